//! What a ray met: a surface point and whose it is.

use super::thing::Thing;
use crate::texture_eval::TexturePoint;
use glam::{Vec2, Vec3};
use heliostat_geometry::Hit;
use heliostat_scene::{MaterialId, Rgb};

/// Whose surface was met.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Owner {
    /// An object of the scene.
    Object {
        /// Index into [`heliostat_scene::Scene::objects`].
        index: u32,
        /// The material of the surface; on groups, that of the part.
        material: MaterialId,
    },
    /// The visible surface of an area light: index into [`heliostat_scene::Scene::lights`].
    Light(u32),
}

/// A hit in world space and what shading needs to know besides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceHit {
    /// The hit in world space.
    pub hit: Hit,
    /// Whose surface it is.
    pub owner: Owner,
    /// Which part of an object that is a group: its number in the order in which groups hold things, copy by copy. 0 for what
    /// is no group.
    pub part: u64,
    /// Position in the local space of the owner; on groups, of the part.
    pub local: Vec3,
    /// The second set of surface parameters; that of the hit where there is only one.
    pub uv1: Vec2,
    /// What of the surface the ray stands for: the change of the surface parameters along the axes of an ellipse. Zero for a ray
    /// without width.
    pub footprint: [Vec2; 2],
    /// Interpolated vertex colour, where the mesh has one.
    pub color: Option<Rgb>,
    /// Interpolated vertex coverage; 1 where the mesh has none.
    pub coverage: f32,
    /// The triangle and the weights of its corners, on meshes.
    pub triangle: Option<(u32, [f32; 3])>,
}

impl SurfaceHit {
    /// The object, unless the surface belongs to a light.
    pub fn object(&self) -> Option<u32> {
        match self.owner {
            Owner::Object { index, .. } => Some(index),
            Owner::Light(_) => None,
        }
    }

    /// Which of all things it is, unless the surface belongs to a light.
    #[inline]
    pub(crate) fn thing(&self) -> Option<Thing> {
        Some(Thing { solid: self.object()?, part: self.part })
    }

    /// Where its textures are looked at.
    pub(crate) fn texture_point(&self) -> TexturePoint {
        let Self { hit, uv1, local, coverage, footprint, .. } = *self;
        TexturePoint { uv: hit.uv, uv1, local, coverage, footprint }
    }

    /// The material, unless the surface belongs to a light.
    pub fn material(&self) -> Option<MaterialId> {
        match self.owner {
            Owner::Object { material, .. } => Some(material),
            Owner::Light(_) => None,
        }
    }
}
