//! A torus around the y axis.

use super::quartic::{bracketed_root, depressed_cubic};
use super::round::Radial;
use super::{AreaSample, Geometry, LocalHit, Root};
use crate::aabb::Aabb;
use crate::error_bound::shape_point;
use crate::ray::LocalRay;
use glam::{DVec3, Vec2, Vec3};
use std::f32::consts::TAU as TAU_F32;
use std::f64::consts::{PI, TAU};

/// A torus around the y axis; `u` runs around the axis, `v` around the tube, 0.5 at its outermost ring.
///
/// A tube thicker than the ring is closed in the middle: the outer skin alone is the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Torus {
    /// Radius of the ring in the middle of the tube, in metres, 0 or more.
    pub major: f32,
    /// Radius of the tube in metres, above 0.
    pub minor: f32,
}

/// A ray with unit direction whose distances count from its point closest to the centre.
#[derive(Clone, Copy, Debug)]
struct CentredRay {
    from: DVec3,
    dir: DVec3,
}

impl Torus {
    fn radii(&self) -> (f64, f64) {
        (f64::from(self.major), f64::from(self.minor))
    }

    /// Squared distance of `p` from the ring minus that of the surface: negative inside. Nothing large cancels.
    fn implicit(&self, p: DVec3) -> f64 {
        let (major, minor) = self.radii();
        let across = (p.x * p.x + p.z * p.z).sqrt() - major;
        across * across + p.y * p.y - minor * minor
    }

    /// The implicit function along a ray with its slope.
    fn along(&self, ray: &CentredRay, t: f64) -> (f64, f64) {
        let (major, minor) = self.radii();
        let p = ray.from + t * ray.dir;
        let distance = (p.x * p.x + p.z * p.z).sqrt();
        let across = distance - major;
        let value = across * across + p.y * p.y - minor * minor;
        let outward = (p.x * ray.dir.x + p.z * ray.dir.z) / distance;
        (value, 2.0 * (across * outward + p.y * ray.dir.y))
    }

    /// The part of a ray that lies in the ball and in the slab around the torus; `None` when empty.
    fn clip(&self, ray: &CentredRay) -> Option<(f64, f64)> {
        let (major, minor) = self.radii();
        let reach = major + minor;
        let spare = reach * reach - ray.from.length_squared();
        if spare < 0.0 {
            return None;
        }
        let (mut low, mut high) = (-spare.sqrt(), spare.sqrt());
        if ray.dir.y == 0.0 {
            if ray.from.y.abs() > minor {
                return None;
            }
        } else {
            let side = minor.copysign(ray.dir.y);
            low = low.max((-side - ray.from.y) / ray.dir.y);
            high = high.min((side - ray.from.y) / ray.dir.y);
        }
        (low <= high).then_some((low, high))
    }

    /// Where the quartic of the torus turns along the ray, rising.
    ///
    /// From the closest point along a unit direction the quartic has no cubic term:
    /// `(t^2 + k)^2 - 4 R^2 (t^2 + m - y(t)^2)` with `m = |from|^2` and `k = m + R^2 - r^2`.
    fn turns(&self, ray: &CentredRay) -> [f64; 3] {
        let (major, minor) = self.radii();
        let ring = major * major;
        let k = ray.from.length_squared() + (major - minor) * (major + minor);
        let square = 2.0 * k - 4.0 * ring * (1.0 - ray.dir.y * ray.dir.y);
        let linear = 8.0 * ring * ray.from.y * ray.dir.y;
        depressed_cubic(0.5 * square, 0.25 * linear)
    }

    /// The largest angle around the tube, from its outermost ring, that belongs to the outer skin.
    fn skin_angle(&self) -> f64 {
        let (major, minor) = self.radii();
        if major >= minor { PI } else { (-major / minor).acos() }
    }
}

impl Geometry for Torus {
    fn hit(&self, ray: &LocalRay) -> Option<Root> {
        // Measure along a unit direction from the point closest to the centre: far origins then cost no digits.
        let length = ray.dir.length();
        let dir = ray.dir / length;
        let shift = -ray.origin.dot(dir);
        let centred = CentredRay { from: ray.origin + shift * dir, dir };
        let (low, high) = self.clip(&centred)?;
        let origin = -shift;
        if high <= origin {
            return None;
        }

        // Start outside at the border, or at the origin of the ray on the side on which it is.
        let (mut start, mut was_inside) =
            if low > origin { (low, false) } else { (origin, self.implicit(ray.origin) < 0.0) };

        // Between two turns there is at most one root, and only where the sides differ. The end is outside.
        for turn in self.turns(&centred).into_iter().chain([high]) {
            if turn <= start && turn < high {
                continue;
            }
            let end = turn.min(high);
            let is_inside = end < high && self.along(&centred, end).0 < 0.0;
            if is_inside != was_inside {
                let t =
                    (shift + bracketed_root(start, end, was_inside, |t| self.along(&centred, t))) / length;
                if ray.accepts(t) {
                    return Some(Root { t, part: 0 });
                }
            }
            if end >= high {
                break;
            }
            (start, was_inside) = (end, is_inside);
        }
        None
    }

    fn surface(&self, ray: &LocalRay, root: Root) -> LocalHit {
        let (major, minor) = self.radii();
        let at = ray.at(root.t);
        let (radial, distance) = Radial::through(at);
        // The direction from the ring, as (away from the axis, up).
        let (across, up) = (distance - major, at.y);
        let tube = (across * across + up * up).sqrt();
        let (cos, sin) = if tube > 0.0 { (across / tube, up / tube) } else { (1.0, 0.0) };
        let n = radial.point(cos, sin);
        LocalHit {
            t: root.t,
            p: radial.point(major + minor * cos, minor * sin),
            p_err: shape_point(major + minor),
            ng: n,
            ns: n,
            uv: Vec2::new(radial.u(), (sin as f32).atan2(cos as f32) / TAU_F32 + 0.5),
            dpdu: radial.dpdu(major + minor * cos),
            dpdv: (TAU * minor * radial.point(-sin, cos)).as_vec3(),
        }
    }

    fn bounds(&self) -> Aabb {
        let reach = (self.major + self.minor).next_up();
        let corner = Vec3::new(reach, self.minor, reach);
        Aabb { min: -corner, max: corner }
    }

    fn area(&self) -> f64 {
        // Pappus, over the part of the tube that is outside.
        let ((major, minor), skin) = (self.radii(), self.skin_angle());
        2.0 * TAU * minor * (major * skin + minor * if skin < PI { skin.sin() } else { 0.0 })
    }

    fn sample(&self, u: Vec2) -> Option<AreaSample> {
        let area = self.area();
        if area <= 0.0 {
            return None;
        }
        // A piece of the tube weighs as much as it is far from the axis: invert the integral of R + r cos.
        let ((major, minor), skin) = (self.radii(), self.skin_angle());
        let integral = |angle: f64| major * angle + minor * angle.sin();
        let wanted = (2.0 * f64::from(u.y) - 1.0) * integral(skin);
        let angle = bracketed_root(-skin, skin, true, |angle| {
            (integral(angle) - wanted, major + minor * angle.cos())
        });
        let (sin, cos) = angle.sin_cos();
        let radial = Radial::at(u.x);
        Some(AreaSample {
            p: radial.point(major + minor * cos, minor * sin),
            p_err: shape_point(major + minor),
            ng: radial.point(cos, sin),
            uv: Vec2::new(u.x, (angle / TAU + 0.5) as f32),
            pdf: 1.0 / area,
        })
    }
}
