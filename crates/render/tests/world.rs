//! The world: two levels against one, movement, what is seen, and scenes that do not hold together.

mod common;

use common::{
    Looker, Stage, at, ball_mesh, black, box_mesh, cuboid, grey, plane, rectangle, sphere, tilted, white,
};
use glam::{DAffine3, DMat3, DVec3, Vec3};
use heliostat_geometry::{Ray, Transform, TriMesh};
use heliostat_render::world::Owner;
use heliostat_render::{TreeCache, World, WorldError};
use heliostat_scene::material::{ColorInput, Phong};
use heliostat_scene::object::Geometry;
use heliostat_scene::{MaterialId, MeshId, Motion, RenderSettings, Rgb, TextureId};
use proptest::prelude::*;
use std::sync::Arc;

/// A geometry by number.
fn some_geometry(stage: &mut Stage, kind: u8) -> Geometry {
    match kind % 5 {
        0 => sphere(0.7),
        1 => cuboid(1.0, 0.4, 0.8),
        2 => rectangle(1.5, 0.5),
        3 => stage.mesh(ball_mesh(0.6, 5, true)),
        _ => stage.mesh(box_mesh(Vec3::new(-0.3, -0.5, -0.2), Vec3::new(0.4, 0.5, 0.6))),
    }
}

fn some_place() -> impl Strategy<Value = Transform> {
    let scale = prop::array::uniform3(prop_oneof![-2.0_f64..-0.3, 0.3_f64..2.0]);
    let shift = prop::array::uniform3(-4.0_f64..4.0);
    (scale, -3.0_f64..3.0, shift).prop_map(|(scale, turn, shift)| {
        let linear = DMat3::from_rotation_z(turn)
            * DMat3::from_rotation_x(turn)
            * DMat3::from_diagonal(DVec3::from_array(scale));
        Transform::new(DAffine3::from_mat3_translation(linear, DVec3::from_array(shift)))
            .expect("a scale above 0")
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, cases: 64, ..ProptestConfig::default() })]

    /// The nearest hit among many is the nearest of the hits of each alone: whatever the index over them does.
    #[test]
    fn the_nearest_of_many_is_the_nearest_of_each(
        things in prop::collection::vec((0_u8..5, some_place()), 1..40),
        rays in prop::collection::vec((prop::array::uniform3(-8.0_f32..8.0), prop::array::uniform3(-1.0_f32..1.0)), 30),
        floor in any::<bool>(),
    ) {
        let mut all = Stage::new();
        let mut each = Vec::new();
        for (kind, place) in things {
            let geometry = some_geometry(&mut all, kind);
            all.add(geometry, white(), place);
            let mut alone = Stage::new();
            let geometry = some_geometry(&mut alone, kind);
            each.push(alone.with(geometry, white(), place));
        }
        if floor {
            all.add(plane(), white(), at(0.0, -1.0, 0.0));
            each.push(Stage::new().with(plane(), white(), at(0.0, -1.0, 0.0)));
        }
        let worlds: Vec<_> = each.iter().map(Looker::new).collect();
        let all = Looker::new(&all);
        for (from, dir) in rays {
            let ray = Ray::new(Vec3::from_array(from), Vec3::from_array(dir));
            prop_assume!(ray.is_valid());
            let hits = worlds.iter().enumerate().filter_map(|(i, one)| Some((one.world.closest_hit(&ray, 0.0)?.hit.t, i)));
            let nearest = hits.min_by(|a, b| a.partial_cmp(b).unwrap());
            let found = all.world.closest_hit(&ray, 0.0);
            let found_index = found.and_then(|hit| Some((hit.hit.t, hit.object()? as usize)));
            prop_assert_eq!(found_index, nearest);
            prop_assert_eq!(all.world.occluded(&ray, 0.0), nearest.is_some());
            if let Some((t, _)) = nearest {
                prop_assert!(!all.world.occluded(&ray.until(0.999 * t), 0.0));
                prop_assert!(all.world.occluded(&ray.until(1.001 * t), 0.0));
            }
        }
    }

    /// A moving thing at a time is the same as a thing that stands where it is then.
    #[test]
    fn a_moving_thing_is_where_its_matrix_says(
        kind in 0_u8..5,
        poses in prop::collection::vec(some_place(), 2..4),
        time in 0.0_f32..=1.0,
        from in prop::array::uniform3(-8.0_f32..8.0),
        aim in prop::array::uniform3(-0.2_f32..0.2),
    ) {
        let position = f64::from(time) * (poses.len() - 1) as f64;
        let first = (position as usize).min(poses.len() - 2);
        let weight = position - first as f64;
        let (a, b) = (poses[first].matrix(), poses[first + 1].matrix());
        let blend = |a: DVec3, b: DVec3| a + weight * (b - a);
        let (ma, mb) = (a.matrix3, b.matrix3);
        let linear = DMat3::from_cols(blend(ma.x_axis, mb.x_axis), blend(ma.y_axis, mb.y_axis), blend(ma.z_axis, mb.z_axis));
        let then = Transform::new(DAffine3::from_mat3_translation(linear, blend(a.translation, b.translation)));
        prop_assume!(linear.determinant().abs() > 1e-2);
        let then = then.unwrap();

        let (mut moving, mut still) = (Stage::new(), Stage::new());
        let geometry = some_geometry(&mut moving, kind);
        moving.add(geometry, white(), Transform::IDENTITY).motion = Motion::through(poses).unwrap();
        let geometry = some_geometry(&mut still, kind);
        let still = still.with(geometry, white(), then);
        let (moving, still) = (Looker::new(&moving), Looker::new(&still));
        let from = Vec3::from_array(from);
        let ray = Ray::new(from, then.point(Vec3::from_array(aim)) - from);
        prop_assume!(ray.is_valid());
        let (a, b) = (moving.world.closest_hit(&ray, time), still.world.closest_hit(&ray, 0.0));
        prop_assert_eq!(a.is_some(), b.is_some());
        if let (Some(a), Some(b)) = (a, b) {
            prop_assert!((a.hit.t - b.hit.t).abs() <= 1e-4 * b.hit.t.max(1e-2), "{} {}", a.hit.t, b.hit.t);
        }
    }
}

#[test]
fn the_lower_object_wins_a_tie() {
    for count in [2, 30] {
        let mut stage = Stage::new();
        for _ in 0..count {
            stage.add(sphere(1.0), white(), Transform::IDENTITY);
        }
        let looker = Looker::new(&stage);
        let hit = looker.world.closest_hit(&Ray::new(Vec3::new(0.1, 0.2, 5.0), Vec3::NEG_Z), 0.0).unwrap();
        assert_eq!(hit.object(), Some(0));
    }
}

#[test]
fn slots_choose_materials_and_the_last_serves_the_rest() {
    let mut stage = Stage::new();
    let mut mesh = box_mesh(Vec3::NEG_ONE, Vec3::ONE);
    // Faces in the order -x +x -y +y -z +z, two triangles each.
    mesh.slots = (0..12).map(|i| i / 2).collect();
    let mesh = stage.mesh(mesh);
    stage.add(mesh, white(), Transform::IDENTITY);
    stage.add(sphere(0.1), black(), at(50.0, 0.0, 0.0));
    stage.scene.objects[0].materials = vec![MaterialId(1), MaterialId(0)];
    let looker = Looker::new(&stage);
    let material = |from: Vec3| looker.world.closest_hit(&Ray::new(from, -from), 0.0).unwrap().material();
    assert_eq!(material(Vec3::new(-5.0, 0.1, 0.2)), Some(MaterialId(1)));
    assert_eq!(material(Vec3::new(5.0, 0.1, 0.2)), Some(MaterialId(0)));
    assert_eq!(material(Vec3::new(0.1, 0.2, 5.0)), Some(MaterialId(0)));
}

#[test]
fn an_empty_scene_and_an_empty_mesh_are_seen_as_nothing() {
    let mut stage = Stage::new().with_sky(0.5);
    assert_eq!(stage.grey(Vec3::ZERO, Vec3::X), 0.5);
    let mesh = stage.mesh(TriMesh::default());
    for _ in 0..20 {
        stage.add(mesh.clone(), white(), Transform::IDENTITY);
    }
    stage.add(sphere(1.0), Phong { emission: grey(1.0), ..black() }, at(9.0, 0.0, 0.0));
    assert_eq!(stage.grey(Vec3::ZERO, Vec3::X), 1.0);
    assert_eq!(stage.look(Vec3::ZERO, Vec3::X).first.unwrap().object, Some(20));
}

#[test]
fn trees_are_shared_by_objects_and_kept_between_frames() {
    let mut stage = Stage::new();
    let mesh = stage.mesh(ball_mesh(1.0, 8, false));
    for x in 0..3 {
        stage.add(mesh.clone(), white(), at(3.0 * x as f32, 0.0, 0.0));
    }
    // A second entry for the same mesh, and one for another of the same content.
    stage.scene.meshes.push(Arc::clone(&stage.scene.meshes[0]));
    stage.scene.meshes.push(Arc::new(ball_mesh(1.0, 8, false)));
    let settings = RenderSettings::default();
    let mut cache = TreeCache::default();
    let first = {
        let world = World::with_cache(&stage.scene, &settings, &mut cache).unwrap();
        let trees = world.mesh_trees();
        assert!(Arc::ptr_eq(&trees[0], &trees[1]) && !Arc::ptr_eq(&trees[0], &trees[2]));
        Arc::clone(&trees[0])
    };
    let world = World::with_cache(&stage.scene, &settings, &mut cache).unwrap();
    assert!(Arc::ptr_eq(&first, &world.mesh_trees()[0]));
    // A frame without the mesh lets go of it.
    World::with_cache(&Stage::new().scene, &settings, &mut cache).unwrap();
    let world = World::with_cache(&stage.scene, &settings, &mut cache).unwrap();
    assert!(!Arc::ptr_eq(&first, &world.mesh_trees()[0]));
}

#[test]
fn the_surface_of_a_light_names_the_light() {
    let kind = heliostat_scene::light::LightKind::Area {
        geometry: sphere(1.0),
        transform: Transform::IDENTITY,
        two_sided: false,
        visible: true,
        falloff: heliostat_scene::light::Falloff::InverseSquare,
    };
    let stage = Stage::new()
        .with_point_light(1.0, Vec3::ONE)
        .with(plane(), white(), at(0.0, -2.0, 0.0))
        .with_light(1.0, 1, kind);
    let looker = Looker::new(&stage);
    let ray = Ray::new(Vec3::new(0.0, 0.0, 5.0), Vec3::NEG_Z);
    assert_eq!(looker.world.closest_hit(&ray, 0.0).unwrap().owner, Owner::Light(1));
    assert!(!looker.world.occluded(&ray.until(9.0), 0.0));
}

#[test]
fn scenes_that_do_not_hold_together_are_refused_by_name() {
    let error = |change: &dyn Fn(&mut Stage)| {
        let mut stage = Stage::new().with(sphere(1.0), white(), Transform::IDENTITY);
        change(&mut stage);
        World::new(&stage.scene, &RenderSettings::default()).unwrap_err()
    };
    let broken: [&dyn Fn(&mut Stage); 6] = [
        &|stage| stage.scene.objects[0].materials = vec![MaterialId(9)],
        &|stage| stage.scene.objects[0].materials.clear(),
        &|stage| stage.scene.objects[0].geometry = Geometry::Mesh(MeshId(0)),
        &|stage| stage.scene.objects[0].geometry = sphere(f32::NAN),
        &|stage| {
            let mesh = TriMesh { triangles: vec![[0, 1, 2]], ..TriMesh::default() };
            let geometry = stage.mesh(mesh);
            stage.scene.objects[0].geometry = geometry;
        },
        &|stage| {
            let heliostat_scene::material::Surface::Phong(phong) = &mut stage.scene.materials[0].surface
            else {
                panic!("not the report\'s surface")
            };
            phong.mirror = ColorInput { factor: Rgb::ONE, texture: Some(TextureId(2)) };
        },
    ];
    for (n, change) in broken.into_iter().enumerate() {
        let error = error(change);
        let WorldError::Scene(issues) = &error else { panic!("change {n}: {error}") };
        assert_eq!(issues.len(), 1, "change {n}: {error}");
        assert!(!error.to_string().is_empty());
    }
}

#[test]
fn a_thing_that_turns_inside_out_on_its_way_is_gone_for_that_moment_only() {
    let flip = Transform::scaling(Vec3::new(-1.0, 1.0, 1.0)).unwrap();
    let mut stage = Stage::new();
    stage.add(sphere(1.0), white(), Transform::IDENTITY).motion =
        Motion::through(vec![Transform::IDENTITY, flip]).unwrap();
    let looker = Looker::new(&stage);
    let ray = Ray::new(Vec3::new(0.0, 0.0, 5.0), Vec3::NEG_Z);
    let seen = |time| looker.world.closest_hit(&ray, time).is_some();
    assert_eq!([seen(0.0), seen(0.25), seen(0.5), seen(0.75), seen(1.0)], [true, true, false, true, true]);
}

#[test]
fn counting_changes_no_hit() {
    let mut stage = Stage::new();
    for i in 0..30 {
        let geometry = some_geometry(&mut stage, i);
        stage.add(
            geometry,
            white(),
            tilted(f64::from(17 * u32::from(i)), f64::from(i % 6) - 2.5, f64::from(i / 6) - 2.5, 0.0),
        );
    }
    let looker = Looker::new(&stage);
    let mut steps = 0;
    for i in 0..200 {
        let ray = Ray::new(
            Vec3::new(0.03 * i as f32 - 3.0, 0.1, 9.0),
            Vec3::new(0.0, 0.004 * i as f32 - 0.4, -1.0),
        );
        let mut cost = heliostat_index::TraversalCost::default();
        assert_eq!(looker.world.camera_hit_counted(&ray, 0.0, &mut cost), looker.world.camera_hit(&ray, 0.0));
        steps += cost.nodes + cost.leaves;
    }
    assert!(steps > 0);
}
