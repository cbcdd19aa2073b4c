//! How much light rough boundaries reflect, once, for any curve of reflectance over the angle.

use super::axis::{curve_width, grazing_axis, width_axis};
use super::chebyshev::{sums, weights};
use super::curve::Curve;
use super::folded::{
    ANGLE_SERIES, LOST_SERIES, MOST_WIDTH, STEEP_NODES, STEEPS, WIDE_WEIGHTS, wide_directions,
};
use super::means::curve_means;
use super::profile::{Profile, Spot, hemisphere_mean};
use super::stored::{COS, CURVE, DRAWN_ANGLES, DRAWN_OUT, STRENGTH, TURN, Table, WIDTH};
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
    /// Cosine of the angle to the normal, on either side.
    pub(super) cos: f32,
}

impl Reflection {
    /// Of facets; `None` for a mirror.
    pub(crate) fn of(ggx: Option<Ggx>) -> Self {
        let Some(ggx) = ggx else {
            let none = Profile::new(None, |_| 1.0, |_, _| 0.0);
            return Self { ggx, lost: none, lost_mean: f32::MIN_POSITIVE };
        };
        let lost = if ggx.is_isotropic() {
            Profile::from_series(LOST_SERIES.at(ggx.mean_alpha()))
        } else {
            let rows = drawn_out::<{ TURN * COS }>(&ggx, DRAWN_OUT);
            Profile::new(Some(&ggx), |w| ggx.width_along(w), |_, [turn, c]| rows[turn * COS + c])
        };
        let mut reflection = Self { ggx: Some(ggx), lost, lost_mean: 0.0 };
        let mean = if ggx.is_isotropic() {
            let (places, weights) = steep_places(ggx.mean_alpha());
            let lost = sums(reflection.lost.series(), &places);
            lost.into_iter().zip(weights).map(|(lost, weight)| weight * lost.clamp(0.0, 1.0)).sum()
        } else {
            hemisphere_mean(Some(&ggx), |w| ggx.width_along(w), |w| reflection.lost_at(w))
        };
        reflection.lost_mean = mean.max(f32::MIN_POSITIVE);
        reflection
    }

    /// Where a direction lies.
    #[inline]
    pub(crate) fn place(&self, w: Vec3) -> Place {
        let ggx = self.ggx.as_ref();
        Place {
            steep: Spot::new(ggx, self.steep_width(w), w),
            wide: Spot::new(ggx, self.wide_width(w), w),
            cos: w.z.abs().min(1.0),
        }
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
            return CurveSeen(Profile::from_series(curve.fold(&ANGLE_SERIES.at(ggx.mean_alpha()))));
        }
        let rows = drawn_out::<{ TURN * COS * CURVE }>(ggx, DRAWN_ANGLES);
        let value = |_, [turn, c]: [usize; 2]| curve.sum(&rows[(turn * COS + c) * CURVE..][..CURVE]);
        CurveSeen(Profile::new(Some(ggx), |w| self.wide_width(w), value))
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

    /// The mean over the hemisphere, weighted by the cosine, of what depends on a direction as covers and curves of reflectance
    /// do.
    pub(crate) fn mean_around(&self, value: impl Fn(Vec3) -> Rgb) -> Rgb {
        if let Some(ggx) = self.drawn_out() {
            return hemisphere_mean(Some(ggx), |w| self.steep_width(w).min(MOST_WIDTH), value);
        }
        let alpha = self.ggx.map_or(0.0, |ggx| ggx.mean_alpha());
        let nodes = wide_directions(alpha).into_iter().zip(WIDE_WEIGHTS.at(alpha));
        nodes.map(|(w, weight)| weight * value(w)).sum()
    }

    /// The same of what depends on a direction as the losses of facets do.
    pub(crate) fn mean_of_losses(&self, value: impl Fn(Vec3) -> Rgb) -> Rgb {
        let Some(ggx) = &self.ggx else { return Rgb::ZERO };
        if self.drawn_out().is_some() {
            return hemisphere_mean(Some(ggx), |w| ggx.width_along(w), value);
        }
        let (cosines, weights) = steep_nodes(ggx.mean_alpha());
        let nodes = cosines.into_iter().zip(weights);
        nodes
            .map(|(cos, weight)| weight * value(Vec3::new((1.0 - cos * cos).max(0.0).sqrt(), 0.0, cos)))
            .sum()
    }

    /// The same of a profile over the axis of grazing angles.
    pub(crate) fn mean_of_profile(&self, profile: &Profile<Rgb>) -> Rgb {
        let Some(ggx) = self.ggx.as_ref().filter(|ggx| ggx.is_isotropic()) else {
            return self.mean_of_losses(|w| profile.at(self.place(w).steep).max(Rgb::ZERO));
        };
        let (places, weights) = steep_places(ggx.mean_alpha());
        Rgb::from_array([0, 1, 2].map(|channel| {
            let series = profile.series().map(|coefficient| coefficient[channel]);
            sums(&series, &places)
                .into_iter()
                .zip(weights)
                .map(|(value, weight)| weight * value.max(0.0))
                .sum()
        }))
    }

    /// The facets, where they are not the same in all directions.
    fn drawn_out(&self) -> Option<&Ggx> {
        self.ggx.as_ref().filter(|ggx| !ggx.is_isotropic())
    }

    /// The facets; `None` for a mirror.
    pub(super) fn ggx(&self) -> Option<&Ggx> {
        self.ggx.as_ref()
    }
}

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

/// Cosines and weights of means over the hemisphere, for facets that are the same in all directions.
fn steep_nodes(alpha: f32) -> ([f32; STEEPS], [f32; STEEPS]) {
    let numbers = STEEP_NODES.at(alpha);
    let part = |start: usize| std::array::from_fn(|k| numbers[start + k]);
    (part(0), part(STEEPS))
}

/// The same with places on the axis of grazing angles.
fn steep_places(alpha: f32) -> ([f32; STEEPS], [f32; STEEPS]) {
    let (cosines, weights) = steep_nodes(alpha);
    (cosines.map(|cos| grazing_axis(cos, alpha)), weights)
}

/// Numbers for these widths, by turn and cosine.
fn drawn_out<const N: usize>(ggx: &Ggx, table: Table) -> [f32; N] {
    let mut sums = [0.0; N];
    for (w, at_width) in weights::<WIDTH>(width_axis(ggx.alpha().y)).into_iter().enumerate() {
        for (s, at_strength) in weights::<STRENGTH>(ggx.strength()).into_iter().enumerate() {
            table.add((w * STRENGTH + s) * N, at_width * at_strength, &mut sums);
        }
    }
    sums
}
