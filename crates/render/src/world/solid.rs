//! One thing that rays can meet: a geometry at a place.

use super::place::Place;
use glam::Vec3;
use heliostat_geometry::shape::Root;
use heliostat_geometry::{Aabb, Hit, Ray, Shape};

/// A geometry at a place, with its tree where it is a mesh.
#[derive(Clone, Debug)]
pub(crate) struct Solid<'s> {
    pub(crate) geometry: Body<'s>,
    pub(crate) place: Place<'s>,
    /// The box around it over the shutter, in world space; unbounded for the infinite plane.
    pub(crate) bounds: Aabb,
}

/// What there is in local space.
#[derive(Clone, Debug)]
pub(crate) enum Body<'s> {
    /// An analytic shape.
    Shape(&'s Shape),
}

/// Where a ray meets a body, before the surface there is worked out.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Meeting {
    /// On a shape.
    Shape(Root),
}

/// The surface at a meeting.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Surface {
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

impl Solid<'_> {
    /// The nearest meeting in the range of the ray.
    #[inline]
    pub(crate) fn closest(&self, ray: &Ray, time: f32) -> Option<(f32, Meeting)> {
        self.place.at(time, |transform| match &self.geometry {
            Body::Shape(shape) => {
                let root = shape.geometry().hit(&transform.local_ray(ray))?;
                Some((root.t as f32, Meeting::Shape(root)))
            }
        })?
    }

    /// The surface at a meeting that [`Solid::closest`] gave for the same ray and time.
    pub(crate) fn surface(&self, ray: &Ray, time: f32, meeting: Meeting) -> Option<Surface> {
        self.place.at(time, |transform| match (&self.geometry, meeting) {
            (Body::Shape(shape), Meeting::Shape(root)) => {
                let local = shape.geometry().surface(&transform.local_ray(ray), root);
                Surface {
                    hit: transform.hit_to_world(&local),
                    local: local.p.as_vec3(),
                    slot: 0,
                    color: None,
                    triangle: None,
                }
            }
        })
    }
}
