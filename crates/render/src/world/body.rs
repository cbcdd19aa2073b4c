//! What there is in local space, and what rays find there.

use glam::{Vec2, Vec3};
use heliostat_geometry::shape::Root;
use heliostat_geometry::triangle::TriangleHit;
use heliostat_geometry::{Hit, Ray, Shape, Transform, TriMesh};
use heliostat_index::{MeshHit, MeshTree, TraversalCost};
use std::sync::Arc;

/// A shape or a mesh.
#[derive(Debug)]
pub(crate) enum Body<'s> {
    /// An analytic shape.
    Shape(&'s Shape),
    /// A mesh with its tree.
    Mesh { mesh: &'s TriMesh, tree: Arc<MeshTree> },
}

/// Where a ray meets a body, before the surface there is worked out.
///
/// One form for shapes and meshes, written where it stays: to copy numbers that have just been written costs a search more
/// than to find them.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Meeting {
    /// Ray parameter; on meshes an `f32`.
    t: f64,
    /// The part of the shape, or the triangle.
    face: u32,
    /// Weights of the corners of the triangle.
    weights: [f32; 3],
}

impl Meeting {
    #[inline(always)]
    fn on_shape(root: Root) -> Self {
        Self { t: root.t, face: root.part.into(), weights: [0.0; 3] }
    }

    #[inline(always)]
    fn on_mesh(MeshHit { triangle, hit }: MeshHit) -> Self {
        Self { t: hit.t.into(), face: triangle, weights: hit.barycentric }
    }

    #[inline(always)]
    fn root(&self) -> Root {
        Root { t: self.t, part: self.face as u8 }
    }

    #[inline(always)]
    fn triangle_hit(&self) -> TriangleHit {
        TriangleHit { t: self.t as f32, barycentric: self.weights }
    }
}

/// Whether anybody looks at the surface parameters of a hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Parameters {
    Used,
    /// They may be left out.
    Unused,
}

impl Parameters {
    /// Something of them, where it is used.
    #[inline(always)]
    pub(crate) fn of<T: Default>(self, work: impl FnOnce() -> T) -> T {
        match self {
            Self::Used => work(),
            Self::Unused => T::default(),
        }
    }
}

/// The surface at a meeting.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SurfaceAt {
    /// In world space.
    pub(crate) hit: Hit,
    /// Position in local space.
    pub(crate) local: Vec3,
    /// Material slot.
    pub(crate) slot: u16,
    /// The second set of surface parameters; the first one where there is only that.
    pub(crate) uv1: Vec2,
    /// Interpolated vertex colour.
    pub(crate) color: Option<Vec3>,
    /// Interpolated vertex coverage.
    pub(crate) coverage: f32,
    /// Triangle and weights of its corners.
    pub(crate) triangle: Option<(u32, [f32; 3])>,
}

impl Body<'_> {
    /// Whether some of it covers less than all, whatever its material says.
    pub(super) fn has_holes(&self) -> bool {
        match self {
            Self::Shape(_) => false,
            Self::Mesh { mesh, .. } => !mesh.opacities.is_empty(),
        }
    }

    /// The nearest meeting in the range of the ray: where on the ray, and the rest in `met`; `place` is the map to world space.
    #[inline]
    pub(super) fn closest(&self, place: &Transform, ray: &Ray, met: &mut Meeting) -> Option<f32> {
        *met = match self {
            Self::Shape(shape) => Meeting::on_shape(shape.hit(&place.local_ray(ray))?),
            Self::Mesh { tree, .. } => Meeting::on_mesh(tree.closest_hit(&place.ray_to_local(ray))?),
        };
        Some(met.t as f32)
    }

    /// [`Body::closest`] that adds the work of the mesh tree to `cost`.
    pub(super) fn closest_counted(
        &self,
        place: &Transform,
        ray: &Ray,
        met: &mut Meeting,
        cost: &mut TraversalCost,
    ) -> Option<f32> {
        let Self::Mesh { tree, .. } = self else { return self.closest(place, ray, met) };
        *met = Meeting::on_mesh(tree.closest_hit_counted(&place.ray_to_local(ray), cost)?);
        Some(met.t as f32)
    }

    /// Whether anything lies in the range of the ray.
    #[inline]
    pub(super) fn blocks(&self, place: &Transform, ray: &Ray) -> bool {
        match self {
            Self::Shape(shape) => shape.hit(&place.local_ray(ray)).is_some(),
            Self::Mesh { tree, .. } => tree.any_hit(&place.ray_to_local(ray)),
        }
    }

    /// Visits every surface in the range of the ray once, in no certain order.
    pub(super) fn each_surface(&self, place: &Transform, ray: &Ray, mut visit: impl FnMut(SurfaceAt)) {
        match self {
            Self::Shape(_) => {
                let (mut rest, mut met) = (*ray, Meeting::default());
                while let Some(t) = self.closest(place, &rest, &mut met) {
                    visit(self.surface(place, &rest, &met, Parameters::Used));
                    rest.range.min = t.next_up();
                }
            }
            Self::Mesh { tree, .. } => tree.for_each_hit(&place.ray_to_local(ray), |found| {
                visit(self.surface(place, ray, &Meeting::on_mesh(found), Parameters::Used));
            }),
        }
    }

    /// Visits every surface of a shape in the range of the ray: where, and its unit normal. `false` for a mesh.
    pub(super) fn each_crossing(
        &self,
        place: &Transform,
        ray: &Ray,
        mut visit: impl FnMut(f32, Vec3),
    ) -> bool {
        let Self::Shape(shape) = self else { return false };
        let (local, shape) = (place.local_ray(ray), shape.geometry());
        shape.each_root(&local, &mut |root| {
            visit(root.t as f32, place.normal(shape.normal(&local, root).as_vec3()));
        });
        true
    }

    /// The surface at a meeting that came from the same ray and place.
    #[inline(always)]
    pub(super) fn surface(
        &self,
        place: &Transform,
        ray: &Ray,
        meeting: &Meeting,
        parameters: Parameters,
    ) -> SurfaceAt {
        match self {
            Self::Shape(shape) => {
                let (ray, shape, root) = (place.local_ray(ray), shape.geometry(), meeting.root());
                let local = match parameters {
                    Parameters::Unused => shape.bare_surface(&ray, root),
                    Parameters::Used => shape.surface(&ray, root),
                };
                SurfaceAt {
                    hit: place.hit_to_world(&local),
                    local: local.p.as_vec3(),
                    slot: 0,
                    uv1: local.uv,
                    color: None,
                    coverage: 1.0,
                    triangle: None,
                }
            }
            Self::Mesh { mesh, .. } => {
                let (triangle, hit) = (meeting.face, meeting.triangle_hit());
                let local = mesh.surface(triangle, &hit);
                SurfaceAt {
                    hit: place.hit_to_world(&local),
                    local: local.p.as_vec3(),
                    slot: mesh.slot(triangle),
                    uv1: mesh.second_uv(triangle, &hit).unwrap_or(local.uv),
                    color: mesh.color(triangle, &hit),
                    coverage: mesh.opacity(triangle, &hit),
                    triangle: Some((triangle, hit.barycentric)),
                }
            }
        }
    }
}
