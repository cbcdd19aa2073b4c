//! Shapes that are spheres in world space, too.

use glam::DVec3;
use heliostat_geometry::Transform;
use heliostat_geometry::error_bound::gamma_f64;

/// A sphere in world space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WorldSphere {
    pub(crate) centre: DVec3,
    pub(crate) radius: f64,
}

impl WorldSphere {
    /// The image of a sphere of radius `radius` around the origin; `None` unless the map keeps it round.
    pub(crate) fn new(radius: f32, transform: &Transform) -> Option<Self> {
        let m = transform.matrix();
        let (x, y, z) = (m.matrix3.x_axis, m.matrix3.y_axis, m.matrix3.z_axis);
        let scale = x.length();
        let round = gamma_f64(64) * scale * scale;
        let same = |v: DVec3| (v.length() - scale).abs() * scale <= round;
        let right_angles = [x.dot(y), y.dot(z), z.dot(x)].iter().all(|dot| dot.abs() <= round);
        (same(y) && same(z) && right_angles)
            .then(|| Self { centre: m.translation, radius: scale * f64::from(radius) })
    }
}
