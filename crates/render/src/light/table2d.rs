//! A density over the unit square that is constant in each cell of a grid.

use super::sums;
use glam::Vec2;

/// A grid of shares: rows are chosen first, then cells in the row.
///
/// # Source
/// Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th edition, section A.5.6.
#[derive(Debug)]
pub(super) struct Table2d {
    columns: usize,
    /// Running sums of the rows.
    rows: Vec<f64>,
    /// Running sums of the cells within each row, row by row.
    cells: Vec<f64>,
    /// Guides to the rows, and to the cells of each row.
    row_guides: Vec<u32>,
    cell_guides: Vec<u32>,
}

impl Table2d {
    /// A table of shares that are at least 0, row by row; `None` when they are all 0.
    pub(super) fn new(columns: usize, shares: &[f64]) -> Option<Self> {
        let cells: Vec<_> =
            shares.chunks_exact(columns).flat_map(|row| sums::running(row.to_vec())).collect();
        let rows: Vec<_> = sums::running(cells.chunks_exact(columns).map(sums::total)).collect();
        let total = sums::total(&rows);
        let row_guides = sums::guide(&rows).collect();
        let cell_guides = cells.chunks_exact(columns).flat_map(sums::guide).collect();
        let table = Self { columns, rows, cells, row_guides, cell_guides };
        (total > 0.0 && total.is_finite()).then_some(table)
    }

    /// A point of the unit square, and the density there.
    #[inline]
    pub(super) fn sample(&self, u: Vec2) -> (Vec2, f32) {
        let (row, y) = sums::pick_guided(&self.rows, &self.row_guides, u.y);
        let guides = sums::guides(self.columns);
        let cell_guides = &self.cell_guides[row * guides..(row + 1) * guides];
        let (column, x) = sums::pick_guided(self.row(row), cell_guides, u.x);
        let at =
            Vec2::new((column as f32 + x) / self.columns as f32, (row as f32 + y) / self.rows.len() as f32);
        (at, self.density_in(row, column))
    }

    /// The density at a point of the unit square.
    #[inline]
    pub(super) fn density(&self, at: Vec2) -> f32 {
        let cell = |x: f32, count: usize| ((x * count as f32) as usize).min(count - 1);
        self.density_in(cell(at.y, self.rows.len()), cell(at.x, self.columns))
    }

    fn density_in(&self, row: usize, column: usize) -> f32 {
        let cells = self.cells.len() as f64;
        (sums::share(self.row(row), column) * cells / sums::total(&self.rows)) as f32
    }

    fn row(&self, row: usize) -> &[f64] {
        &self.cells[row * self.columns..(row + 1) * self.columns]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_drawn_by_their_share() {
        let shares = [1.0, 0.0, 3.0, 0.0, 0.0, 0.0, 2.0, 2.0, 0.0];
        let table = Table2d::new(3, &shares).unwrap();
        let mut counts = [0_u32; 9];
        let n = 64;
        for i in 0..n * n {
            let u = (Vec2::new((i % n) as f32, (i / n) as f32) + 0.5) / n as f32;
            let (at, pdf) = table.sample(u);
            let cell = (at.y * 3.0) as usize * 3 + (at.x * 3.0) as usize;
            counts[cell] += 1;
            assert!((f64::from(pdf) - 9.0 / 8.0 * shares[cell]).abs() < 1e-5);
            assert_eq!(table.density(at), pdf);
        }
        for (count, share) in counts.into_iter().zip(shares) {
            assert!((f64::from(count) / f64::from(n * n) - share / 8.0).abs() < 1.0 / f64::from(n));
        }
    }

    #[test]
    fn nothing_is_drawn_from_darkness() {
        assert!(Table2d::new(2, &[0.0; 4]).is_none());
    }
}
