//! A hand-written BSP tree for ray queries over any primitives, with brute force as its truth.
//!
//! [`BspTree`] cuts the box around all primitives by axis-aligned planes into disjoint cells. A ray walks through
//! the cells it meets, front to back, and tests the primitives they name; once the nearest hit lies before the
//! next cell, it is done. The tree knows its primitives only by their boxes ([`Primitives`]); what a hit *is* decides a
//! closure of the caller. [`MeshTree`] is the same tree with the test for triangle meshes built in.
//!
//! ```
//! use heliostat_geometry::{Aabb, Ray};
//! use heliostat_index::{BspTree, BuildParams, RayIndex};
//! use glam::Vec3;
//!
//! // Ten balls in a row along x, known to the tree by their boxes.
//! let centres: Vec<Vec3> = (0..10).map(|i| Vec3::new(3.0 * i as f32, 0.0, 0.0)).collect();
//! let boxes: Vec<Aabb> =
//!     centres.iter().map(|&c| Aabb { min: c - Vec3::ONE, max: c + Vec3::ONE }).collect();
//! let tree = BspTree::build(&boxes, &BuildParams::BALANCED)?;
//!
//! // The closure decides what is hit: here the ball inside the box.
//! let ball = |i: u32, ray: &Ray| {
//!     let to_centre = centres[i as usize] - ray.origin;
//!     let along = to_centre.dot(ray.dir) / ray.dir.length_squared();
//!     let miss = (to_centre - along * ray.dir).length_squared();
//!     let t = along - ((1.0 - miss).max(0.0) / ray.dir.length_squared()).sqrt();
//!     (miss <= 1.0 && ray.range.contains(t)).then_some((t, ()))
//! };
//! let ray = Ray::new(Vec3::new(-5.0, 0.0, 0.0), Vec3::X);
//! let found = tree.closest_hit(&ray, ball).expect("the ray runs along the row");
//! assert_eq!((found.primitive, found.t), (0, 4.0));
//! # Ok::<(), heliostat_index::BuildError>(())
//! ```
//!
//! # What a tree looks like
//!
//! <figure style="margin: 0">
#![doc = include_str!("../docs/partition.svg")]
//! </figure>
//!
//! A bird of 18,000 triangles, and the cells that a plane through its middle meets: what [`export_obj`] writes, or
//! `heliostat index bird.obj --export cells.obj`, cut open. Each build has a preset in [`BuildParams`]:
//!
//! | preset | cuts | take it for |
//! |---|---|---|
//! | [`MIDPOINT`](BuildParams::MIDPOINT) | the longest edge in the middle, until few primitives are left: the classic build | comparing, teaching |
//! | [`FAST`](BuildParams::FAST) | by the surface area heuristic over boxes | things that change often |
//! | [`BALANCED`](BuildParams::BALANCED) | by the heuristic over primitives clipped to the cell | anything else: renders use it |
//! | [`BEST`](BuildParams::BEST) | the same, with smaller leaves and more references | meshes on which it is measured to be faster |
//!
//! The heuristic cuts where the expected work of a ray is least. It need not cut empty space away, as `MIDPOINT` does: the
//! boxes of the second form below do that.
//!
//! # From planes to lanes
//!
//! 1. **Binary.** [`BspTree::build`] cuts cell by cell. A node is a plane with two children, or a leaf that names every
//!    primitive whose part in its cell is more than a touch; a primitive may lie in several leaves. This is the form that
//!    [`BspTree::validate`] holds against the primitives, [`BspTree::stats`] counts, and [`export_obj`] writes.
//! 2. **Wide.** Treelets of the binary tree become nodes of up to eight children, each with the box around what its cell
//!    holds. As cells are disjoint, the signs of a ray's direction give the order of the children: no distances are sorted.
//! 3. **Blocks.** [`MeshTree`] lays out the triangles of each leaf in blocks of eight, side by side.
//!
//! A query goes down the wide nodes: one compares the ray with eight boxes at a time, keeps those that it meets, and enters the
//! nearest first. In a leaf of a mesh, eight triangles at a time get a verdict and an interval for the distance; only the
//! nearest is intersected exactly, and those that the intervals cannot tell apart. All of it runs on the vector instructions
//! that the processor turns out to have: [`Backend`].
//!
//! # What can be asked
//!
//! Nearest hit, any hit, all hits: [`RayIndex`] for closures, methods of the same names on [`MeshTree`], which also takes many
//! rays at once, for less time each ([`MeshTree::closest_hits`], [`MeshTree::any_hits`]). [`BruteForce`]
//! (every primitive, always: slow and beyond doubt) answers the same, and [`verify`] holds indices against it, ray by ray.
//! The examples `picking` and `line_of_sight` show both kinds.
//!
//! # Features
//!
//! - `parallel` builds on all threads of the current rayon pool; the tree is the same.
//! - `reference` adds the BVH of the `obvhs` crate behind the same queries, as a second witness: `ReferenceBvh`.
//!
//! None is on by default; without them the crate needs `glam` and `heliostat-geometry` alone.
//!
//! # What holds
//!
//! - **Nothing is lost.** A box ends a search, but never rejects a hit for lying an ulp outside; distances to its
//!   sides are grown by the rounding error of a ray ([`heliostat_geometry::error_bound::cell_padding`]), so a
//!   ray along a split plane sees both sides.
//! - **Every back end finds the same**, to the bit, and so does brute force: for coordinates up to 10¹² and triangles of 10⁻¹¹ and
//!   more. Beyond, products of three lengths leave the range of `f32`, and hits may be lost.
//! - **Ties go to the lower primitive id**, in every structure: the answer does not depend on the tree.
//! - **Building ends.** Depth, references and time are bounded for any input; see [`BuildParams`].
//!
//! # Reading order
//!
//! [`primitives`], [`query`], [`bsp`], `wide`, `simd`, [`mesh_tree`], [`brute`], [`verify`].

pub mod brute;
pub mod bsp;
mod clip;
pub mod mesh_tree;
mod parallel;
pub mod primitives;
pub mod query;
#[cfg(feature = "reference")]
pub mod reference;
mod simd;
pub mod verify;
mod wide;

pub use brute::BruteForce;
pub use bsp::{
    BspTree, BuildError, BuildParams, ExportWhat, InvalidTree, SahCosts, SplitRule, TreeStats, export_obj,
};
pub use mesh_tree::{MeshHit, MeshTree};
pub use primitives::Primitives;
pub use query::{Found, RayIndex};
#[cfg(feature = "reference")]
pub use reference::ReferenceBvh;
pub use simd::Backend;
pub use wide::walk::TraversalCost;
