//! The builder: from primitives to nodes, depth first, without recursion.
//!
//! All references of unfinished cells lie in one arena. A cell that is cut keeps one side in place and appends
//! the other; the side on top is finished first and then dropped. So memory is bounded by the references alive
//! at once.

use super::BspTree;
use super::blur::{Blur, grow};
use super::node::{MAX_TAG, Node};
use super::params::{BuildError, BuildParams, SplitRule};
use super::sah::{self, Scratch};
use super::split::{Plane, Reference, Side};
use crate::primitives::Primitives;
use heliostat_geometry::Aabb;
use std::time::Instant;

/// How many splits in a row may bring nothing before a cell is left as it is.
const MAX_WASTED: u32 = 3;

/// A cell above this size may be cut at a loss, hoping that its parts are cut at a gain.
const HOPE_ABOVE: usize = 16;

/// References beyond one per primitive that even the smallest tree may hold.
const SPARE_REFERENCES: usize = 64;

/// A cell whose references are those of the arena from `start` on.
struct Task {
    node: usize,
    cell: Aabb,
    start: usize,
    depth: u32,
    /// References that may be added below this cell.
    budget: usize,
    /// Splits in a row above this cell that brought nothing.
    wasted: u32,
}

/// A plane, and whether it was chosen against the odds.
struct Decision {
    plane: Plane,
    wasted: u32,
}

struct Builder<'a, P: ?Sized> {
    primitives: &'a P,
    params: &'a BuildParams,
    blur: Blur,
    nodes: Vec<Node>,
    leaf_refs: Vec<u32>,
    arena: Vec<Reference>,
    /// Right sides while a cell is cut.
    spill: Vec<Reference>,
    scratch: Scratch,
    depth: u32,
}

/// Builds a tree; see [`BspTree::build`].
pub(crate) fn build<P: Primitives + ?Sized>(
    primitives: &P,
    params: &BuildParams,
) -> Result<BspTree, BuildError> {
    let begin = Instant::now();
    params.check()?;
    let (mut arena, unbounded) = gather(primitives)?;
    let blur = Blur::of(&arena);
    for reference in &mut arena {
        reference.bounds = blur.grown(reference.bounds);
    }
    let bounds = arena.iter().fold(Aabb::EMPTY, |around, r| around.union(r.bounds));

    let mut builder = Builder {
        primitives,
        params,
        blur,
        nodes: vec![Node::EMPTY],
        leaf_refs: Vec::with_capacity(arena.len()),
        arena,
        spill: Vec::new(),
        scratch: Scratch::default(),
        depth: 0,
    };
    builder.run(bounds)?;

    let Builder { mut nodes, mut leaf_refs, depth, .. } = builder;
    nodes.shrink_to_fit();
    leaf_refs.shrink_to_fit();
    Ok(BspTree {
        nodes,
        leaf_refs,
        unbounded,
        bounds,
        blur,
        slack: blur.slack(),
        depth,
        params: *params,
        primitives: primitives.len() as u32,
        build_seconds: begin.elapsed().as_secs_f64(),
    })
}

/// Splits the primitives into those with a finite box and the ids of the others.
pub(crate) fn gather<P: Primitives + ?Sized>(
    primitives: &P,
) -> Result<(Vec<Reference>, Vec<u32>), BuildError> {
    // The highest id is kept free as a mark.
    let count = u32::try_from(primitives.len())
        .ok()
        .filter(|&n| n < u32::MAX)
        .ok_or(BuildError::TooLarge { what: "primitives" })?;
    let mut arena = Vec::with_capacity(count as usize);
    let mut unbounded = Vec::new();
    for primitive in 0..count {
        let bounds = primitives.bounds(primitive);
        // A NaN makes a box empty as well.
        if bounds.is_empty() {
            return Err(BuildError::Bounds { primitive, bounds });
        }
        if bounds.is_finite() {
            arena.push(Reference { primitive, bounds });
        } else {
            unbounded.push(primitive);
        }
    }
    Ok((arena, unbounded))
}

impl<P: Primitives + ?Sized> Builder<'_, P> {
    fn run(&mut self, bounds: Aabb) -> Result<(), BuildError> {
        let budget = (f64::from(self.params.max_duplication) - 1.0) * self.arena.len() as f64;
        let budget = budget as usize + SPARE_REFERENCES;
        let mut tasks = vec![Task { node: 0, cell: bounds, start: 0, depth: 0, budget, wasted: 0 }];
        while let Some(task) = tasks.pop() {
            self.depth = self.depth.max(task.depth);
            match self.decide(&task) {
                Some(decision) => {
                    let [left, right] = self.cut(&task, &decision)?;
                    tasks.push(left);
                    tasks.push(right);
                }
                None => self.finish(&task)?,
            }
        }
        Ok(())
    }

    /// The plane that cuts the cell, or `None` for a leaf.
    fn decide(&mut self, task: &Task) -> Option<Decision> {
        let refs = &self.arena[task.start..];
        let splittable = refs.len() > self.params.leaf_limit as usize
            && task.depth < self.params.max_depth
            // In a thinner one, the walk could not tell the parts from each other.
            && task.cell.size().max_element() > 2.0 * self.blur.slack();
        if !splittable {
            return None;
        }
        let decision = match self.params.split {
            SplitRule::Sah(costs) if task.cell.surface_area() > 0.0 => {
                let choice = sah::choose(refs, task.cell, costs, task.budget, &mut self.scratch)?;
                let gains = choice.cost < costs.intersection * refs.len() as f64;
                let wasted = if gains { 0 } else { task.wasted + 1 };
                if !gains && refs.len() <= HOPE_ABOVE {
                    return None;
                }
                Decision { plane: choice.plane, wasted }
            }
            // A cell without area (all on one line) has nothing for the heuristic to weigh.
            SplitRule::Midpoint | SplitRule::Sah(_) => {
                let plane = Plane::midpoint(task.cell)?;
                let (left, right) = plane.count(refs);
                let separates = left < refs.len() || right < refs.len();
                Decision { plane, wasted: if separates { 0 } else { task.wasted + 1 } }
            }
        };
        (decision.wasted <= MAX_WASTED && self.affordable(task, decision.plane)).then_some(decision)
    }

    /// Whether the plane duplicates no more references than the cell may.
    fn affordable(&self, task: &Task, plane: Plane) -> bool {
        let refs = &self.arena[task.start..];
        let (left, right) = plane.count(refs);
        left + right <= refs.len() + task.budget
    }

    /// Cuts a cell: the left side stays where it was in the arena, the right side lies on top of it.
    fn cut(&mut self, task: &Task, decision: &Decision) -> Result<[Task; 2], BuildError> {
        let plane = decision.plane;
        let before = self.arena.len() - task.start;
        let mut kept = task.start;
        self.spill.clear();
        for i in task.start..self.arena.len() {
            let reference = self.arena[i];
            let (left, right) = self.parts(reference, plane);
            if let Some(bounds) = left {
                self.arena[kept] = Reference { bounds, ..reference };
                kept += 1;
            }
            if let Some(bounds) = right {
                self.spill.push(Reference { bounds, ..reference });
            }
        }
        self.arena.truncate(kept);
        self.arena.extend_from_slice(&self.spill);

        let first = self.nodes.len();
        if first + 1 > MAX_TAG {
            return Err(BuildError::TooLarge { what: "nodes" });
        }
        self.nodes.extend([Node::EMPTY; 2]);
        self.nodes[task.node] = Node::inner(plane.axis, plane.position, first as u32);

        // What is left of the budget goes to the sides by their size.
        let (left_count, right_count) = (kept - task.start, self.spill.len());
        let after = left_count + right_count;
        let budget = (task.budget + before).saturating_sub(after);
        let share = |count: usize| (budget as u128 * count as u128 / after.max(1) as u128) as usize;
        let (left_cell, right_cell) = plane.cut(task.cell);
        let child = |node, cell, start, count| Task {
            node,
            cell,
            start,
            depth: task.depth + 1,
            budget: share(count),
            wasted: decision.wasted,
        };
        Ok([child(first, left_cell, task.start, left_count), child(first + 1, right_cell, kept, right_count)])
    }

    /// The boxes of a reference on either side of a plane.
    fn parts(&self, reference: Reference, plane: Plane) -> (Option<Aabb>, Option<Aabb>) {
        match plane.side(&reference.bounds) {
            Side::Left => (Some(reference.bounds), None),
            Side::Right => (None, Some(reference.bounds)),
            Side::Both => {
                let (left, right) = plane.cut(reference.bounds);
                if !self.params.clip {
                    return (Some(left), Some(right));
                }
                let margin = self.blur.margin(self.primitives.bounds(reference.primitive));
                let clipped = |side: Aabb| {
                    let part = self.primitives.clipped_bounds(reference.primitive, grow(side, margin));
                    let part = grow(part, margin).intersect(side);
                    (!part.is_empty()).then_some(part)
                };
                match (clipped(left), clipped(right)) {
                    // Numerics lost it: a reference is never dropped.
                    (None, None) => (Some(left), Some(right)),
                    parts => parts,
                }
            }
        }
    }

    /// Makes the cell a leaf and takes its references off the arena.
    fn finish(&mut self, task: &Task) -> Result<(), BuildError> {
        let refs = &self.arena[task.start..];
        let first = self.leaf_refs.len();
        let fits = refs.len() <= MAX_TAG && u32::try_from(first + refs.len()).is_ok();
        if !fits {
            return Err(BuildError::TooLarge { what: "references" });
        }
        self.nodes[task.node] = Node::leaf(first as u32, refs.len() as u32);
        self.leaf_refs.extend(refs.iter().map(|r| r.primitive));
        self.arena.truncate(task.start);
        Ok(())
    }
}
