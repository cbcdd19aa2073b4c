//! One object that rays can meet, or the surface of a light: a geometry at a place.

use super::blocker::{Blocker, Verdict};
use super::body::Body;
use super::group::{Groups, PreparedGroup};
use super::hull::Hull;
use super::place::Place;
use super::shadow_rays::ShadowRays;
use super::shaft::Shaft;
use heliostat_geometry::{Aabb, Ray, Shape, SurfacePoint};
use heliostat_index::MeshTree;
use heliostat_scene::Scene;
use heliostat_scene::object::Geometry;
use std::sync::Arc;

/// A geometry at a place.
#[derive(Debug)]
pub(crate) struct Solid<'s> {
    pub(crate) content: Content<'s>,
    pub(crate) place: Place<'s>,
    /// The box around it over the shutter, in world space; unbounded for the infinite plane, empty for an empty mesh.
    pub(crate) bounds: Aabb,
    /// The same, but closer where it stands still.
    hull: Hull,
    /// Its test for many rays at once, where it has one.
    pub(super) blocker: Option<Blocker>,
}

/// What a solid is made of.
#[derive(Debug)]
pub(crate) enum Content<'s> {
    /// A shape or a mesh.
    Body(Body<'s>),
    /// Things in a space of their own.
    Group(Arc<PreparedGroup<'s>>),
}

/// What geometries of a scene are made of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stock<'a, 's> {
    pub(super) scene: &'s Scene,
    /// The tree of each mesh.
    pub(super) trees: &'a [Arc<MeshTree>],
    /// The groups that are ready.
    pub(super) groups: &'a Groups<'s>,
}

impl<'s> Stock<'_, 's> {
    /// The content of a geometry. Its group must be there already.
    pub(super) fn content(&self, geometry: &'s Geometry) -> Content<'s> {
        match geometry {
            Geometry::Shape(shape) => Content::Body(Body::Shape(shape)),
            Geometry::Mesh(id) => {
                let (mesh, tree) = (&self.scene.meshes[id.index()], &self.trees[id.index()]);
                Content::Body(Body::Mesh { mesh, tree: Arc::clone(tree) })
            }
            Geometry::Group(id) => Content::Group(Arc::clone(&self.groups[id])),
        }
    }
}

impl<'s> Solid<'s> {
    /// A geometry of the scene.
    pub(super) fn new(stock: &Stock<'_, 's>, geometry: &'s Geometry, place: Place<'s>) -> Self {
        let content = stock.content(geometry);
        let (local, shape) = match &content {
            Content::Body(Body::Shape(shape)) => (shape.geometry().bounds(), Some(*shape)),
            Content::Body(Body::Mesh { mesh, .. }) => (mesh.bounds(), None),
            Content::Group(group) => (group.bounds(), None),
        };
        let blocker = shape.and_then(|shape| Blocker::new(shape, &place));
        Self { content, bounds: place.bounds(local), hull: Hull::new(local, shape, &place), blocker, place }
    }

    /// Whether anything that lets no light through lies in the range of the ray.
    #[inline]
    pub(crate) fn blocks(&self, ray: &Ray, time: f32) -> bool {
        let mut room = None;
        self.place.at(time, &mut room).is_some_and(|place| match &self.content {
            Content::Body(body) => body.blocks(place, ray),
            Content::Group(group) => group.blocks(ray, time, place),
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
        let (Content::Body(Body::Shape(shape)), Place::Still(_)) = (&self.content, self.place) else {
            return false;
        };
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
}
