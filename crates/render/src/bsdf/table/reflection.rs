//! How much light rough boundaries reflect, once, for any curve of reflectance over the angle.

use super::axis::{curve_width, grazing_axis, width_axis};
use super::chebyshev::{nodes, weights};
use super::curve::Curve;
use super::means::curve_means;
use super::profile::{Profile, Spot, hemisphere_mean};
use super::stored::{ANGLES, COS, CURVE, DRAWN_OUT, FINE_WIDTH, LOST, LOWER, LOWERS, STRENGTH, TURN, WIDTH};
use crate::bsdf::ggx::Ggx;
use glam::Vec3;
use heliostat_scene::Rgb;

/// What is known of reflection by one distribution of facets.
#[derive(Clone, Debug)]
pub(crate) struct Reflection {
    /// `None` for a mirror.
    ggx: Option<Ggx>,
    lost: Profile<f32>,
    lost_mean: f32,
}

/// The mean of a curve of reflectance over the facets whose light gets away to a viewer, by the viewer's direction.
#[derive(Clone, Debug)]
pub(crate) struct CurveSeen(Profile<Rgb>);

/// A direction at these facets.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// For what facets lose, and for curves of reflectance.
    pub(crate) steep: Spot,
    pub(crate) wide: Spot,
}

impl Reflection {
    /// Of facets; `None` for a mirror.
    pub(crate) fn of(ggx: Option<Ggx>) -> Self {
        let Some(ggx) = ggx else {
            let none = Profile::new(None, |_| 1.0, |_, _| 0.0);
            return Self { ggx, lost: none, lost_mean: f32::MIN_POSITIVE };
        };
        let lost = if ggx.is_isotropic() {
            let row: [f32; COS] = LOST.at::<WIDTH, COS>(width_axis(ggx.mean_alpha()));
            Profile::new(Some(&ggx), |_| ggx.mean_alpha(), |_, [_, c]| row[c])
        } else {
            let rows = drawn_out(&ggx);
            Profile::new(Some(&ggx), |w| ggx.width_along(w), |_, [turn, c]| rows[turn * COS + c])
        };
        let mut reflection = Self { ggx: Some(ggx), lost, lost_mean: 0.0 };
        let mean = hemisphere_mean(Some(&ggx), |w| ggx.width_along(w), |w| reflection.lost_at(w));
        reflection.lost_mean = mean.max(f32::MIN_POSITIVE);
        reflection
    }

    /// Where a direction lies.
    #[inline]
    pub(crate) fn place(&self, w: Vec3) -> Place {
        let ggx = self.ggx.as_ref();
        Place { steep: Spot::new(ggx, self.steep_width(w), w), wide: Spot::new(ggx, self.wide_width(w), w) }
    }

    fn steep_width(&self, w: Vec3) -> f32 {
        self.ggx.as_ref().map_or(1.0, |ggx| ggx.width_along(w))
    }

    fn wide_width(&self, w: Vec3) -> f32 {
        curve_width(self.ggx.as_ref().map_or(0.0, |ggx| ggx.width_along(w)))
    }

    /// Share of the light that facets which reflect all keep at first, and throw at each other, for a viewer there.
    #[inline]
    pub(crate) fn lost(&self, place: &Place) -> f32 {
        if self.ggx.is_some() { self.lost.at(place.steep).clamp(0.0, 1.0) } else { 0.0 }
    }

    fn lost_at(&self, w: Vec3) -> f32 {
        self.lost(&self.place(w))
    }

    /// The mean of [`Self::lost`] over the hemisphere, weighted by the cosine; above 0.
    pub(crate) fn lost_mean(&self) -> f32 {
        self.lost_mean
    }

    /// A curve of reflectance seen through the facets.
    pub(crate) fn seen(&self, curve: &Curve) -> CurveSeen {
        let Some(ggx) = &self.ggx else {
            let width = curve_width(0.0);
            return CurveSeen(Profile::new(
                None,
                |_| width,
                |w, _| curve.sum(&super::curve::curve_weights(w.z)),
            ));
        };
        if ggx.is_isotropic() {
            // The nodes of the table are those of the series.
            let rows: [f32; COS * CURVE] = ANGLES.at::<FINE_WIDTH, _>(width_axis(ggx.mean_alpha()));
            let width = self.wide_width(Vec3::X);
            let value = |_, [_, c]: [usize; 2]| curve.sum(&rows[c * CURVE..][..CURVE]);
            return CurveSeen(Profile::new(Some(ggx), |_| width, value));
        }
        let mut plane = [[Rgb::ZERO; COS]; FINE_WIDTH];
        for (k, weights) in ANGLES.rows::<CURVE>().enumerate() {
            plane[k / COS][k % COS] = curve.sum(&weights);
        }
        CurveSeen(Profile::new(
            Some(ggx),
            |w| self.wide_width(w),
            |w, _| plane_at(&plane, ggx.alike(w), curve_width(ggx.alike(w)), w),
        ))
    }

    /// Of white light, what facets send to a viewer from more grazing directions and what a cover stops of it, because it lets
    /// the smaller of what passes along either direction: by the direction of the viewer.
    pub(crate) fn stopped(&self, passed: impl Fn(Vec3) -> f32) -> Profile<f32> {
        let Some(ggx) = &self.ggx else { return Profile::new(None, |_| 1.0, |_, _| 0.0) };
        let mut plane = [[[0.0; LOWER]; COS]; WIDTH];
        for (k, weights) in LOWERS.rows::<LOWER>().enumerate() {
            plane[k / COS][k % COS] = weights;
        }
        let stopped = |w: Vec3, _| {
            let alpha = ggx.alike(w);
            let here = passed(w);
            let flat = w.truncate().normalize_or(ggx.tangent());
            let steps = const { nodes::<LOWER>() }.map(|lower| {
                let cos = w.z * (1.0 - lower);
                (here - passed(((1.0 - cos * cos).sqrt() * flat).extend(cos))).max(0.0)
            });
            let mut sum = 0.0;
            for (row, at_width) in plane.iter().zip(weights::<WIDTH>(width_axis(alpha))) {
                for (node, at_cos) in row.iter().zip(weights::<COS>(grazing_axis(w.z, alpha))) {
                    let light: f32 = node.iter().zip(steps).map(|(a, b)| a * b).sum();
                    sum += at_width * at_cos * light;
                }
            }
            sum.max(0.0)
        };
        Profile::new(Some(ggx), |w| ggx.width_along(w), stopped)
    }

    /// What is left, per unit of light that facets keep at first, of the light that they throw at each other until it leaves.
    ///
    /// # Source
    /// Kulla, Conty, "Revisiting Physically Based Shading at Imageworks", 2017, pages 11 to 18; with the factor of Hill, "A
    /// Multi-Faceted Exploration", 2018, for light that has met two facets at least.
    pub(crate) fn between(&self, curve: &Curve) -> Rgb {
        let (mean, lost) = (curve.cosine_mean(), self.lost_mean());
        mean * mean * (1.0 - lost) / (Rgb::ONE - mean * lost)
    }

    /// The mean over the hemisphere, weighted by the cosine, of what a boundary with that curve lets through, with what comes
    /// `between` of light that facets throw at each other; `None` where that has to be summed up.
    pub(crate) fn passed_mean(&self, curve: &Curve, between: Rgb) -> Option<Rgb> {
        let reflected = match &self.ggx {
            None => curve.cosine_mean(),
            Some(ggx) if ggx.is_isotropic() => {
                curve.sum(&curve_means(ggx.mean_alpha())) + between * self.lost_mean
            }
            Some(_) => return None,
        };
        Some((Rgb::ONE - reflected).clamp(Rgb::ZERO, Rgb::ONE))
    }

    /// The mean over the hemisphere, weighted by the cosine, of what depends on a direction as the facets do, and on covers.
    pub(crate) fn mean_around(&self, value: impl Fn(Vec3) -> Rgb) -> Rgb {
        hemisphere_mean(self.ggx.as_ref(), |w| self.steep_width(w).min(MOST_WIDTH), value)
    }
}

/// The largest width for means of what depends on covers too: these change over tenths.
const MOST_WIDTH: f32 = 0.1;

impl CurveSeen {
    /// The mean of what need not be a reflectance.
    pub(super) fn weight_at(&self, place: &Place) -> Rgb {
        self.0.at(place.wide)
    }

    /// The mean at a place.
    #[inline]
    pub(crate) fn at(&self, place: &Place) -> Rgb {
        self.0.at(place.wide).clamp(Rgb::ZERO, Rgb::ONE)
    }
}

/// The value between nodes of the width and of the cosine, on the axis for `width`.
pub(super) fn plane_at<const W: usize>(plane: &[[Rgb; COS]; W], alpha: f32, width: f32, w: Vec3) -> Rgb {
    let at_cos = weights::<COS>(grazing_axis(w.z.abs().min(1.0), width));
    let mut sum = Rgb::ZERO;
    for (row, at_width) in plane.iter().zip(weights::<W>(width_axis(alpha))) {
        let value: Rgb = row.iter().zip(at_cos).map(|(&value, weight)| value * weight).sum();
        sum += at_width * value;
    }
    sum
}

/// Values of [`DRAWN_OUT`] for these widths, by turn and cosine.
fn drawn_out(ggx: &Ggx) -> [f32; TURN * COS] {
    let mut sums = [0.0; TURN * COS];
    for (w, at_width) in weights::<WIDTH>(width_axis(ggx.alpha().y)).into_iter().enumerate() {
        for (s, at_strength) in weights::<STRENGTH>(ggx.strength()).into_iter().enumerate() {
            DRAWN_OUT.add((w * STRENGTH + s) * TURN * COS, at_width * at_strength, &mut sums);
        }
    }
    sums
}
