//! Metals by name.

use super::Conductor;
use crate::color::Rgb;

/// Names, `n` and `k` at 650, 550 and 450 nanometres.
///
/// # Source
/// <https://refractiveindex.info>, as collected in <https://chris.hindefjord.se/resources/rgb-ior-metals>; chromium as in the
/// material standard of `LabPBR`.
const METALS: [(&str, Rgb, Rgb); 10] = [
    ("aluminium", Rgb::new(1.3456, 0.96521, 0.61722), Rgb::new(7.4746, 6.3995, 5.3031)),
    ("brass", Rgb::new(0.444, 0.527, 1.094), Rgb::new(3.695, 2.765, 1.829)),
    ("chromium", Rgb::new(3.1071, 3.1812, 2.3230), Rgb::new(3.3314, 3.3291, 3.1350)),
    ("copper", Rgb::new(0.27105, 0.67693, 1.3164), Rgb::new(3.6092, 2.6248, 2.2921)),
    ("gold", Rgb::new(0.18299, 0.42108, 1.3734), Rgb::new(3.4242, 2.3459, 1.7704)),
    ("iron", Rgb::new(2.9114, 2.9497, 2.5845), Rgb::new(3.0893, 2.9318, 2.7670)),
    ("mercury", Rgb::new(2.0733, 1.5523, 1.0606), Rgb::new(5.3383, 4.6510, 3.8628)),
    ("platinum", Rgb::new(2.3757, 2.0847, 1.8453), Rgb::new(4.2655, 3.7153, 3.1365)),
    ("silver", Rgb::new(0.15943, 0.14512, 0.13547), Rgb::new(3.9291, 3.1900, 2.3808)),
    ("titanium", Rgb::new(2.7407, 2.5418, 2.2670), Rgb::new(3.8143, 3.4345, 3.0385)),
];

impl Conductor {
    /// A measured metal; `None` for a name that is not in [`Self::names`].
    ///
    /// ```
    /// use heliostat_scene::material::Conductor;
    ///
    /// let gold = Conductor::named("gold").unwrap();
    /// assert!(gold.n.x < gold.n.z);
    /// assert_eq!(Conductor::named("unobtainium"), None);
    /// ```
    pub fn named(name: &str) -> Option<Self> {
        METALS.iter().find(|(known, ..)| *known == name).map(|&(_, n, k)| Self { n, k })
    }

    /// The names that [`Self::named`] knows, in the order of the alphabet.
    pub fn names() -> impl Iterator<Item = &'static str> {
        METALS.iter().map(|(name, ..)| *name)
    }
}
