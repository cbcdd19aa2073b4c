//! Hostile geometry for tests: proptest strategies, deterministic meshes, and random numbers for long loops.
//!
//! Only with feature `test-support`, for the tests of this crate and the crates above. Proptest shrinks what it finds, but
//! a law that must hold 100,000 times is cheaper to check in a plain loop over [`Random`].

mod generate;
mod meshes;
mod numbers;
mod random;
mod rays;
mod shapes;
mod triangles;

pub use generate::{box_grid, displaced_sphere, grid, icosphere, torus_mesh};
pub use meshes::{closed_mesh, mesh, soup};
pub use numbers::{direction, extent, hostile_float, ordinary_float, point, scale};
pub use random::Random;
pub use rays::{ray, ray_at_mesh, ray_in_box};
pub use shapes::{shape, transform};
pub use triangles::triangle;
