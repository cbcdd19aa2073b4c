//! Faces that are seen from the front alone: who sees them, and who does not.

mod common;

use common::{
    Estimate, Looker, Stage, at, ball_mesh, black, box_mesh, glass, grey, mirror, plane, rectangle, sphere,
    tilted, white,
};
use glam::Vec3;
use heliostat_geometry::{Ray, Transform};
use heliostat_index::TraversalCost;
use heliostat_scene::material::{Back, Phong};
use heliostat_scene::settings::IntegratorKind;
use heliostat_scene::{RenderSettings, Scene};

const SEEN: [IntegratorKind; 8] = [
    IntegratorKind::Whitted,
    IntegratorKind::Direct,
    IntegratorKind::Path,
    IntegratorKind::PathSimple,
    IntegratorKind::VolPath,
    IntegratorKind::Normals,
    IntegratorKind::Depth,
    IntegratorKind::AmbientOcclusion,
];
const UP: Vec3 = Vec3::new(0.1, 9.0, 0.2);
const DOWN: Vec3 = Vec3::new(0.1, -9.0, 0.2);
const MIDDLE: Vec3 = Vec3::new(0.1, 0.0, 0.2);

fn shining(radiance: f32) -> Phong {
    Phong { emission: grey(radiance), ..black() }
}

fn hide(stage: &mut Stage) {
    stage.last_material().back = Back::Hidden;
}

/// A sheet in the plane y = 0 that faces up, and shining sheets far above and below it.
fn sheet() -> Stage {
    let mut stage = Stage::new().with(rectangle(2.0, 2.0), shining(1.0), Transform::IDENTITY);
    hide(&mut stage);
    stage.with(rectangle(90.0, 90.0), shining(2.0), at(0.0, 20.0, 0.0)).with(
        rectangle(90.0, 90.0),
        shining(3.0),
        at(0.0, -20.0, 0.0),
    )
}

#[test]
fn every_integrator_and_its_layers_look_past_hidden_backs() {
    for integrator in SEEN {
        let stage = Stage { settings: RenderSettings { integrator, ..RenderSettings::default() }, ..sheet() };
        let object = |from| stage.look(from, MIDDLE).first.unwrap().object;
        assert_eq!((object(UP), object(DOWN)), (Some(0), Some(1)), "{integrator:?}");
    }
    for integrator in &SEEN[..5] {
        let settings = RenderSettings { integrator: *integrator, ..RenderSettings::default() };
        let stage = Stage { settings, ..sheet() };
        assert_eq!((stage.grey(UP, MIDDLE), stage.grey(DOWN, MIDDLE)), (1.0, 2.0), "{integrator:?}");
    }
}

#[test]
fn distances_are_those_from_the_camera() {
    let stage = sheet();
    let looker = Looker::new(&stage);
    let ray = Ray::new(Vec3::new(0.3, -9.0, 0.2), Vec3::Y);
    let past = looker.world.camera_hit(&ray, 0.0).unwrap();
    assert_eq!((past.object(), past.hit.t), (Some(1), 29.0));
    assert_eq!(looker.world.closest_hit(&ray, 0.0).unwrap().object(), Some(0), "who asks for all there is");
    assert_eq!(looker.world.camera_hit_counted(&ray, 0.0, &mut TraversalCost::default()), Some(past));
}

#[test]
fn a_mirror_and_clear_glass_show_what_the_camera_would_see() {
    for integrator in &SEEN[..5] {
        let settings = RenderSettings { integrator: *integrator, ..RenderSettings::default() };
        // A mirror below sees the sheet from behind; one above sees its front.
        for (y, expected) in [(-5.0, 2.0), (5.0, 1.0)] {
            let mut stage = Stage { settings: settings.clone(), ..sheet() };
            stage.add(rectangle(2.0, 2.0), mirror(), at(0.0, y, 0.0));
            assert_eq!(
                stage.grey(Vec3::new(0.1, y / 2.0, 0.2), Vec3::new(0.1, y, 0.2)),
                expected,
                "{integrator:?} {y}"
            );
        }
        let mut stage = Stage { settings, ..sheet() };
        stage.add(rectangle(2.0, 2.0), glass(1.0), at(0.0, -5.0, 0.0));
        assert_eq!(stage.grey(DOWN, MIDDLE), 2.0, "{integrator:?}");
    }
}

#[test]
fn many_layers_and_meshes_are_passed() {
    // Fifty balls in each other show their inner sides alone to who stands in the middle, be they shapes or meshes.
    let mut stage = Stage::new().with_sky(0.25);
    for i in 1..50 {
        let radius = 1.2_f32.powi(i);
        let geometry = if i % 2 == 0 { sphere(radius) } else { stage.mesh(ball_mesh(radius, 6, true)) };
        stage.add(geometry, shining(1.0), Transform::IDENTITY);
        hide(&mut stage);
    }
    for dir in [Vec3::X, Vec3::new(0.3, -0.5, 0.7), Vec3::NEG_Y] {
        assert_eq!(stage.grey(Vec3::new(0.01, 0.02, 0.03), dir), 0.25);
        assert_eq!(stage.look(2e4 * dir.normalize(), Vec3::ZERO).first.unwrap().object, Some(48));
    }
}

#[test]
fn the_front_of_a_mirrored_thing_stays_its_outside() {
    for flip in [Vec3::new(-1.0, 1.0, 1.0), Vec3::new(1.0, -2.0, 1.0), Vec3::new(-1.0, -1.0, -1.0)] {
        let mut stage = Stage::new().with_sky(0.25);
        let mesh = stage.mesh(box_mesh(Vec3::NEG_ONE, Vec3::ONE));
        stage.add(mesh, shining(1.0), Transform::scaling(flip).unwrap());
        hide(&mut stage);
        assert_eq!(stage.grey(Vec3::new(0.1, 0.2, 9.0), Vec3::new(0.1, 0.2, 0.0)), 1.0, "{flip}");
        assert_eq!(stage.grey(Vec3::new(0.1, 0.2, 0.3), Vec3::new(0.4, 0.9, 9.0)), 0.25, "{flip}");
    }
}

/// Light falls as if nothing were hidden: by lamps, by skies and from wall to wall.
#[test]
fn light_does_not_look_past_them() {
    let lit = |hides: bool, integrator| {
        let mut stage = Stage::new()
            .with(plane(), white(), Transform::IDENTITY)
            .with(rectangle(4.0, 4.0), white(), tilted(20.0, 0.0, 1.0, 0.0))
            .with_point_light(30.0, Vec3::new(1.0, 6.0, 0.5))
            .with_sky(0.5);
        stage.last_material().back = if hides { Back::Hidden } else { Back::Dark };
        stage.settings.integrator = integrator;
        let looker = Looker::new(&stage);
        let (from, to) = (Vec3::new(9.0, 3.0, 0.0), Vec3::new(0.4, 0.0, 0.1));
        (0..64).map(|sample| looker.look(from, (to - from).normalize(), sample).radiance).collect::<Vec<_>>()
    };
    for integrator in &SEEN[..5] {
        let shown = lit(false, *integrator);
        assert!(shown.iter().any(|light| light.y > 0.0) || *integrator != IntegratorKind::Path);
        assert_eq!(lit(true, *integrator), shown, "{integrator:?}");
    }
}

/// What a material hides counts where the material is on a part of a group, and where a ray leaves glass in the same place.
#[test]
fn scenes_without_hidden_backs_are_as_before() {
    let stage = sheet();
    let mut shown: Scene = stage.scene.clone();
    shown.materials.iter_mut().for_each(|material| material.back = Back::Alike);
    let shown = Stage { scene: shown, settings: stage.settings.clone() };
    assert_eq!((shown.grey(UP, MIDDLE), shown.grey(DOWN, MIDDLE)), (1.0, 1.0));
}

#[test]
fn dark_backs_light_nothing() {
    // A sheet that faces down, over a white plane or under one.
    for integrator in [IntegratorKind::Path, IntegratorKind::PathSimple, IntegratorKind::VolPath] {
        let settings = RenderSettings { integrator, ..RenderSettings::default() };
        let lit = |y: f32, back: Back| {
            let mut stage = Stage { settings: settings.clone(), ..Stage::new() }
                .with(plane(), white(), tilted(if y > 0.0 { 180.0 } else { 0.0 }, 0.0, y.into(), 0.0))
                .with(rectangle(1.0, 1.0), shining(5.0), tilted(180.0, 0.0, 0.0, 0.0));
            stage.last_material().back = back;
            Estimate::new(&stage, Vec3::new(0.8, 0.9 * y, 0.1), Vec3::new(0.3, y, 0.1), 64)
        };
        assert!(lit(1.0, Back::Alike).mean.x > 0.5, "{integrator:?}");
        assert_eq!(lit(1.0, Back::Dark).mean.x, 0.0, "{integrator:?}");
        lit(-1.0, Back::Dark).assert_same(&lit(-1.0, Back::Alike), &format!("{integrator:?}"));
        // Seen from behind, it is black.
        let seen = |back: Back| {
            let mut stage = Stage { settings: settings.clone(), ..Stage::new() }.with(
                rectangle(1.0, 1.0),
                shining(5.0),
                Transform::IDENTITY,
            );
            stage.last_material().back = back;
            [UP, DOWN].map(|from| stage.grey(from, MIDDLE))
        };
        assert_eq!((seen(Back::Dark), seen(Back::Alike)), ([5.0, 0.0], [5.0, 5.0]), "{integrator:?}");
    }
}
