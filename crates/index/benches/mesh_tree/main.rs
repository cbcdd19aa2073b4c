//! How long trees over meshes take to build, and how many rays a second they answer, on one thread.
//!
//! ```sh
//! cargo bench -p heliostat-index                          # everything, about a minute
//! cargo bench -p heliostat-index -- closest_hit           # what has this in its path
//! cargo bench -p heliostat-index --features parallel -- build
//! ```
//!
//! The meshes are made from formulas and the rays from fixed seeds: every run traces the same.

mod build;
mod meshes;
mod queries;
mod rays;

fn main() {
    divan::main();
}
