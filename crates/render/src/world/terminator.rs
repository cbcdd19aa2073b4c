//! Shadows on smooth meshes without the corners of their triangles.
//!
//! A facet lies below the smooth surface that its vertex normals describe. Near the border between light and
//! shadow its neighbours shade it, and the border shows the triangles. Shadow rays that start on the smooth surface do not
//! have that problem.
//!
//! # Source
//! Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II, 2021.

use super::World;
use super::body::Body;
use super::hit::SurfaceHit;
use super::thing::Standing;
use glam::{DVec3, Vec3};

impl World<'_> {
    /// How far the smooth surface lies above a hit on the side of its normal; against it with `turned`.
    ///
    /// Zero on shapes, on faceted meshes, and where the smooth surface lies below the facet.
    pub(crate) fn lift(&self, hit: &SurfaceHit, turned: bool, time: f32) -> Vec3 {
        let lift = || self.with_owner(hit, time, |standing| lift(hit, turned, standing));
        hit.triangle.and_then(|_| lift()).unwrap_or(Vec3::ZERO)
    }
}

/// [`World::lift`] on a thing.
fn lift(hit: &SurfaceHit, turned: bool, standing: &Standing<'_, '_>) -> Option<Vec3> {
    let ((triangle, weights), Body::Mesh { mesh, .. }) = (hit.triangle?, standing.body) else { return None };
    if mesh.normals.is_empty() {
        return None;
    }
    let p = hit.hit.at.p.as_dvec3();
    let side = if turned { -1.0 } else { 1.0 };
    let place = standing.place;
    let corners = mesh.triangles[triangle as usize].map(|v| v as usize);
    let lift = corners.into_iter().zip(weights).fold(DVec3::ZERO, |lift, (corner, weight)| {
        // Onto the plane through the corner at right angles to its normal, if that lies above.
        let vertex = place.matrix().transform_point3(mesh.positions[corner].as_dvec3());
        let normal = side * place.normal(mesh.normals[corner]).as_dvec3();
        lift - f64::from(weight) * (p - vertex).dot(normal).min(0.0) * normal
    });
    Some(lift.as_vec3())
}
