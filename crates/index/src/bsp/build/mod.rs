//! The builder: from primitives to nodes.
//!
//! The references of a large cell lie in pieces, which threads cut one by one ([`pieces`]); then its two sides are cut in
//! parallel. Once a cell is small, all of its subtree is made by one thread in one arena ([`part`]). What comes out depends
//! on neither the number of threads nor their timing: a cell knows all that its cuts depend on.

mod blur;
mod cell;
mod part;
mod pieces;
mod reference;
mod sah;

pub(crate) use blur::{Blur, grow};
pub(crate) use pieces::gather;
pub(crate) use reference::Reference;

use super::BspTree;
use super::node::{MAX_TAG, Node};
use super::params::{BuildError, BuildParams};
use super::split::Plane;
use crate::parallel;
use crate::primitives::Primitives;
use crate::wide::Wide;
use crate::wide::collapse::collapse;
use crate::wide::ray::Room;
use cell::{Cell, Cutter};
use heliostat_geometry::Aabb;
use part::Part;
use pieces::Pieces;
use reference::Around;
use std::time::Instant;

/// Cells with more references are cut in parallel.
const LARGE: usize = 4096;

/// References beyond one per primitive that even the smallest tree may hold.
const SPARE_REFERENCES: usize = 64;

/// How leaves are laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LeafLayout {
    /// References that are tested together. Each leaf begins at a multiple; the last reference fills what is left.
    pub(crate) group: usize,
}

/// A subtree.
enum Branch {
    Cut { plane: Plane, content: Around, sides: Box<[Self; 2]> },
    Part(Part),
}

/// Builds a tree; see [`BspTree::build`].
pub(crate) fn build<P: Primitives + ?Sized>(
    primitives: &P,
    params: &BuildParams,
    layout: LeafLayout,
) -> Result<BspTree, BuildError> {
    let begin = Instant::now();
    params.check()?;
    let (refs, unbounded) = gather(primitives)?;
    let blur = Blur::of(&refs);
    let refs = refs.map(|reference| reference.with_bounds(blur.grown(reference.bounds())));
    let content = refs.around();
    let bounds = content.bounds();

    let spare = (f64::from(params.max_duplication) - 1.0) * refs.len() as f64;
    // More than nodes can name need not be counted.
    let budget = spare.min(MAX_TAG as f64) as usize + SPARE_REFERENCES;
    let root = Cell { bounds, content, depth: 0, budget, wasted: 0 };
    let cutter = Cutter { primitives, params, blur, group: layout.group };
    let root = branch(&cutter, root, refs);

    let mut flat = Flat { layout, ..Flat::default() };
    flat.nodes.push(Node::EMPTY);
    flat.contents.push(Aabb::EMPTY);
    flat.lay(root, 0)?;
    let Flat { mut nodes, mut leaf_refs, contents, depth, .. } = flat;
    nodes.shrink_to_fit();
    leaf_refs.shrink_to_fit();
    let room = Room::new(bounds, blur.slack(), detail(&nodes, &contents));
    let wide_nodes =
        collapse(&nodes, &contents, |leaf, words| layout.words(nodes[leaf as usize], leaf, words));
    Ok(BspTree {
        nodes,
        leaf_refs,
        wide: Wide { nodes: wide_nodes, room },
        unbounded,
        bounds,
        blur,
        depth,
        params: *params,
        layout,
        backend: crate::simd::Backend::best(),
        primitives: primitives.len() as u32,
        build_seconds: begin.elapsed().as_secs_f64(),
    })
}

/// A size that few boxes of leaves are below.
fn detail(nodes: &[Node], contents: &[Aabb]) -> f32 {
    const FEW: usize = 16;
    let leaves = nodes.iter().zip(contents).filter(|(node, content)| node.is_leaf() && !content.is_empty());
    let mut sizes: Vec<f32> = leaves.map(|(_, content)| content.size().max_element()).collect();
    let few = sizes.len() / FEW;
    if sizes.is_empty() { 0.0 } else { *sizes.select_nth_unstable_by(few, f32::total_cmp).1 }
}

/// The subtree of a cell.
fn branch<P: Primitives + ?Sized>(cutter: &Cutter<'_, P>, cell: Cell, refs: Pieces) -> Branch {
    if refs.len() <= LARGE {
        return Branch::Part(Part::build(cutter, cell, refs.into_vec()));
    }
    match cutter.decide(&cell, refs.len(), refs.as_slices()) {
        None => Branch::Part(Part::leaf(&cell, &refs.into_vec())),
        Some(decision) => {
            let before = refs.len();
            let sides = refs.cut(|refs, spill| cutter.cut(refs, spill, decision.plane));
            let [(left_refs, left), (right_refs, right)] = sides;
            let counts = [left_refs.len(), right_refs.len()];
            let [left, right] = cell.sides(&decision, before, counts, [left, right]);
            let (left, right) =
                parallel::join(|| branch(cutter, left, left_refs), || branch(cutter, right, right_refs));
            Branch::Cut { plane: decision.plane, content: cell.content, sides: Box::new([left, right]) }
        }
    }
}

impl LeafLayout {
    /// Each reference is tested by itself.
    pub(crate) const SINGLE: Self = Self { group: 1 };

    /// What the wide child of a leaf says: the leaf's node; or for groups the first of them, in 24 bits, and above, how many.
    fn words(self, leaf: Node, index: u32, words: &mut Vec<u32>) {
        let super::node::Kind::Leaf { first, count } = leaf.kind() else { return };
        if self.group == 1 {
            return words.push(index);
        }
        let (mut first, mut groups) = (first / self.group as u32, count.div_ceil(self.group as u32));
        while groups > 0 {
            let some = groups.min(127);
            words.push(some << 24 | first);
            first += some;
            groups -= some;
        }
    }
}

impl Default for LeafLayout {
    fn default() -> Self {
        Self::SINGLE
    }
}

/// The tree as it is kept.
#[derive(Default)]
struct Flat {
    layout: LeafLayout,
    nodes: Vec<Node>,
    /// The box of what lies below each node.
    contents: Vec<Aabb>,
    leaf_refs: Vec<u32>,
    depth: u32,
}

impl Flat {
    /// Lays a branch out at `slot`.
    fn lay(&mut self, branch: Branch, slot: usize) -> Result<(), BuildError> {
        match branch {
            Branch::Part(part) => self.lay_part(&part, slot),
            Branch::Cut { plane, content, sides } => {
                let left = self.nodes.len();
                self.nodes.extend([Node::EMPTY; 2]);
                self.contents.extend([Aabb::EMPTY; 2]);
                self.nodes[slot] = Node::inner(plane.axis, plane.position, left as u32);
                self.contents[slot] = content.bounds();
                let [below, above] = *sides;
                self.lay(below, left)?;
                self.lay(above, left + 1)
            }
        }
    }

    /// Lays out a part: its root at `slot`, all others behind what is there.
    fn lay_part(&mut self, part: &Part, slot: usize) -> Result<(), BuildError> {
        use super::node::Kind;
        let base = self.nodes.len();
        if base + part.nodes.len() > MAX_TAG {
            return Err(BuildError::TooLarge { what: "nodes" });
        }
        self.depth = self.depth.max(part.depth);
        for (i, (&node, &content)) in part.nodes.iter().zip(&part.contents).enumerate() {
            let node = match node.kind() {
                Kind::Inner { axis, split, left } => Node::inner(axis, split, base as u32 + left - 1),
                Kind::Leaf { first, count } => {
                    self.lay_leaf(&part.refs[first as usize..][..count as usize])?
                }
            };
            if i == 0 {
                self.nodes[slot] = node;
                self.contents[slot] = content;
            } else {
                self.nodes.push(node);
                self.contents.push(content);
            }
        }
        Ok(())
    }

    fn lay_leaf(&mut self, refs: &[u32]) -> Result<Node, BuildError> {
        let first = self.leaf_refs.len();
        let (Some(&last), group) = (refs.last(), self.layout.group) else { return Ok(Node::EMPTY) };
        let end = first + refs.len().next_multiple_of(group);
        // Groups are counted in 24 bits.
        let fits = if group == 1 { u32::MAX as usize } else { group << 24 };
        if refs.len() > MAX_TAG || end > fits {
            return Err(BuildError::TooLarge { what: "references" });
        }
        self.leaf_refs.extend_from_slice(refs);
        self.leaf_refs.resize(end, last);
        Ok(Node::leaf(first as u32, refs.len() as u32))
    }
}
