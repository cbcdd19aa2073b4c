//! Points on the surface of anything that shines: uniform on shapes, by brightness where a texture says how bright it is.

mod cells;
mod glow;
mod mesh;

pub(super) use glow::Glow;
pub(super) use mesh::MeshLamp;

use super::cluster::Cone;
use super::table2d::Table2d;
use crate::texture_eval::TexturePoint;
use crate::world::SurfaceHit;
use glam::Vec2;
use heliostat_geometry::shape::AreaSample;
use heliostat_geometry::{Aabb, Shape};
use std::sync::Arc;

/// Share of the choices on a textured surface that are made without regard to its brightness, which is known at a few points.
const EVEN: f32 = 0.1;

/// A surface of finite area above 0.
#[derive(Clone, Debug)]
pub(super) enum Emitter<'s> {
    /// Uniform; by a table over the surface parameters on a rectangle with a texture.
    Shape(&'s Shape, Option<Arc<Table2d>>),
    Mesh(Arc<MeshLamp<'s>>),
}

/// A point on an emitter, in its local space.
#[derive(Clone, Copy, Debug)]
pub(super) struct EmitterSample {
    /// Point and density by local area.
    pub(super) point: AreaSample,
    /// Material slot there.
    pub(super) slot: u16,
    /// Where its textures are looked at.
    pub(super) at: TexturePoint,
}

/// What is known of a piece of an emitter, in local space.
#[derive(Clone, Copy, Debug)]
pub(super) struct EmitterPiece {
    pub(super) bounds: Aabb,
    /// Around all normals.
    pub(super) normals: Cone,
    /// Area times luminance.
    pub(super) brightness: f64,
}

impl EmitterSample {
    /// A point of a shape.
    pub(super) fn on_shape(point: AreaSample) -> Self {
        Self { point, slot: 0, at: TexturePoint::plain(point.uv, point.p.as_vec3()) }
    }
}

impl<'s> Emitter<'s> {
    /// The surface of a shape; `None` without a finite area above 0, or in the dark.
    pub(super) fn of_shape(shape: &'s Shape, glow: &Glow<'_>) -> Option<Self> {
        let area = shape.geometry().area();
        let table = matches!(shape, Shape::Rectangle(_)).then(|| glow.table()).flatten().map(Arc::new);
        (glow.factor(0) > 0.0 && area.is_finite() && area > 0.0).then_some(Self::Shape(shape, table))
    }

    /// A box around it in local space.
    pub(super) fn bounds(&self) -> Aabb {
        match self {
            Self::Shape(shape, _) => shape.geometry().bounds(),
            Self::Mesh(lamp) => lamp.mesh.bounds(),
        }
    }

    /// The pieces, in local space; `glow` as when it was made.
    pub(super) fn pieces(&self, glow: &Glow<'_>) -> Vec<EmitterPiece> {
        match self {
            Self::Shape(shape, _) => {
                let normals = match shape {
                    Shape::Rectangle(_) | Shape::Disk(_) => Cone { axis: glam::Vec3::Y, angle: 0.0 },
                    Shape::Triangle(t) => match (t.b - t.a).cross(t.c - t.a).try_normalize() {
                        Some(axis) => Cone { axis, angle: 0.0 },
                        None => Cone::ALL,
                    },
                    _ => Cone::ALL,
                };
                let brightness = shape.geometry().area() * f64::from(glow.mean());
                vec![EmitterPiece { bounds: shape.geometry().bounds(), normals, brightness }]
            }
            Self::Mesh(lamp) => lamp.pieces().collect(),
        }
    }

    /// The index of the piece that a hit lies on; `None` where it does not shine.
    #[inline]
    pub(super) fn piece_of(&self, hit: &SurfaceHit) -> Option<usize> {
        match (self, hit.triangle) {
            (Self::Shape(..), _) => Some(0),
            (Self::Mesh(lamp), Some((triangle, weights))) => lamp.piece_of(triangle, weights),
            (Self::Mesh(_), None) => None,
        }
    }

    /// A point of a piece.
    pub(super) fn sample(&self, piece: usize, u: Vec2) -> Option<EmitterSample> {
        match self {
            Self::Shape(shape, None) => Some(EmitterSample::on_shape(shape.geometry().sample(u)?)),
            Self::Shape(shape, Some(table)) => {
                let (u, density) = table.sample(u);
                let mut point = shape.geometry().sample(u)?;
                point.pdf *= f64::from(density);
                Some(EmitterSample::on_shape(point))
            }
            Self::Mesh(lamp) => Some(lamp.sample(piece, u)),
        }
    }

    /// The density by local area with which [`Emitter::sample`] finds a hit on a piece.
    #[inline]
    pub(super) fn density(&self, piece: usize, hit: &SurfaceHit) -> f64 {
        match (self, hit.triangle) {
            (Self::Shape(shape, table), _) => {
                let share = table.as_ref().map_or(1.0, |table| f64::from(table.density(hit.hit.uv)));
                share / shape.geometry().area()
            }
            (Self::Mesh(lamp), Some((triangle, weights))) => lamp.density(piece, triangle, weights),
            (Self::Mesh(_), None) => 0.0,
        }
    }
}
