//! A model alone as a scene: a camera that fits it and neutral light.
//!
//! What a file does not say is chosen here, from the geometry and the materials alone and in proportion to the size: the
//! same model in millimetres gives the same picture.

mod enclosure;
mod fit;
mod rig;
mod stance;

use crate::error::{LoadError, Warning};
use crate::obj::{ObjModel, ObjOptions, Placement, load_obj, unique};
use crate::texture_cache::TextureCache;
use enclosure::open_side;
use fit::{View, fit};
use glam::{DVec3, Vec3};
use heliostat_geometry::{Aabb, TriMesh};
use heliostat_scene::camera::Projection;
use heliostat_scene::object::Geometry;
use heliostat_scene::{Camera, Material, Motion, Scene};
use stance::stance;
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
    let meshes = scene.meshes.clone();
    let bounds = bounds_of(&scene);
    let inside = open_side(&scene, bounds);
    let view = inside.map_or_else(|| View::onto(&stance(&meshes, bounds)), View::into);
    let points = meshes.iter().flat_map(|mesh| &mesh.positions).map(|p| p.as_dvec3());
    scene.cameras.push(Camera {
        name: FITTED_CAMERA.to_owned(),
        motion: Motion::still(fit(points, &view, f64::from(aspect))),
        projection: Projection::Perspective { fov_y: view.fov_y as f32 },
        focus: None,
    });
    rig::light(&mut scene, bounds, &view, inside.is_some());
    scene
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

fn bounds_of(scene: &Scene) -> Aabb {
    scene.meshes.iter().fold(Aabb::EMPTY, |all, mesh| all.union(mesh.bounds()))
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

/// As [`doubled_areas`] for all objects of the scene, which stand where they were made, beside their materials.
fn shaded_areas(scene: &Scene) -> impl Iterator<Item = (&Material, [Vec3; 3], DVec3)> {
    scene.objects.iter().flat_map(move |object| {
        let mesh = match object.geometry {
            Geometry::Mesh(id) => scene.meshes.get(id.index()),
            Geometry::Shape(_) | Geometry::Group(_) => None,
        };
        mesh.into_iter().flat_map(move |mesh| {
            (0..).zip(doubled_areas(mesh)).map(move |(i, (corners, area))| {
                let material = object.material(mesh.slot(i));
                (&scene.materials[material.index()], corners, area)
            })
        })
    })
}

#[cfg(test)]
mod tests;
