//! How much light a lamp sends in which direction, as it was measured.

use std::f32::consts::{PI, TAU};

/// Luminous intensities over directions, in candela; between the measured ones linear in both angles.
///
/// The vertical angle runs from the axis of the lamp, the horizontal one around it. What is measured over a quarter or a half
/// of the turn is mirrored to the rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// In radians from the axis, ascending.
    vertical: Vec<f32>,
    /// In radians around it, ascending from the first.
    horizontal: Vec<f32>,
    /// For each horizontal angle, one for each vertical angle.
    candela: Vec<f32>,
}

impl Profile {
    /// A profile of measured values; `None` unless both lists of angles ascend in `[0, pi]` and `[0, 2 pi]`, the horizontal ones
    /// cover none, a quarter, a half or all of the turn, and there is a finite intensity of at least 0 for each pair.
    pub fn new(vertical: Vec<f32>, horizontal: Vec<f32>, candela: Vec<f32>) -> Option<Self> {
        let ascends = |angles: &[f32], most: f32| {
            let within = angles.iter().all(|a| (0.0..=most).contains(a));
            !angles.is_empty() && within && angles.windows(2).all(|pair| pair[0] < pair[1])
        };
        let is_whole = ascends(&vertical, PI.next_up()) && ascends(&horizontal, TAU.next_up());
        let is_measured = candela.iter().all(|c| c.is_finite() && *c >= 0.0);
        let fits = Some(candela.len()) == vertical.len().checked_mul(horizontal.len());
        (is_whole && is_measured && fits).then_some(Self { vertical, horizontal, candela })
    }

    /// The intensity at a vertical and a horizontal angle in radians; 0 beyond what was measured.
    ///
    /// ```
    /// use heliostat_scene::Profile;
    ///
    /// let lamp = Profile::new(vec![0.0, 1.0], vec![0.0], vec![100.0, 50.0]).unwrap();
    /// assert_eq!([lamp.intensity(0.5, 2.0), lamp.intensity(1.5, 0.0)], [75.0, 0.0]);
    /// ```
    pub fn intensity(&self, vertical: f32, horizontal: f32) -> f32 {
        let (first, last) = (self.vertical[0], self.vertical[self.vertical.len() - 1]);
        if !(first..=last).contains(&vertical) {
            return 0.0;
        }
        let (row, y) = split(&self.horizontal, self.folded(horizontal));
        let (column, x) = split(&self.vertical, vertical);
        let at = |row: usize, column: usize| {
            let column = column.min(self.vertical.len() - 1);
            self.candela[row.min(self.horizontal.len() - 1) * self.vertical.len() + column]
        };
        let along = |row: usize| (1.0 - x) * at(row, column) + x * at(row, column + 1);
        (1.0 - y) * along(row) + y * along(row + 1)
    }

    /// The largest intensity.
    pub fn peak(&self) -> f32 {
        self.candela.iter().copied().fold(0.0, f32::max)
    }

    /// The angle from the axis from which on there is no light.
    pub fn reach(&self) -> f32 {
        let columns = self.vertical.len();
        let shines = |column: &usize| self.candela.iter().skip(*column).step_by(columns).any(|&c| c > 0.0);
        match (0..columns).rev().find(shines) {
            Some(column) => self.vertical[(column + 1).min(columns - 1)],
            None => 0.0,
        }
    }

    /// The measured horizontal angle that stands for any.
    fn folded(&self, horizontal: f32) -> f32 {
        let turn = horizontal.rem_euclid(TAU);
        let (first, last) = (self.horizontal[0], self.horizontal[self.horizontal.len() - 1]);
        let span = last - first;
        if span > 1.5 * PI {
            return turn;
        }
        // Mirrored at the plane in which the measured half ends; then a quarter at the plane across.
        let half = if first > 0.25 * PI { (turn - first).rem_euclid(TAU) } else { turn };
        let half = if half > PI { TAU - half } else { half };
        first + if span < 0.75 * PI && half > 0.5 * PI { PI - half } else { half }
    }
}

/// The last value that is not larger, and the share of the way to the next.
fn split(values: &[f32], at: f32) -> (usize, f32) {
    let i = values.partition_point(|&value| value <= at).saturating_sub(1);
    match values.get(i + 1) {
        Some(next) => (i, ((at - values[i]) / (next - values[i])).clamp(0.0, 1.0)),
        None => (i, 0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn around(horizontal: &[f32]) -> Profile {
        let angles: Vec<f32> = horizontal.iter().map(|a| a.to_radians()).collect();
        Profile::new(vec![0.0, 1.0], angles, horizontal.iter().flat_map(|&a| [a, a]).collect()).unwrap()
    }

    #[test]
    fn what_was_measured_in_part_is_mirrored() {
        let at = |profile: &Profile, degrees: f32| profile.intensity(0.5, degrees.to_radians()).round();
        let (quarter, half, other) =
            (around(&[0.0, 45.0, 90.0]), around(&[0.0, 90.0, 180.0]), around(&[90.0, 180.0, 270.0]));
        for (turn, in_quarter, in_half, in_other) in [
            (30.0, 30.0, 30.0, 150.0),
            (120.0, 60.0, 120.0, 120.0),
            (200.0, 20.0, 160.0, 200.0),
            (300.0, 60.0, 60.0, 240.0),
            (-30.0, 30.0, 30.0, 210.0),
        ] {
            assert_eq!(at(&quarter, turn), in_quarter, "{turn}");
            assert_eq!(at(&half, turn), in_half, "{turn}");
            assert_eq!(at(&other, turn), in_other, "{turn}");
        }
        assert_eq!(at(&around(&[0.0, 90.0, 360.0]), 225.0), 225.0);
        assert_eq!(at(&around(&[0.0]), 77.0), 0.0);
    }

    #[test]
    fn light_ends_where_the_last_of_it_was_measured() {
        let lamp = Profile::new(vec![0.0, 0.5, 1.0, 1.5], vec![0.0], vec![4.0, 8.0, 0.0, 0.0]).unwrap();
        assert_eq!((lamp.peak(), lamp.reach()), (8.0, 1.0));
    }

    #[test]
    fn nonsense_is_no_profile() {
        assert!(Profile::new(vec![0.0, 0.0], vec![0.0], vec![1.0, 1.0]).is_none());
        assert!(Profile::new(vec![0.0, 4.0], vec![0.0], vec![1.0, 1.0]).is_none());
        assert!(Profile::new(vec![0.0, 1.0], vec![0.0], vec![1.0]).is_none());
        assert!(Profile::new(vec![0.0, 1.0], vec![0.0], vec![1.0, f32::NAN]).is_none());
        assert!(Profile::new(vec![], vec![], vec![]).is_none());
    }
}
