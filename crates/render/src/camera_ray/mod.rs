//! Rays of the camera: projection, thin lens, movement over the shutter.
//!
//! # Depth of field
//! Light of a point in focus meets in one place of the picture wherever it passes the lens. So a ray starts at a point of
//! the lens opening and goes to where the ray through the middle of the lens meets what is in focus: a *plane* across
//! the view for perspective and parallel rays, so that a wall is sharp into its corners; a sphere around the
//! camera for the projections that look around, whose lens always faces the ray.
//!
//! # Motion
//! Poses are interpolated as matrices, as [`Motion`] promises, and made orthonormal again, the direction of view first.
//!
//! # Source
//! Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th edition, sections 5.2 and 5.3.

mod picture;

use crate::integrator::CameraRay;
use crate::ray_cone::RayCone;
use glam::{DAffine3, DMat3, DVec2, DVec3, Vec2, Vec3};
use heliostat_geometry::Ray;
use heliostat_geometry::warp::square_to_polygon;
use heliostat_scene::camera::{Camera, Focus, FocusMethod};
use heliostat_scene::motion::Motion;
use picture::{LocalRay, Picture};

/// A camera, ready to shoot rays.
#[derive(Clone, Debug)]
pub(crate) struct CameraRays {
    picture: Picture,
    motion: Motion<DAffine3>,
    /// The lens, when rays make the depth of field.
    lens: Option<Focus>,
    /// The focus, when a blur after rendering makes it.
    post: Option<Focus>,
    /// Samples of a pixel, where rays have a width.
    cones: Option<u32>,
}

impl CameraRays {
    /// The rays of `camera` into a picture of a size in pixels.
    pub(crate) fn new(camera: &Camera, width: u32, height: u32) -> Self {
        let with = |method| camera.focus.filter(|focus| focus.method == method && focus.lens_radius > 0.0);
        Self {
            picture: Picture::new(camera.projection, width, height),
            motion: camera.motion.clone(),
            lens: with(FocusMethod::Lens),
            post: with(FocusMethod::Post),
            cones: None,
        }
    }

    /// The same camera whose rays are as wide as the share of a pixel that falls to one of `samples`.
    pub(crate) fn with_cones(self, samples: u32) -> Self {
        Self { cones: Some(samples), ..self }
    }

    /// The ray through `place`, in pixels from the upper left corner of the picture.
    ///
    /// `lens` is a point of the unit square, mapped to the lens opening; `time` lies in `[0, 1]` over the shutter. `None`
    /// where the projection leaves the picture empty.
    pub(crate) fn ray(&self, place: DVec2, lens: Vec2, time: f32) -> Option<CameraRay> {
        let pinhole = self.picture.ray(place)?;
        let local = self.lens.map_or(pinhole, |focus| self.through_lens(pinhole, &focus, lens));
        let pose = self.pose(time);
        let dir = pose.transform_vector3(local.dir).normalize();
        Some(CameraRay {
            ray: Ray::new(pose.transform_point3(local.origin).as_vec3(), dir.as_vec3()),
            time,
            eye: pose.translation.as_vec3(),
            forward: -pose.matrix3.z_axis.as_vec3(),
            cone: self.cones.map_or(RayCone::POINT, |samples| self.cone(place, &pinhole, samples)),
        })
    }

    /// How wide a pixel is where its ray starts and how its angle grows, by the rays of its neighbours to the right and below.
    fn cone(&self, place: DVec2, ray: &LocalRay, samples: u32) -> RayCone {
        let neighbours = [DVec2::X, DVec2::Y].map(|step| {
            let other = self.picture.ray(place + step).or_else(|| self.picture.ray(place - step));
            let other = other.unwrap_or(*ray);
            (ray.origin.distance(other.origin), small_angle(ray.dir, other.dir))
        });
        let mean = |a: f64, b: f64| (a * b).sqrt() as f32;
        let [(right, turn), (down, tilt)] = neighbours;
        RayCone::of_pixel(mean(right, down), mean(turn, tilt), samples)
    }

    /// What the `Z` layer says of a point that `ray` met: perpendicular to the picture, or the distance where the camera
    /// looks around.
    pub(crate) fn depth(&self, ray: &CameraRay, p: Vec3) -> f32 {
        if self.picture.is_flat() { ray.perpendicular_depth(p) } else { p.distance(ray.eye) }
    }

    /// Whether depth is measured perpendicular to the picture.
    pub(crate) fn has_perpendicular_depth(&self) -> bool {
        self.picture.is_flat()
    }

    /// The pose at the opening of the shutter: from camera to world space.
    pub(crate) fn opening_pose(&self) -> DAffine3 {
        self.pose(0.0)
    }

    /// Half the width and height of what a flat picture sees, in metres at depth 1; `None` where it looks around.
    pub(crate) fn half_extent(&self) -> Option<DVec2> {
        self.picture.half_extent()
    }

    /// Whether rays are parallel.
    pub(crate) fn is_parallel(&self) -> bool {
        self.picture.is_parallel()
    }

    /// The focus, when a blur after rendering makes the depth of field.
    pub(crate) fn post_focus(&self) -> Option<&Focus> {
        self.post.as_ref()
    }

    /// Radius in pixels of the disk that a lens makes of a point at `depth`, in the middle of the picture.
    ///
    /// # Source
    /// Similar triangles: the cone between lens and plane of focus, cut at `depth`, has the radius
    /// `lens_radius |depth - distance| / distance`; a perspective picture shows it divided by `depth`.
    pub(crate) fn blur_radius(&self, focus: &Focus, depth: f64) -> f64 {
        let distance = f64::from(focus.distance);
        let cone = f64::from(focus.lens_radius) / distance * self.picture.pixels_per_slope();
        if self.picture.is_parallel() {
            cone * (depth - distance).abs()
        } else {
            // In this form a depth near infinity keeps its digits.
            cone * (1.0 - distance / depth).abs()
        }
    }

    /// From camera to world space at a time of the shutter.
    fn pose(&self, time: f32) -> DAffine3 {
        if !self.motion.is_moving() {
            return *self.motion.first();
        }
        let (first, second, weight) = self.motion.around(time);
        if first == second {
            return *first;
        }
        let mix = |a: DVec3, b: DVec3| a.lerp(b, f64::from(weight));
        let axes = DMat3::from_cols(
            mix(first.matrix3.x_axis, second.matrix3.x_axis),
            mix(first.matrix3.y_axis, second.matrix3.y_axis),
            mix(first.matrix3.z_axis, second.matrix3.z_axis),
        );
        // Between opposite poses there is no direction: the first pose holds.
        let matrix3 = orthonormal(axes).unwrap_or(first.matrix3);
        DAffine3 { matrix3, translation: mix(first.translation, second.translation) }
    }

    /// Moves the start of a ray over the lens and keeps the point in focus.
    fn through_lens(&self, pinhole: LocalRay, focus: &Focus, u: Vec2) -> LocalRay {
        let in_focus = if self.picture.is_flat() {
            pinhole.origin + pinhole.dir * (f64::from(focus.distance) / -pinhole.dir.z)
        } else {
            pinhole.dir.normalize() * f64::from(focus.distance)
        };
        let iris = square_to_polygon(u, focus.blades).as_dvec2() * f64::from(focus.lens_radius);
        let opening = DVec2::from_angle(f64::from(focus.blade_rotation)).rotate(iris);
        let (right, up) = if self.picture.is_flat() { (DVec3::X, DVec3::Y) } else { across(pinhole.dir) };
        let origin = pinhole.origin + opening.x * right + opening.y * up;
        LocalRay { origin, dir: in_focus - origin }
    }
}

/// The angle between two directions that are close to each other, by its sine.
fn small_angle(a: DVec3, b: DVec3) -> f64 {
    (a.cross(b).length_squared() / (a.length_squared() * b.length_squared())).sqrt()
}

/// The right and up of a lens that faces `dir`, level with the camera.
fn across(dir: DVec3) -> (DVec3, DVec3) {
    // Straight up and down every direction is level; x is as good as any.
    let right = dir.cross(DVec3::Y).try_normalize().unwrap_or(DVec3::X);
    (right, right.cross(dir).normalize())
}

/// The nearest right-handed axes: z keeps its direction, y its plane with z. `None` when they do not exist.
fn orthonormal(axes: DMat3) -> Option<DMat3> {
    let z = axes.z_axis.try_normalize()?;
    let x = axes.y_axis.cross(z).try_normalize()?;
    Some(DMat3::from_cols(x, z.cross(x), z))
}

#[cfg(test)]
mod tests;
