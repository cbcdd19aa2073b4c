//! Spectra in twenty bands of 20 nm, what the Earth's air does to them, and the colour that they are.
//!
//! # Source
//! Sun and ozone: ASTM G-173 (extraterrestrial) and Serdyuchenko et al. 2011 (233 K), averaged in bands, as in Bruneton,
//! "A Qualitative and Quantitative Evaluation of 8 Clear Sky Models", TVCG 2017. Rayleigh scattering: Penndorf 1957, as
//! there. Haze: Ångström's law with the coefficients of Preetham, Shirley, Smits, "A Practical Analytic Model for Daylight",
//! SIGGRAPH 1999, appendix 1. Colour matching: Wyman, Sloan, Shirley, "Simple Analytic Approximations to the CIE XYZ Color
//! Matching Functions", JCGT 2013.

use heliostat_scene::Rgb;

/// Bands.
pub(super) const BANDS: usize = 20;
/// Where the first begins and how wide each is, in nm.
const FIRST: f64 = 360.0;
const WIDTH: f64 = 20.0;

/// A number for each band.
pub(super) type Spectrum = [f32; BANDS];

/// Irradiance from the sun above the air, in W/(m² nm).
pub(super) const SUN: Spectrum = [
    1.130175, 1.0798, 1.72910, 1.650765, 1.97336, 2.02127, 1.94593, 1.87248, 1.8808, 1.850945, 1.83775,
    1.79814, 1.7249, 1.66424, 1.563115, 1.53376, 1.4611, 1.388965, 1.328085, 1.270305,
];

/// Absorption by one molecule of ozone, in 10^-25 m².
const OZONE: Spectrum = [
    0.006991, 0.004727, 0.02145, 0.069855, 0.1949, 0.42965, 0.8384, 1.541, 2.447, 3.2955, 4.469, 4.5495,
    4.662, 3.4775, 2.45, 1.6625, 1.07565, 0.701, 0.46275, 0.37325,
];
/// Molecules of ozone where it is densest, in 10^25 per m³: 300 Dobson units of 2.687 10^20 per m², in a layer as thick as one
/// of 15 km.
const OZONE_DENSITY: f64 = 300.0 * 2.687 / 100_000.0 / 15_000.0;
/// Scattering by air at sea level per metre, at a wavelength of 1 µm.
const RAYLEIGH: f64 = 1.24062 / 1_000_000.0;
/// The exponent of Ångström's law.
const ANGSTROM: f64 = 1.3;
/// Watts to lumens of the definition of the lumen, and of what is called white light: the scale that makes a white of 1 W
/// in all bands that eyes see a white of 1. As in Ward, "Radiance".
const LUMENS: f64 = 683.0;
const WHITE_LUMENS: f64 = 179.0;

/// The wavelength in the middle of a band, in nm.
fn wavelength(band: usize) -> f64 {
    FIRST + (band as f64 + 0.5) * WIDTH
}

fn by_wavelength(value: impl Fn(f64) -> f64) -> Spectrum {
    std::array::from_fn(|band| value(wavelength(band)) as f32)
}

/// Scattering by air at sea level, per metre.
pub(super) fn rayleigh() -> Spectrum {
    by_wavelength(|nm| RAYLEIGH * (nm / 1000.0).powi(-4))
}

/// Optical thickness of the haze above sea level, straight up.
pub(super) fn haze(turbidity: f64) -> Spectrum {
    let beta = (0.04608 * turbidity - 0.04586).max(0.0);
    by_wavelength(|nm| beta * (nm / 1000.0).powf(-ANGSTROM))
}

/// Absorption by ozone where it is densest, per metre.
pub(super) fn ozone() -> Spectrum {
    OZONE.map(|cross_section| (f64::from(cross_section) * OZONE_DENSITY) as f32)
}

/// From spectra per nm to linear Rec.709.
pub(super) struct Observer([Rgb; BANDS]);

impl Observer {
    pub(super) fn new() -> Self {
        Self(std::array::from_fn(|band| {
            // The mean over the band.
            let points = (0..10).map(|i| xyz(wavelength(band) + WIDTH * (0.1 * f64::from(i) - 0.45)));
            let sum = points.fold([0.0; 3], |sum, xyz| std::array::from_fn(|i| sum[i] + 0.1 * xyz[i]));
            let [x, y, z] = sum.map(|v| v * WIDTH * LUMENS / WHITE_LUMENS);
            // IEC 61966-2-1.
            let r = 3.240_969_9 * x - 1.537_383_2 * y - 0.498_610_8 * z;
            let g = -0.969_243_6 * x + 1.875_967_5 * y + 0.041_555_1 * z;
            let b = 0.055_630_1 * x - 0.203_977 * y + 1.056_971_5 * z;
            Rgb::new(r as f32, g as f32, b as f32)
        }))
    }

    /// A colour; what lies outside the triangle of the primaries is brought to its border.
    pub(super) fn color(&self, spectrum: &Spectrum) -> Rgb {
        let sum: Rgb = self.0.iter().zip(spectrum).map(|(color, &value)| value * color).sum();
        sum.max(Rgb::ZERO)
    }
}

/// The CIE 1931 colour matching functions, fitted.
fn xyz(nm: f64) -> [f64; 3] {
    let lobe = |height: f64, middle: f64, left: f64, right: f64| {
        let width = if nm < middle { left } else { right };
        height * (-0.5 * ((nm - middle) / width).powi(2)).exp()
    };
    [
        lobe(1.056, 599.8, 37.9, 31.0) + lobe(0.362, 442.0, 16.0, 26.7) + lobe(-0.065, 501.1, 20.4, 26.2),
        lobe(0.821, 568.8, 46.9, 40.5) + lobe(0.286, 530.9, 16.3, 31.1),
        lobe(1.217, 437.0, 11.8, 36.0) + lobe(0.681, 459.0, 26.0, 13.8),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use heliostat_scene::color::luminance;

    #[test]
    fn the_sun_above_the_air_is_as_bright_as_it_is() {
        // 128 to 134 klx are published: 179 lumens are 1.
        let klx = 0.179 * luminance(Observer::new().color(&SUN));
        assert!((128.0..136.0).contains(&klx), "{klx}");
    }

    #[test]
    fn equal_energy_is_nearly_white() {
        let white = Observer::new().color(&[1.0 / 400.0; BANDS]);
        assert!((luminance(white) - 1.0).abs() < 0.05, "{white}");
    }
}
