//! Curves on two logarithmic axes, as PNG: lines, marks and letters of 8 x 8 pixels are all it takes.

use crate::Outcome;
use font8x8::{BASIC_FONTS, UnicodeFonts};
use image::{Rgb, RgbImage};
use std::ops::RangeInclusive;
use std::path::Path;

const SIZE: (u32, u32) = (960, 640);
/// Left, top, right and bottom of the field of curves.
const FIELD: [f64; 4] = [90.0, 50.0, 640.0, 590.0];
/// Side of a letter.
const LETTER: i32 = 8;
const INK: Rgb<u8> = Rgb([30, 30, 30]);
const GRID: Rgb<u8> = Rgb([215, 215, 215]);
/// Colours that the colour-blind tell apart (Okabe and Ito, "Color Universal Design", 2008), dark enough for white paper.
const COLOURS: [Rgb<u8>; 7] = [
    Rgb([0, 114, 178]),
    Rgb([86, 180, 233]),
    Rgb([213, 94, 0]),
    Rgb([230, 159, 0]),
    Rgb([0, 120, 90]),
    Rgb([90, 190, 130]),
    Rgb([170, 90, 140]),
];

/// A named curve of points, both coordinates above 0.
pub(super) struct Curve {
    pub(super) name: String,
    pub(super) points: Vec<(f64, f64)>,
}

/// Curves under a title.
pub(super) struct Plot {
    pub(super) title: String,
    pub(super) curves: Vec<Curve>,
}

impl Plot {
    /// Draws it into a file.
    pub(super) fn save(&self, path: &Path) -> Outcome {
        let mut canvas = Canvas(RgbImage::from_pixel(SIZE.0, SIZE.1, Rgb([255; 3])));
        let axes = Axes::over(&self.curves);
        axes.draw(&mut canvas);
        canvas.text(12, 14, &self.title, INK);
        for (i, curve) in self.curves.iter().enumerate() {
            let colour = COLOURS[i % COLOURS.len()];
            let places: Vec<_> = curve.points.iter().map(|&p| axes.place(p)).collect();
            places.windows(2).for_each(|pair| canvas.line(pair[0], pair[1], colour));
            places.iter().for_each(|&place| canvas.mark(place, colour));
            let y = FIELD[1] + 8.0 + 30.0 * i as f64;
            canvas.mark((FIELD[2] + 16.0, y + 4.0), colour);
            canvas.text(FIELD[2] as i32 + 30, y as i32, &curve.name, INK);
        }
        canvas.0.save(path).map_err(|e| format!("{}: {e}", path.display()))
    }
}

/// The logarithms that the field spans, in powers of two to the right and of ten upward.
struct Axes {
    x: RangeInclusive<f64>,
    y: RangeInclusive<f64>,
}

impl Axes {
    fn over(curves: &[Curve]) -> Self {
        let all = || curves.iter().flat_map(|curve| &curve.points);
        let span = |values: &mut dyn Iterator<Item = f64>| {
            let finite = values.filter(|v| v.is_finite());
            let (low, high) =
                finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
            // A little room above and below, and something to show where there is one value or none.
            if low < high { low - 0.1..=high + 0.1 } else { -1.0..=1.0 }
        };
        Self { x: span(&mut all().map(|p| p.0.log2())), y: span(&mut all().map(|p| p.1.log10())) }
    }

    fn place(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let share = |v: f64, range: &RangeInclusive<f64>| (v - range.start()) / (range.end() - range.start());
        let (across, up) = (share(x.log2(), &self.x), share(y.log10(), &self.y));
        (FIELD[0] + across * (FIELD[2] - FIELD[0]), FIELD[3] - up * (FIELD[3] - FIELD[1]))
    }

    /// The grid with its numbers, and the line of pure chance, slope -1/2.
    fn draw(&self, canvas: &mut Canvas) {
        let whole = |range: &RangeInclusive<f64>| range.start().ceil() as i32..=range.end().floor() as i32;
        for power in whole(&self.x) {
            let value = f64::from(power).exp2();
            let (x, _) = self.place((value, 1.0));
            canvas.line((x, FIELD[1]), (x, FIELD[3]), GRID);
            let label = format!("{value}");
            canvas.text(x as i32 - LETTER / 2 * label.len() as i32, FIELD[3] as i32 + 10, &label, INK);
        }
        for power in whole(&self.y) {
            for digit in [1.0, 2.0, 5.0] {
                self.draw_level(canvas, digit * 10_f64.powi(power));
            }
        }
        // Below the first whole power of ten.
        let below = 10_f64.powi(*whole(&self.y).start() - 1);
        [2.0, 5.0].iter().for_each(|digit| self.draw_level(canvas, digit * below));
        let corners = [(FIELD[0], FIELD[1]), (FIELD[0], FIELD[3]), (FIELD[2], FIELD[3])];
        corners.windows(2).for_each(|pair| canvas.line(pair[0], pair[1], INK));
        self.draw_chance(canvas);
    }

    fn draw_level(&self, canvas: &mut Canvas, value: f64) {
        if self.y.contains(&value.log10()) {
            let (_, y) = self.place((1.0, value));
            canvas.line((FIELD[0], y), (FIELD[2], y), GRID);
            let label = format!("{value:>9.1e}");
            canvas.text(8, y as i32 - LETTER / 2, &label, INK);
        }
    }

    fn draw_chance(&self, canvas: &mut Canvas) {
        let (left, right) = (self.x.start() + 0.1, self.x.end() - 0.1);
        let top = self.y.end() - 0.1;
        let bottom = top - 0.5 * (right - left) * 2_f64.log10();
        let at = |x: f64, y: f64| self.place((x.exp2(), 10_f64.powf(y)));
        let (a, b) = (at(left, top), at(right, bottom));
        // Dashes.
        let between = |t: f64| (a.0 + t * (b.0 - a.0), a.1 + t * (b.1 - a.1));
        for dash in 0..40 {
            let t = f64::from(dash) / 40.0;
            let (from, to) = (between(t), between(t + 0.5 / 40.0));
            if to.1 < FIELD[3] {
                canvas.line(from, to, INK);
            }
        }
        canvas.text(FIELD[2] as i32 + 30, FIELD[3] as i32 - 12, "- - pure chance  -0.50", INK);
    }
}

struct Canvas(RgbImage);

impl Canvas {
    fn dot(&mut self, x: i32, y: i32, colour: Rgb<u8>) {
        if let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y))
            && x < self.0.width()
            && y < self.0.height()
        {
            self.0.put_pixel(x, y, colour);
        }
    }

    fn line(&mut self, a: (f64, f64), b: (f64, f64), colour: Rgb<u8>) {
        let steps = (b.0 - a.0).abs().max((b.1 - a.1).abs()).ceil().clamp(1.0, 1e5) as i32;
        for i in 0..=steps {
            let t = f64::from(i) / f64::from(steps);
            let (x, y) = (a.0 + t * (b.0 - a.0), a.1 + t * (b.1 - a.1));
            self.dot(x.round() as i32, y.round() as i32, colour);
        }
    }

    fn mark(&mut self, (x, y): (f64, f64), colour: Rgb<u8>) {
        for dy in -3..=3 {
            (-3..=3).for_each(|dx| self.dot(x.round() as i32 + dx, y.round() as i32 + dy, colour));
        }
    }

    /// A line of text with its upper left corner at `x`, `y`; letters that the font does not have are left out.
    fn text(&mut self, x: i32, y: i32, text: &str, colour: Rgb<u8>) {
        for (letter, left) in text.chars().zip((x..).step_by(LETTER as usize)) {
            let rows = BASIC_FONTS.get(letter).unwrap_or_default();
            for (row, bits) in (0..).zip(rows) {
                let columns = (0..LETTER).filter(|column| bits >> column & 1 == 1);
                columns.for_each(|column| self.dot(left + column, y + row, colour));
            }
        }
    }
}
