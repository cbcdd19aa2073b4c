//! Shadows against geometry: where they begin, how they fade, what casts them. The report's edge of the umbra and its
//! shadows of touching things are here.

mod common;

use common::{
    Looker, Stage, assert_close, at, ball_mesh, black, cuboid, glass, grey, plane, rectangle, sphere, tilted,
    white,
};
use glam::{Vec2, Vec3};
use heliostat_geometry::Transform;
use heliostat_scene::image::{Encoding, Samples};
use heliostat_scene::light::{Falloff, LightKind};
use heliostat_scene::material::Phong;
use heliostat_scene::texture::{Filtering, Minify, Pattern, UvTransform, Wrap};
use heliostat_scene::{Image, Rgb, Texture, TextureId};
use std::sync::Arc;

/// A lamp at height 4 that shines down without falloff: a square of side 2.
fn lamp(samples: u32) -> (f32, u32, LightKind) {
    let kind = LightKind::Area {
        geometry: rectangle(2.0, 2.0),
        transform: tilted(180.0, 0.0, 4.0, 0.0),
        two_sided: false,
        visible: false,
        falloff: Falloff::InverseSquare,
    };
    (1.0, samples, kind)
}

/// The floor under the lamp, half covered at height 2 by a sheet with its edge at x = 0, z any.
fn half_covered(samples: u32) -> Stage {
    let (intensity, samples, kind) = lamp(samples);
    Stage::new()
        .with(plane(), white(), Transform::IDENTITY)
        .with(rectangle(100.0, 100.0), black(), at(-50.0, 2.0, 0.0))
        .with_light(intensity, samples, kind)
}

#[test]
fn the_hard_shadow_of_a_ball_ends_where_tangents_say() {
    // A point light at height 4 over a ball of radius 1 at height 2: the shadow on the floor is a disk of radius
    // 4 tan(asin(1 / 2)).
    for scale in [1e-3_f32, 1.0, 1e4] {
        let stage = Stage::new()
            .with(plane(), white(), Transform::IDENTITY)
            .with(sphere(scale), black(), at(0.0, 2.0 * scale, 0.0))
            .with_point_light(scale * scale, Vec3::new(0.0, 4.0 * scale, 0.0));
        let radius = 4.0 / 3.0_f32.sqrt();
        let seen = |x: f32| stage.grey(scale * Vec3::new(x, 0.1, 0.0), scale * Vec3::new(x, 0.0, 0.0));
        assert_eq!(seen(radius * 0.9999), 0.0);
        assert!(seen(radius * 1.0001) > 0.0);
    }
}

#[test]
fn umbra_and_penumbra_lie_where_the_edges_of_the_lamp_say() {
    let stage = half_covered(64);
    let open = {
        let (intensity, samples, kind) = lamp(64);
        Stage::new().with(plane(), white(), Transform::IDENTITY).with_light(intensity, samples, kind)
    };
    let seen = |stage: &Stage, x: f32| stage.grey(Vec3::new(x, 1.0, 0.0), Vec3::new(x, 0.0, 0.0));
    // Lines over the edge (0, 2) to the borders of the lamp (-1, 4) and (1, 4) meet the floor at 1 and -1.
    for i in 0..100 {
        let x = -1.98 + 0.04 * i as f32;
        let (covered, whole) = (seen(&stage, x), seen(&open, x));
        if x < -1.0 {
            assert_eq!(covered, 0.0, "umbra at {x}");
        } else if x > 1.0 {
            // Sums of 64 samples, in whatever order.
            assert_close(covered, whole, 64.0 * f32::EPSILON);
        } else if x.abs() < 0.9 {
            assert!(0.0 < covered && covered < whole, "penumbra at {x}: {covered} of {whole}");
        }
    }
}

#[test]
fn there_is_no_jump_at_the_edge_of_the_umbra() {
    // Many samples stand for the integral: over the penumbra light grows in small steps only, from nothing.
    let stage = half_covered(1024);
    let looker = Looker::new(&stage);
    let profile: Vec<f32> = (0..=240)
        .map(|i| looker.look(Vec3::new(-1.2 + 0.01 * i as f32, 1.0, 0.0), Vec3::NEG_Y, 0).radiance.y)
        .collect();
    let whole = profile[240];
    // The light of a strip of a hundredth of the lamp, twice over for the noise of 1024 samples.
    for pair in profile.windows(2) {
        assert!((pair[1] - pair[0]).abs() < 0.02 * whole, "{pair:?}");
    }
    assert_eq!(profile[0], 0.0);
}

#[test]
fn a_ball_on_the_floor_shades_the_floor_beside_it_without_noise() {
    // Lit straight from above, all within the radius is dark, up to the point of contact.
    let kind = LightKind::Directional { direction: Vec3::NEG_Y, angle: 0.0 };
    let stage = Stage::new()
        .with(plane(), white(), Transform::IDENTITY)
        .with(sphere(0.37), white(), at(0.2, 0.37, -0.1))
        .with_light(1.0, 1, kind);
    let looker = Looker::new(&stage);
    for i in 0..400 {
        // From a flat angle, past the underside of the ball.
        let (angle, r) = (0.1 * i as f32, 0.37 * (i as f32 + 0.5) / 400.0);
        let to = Vec3::new(0.2 + r * angle.cos(), 0.0, -0.1 + r * angle.sin());
        let outward = Vec3::new(angle.cos(), 0.0, angle.sin());
        let from = to + outward + Vec3::Y * (0.2 * r);
        let seen = looker.look(from, (to - from).normalize(), 0);
        if seen.first.is_some_and(|first| first.object == Some(0)) {
            assert_eq!(seen.radiance, Rgb::ZERO, "at {to}");
        }
    }
}

#[test]
fn convex_things_never_shade_their_own_lit_side() {
    let light = Vec3::new(3.0, 4.0, 5.0);
    for scale in [1e-3_f32, 1.0, 1e5] {
        for geometry in [sphere(scale), cuboid(2.0 * scale, scale, 1.5 * scale)] {
            let place =
                tilted(27.0, f64::from(30.0 * scale), f64::from(-7.0 * scale), f64::from(11.0 * scale));
            let centre = place.point(Vec3::ZERO);
            let lamp = centre + scale * light;
            let stage = Stage::new().with(geometry.clone(), white(), place).with_light(
                1.0,
                1,
                LightKind::Point { position: lamp, falloff: Falloff::None },
            );
            let looker = Looker::new(&stage);
            for i in 0..2000 {
                let u = Vec2::new((0.618_034 * i as f32).fract(), (i as f32 + 0.5) / 2000.0);
                let eye = centre + 4.0 * scale * heliostat_geometry::warp::square_to_sphere(u);
                let seen = looker.look(eye, (centre - eye).normalize(), 0);
                let first = seen.first.unwrap();
                let cos = first.normal.dot((lamp - first.p).normalize());
                // The answer is the cosine itself, or nothing behind.
                assert!(
                    (seen.radiance.y - cos.max(0.0)).abs() < 1e-5,
                    "{:?}: {} {cos}",
                    geometry,
                    seen.radiance.y
                );
            }
        }
    }
}

#[test]
fn things_without_shadow_and_invisible_things_do_as_told() {
    for (visible, casts_shadow) in [(true, true), (true, false), (false, true), (false, false)] {
        let mut stage = Stage::new()
            .with(plane(), white(), Transform::IDENTITY)
            .with_point_light(1.0, Vec3::new(0.0, 4.0, 0.0));
        let ball = stage.add(
            sphere(0.5),
            Phong { ambient: grey(0.0), emission: grey(0.0), ..white() },
            at(0.0, 2.0, 0.0),
        );
        (ball.visible, ball.casts_shadow) = (visible, casts_shadow);
        let lit = stage.grey(Vec3::new(0.1, 1.0, 0.0), Vec3::new(0.1, 0.0, 0.0)) > 0.0;
        assert_eq!(lit, !casts_shadow);
        let first = stage.look(Vec3::new(0.0, 2.0, 9.0), Vec3::new(0.0, 2.0, 0.0)).first;
        assert_eq!(first.and_then(|first| first.object), visible.then_some(1));
    }
}

#[test]
fn mirrors_and_glass_see_what_the_camera_does_not() {
    let mut stage = Stage::new().with(plane(), common::mirror(), Transform::IDENTITY);
    stage.add(sphere(0.5), Phong { emission: grey(3.0), ..black() }, at(0.0, 2.0, 0.0)).visible = false;
    assert_eq!(stage.grey(Vec3::new(0.0, 2.0, 2.0), Vec3::new(0.0, 0.0, 1.0)), 3.0);
    assert_eq!(stage.grey(Vec3::new(0.0, 2.0, 2.0), Vec3::new(0.0, 2.0, 0.0)), 0.0);
}

/// A texture of two columns: alpha 0 on the left, 1 on the right.
fn half_alpha() -> Texture {
    let samples = Samples::U8(vec![255, 255, 255, 0, 255, 255, 255, 255]);
    let image = Arc::new(Image::new(2, 1, 4, Encoding::Linear, samples));
    let (wrap, filtering) = (Wrap::Clamp, Filtering::Nearest);
    let pattern = Pattern::Image { image, wrap_u: wrap, wrap_v: wrap, filtering, minify: Minify::Mip };
    Texture { name: "half".to_owned(), pattern, uv: UvTransform::default() }
}

#[test]
fn a_plane_far_behind_everything_shades_from_a_wide_sun() {
    let ceiling = |samples| {
        let kind = LightKind::Directional { direction: Vec3::NEG_Y, angle: 0.2 };
        Stage::new().with(sphere(0.5), white(), Transform::IDENTITY).with_light(1.0, samples, kind).with(
            plane(),
            black(),
            at(0.0, 10.0, 0.0),
        )
    };
    for samples in [1, 16] {
        let seen = ceiling(samples).grey(Vec3::new(0.3, 3.0, 0.0), Vec3::new(0.0, 0.5, 0.0));
        assert_eq!(seen, 0.0, "{samples} samples");
    }
}

#[test]
fn cut_outs_let_rays_and_light_pass() {
    let mut stage = Stage::new()
        .with(plane(), Phong { ambient: grey(1.0), ..white() }, Transform::IDENTITY)
        .with(rectangle(2.0, 2.0), Phong { emission: grey(0.0), ..black() }, at(0.0, 2.0, 0.0))
        .with_light(1.0, 1, LightKind::Ambient)
        .with_light(1.0, 1, LightKind::Directional { direction: Vec3::NEG_Y, angle: 0.0 });
    stage.scene.textures.push(half_alpha());
    stage.last_material().opacity.texture = Some(TextureId(0));
    // u grows with x: the left half is open.
    assert_eq!(stage.grey(Vec3::new(-0.5, 1.0, 0.0), Vec3::new(-0.5, 0.0, 0.0)), 2.0);
    assert_eq!(stage.grey(Vec3::new(0.5, 1.0, 0.0), Vec3::new(0.5, 0.0, 0.0)), 1.0);
    assert_eq!(stage.grey(Vec3::new(-0.5, 3.0, 0.0), Vec3::new(-0.5, 0.0, 0.0)), 2.0);
    assert_eq!(stage.grey(Vec3::new(0.5, 3.0, 0.0), Vec3::new(0.5, 0.0, 0.0)), 0.0);
    // The first hit is the first that is not cut away.
    let object = |x| stage.look(Vec3::new(x, 3.0, 0.0), Vec3::new(x, 0.0, 0.0)).first.unwrap().object;
    assert_eq!((object(-0.5), object(0.5)), (Some(0), Some(1)));
}

#[test]
fn layers_of_half_opacity_multiply_and_make_alpha() {
    let layer = Phong { emission: grey(1.0), ..black() };
    let mut stage = Stage::new();
    for y in 0..3 {
        stage = stage.with(rectangle(9.0, 9.0), layer.clone(), at(0.0, y as f32, 0.0)).with_opacity(0.5);
    }
    let eye = Vec3::new(0.0, 9.0, 0.0);
    stage.scene.background = heliostat_scene::scene::Background::Constant(Rgb::splat(8.0));
    let seen = stage.look(eye, Vec3::ZERO);
    assert_eq!((seen.radiance.y, seen.alpha), (0.875 + 0.125 * 8.0, 1.0));
    stage.settings.transparent_background = true;
    let seen = stage.look(eye, Vec3::ZERO);
    assert_eq!((seen.radiance.y, seen.alpha), (0.875, 0.875));
    // Half of the light comes through each.
    stage.scene.materials.iter_mut().for_each(|material| {
        let heliostat_scene::material::Surface::Phong(phong) = &mut material.surface else {
            panic!("not the report\'s surface")
        };
        *phong = black();
    });
    let floor = Stage { scene: stage.scene, settings: stage.settings }
        .with(plane(), white(), at(0.0, -1.0, 0.0))
        .with_light(1.0, 1, LightKind::Directional { direction: Vec3::NEG_Y, angle: 0.0 });
    assert_close(floor.grey(Vec3::new(0.0, -0.5, 0.0), Vec3::NEG_Y), 0.125, f32::EPSILON);
}

#[test]
fn a_transparent_background_stays_empty_behind_glass_but_is_seen_in_mirrors() {
    let mut stage = Stage::new().with(cuboid(1.0, 1.0, 1.0), glass(1.5), Transform::IDENTITY).with_sky(1.0);
    stage.settings.transparent_background = true;
    let seen = stage.look(Vec3::new(0.1, 0.2, 9.0), Vec3::new(0.1, 0.2, 0.0));
    assert_eq!((seen.radiance, seen.alpha), (Rgb::ZERO, 0.0));
    let seen = stage.look(Vec3::new(4.0, 0.2, 9.0), Vec3::new(4.0, 0.2, 0.0));
    assert_eq!((seen.radiance, seen.alpha, seen.first), (Rgb::ZERO, 0.0, None));
    let mut mirrored = Stage::new().with(plane(), common::mirror(), Transform::IDENTITY).with_sky(1.0);
    mirrored.settings.transparent_background = true;
    let seen = mirrored.look(Vec3::Y, Vec3::ZERO);
    assert_eq!((seen.radiance, seen.alpha), (Rgb::ONE, 1.0));
}

#[test]
fn culled_shadow_rays_change_nothing() {
    // Things on both sides of the limits of the index around a lamp; the same picture with every ray traced: a lamp that an
    // object makes endless in the eyes of the culling is one with a single sample per draw.
    for count in [3, 7, 20, 70] {
        let mut stage = Stage::new().with(plane(), white(), Transform::IDENTITY);
        for i in 0..count {
            let (a, b) = (0.618_034 * i as f32, 0.754_877 * i as f32);
            let place = tilted(
                f64::from(100.0 * a),
                f64::from(6.0 * a.fract() - 3.0),
                f64::from(0.5 + 1.5 * (a * b).fract()),
                f64::from(6.0 * b.fract() - 3.0),
            );
            let geometry = match i % 3 {
                0 => sphere(0.2),
                1 => cuboid(0.5, 0.2, 0.3),
                _ => stage.mesh(ball_mesh(0.25, 6, false)),
            };
            stage.add(geometry, white(), place);
        }
        let lamp = |samples| {
            let mut lit = Stage { scene: stage.scene.clone(), settings: stage.settings.clone() };
            let (intensity, _, kind) = lamp(1);
            lit.scene.lights.clear();
            lit = lit.with_light(intensity, samples, kind);
            lit
        };
        let (all, single) = (lamp(16), lamp(1));
        let (all, single) = (Looker::new(&all), Looker::new(&single));
        for i in 0..300 {
            let (x, z) =
                (6.0 * (0.569_84 * i as f32).fract() - 3.0, 6.0 * (0.324_718 * i as f32).fract() - 3.0);
            let eye = Vec3::new(0.0, 3.0, 7.0);
            let dir = (Vec3::new(x, 0.0, z) - eye).normalize();
            // Sample s of 1 in draw d is point s of the same sequence: 16 samples of one are one of 16, in the first draw.
            let mean = (0..16).map(|s| single.look(eye, dir, s).radiance.y).sum::<f32>() / 16.0;
            assert_close(all.look(eye, dir, 0).radiance.y, mean, 1e-5);
        }
    }
}
