//! Surfaces: Phong's terms, normals on both sides, sums beyond 1, smooth meshes, relief and textures.

mod common;

use common::{
    Looker, Stage, assert_close, at, ball_mesh, black, cuboid, grey, plane, rectangle, sphere, tilted, white,
};
use glam::{Vec2, Vec3};
use heliostat_geometry::shape::{Cylinder, Torus};
use heliostat_geometry::{Shape, Transform};
use heliostat_scene::image::{Encoding, Samples};
use heliostat_scene::light::{Falloff, LightKind};
use heliostat_scene::material::{ColorInput, FloatInput, Phong, Relief};
use heliostat_scene::object::Geometry;
use heliostat_scene::texture::{CheckerSpace, Filtering, Minify, Pattern, UvTransform, Wrap};
use heliostat_scene::{Image, Rgb, Texture, TextureId};
use std::f32::consts::FRAC_PI_2;
use std::sync::Arc;

const ROUNDING: f32 = 64.0 * f32::EPSILON;

fn point_light(position: Vec3) -> LightKind {
    LightKind::Point { position, falloff: Falloff::None }
}

#[test]
fn the_terms_of_phong_add_up_as_the_formula_says() {
    let surface = Phong {
        ambient: grey(0.1),
        diffuse: grey(0.6),
        specular: grey(0.8),
        shininess: FloatInput::constant(5.0),
        emission: grey(0.05),
        ..Phong::default()
    };
    let light = Vec3::new(3.0, 4.0, 0.0);
    let stage = Stage::new()
        .with(rectangle(0.1, 0.1), surface, Transform::IDENTITY)
        .with_light(2.0, 1, LightKind::Ambient)
        .with_light(1.5, 1, point_light(light));
    for eye in [Vec3::new(-3.0, 4.0, 0.0), Vec3::new(0.0, 1.0, 0.0), Vec3::new(-4.0, 3.0, 1.0)] {
        let (n, l, v) = (Vec3::Y, light.normalize(), eye.normalize());
        let r_dot_v = (2.0 * n.dot(l) * n - l).dot(v).max(0.0);
        let expected = 0.05 + 0.1 * 2.0 + 1.5 * (0.6 * n.dot(l) + 0.8 * r_dot_v.powi(5));
        assert_close(stage.grey(eye, Vec3::ZERO), expected, ROUNDING);
    }
}

#[test]
fn several_lights_go_beyond_one() {
    let mut stage = Stage::new().with(plane(), white(), Transform::IDENTITY);
    for i in 0..5 {
        stage = stage.with_light(1.0, 1, point_light(Vec3::new(0.0, 2.0 + i as f32, 0.0)));
    }
    assert_close(stage.grey(Vec3::new(1.0, 1.0, 0.0), Vec3::ZERO), 5.0, ROUNDING);
}

#[test]
fn both_sides_of_a_sheet_are_lit_from_their_own_side() {
    // The sign of the normal: whichever way a flat thing faces, the side towards lamp and eye is lit.
    for turn in [0.0, 180.0] {
        for (eye, lamp, lit) in [(1.0, 1.0, true), (-1.0, -1.0, true), (1.0, -1.0, false), (-1.0, 1.0, false)]
        {
            let stage = Stage::new()
                .with(rectangle(2.0, 2.0), white(), tilted(turn, 0.0, 0.0, 0.0))
                .with_light(1.0, 1, point_light(Vec3::Y * lamp));
            let seen = stage.look(Vec3::new(0.3, eye, 0.0), Vec3::ZERO);
            assert_close(seen.radiance.y, if lit { 1.0 } else { 0.0 }, ROUNDING);
            assert_eq!(seen.first.unwrap().normal.y.signum(), eye);
        }
    }
}

#[test]
fn mirrored_things_keep_their_outside() {
    let mirrored = Transform::scaling(Vec3::new(-1.0, 1.0, 2.0)).unwrap();
    let shapes =
        [sphere(1.0), cuboid(1.0, 2.0, 1.0), Geometry::Shape(Shape::Torus(Torus { major: 1.0, minor: 0.3 }))];
    for geometry in shapes {
        let stage = Stage::new().with(geometry, white(), mirrored);
        let looker = Looker::new(&stage);
        for i in 0..200 {
            let from = 9.0
                * heliostat_geometry::warp::square_to_sphere(Vec2::new(
                    0.618_034 * i as f32 % 1.0,
                    (i as f32 + 0.5) / 200.0,
                ));
            let to = Vec3::new(0.9, 0.1, 0.2);
            if let Some(hit) = looker.world.closest_hit(&heliostat_geometry::Ray::new(from, to - from), 0.0) {
                assert!(hit.hit.at.ng.dot(to - from) < 0.0, "seen from outside");
            }
        }
    }
}

#[test]
fn the_inside_of_a_tube_is_lit_from_inside() {
    let tube = Geometry::Shape(Shape::Cylinder(Cylinder { radius: 1.0, height: 4.0, capped: false }));
    let stage = Stage::new().with(tube, white(), Transform::IDENTITY).with_light(
        1.0,
        1,
        point_light(Vec3::new(0.0, 2.0, 0.0)),
    );
    assert_close(stage.grey(Vec3::new(0.0, 2.0, 0.0), Vec3::new(1.0, 2.0, 0.0)), 1.0, ROUNDING);
    assert_eq!(stage.grey(Vec3::new(5.0, 2.0, 0.0), Vec3::new(0.0, 2.0, 0.0)), 0.0);
}

#[test]
fn smooth_meshes_show_no_facets_at_the_border_of_light() {
    // A coarse ball with smooth normals against the sphere that it stands for. Without help the facets around the border of
    // light cast shadows of whole triangles: jumps of up to the sine of a facet's angle.
    let lamp = LightKind::Directional { direction: Vec3::NEG_X, angle: 0.0 };
    let mut stage = Stage::new();
    let mesh = stage.mesh(ball_mesh(1.0, 12, true));
    let stage = stage.with(mesh, white(), Transform::IDENTITY).with_light(1.0, 1, lamp);
    let looker = Looker::new(&stage);
    let mut steps = Vec::new();
    let mut last: Option<f32> = None;
    for i in 0..=2000 {
        // Around the equator, from the lit to the dark side.
        let angle = 0.003 + FRAC_PI_2 * 2.0 * i as f32 / 2000.0;
        let eye = 5.0 * Vec3::new(angle.cos(), 0.04, angle.sin());
        let seen = looker.look(eye, -eye.normalize(), 0);
        let first = seen.first.unwrap();
        // The light is that of the smooth normal, with nothing missing and nothing from behind.
        let expected = first.normal.x.max(0.0);
        assert!(
            (seen.radiance.y - expected).abs() < 1e-4,
            "at {angle}: {} instead of {expected}",
            seen.radiance.y
        );
        if let Some(last) = last {
            steps.push((seen.radiance.y - last).abs());
        }
        last = Some(seen.radiance.y);
    }
    assert!(steps.iter().all(|&step| step < 0.01), "{:?}", steps.iter().copied().fold(0.0, f32::max));
}

#[test]
fn the_inside_of_a_smooth_bowl_shows_no_facets_either() {
    // From inside the smooth surface lies below the facets: light fades instead of being lifted over them. The facets are
    // inclined by 7.5 degrees: hard borders would be steps of up to 0.13.
    let mut stage = Stage::new();
    let mesh = stage.mesh(ball_mesh(1.0, 24, true));
    let lamp = Vec3::new(0.9, 0.02, 0.0);
    let stage = stage.with(mesh, white(), Transform::IDENTITY).with_light(1.0, 1, point_light(lamp));
    let looker = Looker::new(&stage);
    let profile: Vec<f32> = (0..=4000)
        .map(|i| {
            let angle = 0.003 + FRAC_PI_2 * i as f32 / 4000.0;
            looker.look(Vec3::Y * 0.02, Vec3::new(angle.cos(), 0.013, angle.sin()).normalize(), 0).radiance.y
        })
        .collect();
    let step = profile.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f32::max);
    assert!(step < 0.04, "{step}");
}

#[test]
fn faceted_meshes_keep_their_facets() {
    let lamp = LightKind::Directional { direction: Vec3::NEG_X, angle: 0.0 };
    let mut stage = Stage::new();
    let mesh = stage.mesh(ball_mesh(1.0, 12, false));
    let stage = stage.with(mesh, white(), Transform::IDENTITY).with_light(1.0, 1, lamp);
    let looker = Looker::new(&stage);
    for i in 0..500 {
        let u = Vec2::new((0.618_034 * i as f32).fract(), (i as f32 + 0.5) / 500.0);
        let eye = 5.0 * heliostat_geometry::warp::square_to_sphere(u);
        let dir = -eye.normalize();
        let hit = looker.world.closest_hit(&heliostat_geometry::Ray::new(eye, dir), 0.0).unwrap();
        assert_close(looker.look(eye, dir, 0).radiance.y, hit.hit.at.ng.x.max(0.0), 1e-4);
    }
}

/// A stage with a rectangle of 1 by 1 in the plane y = 0 whose ambient answer is a texture under ambient light 1: what is
/// seen at uv (0.5 + x, 0.5 - z) is the texture itself.
fn textured(texture: Texture) -> Stage {
    let mut stage = Stage::new().with_light(1.0, 1, LightKind::Ambient);
    stage.scene.textures.push(texture);
    let ambient = ColorInput { factor: Rgb::ONE, texture: Some(TextureId(0)) };
    stage.with(rectangle(1.0, 1.0), Phong { ambient, ..black() }, Transform::IDENTITY)
}

fn at_uv(stage: &Stage, u: f32, v: f32) -> Rgb {
    let to = Vec3::new(u - 0.5, 0.0, 0.5 - v);
    stage.look(to + Vec3::Y, to).radiance
}

/// A grey image of 4 columns and 2 rows with value column + 10 row, the row counted from the top.
fn ramp(wrap: Wrap, filtering: Filtering, uv: UvTransform) -> Texture {
    let samples = Samples::F32((0..8).map(|i| (i % 4 + 10 * (i / 4)) as f32).collect());
    let image = Arc::new(Image::new(4, 2, 1, Encoding::Linear, samples));
    let pattern = Pattern::Image { image, wrap_u: wrap, wrap_v: wrap, filtering, minify: Minify::Mip };
    Texture { name: "ramp".to_owned(), pattern, uv }
}

#[test]
fn images_lie_with_their_lower_edge_at_v_0() {
    let stage = textured(ramp(Wrap::Repeat, Filtering::Nearest, UvTransform::default()));
    for (u, v, planted) in
        [(0.125, 0.75, 0.0), (0.375, 0.75, 1.0), (0.875, 0.75, 3.0), (0.125, 0.25, 10.0), (0.625, 0.25, 12.0)]
    {
        assert_eq!(at_uv(&stage, u, v).x, planted, "at {u} {v}");
    }
}

#[test]
fn bilinear_values_lie_on_the_ramp_between_centres() {
    let stage = textured(ramp(Wrap::Clamp, Filtering::Bilinear, UvTransform::default()));
    for (u, v) in [(0.3_f32, 0.5_f32), (0.5, 0.6), (0.7, 0.3)] {
        // Between centres: column 4u - 1/2, row 2(1 - v) - 1/2.
        let expected = (4.0 * u - 0.5) + 10.0 * (2.0 * (1.0 - v) - 0.5);
        assert_close(at_uv(&stage, u, v).x, expected, 4.0 * ROUNDING);
    }
    // Beyond the last centre a held image stays.
    assert_eq!(at_uv(&stage, 0.01, 0.99).x, 0.0);
    assert_eq!(at_uv(&stage, 0.99, 0.01).x, 13.0);
}

#[test]
fn wrapping_repeats_mirrors_and_holds() {
    let uv =
        UvTransform { scale: Vec2::new(3.0, 1.0), offset: Vec2::new(-1.0, 0.0), ..UvTransform::default() };
    // u from 0 to 1 on the card runs from -1 to 2 in the texture.
    let cases = [
        (Wrap::Repeat, [0.0, 3.0, 0.0, 3.0, 0.0, 3.0]),
        (Wrap::Mirror, [3.0, 0.0, 0.0, 3.0, 3.0, 0.0]),
        (Wrap::Clamp, [0.0, 0.0, 0.0, 3.0, 3.0, 3.0]),
    ];
    for (wrap, planted) in cases {
        let stage = textured(ramp(wrap, Filtering::Nearest, uv));
        for (i, planted) in planted.into_iter().enumerate() {
            // Near the begin and the end of each repetition.
            let texture_u = -1.0 + (i / 2) as f32 + if i % 2 == 0 { 0.1 } else { 0.9 };
            assert_eq!(at_uv(&stage, (texture_u + 1.0) / 3.0, 0.75).x, planted, "{wrap:?} at {texture_u}");
        }
    }
}

#[test]
fn bilinear_repetition_blends_over_the_seam() {
    let stage = textured(ramp(Wrap::Repeat, Filtering::Bilinear, UvTransform::default()));
    // On the seam between the last column and the first the value is their mean.
    assert_close(at_uv(&stage, 1e-7, 0.75).x, 1.5, 1e-4);
    let stage = textured(ramp(Wrap::Mirror, Filtering::Bilinear, UvTransform::default()));
    assert_close(at_uv(&stage, 1e-7, 0.25).x, 10.0, 1e-4);
}

#[test]
fn checkers_alternate_in_uv_and_in_space() {
    let checker = |space, scale| Texture {
        name: "checker".to_owned(),
        pattern: Pattern::Checker { even: Rgb::X, odd: Rgb::Y, space },
        uv: UvTransform { scale: Vec2::splat(scale), ..UvTransform::default() },
    };
    let stage = textured(checker(CheckerSpace::Uv, 4.0));
    for (u, v, planted) in [(0.1, 0.1, Rgb::X), (0.3, 0.1, Rgb::Y), (0.3, 0.3, Rgb::X), (0.9, 0.1, Rgb::Y)] {
        assert_eq!(at_uv(&stage, u, v), planted);
    }
    // The sides of a cube of side 2 lie on borders of the pattern: each is one clean chess board all the same.
    let mut stage = Stage::new().with_light(1.0, 1, LightKind::Ambient);
    stage.scene.textures.push(checker(CheckerSpace::Local, 1.0));
    let ambient = ColorInput { factor: Rgb::ONE, texture: Some(TextureId(0)) };
    let stage = stage.with(cuboid(2.0, 2.0, 2.0), Phong { ambient, ..black() }, tilted(33.0, 5.0, -3.0, 0.7));
    let looker = Looker::new(&stage);
    let place = stage.scene.objects[0].motion.first();
    for i in 0..100 {
        let local = Vec3::new(0.02 * i as f32 - 0.99, 0.31, 1.0);
        let (eye, to) = (place.point(local + Vec3::Z), place.point(local));
        let even = (local.x.floor() + 0.0 + 1.0).rem_euclid(2.0) == 0.0;
        let planted = if even { Rgb::X } else { Rgb::Y };
        assert_eq!(looker.look(eye, (to - eye).normalize(), 0).radiance, planted, "at {local}");
    }
}

#[test]
fn missing_textures_are_magenta_and_vertex_colours_tint() {
    let missing =
        Texture { name: "lost.png".to_owned(), pattern: Pattern::Missing, uv: UvTransform::default() };
    assert_eq!(at_uv(&textured(missing), 0.5, 0.5), Rgb::new(1.0, 0.0, 1.0));

    let mut stage = Stage::new().with_light(1.0, 1, LightKind::Ambient);
    let mut mesh = common::box_mesh(Vec3::NEG_ONE, Vec3::ONE);
    mesh.colors = mesh.positions.iter().map(|p| 0.5 * (*p + Vec3::ONE)).collect();
    let mesh = stage.mesh(mesh);
    let stage = stage.with(mesh, Phong { ambient: grey(2.0), ..black() }, Transform::IDENTITY);
    let seen = stage.look(Vec3::new(0.5, 9.0, -0.5), Vec3::new(0.5, 0.0, -0.5)).radiance;
    assert!((seen - 2.0 * Vec3::new(0.75, 1.0, 0.25)).abs().max_element() < ROUNDING, "{seen}");
}

#[test]
fn a_ramp_as_bump_tilts_the_normal_by_its_slope() {
    // Height grows linearly by 3 over the four centres of the image, which are 3/4 of the card apart: slope 4 strength.
    let strength = 0.05;
    let mut stage = textured(ramp(Wrap::Clamp, Filtering::Bilinear, UvTransform::default()));
    stage.last_material().relief = Some(Relief::Bump { texture: TextureId(0), strength });
    let to = Vec3::new(0.0, 0.0, 0.0);
    let normal = stage.look(to + Vec3::Y, to).first.unwrap().normal;
    // The rows differ by 10 over half of the card, downward in v, which is towards +z.
    let expected = Vec3::new(-4.0 * strength, 1.0, -20.0 * strength).normalize();
    assert!((normal - expected).abs().max_element() < 1e-4, "{normal} {expected}");
}

#[test]
fn a_normal_map_tilts_along_the_tangents() {
    let samples = Samples::F32(vec![0.5 + 0.3, 0.5 - 0.2, 0.5 + 0.4]);
    let image = Arc::new(Image::new(1, 1, 3, Encoding::Linear, samples));
    let (wrap, filtering) = (Wrap::Repeat, Filtering::Nearest);
    let pattern = Pattern::Image { image, wrap_u: wrap, wrap_v: wrap, filtering, minify: Minify::Mip };
    let mut stage = textured(Texture { name: "n".to_owned(), pattern, uv: UvTransform::default() });
    stage.last_material().relief = Some(Relief::Normal { texture: TextureId(0), strength: 1.0 });
    let normal = stage.look(Vec3::Y, Vec3::ZERO).first.unwrap().normal;
    // u is +x, v is -z, outward is +y.
    let expected = Vec3::new(0.6, 0.8, 0.4).normalize();
    assert!((normal - expected).abs().max_element() < ROUNDING, "{normal}");
    // Seen from below, the same relief is seen from its other side.
    let normal = stage.look(Vec3::NEG_Y, Vec3::ZERO).first.unwrap().normal;
    assert!((normal + expected).abs().max_element() < ROUNDING, "{normal}");
}

#[test]
fn relief_never_turns_its_back_on_the_viewer() {
    // A rough floor, lit from straight above and seen at all angles down to grazing: no point may be black.
    let noise: Vec<u8> = (0..64 * 64_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    let image = Arc::new(Image::new(64, 64, 1, Encoding::Linear, Samples::U8(noise)));
    let pattern = Pattern::Image {
        image,
        wrap_u: Wrap::Repeat,
        wrap_v: Wrap::Repeat,
        filtering: Filtering::Bilinear,
        minify: Minify::Mip,
    };
    let mut stage = Stage::new();
    stage.scene.textures.push(Texture { name: "rough".to_owned(), pattern, uv: UvTransform::default() });
    let mut stage = stage.with(plane(), white(), Transform::IDENTITY).with_light(
        1.0,
        1,
        LightKind::Directional { direction: Vec3::NEG_Y, angle: 0.0 },
    );
    stage.last_material().relief = Some(Relief::Bump { texture: TextureId(0), strength: 0.02 });
    let looker = Looker::new(&stage);
    for height in [1.0_f32, 0.1, 0.01] {
        for i in 0..500 {
            let to = Vec3::new(0.013 * i as f32, 0.0, 0.007 * i as f32);
            let eye = to + Vec3::new(1.0, height, 0.3);
            let seen = looker.look(eye, (to - eye).normalize(), 0);
            let normal = seen.first.unwrap().normal;
            assert!(normal.dot(eye - to) >= -1e-5, "{normal}");
            assert_close(seen.radiance.y, normal.y, 1e-4);
            assert!(seen.radiance.y > 0.0);
        }
    }
}

#[test]
fn a_bumpy_mirror_reflects_upward() {
    // Whatever the relief, a mirror on the floor of a bright sky over a dark ground shows the sky.
    let mut stage = textured(ramp(
        Wrap::Repeat,
        Filtering::Bilinear,
        UvTransform { scale: Vec2::splat(9.0), ..UvTransform::default() },
    ));
    stage.add(plane(), common::mirror(), at(0.0, -1.0, 0.0));
    stage.last_material().relief = Some(Relief::Bump { texture: TextureId(0), strength: 0.1 });
    stage.scene.background =
        heliostat_scene::scene::Background::Gradient { top: Rgb::ONE, horizon: Rgb::ONE, bottom: Rgb::ZERO };
    let looker = Looker::new(&stage);
    for i in 0..500 {
        let to = Vec3::new(5.0 + 0.0137 * i as f32, -1.0, 0.0071 * i as f32);
        let eye = to + Vec3::new(1.0, 0.05 + 0.002 * i as f32, 0.3);
        assert_eq!(looker.look(eye, (to - eye).normalize(), 0).radiance.y, 1.0, "towards {to}");
    }
}
