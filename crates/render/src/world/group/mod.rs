//! Groups made ready: things in a space of their own, which objects and other groups place as often as they like.
//!
//! A group is made ready once and shared by all that place it. Nothing is flattened: a ray goes down from level to level,
//! each with an index over boxes, and takes along the map from the space of the level to world space. That map is composed
//! in `f64` and inverted anew for every thing that is asked, and the thing is asked with the ray of world space. So a hit
//! is, to the bit, that on a thing of the scene with the composed transform, with its error bound; the ray in the space of a
//! level serves only to choose what is asked.
//!
//! # Reading order
//!
//! `boxes` is the index of a level, `walk` asks it, `lamps` finds what shines.

mod boxes;
mod lamps;
mod walk;

pub(crate) use lamps::{Chain, Lamp};
pub(super) use walk::Look;

use super::body::Parameters;
use super::filter::Clear;
use super::kinds::{Shadow, parameters_of, shadow_of};
use super::place::Place;
use super::solid::{Content, Stock};
use super::thing::Standing;
use boxes::BoxIndex;
use glam::DAffine3;
use heliostat_geometry::{Aabb, Transform};
use heliostat_index::{BspTree, BuildError, MeshTree};
use heliostat_scene::settings::Layers;
use heliostat_scene::{Census, Group, GroupBoxes, GroupId, Object, Scene};
use std::collections::HashMap;
use std::sync::Arc;

/// A group made ready.
#[derive(Debug)]
pub(crate) struct PreparedGroup<'s> {
    group: &'s Group,
    members: Vec<Member<'s>>,
    /// Over the members, in the space of the objects.
    inside: BoxIndex,
    /// Over the copies, in the space of the group.
    copies: BoxIndex,
    /// Around all of it in the space of the group, over the shutter.
    bounds: Aabb,
    /// Parts of one copy.
    parts: u64,
    shadow: Shadow,
}

/// An object of a group.
#[derive(Debug)]
struct Member<'s> {
    object: &'s Object,
    content: Content<'s>,
    place: Place<'s>,
    /// Number of its first part among those of one copy.
    first: u64,
    /// How many of its parts shine.
    lamps: u64,
    shadow: Shadow,
    parameters: Parameters,
}

/// What making groups ready needs to know.
#[derive(Clone, Copy, Debug)]
pub(super) struct Settings<'a> {
    /// Which transparent surfaces let light through.
    pub(super) clear: Clear,
    pub(super) layers: &'a Layers,
}

/// Why a group could not be made ready.
#[derive(Debug)]
pub(super) struct GroupError {
    /// Which group.
    pub(super) group: GroupId,
    /// The member without a place, where it is one.
    pub(super) member: Option<usize>,
    pub(super) source: BuildError,
}

/// Groups by their ids.
pub(super) type Groups<'s> = HashMap<GroupId, Arc<PreparedGroup<'s>>>;

/// All groups of a scene.
///
/// # Errors
/// When something has no place in space, or an index grows too large.
pub(super) fn prepare<'s>(
    scene: &'s Scene,
    census: &Census,
    trees: &[Arc<MeshTree>],
    settings: Settings<'_>,
) -> Result<Groups<'s>, GroupError> {
    let boxes = GroupBoxes::new(scene, census);
    let mut groups = Groups::new();
    // Those that a group holds come before it.
    for &id in census.order() {
        let stock = Stock { scene, trees, groups: &groups };
        let ready = PreparedGroup::new(&scene.groups[id.index()], &stock, census, &boxes, settings);
        let ready = ready.map_err(|(member, source)| GroupError { group: id, member, source })?;
        groups.insert(id, Arc::new(ready));
    }
    Ok(groups)
}

impl<'s> PreparedGroup<'s> {
    /// Makes a group ready; those that it holds are ready.
    fn new(
        group: &'s Group,
        stock: &Stock<'_, 's>,
        census: &Census,
        boxes: &GroupBoxes,
        settings: Settings<'_>,
    ) -> Result<Self, (Option<usize>, BuildError)> {
        let scene = stock.scene;
        let mut parts = 0;
        let members: Vec<_> = group
            .objects
            .iter()
            .map(|object| {
                let content = stock.content(&object.geometry);
                let tally = census.object(scene, object);
                let first = parts;
                parts += tally.parts;
                Member {
                    object,
                    place: Place::of(&object.motion),
                    first,
                    lamps: tally.lamps,
                    shadow: shadow_of(scene, object, &content, settings.clear),
                    parameters: parameters_of(scene, object, settings.layers),
                    content,
                }
            })
            .collect();
        let inside = BoxIndex::new(&boxes.objects(scene, group)).map_err(|source| match source {
            BuildError::Bounds { primitive, .. } => (Some(primitive as usize), source),
            _ => (None, source),
        })?;
        let around = boxes.places(scene, group);
        let copies = BoxIndex::new(&around).map_err(|source| (None, source))?;
        let bounds = around.into_iter().fold(Aabb::EMPTY, Aabb::union);
        let shadow = members.iter().fold(Shadow::NONE, |all, member| all.and(member.shadow));
        Ok(Self { group, members, inside, copies, bounds, parts, shadow })
    }

    /// The group of the scene.
    pub(crate) fn group(&self) -> &'s Group {
        self.group
    }

    /// The trees over its objects and over its copies, where there are more than a few.
    pub(crate) fn trees(&self) -> (Option<&BspTree>, Option<&BspTree>) {
        (self.inside.tree(), self.copies.tree())
    }

    /// The box around all of it over the shutter, in its space.
    pub(super) fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// How it stops light.
    pub(super) fn shadow(&self) -> Shadow {
        self.shadow
    }

    /// Shows the part of that number at a moment to a closure, where `place` maps the space of the group to world space.
    pub(super) fn with_part<T>(
        &self,
        number: u64,
        place: &Transform,
        time: f32,
        look: &mut dyn FnMut(&Standing<'_, 's>) -> Option<T>,
    ) -> Option<T> {
        let copy = usize::try_from(number / self.parts).ok()?;
        let number = number % self.parts;
        self.at_copy(copy, place, |place| {
            let index = self.members.partition_point(|member| member.first <= number) - 1;
            let member = &self.members[index];
            member.place.below(place, time, |place| match &member.content {
                Content::Body(body) => {
                    let (object, parameters) = (Some(member.object), member.parameters);
                    look(&Standing { body, place, object, parameters })
                }
                Content::Group(group) => group.with_part(number - member.first, place, time, look),
            })
        })
    }

    /// Shows the map from the space of the objects of a copy to world space to a closure, where `place` is that of the group.
    #[inline]
    fn at_copy<T>(
        &self,
        index: usize,
        place: &Transform,
        look: impl FnOnce(&Transform) -> Option<T>,
    ) -> Option<T> {
        let copy = *self.group.places.get(index)?;
        if copy == DAffine3::IDENTITY {
            return look(place);
        }
        look(&Transform::new(place.matrix() * copy)?)
    }
}
