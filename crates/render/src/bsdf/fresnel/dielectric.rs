//! Boundaries of clear matter.

use super::{Film, schlick};
use heliostat_scene::Rgb;

/// What happens to light at a smooth boundary, unpolarised.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Refraction {
    /// Share that is reflected, in `[0, 1]`.
    pub(crate) reflectance: f32,
    /// Cosine of the angle on the other side; 0 where all is reflected.
    pub(crate) cos: f32,
}

/// Fresnel's equations and Snell's law for light that meets a boundary at an angle of cosine `cos` in `[0, 1]`; `eta` is the
/// index of the other side over the index of this one.
///
/// # Source
/// Born, Wolf, "Principles of Optics", section 1.5.2.
pub(crate) fn refraction(cos: f32, eta: f32) -> Refraction {
    // Written so that an index of 1 bends nothing, to the last digit.
    let cos2 = ((eta - 1.0) * (eta + 1.0) + cos * cos) / (eta * eta);
    if cos2 <= 0.0 {
        return Refraction { reflectance: 1.0, cos: 0.0 };
    }
    let other = cos2.sqrt();
    let across = (cos - eta * other) / (cos + eta * other);
    let along = (eta * cos - other) / (eta * cos + other);
    Refraction { reflectance: 0.5 * (across * across + along * along), cos: other }
}

/// The reflectance of a dielectric with weight and tint, and perhaps a film, from either side.
///
/// As glTF has it, `normal = min(((n - 1) / (n + 1))^2 tint, 1) weight` and `grazing = weight`; between the two runs Fresnel's
/// curve in place of Schlick's. What passes from inside to outside is what passes the other way, and where all light is
/// reflected weight and tint do not matter: so no light is lost between the two sides.
///
/// # Source
/// Khronos, `KHR_materials_specular`, "Implementation".
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Boundary {
    /// Index of refraction of the other side over that of the viewer's; infinite for a mirror.
    eta: f32,
    /// Reflectance at normal incidence.
    normal: Rgb,
    /// Reflectance at grazing angles.
    grazing: f32,
    /// Share of the surface under a film, and the film.
    film: Option<(f32, Film)>,
}

impl Boundary {
    /// `ior` is that of the inside relative to the outside, 0 for a mirror; `is_outside` says where the viewer is.
    pub(crate) fn new(ior: f32, is_outside: bool, weight: f32, tint: Rgb) -> Self {
        let eta = match ior {
            ior if ior <= 0.0 => f32::INFINITY,
            ior if is_outside => ior,
            ior => 1.0 / ior,
        };
        let normal = weight * (normal_reflectance(eta) * tint).min(Rgb::ONE);
        Self { eta, normal, grazing: weight, film: None }
    }

    /// The same with a film on a share of it.
    pub(crate) fn with_film(mut self, share: f32, ior: f32, thickness: f32) -> Self {
        if share > 0.0 {
            self.film = Some((share, Film { ior, thickness }));
        }
        self
    }

    /// Index of refraction of the other side over that of the viewer's; infinite for a mirror.
    pub(crate) fn eta(&self) -> f32 {
        self.eta
    }

    /// The reflectance at an angle of cosine `cos` in `[0, 1]`.
    pub(crate) fn reflectance(&self, cos: f32) -> Rgb {
        let exact = if self.eta.is_finite() {
            refraction(cos, self.eta)
        } else {
            Refraction { reflectance: 1.0, cos: 1.0 }
        };
        if exact.cos == 0.0 {
            return Rgb::ONE;
        }
        let bare = self.bare().at(exact.reflectance, || schlick(cos));
        match self.film {
            None => bare,
            Some((share, film)) => {
                let outside = if self.eta < 1.0 { exact.cos } else { cos };
                bare.lerp(film.reflectance(outside, self.normal), share)
            }
        }
    }

    /// Without a film.
    fn bare(&self) -> Affine {
        Affine { least: normal_reflectance(self.eta), normal: self.normal, grazing: self.grazing }
    }
}

/// Reflectance at normal incidence.
fn normal_reflectance(eta: f32) -> f32 {
    if eta.is_finite() { ((eta - 1.0) / (eta + 1.0)).powi(2) } else { 1.0 }
}

/// A reflectance that follows Fresnel's curve between other ends.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Affine {
    /// Where Fresnel's curve starts.
    least: f32,
    /// Where this one starts.
    normal: Rgb,
    /// Where it ends.
    grazing: f32,
}

impl Affine {
    /// The reflectance where Fresnel's is `exact`; `mirror` says how far from start to end where that is 1 at every angle.
    fn at(&self, exact: f32, mirror: impl Fn() -> f32) -> Rgb {
        let way = if self.least < 1.0 { (exact - self.least) / (1.0 - self.least) } else { mirror() };
        self.normal.lerp(Rgb::splat(self.grazing), way.clamp(0.0, 1.0))
    }
}
