//! Every class of mistake: the place, the message and the mend.

use crate::support::refused;

const CAMERA: &str = "[camera]\nposition = [0, 1, 5]\n";

fn with_camera(marked: &str) -> String {
    format!("{CAMERA}{marked}")
}

#[test]
fn unknown_keys_are_marked_and_a_near_one_is_offered() {
    refused("[camera]\n«fov_degree» = 40\n", "unknown key `fov_degree`", "did you mean `fov`?");
    refused("[render]\nwidth = 8\n«sampels» = 4\n", "unknown key `sampels`", "did you mean `samples`?");
    refused(
        "«[objekt]\n»".replace("«[objekt]\n»", "[«objekt»]\n").as_str(),
        "unknown key `objekt`",
        "did you mean `object`?",
    );
    refused(
        &with_camera("[[object]]\nsphere = { «radios» = 1 }\n"),
        "unknown key `radios`",
        "did you mean `radius`?",
    );
    refused(
        &with_camera("[[light]]\npoint = { position = [0, 0, 0], «zzz» = 1 }\n"),
        "unknown key `zzz`",
        "known: `position`, `falloff`, `ies`, `direction`, `turn`, `normalize`",
    );
    refused(
        &with_camera("[[material]]\nname = \"a\"\nphong.diffuse = { texture = \"t\", «faktor» = 1 }\n"),
        "unknown key `faktor`",
        "did you mean `factor`?",
    );
}

#[test]
fn wrong_types_say_what_was_expected_and_what_is_there() {
    refused(
        "[camera]\nfov = «\"wide\"»\n",
        "expected an angle above 0 and up to 360 degrees, found the text `wide`",
        "",
    );
    refused(
        "[camera]\nfov = «\"40\"»\n",
        "expected an angle above 0 and up to 360 degrees, found the text `40`",
        "remove the quotes",
    );
    refused("[camera]\nposition = «5»\n", "expected an array of 3 values, found 5", "");
    refused("[camera]\nposition = «[0, 1]»\n", "expected an array of 3 values, found 2", "");
    refused("[camera]\nposition = «[0, 1, 2, 3]»\n", "expected an array of 3 values, found 4", "");
    refused("[camera]\nname = «3»\n", "expected text in quotes, found 3", "put it in quotes");
    refused("[camera]\nfocus = «[5, 2.8]»\n", "expected a table, found an array", "");
    refused("camera = «3»\n", "expected a table [camera] or several [[camera]], found 3", "");
    refused("[render]\ntransparent_shadows = «1»\n", "expected true or false, found 1", "");
    refused("[render]\nsamples = «16.5»\n", "expected a whole number of at least 1, found 16.5", "");
    refused("[render]\nseed = «-1»\n", "expected a whole number of at least 0, found -1", "");
    refused("[time]\nframe_rate = «1979-05-27»\n", "expected a number above 0, found a date", "");
    refused(
        &with_camera("[environment]\ncolor = «[1, 2]»\n"),
        "expected a number or an array of 3 numbers, found 2 of them",
        "",
    );
    refused(
        "[render]\nfilter = «7»\n",
        "expected one of `box`, `tent`, `gaussian`, `mitchell`, `blackman_harris`, `lanczos`, found 7",
        "",
    );
    refused("[render]\nfilter = «\"guassian\"»\n", "unknown value `guassian`", "did you mean `gaussian`?");
    refused("[output]\npng_bits = «12»\n", "expected 8 or 16, found 12", "");
}

#[test]
fn missing_keys_name_their_table() {
    refused(
        &with_camera("[[object]]\nsphere = «{}»\n"),
        "missing key `radius` in `sphere`",
        "add `radius = ...`",
    );
    refused(
        &with_camera("«[[texture]]»\nimage = \"a.png\"\n"),
        "missing key `name` in `texture`",
        "add `name = ...`",
    );
}

#[test]
fn numbers_out_of_range_are_marked() {
    let object = |text: &str| with_camera(&format!("[[object]]\n{text}\n"));
    refused(&object("sphere = { radius = «-1» }"), "expected a number above 0, found -1", "");
    refused(&object("sphere = { radius = «0» }"), "expected a number above 0, found 0", "");
    refused(&object("sphere = { radius = «nan» }"), "expected a number above 0, found nan", "");
    refused(&object("sphere = { radius = «inf» }"), "expected a number above 0, found inf", "");
    refused(&object("sphere = { radius = «1e-60» }"), "expected a number above 0, found 1e-60", "");
    refused(&object("sphere = { radius = «1e60» }"), "expected a number above 0, found 1e60", "");
    refused(&object("sphere = { radius = «1e999» }"), "the number is too large", "");
    refused(&object("translate = [0, «-inf», 0]"), "expected a finite number, found -inf", "");
    refused(&object("scale = [1, «0», 1]"), "expected a number other than 0, found 0", "");
    refused("[render]\nsamples = «0»\n", "expected a whole number of at least 1, found 0", "");
    refused("[render]\nwidth = «100000»\n", "expected a whole number from 1 to 65535, found 100000", "");
    refused(
        "[camera]\n[render]\nwidth = «65535»\nheight = 65535\n",
        "a picture of 65535 x 65535 pixels is too large",
        "choose at most 1073741824 pixels in all",
    );
    refused("[time]\nshutter = «1.5»\n", "expected a number from 0 to 1, found 1.5", "");
    refused("[camera]\nfov = «400»\n", "expected an angle above 0 and up to 360 degrees, found 400", "");
    refused(
        "[camera]\nfov = «180»\n",
        "expected an angle below 180 degrees for this projection, found 180",
        "choose a smaller `fov`, or projection = \"fisheye\"",
    );
    refused(
        &with_camera("[environment]\ncolor = [0, «-1», 0]\n"),
        "expected a number of at least 0, found -1",
        "",
    );
    refused(
        "[camera]\nposition = [0, 0, 0]\nfocus = { distance = 1, lens_radius = 0.1, blades = «2» }\n",
        "an iris of 2 blades has no opening",
        "choose 0 for a round one, or at least 3",
    );
    refused(
        "[camera]\n[render]\nregion = «[0, 0, 10, 541]»\n",
        "the region is empty or leaves the picture",
        "write [left, top, right, bottom] within [0, 0, 960, 540]",
    );
    refused(
        "[camera]\n[time]\nfirst_frame = 10\nlast_frame = «9»\n",
        "`last_frame` lies before `first_frame`",
        "choose at least 10",
    );
    let material = "[[material]]\nname = \"a\"\nopacity = «1.5»\n";
    refused(&with_camera(material), "expected a number from 0 to 1, found 1.5", "");
}

#[test]
fn directions_and_transforms_must_mean_something() {
    refused(
        &with_camera("[[light]]\ndirectional = { direction = «[0, 0, 0]» }\n"),
        "the direction is zero",
        "at least one of the three numbers must differ from 0",
    );
    refused(
        &with_camera("[[object]]\nplane = {}\nmatrix = «[[1, 2, 0, 0], [2, 4, 0, 0], [0, 0, 1, 0]]»\n"),
        "the transform has no inverse: it flattens what it places",
        "choose scales other than 0 and rows that do not depend on each other",
    );
    refused(
        &with_camera("[[object]]\nplane = {}\nmatrix = «[[1, 0, 0, 0], [0, 1, 0, 0]]»\n"),
        "expected three rows of four numbers",
        "a fourth row may only be [0, 0, 0, 1]",
    );
    refused(
        &with_camera(
            "[[object]]\nplane = {}\nmatrix = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]\nscale = «2»\n",
        ),
        "`scale` has no effect beside `matrix`",
        "remove `scale`",
    );
    refused(
        "[camera]\nposition = [1, 2, 3]\nlook_at = «[1, 2, 3]»\n",
        "the target is the position itself, so there is no direction",
        "move one of the two",
    );
    refused(
        "[camera]\nlook_at = [0, 5, 0]\nup = «[0, 1, 0]»\n",
        "the camera looks along `up`",
        "choose another direction for the upper border",
    );
    refused(
        &with_camera("[[object]]\ntriangle = «{ a = [0, 0, 0], b = [1, 1, 1], c = [3, 3, 3] }»\n"),
        "the corners of the triangle lie on a line",
        "move one of them off the line through the others",
    );
    refused(
        &with_camera("[[object]]\ndisk = { radius = 1, inner_radius = «1» }\n"),
        "`inner_radius` must be smaller than `radius`",
        "choose a number below 1",
    );
    refused(
        &with_camera("[[light]]\nspot = { position = [0, 4, 0], direction = [0, -1, 0], inner = «40» }\n"),
        "`inner` must not be larger than `outer`",
        "choose at most 30 degrees",
    );
}

#[test]
fn unknown_names_are_marked_and_a_near_one_is_offered() {
    let scene =
        "[camera]\n[[material]]\nname = \"glass\"\n[[object]]\nname = \"ball\"\nsphere = { radius = 1 }\n";
    refused(&format!("{scene}material = «\"glas\"»\n"), "unknown material `glas`", "did you mean `glass`?");
    refused(
        &format!("{scene}materials = [\"glass\", «\"wood\"»]\n"),
        "unknown material `wood`",
        "known: `glass`",
    );
    refused(
        &with_camera("[[object]]\nplane = {}\nmaterial = «\"a\"»\n"),
        "unknown material `a`",
        "add a [[material]] of that name",
    );
    refused(
        &with_camera("[[object]]\nmesh = «\"bunny\"»\n"),
        "unknown mesh `bunny`",
        "add a [[mesh]] of that name",
    );
    refused(
        &with_camera(
            "[[texture]]\nname = \"wood\"\nchecker = { even = 0, odd = 1 }\n[[material]]\nname = \"a\"\nphong.diffuse = { texture = «\"woood\"» }\n",
        ),
        "unknown texture `woood`",
        "did you mean `wood`?",
    );
    refused(
        &scene.replace("[camera]", "[camera]\nlook_at = «\"boll\"»"),
        "unknown object `boll`",
        "did you mean `ball`?",
    );
    refused(
        "[render]\ncamera = «\"mian\"»\n[camera]\nname = \"main\"\n",
        "unknown camera `mian`",
        "did you mean `main`?",
    );
}

#[test]
fn names_are_given_once() {
    refused(
        &with_camera("[[material]]\nname = \"a\"\n[[material]]\nname = «\"a\"»\n"),
        "a second material is named `a`",
        "give each its own `name`",
    );
    refused(
        "[[camera]]\nname = \"a\"\n[[camera]]\nname = «\"a\"»\n",
        "a second camera is named `a`",
        "give each its own `name`",
    );
    refused(
        &with_camera("[[light]]\nname = «\"\"»\nambient = {}\n"),
        "the name is empty",
        "write at least one letter",
    );
}

#[test]
fn exactly_one_of_several_keys() {
    refused(
        &with_camera("[[object]]\nsphere = { radius = 1 }\ntorus = «{ major = 2, minor = 1 }»\n"),
        "`sphere` and `torus` exclude each other",
        "remove one of them",
    );
    refused(
        &with_camera("«[[object]]»\nname = \"ball\"\n"),
        "the object `ball` has no shape",
        "add one of `sphere`, `cuboid`, `plane`, `rectangle`, `disk`, `cylinder`, `cone`, `torus`, `triangle`, `mesh`, `group`",
    );
    refused(
        &with_camera("«[[light]]»\nname = \"key\"\n"),
        "the light `key` has no kind",
        "add one of `ambient`, `point`, `directional`, `spot`, `area`",
    );
    refused(
        &with_camera("[[light]]\nambient = {}\npoint = «{ position = [0, 0, 0] }»\n"),
        "`ambient` and `point` exclude each other",
        "remove one of them",
    );
    refused(
        &with_camera("«[[texture]]»\nname = \"a\"\n"),
        "the texture `a` has no pattern",
        "add one of `image`, `checker`",
    );
    refused(
        &with_camera(
            "[[object]]\nplane = {}\nmaterial = \"a\"\nmaterials = «[\"a\"]»\n[[material]]\nname = \"a\"\n",
        ),
        "`material` and `materials` exclude each other",
        "remove one of them",
    );
    refused(
        &with_camera("[[object]]\nplane = {}\nmaterials = «[]»\n"),
        "`materials` is empty",
        "name at least one material, or remove the key",
    );
    refused(
        "[camera]\nfov = «40»\nfocal_length = 50\n",
        "`focal_length` and `fov` exclude each other",
        "remove one of them",
    );
    refused(
        "[camera]\nfocus = «{ lens_radius = 0.1 }»\n",
        "the focus has no distance",
        "add one of `distance`, `at`",
    );
    refused(
        "[camera]\nfocus = «{ distance = 1 }»\n",
        "the focus has no lens opening",
        "add one of `f_number`, `lens_radius`",
    );
    refused(
        &with_camera("[environment]\ncolor = 1\nimage = «\"a.hdr\"»\n"),
        "`color` and `image` exclude each other",
        "remove one of them",
    );
    refused(
        &with_camera("[[light]]\narea = «{ translate = [0, 1, 0] }»\n"),
        "the area light has no shape",
        "add one of `sphere`, `cuboid`, `plane`, `rectangle`, `disk`, `cylinder`, `cone`, `torus`, `triangle`, `mesh`",
    );
    refused(
        &with_camera("[[light]]\narea = { plane = «{}» }\n"),
        "an infinite plane cannot be an area light",
        "use `rectangle` or `disk`, or a `directional` light",
    );
    refused(
        &with_camera("[[light]]\nspot = «{ position = [0, 1, 0] }»\n"),
        "the spot has no aim",
        "add one of `look_at`, `direction`",
    );
    refused(
        &with_camera(
            "[[texture]]\nname = \"t\"\nchecker = { even = 0, odd = 1 }\n[[material]]\nname = \"a\"\nbump = { texture = \"t\", strength = 1 }\nnormal_map = «{ texture = \"t\" }»\n",
        ),
        "`bump` and `normal_map` exclude each other",
        "remove one of them",
    );
}

#[test]
fn keys_that_would_do_nothing_are_refused() {
    refused("[camera]\nheight = «2»\n", "`height` has no effect in perspective", "remove `height`");
    refused(
        "[camera]\nprojection = \"orthographic\"\nfov = «2»\n",
        "`fov` has no effect on an orthographic camera",
        "remove `fov`",
    );
    refused(
        "[camera]\nprojection = \"fisheye\"\nfov_x = «2»\n",
        "`fov_x` has no effect on a fisheye",
        "remove `fov_x`",
    );
    refused(
        "[camera]\nprojection = \"panorama\"\nfov = «2»\n",
        "`fov` has no effect on a panorama",
        "remove `fov`",
    );
    refused(
        "[camera]\nprojection = \"cylindrical\"\nfocal_length = «2»\n",
        "`focal_length` has no effect on a cylindrical camera",
        "remove `focal_length`",
    );
    refused(
        "[camera]\nsensor_height = «24»\n",
        "`sensor_height` has no effect without `focal_length` or `f_number`",
        "remove `sensor_height`",
    );
    refused(
        "[camera]\nprojection = \"panorama\"\nfocus = { distance = 1, f_number = «2» }\n",
        "`f_number` needs a focal length, which only a perspective camera has",
        "use `lens_radius`",
    );
    refused(
        "[camera]\nfocus = { distance = 1, lens_radius = 1, blade_rotation = «2» }\n",
        "`blade_rotation` has no effect on a round iris",
        "remove `blade_rotation`",
    );
    let texture = |text: &str| with_camera(&format!("[[texture]]\nname = \"t\"\n{text}\n"));
    refused(
        &texture("checker = { even = 0, odd = 1 }\nwrap = «\"clamp\"»"),
        "`wrap` has no effect on a checker",
        "remove `wrap`",
    );
    refused(
        &texture("checker = { even = 0, odd = 1, space = \"local\" }\nrotation = «3»"),
        "`rotation` has no effect on a checker in local space",
        "remove `rotation`",
    );
    refused(
        &texture("image = \"a.png\"\nwrap = \"clamp\"\nwrap_u = «\"repeat\"»"),
        "`wrap_u` has no effect beside `wrap`",
        "remove `wrap_u`",
    );
    refused(
        &with_camera("[environment]\ncolor = 1\nrotation = «3»\n"),
        "`rotation` has no effect without `image`",
        "remove `rotation`",
    );
    refused(
        &with_camera("[environment]\nintensity = «3»\n"),
        "`intensity` has no effect without `color`, `gradient`, `image` or `sky`",
        "remove `intensity`",
    );
    refused(
        &with_camera(
            "[[light]]\narea = { disk = { radius = 1 }, look_at = [0, -1, 0], rotate = «[0, 0, 9]» }\n",
        ),
        "`rotate` has no effect beside `look_at`",
        "remove `rotate`",
    );
}

#[test]
fn a_scene_needs_a_camera() {
    refused("«»", "the scene has no camera", "add [camera] with `position` and `look_at`");
    refused(
        "«»[render]\nwidth = 9\n",
        "the scene has no camera",
        "add [camera] with `position` and `look_at`",
    );
}

#[test]
fn broken_toml_is_marked() {
    refused("[camera]\nfov = «»\n", "string values must be quoted, expected literal string", "");
    refused("[camera]\nfov = 1\n«fov» = 2\n", "duplicate key", "");
}

#[test]
fn focus_behind_the_camera_is_refused() {
    refused(
        "[camera]\nposition = [0, 0, 5]\nfocus = { at = «[0, 0, 9]», lens_radius = 0.1 }\n",
        "the focus is not in front of the camera",
        "choose a point that the camera sees, or `distance`",
    );
}

#[test]
fn physical_surfaces_say_what_they_do_not_take() {
    let material = |rest: &str| with_camera(&format!("[[material]]\nname = \"a\"\n{rest}"));
    refused(&material("standard.conductor = «\"golt\"»\n"), "unknown metal `golt`", "did you mean `gold`?");
    refused(
        &material("phong = {}\nstandard = «{}»\n"),
        "`phong` and `standard` exclude each other",
        "remove one of them",
    );
    refused(
        "[camera]\n[[texture]]\nname = \"t\"\nchecker = { even = 0, odd = 1 }\n\
         [[material]]\nname = \"a\"\nstandard.base_color = { texture = \"t\", channel = «\"r\"» }\n",
        "a colour takes all channels of its texture",
        "remove `channel`",
    );
}

#[test]
fn what_has_an_inside_keeps_its_back_faces() {
    let help = "remove `backfaces`, or what lets light in";
    let message = "what has an inside that light enters needs its back faces";
    for clear in ["phong.transparency = 1", "standard.transmission = 1"] {
        let text = format!("[[material]]\nname = \"m\"\nbackfaces = «\"hidden\"»\n{clear}\n");
        refused(&with_camera(&text), message, help);
    }
    let thin = "[[material]]\nname = \"m\"\nbackfaces = \"hidden\"\nstandard = { transmission = 1, thin_walled = true }\n";
    assert!(crate::support::shot(&with_camera(thin)).is_ok());
}
