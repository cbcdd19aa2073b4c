//! `path` finds what `path_simple` finds: scattered rays alone, weighed against nothing.

mod common;

use common::{
    Estimate, Stage, at, ball_mesh, black, cuboid, grey, plane, rectangle, sphere, tilted, torus, white,
};
use glam::{DAffine3, DVec3, Vec2, Vec3};
use heliostat_geometry::shape::{Cone, Cylinder};
use heliostat_geometry::{Shape, Transform, TriMesh};
use heliostat_scene::image::{Encoding, Samples};
use heliostat_scene::light::{Falloff, LightKind};
use heliostat_scene::material::{ColorInput, FloatInput, FresnelMode, Phong, Standard, Surface};
use heliostat_scene::object::Geometry;
use heliostat_scene::scene::Background;
use heliostat_scene::settings::IntegratorKind;
use heliostat_scene::{Group, GroupId, Image, MaterialId, Motion, Object, Rgb};
use std::sync::Arc;

fn area(geometry: Geometry, transform: Transform) -> LightKind {
    LightKind::Area { geometry, transform, two_sided: false, visible: true, falloff: Falloff::InverseSquare }
}

fn shining(radiance: f32) -> Phong {
    Phong { emission: grey(radiance), ..black() }
}

fn clear(ior: f32) -> Phong {
    Phong { transparency: grey(0.9), ior, fresnel: FresnelMode::Dielectric, ..black() }
}

/// A floor with a wall behind it, under a lamp that is large enough to be met by chance.
fn room() -> Stage {
    Stage::new()
        .with(plane(), Phong { diffuse: grey(0.6), ..white() }, Transform::IDENTITY)
        .with(rectangle(6.0, 6.0), Phong { diffuse: grey(0.5), ..white() }, tilted(90.0, 0.0, 3.0, -1.5))
        .with_light(4.0, 1, area(rectangle(2.0, 2.0), tilted(180.0, 0.5, 2.5, 0.5)))
}

/// Asserts that both integrators agree on what is seen from `from` at `to`.
#[track_caller]
fn assert_agree(mut stage: Stage, from: Vec3, to: Vec3, samples: u32, what: &str) {
    let samples = 8 * samples;
    let mut seen = |kind, samples| {
        stage.settings.integrator = kind;
        Estimate::new(&stage, from, to, samples)
    };
    let simple = seen(IntegratorKind::PathSimple, 4 * samples);
    let path = seen(IntegratorKind::Path, samples);
    assert!(path.mean.min_element() > 0.0, "{what} is black: {path:?}");
    path.assert_same(&simple, what);
    let volpath = seen(IntegratorKind::VolPath, samples);
    volpath.assert_same(&simple, what);
}

const FROM: Vec3 = Vec3::new(0.5, 1.5, 4.0);
const FLOOR: Vec3 = Vec3::new(0.2, 0.0, 0.3);

#[test]
fn matte_and_glossy() {
    assert_agree(room(), FROM, FLOOR, 64, "matte");
    for shininess in [3.0, 60.0] {
        let shiny = Phong {
            diffuse: grey(0.2),
            specular: grey(0.7),
            shininess: FloatInput::constant(shininess),
            ..white()
        };
        let stage = room().with(sphere(0.5), shiny, at(0.0, 0.5, 0.0));
        assert_agree(stage, FROM, Vec3::new(0.1, 0.8, 0.3), 64, "glossy");
    }
}

#[test]
fn mirror_and_glass() {
    let mirror = Phong { mirror: grey(0.9), ..black() };
    assert_agree(room().with(cuboid(1.0, 1.0, 0.1), mirror, at(0.0, 0.5, -0.5)), FROM, FLOOR, 64, "mirror");
    let ball = || room().with(sphere(0.4), clear(1.5), at(0.2, 0.4, 0.3));
    assert_agree(ball(), FROM, Vec3::new(0.2, 0.4, 0.3), 64, "glass");
    assert_agree(ball(), FROM, FLOOR + 0.5 * Vec3::X, 64, "beside glass");
    let coloured = Phong { absorption: Rgb::new(0.5, 1.0, 2.0), ..clear(1.3) };
    let block = room().with(cuboid(0.6, 0.6, 0.6), coloured, at(0.2, 0.3, 0.3));
    assert_agree(block, FROM, Vec3::new(0.2, 0.2, 0.5), 64, "glass on the floor");
}

#[test]
fn cut_outs_and_thin_walls_let_light_through() {
    let above = tilted(5.0, 0.2, 1.2, 0.3);
    let net = room().with(rectangle(2.0, 2.0), white(), above).with_opacity(0.4);
    assert_agree(net, FROM, FLOOR, 64, "cut-out");
    let pane =
        Phong { diffuse: grey(0.2), mirror: grey(0.1), absorption: Rgb::new(0.1, 1.0, 3.0), ..clear(1.0) };
    let thin = room().with(rectangle(2.0, 2.0), pane.clone(), above);
    assert_agree(thin, FROM, FLOOR, 64, "thin wall");
    let block = room().with(cuboid(1.5, 0.3, 1.5), pane, at(0.2, 1.2, 0.3));
    assert_agree(block, FROM, FLOOR, 64, "block that bends nothing");
}

#[test]
fn every_kind_of_lamp() {
    let lamps = [
        ("sphere", sphere(0.5)),
        ("cylinder", Geometry::Shape(Shape::Cylinder(Cylinder { radius: 0.3, height: 1.0, capped: true }))),
        (
            "cone",
            Geometry::Shape(Shape::Cone(Cone { radius: 0.4, top_radius: 0.1, height: 0.8, capped: true })),
        ),
        ("torus", torus(0.6, 0.2)),
        ("box", cuboid(0.8, 0.5, 0.3)),
    ];
    let squeezed = DAffine3::from_scale_rotation_translation(
        DVec3::new(1.0, 0.4, 1.6),
        glam::DQuat::from_rotation_z(0.5),
        DVec3::new(0.0, 1.2, 0.2),
    );
    for (name, lamp) in lamps {
        for place in [at(0.0, 1.2, 0.2), Transform::new(squeezed).unwrap()] {
            let floor = || Stage::new().with(plane(), white(), Transform::IDENTITY);
            assert_agree(floor().with_light(2.0, 1, area(lamp.clone(), place)), FROM, FLOOR, 32, name);
            assert_agree(floor().with(lamp.clone(), shining(2.0), place), FROM, FLOOR, 32, name);
        }
    }
}

#[test]
fn meshes_and_parts_of_groups_that_shine() {
    let mut stage = Stage::new().with(plane(), white(), Transform::IDENTITY);
    let mesh = stage.mesh(ball_mesh(0.4, 6, true));
    let stage = stage.with(mesh.clone(), shining(2.0), at(0.6, 1.0, 0.0));
    let material = MaterialId(stage.scene.materials.len() as u32 - 1);
    let part = |name: &str, geometry: Geometry, place| Object {
        name: name.into(),
        geometry,
        materials: vec![material],
        motion: Motion::still(place),
        visible: true,
        casts_shadow: true,
    };
    let mut stage = stage;
    let places = [-1.0, 0.0, 1.0].map(|x| DAffine3::from_translation(DVec3::new(x, 0.0, 0.0)));
    let objects = vec![part("a", sphere(0.2), at(0.0, 0.4, 0.0)), part("b", mesh, at(0.0, 1.5, 0.0))];
    stage.scene.groups.push(Group { name: "lamps".into(), objects, places: places.to_vec() });
    let mut row = part("row", Geometry::Group(GroupId(0)), at(0.0, 0.2, -0.4));
    row.materials.clear();
    stage.scene.objects.push(row);
    assert_agree(stage, FROM, FLOOR, 64, "shining groups");
}

#[test]
fn lights_that_no_ray_meets() {
    let invisible = |falloff| LightKind::Area {
        geometry: rectangle(0.5, 0.5),
        transform: tilted(150.0, -1.0, 2.0, 0.5),
        two_sided: true,
        visible: falloff == Falloff::None,
        falloff,
    };
    let stage = room()
        .with_point_light(3.0, Vec3::new(-1.0, 1.0, 1.0))
        .with_light(0.4, 1, invisible(Falloff::None))
        .with_light(2.0, 1, invisible(Falloff::InverseSquare))
        .with_light(1.0, 1, LightKind::Directional { direction: Vec3::new(0.6, -0.8, 0.0), angle: 0.0 })
        .with_light(0.5, 1, LightKind::Ambient);
    assert_agree(stage, FROM, FLOOR, 64, "lights unseen");
}

#[test]
fn many_lights_and_lights_in_each_others_way() {
    let mut stage = Stage::new().with(plane(), white(), Transform::IDENTITY);
    for i in 0..12 {
        let (x, z) = ((i % 4) as f32 - 1.5, (i / 4) as f32 - 1.0);
        let kind = area(rectangle(0.6, 0.6), tilted(180.0, x.into(), 0.4 + 0.2 * f64::from(z), z.into()));
        stage = stage.with_light(1.0 + i as f32, 1, kind);
    }
    assert_agree(stage, Vec3::new(0.5, 0.3, 4.0), FLOOR, 64, "many lights");
}

#[test]
fn a_sky_with_a_small_sun_and_a_sun_disk() {
    let mut values = vec![0.2; 3 * 32 * 16];
    values[3 * (3 * 32 + 18)..][..3].copy_from_slice(&[60.0, 50.0, 20.0]);
    let image = Image::new(32, 16, 3, Encoding::Linear, Samples::F32(values));
    let sky = |rotation| Background::Image { image: Arc::new(image.clone()), intensity: Rgb::ONE, rotation };
    let shiny = || Phong { specular: grey(0.5), diffuse: grey(0.4), ..white() };
    for rotation in [0.0, 2.0] {
        let mut stage = Stage::new().with(plane(), shiny(), Transform::IDENTITY);
        stage.scene.background = sky(rotation);
        stage.add(sphere(0.4), white(), at(0.5, 0.4, 0.0));
        assert_agree(stage, FROM, FLOOR, 64, "sky");
    }
    let sun = LightKind::Directional { direction: Vec3::new(0.6, -0.8, 0.0), angle: 0.8 };
    let stage = Stage::new().with(plane(), shiny(), Transform::IDENTITY).with_light(2.0, 1, sun);
    assert_agree(stage.with_sky(0.1), FROM, FLOOR, 64, "sun disk");
}

#[test]
fn facets_of_a_smooth_surface() {
    let mut stage = room();
    let mesh = stage.mesh(ball_mesh(0.6, 5, true));
    let stage = stage.with(mesh, Phong { specular: grey(0.3), ..white() }, at(0.0, 0.6, 0.0));
    for to in [Vec3::new(0.0, 0.6, 0.0), Vec3::new(0.4, 0.8, 0.0), Vec3::new(-0.5, 0.5, 0.1)] {
        assert_agree(stage_again(&stage), FROM, to, 64, "facets");
    }
}

fn stage_again(stage: &Stage) -> Stage {
    Stage { scene: stage.scene.clone(), settings: stage.settings.clone() }
}

#[test]
fn a_thing_that_moves_and_shines() {
    let mut stage = Stage::new().with(plane(), white(), Transform::IDENTITY);
    let lamp = stage.add(sphere(0.4), shining(3.0), at(0.0, 1.0, 0.0));
    lamp.motion = Motion::through(vec![at(-1.0, 1.0, 0.0), at(1.0, 1.0, 0.0)]).unwrap();
    assert_agree(stage, FROM, FLOOR, 32, "moving lamp");
}

#[test]
fn a_mesh_with_a_dark_slot() {
    let mut stage = Stage::new().with(plane(), white(), Transform::IDENTITY);
    let positions = [(-1.0, 1.0), (1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)].map(|(x, z)| Vec3::new(x, 1.0, z));
    let mesh = stage.mesh(TriMesh {
        positions: positions.to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        slots: vec![0, 1],
        uvs: vec![Vec2::ZERO; 4],
        ..TriMesh::default()
    });
    let mut stage = stage.with(mesh, shining(2.0), Transform::IDENTITY);
    stage.scene.objects.last_mut().unwrap().materials.insert(0, MaterialId(0));
    assert_agree(stage, Vec3::new(0.5, 0.6, 4.0), FLOOR, 32, "half of a mesh");
}

#[test]
fn glass_that_parts_colours() {
    let prism = Standard {
        base_color: ColorInput::constant(Rgb::new(0.9, 0.8, 0.95)),
        transmission: FloatInput::constant(1.0),
        roughness: FloatInput::constant(0.0),
        dispersion: 4.0,
        ..Standard::default()
    };
    let mut stage = room();
    stage.add(sphere(0.6), black(), at(0.2, 0.7, 0.8));
    stage.last_material().surface = Surface::Standard(Box::new(prism));
    assert_agree(stage, FROM, Vec3::new(0.45, 0.8, 0.8), 64, "glass that parts colours");
}
