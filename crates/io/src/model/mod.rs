//! A model alone as a scene: a camera that fits it and neutral light.
//!
//! What a file does not say is chosen here, from the geometry and the materials alone and in proportion to the size: the
//! same model in millimetres gives the same picture.

mod enclosure;
mod fit;
mod parts;
mod rig;
mod stance;

use crate::error::{LoadError, Warning};
use crate::obj::{ObjModel, ObjOptions, Placement, load_obj, unique};
use crate::texture_cache::TextureCache;
use enclosure::open_side;
use fit::{View, fit};
use glam::{DVec3, Vec3};
use heliostat_geometry::TriMesh;
use heliostat_scene::camera::Projection;
use heliostat_scene::{Camera, Motion, Scene};
use parts::{bounds_of, each_part};
use stance::{Stance, stance};
use std::path::Path;

/// The name of the camera that sees all of a lone model.
pub const FITTED_CAMERA: &str = "fitted";

/// How a model becomes a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelOptions {
    /// How to read the file.
    pub obj: ObjOptions,
    /// Width over height of the picture that the camera is to fit.
    pub aspect: f32,
}

impl Default for ModelOptions {
    fn default() -> Self {
        Self { obj: ObjOptions::default(), aspect: 16.0 / 9.0 }
    }
}

/// Reads a model and makes a scene of it; objects without a name get that of the file.
///
/// # Errors
/// Those of [`load_obj`].
pub fn scene_from_obj(
    path: &Path,
    options: &ModelOptions,
    textures: &mut TextureCache,
) -> Result<(Scene, Vec<Warning>), LoadError> {
    let mut model = load_obj(path, &options.obj, textures)?;
    let warnings = std::mem::take(&mut model.warnings);
    let name = path.file_stem().map_or_else(|| "model".into(), |stem| stem.to_string_lossy().into_owned());
    Ok((scene_of(&model, &name, options.aspect), warnings))
}

/// The model with a camera and lights; `name` is for objects that have none.
pub fn scene_of(model: &ObjModel, name: &str, aspect: f32) -> Scene {
    let mut scene = Scene::default();
    named(model, name).append_to(&mut scene, &Placement::identity());
    let bounds = bounds_of(&scene);
    let inside = open_side(&scene, bounds);
    let view = inside.map_or_else(|| View::onto(&stance(&scene.meshes, bounds)), View::into);
    let camera = fitted(&scene, &view, aspect);
    scene.cameras.push(camera);
    rig::light(&mut scene, bounds, &view, inside.is_some());
    scene
}

/// A scene of a glTF file with a camera that sees all of it, behind its own ones, and with lights where it has none; and the
/// stops that bring it to a middling brightness.
///
/// glTF says which way is up and which way is front, so nothing is guessed.
pub fn complete_gltf(scene: &mut Scene, aspect: f32) -> f32 {
    let bounds = bounds_of(scene);
    let inside = open_side(scene, bounds);
    let view = inside.map_or_else(|| View::onto(&Stance::of_gltf(bounds)), View::into);
    let mut taken = scene.cameras.iter().map(|camera| camera.name.clone()).collect();
    let camera = fitted(scene, &view, aspect);
    scene.cameras.push(Camera { name: unique(camera.name, &mut taken), ..camera });
    if !scene.lights.is_empty() {
        let stops = rig::exposure_by_lights(&scene.lights, bounds);
        // Lights of usual strength were set up in viewers, which add an environment to them; those of another unit, by
        // whoever lit all of it.
        if stops == 0.0 && inside.is_none() {
            rig::surround(scene, 0.5);
        }
        return stops;
    }
    if inside.is_some() {
        rig::light(scene, bounds, &view, true);
        return rig::exposure(scene, bounds);
    }
    rig::studio(scene, &view);
    0.0
}

/// The camera from which all of a scene is seen.
fn fitted(scene: &Scene, view: &View, aspect: f32) -> Camera {
    let mut points = Vec::new();
    each_part(scene, &mut |part| part.points(&mut |p| points.push(p)));
    if points.is_empty() {
        // Nothing to see: look at where it would be.
        points = vec![DVec3::NEG_ONE, DVec3::ONE];
    }
    Camera {
        name: FITTED_CAMERA.to_owned(),
        motion: Motion::still(fit(points.into_iter(), view, f64::from(aspect))),
        projection: Projection::Perspective { fov_y: view.fov_y as f32 },
        focus: None,
    }
}

/// Stops that bring a scene of [`scene_of`] to a middling brightness: 0 where the light was chosen here, else by the strength
/// of the model's own emitters, which are given in any unit.
pub fn exposure_of(scene: &Scene) -> f32 {
    rig::exposure(scene, bounds_of(scene))
}

/// Whether any material refracts: then light passes through it to what lies behind.
pub fn has_glass(scene: &Scene) -> bool {
    scene.materials.iter().any(|material| material.surface.refracts())
}

/// The model with `name` for the object that has none.
fn named(model: &ObjModel, name: &str) -> ObjModel {
    let mut model = model.clone();
    let mut taken = model.objects.iter().map(|object| object.name.clone()).collect();
    for object in model.objects.iter_mut().filter(|object| object.name.is_empty()) {
        object.name = unique(name.to_owned(), &mut taken);
    }
    model
}

/// Corners of each triangle, and twice its area times its normal.
fn doubled_areas(mesh: &TriMesh) -> impl Iterator<Item = ([Vec3; 3], DVec3)> {
    (0..mesh.triangles.len() as u32).map(|i| {
        let corners = mesh.corners(i);
        let [a, b, c] = corners.map(|p| p.as_dvec3());
        (corners, (b - a).cross(c - a))
    })
}

#[cfg(test)]
mod tests;
