//! Rough matte matter under a boundary: keeps what the boundary lets in.
//!
//! A boundary lets more light in along some directions than along others, and a rough matte surface sends light of each
//! direction to others. So a profile that suits Lambert's surface does not suit this one: it is corrected by a factor for
//! either direction, scaled until the sum is due at every angle.
//!
//! # Source
//! Sinkhorn, "A Relationship Between Arbitrary Positive Matrices and Doubly Stochastic Matrices", 1964, for symmetric kernels.

use crate::bsdf::diffuse::Matte;
use crate::bsdf::table::{Even, EvenProfile, even_cosines, even_mean, lean_means};
use glam::Vec3;
use heliostat_scene::Rgb;

/// The factors.
#[derive(Clone, Debug)]
pub(super) struct Balance(EvenProfile);

/// Steps of the scaling: each leaves about a hundredth of the error.
const STEPS: usize = 2;

impl Balance {
    /// `passed` is what the boundary, and a cover, let pass over the cosine.
    pub(super) fn new(matte: &Matte, passed: impl Fn(f32) -> Rgb) -> Self {
        let passed = even_cosines().map(passed);
        let mean = even_mean(&passed).max(Rgb::splat(f32::MIN_POSITIVE));
        let mut factors = passed.map(|_| Rgb::ONE);
        for _ in 0..STEPS {
            factors = sent(matte, &product(&passed, &factors))
                .map(|sent| mean / sent.max(Rgb::splat(f32::MIN_POSITIVE)));
            // What is sent in all is due, too: the scaling alone would swing around that.
            let light = product(&passed, &factors);
            let all = even_mean(&product(&light, &sent(matte, &light))) / (mean * mean);
            let level = all.max(Rgb::splat(f32::MIN_POSITIVE)).map(f32::sqrt);
            factors = factors.map(|factor| factor / level);
        }
        Self(EvenProfile::new(&factors))
    }

    /// The factor for one direction.
    pub(super) fn at(&self, w: Vec3) -> Rgb {
        self.0.at(w.z.abs()).max(Rgb::ZERO)
    }
}

/// What white matter sends to each node of so much light.
fn sent(matte: &Matte, light: &Even<Rgb>) -> Even<Rgb> {
    let missing = even_cosines().map(|cos| matte.missing(cos));
    let between = even_mean(&product(light, &missing.map(Rgb::splat))) / matte.missing_mean();
    let (all, leaning) = (even_mean(light), lean_means(light));
    std::array::from_fn(|node| matte.once(all, leaning[node]) + between * missing[node])
}

fn product(a: &Even<Rgb>, b: &Even<Rgb>) -> Even<Rgb> {
    std::array::from_fn(|node| a[node] * b[node])
}
