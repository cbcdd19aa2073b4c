//! One animation, checked and ready to be evaluated.

use super::curve::{Curve, monotone_slopes};
use super::keyframe::Keyframe;
use super::{AnimationTable, InterpolationName};
use crate::document::{DottedPath, Fault, Node, Placed, Span};
use crate::error::quote;

/// Keys of one target.
#[derive(Clone, Debug)]
pub(crate) struct Track {
    path: DottedPath,
    times: Vec<f64>,
    keys: Vec<Placed<Keyframe>>,
    /// Per component the values at the keys and the curve through them; empty for steps.
    components: Vec<(Vec<f64>, Curve)>,
}

impl Track {
    /// Checks an animation; `raw` gives the text at a span, for the places of the parts of the target.
    ///
    /// # Errors
    /// Where the target is no path, or the keys are out of order or of different forms.
    pub(crate) fn new<'a>(table: &AnimationTable, raw: impl Fn(Span) -> &'a str) -> Result<Self, Fault> {
        let path = target_path(&table.target, raw)?;
        let first = path.segments()[0].text.as_str();
        if matches!(first, "time" | "animation") {
            return Err(Fault::new(format!("{} cannot be animated", quote(first)))
                .with_help("animate a number of another section")
                .or_at(path.segments()[0].span));
        }
        let times = times_in_order(&table.keys)?;
        let components = match table.interpolation.unwrap_or_default() {
            InterpolationName::Step => Vec::new(),
            InterpolationName::Linear => components(&table.keys, |_| Curve::Linear)?,
            InterpolationName::Smooth => {
                components(&table.keys, |values| Curve::Smooth(monotone_slopes(&times, values)))?
            }
        };
        Ok(Self { path, times, keys: table.keys.to_vec(), components })
    }

    /// The target.
    pub(crate) fn path(&self) -> &DottedPath {
        &self.path
    }

    /// Time of the last key in seconds.
    pub(crate) fn last_key(&self) -> f64 {
        self.times[self.times.len() - 1]
    }

    /// The value at `time`; its place is that of the key at or before that time.
    pub(crate) fn at(&self, time: f64) -> Node {
        let last = self.times.len() - 1;
        let i = self.times.partition_point(|&key| key <= time).saturating_sub(1);
        let key = &self.keys[i];
        let span = key.value.span().or(key.span()).unwrap_or_default();
        if i == last || time <= self.times[i] || self.components.is_empty() {
            return key.value.node(span);
        }
        let mut numbers =
            self.components.iter().map(|(values, curve)| curve.between(&self.times, values, i, time));
        key.value.with_numbers(&mut numbers).node(span)
    }
}

/// The path of a target, with places inside its quotes where the text has no escapes.
fn target_path<'a>(target: &Placed<String>, raw: impl Fn(Span) -> &'a str) -> Result<DottedPath, Fault> {
    let whole = target.span().unwrap_or_default();
    let text = raw(whole);
    let is_plain = text.get(1..text.len().saturating_sub(1)) == Some(target.as_str());
    DottedPath::parse(target, whole, is_plain.then_some(whole.start as usize + 1))
}

fn times_in_order(keys: &Placed<Vec<Placed<Keyframe>>>) -> Result<Vec<f64>, Fault> {
    if keys.is_empty() {
        return Err(Fault::new("the animation has no keys")
            .with_help("write keys = [[seconds, value], ...]")
            .or_at(keys.span()));
    }
    for pair in keys.windows(2) {
        if pair[1].time.get() <= pair[0].time.get() {
            return Err(Fault::new("the times of the keys do not grow")
                .with_help("sort the keys by time, one for each")
                .or_at(pair[1].time.span()));
        }
    }
    Ok(keys.iter().map(|key| key.time.get()).collect())
}

/// The numbers of the keys, component by component.
fn components(
    keys: &[Placed<Keyframe>],
    curve: impl Fn(&[f64]) -> Curve,
) -> Result<Vec<(Vec<f64>, Curve)>, Fault> {
    let mut columns: Vec<Vec<f64>> = Vec::new();
    for key in keys {
        let mut numbers = Vec::new();
        key.value.numbers(&mut numbers).ok_or_else(|| {
            Fault::new("only numbers have values in between")
                .with_help("use interpolation = \"step\" here")
                .or_at(key.value.span())
        })?;
        if !key.value.has_form_of(&keys[0].value) {
            return Err(Fault::new("the value has another form than that of the first key")
                .with_help("write a number in every key, or an array of the same length")
                .or_at(key.value.span()));
        }
        columns.resize(numbers.len(), Vec::new());
        for (column, number) in columns.iter_mut().zip(numbers) {
            column.push(number);
        }
    }
    Ok(columns.into_iter().map(|values| (values.clone(), curve(&values))).collect())
}
