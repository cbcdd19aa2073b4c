//! Lights from one point or one direction: point, spot and directional light.

use super::choice::Reach;
use super::cluster::{self, Cluster};
use super::{LightSample, Target, Use};
use crate::medium::flight::Way;
use glam::{Vec2, Vec3};
use heliostat_geometry::warp::{cone_pdf, square_to_cone};
use heliostat_geometry::{Aabb, OrthonormalFrame};
use heliostat_scene::color::luminance;
use heliostat_scene::light::Falloff;
use heliostat_scene::{Profile, Rgb};
use std::f32::consts::{FRAC_PI_2, FRAC_PI_4, PI};
use std::sync::Arc;

/// A point light, with a cone if it is a spot, or as a lamp was measured.
#[derive(Debug)]
pub(super) struct PointLight {
    intensity: Rgb,
    position: Vec3,
    falloff: Falloff,
    spread: Spread,
}

/// How much of the light goes where.
#[derive(Debug)]
enum Spread {
    Even,
    Cone(Cone),
    /// In a frame whose z is the axis.
    Measured(OrthonormalFrame, Arc<Profile>),
}

/// Where a spot shines.
#[derive(Debug)]
struct Cone {
    axis: Vec3,
    cos_inner: f32,
    cos_outer: f32,
}

impl Cone {
    /// The part of a way inside of a cone below a right angle with its tip there; ends before it begins where there is none.
    ///
    /// # Source
    /// With `v` the way from the tip, a point is inside where `v . axis >= cos |v|`: squared, that is a quadratic equation.
    fn clip(&self, way: &Way, tip: Vec3) -> Way {
        let (to_origin, cos_squared) = (way.origin - tip, self.cos_outer * self.cos_outer);
        let (height, rise) = (to_origin.dot(self.axis), way.dir.dot(self.axis));
        let a = rise * rise - cos_squared;
        let b = height * rise - cos_squared * to_origin.dot(way.dir);
        let c = height * height - cos_squared * to_origin.length_squared();
        let none = Way { to: way.from, ..*way };
        let root = (b * b - a * c).max(0.0).sqrt();
        let (p, q) = ((-b - root) / a, (-b + root) / a);
        let (first, last) = (p.min(q), p.max(q));
        // A way that is steeper than the cone is inside from where it comes in on the side of the light; others pass through.
        let (from, to) = match a > 0.0 {
            true if rise > 0.0 => (last, f32::INFINITY),
            true => (f32::NEG_INFINITY, first),
            false if b * b < a * c || height + 0.5 * (first + last) * rise < 0.0 => return none,
            false => (first, last),
        };
        let (from, to) = (way.from.max(from), way.to.min(to));
        if from < to { Way { from, to, ..*way } } else { none }
    }
}

impl PointLight {
    pub(super) fn new(intensity: Rgb, position: Vec3, falloff: Falloff) -> Self {
        Self { intensity, position, falloff, spread: Spread::Even }
    }

    /// The same light, full within `inner` radians of `axis` and gone at `outer`.
    pub(super) fn into_cone(self, axis: Vec3, inner: f32, outer: f32) -> Self {
        let (cos_inner, cos_outer) = (inner.clamp(0.0, PI).cos(), outer.clamp(0.0, PI).cos());
        Self { spread: Spread::Cone(Cone { axis, cos_inner, cos_outer }), ..self }
    }

    /// The same light with the intensities of a profile around `axis`, turned so that `across` is its zero.
    pub(super) fn into_measured(self, axis: Vec3, across: Vec3, profile: Arc<Profile>) -> Self {
        let z = axis.normalize_or(Vec3::NEG_Y);
        let frame = match (across - across.dot(z) * z).try_normalize() {
            Some(x) => OrthonormalFrame { x, y: z.cross(x), z },
            None => OrthonormalFrame::around(z),
        };
        Self { spread: Spread::Measured(frame, profile), ..self }
    }

    /// What a choice among lights has to know of it.
    pub(super) fn reach(&self) -> Reach {
        let peak = match &self.spread {
            Spread::Measured(_, profile) => profile.peak(),
            Spread::Even | Spread::Cone(_) => 1.0,
        };
        let intensity = peak * luminance(self.intensity);
        if self.falloff == Falloff::None {
            return Reach::Far(intensity);
        }
        let bounds = Aabb { min: self.position, max: self.position };
        let (normals, spread) = match &self.spread {
            Spread::Even => (cluster::Cone::ALL, FRAC_PI_2),
            Spread::Measured(frame, profile) => {
                let half = 0.5 * profile.reach();
                (cluster::Cone { axis: frame.z, angle: half }, half)
            }
            Spread::Cone(Cone { axis, cos_inner, cos_outer }) => {
                let inner = cos_inner.acos();
                (cluster::Cone { axis: *axis, angle: inner }, cos_outer.acos() - inner)
            }
        };
        Reach::Near(Cluster { bounds, intensity, normals, spread, two_sided: false })
    }

    #[inline]
    pub(super) fn sample(&self, p: Vec3) -> Option<LightSample> {
        let to_light = self.position - p;
        let distance_squared = to_light.length_squared();
        if distance_squared == 0.0 {
            return None;
        }
        let to_light = to_light / distance_squared.sqrt();
        let share = self.share(-to_light);
        if share == 0.0 {
            return None;
        }
        let weakened = match self.falloff {
            Falloff::InverseSquare => share / distance_squared,
            Falloff::None => share,
        };
        Some(LightSample {
            to_light,
            arriving: weakened * self.intensity,
            pdf: f32::INFINITY,
            target: Target::Point(self.position),
        })
    }
}

impl PointLight {
    /// Whether it weakens with the distance, as light does.
    pub(super) fn falls_off(&self) -> bool {
        self.falloff == Falloff::InverseSquare
    }

    pub(super) fn position(&self) -> Vec3 {
        self.position
    }

    /// What it sends in the unit direction `dir`, in W/sr.
    pub(super) fn intensity(&self, dir: Vec3) -> Rgb {
        self.share(dir) * self.intensity
    }

    /// The part of a way that may be lit: for a spot, what lies in its cone.
    pub(super) fn lit(&self, way: &Way) -> Way {
        match &self.spread {
            Spread::Cone(cone) if cone.cos_outer > 0.0 => cone.clip(way, self.position),
            Spread::Even | Spread::Cone(_) | Spread::Measured(..) => *way,
        }
    }

    /// The share of its intensity that it sends in the unit direction `dir`.
    #[inline]
    fn share(&self, dir: Vec3) -> f32 {
        match &self.spread {
            Spread::Even => 1.0,
            Spread::Cone(cone) => cone.share(dir),
            Spread::Measured(frame, profile) => {
                let dir = frame.to_local(dir);
                profile.intensity(dir.z.clamp(-1.0, 1.0).acos(), dir.y.atan2(dir.x))
            }
        }
    }
}

impl Cone {
    /// The share of the light that leaves in the unit direction `dir`: a smooth step over the cosine.
    fn share(&self, dir: Vec3) -> f32 {
        let cos = self.axis.dot(dir);
        if cos <= self.cos_outer {
            return 0.0;
        }
        if cos >= self.cos_inner {
            return 1.0;
        }
        let x = (cos - self.cos_outer) / (self.cos_inner - self.cos_outer);
        x * x * (3.0 - 2.0 * x)
    }
}

/// A light from infinitely far away, from one direction or from a disk in the sky.
#[derive(Debug)]
pub(super) struct DirectionalLight {
    intensity: Rgb,
    /// Around the direction to the light.
    frame: OrthonormalFrame,
    /// Half of the angle that the source covers.
    half_angle: f32,
    /// One over its solid angle; infinite for a single direction.
    pdf: f32,
}

impl DirectionalLight {
    /// `direction` is the way of the light; `angle` what the source covers from edge to edge.
    pub(super) fn new(intensity: Rgb, direction: Vec3, angle: f32, used: Use) -> Self {
        let half_angle = (0.5 * angle).min(PI);
        // What arrives is the mean over the source of radiance times cosine, and all of it to Whitted.
        let share = match used {
            Use::Recursion => 1.0,
            Use::Paths => 2.0 / (1.0 + half_angle.min(FRAC_PI_2).cos()),
        };
        Self {
            intensity: share * intensity,
            frame: OrthonormalFrame::around(-direction),
            half_angle,
            pdf: if half_angle > 0.0 { cone_pdf(half_angle) } else { f32::INFINITY },
        }
    }

    /// The radiance from a unit direction, and the density with which it is drawn; `None` beside the source.
    #[inline]
    pub(super) fn seen(&self, dir: Vec3) -> Option<(Rgb, f32)> {
        // Lengths of chords, which keep their digits where cosines are all 1.
        let is_inside = dir.distance_squared(self.frame.z) <= 4.0 * (0.5 * self.half_angle).sin().powi(2);
        (self.is_wide() && is_inside).then_some((self.pdf * self.intensity, self.pdf))
    }

    /// Whether it covers more than a point of the sky.
    pub(super) fn is_wide(&self) -> bool {
        self.half_angle > 0.0
    }

    /// What a choice among lights has to know of it.
    pub(super) fn reach(&self) -> Reach {
        Reach::Far(luminance(self.intensity))
    }

    /// A box that holds the whole source as seen from `p`, behind everything in the box `scene`.
    pub(super) fn bounds(&self, p: Vec3, scene: Aabb) -> Option<Aabb> {
        let away = (scene.min - p).abs().max((scene.max - p).abs()).length();
        let radius = away * self.half_angle.tan();
        if self.half_angle >= FRAC_PI_4 || !radius.is_finite() {
            return None;
        }
        // A ball at that distance which the cone of directions touches from inside: radius / distance is the tangent.
        let centre = p + away * self.frame.z;
        Some(Aabb { min: centre - radius, max: centre + radius })
    }

    #[inline]
    pub(super) fn sample(&self, u: Vec2) -> LightSample {
        let to_light = if self.is_wide() {
            self.frame.to_world(square_to_cone(u, self.half_angle))
        } else {
            self.frame.z
        };
        LightSample { to_light, arriving: self.intensity, pdf: self.pdf, target: Target::Sky }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::Sampler;
    use heliostat_geometry::warp::square_to_sphere;

    #[test]
    fn ways_are_clipped_to_what_a_spot_lights() {
        let (tip, n) = (Vec3::new(0.3, 2.0, -0.5), 4000);
        let mut lit = 0;
        for i in 0..n {
            let mut draws = Sampler::new(4, [0, 1], i);
            let (axis, dir) = (square_to_sphere(draws.next_2d()), square_to_sphere(draws.next_2d()));
            let outer = 0.05 + 1.4 * draws.next_1d();
            let lamp = PointLight::new(Rgb::ONE, tip, Falloff::InverseSquare).into_cone(axis, 0.0, outer);
            let origin = tip + 3.0 * draws.next_1d() * square_to_sphere(draws.next_2d());
            let way = Way { origin, dir, from: 0.5, to: 6.0 };
            let part = lamp.lit(&way);
            assert!(way.from <= part.from && part.to <= way.to);
            for k in 0..64 {
                let t = 0.5 + 5.5 * (k as f32 + 0.5) / 64.0;
                let cos = (way.at(t) - tip).normalize().dot(axis);
                // Rounding decides at the border.
                if (cos - outer.cos()).abs() > 1e-4 {
                    assert_eq!(part.from < t && t < part.to, cos > outer.cos(), "{i}: {t} in {part:?}");
                    lit += usize::from(cos > outer.cos());
                }
            }
        }
        assert!(lit > 1000, "{lit}");
    }
}
