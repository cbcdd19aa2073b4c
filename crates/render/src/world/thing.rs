//! Which of all things a ray met: an object, or a part of one that is a group.

use super::body::{Body, Meeting, Parameters};
use heliostat_geometry::Transform;
use heliostat_scene::Object;

/// One thing in the world. Packed, because rays carry several.
#[repr(C, packed(4))]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Thing {
    /// Index into the solids.
    pub(crate) solid: u32,
    /// Number of the part, in the order in which groups are written, copy by copy; 0 for what is no group.
    pub(crate) part: u64,
}

/// Where a ray met a thing of some solid, before the surface there is worked out.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Met {
    /// See [`Thing::part`].
    pub(super) part: u64,
    pub(super) meeting: Meeting,
}

/// A thing at a moment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Standing<'w, 's> {
    pub(super) body: &'w Body<'s>,
    /// From its local space to world space, through all groups.
    pub(super) place: &'w Transform,
    /// The object that the body belongs to, be it in the scene or in a group; none for the surface of a light.
    pub(super) object: Option<&'s Object>,
    /// Whether the material of the object, or a layer, looks at surface parameters.
    pub(super) parameters: Parameters,
}
