//! Groups and copies: what they become, how they move, and what is refused.

use crate::support::{Folder, refused, set, shot, shot_with};
use heliostat_io::OpenOptions;
use heliostat_scene::object::Geometry;
use heliostat_scene::{Census, GroupId, Scene};

const CAMERA: &str = "camera = { position = [0, 1, 5] }\n";

fn scene(text: &str) -> Scene {
    let scene = shot(&format!("{CAMERA}{text}")).unwrap_or_else(|e| panic!("{e}\n{text}")).scene;
    assert_eq!(scene.validate(), Ok(()));
    scene
}

/// Asserts that a text behind a camera is refused.
fn wrong(marked: &str, message: &str, help: &str) {
    refused(&format!("{CAMERA}{marked}"), message, help);
}

const TREE: &str = "\
[[material]]
name = 'bark'
[[group]]
name = 'tree'
[[group.object]]
name = 'trunk'
cylinder = { radius = 0.1, height = 2 }
material = 'bark'
[[group.object]]
group = 'twig'
translate = [0, 2, 0]
visible = false
[[group]]
name = 'twig'
[[group.object]]
sphere = { radius = 0.5 }
casts_shadow = false
";

#[test]
fn groups_keep_what_their_objects_say() {
    let text = format!("{TREE}[[object]]\nname = 'oak'\ngroup = 'tree'\nscale = [1, 2, -1]\n");
    let scene = scene(&text);
    let [tree, twig] = &scene.groups[..] else { panic!("{:?}", scene.groups) };
    assert_eq!((tree.name.as_str(), twig.name.as_str()), ("tree", "twig"));
    let names: Vec<_> = tree.objects.iter().map(|object| object.name.as_str()).collect();
    assert_eq!(names, ["trunk", "object2"]);
    assert_eq!(tree.objects[1].geometry, Geometry::Group(GroupId(1)));
    assert_eq!(tree.objects[1].motion.first().matrix().translation.y, 2.0);
    assert!(tree.objects[0].visible && !tree.objects[1].visible && !twig.objects[0].casts_shadow);
    let material = tree.objects[0].materials[0];
    assert_eq!(scene.materials[material.index()].name, "bark");
    assert_eq!(scene.objects[0].geometry, Geometry::Group(GroupId(0)));
    assert!(scene.objects[0].materials.is_empty());
}

#[test]
fn copies_are_one_object_and_multiply_through_groups() {
    let scene = scene(&format!(
        "{TREE}[[object]]\nname = 'wood'\ngroup = 'tree'\ncopies = {{ count = [20, 1, 30], step = [3, 0, 3] }}\n\
         [[object]]\nname = 'balls'\nsphere = {{ radius = 1 }}\nmaterial = 'bark'\nvisible = false\n\
         copies = {{ count = [2, 3, 4], step = [1, 1, 1] }}\n"
    ));
    assert_eq!(scene.objects.len(), 2);
    let census = Census::new(&scene).unwrap();
    let parts = |i: usize| census.object(&scene, &scene.objects[i]).parts;
    assert_eq!((parts(0), parts(1)), (1200, 24));
    assert!(!scene.objects[1].visible);
    let Geometry::Group(id) = scene.objects[1].geometry else { panic!() };
    assert!(scene.groups[id.index()].objects[0].visible, "told once, outside");
}

#[test]
fn what_lies_in_groups_is_set_and_moves_by_its_path() {
    let text = format!("{CAMERA}{TREE}[[object]]\ngroup = 'tree'\n");
    let options = set(&[
        ("group.tree.object.trunk.translate.x", "7"),
        ("group.twig.object.0.sphere.radius", "3"),
        ("group.tree.object.object2.scale", "2"),
    ]);
    let scene = shot_with(&text, &options).unwrap().scene;
    assert_eq!(scene.groups[0].objects[0].motion.first().matrix().translation.x, 7.0);
    assert_eq!(scene.groups[0].objects[1].motion.first().matrix().matrix3.y_axis.y, 2.0);
    let error = shot_with(&text, &set(&[("group.tree.object.trunc.scale", "2")])).unwrap_err().to_string();
    assert!(error.contains("unknown object `trunc`; did you mean `trunk`?"), "{error}");

    let time = "time = { shutter = 1, frame_rate = 1, first_frame = 0 }\n";
    let moving = "[[animation]]\n\
                  target = 'group.tree.object.object2.rotate.1'\ninterpolation = 'linear'\nkeys = [[-1, 0], [1, 180]]\n";
    let source = Folder::new().open(&format!("{time}{text}{moving}"), &OpenOptions::default()).unwrap();
    let scene = source.shot(0).unwrap().scene;
    let motion = &scene.groups[0].objects[1].motion;
    assert!(motion.poses().len() > 2, "a turn of a quarter needs poses on its arc");
    assert!(!scene.groups[0].objects[0].motion.is_moving());
    let x = motion.first().matrix().matrix3.x_axis;
    // Half a second before the middle: turned by 45 degrees.
    assert!((x.x - 0.5_f64.sqrt()).abs() < 1e-9 && (x.z + 0.5_f64.sqrt()).abs() < 1e-9, "{x}");
}

#[test]
fn a_camera_looks_at_the_middle_of_a_group() {
    let text = "camera = { position = [0, 0, 9], look_at = 'pair' }\n[[group]]\nname = 'g'\n\
                [[group.object]]\nsphere = { radius = 1 }\n\
                [[group.object]]\nsphere = { radius = 1 }\ntranslate = [8, 0, 0]\n\
                [[object]]\nname = 'pair'\ngroup = 'g'\ntranslate = [-4, 0, 0]\n";
    let pose = *shot(text).unwrap().scene.cameras[0].motion.first();
    // Boxes are rounded outward.
    assert!((pose.matrix3.z_axis - glam::DVec3::Z).length() < 1e-6, "{pose}");
}

#[test]
fn names_of_groups() {
    wrong(&format!("{TREE}[[object]]\ngroup = «'tre'»\n"), "unknown group `tre`", "did you mean `tree`?");
    wrong("[[object]]\ngroup = «'tree'»\n", "unknown group `tree`", "add a [[group]] of that name");
    wrong(
        &format!("{TREE}[[group]]\nname = «'tree'»\n"),
        "a second group is named `tree`",
        "give each its own `name`",
    );
    wrong(
        "[[group]]\nname = 'g'\nobject = [{ name = 'a', plane = {} }, { name = «'a'», plane = {} }]\n",
        "a second object is named `a`",
        "give each its own `name`",
    );
}

#[test]
fn groups_that_hold_nothing_themselves_or_too_much() {
    wrong(
        "[[group]]\nname = «'g'»\n",
        "the group `g` holds nothing",
        "add a [[group.object]] below it, or remove the group",
    );
    wrong(
        "[[group]]\nname = 'g'\nobject = [{ group = «'g'» }]\n",
        "the group `g` holds itself: `g` holds `g`",
        "take this object out",
    );
    wrong(
        "[[group]]\nname = 'a'\nobject = [{ group = 'b' }]\n[[group]]\nname = 'b'\nobject = [{ group = 'c' }]\n\
         [[group]]\nname = 'c'\nobject = [{ group = «'b'» }]\n",
        "the group `b` holds itself: `b` holds `c` holds `b`",
        "take this object out",
    );
    let chain = |length: usize, copies: &str| {
        let mut text = "[[group]]\nname = 'g1'\nobject = [{ sphere = { radius = 1 } }]\n".to_owned();
        for i in 2..=length {
            let [open, close] = if i == 17 { ["«", "»"] } else { ["", ""] };
            let inner = i - 1;
            text += &format!(
                "[[group]]\nname = 'g{i}'\nobject = [{{ group = {open}'g{inner}'{close}{copies} }}]\n"
            );
        }
        text
    };
    scene(&format!("{}[[object]]\ngroup = 'g16'\n", chain(16, "")));
    let fewer = "put what the inner groups hold into fewer groups";
    let deep = "groups lie in one another more than 16 deep, copies counted";
    wrong(&chain(17, ""), deep, fewer);
    let copies = ", copies = { count = [1, 1, 1], step = [1, 1, 1] }";
    scene(&chain(8, copies));
    let at_last = chain(9, copies).replace("'g8',", "«'g8'»,");
    wrong(&at_last, deep, fewer);
    // From the outermost inwards: found before the stack is.
    let mut backwards: Vec<_> = (1..2000)
        .map(|i| format!("[[group]]\nname = 'g{i}'\nobject = [{{ group = 'g{}' }}]\n", i + 1))
        .collect();
    backwards.push("[[group]]\nname = 'g2000'\nobject = [{ plane = {} }]\n".into());
    let error = shot(&format!("{CAMERA}{}", backwards.concat())).unwrap_err().to_string();
    assert!(error.contains(deep), "{error}");
}

#[test]
fn keys_that_a_group_does_not_take() {
    wrong(
        &format!("{TREE}[[object]]\ngroup = 'tree'\nmaterial = «'bark'»\n"),
        "`material` has no effect beside `group`, whose objects have their own",
        "remove `material`",
    );
    wrong(
        &format!("{TREE}[[object]]\nsphere = {{ radius = 1 }}\ngroup = «'tree'»\n"),
        "`sphere` and `group` exclude each other",
        "remove one of them",
    );
    wrong(
        "[[light]]\narea = { «group» = 'tree' }\n",
        "unknown key `group`",
        "known: `sphere`, `cuboid`, `plane`, `rectangle`, `disk`, `cylinder`, `cone`, `torus`, `triangle`, `mesh`, `scale`, \
         `rotate`, `translate`, `matrix`, `look_at`, `two_sided`, `visible`, `falloff`",
    );
}

#[test]
fn copies_that_ask_for_too_much() {
    let ball = "[[object]]\nsphere = { radius = 1 }\n";
    wrong(
        &format!("{ball}copies = {{ count = «[2000, 2000, 2]», step = [1, 1, 1] }}\n"),
        "the file asks for 8000000 copies, 4000000 is the most",
        "put copies into a [[group]] and make copies of that: they multiply",
    );
    wrong(
        &format!("{ball}copies = {{ count = «[4294967295, 4294967295, 4294967295]», step = [1, 1, 1] }}\n"),
        "the file asks for 18446744073709551615 copies, 4000000 is the most",
        "put copies into a [[group]] and make copies of that: they multiply",
    );
    wrong(
        &format!("{ball}copies = {{ count = [1, «0», 1], step = [1, 1, 1] }}\n"),
        "expected a whole number of at least 1, found 0",
        "",
    );
    wrong(
        &format!("{ball}copies = {{ count = [1, 1, 1], step = [1, 1, 1], jitter = {{ scale = «1.5» }} }}\n"),
        "expected a number from 0 to 1, found 1.5",
        "",
    );
    // More parts than have numbers.
    let mut text = "[[group]]\nname = 'g1'\nobject = [{ plane = {} }]\n".to_owned();
    for i in 2..=7 {
        text += &format!(
            "[[group]]\nname = {}'g{i}'{}\n",
            ["", "«"][usize::from(i == 5)],
            ["", "»"][usize::from(i == 5)]
        );
        text += &format!(
            "object = [{{ group = 'g{}', copies = {{ count = [300000, 1, 1], step = [1, 1, 1] }} }}]\n",
            i - 1
        );
    }
    let error = shot(&format!("{CAMERA}{}", text.replace(['«', '»'], ""))).unwrap_err().to_string();
    assert!(error.contains("the group holds more parts than can be numbered; make fewer copies"), "{error}");
    wrong(
        "[[material]]\nname = 'm'\nphong = { emission = 1 }\n[[group]]\nname = 'g'\nobject = [{ sphere = { radius = 1 }, material = 'm' }]\n\
         [[object]]\ngroup = «'g'»\ncopies = { count = [40, 1, 40], step = [1, 1, 1] }\n",
        "groups and copies bring 1600 things that shine, each a light of its own; 1024 is the most",
        "make fewer copies, or take the emission from the material",
    );
}
