//! A valid scene has no issues; each way to break it gives the issue that says so.

use glam::{DAffine3, Vec2, Vec3};
use heliostat_geometry::mesh::MeshError;
use heliostat_geometry::shape::{Disk, Plane, Sphere, Triangle};
use heliostat_geometry::{Shape, Transform, TriMesh};
use heliostat_scene::camera::{Camera, Focus, FocusMethod, Projection};
use heliostat_scene::image::{Encoding, Image, Samples};
use heliostat_scene::light::{Falloff, Light, LightKind};
use heliostat_scene::material::{ColorInput, Material, Phong, Relief, Surface};
use heliostat_scene::medium::{Atmosphere, DensityGrid};
use heliostat_scene::object::{Geometry, Object};
use heliostat_scene::scene::Background;
use heliostat_scene::texture::{Filtering, Minify, Pattern, Texture, UvTransform, Wrap};
use heliostat_scene::validate::{ItemKind, Problem};
use heliostat_scene::{Group, GroupId, MaterialId, Medium, MediumId, MeshId, Motion, Rgb, Scene, TextureId};
use std::sync::Arc;

fn scene() -> Scene {
    let triangle = TriMesh {
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
        triangles: vec![[0, 1, 2]],
        ..TriMesh::default()
    };
    let image = Image::new(2, 1, 3, Encoding::Srgb, Samples::U8(vec![0; 6]));
    let pattern = Pattern::Image {
        image: Arc::new(image),
        wrap_u: Wrap::Repeat,
        wrap_v: Wrap::Repeat,
        filtering: Filtering::Bilinear,
        minify: Minify::Mip,
    };
    let light = |name: &str, kind| Light { name: name.to_owned(), intensity: Vec3::ONE, samples: 1, kind };
    let area = LightKind::Area {
        geometry: Geometry::Mesh(MeshId(0)),
        transform: Transform::IDENTITY,
        two_sided: false,
        visible: true,
        falloff: Falloff::None,
    };
    let spot = LightKind::Spot {
        position: Vec3::Y,
        direction: Vec3::NEG_Y,
        inner: 0.1,
        outer: 0.2,
        falloff: Falloff::InverseSquare,
    };
    Scene {
        meshes: vec![Arc::new(triangle)],
        textures: vec![Texture { name: "wood".to_owned(), pattern, uv: UvTransform::default() }],
        materials: vec![Material::new("red", Phong::default())],
        groups: vec![Group::once("pair", vec![object("disc", Geometry::Shape(Shape::Plane(Plane)))])],
        objects: vec![
            object("ball", Geometry::Shape(Shape::Sphere(Sphere { radius: 1.0 }))),
            object("leaf", Geometry::Mesh(MeshId(0))),
        ],
        lights: vec![light("key", area), light("rim", spot)],
        cameras: vec![Camera {
            name: "main".to_owned(),
            motion: Motion::still(DAffine3::IDENTITY),
            projection: Projection::Perspective { fov_y: 1.0 },
            focus: Some(Focus {
                distance: 1.0,
                lens_radius: 0.0,
                blades: 0,
                blade_rotation: 0.0,
                method: FocusMethod::Lens,
            }),
        }],
        ..Scene::default()
    }
}

fn object(name: &str, geometry: Geometry) -> Object {
    Object {
        name: name.to_owned(),
        geometry,
        materials: vec![MaterialId(0)],
        motion: Motion::still(Transform::IDENTITY),
        visible: true,
        casts_shadow: true,
    }
}

/// Breaks the valid scene and asserts the one issue that follows, as a sentence.
fn broken(sentence: &str, change: impl FnOnce(&mut Scene)) {
    let mut scene = scene();
    change(&mut scene);
    let issues = scene.validate().expect_err(sentence);
    let told: Vec<_> = issues.iter().map(ToString::to_string).collect();
    assert_eq!(told, [sentence]);
}

fn phong(scene: &mut Scene) -> &mut Phong {
    let Surface::Phong(phong) = &mut scene.materials[0].surface else { panic!("not the report\'s surface") };
    phong
}

#[test]
fn a_valid_scene_has_no_issues() {
    assert_eq!(scene().validate(), Ok(()));
}

#[test]
fn ids_must_point_to_something() {
    broken("object `leaf`: mesh 1 does not exist, there are 1", |s| {
        s.objects[1].geometry = Geometry::Mesh(MeshId(1));
    });
    broken("object `ball`: material 7 does not exist, there are 1", |s| {
        s.objects[0].materials = vec![MaterialId(0), MaterialId(7)];
    });
    broken("object `ball`: there is no material", |s| s.objects[0].materials.clear());
    broken("material `red`: texture 1 does not exist, there are 1", |s| {
        phong(s).mirror.texture = Some(TextureId(1));
    });
    broken("material `red`: texture 2 does not exist, there are 1", |s| {
        s.materials[0].relief = Some(Relief::Bump { texture: TextureId(2), strength: 1.0 });
    });
    broken("light `key`: mesh 9 does not exist, there are 1", |s| {
        if let LightKind::Area { geometry, .. } = &mut s.lights[0].kind {
            *geometry = Geometry::Mesh(MeshId(9));
        }
    });
}

#[test]
fn names_are_given_once() {
    broken("object `ball`: the name is taken by an earlier one", |s| s.objects[1].name = "ball".to_owned());
    broken("light `key`: the name is taken by an earlier one", |s| s.lights[1].name = "key".to_owned());
    // The same name in two arrays is fine.
    let mut scene = scene();
    scene.materials[0].name = "ball".to_owned();
    assert_eq!(scene.validate(), Ok(()));
}

#[test]
fn a_scene_needs_a_camera() {
    broken("there is no camera", |s| s.cameras.clear());
}

#[test]
fn measures_must_be_in_range() {
    let shape = |s: &mut Scene, shape| s.objects[0].geometry = Geometry::Shape(shape);
    broken("object `ball`: radius must be above 0, is 0", |s| {
        shape(s, Shape::Sphere(Sphere { radius: 0.0 }));
    });
    broken("object `ball`: radius is not finite", |s| shape(s, Shape::Sphere(Sphere { radius: f32::NAN })));
    broken("object `ball`: inner_radius must be from 0 to below the radius, is 1", |s| {
        shape(s, Shape::Disk(Disk { radius: 1.0, inner_radius: 1.0 }));
    });
    broken("object `ball`: there is no surface", |s| {
        shape(s, Shape::Triangle(Triangle { a: Vec3::ZERO, b: Vec3::ONE, c: Vec3::splat(3.0) }));
    });
    broken("material `red`: ior must be above 0, is 0", |s| phong(s).ior = 0.0);
    broken("material `red`: diffuse must be at least 0, is -1", |s| {
        phong(s).diffuse = ColorInput::constant(Vec3::new(0.0, -1.0, 0.0));
    });
    broken("material `red`: opacity must be from 0 to 1, is 2", |s| s.materials[0].opacity.factor = 2.0);
    broken("texture `wood`: the change of uv is not finite", |s| {
        s.textures[0].uv.scale = Vec2::new(1.0, f32::INFINITY);
    });
    broken("the background is not finite", |s| {
        s.background = Background::Constant(Vec3::new(0.0, f32::NAN, 0.0));
    });
}

#[test]
fn lights_must_shine_somewhere() {
    broken("light `key`: samples must be at least 1, is 0", |s| s.lights[0].samples = 0);
    broken("light `rim`: the length of the direction must be above 0, is 0", |s| {
        if let LightKind::Spot { direction, .. } = &mut s.lights[1].kind {
            *direction = Vec3::ZERO;
        }
    });
    broken("light `rim`: inner must be from 0 to outer, is 3", |s| {
        if let LightKind::Spot { inner, .. } = &mut s.lights[1].kind {
            *inner = 3.0;
        }
    });
    broken("light `key`: a light cannot have an infinite surface", |s| {
        if let LightKind::Area { geometry, .. } = &mut s.lights[0].kind {
            *geometry = Geometry::Shape(Shape::Plane(Plane));
        }
    });
    broken("light `key`: there is no surface", |s| s.meshes[0] = Arc::new(TriMesh::default()));
}

#[test]
fn cameras_must_see() {
    broken("camera `main`: fov_y must be between 0 and pi, is 4", |s| {
        s.cameras[0].projection = Projection::Perspective { fov_y: 4.0 };
    });
    broken("camera `main`: height must be above 0, is -1", |s| {
        s.cameras[0].projection = Projection::Orthographic { height: -1.0 };
    });
    broken("camera `main`: the pose is not finite", |s| {
        s.cameras[0].motion = Motion::still(DAffine3::from_translation(glam::DVec3::NAN));
    });
    let focus =
        |s: &mut Scene, change: &dyn Fn(&mut Focus)| change(s.cameras[0].focus.as_mut().expect("a focus"));
    broken("camera `main`: the focus distance must be above 0, is 0", |s| focus(s, &|f| f.distance = 0.0));
    broken("camera `main`: blades must be 0 or at least 3, is 2", |s| focus(s, &|f| f.blades = 2));
}

#[test]
fn meshes_and_images_must_be_whole() {
    let mut scene = scene();
    Arc::make_mut(&mut scene.meshes[0]).triangles[0][2] = 5;
    let issues = scene.validate().expect_err("a dangling vertex");
    assert_eq!((issues[0].kind, issues[0].index), (ItemKind::Mesh, 0));
    assert!(matches!(issues[0].problem, Problem::Mesh(MeshError::Index { vertex: 5, .. })), "{issues:?}");
    broken("texture `wood`: the image has not as many samples as its size says", |s| {
        if let Pattern::Image { image, .. } = &mut s.textures[0].pattern {
            Arc::make_mut(image).width = 3;
        }
    });
}

#[test]
fn every_issue_is_told_at_once() {
    let mut scene = scene();
    scene.cameras.clear();
    scene.objects[0].materials.clear();
    scene.lights[0].samples = 0;
    assert_eq!(scene.validate().map_err(|issues| issues.len()), Err(3));
}

/// An object that places a group.
fn placed(name: &str, group: u32) -> Object {
    Object { materials: vec![], ..object(name, Geometry::Group(GroupId(group))) }
}

#[test]
fn groups() {
    broken("group `pair`: the group holds no objects", |s| s.groups[0].objects.clear());
    broken("group `pair`: the group has no place to stand", |s| s.groups[0].places.clear());
    broken("group `pair`: the transform of copy 1 has no inverse", |s| {
        s.groups[0].places.push(DAffine3::ZERO);
    });
    broken("object `pair/disc`: material 7 does not exist, there are 1", |s| {
        s.groups[0].objects[0].materials = vec![MaterialId(7)];
    });
    broken("object `ball`: group 1 does not exist, there are 1", |s| s.objects[0] = placed("ball", 1));
    broken("object `ball`: a group takes no material: the objects that it holds have their own", |s| {
        s.objects[0].geometry = Geometry::Group(GroupId(0));
    });
    broken("light `key`: a group cannot be an area light", |s| {
        let LightKind::Area { geometry, .. } = &mut s.lights[0].kind else { panic!() };
        *geometry = Geometry::Group(GroupId(0));
    });
}

#[test]
fn groups_in_groups() {
    broken("group `pair`: the group holds itself", |s| s.groups[0].objects.push(placed("again", 0)));
    broken("group `pair`: the group holds itself", |s| {
        s.groups[0].objects.push(placed("other", 1));
        s.groups.push(Group::once("other", vec![placed("pair", 0)]));
    });
    let chain = |s: &mut Scene, length: u32| {
        (1..length)
            .for_each(|i| s.groups.push(Group::once(format!("group {i}"), vec![placed("inner", i - 1)])));
    };
    let mut deep = scene();
    chain(&mut deep, Group::MAX_DEPTH);
    deep.validate().expect("as deep as may be");
    broken("group `group 16`: groups lie in one another more than 16 deep", |s| chain(s, 17));
    // Backwards, so that the deepest is looked at first.
    broken("group `pair`: groups lie in one another more than 16 deep", |s| {
        chain(s, 17);
        s.groups.reverse();
        let last = s.groups.len() as u32 - 1;
        for group in &mut s.groups {
            for object in group.objects.iter_mut().filter(|o| matches!(o.geometry, Geometry::Group(_))) {
                let Geometry::Group(id) = &mut object.geometry else { unreachable!() };
                id.0 = last - id.0;
            }
        }
    });
    // 2^80 things are more than there are numbers, and are counted in no time.
    broken("group `group 12`: the group holds more parts than can be numbered", |s| {
        chain(s, 16);
        s.groups.iter_mut().for_each(|group| group.places = vec![DAffine3::IDENTITY; 32]);
    });
}

#[test]
fn media_have_numbers_and_grids_that_mean_something() {
    let good = || {
        let mut scene = scene();
        let values = vec![0.5; 6].into();
        let density = Some(DensityGrid { size: [1, 2, 3], values, place: Transform::IDENTITY });
        let smoke = Medium::homogeneous("smoke", Rgb::ZERO, Rgb::ONE, 0.3);
        scene.media = vec![Medium { density, ..smoke }, Medium::homogeneous("fog", Rgb::ONE, Rgb::ZERO, 0.0)];
        scene.atmosphere = Some(Atmosphere { medium: MediumId(1), radius: None });
        scene.materials[0].interior = Some(MediumId(0));
        scene
    };
    assert_eq!(good().validate(), Ok(()));
    let with = |change: fn(&mut Scene)| {
        let mut scene = good();
        change(&mut scene);
        scene.validate().unwrap_err().iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    let grid = "medium `smoke`: the grid has not as many values as its size says";
    type Case = (fn(&mut Scene), &'static str);
    let cases: [Case; 8] = [
        (|s| s.media[0].anisotropy = 1.0, "medium `smoke`: anisotropy must be above -1 and below 1, is 1"),
        (|s| s.media[0].scattering.y = f32::NAN, "medium `smoke`: scattering is not finite"),
        (|s| s.media[1].absorption.x = -1.0, "medium `fog`: absorption must be at least 0, is -1"),
        (|s| s.media[0].density.as_mut().unwrap().size = [1, 2, 4], grid),
        (|s| s.media[0].density.as_mut().unwrap().size = [0, 2, 3], grid),
        (|s| s.media[1].name = "smoke".to_owned(), "medium `smoke`: the name is taken by an earlier one"),
        (
            |s| s.materials[0].interior = Some(MediumId(2)),
            "material `red`: medium 2 does not exist, there are 2",
        ),
        (
            |s| s.atmosphere = Some(Atmosphere { medium: MediumId(5), radius: None }),
            "medium 5 does not exist, there are 2",
        ),
    ];
    for (change, expected) in cases {
        assert_eq!(with(change), [expected]);
    }
}
