//! The surface for one viewer: the shares of its lobes, their sum, and draws from their mixture.

use super::StandardBsdf;
use super::base::Passage;
use super::fill::Sides;
use crate::bsdf::fresnel::refraction;
use crate::bsdf::glass::{Bend, refract, sample_bend};
use crate::bsdf::reflect::{Facet, mirrored, mirrored_down, sample_facet};
use crate::bsdf::{BsdfSample, Event};
use glam::{Vec2, Vec3};
use heliostat_geometry::warp;
use heliostat_scene::Rgb;

/// Ways of drawing a direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Way {
    /// Reflected by the coat.
    Coat,
    /// Anywhere above: fibres have no lobe.
    Fibres,
    /// Reflected by facets of the base.
    Reflected,
    /// Through the base.
    Passed,
    /// By the cosine above.
    Up,
    /// By the cosine below.
    Down,
    /// In, to walk below the surface: by the cosine as well.
    Under,
}

pub(crate) const WAYS: [Way; 7] =
    [Way::Coat, Way::Fibres, Way::Reflected, Way::Passed, Way::Up, Way::Down, Way::Under];

/// A surface and who looks at it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View<'b> {
    bsdf: &'b StandardBsdf,
    wo: Vec3,
    /// Share of the light along `wo` that the cover lets pass.
    passed: f32,
    /// Probabilities of [`WAYS`]; they add up to 1, or to 0 for a black surface.
    shares: [f32; WAYS.len()],
}

impl<'b> View<'b> {
    pub(crate) fn new(bsdf: &'b StandardBsdf, wo: Vec3) -> Self {
        let passed = bsdf.cover.passed(wo);
        let Sides { up, down } = bsdf.fill.albedo(&bsdf.cover, wo);
        let coat = bsdf.cover.coat.map_or(0.0, |coat| coat.share(wo));
        let fibres = bsdf.cover.fibres.map_or(0.0, |fibres| bsdf.cover.coat_passed(wo) * fibres.kept(wo));
        let reflected = passed * bright(bsdf.reflected_about(wo));
        let through = passed * bright(bsdf.passed_about(wo));
        let under = bright(bsdf.fill.under(&bsdf.cover, wo).0);
        let weights = [coat, fibres, reflected, through, bright(up), bright(down), under];
        let sum: f32 = weights.iter().sum();
        let shares = if sum > 0.0 { weights.map(|weight| weight / sum) } else { [0.0; WAYS.len()] };
        Self { bsdf, wo, passed, shares }
    }

    /// Whether light is scattered into more than a few directions.
    pub(crate) fn scatters(&self) -> bool {
        let StandardBsdf { cover, base, fill } = self.bsdf;
        let is_rough = base.ggx.is_some() || cover.fibres.is_some();
        is_rough || cover.coat.is_some_and(|coat| coat.ggx.is_some()) || !fill.is_empty()
    }

    /// Whether anything from below is drawn.
    pub(crate) fn is_open(&self) -> bool {
        self.share(Way::Passed) > 0.0 || self.share(Way::Down) > 0.0
    }

    /// The share of the light that goes through without a bend.
    pub(crate) fn straight(&self) -> Rgb {
        let base = &self.bsdf.base;
        match (base.passage, base.ggx) {
            (Passage::Sheet, None) => self.passed * base.passed(self.wo.z.min(1.0)),
            _ => Rgb::ZERO,
        }
    }

    /// About the share of light from all around that goes to the viewer.
    pub(crate) fn albedo(&self) -> Rgb {
        let (StandardBsdf { cover, base, fill }, wo) = (self.bsdf, self.wo);
        let coat = cover.coat.map_or(0.0, |coat| coat.share(wo));
        let fibres = cover.fibres.map_or(Rgb::ZERO, |fibres| cover.coat_passed(wo) * fibres.albedo(wo));
        let Sides { up, down } = fill.albedo(cover, wo);
        let facets = self.passed * (base.reflected(wo.z) + base.passed(wo.z));
        let (under, color) = fill.under(cover, self.wo);
        (facets + fibres + up + down + under * color + coat).min(Rgb::ONE)
    }

    /// Probability of a way.
    pub(crate) fn share(&self, way: Way) -> f32 {
        self.shares[way as usize]
    }

    /// The value, and the density of `wi` in the mixture, both without mirrors and clear glass.
    pub(crate) fn answer(&self, wi: Vec3) -> (Rgb, f32) {
        let is_seen = self.wo.z > 0.0 && wi.z != 0.0;
        match is_seen {
            false => (Rgb::ZERO, 0.0),
            true if wi.z > 0.0 => self.answer_above(wi),
            true => self.answer_below(wi),
        }
    }

    fn answer_above(&self, wi: Vec3) -> (Rgb, f32) {
        let (bsdf, wo) = (self.bsdf, self.wo);
        let cover = &bsdf.cover;
        let mut value = bsdf.fill.value(cover, wo, wi);
        let mut pdf = self.share(Way::Up) * warp::cosine_hemisphere_pdf(wi);
        if let Some(coat) = &cover.coat {
            value += Rgb::splat(coat.value(wo, wi));
            pdf += self.share(Way::Coat) * coat.pdf(wo, wi);
        }
        if let Some(fibres) = &cover.fibres {
            value += cover.coat_passed(wo).min(cover.coat_passed(wi)) * fibres.value(wo, wi);
            pdf += self.share(Way::Fibres) * warp::hemisphere_pdf(wi);
        }
        if let (Some(ggx), Some(facet)) = (&bsdf.base.ggx, Facet::between(wo, wi)) {
            let passed = self.passed.min(cover.passed(wi));
            value += passed * facet.value(ggx, wo, wi) * bsdf.base.reflected(facet.cos);
            pdf += self.share(Way::Reflected) * facet.pdf(ggx, wo);
        }
        (value, pdf)
    }

    fn answer_below(&self, wi: Vec3) -> (Rgb, f32) {
        let (bsdf, wo) = (self.bsdf, self.wo);
        let mut value = bsdf.fill.value(&bsdf.cover, wo, wi);
        let mut pdf = self.share(Way::Down) * warp::cosine_hemisphere_pdf(-wi);
        let Some(ggx) = &bsdf.base.ggx else { return (value, pdf) };
        let share = self.share(Way::Passed);
        match bsdf.base.passage {
            Passage::Closed | Passage::Straight => {}
            Passage::Sheet => {
                let above = mirrored_down(wi);
                if let Some(facet) = Facet::between(wo, above) {
                    let passed = self.passed.min(bsdf.cover.passed(above));
                    value += passed * facet.value(ggx, wo, above) * bsdf.base.passed(facet.cos);
                    pdf += share * facet.pdf(ggx, wo);
                }
            }
            Passage::Bent => {
                for (eta, color) in bsdf.base.clear.rays() {
                    if let Some(bend) = Bend::between(wo, wi, eta) {
                        let through = color * bsdf.base.passed(bend.cos);
                        value += self.passed * bend.value(ggx, wo, wi) * through;
                        pdf += share * bsdf.base.clear.ray_share() * bend.pdf(ggx, wo);
                    }
                }
            }
        }
        (value, pdf)
    }

    /// Draws a direction: `u.z` says which way, the rest where; `None` where the numbers lead nowhere, for which light is 0.
    ///
    /// With dispersion smooth glass picks one channel: the weight of the others is 0 and that of this one three times as
    /// large, so that a weight with a single channel tells that the path has taken the way of one colour.
    pub(crate) fn sample(&self, u: Vec3) -> Option<BsdfSample> {
        if self.wo.z <= 0.0 {
            return None;
        }
        let (way, rest) = self.choose(u.z)?;
        self.draw(way, rest, u.truncate())
    }

    /// Draws a direction by one of the ways; `rest` and `at` are numbers in `[0, 1)`.
    pub(crate) fn draw(&self, way: Way, rest: f32, at: Vec2) -> Option<BsdfSample> {
        let (bsdf, wo) = (self.bsdf, self.wo);
        let (wi, event) = match way {
            Way::Coat => {
                let coat = bsdf.cover.coat.as_ref()?;
                let local = coat.local(wo);
                let Some(ggx) = &coat.ggx else {
                    let weight = Rgb::splat(coat.smooth(wo));
                    return self.delta(way, coat.world(mirrored(local)), weight, Event::Glossy);
                };
                let wi = coat.world(sample_facet(ggx, local, at)?);
                ((wi.z > 0.0).then_some(wi)?, Event::Glossy)
            }
            Way::Fibres => (warp::square_to_hemisphere(at), Event::Diffuse),
            Way::Reflected => match &bsdf.base.ggx {
                Some(ggx) => (sample_facet(ggx, wo, at)?, Event::Glossy),
                None => {
                    let weight = self.passed * bsdf.base.reflected(wo.z.min(1.0));
                    return self.delta(way, mirrored(wo), weight, Event::Glossy);
                }
            },
            Way::Passed => match self.sample_through(at, rest)? {
                Through::Rough(wi) => (wi, Event::Transmission),
                Through::Smooth(wi, weight) => return self.delta(way, wi, weight, Event::Transmission),
            },
            Way::Up => (warp::square_to_cosine_hemisphere(at), Event::Diffuse),
            Way::Under => {
                let wi = mirrored_down(warp::square_to_cosine_hemisphere(at));
                let weight = bsdf.fill.under(&bsdf.cover, wo).0;
                return self.delta(way, wi, weight, Event::Subsurface);
            }
            Way::Down => (mirrored_down(warp::square_to_cosine_hemisphere(at)), Event::Diffuse),
        };
        let (value, pdf) = self.answer(wi);
        (pdf > 0.0).then(|| BsdfSample { wi, weight: value / pdf, pdf, event })
    }

    fn sample_through(&self, at: Vec2, rest: f32) -> Option<Through> {
        let (base, wo) = (&self.bsdf.base, self.wo);
        let cos = wo.z.min(1.0);
        if base.passage == Passage::Sheet {
            let Some(ggx) = &base.ggx else {
                return Some(Through::Smooth(-wo, self.passed * base.passed(cos)));
            };
            return sample_facet(ggx, wo, at).map(|wi| Through::Rough(mirrored_down(wi)));
        }
        let (eta, color) = base.clear.ray(rest);
        if let (Some(ggx), Passage::Bent) = (&base.ggx, base.passage) {
            return sample_bend(ggx, wo, eta, at).map(Through::Rough);
        }
        let weight = self.passed * color * self.bsdf.smooth_passed(wo) / base.clear.ray_share();
        let wi = refract(wo, Vec3::Z, cos, refraction(cos, eta).cos, eta).normalize_or_zero();
        (wi.z < 0.0).then_some(Through::Smooth(wi, weight))
    }

    /// A direction that is the only one of its way.
    fn delta(&self, way: Way, wi: Vec3, weight: Rgb, event: Event) -> Option<BsdfSample> {
        let share = self.share(way);
        let is_seen = weight.max_element() > 0.0 && (wi.z > 0.0) == (event == Event::Glossy);
        is_seen.then(|| BsdfSample { wi, weight: weight / share, pdf: f32::INFINITY, event })
    }

    /// The way that `u` in `[0, 1)` falls on, and where within it, again in `[0, 1)`.
    fn choose(&self, u: f32) -> Option<(Way, f32)> {
        let mut left = u;
        let mut last = None;
        for (way, share) in WAYS.into_iter().zip(self.shares).filter(|(_, share)| *share > 0.0) {
            if left < share {
                return Some((way, left / share));
            }
            left -= share;
            last = Some((way, 0.0));
        }
        // Rounding of the sum of the shares.
        last
    }
}

/// A direction through the surface.
enum Through {
    Rough(Vec3),
    /// The only one, with its weight.
    Smooth(Vec3, Rgb),
}

/// The mean of the channels.
fn bright(color: Rgb) -> f32 {
    color.element_sum() / 3.0
}
