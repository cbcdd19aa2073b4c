//! An orthonormal frame around a direction.

use glam::Vec3;

/// Three unit vectors at right angles, right-handed: `x cross y = z`.
///
/// ```
/// use glam::Vec3;
/// use heliostat_geometry::OrthonormalFrame;
///
/// let frame = OrthonormalFrame::around(Vec3::X);
/// assert_eq!(frame.to_world(Vec3::Z), Vec3::X);
/// assert_eq!(frame.to_local(Vec3::X), Vec3::Z);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrthonormalFrame {
    /// First tangent.
    pub x: Vec3,
    /// Second tangent.
    pub y: Vec3,
    /// The direction that the frame was made for.
    pub z: Vec3,
}

impl OrthonormalFrame {
    /// A frame whose z axis is the unit vector `z`.
    ///
    /// # Source
    /// Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017.
    pub fn around(z: Vec3) -> Self {
        let sign = 1.0_f32.copysign(z.z);
        let a = -1.0 / (sign + z.z);
        let b = z.x * z.y * a;
        Self {
            x: Vec3::new(1.0 + sign * z.x * z.x * a, sign * b, -sign * z.x),
            y: Vec3::new(b, sign + z.y * z.y * a, -z.y),
            z,
        }
    }

    /// From frame coordinates to the space the frame stands in.
    pub fn to_world(&self, v: Vec3) -> Vec3 {
        v.x * self.x + v.y * self.y + v.z * self.z
    }

    /// From the space the frame stands in to frame coordinates.
    pub fn to_local(&self, v: Vec3) -> Vec3 {
        Vec3::new(v.dot(self.x), v.dot(self.y), v.dot(self.z))
    }
}
