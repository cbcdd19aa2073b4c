//! Random scenes of groups in groups, and how a scene is flattened: one object for each part, with the composed transform.

use crate::common::{Stage, ball_mesh, box_mesh, cuboid, glass, rectangle, sphere, white};
use glam::{DAffine3, DMat3, DVec3, Vec3};
use heliostat_geometry::Transform;
use heliostat_scene::material::{Back, Phong};
use heliostat_scene::object::Geometry;
use heliostat_scene::{Group, GroupId, Motion, Object, Scene};
use proptest::prelude::*;

/// How a random object stands and what it is: a kind of geometry, or a group that was made before.
#[derive(Clone, Debug)]
pub(crate) struct Thing {
    kind: u8,
    poses: Vec<Transform>,
    visible: bool,
    casts_shadow: bool,
}

/// The objects of a random group, and where its copies stand.
#[derive(Clone, Debug)]
pub(crate) struct Bunch {
    things: Vec<Thing>,
    places: Vec<DAffine3>,
}

fn affine(size: f64, reach: f64) -> impl Strategy<Value = DAffine3> {
    let scale = prop::array::uniform3(prop_oneof![-size..-0.4, 0.4..size]);
    let (turn, shift) = (prop::array::uniform3(-3.0_f64..3.0), prop::array::uniform3(-reach..reach));
    (scale, turn, shift).prop_map(|(scale, turn, shift)| {
        let linear = DMat3::from_rotation_z(turn[0])
            * DMat3::from_rotation_x(turn[1])
            * DMat3::from_diagonal(DVec3::from_array(scale))
            * DMat3::from_rotation_y(turn[2]);
        DAffine3::from_mat3_translation(linear, DVec3::from_array(shift))
    })
}

fn place() -> impl Strategy<Value = Transform> {
    prop_oneof![
        Just(Transform::IDENTITY),
        prop::array::uniform3(-2.0_f32..2.0).prop_map(|by| Transform::translation(Vec3::from_array(by))),
        affine(1.8, 2.0).prop_map(|place| Transform::new(place).unwrap()),
        affine(1.8, 2.0).prop_map(|place| Transform::new(place).unwrap()),
    ]
}

fn thing(moving: bool) -> impl Strategy<Value = Thing> {
    let poses = prop::collection::vec(place(), 1..if moving { 4 } else { 2 });
    let flag = || prop::bool::weighted(0.9);
    (any::<u8>(), poses, flag(), flag()).prop_map(|(kind, poses, visible, casts_shadow)| Thing {
        kind,
        poses,
        visible,
        casts_shadow,
    })
}

/// Groups, each of which may hold those before it, and the objects of the scene.
pub(crate) fn bunches(moving: bool) -> impl Strategy<Value = (Vec<Bunch>, Vec<Thing>)> {
    let things = move |most| prop::collection::vec(thing(moving), 1..most);
    let places = prop::collection::vec(prop_oneof![Just(DAffine3::IDENTITY), affine(1.5, 3.0)], 1..4);
    let bunch = (things(12), places).prop_map(|(things, places)| Bunch { things, places });
    (prop::collection::vec(bunch, 1..4), things(12))
}

/// A scene of such groups. Materials differ, some let light through.
pub(crate) fn stage(bunches: &[Bunch], things: &[Thing]) -> Stage {
    let mut stage = Stage::new();
    for (i, bunch) in bunches.iter().enumerate() {
        let objects = bunch.things.iter().map(|thing| object(&mut stage, thing, i)).collect();
        stage.scene.groups.push(Group { name: format!("group {i}"), objects, places: bunch.places.clone() });
    }
    let objects: Vec<_> = things.iter().map(|thing| object(&mut stage, thing, bunches.len())).collect();
    stage.scene.objects = objects;
    for (i, object) in stage.scene.objects.iter_mut().enumerate() {
        object.name = format!("object {i}");
    }
    stage.settings.transparent_shadows = true;
    stage
}

fn object(stage: &mut Stage, thing: &Thing, groups: usize) -> Object {
    let geometry = match thing.kind % 8 {
        0 => sphere(0.7),
        1 => cuboid(1.0, 0.4, 0.8),
        2 => rectangle(1.5, 0.5),
        3 => stage.mesh(ball_mesh(0.6, 5, true)),
        4 => stage.mesh(box_mesh(Vec3::new(-0.3, -0.5, -0.2), Vec3::new(0.4, 0.5, 0.6))),
        _ if groups == 0 => sphere(0.4),
        _ => Geometry::Group(GroupId(u32::from(thing.kind) % groups as u32)),
    };
    let phong = if thing.kind.is_multiple_of(5) { glass(1.5) } else { white() };
    let mut object = stage.add(geometry, phong, Transform::IDENTITY).clone();
    if thing.kind.is_multiple_of(7) {
        stage.last_material().opacity = heliostat_scene::material::FloatInput::constant(0.5);
    }
    stage.last_material().back = if thing.kind.is_multiple_of(3) { Back::Hidden } else { Back::Alike };
    if matches!(object.geometry, Geometry::Group(_)) {
        object.materials.clear();
    }
    object.motion = Motion::through(thing.poses.clone()).unwrap();
    (object.visible, object.casts_shadow) = (thing.visible, thing.casts_shadow);
    object
}

/// A flattened scene, and for each of its objects the object and part of the scene that it comes from.
pub(crate) struct Flat {
    pub(crate) stage: Stage,
    pub(crate) origins: Vec<(u32, u64)>,
}

/// Every part of a scene as an object of its own, standing where it is at `time`; `None` where one has no place then.
pub(crate) fn flatten(scene: &Scene, time: f32) -> Option<Flat> {
    let objects = Vec::new();
    let mut flat = Flat { stage: Stage::new(), origins: Vec::new() };
    flat.stage.scene = Scene { objects, groups: Vec::new(), ..scene.clone() };
    flat.stage.settings.transparent_shadows = true;
    for (i, object) in scene.objects.iter().enumerate() {
        let before = flat.stage.scene.objects.len();
        add(&mut flat.stage.scene, scene, object, &Transform::IDENTITY, time)?;
        let parts = (flat.stage.scene.objects.len() - before) as u64;
        flat.origins.extend((0..parts).map(|part| (i as u32, part)));
        for added in &mut flat.stage.scene.objects[before..] {
            added.visible &= object.visible;
            added.casts_shadow &= object.casts_shadow;
        }
    }
    for (i, object) in flat.stage.scene.objects.iter_mut().enumerate() {
        object.name = format!("object {i}");
    }
    Some(flat)
}

fn add(flat: &mut Scene, scene: &Scene, object: &Object, outer: &Transform, time: f32) -> Option<()> {
    let (before, after, weight) = object.motion.around(time);
    let place = before.lerp(after, weight)?.then(outer)?;
    let Geometry::Group(id) = object.geometry else {
        flat.objects.push(Object { motion: Motion::still(place), ..object.clone() });
        return Some(());
    };
    let group = &scene.groups[id.index()];
    for copy in &group.places {
        let place = Transform::new(*copy)?.then(&place)?;
        for member in &group.objects {
            let first = flat.objects.len();
            add(flat, scene, member, &place, time)?;
            for added in &mut flat.objects[first..] {
                added.visible &= member.visible;
                added.casts_shadow &= member.casts_shadow;
            }
        }
    }
    Some(())
}

/// A material for a group of fixed content.
pub(crate) fn shiny() -> Phong {
    Phong { mirror: crate::common::grey(0.3), ..white() }
}
