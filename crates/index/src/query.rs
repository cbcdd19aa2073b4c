//! The queries that every index answers, and the rule by which a hit is the nearest.

use heliostat_geometry::Ray;

/// The nearest hit of a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Found<T> {
    /// Id of the primitive.
    pub primitive: u32,
    /// Ray parameter of the hit.
    pub t: f32,
    /// What the caller's closure said of it.
    pub data: T,
}

/// Ray queries over primitives that only the caller's closure can intersect.
///
/// A ray must be [valid](Ray::is_valid); for any other one the answer is unspecified, but there is one.
pub trait RayIndex {
    /// The nearest hit; of two at the same distance the one on the lower primitive id.
    ///
    /// `hit` says where the ray meets a primitive, within the range of the ray *it is given*: that range ends,
    /// inclusively, at the nearest hit so far. Answers outside it are ignored. It may be asked for one primitive
    /// more than once.
    fn closest_hit<T>(&self, ray: &Ray, hit: impl FnMut(u32, &Ray) -> Option<(f32, T)>) -> Option<Found<T>>;

    /// Whether any primitive is hit; ends at the first one that `hit` affirms.
    fn any_hit(&self, ray: &Ray, hit: impl FnMut(u32, &Ray) -> bool) -> bool;

    /// Visits every primitive that the ray may meet within its range, each exactly once, in no certain order.
    ///
    /// It may meet those whose box lies in a cell on its way: all that it does meet, and others.
    fn for_each_hit(&self, ray: &Ray, visit: impl FnMut(u32));
}

/// The nearest hit so far.
pub(crate) struct Nearest<T> {
    /// The ray; its range ends at the nearest hit so far.
    pub(crate) ray: Ray,
    pub(crate) found: Option<Found<T>>,
}

impl<T> Nearest<T> {
    pub(crate) fn new(ray: &Ray) -> Self {
        Self { ray: *ray, found: None }
    }

    /// Asks the closure about one primitive.
    #[inline]
    pub(crate) fn test(&mut self, primitive: u32, hit: &mut impl FnMut(u32, &Ray) -> Option<(f32, T)>) {
        if let Some((t, data)) = hit(primitive, &self.ray)
            && self.accepts(t, primitive)
        {
            self.ray.range.max = t;
            self.found = Some(Found { primitive, t, data });
        }
    }

    fn accepts(&self, t: f32, primitive: u32) -> bool {
        self.ray.range.contains(t)
            && self.found.as_ref().is_none_or(|best| t < best.t || primitive < best.primitive)
    }
}
