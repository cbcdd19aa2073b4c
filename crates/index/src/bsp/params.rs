//! How a tree is built, and what can go wrong.

use heliostat_geometry::Aabb;
use heliostat_geometry::mesh::MeshError;
use std::fmt;
use std::str::FromStr;

/// Greatest depth of a tree: the walk's stack has so many places.
pub const MAX_DEPTH: u32 = 48;

/// Where a cell is cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SplitRule {
    /// In the middle of its longest edge.
    Midpoint,
    /// Where the surface area heuristic expects the least work.
    Sah(SahCosts),
}

/// The work that the surface area heuristic counts, in any unit.
///
/// # Source
/// Goldsmith and Salmon, "Automatic Creation of Object Hierarchies for Ray Tracing", IEEE CG&A 1987.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SahCosts {
    /// One step from a node to a child. Positive.
    pub traversal: f64,
    /// One test of a primitive, or of a group of triangles that are tested together. Positive.
    pub intersection: f64,
}

/// Settings of a build. Take a preset and change what differs.
///
/// Whatever the input, a tree has at most `max_duplication` references per primitive and `max_depth` levels, which
/// bounds the time of a build and the memory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BuildParams {
    /// Where cells are cut.
    pub split: SplitRule,
    /// A cell with at most so many primitives is not cut. At least 1.
    pub leaf_limit: u32,
    /// Levels below the root, at most [`MAX_DEPTH`].
    pub max_depth: u32,
    /// References per primitive that the tree may hold, at least 1: a primitive is named by every leaf it meets.
    /// (Small trees are given a few dozen references more.)
    pub max_duplication: f32,
    /// Whether a leaf names a primitive only when the primitive itself meets its cell
    /// ([`crate::Primitives::clipped_bounds`]), not merely its box.
    pub clip: bool,
}

impl SahCosts {
    /// Measured on meshes: larger costs of a test make more references, and rays no faster.
    pub const DEFAULT: Self = Self { traversal: 1.0, intersection: 1.5 };

    /// Costs of leaves whose primitives are tested in groups of so many: a power of two.
    pub(crate) fn of_group(self, group: usize) -> LeafCosts {
        LeafCosts { traversal: self.traversal, intersection: self.intersection, group_bits: group.ilog2() }
    }
}

/// [`SahCosts`] for a layout of leaves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LeafCosts {
    pub(crate) traversal: f64,
    intersection: f64,
    group_bits: u32,
}

impl LeafCosts {
    /// The work in a leaf.
    #[inline(always)]
    pub(crate) fn leaf(&self, count: u32) -> f64 {
        // A full group is a little more likely to hold a hit than one that is not.
        const FILLED: f64 = 0.02;
        let groups = (u64::from(count) + (1 << self.group_bits) - 1) >> self.group_bits;
        self.intersection * (groups as i64 as f64 + FILLED * f64::from(count))
    }
}

impl BuildParams {
    /// The classic build: halve the longest edge until few primitives are left.
    pub const MIDPOINT: Self =
        Self { split: SplitRule::Midpoint, leaf_limit: 8, max_depth: 40, max_duplication: 16.0, clip: true };

    /// Built in the shortest time.
    pub const FAST: Self = Self {
        split: SplitRule::Sah(SahCosts::DEFAULT),
        leaf_limit: 8,
        max_depth: MAX_DEPTH,
        max_duplication: 2.0,
        clip: false,
    };

    /// Rays as fast as a build in reasonable time allows: the surface area heuristic over clipped boxes.
    pub const BALANCED: Self = Self {
        split: SplitRule::Sah(SahCosts::DEFAULT),
        leaf_limit: 2,
        max_depth: MAX_DEPTH,
        max_duplication: 5.0,
        clip: true,
    };

    /// Smaller leaves and more references than [`BuildParams::BALANCED`]: fewer tests for more memory. Where that is faster at
    /// all, it is so by a few percent: measure.
    pub const BEST: Self = Self {
        split: SplitRule::Sah(SahCosts { intersection: 2.25, ..SahCosts::DEFAULT }),
        max_duplication: 8.0,
        ..Self::BALANCED
    };

    /// Names of the presets, as [`BuildParams::from_str`] knows them.
    pub const NAMES: [&str; 4] = ["midpoint", "fast", "balanced", "best"];

    pub(crate) fn check(&self) -> Result<(), BuildError> {
        let wrong = |what| Err(BuildError::Params { what });
        if self.leaf_limit == 0 {
            return wrong("leaf_limit must be at least 1");
        }
        if self.max_depth > MAX_DEPTH {
            return wrong("max_depth must be at most 48");
        }
        if !(self.max_duplication >= 1.0 && self.max_duplication.is_finite()) {
            return wrong("max_duplication must be at least 1 and finite");
        }
        if let SplitRule::Sah(c) = self.split {
            let positive = |x: f64| x > 0.0 && x.is_finite();
            if !positive(c.traversal) || !positive(c.intersection) {
                return wrong("costs must be positive");
            }
        }
        Ok(())
    }
}

impl Default for BuildParams {
    fn default() -> Self {
        Self::BALANCED
    }
}

impl FromStr for BuildParams {
    type Err = UnknownPreset;

    fn from_str(name: &str) -> Result<Self, UnknownPreset> {
        match name {
            "midpoint" => Ok(Self::MIDPOINT),
            "fast" => Ok(Self::FAST),
            "balanced" => Ok(Self::BALANCED),
            "best" => Ok(Self::BEST),
            _ => Err(UnknownPreset { name: name.to_owned() }),
        }
    }
}

/// A name that no preset has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownPreset {
    /// The name that was asked for.
    pub name: String,
}

impl fmt::Display for UnknownPreset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "no build preset `{}`; there are: {}", self.name, BuildParams::NAMES.join(", "))
    }
}

impl std::error::Error for UnknownPreset {}

/// Why a tree could not be built.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum BuildError {
    /// A primitive has no place: its box is empty or holds a NaN.
    Bounds {
        /// Id of the primitive.
        primitive: u32,
        /// What it said.
        bounds: Aabb,
    },
    /// The mesh does not hold together.
    Mesh(MeshError),
    /// More primitives, nodes or references than ids can name.
    TooLarge {
        /// What there is too much of.
        what: &'static str,
    },
    /// A setting out of its range.
    Params {
        /// Which, and what it must be.
        what: &'static str,
    },
}

impl fmt::Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bounds { primitive, bounds: Aabb { min, max } } => {
                write!(f, "primitive {primitive} has no place in space: its box is {min} to {max}")
            }
            Self::Mesh(error) => error.fmt(f),
            Self::TooLarge { what } => write!(f, "the tree is too large: too many {what}"),
            Self::Params { what } => write!(f, "wrong build settings: {what}"),
        }
    }
}

impl std::error::Error for BuildError {}
