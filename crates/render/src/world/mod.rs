//! A scene made ready for rays: indices over objects and meshes, and the table of its lights.
//!
//! Two levels: each mesh has one tree in its local space, however many objects show it; the world has one tree over the
//! boxes of its objects. Infinite things stay outside the tree and are asked by every ray.

mod hit;
mod place;
mod solid;

pub use hit::{Owner, SurfaceHit};

use heliostat_geometry::Ray;
use heliostat_scene::object::Geometry;
use heliostat_scene::{Rgb, Scene};
use place::Place;
use solid::{Body, Solid};

/// Why a scene could not be made ready.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WorldError {
    /// An object refers to something that the scene does not have.
    #[error("object `{object}` refers to {what}, which the scene does not have")]
    Dangling {
        /// Name of the object.
        object: String,
        /// What is missing.
        what: String,
    },
}

/// A scene made ready for rays.
#[derive(Debug)]
pub struct World<'s> {
    scene: &'s Scene,
    solids: Vec<Solid<'s>>,
}

impl<'s> World<'s> {
    /// Makes `scene` ready.
    ///
    /// # Errors
    /// When an object refers to something that is not there.
    pub fn new(scene: &'s Scene) -> Result<Self, WorldError> {
        let mut solids = Vec::with_capacity(scene.objects.len());
        for object in &scene.objects {
            let place = Place::of(&object.motion);
            let (geometry, local) = match &object.geometry {
                Geometry::Shape(shape) => (Body::Shape(shape), shape.geometry().bounds()),
                Geometry::Mesh(id) => {
                    let what = format!("mesh {}", id.0);
                    return Err(WorldError::Dangling { object: object.name.clone(), what });
                }
            };
            solids.push(Solid { geometry, bounds: place.bounds(local), place });
        }
        Ok(Self { scene, solids })
    }

    /// The scene behind it.
    pub fn scene(&self) -> &'s Scene {
        self.scene
    }

    /// The nearest surface that a ray meets at `time` in `[0, 1]` over the shutter.
    pub fn closest_hit(&self, ray: &Ray, time: f32) -> Option<SurfaceHit> {
        let mut ray = *ray;
        let mut nearest = None;
        for (id, solid) in self.solids.iter().enumerate() {
            if let Some((t, meeting)) = solid.closest(&ray, time) {
                if nearest.is_none() || t < ray.range.max {
                    ray.range.max = t;
                    nearest = Some((id, meeting));
                }
            }
        }
        let (id, meeting) = nearest?;
        let surface = self.solids[id].surface(&ray, time, meeting)?;
        Some(SurfaceHit {
            hit: surface.hit,
            owner: Owner::Object {
                index: id as u32,
                material: self.scene.objects[id].material(surface.slot),
            },
            local: surface.local,
            color: surface.color,
            triangle: surface.triangle,
        })
    }

    /// Whether something that throws shadows lies in the range of the ray.
    pub fn occluded(&self, ray: &Ray, time: f32) -> bool {
        let shadow = |(object, solid): (&heliostat_scene::Object, &Solid<'_>)| {
            object.casts_shadow && solid.closest(ray, time).is_some()
        };
        self.scene.objects.iter().zip(&self.solids).any(shadow)
    }

    /// The share of light that comes along a ray past everything that throws shadows.
    pub fn transmittance(&self, ray: &Ray, time: f32) -> Rgb {
        if self.occluded(ray, time) { Rgb::ZERO } else { Rgb::ONE }
    }
}
