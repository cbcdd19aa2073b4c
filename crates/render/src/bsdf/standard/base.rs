//! The base under all layers: facets of metal and of clear matter in shares.

use crate::bsdf::fresnel::{Boundary, Metal};
use crate::bsdf::ggx::Ggx;
use crate::bsdf::glass::sheet;
use crate::bsdf::standard::StandardPoint;
use heliostat_geometry::error_bound;
use heliostat_scene::Rgb;

/// How light comes through clear matter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Passage {
    /// None does.
    Closed,
    /// Through a boundary, bent by each facet.
    Bent,
    /// Through a boundary, bent as by a smooth one: facets bend too little to tell.
    Straight,
    /// Through a thin wall, spread as by a mirror on its other side.
    Sheet,
}

/// What facets of the base reflect and let through.
#[derive(Clone, Copy, Debug)]
pub(super) struct Base {
    /// `None` for a smooth base, and for one that reflects nothing.
    pub(super) ggx: Option<Ggx>,
    /// Share of metal; the rest is clear matter.
    pub(super) metalness: f32,
    pub(super) metal: Metal,
    pub(super) clear: Clear,
    pub(super) passage: Passage,
    /// Share of clear matter that is seen through; below the rest lies matte matter.
    pub(super) transmission: f32,
    /// What is left of light that crosses once.
    pub(super) tint: Rgb,
    /// Whether matte matter has no boundary over it: inside of a body it begins where light sees it.
    pub(super) is_bare: bool,
}

impl Base {
    pub(super) fn new(point: &StandardPoint, is_outside: bool) -> Self {
        let has_facets =
            point.specular > 0.0 || point.film > 0.0 || point.metalness > 0.0 || point.transmission > 0.0;
        let ggx =
            Ggx::new(point.roughness, point.anisotropy, point.anisotropy_direction).filter(|_| has_facets);
        let film = (point.film, point.film_ior, point.film_thickness);
        let clear = Clear::new(point, is_outside);
        let passage = passage(point, ggx.as_ref(), clear.eta().x);
        // From inside only total reflection at grazing angles would tell such facets from a smooth boundary.
        let is_smooth = passage == Passage::Straight && !is_outside;
        let (ggx, passage) = if is_smooth { (None, Passage::Bent) } else { (ggx, passage) };
        Self {
            ggx,
            metalness: point.metalness,
            metal: Metal::new(point.base_color, point.edge_color, point.conductor)
                .with_film(film.0, film.1, film.2),
            clear,
            passage,
            transmission: if passage == Passage::Closed { 0.0 } else { point.transmission },
            // In and out again give the colour.
            tint: if point.thin_walled { point.base_color } else { point.base_color.map(f32::sqrt) },
            is_bare: !is_outside,
        }
    }

    /// What facets reflect at an angle of cosine `cos`.
    pub(super) fn reflected(&self, cos: f32) -> Rgb {
        let mut sum = Rgb::ZERO;
        if self.metalness > 0.0 {
            sum += self.metalness * self.metal.reflectance(cos);
        }
        if self.clear_share() > 0.0 {
            sum += self.clear_share() * self.clear_reflected(cos);
        }
        sum
    }

    fn clear_reflected(&self, cos: f32) -> Rgb {
        let face = self.clear.reflectance(cos);
        match self.passage {
            Passage::Sheet => face.lerp(sheet(face, self.tint).0, self.transmission),
            _ => face,
        }
    }

    /// What facets let through at an angle of cosine `cos`, colours of the passage included.
    pub(super) fn passed(&self, cos: f32) -> Rgb {
        let weight = self.glass_share();
        if weight == 0.0 {
            return Rgb::ZERO;
        }
        let face = self.clear.reflectance(cos);
        let through = match self.passage {
            Passage::Sheet => sheet(face, self.tint).1,
            _ => self.tint * (Rgb::ONE - face),
        };
        weight * through
    }

    /// [`Self::reflected`] and [`Self::passed`] at once.
    pub(super) fn split(&self, cos: f32) -> (Rgb, Rgb) {
        let face = self.clear.reflectance(cos);
        let (sides, clear) = match self.passage {
            Passage::Sheet => {
                let sides = sheet(face, self.tint);
                (sides, face.lerp(sides.0, self.transmission))
            }
            _ => ((face, self.tint * (Rgb::ONE - face)), face),
        };
        let metal =
            if self.metalness > 0.0 { self.metalness * self.metal.reflectance(cos) } else { Rgb::ZERO };
        (metal + self.clear_share() * clear, self.glass_share() * sides.1)
    }

    /// What a thin wall of this matter reflects and lets through.
    pub(super) fn sheet_sides(&self, cos: f32) -> (Rgb, Rgb) {
        sheet(self.clear.reflectance(cos), self.tint)
    }

    /// Share of the surface that is seen through.
    pub(super) fn glass_share(&self) -> f32 {
        (1.0 - self.metalness) * self.transmission
    }

    /// Share of the surface that has a boundary of clear matter.
    pub(super) fn clear_share(&self) -> f32 {
        if self.is_bare { self.glass_share() } else { 1.0 - self.metalness }
    }

    /// Share of the surface that is matte below its boundary.
    pub(super) fn matte_share(&self) -> f32 {
        (1.0 - self.metalness) * (1.0 - self.transmission)
    }
}

fn passage(point: &StandardPoint, ggx: Option<&Ggx>, eta: f32) -> Passage {
    let is_closed = point.transmission == 0.0 || point.metalness == 1.0 || !eta.is_finite();
    if is_closed {
        return Passage::Closed;
    }
    if point.thin_walled {
        return Passage::Sheet;
    }
    // A facet turned by a small angle turns refracted light by that angle times `eta - 1`.
    let spread = |ggx: &Ggx| ggx.mean_alpha() * (eta - 1.0).abs();
    match ggx {
        Some(ggx) if spread(ggx) < error_bound::LEAST_WIDTH && point.dispersion == 0.0 => Passage::Straight,
        _ => Passage::Bent,
    }
}

/// Clear matter; with dispersion a boundary of its own for each channel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clear {
    pub(super) channels: [Boundary; 3],
    pub(super) is_dispersed: bool,
}

/// `523655 / lambda^2 - 1.5168` at 611.4, 549.1 and 464.2 nanometres, where the primaries of Rec.709 have their weight.
///
/// # Source
/// Khronos, `KHR_materials_dispersion`: Cauchy's formula through Abbe's number; ITU-R BT.709 as dominant wavelengths.
const CAUCHY: Rgb = Rgb::new(-0.115_943, 0.219_976, 0.913_322);

impl Clear {
    fn new(point: &StandardPoint, is_outside: bool) -> Self {
        let is_dispersed = point.dispersion > 0.0 && point.transmission > 0.0 && !point.thin_walled;
        let boundary = |ior: f32| {
            Boundary::new(ior, is_outside || point.thin_walled, point.specular, point.specular_color)
                .with_film(point.film, point.film_ior, point.film_thickness)
        };
        let channels = if is_dispersed && point.ior > 0.0 {
            let spread = (point.ior - 1.0) * point.dispersion / 20.0;
            (spread * CAUCHY + point.ior).max(Rgb::ONE.min(Rgb::splat(point.ior))).to_array().map(boundary)
        } else {
            [boundary(point.ior); 3]
        };
        Self { channels, is_dispersed }
    }

    /// Index of the other side over that of the viewer's, per channel.
    pub(super) fn eta(&self) -> Rgb {
        Rgb::from_array(self.channels.map(|boundary| boundary.eta()))
    }

    /// The rays that refraction parts: index of refraction, and the channels that take this way.
    pub(super) fn rays(&self) -> impl Iterator<Item = (f32, Rgb)> {
        let count = if self.is_dispersed { 3 } else { 1 };
        (0..count).map(|k| self.nth_ray(k))
    }

    /// One of [`Self::rays`], by a number in `[0, 1)` and in proportion to what each channel carries, and its colour over the
    /// probability: a path that has taken the way of one colour before stays with it.
    pub(super) fn ray(&self, u: f32, carried: Rgb) -> (f32, Rgb) {
        if !self.is_dispersed {
            return self.nth_ray(0);
        }
        let sum = carried.element_sum();
        let shares = if sum > 0.0 { carried / sum } else { Rgb::splat(1.0 / 3.0) };
        let (mut left, mut drawn) = (u, 0);
        for k in (0..3).filter(|&k| shares[k] > 0.0) {
            drawn = k;
            if left < shares[k] {
                break;
            }
            left -= shares[k];
        }
        let (eta, color) = self.nth_ray(drawn);
        (eta, color / shares[drawn])
    }

    /// Probability of each ray where all channels carry the same.
    pub(super) fn ray_share(&self) -> f32 {
        if self.is_dispersed { 1.0 / 3.0 } else { 1.0 }
    }

    fn nth_ray(&self, k: usize) -> (f32, Rgb) {
        let color = if self.is_dispersed { [Rgb::X, Rgb::Y, Rgb::Z][k] } else { Rgb::ONE };
        (self.channels[k].eta(), color)
    }

    /// The reflectance at an angle of cosine `cos`.
    pub(super) fn reflectance(&self, cos: f32) -> Rgb {
        let [r, g, b] = &self.channels;
        if !self.is_dispersed {
            return r.reflectance(cos);
        }
        Rgb::new(r.reflectance(cos).x, g.reflectance(cos).y, b.reflectance(cos).z)
    }
}
