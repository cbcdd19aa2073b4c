//! What may stand between a point and a light: one question for all samples of the light.
//!
//! All shadow rays of a point towards one light run in the hull of the point and the light. Things that do not meet it stop
//! none of them. Where nothing does, the light is all there; no ray is needed, and the result is the same.
//!
//! # Source
//! Haines and Wallace, "Shaft Culling for Efficient Ray-Traced Radiosity", EGWR 1991.

use glam::Vec3;
use heliostat_geometry::Aabb;
use heliostat_geometry::error_bound::projection;

/// The hull of a point and a box.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shaft {
    start: Vec3,
    /// Half the size of the box in which the point may lie.
    start_half: Vec3,
    /// From the point to the middle of the light.
    way: Vec3,
    light_half: Vec3,
    /// Along `way`: where the light begins and ends.
    light_depth: [f32; 2],
    /// Largest coordinates that take part.
    reach: Vec3,
}

impl Shaft {
    /// The hull of a box of half size `start_half` around `start`, and `light`.
    pub(super) fn new(start: Vec3, start_half: Vec3, light: Aabb) -> Self {
        let centre = light.centre();
        let light_half = (light.max - centre).max(centre - light.min);
        let way = centre - start;
        let (depth, spread) = (way.length_squared(), light_half.dot(way.abs()));
        let reach = start.abs() + centre.abs() + light_half + start_half;
        Self { start, start_half, way, light_half, light_depth: [depth - spread, depth + spread], reach }
    }

    /// Whether all of the hull lies on one side of the plane through `origin` with unit normal `n`.
    pub(super) fn is_beside(&self, origin: Vec3, n: Vec3) -> bool {
        let error = projection(self.reach + origin.abs(), n);
        let start = n.dot(self.start - origin);
        let light = n.dot(self.start + self.way - origin);
        let (start_half, light_half) = (self.start_half.dot(n.abs()) + error, self.light_half.dot(n.abs()) + error);
        (start > start_half && light > light_half) || (start < -start_half && light < -light_half)
    }

    /// Whether something in the box may stand between the point and the light; false only where nothing can.
    pub(super) fn may_hold(&self, bounds: Aabb) -> bool {
        let centre = bounds.centre();
        let half = (bounds.max - centre).max(centre - bounds.min);
        let (offset, reach) = (centre - self.start, self.reach + centre.abs() + half);
        let solid = half + self.start_half;

        // Along the way: behind the point, or behind the light.
        let (depth, spread) = (offset.dot(self.way), solid.dot(self.way.abs()) + projection(reach, self.way));
        let (near, far) = (depth - spread, depth + spread);
        if far < 0.0 || near > self.light_depth[1] {
            return false;
        }

        // Across the way: the shaft widens from the point to the light, of which only the part up to `far` counts.
        let share = if far < self.light_depth[0] { far / self.light_depth[0] } else { 1.0 };
        let d = self.way;
        [Vec3::new(0.0, d.z, -d.y), Vec3::new(-d.z, 0.0, d.x), Vec3::new(d.y, -d.x, 0.0)].iter().all(|&axis| {
            let across = axis.abs();
            let width = share * (self.light_half.dot(across) + axis.dot(d).abs());
            // Written so that a NaN, from numbers that overflow, keeps it.
            !(offset.dot(axis).abs() > width + solid.dot(across) + projection(reach, axis))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use heliostat_geometry::Ray;
    use proptest::prelude::*;

    fn vec3(range: f32) -> impl Strategy<Value = Vec3> {
        prop::array::uniform3(-range..range).prop_map(Vec3::from_array)
    }

    fn a_box(range: f32) -> impl Strategy<Value = Aabb> {
        (vec3(range), vec3(range)).prop_map(|(a, b)| Aabb { min: a.min(b), max: a.max(b) })
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

        #[test]
        fn a_box_that_a_ray_meets_is_never_culled(
            start in vec3(10.0),
            light in a_box(12.0),
            size in vec3(3.0),
            along in 0.0_f32..1.0,
            corner in prop::array::uniform3(0.0_f32..=1.0),
            inside in prop::array::uniform3(0.0_f32..=1.0),
            scale in prop::sample::select(vec![1e-3_f32, 1.0, 1e5]),
        ) {
            // Plant a box around a point of a ray to a point of the light.
            let target = light.min + Vec3::from_array(corner) * light.size();
            let on_ray = start + along * (target - start);
            let min = on_ray - Vec3::from_array(inside) * size.abs();
            let planted = Aabb { min: scale * min, max: scale * (min + size.abs()) };
            let ray = Ray::new(scale * start, scale * (target - start)).until(1.0);
            prop_assume!(planted.clip(&ray).is_some());
            let light = Aabb { min: scale * light.min, max: scale * light.max };
            prop_assert!(Shaft::new(scale * start, Vec3::ZERO, light).may_hold(planted));
        }
    }

    #[test]
    fn boxes_beside_behind_and_beyond_are_culled() {
        let light = Aabb { min: Vec3::new(-1.0, 10.0, -1.0), max: Vec3::new(1.0, 10.0, 1.0) };
        let shaft = Shaft::new(Vec3::ZERO, Vec3::ZERO, light);
        let unit_box = |x: f32, y: f32, z: f32| {
            let c = Vec3::new(x, y, z);
            Aabb { min: c - 0.5, max: c + 0.5 }
        };
        assert!(shaft.may_hold(unit_box(0.0, 5.0, 0.0)));
        // Halfway the shaft is half as wide as the light.
        assert!(shaft.may_hold(unit_box(0.99, 4.6, 0.0)));
        assert!(!shaft.may_hold(unit_box(1.2, 4.6, 0.0)));
        assert!(!shaft.may_hold(unit_box(0.0, -2.0, 0.0)));
        assert!(!shaft.may_hold(unit_box(0.0, 12.0, 0.0)));
    }
}
