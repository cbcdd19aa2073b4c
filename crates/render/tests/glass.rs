//! Mirror and glass against closed forms, and the report's two problems with them: dark patches under a glass that
//! stands on a floor, and bent lines in total internal reflection.

mod common;

use common::{
    Looker, Stage, assert_close, at, ball_mesh, black, box_mesh, cuboid, glass, grey, mirror, plane, sphere,
    tilted, white,
};
use glam::{Vec2, Vec3};
use heliostat_geometry::Transform;
use heliostat_scene::light::LightKind;
use heliostat_scene::material::{ColorInput, FresnelMode, Phong};
use heliostat_scene::object::Geometry;
use heliostat_scene::texture::{CheckerSpace, Pattern, UvTransform};
use heliostat_scene::{Rgb, Texture, TextureId};

/// Rounding of a few dozen `f32` operations.
const ROUNDING: f32 = 64.0 * f32::EPSILON;

/// A floor at height `y` whose radiance is 1 on even and 0 on odd squares of side `side`, everywhere the same light.
fn checkered_floor(stage: &mut Stage, y: f32, side: f32) {
    stage.scene.textures.push(Texture {
        name: "checker".to_owned(),
        pattern: Pattern::Checker { even: Rgb::ONE, odd: Rgb::ZERO, space: CheckerSpace::Uv },
        uv: UvTransform { scale: Vec2::splat(1.0 / side), ..UvTransform::default() },
    });
    let texture = Some(TextureId(stage.scene.textures.len() as u32 - 1));
    let pattern = ColorInput { factor: Rgb::ONE, texture };
    stage.add(plane(), Phong { ambient: pattern, ..black() }, at(0.0, y, 0.0));
}

fn with_ambient(stage: Stage) -> Stage {
    stage.with_light(1.0, 1, LightKind::Ambient)
}

#[test]
fn a_mirror_shows_what_a_twin_behind_it_would_show() {
    // A mirror at x = 0 and a ball at x = 3, against a scene with the mirrored ball at x = -3 and no mirror.
    let ball = Phong {
        ambient: grey(0.2),
        diffuse: grey(0.5),
        specular: grey(0.7),
        shininess: heliostat_scene::material::FloatInput::constant(20.0),
        ..Phong::default()
    };
    let wall = tilted_to_face_x();
    let mirrored = Stage::new()
        .with(plane(), mirror(), wall)
        .with(sphere(1.0), ball.clone(), at(3.0, 0.5, 0.0))
        .with_light(0.5, 1, LightKind::Ambient)
        .with_point_light(20.0, Vec3::new(4.0, 5.0, 2.0));
    let twin = Stage::new()
        .with(sphere(1.0), ball, at(-3.0, 0.5, 0.0))
        .with_light(0.5, 1, LightKind::Ambient)
        .with_point_light(20.0, Vec3::new(-4.0, 5.0, 2.0));
    let (mirrored, twin) = (Looker::new(&mirrored), Looker::new(&twin));
    let eye = Vec3::new(4.0, 1.0, 6.0);
    let mut on_ball = 0;
    for i in 0..400 {
        let to = Vec3::new(-3.0, 0.5 + 0.12 * (i % 20) as f32 - 1.2, 0.12 * (i / 20) as f32 - 1.2);
        let dir = (to - eye).normalize();
        let (a, b) = (mirrored.look(eye, dir, 0).radiance.y, twin.look(eye, dir, 0).radiance.y);
        // Positions agree to rounding; a power of 20 and a silhouette amplify it.
        assert!((a - b).abs() < 1e-4, "towards {to}: {a} {b}");
        on_ball += usize::from(b > 0.0);
    }
    assert!(on_ball > 200);
}

/// From the plane y = 0 to the plane x = 0, facing +x.
fn tilted_to_face_x() -> Transform {
    use glam::{DAffine3, DMat3};
    Transform::new(DAffine3::from_mat3(DMat3::from_rotation_z(-std::f64::consts::FRAC_PI_2))).expect("a turn")
}

#[test]
fn a_slab_of_glass_shifts_a_ray_by_snells_law() {
    // The floor's radiance tells where the ray arrives: count the border that it crosses as it moves.
    for (ior, degrees, thickness) in [(1.5_f32, 30.0_f32, 1.0_f32), (1.33, 70.0, 0.25), (2.4, 5.0, 3.0)] {
        let angle = degrees.to_radians();
        let refracted = (angle.sin() / ior).asin();
        let mut stage = Stage::new();
        stage.add(cuboid(1000.0, thickness, 1000.0), glass(ior), at(0.0, 2.0 + 0.5 * thickness, 0.0));
        checkered_floor(&mut stage, 0.0, 1000.0);
        let stage = with_ambient(stage);
        let looker = Looker::new(&stage);
        let height = 10.0_f32;
        let dir = Vec3::new(angle.sin(), -angle.cos(), 0.0);
        // Without the slab the ray lands at x + height tan; with it, less by thickness (tan a - tan r).
        let way = (height - thickness) * angle.tan() + thickness * refracted.tan();
        let lit = |landing: f32| looker.look(Vec3::new(landing - way, height, -1.0), dir, 0).radiance.y;
        let margin = 1e-4;
        assert_eq!((lit(-margin), lit(margin)), (0.0, 1.0), "ior {ior}, {degrees} degrees");
    }
}

#[test]
fn internal_reflection_is_total_from_the_critical_angle_on() {
    // From inside a block of glass towards its top: above it there is light, in the block's other walls there is none.
    let ior = 1.5_f32;
    let stage = Stage::new().with(cuboid(1000.0, 2.0, 1000.0), glass(ior), at(0.0, -1.0, 0.0)).with_sky(1.0);
    let looker = Looker::new(&stage);
    let critical = (1.0 / ior).asin();
    for (angle, depth) in [(critical - 1e-3, 1), (critical + 1e-3, 20)] {
        let dir = Vec3::new(angle.sin(), angle.cos(), 0.0);
        let (_, rays) = looker.count(Vec3::new(0.0, -1.0, 0.0), dir, 0);
        if depth == 1 {
            assert_eq!((rays.refraction, rays.reflection), (1, 0));
        } else {
            // It stays inside until the depth is used up.
            assert_eq!(rays.refraction, 0);
            assert_eq!(rays.reflection, u64::from(stage.settings.max_depth));
        }
    }
}

#[test]
fn straight_lines_stay_straight_in_total_internal_reflection() {
    // The top of a block of glass, seen from inside beyond the critical angle, shows a shining card in the block as a plain
    // mirror would: exactly where its twin above the block would stand. The report's lines bent here.
    let card = |stage: &mut Stage, y: f32| {
        let shining = Phong { emission: grey(1.0), ..black() };
        stage.add(cuboid(0.01, 0.8, 1.7), shining, at(3.0, y, 0.0));
    };
    let (mut block, mut twin) = (Stage::new(), Stage::new());
    block.add(cuboid(100.0, 4.0, 100.0), glass(1.5), at(0.0, -2.0, 0.0));
    card(&mut block, -1.0);
    card(&mut twin, 1.0);
    let (block, twin) = (Looker::new(&block), Looker::new(&twin));
    let eye = Vec3::new(-3.0, -1.0, 0.1);
    let (mut on, mut off) = (0, 0);
    for i in 0..100 {
        for j in 0..100 {
            // Points around the card; its edges lie between the rows and the columns.
            let to = Vec3::new(2.995, 1.0 + 0.013 * (i as f32 - 50.3), 0.021 * (j as f32 - 50.3));
            let dir = (to - eye).normalize();
            let (seen, expected) = (block.look(eye, dir, 0).radiance.y, twin.look(eye, dir, 0).radiance.y);
            assert_eq!(seen, expected, "towards {to}");
            *(if seen == 1.0 { &mut on } else { &mut off }) += 1;
        }
    }
    assert!(on > 4000 && off > 4000, "{on} {off}");
}

#[test]
fn absorption_follows_the_exponential_law_per_channel() {
    let absorption = Rgb::new(0.1, 0.5, 2.0);
    for thickness in [0.25_f32, 1.0, 3.0] {
        let block = Phong { absorption, ..glass(1.5) };
        let stage = Stage::new().with(cuboid(9.0, thickness, 9.0), block, Transform::IDENTITY).with_sky(1.0);
        let seen = stage.look(Vec3::new(0.3, 10.0, 0.2), Vec3::new(0.3, 0.0, 0.2)).radiance;
        let expected = (-absorption * thickness).exp();
        assert!((seen - expected).abs().max_element() < ROUNDING, "{seen} {expected}");
        // From inside, the way begins at the eye.
        let half = stage.look(Vec3::ZERO, Vec3::NEG_Y).radiance;
        assert!((half - (-0.5 * absorption * thickness).exp()).abs().max_element() < ROUNDING);
    }
}

#[test]
fn things_inside_glass_are_seen_through_its_colour() {
    let absorption = Rgb::new(0.2, 0.4, 0.8);
    let stage = Stage::new().with(sphere(2.0), Phong { absorption, ..glass(1.5) }, Transform::IDENTITY).with(
        sphere(0.5),
        Phong { emission: grey(1.0), ..black() },
        Transform::IDENTITY,
    );
    let seen = stage.look(Vec3::new(0.0, 0.0, 9.0), Vec3::ZERO).radiance;
    assert!((seen - (-absorption * 1.5).exp()).abs().max_element() < ROUNDING, "{seen}");
}

#[test]
fn fresnel_shares_the_light_and_loses_none() {
    // In a uniform sky a clear dielectric neither adds nor takes.
    for ior in [1.1_f32, 1.5, 2.4] {
        let clear = Phong { fresnel: FresnelMode::Dielectric, ..glass(ior) };
        let mut stage = Stage::new().with(sphere(1.0), clear, Transform::IDENTITY).with_sky(1.0);
        stage.settings.max_depth = 64;
        stage.settings.min_weight = 1e-6;
        for offset in [0.0_f32, 0.5, 0.9, 0.99] {
            let seen = stage.grey(Vec3::new(offset, 0.0, 5.0), Vec3::new(offset, 0.0, 0.0));
            assert_close(seen, 1.0, 1e-3);
        }
    }
}

#[test]
fn fresnel_at_normal_incidence_is_the_textbook_share() {
    let clear = Phong { fresnel: FresnelMode::Dielectric, ..glass(1.5) };
    let mut stage = Stage::new().with(cuboid(9.0, 1.0, 9.0), clear, Transform::IDENTITY).with_sky(1.0);
    stage.settings.max_depth = 1;
    // Only the first reflection sees the sky: ((n - 1) / (n + 1))^2.
    let seen = stage.grey(Vec3::new(0.0, 5.0, 0.0), Vec3::ZERO);
    assert_close(seen, 0.04, 8.0 * ROUNDING);
}

/// Radiances over a grid of camera rays at a floor around and under a glass thing.
fn over_floor(stage: &Stage, eye: Vec3) -> Vec<(Vec3, f32)> {
    let looker = Looker::new(stage);
    let mut seen = Vec::new();
    for i in 0..60 {
        for j in 0..60 {
            let to =
                Vec3::new(-0.7 + 1.4 * (i as f32 + 0.37) / 60.0, 0.0, -0.7 + 1.4 * (j as f32 + 0.71) / 60.0);
            seen.push((to, looker.look(eye, (to - eye).normalize(), 0).radiance.y));
        }
    }
    seen
}

/// Clear things that stand on the floor y = 0, as shape and as mesh, turned and shifted.
fn standing() -> Vec<Stage> {
    let mut stages = Vec::new();
    for turn in [0.0_f64, 33.0] {
        let place = |y: f64| {
            use glam::{DAffine3, DMat3, DVec3};
            let turn = DMat3::from_rotation_y(turn.to_radians());
            Transform::new(DAffine3::from_mat3_translation(turn, DVec3::new(0.013, y, -0.021)))
                .expect("a turn")
        };
        stages.push(Stage::new().with(cuboid(1.0, 0.6, 1.0), glass(1.5), place(0.3)));
        let mut with_mesh = Stage::new();
        let mesh = with_mesh.mesh(box_mesh(Vec3::new(-0.5, -0.3, -0.5), Vec3::new(0.5, 0.3, 0.5)));
        stages.push(with_mesh.with(mesh, glass(1.5), place(0.3)));
        stages.push(Stage::new().with(sphere(0.5), glass(1.5), place(0.5)));
        let mut with_ball = Stage::new();
        let mesh: Geometry = with_ball.mesh(ball_mesh(0.5, 48, true));
        stages.push(with_ball.with(mesh, glass(1.5), place(0.5)));
    }
    stages
}

#[test]
fn glass_on_a_floor_has_no_dark_patches() {
    // Floor and sky are equally bright everywhere, and glass takes nothing: every ray must bring exactly that. A ray lost
    // below the floor would bring the black of the underworld.
    for (n, stage) in standing().into_iter().enumerate() {
        for floor_first in [false, true] {
            let mut stage = Stage { scene: stage.scene.clone(), settings: stage.settings.clone() };
            stage.add(plane(), Phong { ambient: grey(1.0), ..black() }, Transform::IDENTITY);
            if floor_first {
                stage.scene.objects.reverse();
            }
            stage.scene.background = heliostat_scene::scene::Background::Gradient {
                top: Rgb::ONE,
                horizon: Rgb::ONE,
                bottom: Rgb::ZERO,
            };
            stage.settings.max_depth = 40;
            let stage = with_ambient(stage);
            for (to, radiance) in over_floor(&stage, Vec3::new(0.9, 2.0, 1.7)) {
                // Rays that never leave by total reflection are cut at the depth and may be dark; at this view none is.
                assert!(
                    (radiance - 1.0).abs() < 1e-3,
                    "stage {n}, floor first {floor_first}, towards {to}: {radiance}"
                );
            }
        }
    }
}

#[test]
fn clear_shadows_on_a_floor_are_smooth() {
    // With transparent shadows and clear glass nothing is darker anywhere, in and around the glass.
    for (n, mut stage) in standing().into_iter().enumerate() {
        stage.add(plane(), white(), Transform::IDENTITY);
        stage.settings.transparent_shadows = true;
        let kind = LightKind::Directional { direction: Vec3::new(0.3, -0.9, 0.1).normalize(), angle: 0.0 };
        let stage = stage.with_light(1.0, 1, kind).with_sky(0.9 / 0.91_f32.sqrt());
        let expected = 0.9 / 0.91_f32.sqrt();
        for (to, radiance) in over_floor(&stage, Vec3::new(0.9, 2.0, 1.7)) {
            assert!((radiance - expected).abs() < 1e-3, "stage {n}, towards {to}: {radiance}");
        }
    }
}

#[test]
fn transparent_shadows_are_coloured_by_surface_and_way() {
    let tint = Rgb::new(1.0, 0.5, 0.25);
    let absorption = Rgb::new(0.0, 0.1, 1.0);
    let pane = Phong { transparency: ColorInput::constant(tint), absorption, ..glass(1.5) };
    let mut stage = Stage::new().with(plane(), white(), Transform::IDENTITY).with(
        cuboid(4.0, 0.5, 4.0),
        pane,
        at(0.0, 2.0, 0.0),
    );
    stage.settings.transparent_shadows = true;
    let stage = stage.with_light(1.0, 1, LightKind::Directional { direction: Vec3::NEG_Y, angle: 0.0 });
    let seen = stage.look(Vec3::new(0.0, 1.0, 0.0), Vec3::ZERO).radiance;
    let expected = tint * tint * (-0.5 * absorption).exp();
    assert!((seen - expected).abs().max_element() < ROUNDING, "{seen} {expected}");
    // A lamp inside the pane: one surface and half of the way.
    let mut inside = stage;
    inside.scene.lights.clear();
    let inside = inside.with_point_light(4.0, Vec3::new(0.0, 2.0, 0.0));
    let seen = inside.look(Vec3::new(0.0, 1.0, 0.0), Vec3::ZERO).radiance;
    let expected = tint * (-0.25 * absorption).exp();
    assert!((seen - expected).abs().max_element() < ROUNDING, "{seen} {expected}");
}

#[test]
fn depth_and_weight_cut_the_recursion() {
    // Two mirrors face each other: the light of the room is a geometric series of the weight.
    let half = Phong { mirror: grey(0.5), emission: grey(1.0), ..black() };
    let mut stage =
        Stage::new().with(plane(), half.clone(), Transform::IDENTITY).with(plane(), half, at(0.0, 2.0, 0.0));
    let look = |stage: &Stage| stage.grey(Vec3::new(0.0, 1.0, 0.0), Vec3::ZERO);
    for depth in [0, 1, 5] {
        stage.settings.max_depth = depth;
        stage.settings.min_weight = 0.0;
        assert_close(look(&stage), 2.0 - 0.5_f32.powi(depth as i32), ROUNDING);
    }
    stage.settings.max_depth = 1000;
    stage.settings.min_weight = 0.1;
    // Weights 1, 1/2, 1/4, 1/8 count; 1/16 is below.
    assert_close(look(&stage), 1.875, ROUNDING);
}

#[test]
fn a_hall_of_mirrors_ends_at_any_depth() {
    let mut stage = Stage::new()
        .with(plane(), mirror(), Transform::IDENTITY)
        .with(plane(), mirror(), at(0.0, 2.0, 0.0))
        .with(plane(), mirror(), tilted(90.0, 0.0, 0.0, -3.0));
    stage.settings.max_depth = 100_000;
    let (_, rays) = Looker::new(&stage).count(Vec3::new(0.0, 1.0, 0.0), Vec3::NEG_Y, 0);
    assert_eq!(rays.reflection, 100_000);
}
