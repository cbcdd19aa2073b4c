//! Who looks: not everybody sees everything.

use heliostat_scene::Object;

/// What a ray that looks for the nearest surface is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Eye {
    /// The camera, cut-outs aside: invisible objects are not there.
    Camera,
    /// Mirrors, clear glass, and whatever asks for all there is.
    Any,
    /// Light that a surface scattered, of paths. Objects that cast no shadow are not there: whether light from a lamp is asked
    /// for or found, it comes past them, and they take no light from their surroundings either.
    Scattered,
}

impl Eye {
    /// Whether it sees an object, or a group placed by one.
    #[inline]
    pub(crate) fn sees(self, object: &Object) -> bool {
        match self {
            Self::Camera => object.visible,
            Self::Any => true,
            Self::Scattered => object.casts_shadow,
        }
    }
}
