//! Cameras: where from, which projection, how sharp.

use crate::motion::Motion;
use glam::DAffine3;

/// How directions map to the picture. Angles in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Straight lines stay straight; round things near the border are drawn longish, as in a photograph.
    Perspective {
        /// Angle between the upper and the lower border.
        fov_y: f32,
    },
    /// Parallel rays.
    Orthographic {
        /// Height of the picture in metres.
        height: f32,
    },
    /// Equidistant fisheye: the distance from the centre grows with the angle; a circle of `fov` touches the
    /// shorter borders. Pixels outside `fov` are empty.
    Fisheye {
        /// Full angle, up to a whole turn.
        fov: f32,
    },
    /// Equirectangular: a whole turn in x, half a turn in y.
    Panorama,
    /// A turn of `fov` in x over a cylinder, perspective in y.
    Cylindrical {
        /// Angle between the left and the right border.
        fov_x: f32,
        /// Angle between the upper and the lower border.
        fov_y: f32,
    },
}

/// How depth of field is made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FocusMethod {
    /// Rays through a thin lens.
    #[default]
    Lens,
    /// The report's blur from the depth buffer after rendering.
    Post,
}

/// Depth of field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Focus {
    /// Perpendicular distance from the camera to the plane that is sharp, in metres.
    pub distance: f32,
    /// Radius of the lens opening in metres.
    pub lens_radius: f32,
    /// Blades of the iris: 0 for a round one, else at least 3.
    pub blades: u32,
    /// Turn of the iris in radians.
    pub blade_rotation: f32,
    /// How the blur is made.
    pub method: FocusMethod,
}

/// A named camera. In its local space it looks along `-z` with `+y` up and `+x` to the right of the picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Name, unique in a scene.
    pub name: String,
    /// From camera to world space over the shutter; rotation and translation only.
    pub motion: Motion<DAffine3>,
    /// Projection.
    pub projection: Projection,
    /// Depth of field; `None` is sharp everywhere.
    pub focus: Option<Focus>,
}
