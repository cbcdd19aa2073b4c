//! How groups lie in one another: every name found, no group empty, none in itself, none too deep.

use super::names::{Names, name_or_implicit};
use super::object::ObjectTable;
use super::{Directory, SceneFile};
use crate::document::{Fault, Placed};
use crate::error::quote;
use heliostat_scene::Group;

/// How far the search is with a group.
#[derive(Clone, Copy, PartialEq)]
enum Progress {
    Waiting,
    Begun,
    /// Done: it holds groups so deep.
    Done(u32),
}

/// The names of the objects of each group.
///
/// # Errors
/// At the second of two equal names.
pub(super) fn member_names(file: &SceneFile) -> Result<Vec<Names>, Fault> {
    let names = |members: &[Placed<ObjectTable>]| {
        let each = members.iter().enumerate();
        let each = each.map(|(i, o)| name_or_implicit(o.name.as_ref(), o.span(), "object", i, None));
        Names::new("object", each)
    };
    file.group.iter().map(|group| names(&group.object)).collect()
}

/// Checks all groups and what places them.
///
/// # Errors
/// At the first group that holds nothing, itself, or too much.
pub(super) fn check(file: &SceneFile, directory: &Directory) -> Result<(), Fault> {
    for (group, names) in file.group.iter().zip(&directory.members) {
        if group.object.is_empty() {
            return Err(Fault::new(format!("the group {} holds nothing", quote(&group.name)))
                .with_help("add a [[group.object]] below it, or remove the group")
                .or_at(group.name.span()));
        }
        for (i, object) in group.object.iter().enumerate() {
            object.check(names.name(i), object.span())?;
        }
    }
    let mut search =
        Search { file, directory, progress: vec![Progress::Waiting; file.group.len()], path: vec![] };
    for group in 0..file.group.len() {
        search.depth_of_group(group)?;
    }
    for object in &file.object {
        search.depth_of_object(object)?;
    }
    let members = file.group.iter().flat_map(|group| &group.object);
    let copies = file.object.iter().chain(members).filter_map(|object| object.copies.as_ref());
    copies.into_iter().try_fold(0, |before, copies| copies.check(before))?;
    Ok(())
}

struct Search<'a> {
    file: &'a SceneFile,
    directory: &'a Directory,
    progress: Vec<Progress>,
    /// The groups on the way to the one that is looked at.
    path: Vec<usize>,
}

impl Search<'_> {
    /// How deep a group is: one for plain objects, one more for each group and each array of copies on the way down.
    fn depth_of_group(&mut self, group: usize) -> Result<u32, Fault> {
        if let Progress::Done(depth) = self.progress[group] {
            return Ok(depth);
        }
        self.progress[group] = Progress::Begun;
        self.path.push(group);
        let mut depth = 0;
        let file = self.file;
        for object in &file.group[group].object {
            depth = depth.max(self.depth_of_object(object)?);
        }
        self.path.pop();
        self.progress[group] = Progress::Done(depth + 1);
        Ok(depth + 1)
    }

    fn depth_of_object(&mut self, object: &ObjectTable) -> Result<u32, Fault> {
        let mut depth = u32::from(object.copies.is_some());
        if let Some(name) = &object.group {
            let group = self.directory.groups.find(name)?;
            if self.progress[group] == Progress::Begun {
                return Err(self.cycle(group, name));
            }
            // The path grows by one for each level, so that this ends before the stack does.
            let is_deep = self.path.len() >= Group::MAX_DEPTH as usize;
            depth += if is_deep { Group::MAX_DEPTH } else { self.depth_of_group(group)? };
        }
        if depth + u32::from(!self.path.is_empty()) > Group::MAX_DEPTH {
            let place = object.group.as_ref().and_then(Placed::span);
            return Err(Fault::new(format!(
                "groups lie in one another more than {} deep, copies counted",
                Group::MAX_DEPTH
            ))
            .with_help("put what the inner groups hold into fewer groups")
            .or_at(place));
        }
        Ok(depth)
    }

    fn cycle(&self, group: usize, name: &Placed<String>) -> Fault {
        let start = self.path.iter().position(|&other| other == group).unwrap_or(0);
        let way = self.path[start..].iter().chain([&group]).map(|&i| quote(&self.file.group[i].name));
        let way = way.collect::<Vec<_>>().join(" holds ");
        Fault::new(format!("the group {} holds itself: {way}", quote(name)))
            .with_help("take this object out")
            .or_at(name.span())
    }
}
