//! Many rays from one place against a sphere.

use super::Verdict;
use crate::lanes::{LANES, Lanes, mask, widest};
use crate::world::shadow_rays::ShadowRays;
use crate::world_sphere::WorldSphere;
use glam::Vec3;
use heliostat_geometry::error_bound::{gamma, gamma_f64, line_and_sphere};
use pulp::NullaryFnOnce;

/// Hits at which the discriminant is not so many times its error are in doubt: the cosine would have few digits.
const DIGITS: f32 = 64.0;

/// How the rays of a bundle run through a sphere.
#[derive(Clone, Copy, Debug)]
pub(in crate::world) struct Chords {
    pub(in crate::world) verdict: Verdict,
    /// Whether the rays start inside: those that meet the sphere do so once, else twice.
    pub(in crate::world) from_inside: bool,
    /// Squared cosine of the angle between ray and normal, the same on both sides.
    pub(in crate::world) cos_squared: Lanes,
    /// Way inside, in metres, where there is a hit.
    pub(in crate::world) way: Lanes,
}

/// The work of [`Chords::new`].
struct Meet<'a> {
    rays: &'a ShadowRays<'a>,
    /// From the start of the rays to the centre.
    to_centre: Vec3,
    radius_squared: f32,
    /// The power of the start: squared distance from the centre minus squared radius.
    power: f32,
    /// Bound of the error of the discriminant per squared length of a ray.
    error: f32,
}

impl Chords {
    /// `None` for rays that start so near to the surface that numbers cannot tell on which side.
    #[inline]
    pub(in crate::world) fn new(sphere: &WorldSphere, rays: &ShadowRays<'_>) -> Option<Self> {
        let to_centre = sphere.centre - rays.start.origin().as_dvec3();
        let (distance_squared, radius_squared) = (to_centre.length_squared(), sphere.radius * sphere.radius);
        let power = distance_squared - radius_squared;
        if power.abs() <= gamma_f64(256) * (distance_squared + radius_squared) {
            return None;
        }
        Some(widest(Meet {
            rays,
            to_centre: to_centre.as_vec3(),
            radius_squared: radius_squared as f32,
            power: power as f32,
            error: line_and_sphere(distance_squared.sqrt() as f32, sphere.radius as f32),
        }))
    }
}

impl NullaryFnOnce for Meet<'_> {
    type Output = Chords;

    #[inline(always)]
    fn call(self) -> Chords {
        let Self { rays, to_centre, radius_squared, power, error } = self;
        let (reach, from_inside) = (to_centre.length(), power < 0.0);
        let (mut cos_squared, mut way) = ([0.0; LANES], [0.0; LANES]);
        // 1 where the ray meets the sphere, -1 where it does not, 0 where that is in doubt.
        let mut meets: Lanes = [0.0; LANES];
        for i in 0..LANES {
            let dir = rays.targets.get(i) - rays.start.origin();
            let dir_squared = dir.length_squared();
            let length = dir_squared.sqrt();

            // Half the chord of the whole line, squared, in the form in which nothing cancels; see `Sphere`.
            let along = to_centre.dot(dir);
            let discriminant = radius_squared * dir_squared - to_centre.cross(dir).length_squared();
            let slack = error * dir_squared;
            let is_chord = discriminant > DIGITS * slack;

            // Whether the middle of the chord lies between both ends, and whether the end lies outside.
            let (before, after) = (along, dir_squared - along);
            let middle_slack = gamma(8) * length * (length + reach);
            let end_power = power + dir_squared - 2.0 * along;
            let is_end_outside =
                end_power > gamma(16) * (radius_squared + (reach + length) * (reach + length));

            let crosses = is_chord & (before > middle_slack) & (after > middle_slack) & is_end_outside;
            let passes = (discriminant < -slack)
                | (before < -middle_slack)
                | ((after < -middle_slack) & is_end_outside);
            let from_outside = if crosses {
                1.0
            } else if passes {
                -1.0
            } else {
                0.0
            };
            // Every way out leads through the surface.
            let outwards = if is_chord & is_end_outside { 1.0 } else { 0.0 };
            meets[i] = if from_inside { outwards } else { from_outside };

            cos_squared[i] = discriminant / (radius_squared * dir_squared);
            let half = discriminant.max(0.0).sqrt();
            way[i] = (if from_inside { along + half } else { 2.0 * half }) / length;
        }
        let verdict = Verdict { hit: mask(|i| meets[i] > 0.0), doubt: mask(|i| meets[i] == 0.0) };
        Chords { verdict, from_inside, cos_squared, way }
    }
}
