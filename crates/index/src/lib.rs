//! A hand-written BSP tree for ray queries over any primitives, with brute force as its truth.
//!
//! [`BspTree`] cuts the box around all primitives by axis-aligned planes into disjoint cells. A ray walks through
//! the cells it meets, front to back, and tests the primitives they name; once the nearest hit lies before the
//! next cell, it is done. Three structures answer the same queries, [`RayIndex`]: the tree, [`BruteForce`] (every
//! primitive, always: slow and beyond doubt) and, with feature `reference`, the BVH of the `obvhs` crate.
//!
//! The tree knows its primitives only by their boxes ([`Primitives`]); what a hit *is* decides a closure of the
//! caller. [`MeshTree`] is the same tree with the test for triangle meshes built in, eight triangles at a time.
//!
//! What is built is binary: planes that cut cells. What rays walk is made from it: nodes of up to eight cells, each with the
//! box of what is in it, compared with a ray all at once by the vector instructions that the processor turns out to have
//! ([`Backend`]). Feature `parallel` builds on all threads of the current rayon pool; the tree is the same.
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
//! # What holds
//!
//! - **Nothing is lost.** A box ends a search, but never rejects a hit for lying an ulp outside; distances to its
//!   sides are grown by the rounding error of a ray ([`heliostat_geometry::error_bound::cell_padding`]), so a
//!   ray along a split plane sees both sides.
//! - **Every back end finds the same**, to the bit, and so does brute force.
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
