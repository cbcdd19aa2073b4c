//! Uniform points on the surface of anything that shines: shapes, and meshes through a table of triangle areas.

use super::sums;
use glam::Vec2;
use heliostat_geometry::shape::AreaSample;
use heliostat_geometry::{Aabb, Shape, TriMesh};
use heliostat_scene::Scene;
use heliostat_scene::object::Geometry;

/// A surface of finite area above 0.
#[derive(Debug)]
pub(super) enum Emitter<'s> {
    Shape(&'s Shape),
    Mesh { mesh: &'s TriMesh, triangles: TriangleTable },
}

/// A point on an emitter, in its local space.
#[derive(Clone, Copy, Debug)]
pub(super) struct EmitterSample {
    /// Point and density by local area.
    pub(super) point: AreaSample,
    /// Material slot there.
    pub(super) slot: u16,
}

impl<'s> Emitter<'s> {
    /// The surface of a geometry, on meshes only where `shines(slot)`; `None` without a finite area above 0.
    pub(super) fn new(
        scene: &'s Scene,
        geometry: &'s Geometry,
        shines: impl Fn(u16) -> bool,
    ) -> Option<Self> {
        match geometry {
            Geometry::Shape(shape) => {
                let area = shape.geometry().area();
                (shines(0) && area.is_finite() && area > 0.0).then_some(Self::Shape(shape))
            }
            Geometry::Mesh(id) => {
                let mesh = scene.meshes.get(id.index())?.as_ref();
                let triangles = TriangleTable::new(mesh, shines)?;
                Some(Self::Mesh { mesh, triangles })
            }
            // Its parts shine, each by itself.
            Geometry::Group(_) => None,
        }
    }

    /// A box around it in local space.
    pub(super) fn bounds(&self) -> Aabb {
        match self {
            Self::Shape(shape) => shape.geometry().bounds(),
            Self::Mesh { mesh, .. } => mesh.bounds(),
        }
    }

    /// Area of what shines, in local space.
    pub(super) fn area(&self) -> f64 {
        match self {
            Self::Shape(shape) => shape.geometry().area(),
            Self::Mesh { triangles, .. } => triangles.area(),
        }
    }

    /// A point uniform by local area.
    pub(super) fn sample(&self, u: Vec2) -> Option<EmitterSample> {
        match self {
            Self::Shape(shape) => Some(EmitterSample { point: shape.geometry().sample(u)?, slot: 0 }),
            Self::Mesh { mesh, triangles } => {
                let (triangle, x) = triangles.pick(u.x);
                let mut point = mesh.sample_triangle(triangle, Vec2::new(x, u.y));
                point.pdf = 1.0 / triangles.area();
                Some(EmitterSample { point, slot: mesh.slot(triangle) })
            }
        }
    }
}

/// Triangles by the running sum of their areas, in `f64`.
#[derive(Debug)]
pub(super) struct TriangleTable {
    triangles: Vec<u32>,
    /// Area of the triangles up to and including this one.
    sums: Vec<f64>,
}

impl TriangleTable {
    /// The triangles that shine; `None` when their area is 0.
    fn new(mesh: &TriMesh, shines: impl Fn(u16) -> bool) -> Option<Self> {
        let mut table = Self { triangles: Vec::new(), sums: Vec::new() };
        let mut sum = 0.0;
        for triangle in (0..mesh.triangles.len() as u32).filter(|&i| shines(mesh.slot(i))) {
            let area = mesh.area(triangle);
            if area > 0.0 {
                sum += area;
                table.triangles.push(triangle);
                table.sums.push(sum);
            }
        }
        (sum > 0.0 && sum.is_finite()).then_some(table)
    }

    fn area(&self) -> f64 {
        sums::total(&self.sums)
    }

    /// A triangle with probability by area for `u` in `[0, 1)`, and what is left of `u` for a point on it.
    fn pick(&self, u: f32) -> (u32, f32) {
        let (i, rest) = sums::pick(&self.sums, u);
        (self.triangles[i], rest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn triangles_are_picked_by_area_and_the_rest_is_uniform() {
        // Areas 1, 3 and 4 in slots 0, 1 and 0.
        let positions = [(2.0, 1.0), (2.0, 3.0), (4.0, 2.0)].iter();
        let positions = positions.flat_map(|&(x, y)| [Vec3::ZERO, x * Vec3::X, y * Vec3::Y]).collect();
        let mesh = TriMesh {
            positions,
            triangles: vec![[0, 1, 2], [3, 4, 5], [6, 7, 8]],
            slots: vec![0, 1, 0],
            ..TriMesh::default()
        };
        let all = TriangleTable::new(&mesh, |_| true).unwrap();
        assert_eq!(all.area(), 8.0);
        assert_eq!(all.pick(0.0625), (0, 0.5));
        assert_eq!(all.pick(0.125), (1, 0.0));
        assert_eq!(all.pick(0.5), (2, 0.0));
        assert_eq!(all.pick(0.75), (2, 0.5));
        let first_slot = TriangleTable::new(&mesh, |slot| slot == 0).unwrap();
        assert_eq!(first_slot.area(), 5.0);
        assert_eq!(first_slot.pick(0.6), (2, (0.6_f32 * 5.0 - 1.0) / 4.0));
        assert!(TriangleTable::new(&mesh, |_| false).is_none());
    }
}
