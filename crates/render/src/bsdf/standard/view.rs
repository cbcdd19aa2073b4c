//! The surface for one viewer: the shares of its lobes, their sum, and draws from their mixture.

use super::StandardBsdf;
use super::base::Passage;
use super::fill::{Profiles, Sides};
use crate::bsdf::ggx::Ggx;
use crate::bsdf::glass::{Bend, bent};
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
    /// Reflected by facets of the base, or through them.
    Facets,
    /// Anywhere above, by the cosine or towards the horizon.
    Up,
    /// The same below.
    Down,
    /// In, to walk below the surface: by the cosine.
    Under,
}

pub(crate) const WAYS: [Way; 6] = [Way::Coat, Way::Fibres, Way::Facets, Way::Up, Way::Down, Way::Under];

/// A surface and who looks at it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View<'b> {
    bsdf: &'b StandardBsdf,
    wo: Vec3,
    /// What is the same for all directions of light.
    profiles: Profiles,
    /// Share of the light along `wo` that the cover lets pass.
    passed: f32,
    /// What the channels of the path carry.
    carried: Rgb,
    /// Probabilities of [`WAYS`]; they add up to 1, or to 0 for a black surface.
    shares: [f32; WAYS.len()],
}

impl<'b> View<'b> {
    pub(crate) fn new(bsdf: &'b StandardBsdf, wo: Vec3) -> Self {
        let profiles = bsdf.fill.profiles(&bsdf.cover, wo);
        let passed = profiles.cover;
        let Sides { up, down } = bsdf.fill.albedo(&profiles);
        let coat = bsdf.cover.coat.as_ref().map_or(0.0, |coat| coat.kept(wo));
        let fibres = bsdf.cover.fibres.map_or(0.0, |fibres| bsdf.cover.coat_passed(wo) * fibres.kept(wo));
        let facets = passed * bright(bsdf.reflected_about(wo) + bsdf.passed_about(wo));
        let under = bright(bsdf.fill.under(&bsdf.cover, wo).0);
        let weights = [coat, fibres, facets, bright(up), bright(down), under];
        let sum: f32 = weights.iter().sum();
        let shares = if sum > 0.0 { weights.map(|weight| weight / sum) } else { [0.0; WAYS.len()] };
        Self { bsdf, wo, profiles, passed, carried: Rgb::ONE, shares }
    }

    /// [`Self::sample`] for a path whose channels carry so much.
    #[inline]
    pub(crate) fn sample_for(&self, carried: Rgb, u: Vec3) -> Option<BsdfSample> {
        if self.bsdf.base.clear.is_dispersed { Self { carried, ..*self }.sample(u) } else { self.sample(u) }
    }

    /// Whether light is scattered into more than a few directions.
    pub(crate) fn scatters(&self) -> bool {
        let StandardBsdf { cover, base, fill } = self.bsdf;
        let is_rough = base.ggx.is_some() || cover.fibres.is_some();
        is_rough || cover.coat.as_ref().is_some_and(|coat| coat.ggx.is_some()) || !fill.is_empty()
    }

    /// See [`crate::bsdf::View::matte_pdf`].
    pub(crate) fn matte_pdf(&self, wi: Vec3) -> f32 {
        if wi.z > 0.0 {
            let fibres = self.share(Way::Fibres) * warp::hemisphere_pdf(wi);
            fibres + self.share(Way::Up) * self.bsdf.fill.up.pdf(wi.z)
        } else {
            self.share(Way::Down) * self.bsdf.fill.down.pdf(wi.z)
        }
    }

    /// Whether it sends light on from all around.
    pub(crate) fn is_matte(&self) -> bool {
        self.share(Way::Fibres) + self.share(Way::Up) + self.share(Way::Down) > 0.0
    }

    /// See [`crate::bsdf::View::breadth`].
    pub(crate) fn breadth(&self) -> f32 {
        let roughness = |ggx: Option<&Ggx>| ggx.map_or(0.0, |ggx| ggx.mean_alpha().min(1.0).sqrt());
        let coat = roughness(self.bsdf.cover.coat.as_ref().and_then(|coat| coat.ggx.as_ref()));
        let facets = roughness(self.bsdf.base.ggx.as_ref());
        let matte = self.share(Way::Fibres) + self.share(Way::Up) + self.share(Way::Down);
        matte + self.share(Way::Coat) * coat + self.share(Way::Facets) * facets
    }

    /// Whether anything from below is drawn.
    pub(crate) fn is_open(&self) -> bool {
        self.bsdf.base.passage != Passage::Closed || self.share(Way::Down) > 0.0
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
        let coat = cover.coat.as_ref().map_or(0.0, |coat| coat.kept(wo));
        let fibres = cover.fibres_albedo(wo);
        let Sides { up, down } = fill.albedo(&self.profiles);
        let facets = self.passed * (base.reflected(wo.z) + base.passed(wo.z));
        let (under, color) = fill.under(cover, self.wo);
        (facets + fibres + up + down + under * color + coat).min(Rgb::ONE)
    }

    /// Probability with which a way that leads anywhere goes towards the horizon.
    #[cfg(test)]
    pub(crate) fn low_chance(&self, way: Way) -> f32 {
        match way {
            Way::Up => self.bsdf.fill.up.low,
            Way::Down => self.bsdf.fill.down.low,
            Way::Coat | Way::Fibres | Way::Facets | Way::Under => 0.0,
        }
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
        let profiles = bsdf.fill.profiles(cover, wi);
        let mut value = bsdf.fill.value((wo, &self.profiles), (wi, &profiles));
        let mut pdf = self.share(Way::Up) * bsdf.fill.up.pdf(wi.z);
        if let Some(coat) = &cover.coat {
            value += Rgb::splat(coat.value(wo, wi));
            pdf += self.share(Way::Coat) * coat.pdf(wo, wi);
        }
        if cover.fibres.is_some() {
            value += cover.fibres_value(wo, wi);
            pdf += self.share(Way::Fibres) * warp::hemisphere_pdf(wi);
        }
        if let (Some(ggx), Some(facet)) = (&bsdf.base.ggx, Facet::between(wo, wi)) {
            let passed = self.passed.min(profiles.cover);
            let split = self.split(facet.cos);
            value += passed * facet.value(ggx, wo, wi) * split.reflected;
            pdf += self.share(Way::Facets) * split.chance * self.facet_pdf(ggx, &facet);
        }
        (value, pdf)
    }

    fn answer_below(&self, wi: Vec3) -> (Rgb, f32) {
        let (bsdf, wo) = (self.bsdf, self.wo);
        let profiles = bsdf.fill.profiles(&bsdf.cover, wi);
        let mut value = bsdf.fill.value((wo, &self.profiles), (wi, &profiles));
        let mut pdf = self.share(Way::Down) * bsdf.fill.down.pdf(wi.z);
        let Some(ggx) = &bsdf.base.ggx else { return (value, pdf) };
        let share = self.share(Way::Facets);
        match bsdf.base.passage {
            Passage::Closed | Passage::Straight => {}
            Passage::Sheet => {
                let above = mirrored_down(wi);
                if let Some(facet) = Facet::between(wo, above) {
                    let passed = self.passed.min(profiles.cover);
                    let split = self.split(facet.cos);
                    value += passed * facet.value(ggx, wo, above) * split.passed;
                    pdf += share * (1.0 - split.chance) * self.facet_pdf(ggx, &facet);
                }
            }
            Passage::Bent => {
                for (eta, color) in bsdf.base.clear.rays() {
                    if let Some(bend) = Bend::between(wo, wi, eta) {
                        let split = self.split(bend.cos);
                        value += self.passed * bend.value(ggx, wo, wi) * color * split.passed;
                        let ray_share = (1.0 - split.chance) * bsdf.base.clear.ray_share();
                        pdf += share * ray_share * bend.pdf(ggx, wo);
                    }
                }
            }
        }
        (value, pdf)
    }

    /// What a facet at an angle of cosine `cos` to the viewer does.
    fn split(&self, cos: f32) -> Split {
        let base = &self.bsdf.base;
        match base.passage {
            Passage::Closed => Split { reflected: base.reflected(cos), passed: Rgb::ZERO, chance: 1.0 },
            Passage::Straight => {
                // What goes straight knows no facets.
                let (about, passed) = (self.bsdf.reflected_about(self.wo), self.bsdf.smooth_passed(self.wo));
                Split { chance: chance(about, passed), reflected: base.reflected(cos), passed }
            }
            Passage::Bent | Passage::Sheet => {
                let (reflected, passed) = base.split(cos);
                Split { reflected, passed, chance: chance(reflected, passed) }
            }
        }
    }

    /// A facet by two numbers in `[0, 1)`. Where all of its light is reflected, most of those are left out that reflect below
    /// the surface.
    fn facet(&self, at: Vec2) -> Vec3 {
        let base = &self.bsdf.base;
        match &base.ggx {
            None => Vec3::Z,
            Some(ggx) if base.passage == Passage::Bent => ggx.visible(self.wo, at),
            Some(ggx) => ggx.visible_reflecting(self.wo, at),
        }
    }

    /// Density with which [`Self::facet`] leads to the direction that a facet mirrors.
    fn facet_pdf(&self, ggx: &Ggx, facet: &Facet) -> f32 {
        match self.bsdf.base.passage {
            Passage::Bent => facet.seen_pdf(ggx, self.wo),
            _ => facet.pdf(ggx, self.wo),
        }
    }

    /// Probability with which the facet of these numbers reflects.
    #[cfg(test)]
    pub(crate) fn reflect_chance(&self, at: Vec2) -> f32 {
        self.split(self.wo.dot(self.facet(at)).clamp(0.0, 1.0)).chance
    }

    /// Draws a direction: `u.z` says which way, the rest where; `None` where the numbers lead nowhere, for which light is 0.
    ///
    /// With dispersion smooth glass picks one channel, by what each carries: the weight of the others is 0, so that a weight with
    /// a single channel tells that the path has taken the way of one colour.
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
                    let weight = Rgb::splat(coat.kept(wo));
                    return self.delta(way, coat.world(mirrored(local)), weight, Event::Glossy);
                };
                let wi = coat.world(sample_facet(ggx, local, at)?);
                ((wi.z > 0.0).then_some(wi)?, Event::Glossy)
            }
            Way::Fibres => (warp::square_to_hemisphere(at), Event::Diffuse),
            Way::Facets => match self.draw_facet(rest, at)? {
                Facing::Rough(wi, event) => (wi, event),
                Facing::Smooth(sample) => return sample,
            },
            Way::Up => (bsdf.fill.up.draw(rest, at), Event::Diffuse),
            Way::Under => {
                let wi = mirrored_down(warp::square_to_cosine_hemisphere(at));
                let weight = bsdf.fill.under(&bsdf.cover, wo).0;
                return self.delta(way, wi, weight, Event::Subsurface);
            }
            Way::Down => (mirrored_down(bsdf.fill.down.draw(rest, at)), Event::Diffuse),
        };
        let (value, pdf) = self.answer(wi);
        (pdf > 0.0).then(|| BsdfSample { wi, weight: value / pdf, pdf, event })
    }

    /// Draws a facet, then whether it reflects, in proportion to what it reflects and lets through.
    ///
    /// # Source
    /// Walter et al., "Microfacet Models for Refraction through Rough Surfaces", 2007, section 5.3.
    fn draw_facet(&self, rest: f32, at: Vec2) -> Option<Facing> {
        let (base, wo) = (&self.bsdf.base, self.wo);
        let h = self.facet(at);
        let cos = wo.dot(h).clamp(0.0, 1.0);
        let Split { reflected, passed, chance } = self.split(cos);
        let mirrored = (2.0 * wo.dot(h) * h - wo).normalize_or_zero();
        if rest < chance {
            return Some(match base.ggx {
                Some(_) => Facing::Rough((mirrored.z > 0.0).then_some(mirrored)?, Event::Glossy),
                None => Facing::Smooth(self.delta(
                    Way::Facets,
                    mirrored,
                    self.passed * reflected / chance,
                    Event::Glossy,
                )),
            });
        }
        let is_smooth = base.ggx.is_none() || base.passage == Passage::Straight;
        if base.passage == Passage::Sheet {
            let weight = self.passed * passed / (1.0 - chance);
            return Some(match base.ggx {
                Some(_) => {
                    Facing::Rough(mirrored_down((mirrored.z > 0.0).then_some(mirrored)?), Event::Transmission)
                }
                None => Facing::Smooth(self.delta(Way::Facets, -wo, weight, Event::Transmission)),
            });
        }
        // The density of rough glass is that of even odds.
        let carried = if is_smooth { self.carried } else { Rgb::ONE };
        let u = ((rest - chance) / (1.0 - chance)).min(1.0 - f32::EPSILON);
        let (eta, color) = base.clear.ray(u, carried);
        let (h, cos) = if is_smooth { (Vec3::Z, wo.z.min(1.0)) } else { (h, cos) };
        let wi = bent(wo, h, cos, eta)?;
        if !is_smooth {
            return Some(Facing::Rough(wi, Event::Transmission));
        }
        let weight = self.passed * color * passed / (1.0 - chance);
        Some(Facing::Smooth(self.delta(Way::Facets, wi, weight, Event::Transmission)))
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

/// What facets of one slope do with light.
#[derive(Clone, Copy, Debug)]
struct Split {
    reflected: Rgb,
    passed: Rgb,
    /// Probability with which a draw is reflected.
    chance: f32,
}

/// What a draw from facets is.
enum Facing {
    /// A direction, with a density.
    Rough(Vec3, Event),
    /// The only direction of a mirror or of clear glass.
    Smooth(Option<BsdfSample>),
}

/// Probability of reflection where so much is reflected and so much passes.
fn chance(reflected: Rgb, passed: Rgb) -> f32 {
    let (reflected, passed) = (bright(reflected), bright(passed));
    if passed > 0.0 { reflected / (reflected + passed) } else { 1.0 }
}

/// The mean of the channels.
fn bright(color: Rgb) -> f32 {
    color.element_sum() / 3.0
}
