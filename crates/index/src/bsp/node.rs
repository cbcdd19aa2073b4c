//! Nodes of the tree, eight bytes each.

/// Largest child or leaf size that the tag of a node can hold.
pub(crate) const MAX_TAG: usize = (1 << 30) - 1;

/// A node: one plane and two children that lie side by side, or a run of references.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Node {
    /// Bits of the plane's position, or the index of the first reference.
    payload: u32,
    /// Low two bits: the axis, or 3 for a leaf. Above them: the index of the left child, or the number of
    /// references.
    tag: u32,
}

/// A node, unpacked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kind {
    /// A plane. `left` holds what lies below `split`, `left + 1` what lies above.
    Inner { axis: usize, split: f32, left: u32 },
    /// The references `first .. first + count`.
    Leaf { first: u32, count: u32 },
}

impl Node {
    const LEAF: u32 = 3;

    /// A leaf without references.
    pub(crate) const EMPTY: Self = Self { payload: 0, tag: Self::LEAF };

    /// `left` is at most [`MAX_TAG`], `axis` at most 2.
    pub(crate) fn inner(axis: usize, split: f32, left: u32) -> Self {
        Self { payload: split.to_bits(), tag: left << 2 | axis as u32 }
    }

    /// `count` is at most [`MAX_TAG`].
    pub(crate) fn leaf(first: u32, count: u32) -> Self {
        Self { payload: first, tag: count << 2 | Self::LEAF }
    }

    pub(crate) fn is_leaf(self) -> bool {
        self.tag & 3 == Self::LEAF
    }

    #[inline]
    pub(crate) fn kind(self) -> Kind {
        let (low, high) = (self.tag & 3, self.tag >> 2);
        if low == Self::LEAF {
            Kind::Leaf { first: self.payload, count: high }
        } else {
            Kind::Inner { axis: low as usize, split: f32::from_bits(self.payload), left: high }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Kind, MAX_TAG, Node};

    #[test]
    fn packs_and_unpacks() {
        assert_eq!(size_of::<Node>(), 8);
        for axis in 0..3 {
            let node = Node::inner(axis, -1.5e-30, MAX_TAG as u32);
            assert_eq!(node.kind(), Kind::Inner { axis, split: -1.5e-30, left: MAX_TAG as u32 });
        }
        let leaf = Node::leaf(u32::MAX, MAX_TAG as u32);
        assert_eq!(leaf.kind(), Kind::Leaf { first: u32::MAX, count: MAX_TAG as u32 });
        assert_eq!(Node::EMPTY.kind(), Kind::Leaf { first: 0, count: 0 });
    }
}
