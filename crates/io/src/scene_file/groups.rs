//! From the groups and copies of a scene file to the groups of a scene.

use super::build::Builder;
use super::object::ObjectTable;
use crate::document::{Fault, Placed};
use heliostat_geometry::{Aabb, Transform};
use heliostat_scene::object::Geometry;
use heliostat_scene::{Census, Group, GroupBoxes, GroupId, MaterialId, Motion, Object};

/// What an object is made of.
#[derive(Clone, Debug)]
pub(super) struct Made {
    pub(super) geometry: Geometry,
    pub(super) materials: Vec<MaterialId>,
}

impl Made {
    /// The object that a table says, moving so.
    pub(super) fn object(self, table: &ObjectTable, name: &str, motion: Motion<Transform>) -> Object {
        Object {
            name: name.to_owned(),
            geometry: self.geometry,
            materials: self.materials,
            motion,
            visible: table.visible.unwrap_or(true),
            casts_shadow: table.casts_shadow.unwrap_or(true),
        }
    }
}

impl Builder<'_> {
    /// The groups of the file, in its order, with all that they hold at rest.
    pub(super) fn groups(&mut self) -> Result<(), Fault> {
        let file = self.file;
        // Their ids are those of their tables: arrays of copies follow behind.
        self.scene.groups = file.group.iter().map(|table| Group::once(table.name.as_str(), vec![])).collect();
        for (i, table) in file.group.iter().enumerate() {
            for (k, member) in table.object.iter().enumerate() {
                let name = self.directory.members[i].name(k);
                let made = self.made(member, name)?;
                let pose = member.placement_keys().affine()?;
                let pose = Transform::new(pose)
                    .ok_or_else(|| Fault::new("the transform has no inverse").or_at(member.span()))?;
                self.scene.groups[i].objects.push(made.object(member, name, Motion::still(pose)));
            }
        }
        Ok(())
    }

    /// What an object is made of; copies become a group of their own.
    pub(super) fn made(&mut self, table: &ObjectTable, name: &str) -> Result<Made, Fault> {
        let made = match &table.group {
            Some(group) => {
                let id = GroupId(self.directory.groups.find(group)? as u32);
                Made { geometry: Geometry::Group(id), materials: vec![] }
            }
            None => {
                let keys = table.shape_keys();
                let geometry = self.geometry(keys.shape()?, keys.mesh)?;
                let materials = self.materials_of(table, &geometry)?;
                Made { geometry, materials }
            }
        };
        let Some(copies) = &table.copies else { return Ok(made) };
        let one = Object { visible: true, casts_shadow: true, ..made.object(table, name, at_rest()) };
        let id = GroupId(self.scene.groups.len() as u32);
        let group = Group { name: format!("copies of {name}"), objects: vec![one], places: copies.places() };
        self.scene.groups.push(group);
        Ok(Made { geometry: Geometry::Group(id), materials: vec![] })
    }

    /// The boxes of all groups, at rest.
    ///
    /// # Errors
    /// When they hold more than can be numbered, or the objects of the file place too much that shines.
    pub(super) fn group_boxes(&self, objects: &[Made]) -> Result<GroupBoxes, Fault> {
        let census = Census::new(&self.scene).map_err(|error| {
            let table = self.file.group.get(error.group().index());
            Fault::new(error.to_string())
                .with_help("make fewer copies, or place fewer groups")
                .or_at(table.and_then(|table| table.name.span()))
        })?;
        let mut lamps = 0_u64;
        for (made, table) in objects.iter().zip(&self.file.object) {
            let Geometry::Group(id) = made.geometry else { continue };
            lamps = lamps.saturating_add(census.group(id).lamps);
            if lamps > Group::MAX_LAMPS {
                return Err(too_many_lamps(lamps, table));
            }
        }
        Ok(GroupBoxes::new(&self.scene, &census))
    }

    /// The box of each object of each group, in its own space.
    pub(super) fn member_boxes(&self, boxes: &GroupBoxes) -> impl Iterator<Item = Aabb> {
        let groups = &self.scene.groups[..self.file.group.len()];
        let objects = groups.iter().flat_map(|group| &group.objects);
        objects.map(|object| boxes.geometry(&self.scene, &object.geometry))
    }

    /// Lets the objects of groups move so, in the order of the file.
    pub(super) fn move_members(&mut self, motions: &[Motion<Transform>]) {
        let groups = &mut self.scene.groups[..self.file.group.len()];
        let objects = groups.iter_mut().flat_map(|group| &mut group.objects);
        objects.zip(motions).for_each(|(object, motion)| object.motion = motion.clone());
    }
}

fn at_rest() -> Motion<Transform> {
    Motion::still(Transform::IDENTITY)
}

fn too_many_lamps(lamps: u64, table: &Placed<ObjectTable>) -> Fault {
    let (most, place) = (Group::MAX_LAMPS, table.group.as_ref().and_then(Placed::span).or(table.span()));
    Fault::new(format!(
        "groups and copies bring {lamps} things that shine, each a light of its own; {most} is the most"
    ))
    .with_help("make fewer copies, or take the emission from the material")
    .or_at(place)
}
