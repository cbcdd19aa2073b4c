//! A subtree made by one thread, depth first, without recursion.
//!
//! All references of unfinished cells lie in one arena. A cell that is cut keeps one side in place and appends the other;
//! the side on top is finished first and then dropped. So memory is bounded by the references alive at once.

use super::cell::{Cell, Cutter};
use super::reference::{Around, Reference};
use crate::bsp::node::Node;
use crate::primitives::Primitives;
use heliostat_geometry::Aabb;

/// Nodes of a subtree: the root comes first; indices count from there, and leaves name references of `refs`.
pub(super) struct Part {
    pub(super) nodes: Vec<Node>,
    /// The box of what lies below each node; empty for nothing.
    pub(super) contents: Vec<Aabb>,
    pub(super) refs: Vec<u32>,
    /// The deepest level, counted from the root of the tree.
    pub(super) depth: u32,
}

/// A cell whose references are those of the arena from `start` on.
struct Task {
    node: usize,
    start: usize,
    cell: Cell,
}

impl Part {
    /// One leaf.
    pub(super) fn leaf(cell: &Cell, refs: &[Reference]) -> Self {
        Self {
            nodes: vec![Node::leaf(0, refs.len() as u32)],
            contents: vec![if refs.is_empty() { Aabb::EMPTY } else { cell.content.bounds() }],
            refs: refs.iter().map(Reference::primitive).collect(),
            depth: cell.depth,
        }
    }

    /// The whole subtree of a cell.
    pub(super) fn build<P: Primitives + ?Sized>(
        cutter: &Cutter<'_, P>,
        cell: Cell,
        mut arena: Vec<Reference>,
    ) -> Self {
        let mut part = Self {
            nodes: vec![Node::EMPTY],
            contents: vec![Aabb::EMPTY],
            refs: Vec::with_capacity(2 * arena.len()),
            depth: 0,
        };
        let mut spill = Vec::new();
        let mut tasks = vec![Task { node: 0, start: 0, cell }];
        while let Some(Task { node, start, cell }) = tasks.pop() {
            let refs = &arena[start..];
            part.depth = part.depth.max(cell.depth);
            if !refs.is_empty() {
                part.contents[node] = cell.content.bounds();
            }
            let Some(decision) = cutter.decide(&cell, refs.len(), &[refs]) else {
                part.nodes[node] = Node::leaf(part.refs.len() as u32, refs.len() as u32);
                part.refs.extend(refs.iter().map(Reference::primitive));
                arena.truncate(start);
                continue;
            };

            let before = refs.len();
            if spill.len() < before {
                spill.extend_from_slice(&arena[start + spill.len()..]);
            }
            let counts = cutter.cut(&mut arena[start..], &mut spill, decision.plane);
            let kept = start + counts[0];
            let above = &spill[..counts[1]];
            let contents = [Around::of(&arena[start..kept]), Around::of(above)];
            arena.truncate(kept);
            arena.extend_from_slice(above);
            let left = part.nodes.len();
            part.nodes.extend([Node::EMPTY; 2]);
            part.contents.extend([Aabb::EMPTY; 2]);
            part.nodes[node] = Node::inner(decision.plane.axis, decision.plane.position, left as u32);
            let [below, above] = cell.sides(&decision, before, counts, contents);
            tasks.push(Task { node: left, start, cell: below });
            tasks.push(Task { node: left + 1, start: kept, cell: above });
        }
        // All parts wait for the last.
        part.nodes.shrink_to_fit();
        part.contents.shrink_to_fit();
        part.refs.shrink_to_fit();
        part
    }
}
