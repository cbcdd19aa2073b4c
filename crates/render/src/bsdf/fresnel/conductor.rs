//! Boundaries of measured metals.

use heliostat_scene::Rgb;
use heliostat_scene::material::Conductor;

/// Reflectance of a metal in air or vacuum for unpolarised light that meets it at an angle of cosine `cos` in `[0, 1]`.
///
/// # Source
/// Born, Wolf, "Principles of Optics", section 14.2; in the form without complex numbers of Lagarde, "Memo on Fresnel
/// equations", 2013.
pub(crate) fn conductor(metal: &Conductor, cos: f32) -> Rgb {
    let (n2, k2) = (metal.n * metal.n, metal.k * metal.k);
    let cos2 = cos * cos;
    let sin2 = 1.0 - cos2;
    let t0 = n2 - k2 - Rgb::splat(sin2);
    let a2_plus_b2 = sqrt(t0 * t0 + 4.0 * n2 * k2);
    let t1 = a2_plus_b2 + cos2;
    let t2 = 2.0 * cos * sqrt(0.5 * (a2_plus_b2 + t0));
    let across = (t1 - t2) / (t1 + t2);
    let t3 = cos2 * a2_plus_b2 + sin2 * sin2;
    let t4 = t2 * sin2;
    let along = across * (t3 - t4) / (t3 + t4);
    (0.5 * (across + along)).clamp(Rgb::ZERO, Rgb::ONE)
}

fn sqrt(v: Rgb) -> Rgb {
    v.map(|x| x.max(0.0).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bsdf_conductor_without_extinction_is_a_dielectric() {
        let glass = Conductor { n: Rgb::splat(1.5), k: Rgb::ZERO };
        for i in 0..=20 {
            let cos = i as f32 / 20.0;
            let exact = super::super::refraction(cos, 1.5).reflectance;
            assert!((conductor(&glass, cos).x - exact).abs() < 1e-5, "{cos}");
        }
    }

    #[test]
    fn bsdf_conductor_at_normal_incidence() {
        let silver = Conductor::named("silver").unwrap();
        let (n, k) = (silver.n, silver.k);
        let (above, below) = ((n - 1.0) * (n - 1.0) + k * k, (n + 1.0) * (n + 1.0) + k * k);
        assert!((conductor(&silver, 1.0) - above / below).abs().max_element() < 1e-5);
        assert_eq!(conductor(&silver, 0.0), Rgb::ONE);
    }
}
