//! The tree over a triangle mesh, with the watertight test built into the walk.
//!
//! The corners of triangles are laid out leaf by leaf, eight triangles side by side, as the vector units want them. What is
//! asked of the mesh after the build, its normals and so on, stays in the mesh.

mod block;
mod eyes;
mod many;
mod queries;
mod search;
mod seen;

use crate::bsp::build::{LeafLayout, build};
use crate::bsp::visited::Visited;
use crate::bsp::{BspTree, BuildError, BuildParams, TreeStats};
use crate::parallel;
use crate::simd::{Backend, LANES};
use crate::wide::walk::{Counter, TraversalCost, Uncounted};
use block::{Block, Tag};
use heliostat_geometry::triangle::{TriangleHit, TriangleRay, intersect};
use heliostat_geometry::{Ray, TriMesh};
use many::Ask;
use queries::{Closest, Occluded, OfMany, Visit};
use std::marker::PhantomData;
use std::time::Instant;

/// A hit on a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshHit {
    /// Index of the triangle.
    pub triangle: u32,
    /// Distance and place in the triangle.
    pub hit: TriangleHit,
}

impl MeshHit {
    /// Whether this is the one to keep: nearer, or as near on a triangle of lower index.
    #[inline]
    pub(crate) fn beats(&self, best: Option<&Self>) -> bool {
        best.is_none_or(|best| {
            self.hit.t < best.hit.t || (self.hit.t == best.hit.t && self.triangle < best.triangle)
        })
    }
}

/// A [`BspTree`] over the triangles of a mesh.
///
/// ```
/// use glam::Vec3;
/// use heliostat_geometry::{Ray, TriMesh};
/// use heliostat_index::{BuildParams, MeshTree};
///
/// let mesh = TriMesh {
///     positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.0, 1.0, 0.0)],
///     triangles: vec![[0, 1, 2], [2, 1, 3]],
///     ..TriMesh::default()
/// };
/// let tree = MeshTree::build(&mesh, &BuildParams::BALANCED)?;
/// let ray = Ray::new(Vec3::new(0.75, 0.75, 2.0), Vec3::NEG_Z);
/// let found = tree.closest_hit(&ray).expect("the ray meets the second triangle");
/// assert_eq!((found.triangle, found.hit.t), (1, 2.0));
/// # Ok::<(), heliostat_index::BuildError>(())
/// ```
#[derive(Clone, Debug)]
pub struct MeshTree {
    tree: BspTree,
    /// The triangles of the references of the tree, group by group.
    blocks: Vec<Block>,
    /// One for each block.
    tags: Vec<Tag>,
    build_seconds: f64,
}

impl MeshTree {
    /// Builds a tree over all triangles.
    ///
    /// # Errors
    /// When the mesh is [not valid](TriMesh::validate), or for the reasons of [`BspTree::build`].
    pub fn build(mesh: &TriMesh, params: &BuildParams) -> Result<Self, BuildError> {
        let begin = Instant::now();
        mesh.validate().map_err(BuildError::Mesh)?;
        let tree = build(mesh, params, LeafLayout { group: LANES })?;
        // What fills a group up repeats its last triangle.
        let is_new = |group: &[u32], lane: usize| lane == 0 || group[lane] != group[lane - 1];
        let triangle = |group: &[u32], lane: usize| is_new(group, lane).then(|| mesh.corners(group[lane]));
        let block = |group: &[u32]| Block::new((0..LANES).map(|lane| triangle(group, lane)));
        let blocks = parallel::map_chunks(tree.leaf_refs(), LANES, block);
        let tags = parallel::map_chunks(&blocks, 1, |block| Tag::of(&block[0]));
        Ok(Self { tree, blocks, tags, build_seconds: begin.elapsed().as_secs_f64() })
    }

    /// The tree inside.
    pub fn tree(&self) -> &BspTree {
        &self.tree
    }

    /// [`BspTree::stats`], with the triangles that were laid out: their bytes, and the time that took.
    pub fn stats(&self) -> TreeStats {
        let stats = self.tree.stats();
        let bytes = stats.bytes + self.blocks.len() * (size_of::<Block>() + size_of::<Tag>());
        TreeStats { bytes, build_seconds: self.build_seconds, ..stats }
    }

    /// The same tree, walked by another back end.
    #[must_use]
    pub fn with_backend(self, backend: Backend) -> Self {
        Self { tree: self.tree.with_backend(backend), ..self }
    }

    /// The nearest hit within the range of the ray; of two at the same distance the one on the lower triangle.
    pub fn closest_hit(&self, ray: &Ray) -> Option<MeshHit> {
        self.closest(ray, &mut Uncounted)
    }

    /// [`MeshTree::closest_hit`] that adds its work to `cost`.
    pub fn closest_hit_counted(&self, ray: &Ray, cost: &mut TraversalCost) -> Option<MeshHit> {
        self.closest(ray, cost)
    }

    #[inline(always)]
    fn closest(&self, ray: &Ray, counter: &mut impl Counter) -> Option<MeshHit> {
        self.tree.backend().run(Closest { tree: self, ray, counter })
    }

    /// Whether any triangle is hit within the range of the ray.
    pub fn any_hit(&self, ray: &Ray) -> bool {
        self.tree.backend().run(Occluded { tree: self, ray })
    }

    /// [`MeshTree::closest_hit`] of many rays, in their order, and sooner than one after the other: while one waits for memory,
    /// others go on. Rays that start and run alike belong beside each other.
    pub fn closest_hits(&self, rays: &[Ray]) -> Vec<Option<MeshHit>> {
        self.ask_many::<many::Nearest>(rays)
    }

    /// [`MeshTree::any_hit`] of many rays, in their order.
    pub fn any_hits(&self, rays: &[Ray]) -> Vec<bool> {
        self.ask_many::<many::Any>(rays)
    }

    fn ask_many<A: Ask>(&self, rays: &[Ray]) -> Vec<A::Answer> {
        self.tree.backend().run(OfMany { tree: self, rays, ask: PhantomData::<A> })
    }

    /// Visits every hit within the range of the ray, each triangle once, in no certain order.
    pub fn for_each_hit(&self, ray: &Ray, mut visit: impl FnMut(MeshHit)) {
        let mut visited = Visited::new();
        let visit = |candidate: MeshHit| {
            if visited.insert(candidate.triangle) {
                visit(candidate);
            }
        };
        self.tree.backend().run(Visit { tree: self, ray, visit });
    }
}

/// The nearest hit by testing every triangle: the truth that trees are judged by.
///
/// # Panics
/// When a triangle of the mesh names a vertex that does not exist.
pub fn brute_force(mesh: &TriMesh, ray: &Ray) -> Option<MeshHit> {
    let sheared = TriangleRay::new(ray);
    let mut range = ray.range;
    let mut best = None;
    for triangle in 0..mesh.triangles.len() as u32 {
        if let Some(hit) = intersect(&sheared, range, mesh.corners(triangle)) {
            let candidate = MeshHit { triangle, hit };
            if candidate.beats(best.as_ref()) {
                range.max = hit.t;
                best = Some(candidate);
            }
        }
    }
    best
}
