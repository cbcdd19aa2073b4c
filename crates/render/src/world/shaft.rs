//! What may stand between a point and a light: one question for all samples of the light.
//!
//! All shadow rays of a point towards one light run in the hull of the point and the light. Things that do not meet it stop
//! none of them. Where nothing does, the light is all there; no ray is needed, and the result is the same.
//!
//! # Source
//! Haines and Wallace, "Shaft Culling for Efficient Ray-Traced Radiosity", EGWR 1991.

use super::hull::Hull;
use glam::Vec3;
use heliostat_geometry::error_bound::{gamma, projection};

/// The hull of a point and a light.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shaft<'a> {
    start: Vec3,
    /// The point may lie so far away from there.
    start_radius: f32,
    light: &'a Hull,
    /// From the point to the middle of the light.
    way: Vec3,
    way_squared: f32,
    way_length: f32,
    /// Where the light begins and ends along `way`, times the length of `way`.
    light_depth: [f32; 2],
    /// Largest coordinates that take part.
    reach: Vec3,
    /// Where the point may lie, and the rounding of projections of `reach` to unit axes, for spheres.
    error: f32,
}

impl<'a> Shaft<'a> {
    /// The hull of a ball around `start` and `light`.
    pub(super) fn new(start: Vec3, start_radius: f32, light: &'a Hull) -> Self {
        let way = light.centre - start;
        let (way_squared, spread) = (way.length_squared(), light.extent(way));
        let light_depth = [way_squared - spread, way_squared + spread];
        let reach = start.abs() + light.reach() + start_radius;
        let way_length = way_squared.sqrt();
        let error = start_radius + projection(reach, Vec3::splat(2.0));
        Self { start, start_radius, light, way, way_squared, way_length, light_depth, reach, error }
    }

    /// Whether all of it, and where the light is endless all that lies behind, is on one side of the plane through `origin` with unit normal `n`.
    pub(super) fn is_beside(&self, origin: Vec3, n: Vec3) -> bool {
        let error = projection(self.reach + origin.abs(), n) + self.start_radius;
        let start = n.dot(self.start - origin);
        let light = n.dot(self.light.centre - origin);
        let light_error = self.light.extent(n) + error;
        let is_beside = (start > error && light > light_error) || (start < -error && light < -light_error);
        // Rays that come nearer to the plane meet it behind the light, if they go on there.
        let stays_beside = !self.light.is_endless || light.abs() - light_error > start.abs();
        is_beside && stays_beside
    }

    /// [`Shaft::may_hold`] for a sphere, which is as wide along every axis.
    #[inline]
    pub(super) fn may_hold_sphere(&self, centre: Vec3, radius: f32) -> bool {
        let offset = centre - self.start;
        let radius = radius + self.error + gamma(32) * (radius + centre.abs().element_sum());

        // Along the way: behind the point, or behind the light.
        let (depth, spread) = (offset.dot(self.way), radius * self.way_length);
        let far = depth + spread;
        if far < self.light_depth[0].min(0.0) || depth - spread > self.light_depth[1] {
            return false;
        }

        // Across the way, straight away from the middle of the shaft.
        let outward = offset - (depth / self.way_squared) * self.way;
        // What rounding left of the way in it counts as well.
        let light = self.light.extent(outward) + outward.dot(self.way).abs();
        let width = self.share(far) * light + radius * outward.length();
        // False for a NaN, from numbers that overflow: such things are kept.
        let is_beside = offset.dot(outward).abs() > width;
        !is_beside
    }

    /// How wide the shaft is at most up to `far` along the way, as a share of the light: it widens from the point to the light.
    fn share(&self, far: f32) -> f32 {
        if (0.0..self.light_depth[0]).contains(&far) { far / self.light_depth[0] } else { 1.0 }
    }

    /// Whether something in `solid` may stand between the point and the light; false only where nothing can.
    pub(super) fn may_hold(&self, solid: &Hull) -> bool {
        // Most things are far away.
        if !self.may_hold_sphere(solid.centre, solid.radius) {
            return false;
        }
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

        // Across the way.
        let share = self.share(far);
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
            prop_assert!(Shaft::new(scale * start, 0.0, &Hull::of_box(light)).may_hold(&Hull::of_box(planted)));
        }

        #[test]
        fn a_sphere_that_a_ray_meets_is_never_culled(
            start in vec3(10.0),
            light in a_box(12.0),
            radius in prop_oneof![0.001_f32..0.1, 0.1_f32..3.0],
            size in prop::sample::select(vec![1e-4_f32, 1e-2, 1.0]),
            along in 0.0_f32..1.0,
            corner in prop::array::uniform3(0.0_f32..=1.0),
            (off, rim) in (vec3(1.0), prop::sample::select(vec![0.5_f32, 0.9, 0.99])),
            scale in prop::sample::select(vec![1e-3_f32, 1.0, 1e5]),
        ) {
            // Plant a sphere whose rim a ray to a point of the light meets.
            let light = Aabb { min: light.min, max: light.min + size * light.size() };
            let target = light.min + Vec3::from_array(corner) * light.size();
            let across = off.cross(target - start).normalize_or_zero();
            let centre = start + along * (target - start) + rim * radius * across;
            let light = Hull::of_box(Aabb { min: scale * light.min, max: scale * light.max });
            let shaft = Shaft::new(scale * start, 0.0, &light);
            prop_assert!(shaft.may_hold_sphere(scale * centre, scale * radius));
        }
    }

    #[test]
    fn boxes_beside_behind_and_beyond_are_culled() {
        let light = Aabb { min: Vec3::new(-1.0, 10.0, -1.0), max: Vec3::new(1.0, 10.0, 1.0) };
        let light = Hull::of_box(light);
        let shaft = Shaft::new(Vec3::ZERO, 0.0, &light);
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
