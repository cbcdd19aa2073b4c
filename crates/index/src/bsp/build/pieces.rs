//! Many references, in pieces that threads take one by one.
//!
//! No piece is large: what a cut reads and writes at a time stays in the cache, and memory that one piece gives back serves
//! the next.

use super::reference::{Around, Reference};
use crate::bsp::params::BuildError;
use crate::parallel;
use crate::primitives::Primitives;
use std::ops::Range;

/// Most references in a piece.
const PIECE: usize = 16_384;

/// References in order.
#[derive(Default)]
pub(crate) struct Pieces {
    pieces: Vec<Vec<Reference>>,
    len: usize,
}

impl Pieces {
    fn new(pieces: impl Iterator<Item = Vec<Reference>>) -> Self {
        let pieces: Vec<_> = pieces.filter(|piece| !piece.is_empty()).collect();
        let len = pieces.iter().map(Vec::len).sum();
        Self { pieces, len }
    }

    pub(crate) fn len(&self) -> usize {
        self.len
    }

    pub(crate) fn as_slices(&self) -> &[Vec<Reference>] {
        &self.pieces
    }

    pub(crate) fn into_vec(self) -> Vec<Reference> {
        joined(self.pieces)
    }

    /// Around all of them.
    pub(crate) fn around(&self) -> Around {
        parallel::map_reduce(&self.pieces, |piece| Around::of(piece), Around::union)
            .unwrap_or(Around::NOTHING)
    }

    /// Puts another in the place of each.
    pub(crate) fn map(self, map: impl Fn(Reference) -> Reference + Send + Sync) -> Self {
        let each = |mut piece: Vec<Reference>| {
            piece.iter_mut().for_each(|reference| *reference = map(*reference));
            piece
        };
        Self { pieces: parallel::map_each(self.pieces, each), len: self.len }
    }

    /// Cuts them in two. `cut` leaves one part of a piece at its beginning and puts the other part into its second argument,
    /// which is as long; it answers how many either has.
    pub(super) fn cut(
        self,
        cut: impl Fn(&mut [Reference], &mut [Reference]) -> [usize; 2] + Send + Sync,
    ) -> [(Self, Around); 2] {
        let both = parallel::map_each(grouped(self.pieces), |group| {
            let mut left = joined(group);
            let mut right = left.clone();
            let counts = cut(&mut left, &mut right);
            [(left, counts[0]), (right, counts[1])].map(|(mut side, count)| {
                side.truncate(count);
                side.shrink_to_fit();
                let around = Around::of(&side);
                (side, around)
            })
        });
        let around = |i: usize| both.iter().fold(Around::NOTHING, |all, sides| all.union(sides[i].1));
        let arounds = [around(0), around(1)];
        let (left, right): (Vec<_>, Vec<_>) = both.into_iter().map(|[left, right]| (left.0, right.0)).unzip();
        [(Self::new(left.into_iter()), arounds[0]), (Self::new(right.into_iter()), arounds[1])]
    }
}

/// Neighbours together, as far as they make one piece: cuts would leave ever smaller ones.
fn grouped(pieces: Vec<Vec<Reference>>) -> Vec<Vec<Vec<Reference>>> {
    let mut groups: Vec<Vec<Vec<Reference>>> = Vec::new();
    let mut room = 0;
    for piece in pieces {
        match groups.last_mut() {
            Some(group) if piece.len() <= room => {
                room -= piece.len();
                group.push(piece);
            }
            _ => {
                room = PIECE.saturating_sub(piece.len());
                groups.push(vec![piece]);
            }
        }
    }
    groups
}

fn joined(mut pieces: Vec<Vec<Reference>>) -> Vec<Reference> {
    if pieces.len() == 1 { pieces.swap_remove(0) } else { pieces.concat() }
}

/// Splits the primitives into those with a finite box and the ids of the others.
pub(crate) fn gather<P: Primitives + ?Sized>(primitives: &P) -> Result<(Pieces, Vec<u32>), BuildError> {
    // The highest id is kept free as a mark.
    let count = u32::try_from(primitives.len())
        .ok()
        .filter(|&n| n < u32::MAX)
        .ok_or(BuildError::TooLarge { what: "primitives" })?;
    let ranges = (0..count).step_by(PIECE).map(|first| first..count.min(first.saturating_add(PIECE as u32)));
    let gathered = parallel::map_each(ranges.collect(), |range| gather_some(primitives, range));
    let (pieces, unbounded): (Vec<_>, Vec<_>) =
        gathered.into_iter().collect::<Result<Vec<_>, _>>()?.into_iter().unzip();
    Ok((Pieces::new(pieces.into_iter()), unbounded.concat()))
}

fn gather_some<P: Primitives + ?Sized>(
    primitives: &P,
    range: Range<u32>,
) -> Result<(Vec<Reference>, Vec<u32>), BuildError> {
    let (mut refs, mut unbounded) = (Vec::with_capacity(range.len()), Vec::new());
    for primitive in range {
        let bounds = primitives.bounds(primitive);
        // A NaN makes a box empty as well.
        if bounds.is_empty() {
            return Err(BuildError::Bounds { primitive, bounds });
        }
        if bounds.is_finite() {
            refs.push(Reference::new(primitive, bounds));
        } else {
            unbounded.push(primitive);
        }
    }
    Ok((refs, unbounded))
}
