//! The checks of each kind of item.

use super::collect::Collector;
use super::issue::{ItemKind, Problem};
use crate::camera::{Camera, Projection};
use crate::image::{Image, Samples};
use crate::light::LightKind;
use crate::object::{Geometry, Object};
use crate::scene::{Background, Scene};
use crate::texture::Pattern;
use glam::Vec3;
use heliostat_geometry::Shape;
use std::f32::consts::{PI, TAU};

pub(super) fn meshes(scene: &Scene, c: &mut Collector<'_>) {
    for (i, mesh) in scene.meshes.iter().enumerate() {
        c.turn_to(ItemKind::Mesh, i, "");
        if let Err(error) = mesh.validate() {
            c.add(Problem::Mesh(error));
        }
    }
}

pub(super) fn textures<'a>(scene: &'a Scene, c: &mut Collector<'a>) {
    for (i, texture) in scene.textures.iter().enumerate() {
        c.turn_to(ItemKind::Texture, i, &texture.name);
        let uv = &texture.uv;
        c.finite(
            "the change of uv",
            uv.scale.is_finite() && uv.offset.is_finite() && uv.rotation.is_finite(),
        );
        match &texture.pattern {
            Pattern::Image { image, .. } => check_image(image, c),
            Pattern::Tiles { tiles, .. } => tiles.iter().for_each(|tile| check_image(&tile.image, c)),
            Pattern::Checker { even, odd, .. } => {
                c.color("the even colour", *even);
                c.color("the odd colour", *odd);
            }
            Pattern::Missing => {}
        }
    }
}

fn check_image(image: &Image, c: &mut Collector<'_>) {
    let count = match &image.samples {
        Samples::U8(samples) => samples.len(),
        Samples::U16(samples) => samples.len(),
        Samples::F16(samples) => samples.len(),
        Samples::F32(samples) => samples.len(),
    };
    let expected = (image.width as usize)
        .checked_mul(image.height as usize)
        .and_then(|pixels| pixels.checked_mul(usize::from(image.channels)));
    if count == 0 || expected != Some(count) || image.channels > 4 {
        c.add(Problem::ImageSize);
    }
}

pub(super) fn objects<'a>(scene: &'a Scene, c: &mut Collector<'a>) {
    for (i, object) in scene.objects.iter().enumerate() {
        c.turn_to_named(ItemKind::Object, i, &object.name);
        check_object(object, c);
    }
}

pub(super) fn check_object(object: &Object, c: &mut Collector<'_>) {
    check_geometry(&object.geometry, c);
    match (&object.geometry, object.materials.is_empty()) {
        (Geometry::Group(_), false) => c.add(Problem::GroupMaterial),
        (Geometry::Shape(_) | Geometry::Mesh(_), true) => c.add(Problem::NoMaterial),
        _ => {}
    }
    object.materials.iter().for_each(|&id| c.material(id));
    let poses = object.motion.poses();
    c.finite("the transform", poses.iter().all(|pose| pose.matrix().is_finite()));
}

fn check_geometry(geometry: &Geometry, c: &mut Collector<'_>) {
    match geometry {
        Geometry::Mesh(id) => c.mesh(*id),
        Geometry::Group(id) => c.group(*id),
        Geometry::Shape(shape) => check_shape(shape, c),
    }
}

fn check_shape(shape: &Shape, c: &mut Collector<'_>) {
    match shape {
        Shape::Sphere(s) => c.positive("radius", s.radius),
        Shape::Cuboid(s) => s.size.to_array().into_iter().for_each(|side| c.positive("size", side)),
        Shape::Plane(_) => {}
        Shape::Rectangle(s) => s.size.to_array().into_iter().for_each(|side| c.positive("size", side)),
        Shape::Disk(s) => {
            c.positive("radius", s.radius);
            let radius = s.radius;
            c.number("inner_radius", s.inner_radius, "from 0 to below the radius", |v| {
                v >= 0.0 && v < radius
            });
        }
        Shape::Cylinder(s) => {
            c.positive("radius", s.radius);
            c.positive("height", s.height);
        }
        Shape::Cone(s) => {
            c.not_negative("radius", s.radius);
            c.not_negative("top_radius", s.top_radius);
            c.positive("the larger radius", s.radius.max(s.top_radius));
            c.positive("height", s.height);
        }
        Shape::Torus(s) => {
            c.not_negative("major", s.major);
            c.positive("minor", s.minor);
        }
        Shape::Triangle(s) => {
            c.finite("a corner", s.a.is_finite() && s.b.is_finite() && s.c.is_finite());
            let [a, b, d] = [s.a, s.b, s.c].map(|corner| corner.as_dvec3());
            if (b - a).cross(d - a) == glam::DVec3::ZERO {
                c.add(Problem::NoArea);
            }
        }
    }
}

pub(super) fn lights<'a>(scene: &'a Scene, c: &mut Collector<'a>) {
    for (i, light) in scene.lights.iter().enumerate() {
        c.turn_to_named(ItemKind::Light, i, &light.name);
        c.color("intensity", light.intensity);
        c.number("samples", light.samples as f32, "at least 1", |v| v >= 1.0);
        check_light(scene, &light.kind, c);
    }
}

fn check_light(scene: &Scene, kind: &LightKind, c: &mut Collector<'_>) {
    match kind {
        LightKind::Ambient => {}
        LightKind::Point { position, .. } => c.finite("position", position.is_finite()),
        LightKind::Directional { direction, angle } => {
            check_direction(*direction, c);
            c.number("angle", *angle, "from 0 to pi", |v| (0.0..=PI).contains(&v));
        }
        LightKind::Spot { position, direction, inner, outer, .. } => {
            c.finite("position", position.is_finite());
            check_direction(*direction, c);
            c.number("outer", *outer, "from 0 to pi", |v| (0.0..=PI).contains(&v));
            c.number("inner", *inner, "from 0 to outer", |v| v >= 0.0 && v <= *outer);
        }
        LightKind::Measured { position, axis, across, .. } => {
            c.finite("position", position.is_finite());
            check_direction(*axis, c);
            check_direction(axis.cross(*across), c);
        }
        LightKind::Area { geometry, transform, .. } => {
            check_geometry(geometry, c);
            c.finite("the transform", transform.matrix().is_finite());
            match geometry {
                Geometry::Shape(Shape::Plane(_)) => c.add(Problem::InfiniteArea),
                Geometry::Mesh(id) if is_empty_mesh(scene, id.index()) => c.add(Problem::NoArea),
                Geometry::Group(_) => c.add(Problem::GroupLight),
                _ => {}
            }
        }
    }
}

fn is_empty_mesh(scene: &Scene, index: usize) -> bool {
    scene.meshes.get(index).is_some_and(|mesh| mesh.triangles.is_empty())
}

fn check_direction(direction: Vec3, c: &mut Collector<'_>) {
    c.positive("the length of the direction", direction.length());
}

pub(super) fn cameras<'a>(scene: &'a Scene, c: &mut Collector<'a>) {
    for (i, camera) in scene.cameras.iter().enumerate() {
        c.turn_to_named(ItemKind::Camera, i, &camera.name);
        for pose in camera.motion.poses() {
            c.finite("the pose", pose.is_finite());
            c.number("the determinant of the pose", pose.matrix3.determinant() as f32, "above 0", |v| {
                v > 0.0
            });
        }
        check_projection(camera, c);
        if let Some(focus) = &camera.focus {
            c.positive("the focus distance", focus.distance);
            c.not_negative("the lens radius", focus.lens_radius);
            c.number("blades", focus.blades as f32, "0 or at least 3", |v| v == 0.0 || v >= 3.0);
            c.finite("the blade rotation", focus.blade_rotation.is_finite());
        }
    }
    if scene.cameras.is_empty() {
        c.turn_to(ItemKind::Scene, 0, "");
        c.add(Problem::NoCamera);
    }
}

fn check_projection(camera: &Camera, c: &mut Collector<'_>) {
    let below_half = |v: f32| v > 0.0 && v < PI;
    match camera.projection {
        Projection::Perspective { fov_y } => c.number("fov_y", fov_y, "between 0 and pi", below_half),
        Projection::Orthographic { height } => c.positive("height", height),
        Projection::Fisheye { fov } => c.number("fov", fov, "above 0, up to 2 pi", |v| v > 0.0 && v <= TAU),
        Projection::Panorama => {}
        Projection::Cylindrical { fov_x, fov_y } => {
            c.number("fov_x", fov_x, "above 0, up to 2 pi", |v| v > 0.0 && v <= TAU);
            c.number("fov_y", fov_y, "between 0 and pi", below_half);
        }
    }
}

pub(super) fn background<'a>(scene: &'a Scene, c: &mut Collector<'a>) {
    c.turn_to(ItemKind::Scene, 0, "");
    match &scene.background {
        Background::Constant(color) => c.color("the background", *color),
        Background::Gradient { top, horizon, bottom } => {
            for color in [top, horizon, bottom] {
                c.color("the background", *color);
            }
        }
        Background::Image { image, intensity, rotation } => {
            check_image(image, c);
            c.color("the intensity of the background", *intensity);
            c.finite("the rotation of the background", rotation.is_finite());
        }
        Background::Daylight(day) => {
            check_direction(day.to_sun, c);
            c.number("turbidity", day.turbidity, "from 1 to 32", |v| (1.0..=32.0).contains(&v));
            c.color("the albedo of the ground", day.ground_albedo);
            c.color("the intensity of the background", day.intensity);
            c.not_negative("the factor of the sun", day.sun);
        }
    }
}
