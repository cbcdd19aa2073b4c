//! What may stand between a point and a light: one question for all samples of the light.
//!
//! All shadow rays of a point towards one light run in the hull of the point and the light. Things that do not meet it stop
//! none of them. Where nothing does, the light is all there; no ray is needed, and the result is the same.
//!
//! # Source
//! Haines and Wallace, "Shaft Culling for Efficient Ray-Traced Radiosity", EGWR 1991.

use super::hull::Hull;
use glam::Vec3;
use heliostat_geometry::error_bound::projection;

/// The hull of a point and a light.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shaft {
    start: Vec3,
    /// The point may lie so far away from there.
    start_radius: f32,
    light: Hull,
    /// From the point to the middle of the light.
    way: Vec3,
    way_squared: f32,
    /// Where the light begins and ends along `way`, times the length of `way`.
    light_depth: [f32; 2],
    /// Largest coordinates that take part.
    reach: Vec3,
}

impl Shaft {
    /// The hull of a ball around `start` and `light`.
    pub(super) fn new(start: Vec3, start_radius: f32, light: Hull) -> Self {
        let way = light.centre - start;
        let (way_squared, spread) = (way.length_squared(), light.extent(way));
        let light_depth = [way_squared - spread, way_squared + spread];
        let reach = start.abs() + light.reach() + start_radius;
        Self { start, start_radius, light, way, way_squared, light_depth, reach }
    }

    /// Whether all of it lies on one side of the plane through `origin` with unit normal `n`.
    pub(super) fn is_beside(&self, origin: Vec3, n: Vec3) -> bool {
        let error = projection(self.reach + origin.abs(), n) + self.start_radius;
        let start = n.dot(self.start - origin);
        let light = n.dot(self.light.centre - origin);
        let light_error = self.light.extent(n) + error;
        (start > error && light > light_error) || (start < -error && light < -light_error)
    }

    /// Whether something in `solid` may stand between the point and the light; false only where nothing can.
    pub(super) fn may_hold(&self, solid: &Hull) -> bool {
        let (offset, reach) = (solid.centre - self.start, self.reach + solid.reach());

        // Along the way: behind the point, or behind the light.
        let extent = |axis: Vec3| {
            solid.extent(axis) + self.start_radius * axis.abs().element_sum() + projection(reach, axis)
        };
        let (depth, spread) = (offset.dot(self.way), extent(self.way));
        let far = depth + spread;
        if far < self.light_depth[0].min(0.0) || depth - spread > self.light_depth[1] {
            return false;
        }

        // Across the way: the shaft widens from the point to the light, of which only the part up to `far` counts.
        let share = if (0.0..self.light_depth[0]).contains(&far) { far / self.light_depth[0] } else { 1.0 };
        let is_beside = |axis: Vec3| {
            let width = share * (self.light.extent(axis) + axis.dot(self.way).abs());
            // False for a NaN, from numbers that overflow: such things are kept.
            offset.dot(axis).abs() > width + extent(axis)
        };
        // Straight away from the middle of the shaft tells most; then what flat sides can tell.
        let d = self.way;
        let outward = offset - (depth / self.way_squared) * d;
        let across = [Vec3::new(0.0, d.z, -d.y), Vec3::new(-d.z, 0.0, d.x), Vec3::new(d.y, -d.x, 0.0)];
        !is_beside(outward) && !across.into_iter().any(is_beside)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use heliostat_geometry::{Aabb, Ray};
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
            prop_assert!(Shaft::new(scale * start, 0.0, Hull::of_box(light)).may_hold(&Hull::of_box(planted)));
        }
    }

    #[test]
    fn boxes_beside_behind_and_beyond_are_culled() {
        let light = Aabb { min: Vec3::new(-1.0, 10.0, -1.0), max: Vec3::new(1.0, 10.0, 1.0) };
        let shaft = Shaft::new(Vec3::ZERO, 0.0, Hull::of_box(light));
        let unit_box = |x: f32, y: f32, z: f32| {
            let c = Vec3::new(x, y, z);
            Hull::of_box(Aabb { min: c - 0.5, max: c + 0.5 })
        };
        assert!(shaft.may_hold(&unit_box(0.0, 5.0, 0.0)));
        // Halfway the shaft is half as wide as the light.
        assert!(shaft.may_hold(&unit_box(0.99, 4.6, 0.0)));
        assert!(!shaft.may_hold(&unit_box(1.2, 4.6, 0.0)));
        assert!(!shaft.may_hold(&unit_box(0.0, -2.0, 0.0)));
        assert!(!shaft.may_hold(&unit_box(0.0, 12.0, 0.0)));
    }
}
