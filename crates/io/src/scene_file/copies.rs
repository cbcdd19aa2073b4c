//! `copies = { .. }` of an `[[object]]`: a regular array, with a little disorder where it is wanted.
//!
//! The copies stand in the space of the object, whose `scale`, `rotate` and `translate` then place all of them. They are one
//! object: one name, one mark in the layers, one movement. A copy takes about a hundred bytes, whatever it shows.
//!
//! # Scene file
//! ```toml
//! [[object]]
//! group = "tree"                 # or a mesh, or a shape
//! [object.copies]
//! count = [100, 1, 100]          # along x, y and z
//! step = [3, 0, 3]               # metres from one to the next along each axis
//! centered = true                # around the origin of the object; else the first copy stands there
//! [object.copies.jitter]         # each copy differs by chance, up to so much to both sides
//! translate = [1, 0, 1]          # metres
//! rotate = [0, 180, 0]           # degrees
//! scale = 0.2                    # a factor from 0.8 to 1.2
//! seed = 7                       # another seed, another chance
//! ```

use super::number::{Count, Fraction};
use super::placement::rotation;
use super::value::{Point, vector};
use crate::document::{Fault, Placed};
use glam::{DAffine3, DMat3, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Copies of all objects of a file, at most.
pub(super) const MOST_COPIES: u64 = 4_000_000;

/// A regular array of copies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CopiesTable {
    /// How many along x, y and z.
    pub count: Placed<[Count; 3]>,
    /// Metres from one copy to the next along x, y and z.
    pub step: Point,
    /// Whether the origin of the object is the middle of the array instead of its first copy; `false` if left out.
    #[serde(default)]
    pub centered: bool,
    /// By how much copies differ, by chance.
    pub jitter: Option<JitterTable>,
}

/// By how much copies differ at most, to both sides.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct JitterTable {
    /// Shift in metres along x, y and z; none if left out.
    pub translate: Option<Point>,
    /// Turn in degrees about x, then y, then z; none if left out.
    pub rotate: Option<Point>,
    /// Scale, as a share: 0.2 gives factors from 0.8 to 1.2; none if left out.
    pub scale: Option<Fraction>,
    /// Seed of the chance; 0 if left out.
    pub seed: Option<u64>,
}

impl CopiesTable {
    /// How many there are.
    pub(super) fn total(&self) -> u64 {
        self.count.iter().fold(1, |total, count| u64::from(count.u32()).saturating_mul(total))
    }

    /// Refuses more copies than memory should be asked for; `before` are those of other objects.
    ///
    /// # Errors
    /// At the count.
    pub(super) fn check(&self, before: u64) -> Result<u64, Fault> {
        let total = before.saturating_add(self.total());
        if total <= MOST_COPIES {
            return Ok(total);
        }
        Err(Fault::new(format!("the file asks for {total} copies, {MOST_COPIES} is the most"))
            .with_help("put copies into a [[group]] and make copies of that: they multiply")
            .or_at(self.count.span()))
    }

    /// The maps from the space of one copy to that of the object; x runs fastest, then y.
    pub(super) fn places(&self) -> Vec<DAffine3> {
        let counts = self.count.map(Count::u32);
        let step = vector(&self.step);
        let last = DVec3::from_array(counts.map(|count| f64::from(count - 1)));
        let first = if self.centered { -0.5 * last * step } else { DVec3::ZERO };
        let mut places = Vec::with_capacity(self.total() as usize);
        for z in 0..counts[2] {
            for y in 0..counts[1] {
                for x in 0..counts[0] {
                    let at = first + DVec3::new(f64::from(x), f64::from(y), f64::from(z)) * step;
                    let copy = places.len() as u64;
                    places.push(match &self.jitter {
                        Some(jitter) => jitter.place(at, copy),
                        None => DAffine3::from_translation(at),
                    });
                }
            }
        }
        places
    }
}

impl JitterTable {
    /// The place of a copy that stands at `at`, without chance.
    fn place(&self, at: DVec3, copy: u64) -> DAffine3 {
        let seed = self.seed.unwrap_or(0);
        let chance = |draw: u64| 2.0 * uniform(seed, copy, draw) - 1.0;
        let each = |most: &Option<Point>, first: u64| {
            let most = most.as_ref().map_or(DVec3::ZERO, vector);
            most * DVec3::new(chance(first), chance(first + 1), chance(first + 2))
        };
        let scale = 1.0 + self.scale.map_or(0.0, Fraction::get) * chance(6);
        let matrix3 = rotation(each(&self.rotate, 3)) * DMat3::from_diagonal(DVec3::splat(scale));
        DAffine3 { matrix3, translation: at + each(&self.translate, 0) }
    }
}

/// A number between 0 and 1, both excluded, that is the same on every machine.
///
/// # Source
/// Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014 (`SplitMix64`).
fn uniform(seed: u64, copy: u64, draw: u64) -> f64 {
    let step = |state: u64| {
        let mut z = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    };
    let bits = step(step(step(seed) ^ copy) ^ draw) >> 12;
    // 52 bits and a half: exact, and neither 0 nor 1.
    (bits as f64 + 0.5) / (1_u64 << 52) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(text: &str) -> CopiesTable {
        toml::from_str(text).unwrap()
    }

    #[test]
    fn an_array_runs_along_x_first_and_may_be_centered() {
        let at = |text: &str| -> Vec<[f64; 3]> {
            table(text).places().iter().map(|place| place.translation.to_array()).collect()
        };
        let rows = "count = [2, 1, 2]\nstep = [3, 9, 5]";
        assert_eq!(at(rows), [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, 5.0], [3.0, 0.0, 5.0]]);
        let centered = format!("{rows}\ncentered = true");
        assert_eq!(at(&centered), [[-1.5, 0.0, -2.5], [1.5, 0.0, -2.5], [-1.5, 0.0, 2.5], [1.5, 0.0, 2.5]]);
    }

    #[test]
    fn chance_stays_in_its_bounds_fills_them_and_is_the_same_again() {
        let text = "count = [500, 1, 1]\nstep = [10, 0, 0]\n\
                    jitter = { translate = [1, 2, 0], rotate = [0, 90, 0], scale = 0.5, seed = 3 }";
        let places = table(text).places();
        assert_eq!(places, table(text).places());
        assert_ne!(places, table(&text.replace("seed = 3", "seed = 4")).places());
        let shift = |i: usize| places[i].translation - DVec3::new(10.0 * i as f64, 0.0, 0.0);
        let scale = |i: usize| places[i].matrix3.y_axis.length();
        for (i, place) in places.iter().enumerate() {
            let by = shift(i);
            assert!(by.x.abs() < 1.0 && by.y.abs() < 2.0 && by.z == 0.0, "{by}");
            assert!(scale(i) > 0.5 && scale(i) < 1.5);
            // Turned about y by at most a right angle: x never points back.
            assert!(place.matrix3.x_axis.x >= 0.0 && place.matrix3.x_axis.y == 0.0);
        }
        let spread = |value: &dyn Fn(usize) -> f64| {
            let values = (0..500).map(value);
            values.fold((f64::MAX, f64::MIN), |(low, high), v| (low.min(v), high.max(v)))
        };
        let (low, high) = spread(&|i| shift(i).x);
        assert!(low < -0.95 && high > 0.95);
        let (low, high) = spread(&scale);
        assert!(low < 0.53 && high > 1.47);
        let mean = (0..500).map(|i| shift(i).x).sum::<f64>() / 500.0;
        // The mean of 500 even chances has a deviation of 0.026.
        assert!(mean.abs() < 0.1);
    }
}
