//! Camera effects side by side: a row of balls through every projection, focus method and a moving camera.
//!
//! `cargo run --release -p heliostat-render --example cameras -- OUTPUT_FOLDER [SAMPLES]` writes one PNG each, with
//! scenes made in code and no file read: the crate as another program would use it.

use glam::{DAffine3, DVec3, Vec3};
use heliostat_geometry::Transform;
use heliostat_geometry::shape::{Plane, Shape, Sphere};
use heliostat_render::render;
use heliostat_scene::camera::{Focus, FocusMethod, Projection};
use heliostat_scene::color::linear_to_srgb;
use heliostat_scene::light::{Falloff, LightKind};
use heliostat_scene::material::{ColorInput, Phong};
use heliostat_scene::object::Geometry;
use heliostat_scene::scene::Background;
use heliostat_scene::texture::{CheckerSpace, Pattern, Texture, UvTransform};
use heliostat_scene::{
    Camera, Frame, Light, Material, MaterialId, Motion, Object, RenderSettings, Scene, TextureId,
};
use std::error::Error;
use std::path::{Path, PathBuf};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = PathBuf::from(arguments.next().ok_or("usage: cameras OUTPUT_FOLDER [SAMPLES]")?);
    let samples = arguments.next().map_or(Ok(16), |n| n.parse())?;
    for camera in cameras() {
        let path = folder.join(format!("{}.png", camera.name));
        let scene = Scene { cameras: vec![camera], ..balls() };
        let settings = RenderSettings { width: 480, height: 270, samples, ..RenderSettings::default() };
        save(&render(&scene, &settings)?, &path)?;
    }
    Ok(())
}

fn cameras() -> Vec<Camera> {
    let eye = DVec3::new(0.0, 1.2, 6.0);
    let still = || Motion::still(DAffine3::from_translation(eye));
    let camera =
        |name: &str, projection, focus| Camera { name: name.into(), motion: still(), projection, focus };
    let plain = Projection::Perspective { fov_y: 0.8 };
    let focus = |method, blades| {
        Some(Focus { distance: 6.0, lens_radius: 0.15, blades, blade_rotation: 0.0, method })
    };
    let pan = [0.0, 0.3].map(|x| DAffine3::from_translation(eye + DVec3::new(x, 0.0, 0.0)));
    vec![
        camera("perspective", plain, None),
        camera("wide", Projection::Perspective { fov_y: 1.6 }, None),
        camera("orthographic", Projection::Orthographic { height: 5.0 }, None),
        camera("fisheye", Projection::Fisheye { fov: 3.1 }, None),
        camera("panorama", Projection::Panorama, None),
        camera("cylindrical", Projection::Cylindrical { fov_x: 3.0, fov_y: 1.2 }, None),
        camera("lens", plain, focus(FocusMethod::Lens, 0)),
        camera("lens_blades", plain, focus(FocusMethod::Lens, 5)),
        camera("post", plain, focus(FocusMethod::Post, 0)),
        camera("post_blades", plain, focus(FocusMethod::Post, 5)),
        Camera { motion: Motion::through(pan.to_vec()).unwrap_or_else(still), ..camera("pan", plain, None) },
    ]
}

/// Balls in a row from near left to far right on a checkered ground, small bright ones behind them.
fn balls() -> Scene {
    let mut scene = Scene {
        background: Background::Gradient {
            top: Vec3::new(0.2, 0.4, 0.8),
            horizon: Vec3::new(0.7, 0.8, 0.9),
            bottom: Vec3::splat(0.3),
        },
        textures: vec![Texture {
            name: "checks".into(),
            pattern: Pattern::Checker {
                even: Vec3::splat(0.8),
                odd: Vec3::splat(0.15),
                space: CheckerSpace::Uv,
            },
            uv: UvTransform::default(),
        }],
        lights: vec![
            light("sky", 1.0, LightKind::Ambient),
            light(
                "key",
                60.0,
                LightKind::Point { position: Vec3::new(-4.0, 6.0, 5.0), falloff: Falloff::InverseSquare },
            ),
        ],
        ..Scene::default()
    };
    let checks = ColorInput { factor: Vec3::ONE, texture: Some(TextureId(0)) };
    add(&mut scene, Shape::Plane(Plane), Vec3::ZERO, Phong { diffuse: checks, ..Phong::default() });
    for i in -4..=4 {
        let hue = Vec3::new(0.5 + 0.1 * i as f32, 0.3, 0.5 - 0.1 * i as f32);
        let phong = Phong {
            diffuse: ColorInput::constant(hue),
            specular: ColorInput::constant(Vec3::splat(0.5)),
            ..Phong::default()
        };
        let place = Vec3::new(1.3 * i as f32, 0.5, -1.1 * i as f32);
        add(&mut scene, Shape::Sphere(Sphere { radius: 0.5 }), place, phong);
        let far = Vec3::new(3.0 * i as f32, 3.0 + (i * i % 3) as f32, -14.0);
        scene.lights.push(bulb(&format!("bulb {i}"), far));
    }
    scene
}

fn light(name: &str, intensity: f32, kind: LightKind) -> Light {
    Light { name: name.into(), intensity: Vec3::splat(intensity), samples: 1, kind }
}

/// A small bright ball, seen and shining.
fn bulb(name: &str, place: Vec3) -> Light {
    let kind = LightKind::Area {
        geometry: Geometry::Shape(Shape::Sphere(Sphere { radius: 0.06 })),
        transform: Transform::translation(place),
        two_sided: false,
        visible: true,
        falloff: Falloff::InverseSquare,
    };
    light(name, 20.0, kind)
}

fn add(scene: &mut Scene, shape: Shape, place: Vec3, phong: Phong) {
    let name = format!("object {}", scene.objects.len());
    scene.objects.push(Object {
        name: name.clone(),
        geometry: Geometry::Shape(shape),
        materials: vec![MaterialId(scene.materials.len() as u32)],
        motion: Motion::still(Transform::translation(place)),
        visible: true,
        casts_shadow: true,
    });
    scene.materials.push(Material::new(name, phong));
}

/// Writes the beauty as it is, in sRGB.
fn save(frame: &Frame, path: &Path) -> Result<(), Box<dyn Error>> {
    let channels =
        ["R", "G", "B"].map(|name| frame.channel(name).map(|c| c.values.as_slice()).unwrap_or_default());
    let byte = |v: f32| (255.0 * linear_to_srgb(v).clamp(0.0, 1.0)).round() as u8;
    let bytes: Vec<u8> =
        (0..frame.pixel_count()).flat_map(|i| channels.map(|channel| byte(channel[i]))).collect();
    image::save_buffer(path, &bytes, frame.width, frame.height, image::ColorType::Rgb8)?;
    Ok(())
}
