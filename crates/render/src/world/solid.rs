//! One thing that rays can meet: a geometry at a place.

use super::blocker::{Blocker, Verdict};
use super::hull::Hull;
use super::place::Place;
use super::shadow_rays::ShadowRays;
use super::shaft::Shaft;
use glam::Vec3;
use heliostat_geometry::shape::Root;
use heliostat_geometry::{Aabb, Hit, Ray, Shape, SurfacePoint, TriMesh};
use heliostat_index::{MeshHit, MeshTree, TraversalCost};
use heliostat_scene::Scene;
use heliostat_scene::object::Geometry;
use std::sync::Arc;

/// A geometry at a place.
#[derive(Debug)]
pub(crate) struct Solid<'s> {
    pub(crate) body: Body<'s>,
    pub(crate) place: Place<'s>,
    /// The box around it over the shutter, in world space; unbounded for the infinite plane, empty for an empty mesh.
    pub(crate) bounds: Aabb,
    /// The same, but closer where it stands still.
    hull: Hull,
    /// Its test for many rays at once, where it has one.
    pub(super) blocker: Option<Blocker>,
}

/// What there is in local space.
#[derive(Debug)]
pub(crate) enum Body<'s> {
    /// An analytic shape.
    Shape(&'s Shape),
    /// A mesh with its tree.
    Mesh { mesh: &'s TriMesh, tree: Arc<MeshTree> },
}

/// Where a ray meets a body, before the surface there is worked out.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Meeting {
    /// On a shape.
    Shape(Root),
    /// On a mesh.
    Mesh(MeshHit),
}

/// Whether anybody looks at the surface parameters of a hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Parameters {
    Used,
    /// They may be left out.
    Unused,
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
    /// Interpolated vertex colour.
    pub(crate) color: Option<Vec3>,
    /// Triangle and weights of its corners.
    pub(crate) triangle: Option<(u32, [f32; 3])>,
}

impl<'s> Solid<'s> {
    /// A geometry of the scene, whose meshes have these trees.
    pub(crate) fn new(
        scene: &'s Scene,
        trees: &[Arc<MeshTree>],
        geometry: &'s Geometry,
        place: Place<'s>,
    ) -> Self {
        let body = match geometry {
            Geometry::Shape(shape) => Body::Shape(shape),
            Geometry::Mesh(id) => {
                Body::Mesh { mesh: &scene.meshes[id.index()], tree: Arc::clone(&trees[id.index()]) }
            }
        };
        let (local, shape) = match &body {
            Body::Shape(shape) => (shape.geometry().bounds(), Some(*shape)),
            Body::Mesh { mesh, .. } => (mesh.bounds(), None),
        };
        let blocker = shape.and_then(|shape| Blocker::new(shape, &place));
        Self { body, bounds: place.bounds(local), hull: Hull::new(local, shape, &place), blocker, place }
    }

    /// The nearest meeting in the range of the ray.
    #[inline]
    pub(crate) fn closest(&self, ray: &Ray, time: f32) -> Option<(f32, Meeting)> {
        let transform = self.place.now(time)?;
        match &self.body {
            Body::Shape(shape) => {
                let root = shape.hit(&transform.local_ray(ray))?;
                Some((root.t as f32, Meeting::Shape(root)))
            }
            Body::Mesh { tree, .. } => {
                let found = tree.closest_hit(&transform.ray_to_local(ray))?;
                Some((found.hit.t, Meeting::Mesh(found)))
            }
        }
    }

    /// [`Solid::closest`] that adds the work of the mesh tree to `cost`.
    pub(crate) fn closest_counted(
        &self,
        ray: &Ray,
        time: f32,
        cost: &mut TraversalCost,
    ) -> Option<(f32, Meeting)> {
        let Body::Mesh { tree, .. } = &self.body else { return self.closest(ray, time) };
        let transform = self.place.now(time)?;
        let found = tree.closest_hit_counted(&transform.ray_to_local(ray), cost)?;
        Some((found.hit.t, Meeting::Mesh(found)))
    }

    /// Whether anything lies in the range of the ray.
    #[inline]
    pub(crate) fn blocks(&self, ray: &Ray, time: f32) -> bool {
        self.place.now(time).is_some_and(|transform| match &self.body {
            Body::Shape(shape) => shape.hit(&transform.local_ray(ray)).is_some(),
            Body::Mesh { tree, .. } => tree.any_hit(&transform.ray_to_local(ray)),
        })
    }

    /// Which shadow rays meet it.
    #[inline]
    pub(super) fn verdict(&self, rays: &ShadowRays<'_>) -> Verdict {
        self.blocker.map_or(Verdict::DOUBT, |blocker| blocker.verdict(rays))
    }

    /// Whether no ray that leaves its surface at `at`, to the side of the normal there, meets it again: a flat or convex
    /// shape, from outside.
    pub(crate) fn is_left_by_rays(&self, at: &SurfacePoint) -> bool {
        let (Body::Shape(shape), Place::Still(_)) = (&self.body, self.place) else { return false };
        match shape {
            Shape::Plane(_) | Shape::Rectangle(_) | Shape::Disk(_) | Shape::Triangle(_) => true,
            Shape::Sphere(_) | Shape::Cuboid(_) | Shape::Cylinder(_) | Shape::Cone(_) => {
                // The middle of a convex body lies behind all of its outer surface.
                at.ng.dot(at.p - self.hull.centre) > 0.0
            }
            Shape::Torus(_) => false,
        }
    }

    /// Whether it may meet a shaft.
    pub(crate) fn may_block(&self, shaft: &Shaft<'_>) -> bool {
        match &self.blocker {
            Some(Blocker::Sphere(sphere)) => {
                shaft.may_hold_sphere(sphere.centre.as_vec3(), sphere.radius as f32)
            }
            Some(Blocker::Plane(origin, normal)) => !shaft.is_beside(*origin, *normal),
            _ => !self.bounds.is_finite() || shaft.may_hold(&self.hull),
        }
    }

    /// Visits every surface in the range of the ray once, in no certain order.
    pub(crate) fn each_surface(&self, ray: &Ray, time: f32, mut visit: impl FnMut(SurfaceAt)) {
        match &self.body {
            Body::Shape(_) => {
                let mut rest = *ray;
                while let Some((t, meeting)) = self.closest(&rest, time) {
                    self.surface(&rest, time, meeting, Parameters::Used).into_iter().for_each(&mut visit);
                    rest.range.min = t.next_up();
                }
            }
            Body::Mesh { tree, .. } => {
                let Some(transform) = self.place.now(time) else { return };
                tree.for_each_hit(&transform.ray_to_local(ray), |found| {
                    let surface = self.surface(ray, time, Meeting::Mesh(found), Parameters::Used);
                    surface.into_iter().for_each(&mut visit);
                });
            }
        }
    }

    /// Visits every surface of a shape in the range of the ray: where, and its unit normal. `false` for a mesh.
    pub(crate) fn each_crossing(&self, ray: &Ray, time: f32, mut visit: impl FnMut(f32, Vec3)) -> bool {
        let Body::Shape(shape) = &self.body else { return false };
        let Some(transform) = self.place.now(time) else { return true };
        let (local, shape) = (transform.local_ray(ray), shape.geometry());
        shape.each_root(&local, &mut |root| {
            visit(root.t as f32, transform.normal(shape.normal(&local, root).as_vec3()));
        });
        true
    }

    /// The surface at a meeting that came from the same ray and time.
    #[inline]
    pub(crate) fn surface(
        &self,
        ray: &Ray,
        time: f32,
        meeting: Meeting,
        parameters: Parameters,
    ) -> Option<SurfaceAt> {
        let transform = self.place.now(time)?;
        match (&self.body, meeting) {
            (Body::Shape(shape), Meeting::Shape(root)) => {
                let (ray, shape) = (transform.local_ray(ray), shape.geometry());
                let local = match parameters {
                    Parameters::Unused => shape.bare_surface(&ray, root),
                    Parameters::Used => shape.surface(&ray, root),
                };
                Some(SurfaceAt {
                    hit: transform.hit_to_world(&local),
                    local: local.p.as_vec3(),
                    slot: 0,
                    color: None,
                    triangle: None,
                })
            }
            (Body::Mesh { mesh, .. }, Meeting::Mesh(MeshHit { triangle, hit })) => {
                let local = mesh.surface(triangle, &hit);
                Some(SurfaceAt {
                    hit: transform.hit_to_world(&local),
                    local: local.p.as_vec3(),
                    slot: mesh.slot(triangle),
                    color: mesh.color(triangle, &hit),
                    triangle: Some((triangle, hit.barycentric)),
                })
            }
            // A meeting of the other kind does not come from this body.
            _ => None,
        }
    }
}
