//! What a render took: rays, samples, seconds, indices. The only place of the crate that reads the clock.

use crate::counters::RayCounters;
use crate::schedule::Tally;
use crate::world::World;
use heliostat_index::TreeStats;
use std::sync::Arc;
use std::time::Instant;

/// What a render took so far.
#[derive(Clone, Debug, Default)]
pub struct RenderStats {
    /// Rays by what they were for.
    pub rays: RayCounters,
    /// Camera samples, those through an empty part of the projection included.
    pub samples: u64,
    /// Samples that were left out because a number in them was infinite or not a number.
    pub non_finite_samples: u64,
    /// Wall clock of the phases.
    pub seconds: PhaseSeconds,
    /// The indices that rays went through.
    pub indices: Vec<IndexStats>,
}

/// Seconds of wall clock by phase, each summed over its calls.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PhaseSeconds {
    /// Building indices and light tables.
    pub prepare: f64,
    /// Passes.
    pub trace: f64,
    /// From the film to the frame.
    pub resolve: f64,
}

/// An index and what it is over.
#[derive(Clone, Debug)]
pub struct IndexStats {
    /// `scene` for the index over the objects, `group`, its index and its name for one over the objects of a group, the same
    /// and `copies` for one over its copies, `mesh` and its index for one over triangles.
    pub name: String,
    /// Its numbers.
    pub tree: TreeStats,
}

/// Sums over several indices.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct IndexTotals {
    /// Indices.
    pub trees: usize,
    /// Primitives, a shared mesh counted once.
    pub primitives: usize,
    /// Nodes, leaves included.
    pub nodes: usize,
    /// Leaves.
    pub leaves: usize,
    /// References of all leaves.
    pub references: usize,
    /// Levels of the deepest.
    pub depth: u32,
    /// Bytes, primitives not counted.
    pub bytes: usize,
    /// Seconds that the builds took, one after the other.
    pub build_seconds: f64,
}

impl RenderStats {
    /// Before the first pass.
    pub(crate) fn prepared(world: &World<'_>, seconds: f64) -> Self {
        let seconds = PhaseSeconds { prepare: seconds, ..PhaseSeconds::default() };
        Self { seconds, indices: index_stats(world), ..Self::default() }
    }

    /// Adds a pass.
    pub(crate) fn add(&mut self, tally: &Tally, seconds: f64) {
        self.rays += tally.rays;
        self.samples += tally.samples;
        self.non_finite_samples += tally.non_finite;
        self.seconds.trace += seconds;
    }

    /// Sums over all indices.
    pub fn index_totals(&self) -> IndexTotals {
        let start = IndexTotals { trees: self.indices.len(), ..IndexTotals::default() };
        self.indices.iter().map(|index| &index.tree).fold(start, |sum, tree| IndexTotals {
            trees: sum.trees,
            primitives: sum.primitives + tree.primitives,
            nodes: sum.nodes + tree.nodes,
            leaves: sum.leaves + tree.leaves,
            references: sum.references + tree.references,
            depth: sum.depth.max(tree.depth),
            bytes: sum.bytes + tree.bytes,
            build_seconds: sum.build_seconds + tree.build_seconds,
        })
    }

    /// Rays of all kinds per second of tracing; 0 before the first pass.
    pub fn rays_per_second(&self) -> f64 {
        if self.seconds.trace > 0.0 { self.rays.total() as f64 / self.seconds.trace } else { 0.0 }
    }
}

/// Every tree of a world once, the one over the objects first, then those of groups.
fn index_stats(world: &World<'_>) -> Vec<IndexStats> {
    let objects = world.object_tree().map(|tree| IndexStats { name: "scene".to_owned(), tree: tree.stats() });
    let trees = world.mesh_trees();
    let is_first = |i: usize| !trees[..i].iter().any(|other| Arc::ptr_eq(other, &trees[i]));
    let meshes = (0..trees.len())
        .filter(|&i| is_first(i))
        .map(|i| IndexStats { name: format!("mesh {i}"), tree: trees[i].stats() });
    let groups = world.groups().iter().enumerate().flat_map(|(i, group)| {
        let name = format!("group {i} ({})", group.group().name);
        let (inside, copies) = group.trees();
        let copies = copies.map(|tree| IndexStats { name: format!("{name}, copies"), tree: tree.stats() });
        inside.map(|tree| IndexStats { name, tree: tree.stats() }).into_iter().chain(copies)
    });
    objects.into_iter().chain(groups).chain(meshes).collect()
}

/// The result of `work` and the seconds it took.
pub(crate) fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let result = work();
    (result, start.elapsed().as_secs_f64())
}
