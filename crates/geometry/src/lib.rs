//! Rays, boxes, transforms, analytic shapes, triangle meshes and sampling warps.
//!
//! This crate knows nothing of spatial indices, materials or files: it answers "where does this ray meet this
//! shape", "where is a uniform point on it", and "how does a ray leave that point without meeting it again".
//!
//! # Conventions of the whole project
//!
//! - Right-handed, y up, column vectors. Lengths in metres, times in seconds, angles in radians in code and in
//!   degrees in files and flags.
//! - Directions point *away* from the surface. Geometric normals are unit and point to the outside of closed
//!   shapes; of a triangle `(a, b, c)` to the side from which it is seen counter-clockwise.
//! - Colour is linear Rec.709; alpha is premultiplied.
//! - `f32` for rays, hits and shading; `f64` where an error would travel: composed transforms, the roots of
//!   analytic shapes, the distance to a triangle's plane, split decisions, CDFs and film sums.
//! - No epsilon outside [`error_bound`]: a hit carries a bound of its own rounding error, and a ray leaves it
//!   only by [`Hit::spawn`], [`Hit::spawn_to`] or [`Hit::spawn_to_surface`].
//!
//! # Reading order
//!
//! [`ray`], [`aabb`], [`transform`], [`error_bound`], [`hit`], [`shape`], [`triangle`], [`triangle_columns`], [`mesh`], [`warp`].

pub mod aabb;
pub mod error_bound;
pub mod frame;
pub mod hit;
pub mod mesh;
pub mod ray;
pub mod shape;
#[cfg(feature = "test-support")]
pub mod strategies;
pub mod transform;
pub mod triangle;
pub mod triangle_columns;
pub mod warp;

pub use aabb::Aabb;
pub use frame::OrthonormalFrame;
pub use hit::{Departure, Hit, SurfacePoint, SurfaceSample};
pub use mesh::{MeshError, TriMesh};
pub use ray::{Interval, Ray};
pub use shape::Shape;
pub use transform::Transform;
