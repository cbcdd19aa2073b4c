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
    /// The eye of a path that comes straight from the camera, or was scattered where lights are asked, or neither.
    #[inline]
    pub(crate) fn of_path(from_camera: bool, is_scattered: bool) -> Self {
        match (from_camera, is_scattered) {
            (true, _) => Self::Camera,
            (false, true) => Self::Scattered,
            (false, false) => Self::Any,
        }
    }

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
