//! Light that comes back from anywhere: from matte matter, and from facets that throw it at each other.
//!
//! Each part is a product of a profile of either direction, `color q(wo) q(wi) / (pi mean(q))`, where the profile is what
//! other parts of the surface have not sent on. So each is reciprocal, and where nothing is absorbed it sends back `q(wo)`:
//! just what was missing.
//!
//! # Source
//! Kulla, Conty, "Revisiting Physically Based Shading at Imageworks", 2017; Kelemen, Szirmay-Kalos, "A Microfacet Based
//! Coupled Specular-Matte BRDF Model", 2001, for matte matter under a boundary.

use super::base::{Base, Passage};
use super::cover::Cover;
use super::glass_fill::GlassFill;
use crate::bsdf::diffuse::Matte;
use crate::bsdf::reflect::mirrored_down;
use crate::bsdf::standard::StandardPoint;
use crate::bsdf::table::{Curve, Reflection, cosine_mean};
use glam::Vec3;
use heliostat_geometry::error_bound;
use heliostat_scene::Rgb;
use std::f32::consts::FRAC_1_PI;

/// What is sent to either side.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sides {
    pub(super) up: Rgb,
    pub(super) down: Rgb,
}

/// All that comes back from anywhere.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fill {
    reflection: Reflection,
    facets: Option<FacetFill>,
    matte: Option<MatteFill>,
    glass: Option<GlassFill>,
    cover: Option<CoverFill>,
    /// Boundary over the matte part.
    face: Face,
}

/// Light that facets throw at each other: its color on either side, and the mean of its profile.
#[derive(Clone, Copy, Debug)]
struct FacetFill {
    color: Sides,
    mean: f32,
}

/// Matte matter under the boundary: its share, what it sends to either side, and the mean of its profile.
#[derive(Clone, Copy, Debug)]
struct MatteFill {
    share: f32,
    up: Matte,
    down: Rgb,
    /// Share of the light that walks below the surface, and its colour when it comes out.
    under: f32,
    under_color: Rgb,
    mean: Rgb,
}

/// Light of facets that the cover throws back at them: its colour, what passes the cover over the cosine, and the mean of its
/// profile.
#[derive(Clone, Copy, Debug)]
struct CoverFill {
    color: Rgb,
    passed: Curve,
    mean: f32,
}

impl CoverFill {
    fn new(base: &Base, cover: &Cover, reflection: &Reflection) -> Self {
        let color = cosine_mean(&Curve::new(|cos| base.reflected(cos)));
        let passed = Curve::new(|cos| {
            let w = Vec3::new((1.0 - cos * cos).max(0.0).sqrt(), 0.0, cos);
            Rgb::splat(cover.passed(w))
        });
        let mean = reflection.mean_around(|w| Rgb::splat(reflection.stopped(&passed, w))).x;
        Self { color, passed, mean: mean.max(f32::MIN_POSITIVE) }
    }
}

/// The boundary of clear matter as a layer.
#[derive(Clone, Copy, Debug)]
struct Face {
    curve: Curve,
    between: Rgb,
    /// Whether it reflects nothing.
    is_dark: bool,
}

impl Face {
    /// Share of the light along `w` that gets through.
    fn passed(&self, reflection: &Reflection, w: Vec3) -> Rgb {
        if self.is_dark {
            return Rgb::ONE;
        }
        let kept = reflection.albedo(&self.curve, w) + self.between * reflection.lost(w);
        (Rgb::ONE - kept).clamp(Rgb::ZERO, Rgb::ONE)
    }

    fn passed_mean(&self, reflection: &Reflection) -> Rgb {
        let kept = reflection.albedo_mean(&self.curve) + self.between * reflection.lost_mean();
        (Rgb::ONE - kept).clamp(Rgb::ZERO, Rgb::ONE)
    }
}

impl Fill {
    /// Whether it sends back no light at all.
    pub(super) fn is_empty(&self) -> bool {
        self.facets.is_none() && self.matte.is_none() && self.glass.is_none()
    }

    pub(super) fn new(point: &StandardPoint, base: &Base, cover: &Cover) -> Self {
        let reflection = Reflection::of(base.ggx);
        let curve = Curve::new(|cos| base.clear.reflectance(cos));
        let face = Face { curve, between: reflection.between(&curve), is_dark: curve.is_zero() };
        let is_bent = base.passage == Passage::Bent && base.ggx.is_some();
        Self {
            reflection,
            facets: base.ggx.is_some().then(|| facet_fill(base, cover, &reflection, &face)),
            matte: matte_fill(point, base, cover, &reflection, &face),
            glass: is_bent.then(|| GlassFill::new(base, &reflection)),
            cover: (base.ggx.is_some() && !cover.is_none()).then(|| CoverFill::new(base, cover, &reflection)),
            face,
        }
    }

    /// The value.
    pub(super) fn value(&self, cover: &Cover, wo: Vec3, wi: Vec3) -> Rgb {
        let is_up = wi.z > 0.0;
        let passed = cover.passed(wo) * cover.passed(if is_up { wi } else { mirrored_down(wi) });
        let mut sum = Rgb::ZERO;
        if let Some(FacetFill { color, mean }) = &self.facets {
            let profiles = self.reflection.lost(wo) * self.reflection.lost(wi);
            sum += if is_up { color.up } else { color.down } * (passed * profiles / mean);
        }
        if let Some(matte) = &self.matte {
            let face = |w: Vec3| self.face.passed(&self.reflection, w);
            let color = if is_up { matte.up.times_pi(wo, wi) } else { matte.down };
            sum += matte.share * color * face(wo) * face(wi) * passed / matte.mean;
        }
        if let Some(glass) = &self.glass {
            sum += cover.passed(wo) * glass.times_pi(wo, wi);
        }
        if let (Some(CoverFill { color, passed, mean }), true) = (&self.cover, is_up) {
            let stopped = |w: Vec3| self.reflection.stopped(passed, w);
            sum += *color * (stopped(wo) * stopped(wi) / mean);
        }
        sum * (wi.z.abs() * FRAC_1_PI)
    }

    /// What is sent to a viewer in all.
    pub(super) fn albedo(&self, cover: &Cover, wo: Vec3) -> Sides {
        let passed = cover.passed(wo);
        let mut sum = Sides::default();
        if let Some(FacetFill { color, .. }) = &self.facets {
            let profile = self.reflection.lost(wo);
            sum.up += profile * color.up;
            sum.down += profile * color.down;
        }
        if let Some(matte) = &self.matte {
            let profile = matte.share * self.face.passed(&self.reflection, wo);
            sum.up += profile * matte.up.color;
            sum.down += profile * matte.down;
        }
        if let Some(glass) = &self.glass {
            let Sides { up, down } = glass.albedo(wo);
            sum.up += up;
            sum.down += down;
        }
        let stopped = self.cover.map_or(Rgb::ZERO, |CoverFill { color, passed, .. }| {
            self.reflection.stopped(&passed, wo) * color
        });
        Sides { up: passed * sum.up + stopped, down: passed * sum.down }
    }

    /// Share of the light along `wo` that walks below the surface, and about its colour when it comes out.
    pub(super) fn under(&self, cover: &Cover, wo: Vec3) -> (Rgb, Rgb) {
        match &self.matte {
            Some(matte) if matte.under > 0.0 => {
                let share = matte.share * matte.under * cover.passed(wo);
                (share * self.face.passed(&self.reflection, wo), matte.under_color)
            }
            _ => (Rgb::ZERO, Rgb::ZERO),
        }
    }

    /// Share of the light along `wo` that gets through the boundary of clear matter.
    pub(super) fn face_passed(&self, wo: Vec3) -> Rgb {
        self.face.passed(&self.reflection, wo)
    }
}

fn facet_fill(base: &Base, cover: &Cover, reflection: &Reflection, face: &Face) -> FacetFill {
    let metal = Curve::new(|cos| base.metal.reflectance(cos));
    let mut color = Sides { up: base.metalness * reflection.between(&metal), down: Rgb::ZERO };
    match base.passage {
        Passage::Closed | Passage::Bent => color.up += base.matte_share() * face.between,
        Passage::Straight => color.up += (1.0 - base.metalness) * face.between,
        Passage::Sheet => {
            color.up += base.matte_share() * face.between;
            let mean = cosine_mean(&Curve::new(|cos| base.sheet_sides(cos).0));
            let through = cosine_mean(&Curve::new(|cos| base.sheet_sides(cos).1));
            color.up += base.glass_share() * mean;
            color.down += base.glass_share() * through;
        }
    }
    let profile = |w: Vec3| Rgb::splat(reflection.lost(w));
    let mean = covered_mean(cover, reflection, profile, || Rgb::splat(reflection.lost_mean()));
    FacetFill { color, mean: mean.x.max(f32::MIN_POSITIVE) }
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
    let mean =
        covered_mean(cover, reflection, |w| face.passed(reflection, w), || face.passed_mean(reflection));
    // Light that walks leaves less to what is matte; where none does, it has the colour of both.
    let (color, under) = if point.walks {
        ((1.0 - point.subsurface) * point.base_color, point.subsurface)
    } else {
        (point.base_color.lerp(point.subsurface_color, point.subsurface), 0.0)
    };
    // Under a mirror there is no light to scale.
    (mean.max_element() > error_bound::TABLE_ERROR).then_some(MatteFill {
        share: base.matte_share(),
        up: Matte { color: (1.0 - through) * color, roughness: point.diffuse_roughness },
        down: (1.0 - under) * through * point.diffuse_transmission_color,
        under,
        under_color: point.subsurface_color,
        mean: mean.max(Rgb::splat(error_bound::TABLE_ERROR)),
    })
}

/// The mean over the hemisphere of a profile times what the cover lets pass; `bare` is that without cover.
fn covered_mean(
    cover: &Cover,
    reflection: &Reflection,
    profile: impl Fn(Vec3) -> Rgb,
    bare: impl Fn() -> Rgb,
) -> Rgb {
    if cover.is_none() { bare() } else { reflection.mean_around(|w| cover.passed(w) * profile(w)) }
}
