//! The tables as they are stored, made by `cargo xtask assets`: values at Chebyshev's nodes, the last axis first.

use super::chebyshev::weights;

/// Nodes of the cosine of a direction, of everything.
pub(crate) const COS: usize = 16;
/// Nodes of the roughness.
pub(crate) const WIDTH: usize = 9;
/// Nodes of the roughness for curves of reflectance: what narrow facets do to them moves with the width.
pub(crate) const FINE_WIDTH: usize = 17;
/// Nodes of a curve of reflectance over the cosine.
pub(crate) const CURVE: usize = 12;
/// Heights of light lower than the viewer; see [`super::stopped`].
pub(crate) const LOWER: usize = 8;
/// Nodes of the index of refraction, seen from the side of the smaller and of the larger one, and of the roughness for glass.
pub(crate) const INDEX: [usize; 2] = [9, 11];
pub(crate) const GLASS_WIDTH: usize = 10;
/// Pieces of the cosine on the denser side of glass, and nodes of each; see [`super::edge`].
pub(crate) const PIECES: usize = 3;
pub(crate) const EDGE: usize = 16;
/// Nodes of the strength by which highlights are drawn out, and of the turn from one tangent to the other.
pub(crate) const STRENGTH: usize = 7;
pub(crate) const TURN: usize = 5;
/// Nodes for what glass loses more where highlights are drawn out: of the index, of the width along and across a direction, of
/// a curve of reflectance, of the cosine, and of that in each piece.
pub(crate) const DRAWN_INDEX: usize = 6;
pub(crate) const DRAWN_WIDTH: usize = 6;
pub(crate) const DRAWN_CURVE: usize = 6;
pub(crate) const DRAWN_COS: usize = 12;
pub(crate) const DRAWN_EDGE: usize = 8;
/// Nodes of the roughness of fibres, and of light that they send to a viewer from lower directions.
pub(crate) const FIBRES: usize = 12;
/// Angles at which fibres are known, evenly over [`super::sheen`]'s axis: too steep at its start for polynomials.
pub(crate) const STEEP: usize = 129;

/// A table with numbers at the nodes of its axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Table {
    start: usize,
    len: usize,
}

const fn after(before: Table, len: usize) -> Table {
    Table { start: before.start + before.len, len }
}

/// `[FINE_WIDTH][COS]`: share of the light that facets which reflect all keep at first.
pub(crate) const LOST: Table = Table { start: 0, len: FINE_WIDTH * COS };
/// `[FINE_WIDTH][COS][CURVE]`: weights of a curve's nodes in its mean over the facets whose light gets away.
pub(crate) const ANGLES: Table = after(LOST, FINE_WIDTH * COS * CURVE);
/// `[WIDTH][COS][LOWER][CURVE]`: weights of nodes, and of a curve's nodes, in light from lower than the viewer.
pub(crate) const LOWERS: Table = after(ANGLES, WIDTH * COS * LOWER * CURVE);
/// `[INDEX][GLASS_WIDTH][COS][1 + CURVE]`: what facets of glass keep at first, without reflection and by a curve of reflectance, of
/// light on the side of the smaller index.
pub(crate) const GLASS: Table = after(LOWERS, INDEX[0] * GLASS_WIDTH * COS * (1 + CURVE));
/// `[INDEX][GLASS_WIDTH][PIECES][EDGE][1 + CURVE]`: the same on the side of the larger index, in pieces around total reflection.
pub(crate) const INNER_GLASS: Table = after(GLASS, INDEX[1] * GLASS_WIDTH * PIECES * EDGE * (1 + CURVE));
/// `[WIDTH][STRENGTH][TURN][COS]`: the same share for highlights that are drawn out.
pub(crate) const DRAWN_OUT: Table = after(INNER_GLASS, WIDTH * STRENGTH * TURN * COS);
/// `[WIDTH][STRENGTH][TURN][COS][CURVE]`: [`ANGLES`] of them.
pub(crate) const DRAWN_ANGLES: Table = after(DRAWN_OUT, WIDTH * STRENGTH * TURN * COS * CURVE);
/// `[DRAWN_INDEX][DRAWN_WIDTH][DRAWN_WIDTH][DRAWN_COS][1 + DRAWN_CURVE]`: by the width along a direction and across, what is lost
/// more than in [`GLASS`] of the width along it.
pub(crate) const DRAWN_GLASS: Table = after(DRAWN_ANGLES, DRAWN_PLANES * DRAWN_COS * (1 + DRAWN_CURVE));
/// `[DRAWN_INDEX][DRAWN_WIDTH][DRAWN_WIDTH][PIECES][DRAWN_EDGE][1 + DRAWN_CURVE]`: the same for [`INNER_GLASS`].
pub(crate) const DRAWN_INNER: Table =
    after(DRAWN_GLASS, DRAWN_PLANES * PIECES * DRAWN_EDGE * (1 + DRAWN_CURVE));
const DRAWN_PLANES: usize = DRAWN_INDEX * DRAWN_WIDTH * DRAWN_WIDTH;
/// `[FIBRES][STEEP]`: share of the light that fibres send back.
pub(crate) const SHEEN: Table = after(DRAWN_INNER, FIBRES * STEEP);
/// `[FIBRES][COS][LOWER]`: weights of nodes in light that they send back from lower than the viewer.
pub(crate) const SHEEN_LOWERS: Table = after(SHEEN, FIBRES * COS * LOWER);
/// `[COS][COS]`: weights of nodes in the mean of how light leans at rough matte matter.
pub(crate) const LEAN: Table = after(SHEEN_LOWERS, COS * COS);
/// How many numbers there are.
pub(crate) const COUNT: usize = LEAN.start + LEAN.len;

static BYTES: &[u8; 4 * COUNT] = include_bytes!("tables.f32");

impl Table {
    /// All tables as one.
    #[cfg(test)]
    pub(crate) const ALL: Self = Self { start: 0, len: COUNT };

    /// The numbers from one on, in their order.
    pub(crate) fn from(self, first: usize) -> impl Iterator<Item = f32> {
        let bytes = &BYTES[4 * (self.start + first)..4 * (self.start + self.len)];
        bytes.as_chunks().0.iter().map(|bytes| f32::from_le_bytes(*bytes))
    }

    /// Adds the `weight`-fold of the numbers from one on to those in `sums`.
    pub(crate) fn add(self, first: usize, weight: f32, sums: &mut [f32]) {
        for (sum, number) in sums.iter_mut().zip(self.from(first)) {
            *sum += weight * number;
        }
    }

    /// The numbers at a place on the first axis, of `N` nodes: `M` of them, between those of the nodes.
    pub(crate) fn at<const N: usize, const M: usize>(self, x: f32) -> [f32; M] {
        let mut sums = [0.0; M];
        for (k, weight) in weights::<N>(x).into_iter().enumerate() {
            self.add(k * M, weight, &mut sums);
        }
        sums
    }

    /// All numbers in rows.
    pub(crate) fn rows<const M: usize>(self) -> impl Iterator<Item = [f32; M]> {
        (0..self.len / M).map(move |row| {
            let mut numbers = self.from(row * M);
            std::array::from_fn(|_| numbers.next().unwrap_or_default())
        })
    }

    /// Where it starts.
    #[cfg(test)]
    pub(crate) fn start(self) -> usize {
        self.start
    }
}
