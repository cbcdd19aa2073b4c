//! The smallest distance from which everything is in the picture.

use super::stance::Stance;
use glam::{DAffine3, DMat3, DVec3};

/// Share of the picture's half width and height that stays free at its border.
const MARGIN: f64 = 0.06;

/// A direction to look from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct View {
    /// Unit vector from the model to the camera; not along `up`.
    pub(super) back: DVec3,
    /// Unit vector that is up in the picture.
    pub(super) up: DVec3,
    /// Angle between the upper and the lower border in radians.
    pub(super) fov_y: f64,
}

impl View {
    /// From outside, as the stance asks.
    pub(super) fn onto(stance: &Stance) -> Self {
        let (sin_azimuth, cos_azimuth) = stance.azimuth.sin_cos();
        let (sin, cos) = stance.elevation.sin_cos();
        let side = stance.up.cross(stance.front);
        let level = cos_azimuth * stance.front + sin_azimuth * side;
        Self { back: cos * level + sin * stance.up, up: stance.up, fov_y: 30_f64.to_radians() }
    }

    /// Straight in through the open side of a box, whose outward direction is `out`.
    pub(super) fn into(out: DVec3) -> Self {
        Self { back: out, up: DVec3::Y, fov_y: 40_f64.to_radians() }
    }

    /// The axes of the camera: right, up, back.
    pub(super) fn axes(&self) -> DMat3 {
        let right = self.up.cross(self.back).normalize_or(DVec3::X);
        DMat3::from_cols(right, self.back.cross(right), self.back)
    }
}

/// The pose of a camera that sees all `points` within the margins and cannot come nearer.
///
/// In camera axes a point (x, y, z) is within the right border of a camera at (cx, cy, d) when `x - cx <= t (d - z)`, with t
/// the tangent of half the angle of view: `cx + t d >= x + t z`. The largest right side over all points bounds `cx + t d`,
/// the left border bounds `-cx + t d`, and their sum and difference give the smallest d and its cx.
pub(super) fn fit(points: impl Iterator<Item = DVec3>, view: &View, aspect: f64) -> DAffine3 {
    let axes = view.axes();
    let to_camera = axes.transpose();
    let tan_y = (0.5 * view.fov_y).tan() * (1.0 - MARGIN);
    let tan_x = tan_y * aspect;
    let mut sides = [f64::NEG_INFINITY; 4];
    let (mut nearest, mut farthest) = (f64::NEG_INFINITY, f64::INFINITY);
    for point in points {
        let p = to_camera * point;
        let reach = [p.x + tan_x * p.z, -p.x + tan_x * p.z, p.y + tan_y * p.z, -p.y + tan_y * p.z];
        for (side, reach) in sides.iter_mut().zip(reach) {
            *side = side.max(reach);
        }
        nearest = nearest.max(p.z);
        farthest = farthest.min(p.z);
    }
    let [right, left, top, bottom] = sides;
    let distance = (0.5 * (right + left) / tan_x).max(0.5 * (top + bottom) / tan_y);
    // A needle seen along its axis fits from its tip: keep off by a part of its length, or of a metre for a point.
    let length = if nearest > farthest { nearest - farthest } else { 1.0 };
    let z = distance.max(nearest + 0.1 * length);
    DAffine3::from_mat3_translation(axes, axes * DVec3::new(0.5 * (right - left), 0.5 * (top - bottom), z))
}

#[cfg(test)]
mod tests {
    use super::*;

    const VIEW: View = View { back: DVec3::new(0.48, 0.6, 0.64), up: DVec3::Y, fov_y: 0.5 };

    /// Where the points lie in the picture, in half heights from its middle.
    fn seen(points: &[DVec3], pose: &DAffine3) -> Vec<(f64, f64)> {
        let tan = (0.5 * VIEW.fov_y).tan();
        points
            .iter()
            .map(|p| {
                let p = pose.inverse().transform_point3(*p);
                assert!(p.z < 0.0, "behind the camera");
                (p.x / (-p.z * tan), p.y / (-p.z * tan))
            })
            .collect()
    }

    #[test]
    fn every_point_is_inside_the_margin_and_two_touch_it() {
        for (scale, aspect) in [(1e-3, 16.0 / 9.0), (1.0, 0.5), (1e5, 1.0)] {
            let points: Vec<_> = (0..60)
                .map(|i| {
                    let i = f64::from(i);
                    scale
                        * DVec3::new(
                            (1.7 * i).sin() + 40.0,
                            3.0 * (2.3 * i).sin(),
                            0.4 * (0.9 * i).cos() - 7.0,
                        )
                })
                .collect();
            let pose = fit(points.iter().copied(), &VIEW, aspect);
            let seen = seen(&points, &pose);
            let limit = 1.0 - MARGIN;
            let touching = |reach: f64| (reach - limit).abs() < 1e-9;
            assert!(seen.iter().all(|&(x, y)| x.abs() / aspect < limit + 1e-9 && y.abs() < limit + 1e-9));
            let touches = [
                seen.iter().any(|p| touching(p.0 / aspect)) && seen.iter().any(|p| touching(-p.0 / aspect)),
                seen.iter().any(|p| touching(p.1)) && seen.iter().any(|p| touching(-p.1)),
            ];
            assert!(touches.contains(&true), "{scale} {aspect}");
        }
    }

    #[test]
    fn a_point_and_a_needle_are_seen_from_outside() {
        let point = fit([DVec3::ONE].into_iter(), &VIEW, 1.0);
        assert!(point.translation.distance(DVec3::ONE) > 0.05);
        let needle = [DVec3::ZERO, VIEW.back];
        let pose = fit(needle.into_iter(), &VIEW, 1.0);
        assert!(pose.translation.dot(VIEW.back) > 1.05);
    }

    #[test]
    fn the_camera_stands_upright_and_looks_at_the_model() {
        let axes = VIEW.axes();
        assert!((axes.determinant() - 1.0).abs() < 1e-12);
        assert!(axes.x_axis.y.abs() < 1e-12 && axes.y_axis.y > 0.0);
    }
}
