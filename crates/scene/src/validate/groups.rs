//! The checks of groups: each by itself, and what they add up to.

use super::collect::Collector;
use super::issue::{ItemKind, Problem};
use super::items::check_object;
use crate::census::Census;
use crate::group::Group;
use crate::object::Geometry;
use crate::scene::Scene;
use heliostat_geometry::Transform;

pub(super) fn groups<'a>(scene: &'a Scene, c: &mut Collector<'a>) {
    for (i, group) in scene.groups.iter().enumerate() {
        c.turn_to(ItemKind::Group, i, &group.name);
        if group.objects.is_empty() {
            c.add(Problem::EmptyGroup);
        }
        if group.places.is_empty() {
            c.add(Problem::NoPlace);
        }
        if let Some(copy) = group.places.iter().position(|&place| Transform::new(place).is_none()) {
            c.add(Problem::Singular { copy });
        }
        for (k, object) in group.objects.iter().enumerate() {
            c.turn_to_member(&group.name, k, &object.name);
            check_object(object, c);
        }
    }
}

/// What holds only once all ids point to something.
pub(super) fn sums<'a>(scene: &'a Scene, c: &mut Collector<'a>) {
    if scene.groups.is_empty() || !c.is_whole() {
        return;
    }
    let census = match Census::new(scene) {
        Ok(census) => census,
        Err(error) => {
            let group = error.group().index();
            c.turn_to(ItemKind::Group, group, &scene.groups[group].name);
            c.add(Problem::Groups(error));
            return;
        }
    };
    let mut lamps = 0_u64;
    for (i, object) in scene.objects.iter().enumerate() {
        if let Geometry::Group(id) = object.geometry {
            lamps = lamps.saturating_add(census.group(id).lamps);
            if lamps > Group::MAX_LAMPS {
                c.turn_to(ItemKind::Object, i, &object.name);
                c.add(Problem::TooManyLamps { count: lamps });
                return;
            }
        }
    }
}
