//! Animations: keys of translations, turns, scales and weights, and what lies between them.
//!
//! All animations of a file play at once, because many exporters write one per object. Where two of them move the same
//! thing, the first one does.

use super::document::Document;
use super::flaw::Flaw;
use gltf::json::animation::{Channel, Interpolation, Property, Sampler};
use gltf::json::validation::Checked;
use std::collections::HashMap;

/// What a track moves: a property of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Moved {
    Translation,
    Rotation,
    Scale,
    Weights,
}

/// All tracks of a file.
#[derive(Debug, Default)]
pub(super) struct Tracks {
    tracks: HashMap<(usize, Moved), Track>,
}

/// The keys of one property.
#[derive(Debug)]
struct Track {
    /// Seconds, rising.
    times: Vec<f32>,
    /// `width` numbers per key, three times as many for splines.
    values: Vec<f32>,
    width: usize,
    interpolation: Interpolation,
    /// Whether the numbers are a turn.
    is_turn: bool,
}

impl Tracks {
    /// Reads the keys of all animations.
    ///
    /// # Errors
    /// When keys are not there, or are not as many as they must be.
    pub(super) fn of(document: &Document) -> Result<Self, Flaw> {
        let mut tracks = HashMap::new();
        for (i, animation) in document.root.animations.iter().enumerate() {
            for (k, channel) in animation.channels.iter().enumerate() {
                let place = format!("animations[{i}].channels[{k}]");
                let Some(target) = target(document, channel, &place)? else { continue };
                let number = channel.sampler.value();
                let sampler = animation.samplers.get(number);
                let sampler = sampler
                    .ok_or_else(|| Flaw::dangling(place, "samplers", number, animation.samplers.len()))?;
                let place = format!("animations[{i}].samplers[{number}]");
                let track = Track::of(document, sampler, target.1, &place)?;
                // Without keys it moves nothing.
                if !track.times.is_empty() {
                    tracks.entry(target).or_insert(track);
                }
            }
        }
        Ok(Self { tracks })
    }

    /// The numbers of a property at a time, if anything moves it.
    pub(super) fn at(&self, node: usize, moved: Moved, seconds: f64) -> Option<Vec<f32>> {
        self.tracks.get(&(node, moved)).map(|track| track.at(seconds))
    }

    /// The time of the last key in seconds; `None` when nothing moves.
    pub(super) fn last_key(&self) -> Option<f64> {
        let ends = self.tracks.values().filter_map(|track| track.times.last());
        ends.map(|&end| f64::from(end)).filter(|end| end.is_finite()).reduce(f64::max)
    }
}

/// What a channel moves; `None` for what is not read.
fn target(document: &Document, channel: &Channel, place: &str) -> Result<Option<(usize, Moved)>, Flaw> {
    let moved = match channel.target.path {
        Checked::Valid(Property::Translation) => Moved::Translation,
        Checked::Valid(Property::Rotation) => Moved::Rotation,
        Checked::Valid(Property::Scale) => Moved::Scale,
        Checked::Valid(Property::MorphTargetWeights) => Moved::Weights,
        // Those of extensions.
        Checked::Invalid => return Ok(None),
    };
    let (node, count) = (channel.target.node.value(), document.root.nodes.len());
    if node < count { Ok(Some((node, moved))) } else { Err(Flaw::dangling(place, "nodes", node, count)) }
}

impl Track {
    fn of(document: &Document, sampler: &Sampler, moved: Moved, place: &str) -> Result<Self, Flaw> {
        let input = document.accessor(sampler.input.value(), &format!("{place}.input"))?;
        let output = document.accessor(sampler.output.value(), &format!("{place}.output"))?;
        let interpolation = match sampler.interpolation {
            Checked::Valid(interpolation) => interpolation,
            Checked::Invalid => Interpolation::Linear,
        };
        let times: Vec<f32> = (0..input.len()).map(|i| input.floats::<1>(i)[0]).collect();
        let components = output.components().min(4);
        let values = (0..output.len()).flat_map(|i| output.floats::<4>(i).into_iter().take(components));
        let values: Vec<f32> = values.collect();
        let per_key = if interpolation == Interpolation::CubicSpline { 3 } else { 1 };
        let width = match moved {
            Moved::Translation | Moved::Scale => 3,
            Moved::Rotation => 4,
            Moved::Weights => values.len().checked_div(times.len() * per_key).unwrap_or(0),
        };
        if values.len() != times.len() * per_key * width {
            let message = format!("has {} numbers for {} keys", values.len(), times.len());
            return Err(Flaw::new(output.place(), message).with_help("export the file again"));
        }
        let is_finite = times.iter().chain(&values).all(|v| v.is_finite());
        if !is_finite || !times.is_sorted() {
            let message = "has keys that do not follow one another in time, or are no numbers";
            return Err(Flaw::new(place, message).with_help("export the file again"));
        }
        Ok(Self { times, values, width, interpolation, is_turn: moved == Moved::Rotation })
    }

    /// The numbers at a time; before the first and after the last key, those of that key.
    fn at(&self, seconds: f64) -> Vec<f32> {
        let after = self.times.partition_point(|&time| f64::from(time) <= seconds);
        let Some(before) = after.checked_sub(1) else { return self.key(0).to_vec() };
        if after == self.times.len() {
            return self.key(before).to_vec();
        }
        let (start, end) = (f64::from(self.times[before]), f64::from(self.times[after]));
        let share = ((seconds - start) / (end - start)) as f32;
        match self.interpolation {
            Interpolation::Step => self.key(before).to_vec(),
            Interpolation::Linear if self.is_turn => slerp(self.key(before), self.key(after), share),
            Interpolation::Linear => {
                let mix = |(a, b): (&f32, &f32)| a + share * (b - a);
                self.key(before).iter().zip(self.key(after)).map(mix).collect()
            }
            Interpolation::CubicSpline => self.spline(before, share, (end - start) as f32),
        }
    }

    /// The numbers of a key.
    fn key(&self, key: usize) -> &[f32] {
        match self.interpolation {
            Interpolation::CubicSpline => self.row(3 * key + 1),
            Interpolation::Linear | Interpolation::Step => self.row(key),
        }
    }

    fn row(&self, row: usize) -> &[f32] {
        &self.values[row * self.width..][..self.width]
    }

    /// Hermite's spline from a key to the next, `seconds` later.
    fn spline(&self, before: usize, t: f32, seconds: f32) -> Vec<f32> {
        let rows = [3 * before + 1, 3 * before + 2, 3 * before + 4, 3 * before + 3].map(|row| self.row(row));
        let (t2, t3) = (t * t, t * t * t);
        let weights = [
            2.0 * t3 - 3.0 * t2 + 1.0,
            seconds * (t3 - 2.0 * t2 + t),
            -2.0 * t3 + 3.0 * t2,
            seconds * (t3 - t2),
        ];
        (0..self.width).map(|i| weights.iter().zip(rows).map(|(weight, row)| weight * row[i]).sum()).collect()
    }
}

/// Between two turns, the short way round.
fn slerp(a: &[f32], b: &[f32], share: f32) -> Vec<f32> {
    let turn = |v: &[f32]| glam::Quat::from_slice(v).normalize();
    let mixed = turn(a).slerp(turn(b), share);
    if mixed.is_finite() { mixed.to_array().to_vec() } else { a.to_vec() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn track(interpolation: Interpolation, values: &[f32], width: usize) -> Track {
        Track { times: vec![1.0, 3.0], values: values.to_vec(), width, interpolation, is_turn: width == 4 }
    }

    #[test]
    fn steps_hold_and_lines_go_straight() {
        let step = track(Interpolation::Step, &[1.0, 5.0], 1);
        let line = track(Interpolation::Linear, &[1.0, 5.0], 1);
        let at = |track: &Track| [0.0, 1.0, 2.0, 2.5, 3.0, 9.0].map(|t| track.at(t)[0]);
        assert_eq!(at(&step), [1.0, 1.0, 1.0, 1.0, 5.0, 5.0]);
        assert_eq!(at(&line), [1.0, 1.0, 3.0, 4.0, 5.0, 5.0]);
    }

    #[test]
    fn splines_keep_their_slopes() {
        // In-slope, value, out-slope: a parabola t^2 from t = 1 to t = 3.
        let spline = track(Interpolation::CubicSpline, &[0.0, 1.0, 2.0, 6.0, 9.0, 0.0], 1);
        for t in [1.0, 1.5, 2.25, 3.0_f64] {
            assert!((f64::from(spline.at(t)[0]) - t * t).abs() < 1e-5, "{t}");
        }
    }

    #[test]
    fn turns_go_the_short_way_at_an_even_pace() {
        let half = std::f32::consts::FRAC_1_SQRT_2;
        // A quarter turn about x, its end written with the other sign.
        let turn = track(Interpolation::Linear, &[0.0, 0.0, 0.0, 1.0, -half, 0.0, 0.0, -half], 4);
        let (sin, cos) = (std::f32::consts::PI / 8.0).sin_cos();
        let mid = turn.at(2.0);
        assert!((mid[0] - sin).abs() < 1e-6 && (mid[3] - cos).abs() < 1e-6, "{mid:?}");
    }
}
