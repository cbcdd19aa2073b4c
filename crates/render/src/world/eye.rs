//! Who looks: not everybody sees everything.

use heliostat_scene::Object;

/// How a path comes from the camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sight {
    /// Straight, cut-outs aside.
    Straight,
    /// By mirrors and clear glass: what it meets is seen.
    Clear,
    /// It was scattered, so that what it meets is lit or gives light.
    Lost,
}

/// What a ray that looks for the nearest surface is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Eye {
    /// The camera, cut-outs aside: invisible objects and hidden backs are not there.
    Camera,
    /// The camera by mirrors and clear glass: hidden backs are not there.
    Mirrored,
    /// Light that goes on by mirrors and clear glass, and whatever asks for all there is.
    Any,
    /// Light that a surface scattered, of paths. Objects that cast no shadow are not there: whether light from a lamp is asked
    /// for or found, it comes past them, and they take no light from their surroundings either.
    Scattered,
}

impl Sight {
    /// That of the way on, which a mirror or clear glass sends there, or something that scatters.
    #[inline]
    pub(crate) fn after(self, is_smooth: bool) -> Self {
        if is_smooth && self != Self::Lost { Self::Clear } else { Self::Lost }
    }
}

impl Eye {
    /// The eye of a path by how it comes from the camera, and whether it was scattered last where lights are asked.
    #[inline]
    pub(crate) fn of_path(sight: Sight, is_scattered: bool) -> Self {
        match (sight, is_scattered) {
            (Sight::Straight, _) => Self::Camera,
            (_, true) => Self::Scattered,
            (Sight::Clear, false) => Self::Mirrored,
            (Sight::Lost, false) => Self::Any,
        }
    }

    /// Whether it sees an object, or a group placed by one.
    #[inline]
    pub(crate) fn sees(self, object: &Object) -> bool {
        match self {
            Self::Camera => object.visible,
            Self::Mirrored | Self::Any => true,
            Self::Scattered => object.casts_shadow,
        }
    }

    /// Whether it sees the backs that a material hides. Light does: they throw shadows and send light on like any other, as in
    /// the shadow maps of rasterisers.
    #[inline]
    pub(crate) fn sees_hidden_backs(self) -> bool {
        matches!(self, Self::Any | Self::Scattered)
    }
}
