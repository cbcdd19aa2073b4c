//! What takes part: an index that answers rays.

use heliostat_geometry::Ray;

/// What is asked of a ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Query {
    /// The nearest hit.
    Closest,
    /// Whether there is a hit.
    Any,
}

/// An index over one mesh.
pub(crate) trait Contestant {
    /// How it is called in tables.
    fn name(&self) -> &str;

    /// Seconds that its build took.
    fn build_seconds(&self) -> f64;

    /// Answers all rays, one after the other: the distance of the nearest hit, or 0 for any hit; infinity for none.
    fn trace(&self, query: Query, rays: &[Ray], distances: &mut [f32]);
}
