//! Light that comes back from anywhere: from matte matter, and from facets that throw it at each other.
//!
//! Each part is a product of a profile of either direction, `color q(wo) q(wi) / (pi mean(q))`, where the profile is what
//! other parts of the surface have not sent on. So each is reciprocal, and where nothing is absorbed it sends back `q(wo)`:
//! just what was missing.
//!
//! # Source
//! Kulla, Conty, "Revisiting Physically Based Shading at Imageworks", 2017; Kelemen, Szirmay-Kalos, "A Microfacet Based
//! Coupled Specular-Matte BRDF Model", 2001, for matte matter under a boundary.

use super::balance::Balance;
use super::base::{Base, Passage};
use super::cover::Cover;
use super::glass_fill::GlassFill;
use super::spread::Spread;
use crate::bsdf::diffuse::Matte;
use crate::bsdf::standard::StandardPoint;
use crate::bsdf::table::{Curve, CurveSeen, Place, Reflection, Stopped};
use glam::Vec3;
use heliostat_geometry::error_bound;
use heliostat_scene::Rgb;
use std::f32::consts::FRAC_1_PI;

/// A direction near the horizon, where facets lose most.
const LOW: Vec3 = Vec3::new(0.999_8, 0.0, 0.02);

/// What is sent to either side.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sides {
    pub(super) up: Rgb,
    pub(super) down: Rgb,
}

/// All that comes back from anywhere.
#[derive(Clone, Debug)]
pub(super) struct Fill {
    reflection: Reflection,
    facets: Option<FacetFill>,
    matte: Option<MatteFill>,
    glass: Option<GlassFill>,
    cover: Option<CoverFill>,
    /// Boundary of clear matter, and whether there is none over the matte part.
    face: Face,
    is_bare: bool,
    /// How directions are drawn above and below.
    pub(super) up: Spread,
    pub(super) down: Spread,
}

/// Light that facets throw at each other: its color on either side, and the mean of its profile.
#[derive(Clone, Copy, Debug)]
struct FacetFill {
    color: Sides,
    mean: f32,
}

/// Matte matter under the boundary: its share, what it sends to either side, and the mean of its profile.
#[derive(Clone, Debug)]
struct MatteFill {
    share: f32,
    up: Matte,
    /// For rough matter under something.
    balance: Option<Box<Balance>>,
    down: Rgb,
    /// Share of the light that walks below the surface, and its colour when it comes out.
    under: f32,
    under_color: Rgb,
    mean: Rgb,
}

impl MatteFill {
    fn sent_up(&self, wo: Vec3, wi: Vec3) -> Rgb {
        let color = self.up.times_pi(wo, wi);
        self.balance.as_ref().map_or(color, |balance| balance.at(wo) * balance.at(wi) * color)
    }
}

/// Light of facets that the cover throws back at them, on either side of the surface.
#[derive(Clone, Debug)]
struct CoverFill {
    up: Stopped,
    /// For thin walls.
    down: Option<Box<Stopped>>,
}

impl CoverFill {
    fn new(base: &Base, cover: &Cover, reflection: &Reflection) -> Self {
        let stopped = |curve| Stopped::new(reflection, |w| cover.passed(w), &curve);
        Self {
            up: stopped(Curve::new(|cos| base.reflected(cos))),
            down: (base.passage == Passage::Sheet)
                .then(|| Box::new(stopped(Curve::new(|cos| base.passed(cos))))),
        }
    }

    fn profile(&self, place: &Place) -> Sides {
        Sides { up: self.up.at(place), down: self.down.as_ref().map_or(Rgb::ZERO, |down| down.at(place)) }
    }

    /// The distribution function times pi, for the profiles of both directions.
    fn times_pi(&self, to: &Sides, from: &Sides, is_up: bool) -> Rgb {
        match (&self.down, is_up) {
            (_, true) => to.up * from.up / self.up.mean(),
            (Some(down), false) => to.down * from.down / down.mean(),
            (None, false) => Rgb::ZERO,
        }
    }
}

/// The boundary of clear matter as a layer.
#[derive(Clone, Debug)]
struct Face {
    /// Its reflectance over the angle, and as it is seen through facets.
    bare: Curve,
    curve: CurveSeen,
    between: Rgb,
    /// Whether it reflects nothing.
    is_dark: bool,
}

impl Face {
    /// Share of the light there that gets through.
    fn passed(&self, reflection: &Reflection, place: &Place) -> Rgb {
        if self.is_dark {
            return Rgb::ONE;
        }
        let lost = reflection.lost(place);
        let kept = (1.0 - lost) * self.curve.at(place) + self.between * lost;
        (Rgb::ONE - kept).clamp(Rgb::ZERO, Rgb::ONE)
    }
}

impl Face {
    /// The mean of what gets through, where that is known.
    fn passed_mean(&self, reflection: &Reflection) -> Option<Rgb> {
        reflection.passed_mean(&self.bare, self.between)
    }
}

/// The profiles in one direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Profiles {
    place: Place,
    /// What passes the cover.
    pub(super) cover: f32,
    facets: f32,
    matte: Rgb,
    stopped: Sides,
}

impl Fill {
    /// Whether it sends back no light at all.
    pub(super) fn is_empty(&self) -> bool {
        self.facets.is_none() && self.matte.is_none() && self.glass.is_none()
    }

    pub(super) fn new(point: &StandardPoint, base: &Base, cover: &Cover) -> Self {
        let reflection = Reflection::of(base.ggx);
        let curve = Curve::new(|cos| base.clear.reflectance(cos));
        let between = reflection.between(&curve);
        let face = Face { curve: reflection.seen(&curve), between, is_dark: curve.is_zero(), bare: curve };
        let is_bent = base.passage == Passage::Bent;
        let bent = base.ggx.as_ref().filter(|_| is_bent);
        let glass = bent.map(|ggx| GlassFill::new(base, ggx, &reflection));
        let matte = matte_fill(point, base, cover, &reflection, &face);
        // Matte matter outshines what facets throw at each other.
        let (up, down) = match (&glass, &matte) {
            _ if base.ggx.is_none() || matte.is_some() => (Spread::COSINE, Spread::COSINE),
            (Some(glass), _) => glass.spreads(&reflection.place(LOW)),
            (None, _) => {
                let lost = reflection.lost(&reflection.place(LOW)) / reflection.lost_mean();
                (Spread::towards_horizon(lost), Spread::towards_horizon(lost))
            }
        };
        Self {
            facets: base.ggx.is_some().then(|| facet_fill(base, cover, &reflection, &face)),
            matte,
            glass,
            up,
            down,
            cover: (base.ggx.is_some() && !cover.is_none()).then(|| CoverFill::new(base, cover, &reflection)),
            reflection,
            face,
            is_bare: base.is_bare,
        }
    }

    /// The profiles in a direction, on either side.
    pub(super) fn profiles(&self, cover: &Cover, w: Vec3) -> Profiles {
        let place = self.reflection.place(w);
        Profiles {
            place,
            cover: cover.passed(Vec3::new(w.x, w.y, w.z.abs())),
            facets: if self.facets.is_some() { self.reflection.lost(&place) } else { 0.0 },
            matte: match &self.matte {
                None => Rgb::ZERO,
                Some(_) if self.is_bare => Rgb::ONE,
                Some(_) => self.face.passed(&self.reflection, &place),
            },
            stopped: self.cover.as_ref().map_or(Sides::default(), |cover| cover.profile(&place)),
        }
    }

    /// The value for the profiles of both directions.
    pub(super) fn value(&self, (wo, to): (Vec3, &Profiles), (wi, from): (Vec3, &Profiles)) -> Rgb {
        let is_up = wi.z > 0.0;
        let passed = to.cover * from.cover;
        let mut sum = Rgb::ZERO;
        if let Some(FacetFill { color, mean }) = &self.facets {
            sum += if is_up { color.up } else { color.down } * (passed * to.facets * from.facets / mean);
        }
        if let Some(matte) = &self.matte {
            let color = if is_up { matte.sent_up(wo, wi) } else { matte.down };
            sum += matte.share * color * to.matte * from.matte * passed / matte.mean;
        }
        if let Some(glass) = &self.glass {
            sum += to.cover * glass.times_pi(glass.lost(&to.place), &from.place, is_up);
        }
        if let Some(cover) = &self.cover {
            sum += cover.times_pi(&to.stopped, &from.stopped, is_up);
        }
        sum * (wi.z.abs() * FRAC_1_PI)
    }

    /// What is sent in all to a viewer with these profiles.
    pub(super) fn albedo(&self, to: &Profiles) -> Sides {
        let mut sum = Sides::default();
        if let Some(FacetFill { color, .. }) = &self.facets {
            sum.up += to.facets * color.up;
            sum.down += to.facets * color.down;
        }
        if let Some(matte) = &self.matte {
            let profile = matte.share * to.matte;
            sum.up += profile * matte.up.color;
            sum.down += profile * matte.down;
        }
        if let Some(glass) = &self.glass {
            let Sides { up, down } = glass.albedo(glass.lost(&to.place));
            sum.up += up;
            sum.down += down;
        }
        Sides { up: to.cover * sum.up + to.stopped.up, down: to.cover * sum.down + to.stopped.down }
    }

    /// Share of the light along `wo` that walks below the surface, and about its colour when it comes out.
    pub(super) fn under(&self, cover: &Cover, wo: Vec3) -> (Rgb, Rgb) {
        match &self.matte {
            Some(matte) if matte.under > 0.0 => {
                let share = matte.share * matte.under * cover.passed(wo);
                (share * self.face.passed(&self.reflection, &self.reflection.place(wo)), matte.under_color)
            }
            _ => (Rgb::ZERO, Rgb::ZERO),
        }
    }

    /// Share of the light along `wo` that gets through the boundary of clear matter.
    pub(super) fn face_passed(&self, wo: Vec3) -> Rgb {
        self.face.passed(&self.reflection, &self.reflection.place(wo))
    }
}

fn facet_fill(base: &Base, cover: &Cover, reflection: &Reflection, face: &Face) -> FacetFill {
    let metal = Curve::new(|cos| base.metal.reflectance(cos));
    let mut color = Sides { up: base.metalness * reflection.between(&metal), down: Rgb::ZERO };
    match base.passage {
        Passage::Closed | Passage::Bent => {
            color.up += (base.clear_share() - base.glass_share()) * face.between;
        }
        Passage::Straight => color.up += base.clear_share() * face.between,
        Passage::Sheet => {
            color.up += base.matte_share() * face.between;
            let mean = Curve::new(|cos| base.sheet_sides(cos).0).cosine_mean();
            let through = Curve::new(|cos| base.sheet_sides(cos).1).cosine_mean();
            color.up += base.glass_share() * mean;
            color.down += base.glass_share() * through;
        }
    }
    let covered =
        || reflection.mean_of_losses(|w| Rgb::splat(cover.passed(w) * reflection.lost(&reflection.place(w))));
    let mean = if cover.is_none() { reflection.lost_mean() } else { covered().x };
    FacetFill { color, mean: mean.max(f32::MIN_POSITIVE) }
}

fn matte_fill(
    point: &StandardPoint,
    base: &Base,
    cover: &Cover,
    reflection: &Reflection,
    face: &Face,
) -> Option<MatteFill> {
    if base.matte_share() == 0.0 {
        return None;
    }
    let through = point.diffuse_transmission;
    let is_dark = face.is_dark || base.is_bare;
    let passed = |w: Vec3| {
        let face = if is_dark { Rgb::ONE } else { face.passed(reflection, &reflection.place(w)) };
        cover.passed(w) * face
    };
    let mean = if is_dark { Some(Rgb::ONE) } else { face.passed_mean(reflection) };
    let mean = mean.filter(|_| cover.is_none()).unwrap_or_else(|| reflection.mean_around(passed));
    // Light that walks leaves less to what is matte; where none does, it has the colour of both.
    let (color, under) = if point.walks {
        ((1.0 - point.subsurface) * point.base_color, point.subsurface)
    } else {
        (point.base_color.lerp(point.subsurface_color, point.subsurface), 0.0)
    };
    let up = Matte { color: (1.0 - through) * color, roughness: point.diffuse_roughness };
    let is_bare = is_dark && cover.is_none();
    let along = |cos: f32| passed(Vec3::new((1.0 - cos * cos).max(0.0).sqrt(), 0.0, cos));
    let balance = (up.roughness > 0.0 && !is_bare).then(|| Box::new(Balance::new(&up, along)));
    // Under a mirror there is no light to scale.
    (mean.max_element() > error_bound::TABLE_ERROR).then_some(MatteFill {
        share: base.matte_share(),
        up,
        balance,
        down: (1.0 - under) * through * point.diffuse_transmission_color,
        under,
        under_color: point.subsurface_color,
        mean: mean.max(Rgb::splat(error_bound::TABLE_ERROR)),
    })
}
