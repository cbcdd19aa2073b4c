//! The nearest hit, shadows and rays that leave a hit.

use crate::common::{Looker, Stage, ball_mesh, cuboid, sphere, torus, white};
use crate::flat::{bunches, flatten, stage};
use glam::{DAffine3, DMat3, DVec3, Vec3};
use heliostat_geometry::{Ray, Transform};
use heliostat_scene::object::Geometry;
use heliostat_scene::{Group, GroupId, Motion};
use proptest::prelude::*;

/// The edges of the cuboid that rays leave.
const CUBOID: Vec3 = Vec3::new(1.0, 2.0, 0.5);

/// Rays from around a scene towards its middle.
fn rays() -> impl Strategy<Value = Vec<(Vec3, Vec3)>> {
    let vec3 = |reach: f32| prop::array::uniform3(-reach..reach).prop_map(Vec3::from_array);
    prop::collection::vec((vec3(14.0), vec3(6.0)), 40)
}

/// The distance of a point on the surface of the test's cuboid to the nearest edge.
fn distance_to_edge(local: Vec3) -> f64 {
    let mut to_faces = (CUBOID / 2.0 - local.abs()).abs().to_array();
    to_faces.sort_by(f32::total_cmp);
    to_faces[1].into()
}

/// Asserts that a scene of groups and the same scene flattened at a time answer rays alike.
fn assert_alike(stage: &Stage, time: f32, rays: &[(Vec3, Vec3)]) -> Result<(), TestCaseError> {
    let Some(flat) = flatten(&stage.scene, time) else { return Ok(()) };
    prop_assume!(flat.origins.len() < 2000);
    let (grouped, flattened) = (Looker::new(stage), Looker::new(&flat.stage));
    for &(from, to) in rays {
        let ray = Ray::new(from, to - from);
        prop_assume!(ray.is_valid());
        for camera in [false, true] {
            let hit = |looker: &Looker<'_>, time| match camera {
                false => looker.world.closest_hit(&ray, time),
                true => looker.world.camera_hit(&ray, time),
            };
            let (got, expected) = (hit(&grouped, time), hit(&flattened, 0.0));
            prop_assert_eq!(got.is_some(), expected.is_some());
            let (Some(got), Some(expected)) = (got, expected) else { continue };
            // The same composed transform: the same bits, error bound included.
            prop_assert_eq!(got.hit, expected.hit);
            prop_assert_eq!(got.local, expected.local);
            prop_assert_eq!(got.material(), expected.material());
            let origin = flat.origins[expected.object().unwrap() as usize];
            prop_assert_eq!((got.object().unwrap(), got.part), origin);
            let bounds = grouped.world.bounds();
            let (p, e) = (got.hit.at.p, got.hit.at.p_err);
            let inside = bounds.min.cmple(p + e).all() && bounds.max.cmpge(p - e).all();
            prop_assert!(inside, "{p} not in {bounds:?}");
        }
        for end in [0.3, 0.8, 1.0, f32::INFINITY] {
            let ray = ray.until(end);
            prop_assert_eq!(grouped.world.occluded(&ray, time), flattened.world.occluded(&ray, 0.0));
            let got = grouped.world.transmittance(&ray, time);
            let expected = flattened.world.transmittance(&ray, 0.0);
            let close = (got - expected).abs().max_element() <= 1e-4 * expected.max_element();
            prop_assert!(close, "{got} for {expected}");
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 96, ..ProptestConfig::default() })]

    #[test]
    fn still_groups_are_as_the_same_scene_flattened((groups, objects) in bunches(false), rays in rays()) {
        assert_alike(&stage(&groups, &objects), 0.0, &rays)?;
    }

    /// Movement at several levels at once: the product of matrices that run straight does not, and all bounds hold.
    #[test]
    fn moving_groups_are_as_the_scene_of_each_moment_flattened(
        (groups, objects) in bunches(true),
        rays in rays(),
        time in prop_oneof![Just(0.0_f32), Just(0.5), Just(1.0), 0.0_f32..=1.0],
    ) {
        assert_alike(&stage(&groups, &objects), time, &rays)?;
    }

    /// Three levels of stretching maps, the outer ones far away and back: a ray that leaves a convex thing to the outside does
    /// not meet it again, and one that goes in meets its far side.
    #[test]
    fn rays_leave_parts_of_groups_far_away(
        kind in 0..4_u8,
        far in prop::array::uniform3(prop_oneof![Just(0.0_f64), -1e6_f64..1e6, -1e3_f64..1e3]),
        scales in prop::array::uniform3(prop::array::uniform3(prop_oneof![0.05_f64..0.2, -3.0_f64..-0.5, 5.0_f64..20.0])),
        turns in prop::array::uniform3(-3.0_f64..3.0),
        aims in prop::collection::vec((prop::array::uniform3(-1.0_f32..1.0), prop::array::uniform3(-1.0_f32..1.0)), 30),
    ) {
        let mut stage = Stage::new();
        let geometry = match kind {
            0 => sphere(1.0),
            1 => cuboid(CUBOID.x, CUBOID.y, CUBOID.z),
            2 => stage.mesh(ball_mesh(1.0, 9, true)),
            _ => torus(1.0, 0.3),
        };
        let map = |i: usize, shift: DVec3| {
            let linear = DMat3::from_rotation_y(turns[i]) * DMat3::from_diagonal(DVec3::from_array(scales[i]));
            Transform::new(DAffine3::from_mat3_translation(linear * DMat3::from_rotation_x(turns[i]), shift)).unwrap()
        };
        let far = DVec3::from_array(far);
        let places = [map(0, DVec3::new(1.0, -2.0, 0.5)), map(1, -0.5 * far), map(2, far)];
        let mut inner = stage.add(geometry, white(), places[0]).clone();
        for (level, place) in places[1..].iter().enumerate() {
            let group = Group::once("group", vec![inner.clone()]);
            stage.scene.groups.push(group);
            inner.materials.clear();
            inner.geometry = Geometry::Group(GroupId(level as u32));
            inner.motion = Motion::still(*place);
        }
        stage.scene.objects = vec![inner];
        let looker = Looker::new(&stage);
        let whole = places[0].then(&places[1]).and_then(|place| place.then(&places[2])).unwrap();
        for (from, aim) in aims {
            let from = 6.0 * Vec3::from_array(from).normalize_or(Vec3::X);
            let (from, to) = (whole.point(from), whole.point(0.4 * Vec3::from_array(aim)));
            let ray = Ray::new(from, to - from);
            let Some(hit) = looker.world.closest_hit(&ray, 0.0) else { continue };
            let (ng, p) = (hit.hit.at.ng, hit.hit.at.p);
            // Things thinner than the spacing of numbers promise nothing.
            let inverse = whole.inverse_matrix().matrix3;
            let thinnest = [inverse.x_axis, inverse.y_axis, inverse.z_axis].map(|v| v.length()).into_iter();
            let thinnest = 0.3 / thinnest.fold(0.0, f64::max);
            if thinnest < 1e-4 * f64::from(p.abs().max_element()) {
                continue;
            }
            for tangent in [ng.any_orthogonal_vector(), -ng.any_orthogonal_vector(), Vec3::ZERO] {
                let dir = ng + 3.0 * tangent.normalize_or_zero();
                if kind < 2 {
                    prop_assert_eq!(looker.world.closest_hit(&hit.hit.spawn(dir), 0.0), None);
                    // Nearer to an edge than the error bound, the point that stands for the hit may lie beyond the other face.
                    if kind == 1 && distance_to_edge(hit.local) * thinnest < 4.0 * f64::from(hit.hit.at.p_err.max_element()) {
                        continue;
                    }
                    let inside = looker.world.closest_hit(&hit.hit.spawn(-ng), 0.0);
                    prop_assert!(inside.is_some_and(|far| far.hit.at.ng.dot(ng) < 0.0), "no way out: {inside:?}");
                } else if let Some(again) = looker.world.closest_hit(&hit.hit.spawn(dir), 0.0) {
                    prop_assert!(hit.triangle.is_none() || again.triangle.map(|t| t.0) != hit.triangle.map(|t| t.0));
                    prop_assert!(again.hit.at.ng.dot(dir) < 0.0, "met from behind: {:?}", again.hit);
                }
            }
        }
    }
}

#[test]
fn an_infinite_plane_in_a_group_has_no_end() {
    let mut stage = Stage::new();
    let floor = stage.add(crate::common::plane(), white(), Transform::IDENTITY).clone();
    let ball = stage.add(sphere(1.0), white(), Transform::IDENTITY).clone();
    let mut placed = ball.clone();
    stage.scene.groups.push(Group::once("floor", vec![floor, ball]));
    placed.geometry = Geometry::Group(GroupId(0));
    placed.materials.clear();
    placed.motion = Motion::still(crate::common::at(0.0, -2.0, 0.0));
    stage.scene.objects = vec![placed];
    let looker = Looker::new(&stage);
    let hit = |x: f32| looker.world.closest_hit(&Ray::new(Vec3::new(x, 5.0, 0.0), Vec3::NEG_Y), 0.0).unwrap();
    assert_eq!((hit(0.0).hit.t, hit(0.0).part), (6.0, 1));
    assert_eq!((hit(1e6).hit.t, hit(1e6).part), (7.0, 0));
}

#[test]
fn what_hides_a_part_of_a_group_is_whole() {
    let mut stage = Stage::new();
    let near = stage.add(sphere(1.0), white(), crate::common::at(0.0, 5.0, 0.0)).clone();
    let parts = [0.0, 2.0].map(|x| stage.add(sphere(1.0), white(), crate::common::at(x, 0.0, 0.0)).clone());
    let mut placed = near.clone();
    stage.scene.groups.push(Group::once("pair", parts.to_vec()));
    placed.geometry = Geometry::Group(GroupId(0));
    placed.materials.clear();
    placed.motion = Motion::still(crate::common::at(-2.0, 0.0, 0.0));
    placed.name = "pair".to_owned();
    stage.scene.objects = vec![placed, near];
    let looker = Looker::new(&stage);
    let hit = |from: f32| {
        let found = looker.world.closest_hit(&Ray::new(Vec3::new(0.0, from, 0.0), Vec3::NEG_Y), 0.0).unwrap();
        (found.hit.t, found.object(), found.part)
    };
    assert_eq!(hit(9.0), (3.0, Some(1), 0));
    assert_eq!(hit(3.0), (2.0, Some(0), 1));
}
