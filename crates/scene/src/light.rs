//! Light sources.

use crate::color::Rgb;
use crate::object::Geometry;
use crate::profile::Profile;
use glam::Vec3;
use heliostat_geometry::Transform;
use std::sync::Arc;

/// How light weakens on its way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Falloff {
    /// By the square of the distance: physics.
    #[default]
    InverseSquare,
    /// Not at all: the report's model. Intensity is then what arrives, at any distance.
    None,
}

/// The closed list of light sources.
#[derive(Clone, Debug, PartialEq)]
pub enum LightKind {
    /// Ia: the same from everywhere, without shadow. Paths take it for the irradiance that an unseen sky, the same from
    /// everywhere, throws on an open surface, in W/m²: what stands in its way throws shadows.
    Ambient,
    /// From a point, equal in all directions. Intensity in W/sr.
    Point {
        /// Position in world space.
        position: Vec3,
        /// Weakening.
        falloff: Falloff,
    },
    /// From infinitely far. Intensity is the irradiance on a surface that faces it, in W/m². The camera does not see it;
    /// surfaces mirror one that has an angle, when paths are traced.
    Directional {
        /// Unit direction in which the light travels.
        direction: Vec3,
        /// Angle in radians that the source covers, 0 for a hard shadow.
        angle: f32,
    },
    /// From a point into a cone. Intensity in W/sr on the axis.
    Spot {
        /// Position in world space.
        position: Vec3,
        /// Unit direction of the axis.
        direction: Vec3,
        /// Half angle in radians up to which the light is full.
        inner: f32,
        /// Half angle in radians from which there is none.
        outer: f32,
        /// Weakening.
        falloff: Falloff,
    },
    /// From a point, as a lamp was measured. Intensity multiplies its candela, which count as W/sr.
    Measured {
        /// Position in world space.
        position: Vec3,
        /// Unit direction of the axis: where the vertical angle is 0.
        axis: Vec3,
        /// Unit direction across the axis, where the horizontal angle is 0.
        across: Vec3,
        /// How much goes where.
        profile: Arc<Profile>,
        /// Weakening.
        falloff: Falloff,
    },
    /// From every point of a surface. Intensity is radiance in W/(m² sr); with [`Falloff::None`] it is what arrives
    /// from the whole surface, as if from one point light per sample, cosine of the emitter left out.
    Area {
        /// The surface: a rectangle, disk, sphere or any other shape of finite area, or a mesh.
        geometry: Geometry,
        /// From local to world space.
        transform: Transform,
        /// Whether the side against the normal shines too.
        two_sided: bool,
        /// Whether camera rays, mirrors and glass see the surface shine.
        visible: bool,
        /// Weakening.
        falloff: Falloff,
    },
}

/// A named light source.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Name, unique in a scene.
    pub name: String,
    /// Colour times intensity; the unit depends on the kind.
    pub intensity: Rgb,
    /// Shadow rays per shading point, at least 1; only area lights and wide directional ones use more than one.
    pub samples: u32,
    /// The kind.
    pub kind: LightKind,
}
