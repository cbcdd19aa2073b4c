//! Density on a grid, and the largest density in each block of its cells.
//!
//! # Source
//! Amanatides, Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", Eurographics 1987, for the way through the blocks.

use super::flight::Way;
use glam::{Affine3A, IVec3, Vec3};
use heliostat_scene::medium::DensityGrid;

/// Cells along one side of a block.
const BLOCK: u32 = 8;

/// A grid made ready.
#[derive(Debug)]
pub(crate) struct Grid<'s> {
    grid: &'s DensityGrid,
    /// From world space to the unit cube.
    to_unit: Affine3A,
    /// Blocks along each axis, and the largest density that is found in each.
    counts: IVec3,
    most: Vec<f32>,
}

/// A part of a way on which the density has a bound.
#[derive(Clone, Copy, Debug)]
pub(super) struct Block {
    /// Above 0.
    pub(super) most: f32,
    pub(super) from: f32,
    pub(super) to: f32,
}

impl<'s> Grid<'s> {
    pub(super) fn new(grid: &'s DensityGrid) -> Self {
        let counts = IVec3::from_array(grid.size.map(|n| n.div_ceil(BLOCK) as i32));
        let (x, y, z) = (counts.x, counts.y, counts.z);
        let places = (0..z).flat_map(|k| (0..y).flat_map(move |j| (0..x).map(move |i| IVec3::new(i, j, k))));
        let mut this =
            Self { grid, to_unit: grid.place.inverse_matrix().as_affine3a(), counts, most: Vec::new() };
        this.most = places.map(|block| this.most_in(block)).collect();
        this
    }

    /// The density at a point of world space, by linear interpolation between the middles of cells.
    pub(super) fn density(&self, p: Vec3) -> f32 {
        let unit = self.to_unit.transform_point3(p);
        let size = self.size();
        let at = unit * size.as_vec3() - 0.5;
        let low = at.floor();
        let f = at - low;
        let low = low.as_ivec3();
        let row = |dy: i32, dz: i32| {
            let a = self.cell(low + IVec3::new(0, dy, dz));
            let b = self.cell(low + IVec3::new(1, dy, dz));
            a + f.x * (b - a)
        };
        let face = |dz: i32| {
            let (a, b) = (row(0, dz), row(1, dz));
            a + f.y * (b - a)
        };
        let (a, b) = (face(0), face(1));
        a + f.z * (b - a)
    }

    /// The parts of a way through blocks that are not empty, in order.
    pub(super) fn blocks(&self, way: &Way) -> Blocks<'_> {
        Blocks::new(self, way)
    }

    fn size(&self) -> IVec3 {
        IVec3::from_array(self.grid.size.map(|n| n as i32))
    }

    /// The density of a cell; beyond the border that of the nearest one.
    #[inline]
    fn cell(&self, at: IVec3) -> f32 {
        let size = self.size();
        let at = at.clamp(IVec3::ZERO, size - 1);
        self.grid.values[(at.z as usize * size.y as usize + at.y as usize) * size.x as usize + at.x as usize]
    }

    /// The largest density in a block: of all cells that interpolation looks at there.
    fn most_in(&self, block: IVec3) -> f32 {
        let size = self.size();
        // A block covers an equal share of the cube, which need not end where cells end.
        let share = |i: IVec3| i.as_dvec3() / self.counts.as_dvec3() * size.as_dvec3() - 0.5;
        let low = share(block).floor().as_ivec3().clamp(IVec3::ZERO, size - 1);
        let high = (share(block + 1).floor().as_ivec3() + 1).clamp(IVec3::ZERO, size - 1);
        let mut most = 0.0_f32;
        for z in low.z..=high.z {
            for y in low.y..=high.y {
                for x in low.x..=high.x {
                    most = most.max(self.cell(IVec3::new(x, y, z)));
                }
            }
        }
        most
    }
}

/// The way of a ray through the blocks.
#[derive(Debug)]
pub(super) struct Blocks<'g> {
    grid: &'g Grid<'g>,
    block: IVec3,
    step: IVec3,
    /// Where the ray enters the next block along each axis, and how far it is from there to the one after.
    next: Vec3,
    apart: Vec3,
    t: f32,
    end: f32,
}

impl<'g> Blocks<'g> {
    fn new(grid: &'g Grid<'g>, way: &Way) -> Self {
        let counts = grid.counts.as_vec3();
        // In blocks, and per metre.
        let origin = grid.to_unit.transform_point3(way.origin) * counts;
        let dir = grid.to_unit.transform_vector3(way.dir) * counts;
        let inverse = dir.recip();
        let (a, b) = ((Vec3::ZERO - origin) * inverse, (counts - origin) * inverse);
        // A ray in a plane of the border: 0 times infinity, which minimum and maximum leave out.
        let is_beside = dir.cmpeq(Vec3::ZERO) & (origin.cmplt(Vec3::ZERO) | origin.cmpgt(counts));
        let near = Vec3::select(dir.cmpeq(Vec3::ZERO), Vec3::NEG_INFINITY, a.min(b)).max_element();
        let far = Vec3::select(dir.cmpeq(Vec3::ZERO), Vec3::INFINITY, a.max(b)).min_element();
        let (t, end) = (near.max(way.from), far.min(way.to));
        let end = if is_beside.any() { f32::NEG_INFINITY } else { end };
        let start = origin + t * dir;
        let block = start.floor().as_ivec3().clamp(IVec3::ZERO, grid.counts - 1);
        let step = IVec3::select(dir.cmpge(Vec3::ZERO), IVec3::ONE, IVec3::NEG_ONE);
        let border = (block + step.max(IVec3::ZERO)).as_vec3();
        let next = Vec3::select(dir.cmpeq(Vec3::ZERO), Vec3::INFINITY, (border - origin) * inverse);
        Self { grid, block, step, next, apart: inverse.abs(), t, end }
    }
}

impl Iterator for Blocks<'_> {
    type Item = Block;

    fn next(&mut self) -> Option<Block> {
        loop {
            // False for numbers that are none.
            let goes_on = self.t < self.end;
            if !goes_on {
                return None;
            }
            let counts = self.grid.counts;
            let (block, from) = (self.block, self.t);
            let axis = self.next.min_position();
            let to = self.next[axis].min(self.end).max(from);
            self.t = to;
            self.next[axis] += self.apart[axis];
            self.block[axis] += self.step[axis];
            if self.block[axis] < 0 || self.block[axis] >= counts[axis] {
                // Rounding aside the end is here; what is left of the way is of that length.
                self.end = f32::NEG_INFINITY;
            }
            let most = self.grid.most[((block.z * counts.y + block.y) * counts.x + block.x) as usize];
            if most > 0.0 && to > from {
                return Some(Block { most, from, to });
            }
        }
    }
}
