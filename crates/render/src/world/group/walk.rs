//! The way of a ray down through the levels of a group.

use super::super::crossing::PassingRay;
use super::super::solid::Content;
use super::super::thing::{Met, Standing, Thing};
use super::boxes::add;
use super::{Member, PreparedGroup};
use heliostat_geometry::{Ray, Transform};
use heliostat_index::TraversalCost;
use std::cell::Cell;

/// A ray that looks for the nearest thing.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct Look<'q> {
    pub(in super::super) passing: &'q PassingRay,
    /// The solid that is a group.
    pub(in super::super) solid: u32,
    /// Over the shutter.
    pub(in super::super) time: f32,
    /// Whether invisible objects are left out.
    pub(in super::super) camera: bool,
    /// Where the work on all levels is added up.
    pub(in super::super) cost: Option<&'q Cell<TraversalCost>>,
}

impl<'s> PreparedGroup<'s> {
    /// The nearest meeting in the range of `search`, a ray in world space. `place` maps the space of the group there, and
    /// `first` is the number of its first part.
    pub(in super::super) fn closest(
        &self,
        look: &Look<'_>,
        search: &Ray,
        place: &Transform,
        first: u64,
    ) -> Option<(f32, Met)> {
        if self.group.places.len() == 1 {
            return self.closest_in(look, search, &*self.copy(0, place)?, first);
        }
        let found = self.copies.closest(&place.ray_to_local(search), look.cost, |copy, local| {
            let search = Ray { range: local.range, ..*search };
            let place = self.copy(copy as usize, place)?;
            self.closest_in(look, &search, &place, first + u64::from(copy) * self.parts)
        })?;
        Some((found.t, found.data))
    }

    /// The nearest meeting in one copy.
    fn closest_in(&self, look: &Look<'_>, search: &Ray, place: &Transform, first: u64) -> Option<(f32, Met)> {
        if let [member] = self.members.as_slice() {
            return member.closest(look, search, place, first);
        }
        let found = self.inside.closest(&place.ray_to_local(search), look.cost, |i, local| {
            let search = Ray { range: local.range, ..*search };
            self.members[i as usize].closest(look, &search, place, first)
        })?;
        Some((found.t, found.data))
    }

    /// Whether anything that lets no light through lies in the range of the ray.
    pub(in super::super) fn blocks(&self, ray: &Ray, time: f32, place: &Transform) -> bool {
        let in_copy = |place: &Transform| {
            if let [member] = self.members.as_slice() {
                return member.blocks(ray, time, place);
            }
            self.inside
                .any(&place.ray_to_local(ray), |i, _| self.members[i as usize].blocks(ray, time, place))
        };
        if self.group.places.len() == 1 {
            return self.copy(0, place).is_some_and(|place| in_copy(&place));
        }
        self.copies.any(&place.ray_to_local(ray), |copy, _| {
            self.copy(copy as usize, place).is_some_and(|place| in_copy(&place))
        })
    }

    /// Visits every thing that lets a part of the light through and may lie in the range of the ray.
    pub(in super::super) fn each_filter(
        &self,
        ray: &Ray,
        time: f32,
        place: &Transform,
        visit: &mut dyn FnMut(&Standing<'_, 's>),
    ) {
        self.copies.each(&place.ray_to_local(ray), |copy| {
            let Some(place) = self.copy(copy as usize, place) else { return };
            self.inside.each(&place.ray_to_local(ray), |i| {
                self.members[i as usize].each_filter(ray, time, &place, visit);
            });
        });
    }
}

impl<'s> Member<'s> {
    /// See [`PreparedGroup::closest`]; `place` and `first` are those of the copy that it lies in.
    fn closest(&self, look: &Look<'_>, search: &Ray, place: &Transform, first: u64) -> Option<(f32, Met)> {
        if look.camera && !self.object.visible {
            return None;
        }
        let place = self.place.below(place, look.time)?;
        let part = first + self.first;
        let body = match &self.content {
            Content::Body(body) => body,
            Content::Group(group) => return group.closest(look, search, &place, part),
        };
        let ray = look.passing.seen_by(Thing { solid: look.solid, part }, search);
        let (t, meeting) = match look.cost {
            None => body.closest(&place, &ray)?,
            Some(cost) => {
                let mut below = TraversalCost::default();
                let found = body.closest_counted(&place, &ray, &mut below);
                add(cost, below);
                found?
            }
        };
        Some((t, Met { part, meeting }))
    }

    fn blocks(&self, ray: &Ray, time: f32, place: &Transform) -> bool {
        self.shadow.stops
            && self.place.below(place, time).is_some_and(|place| match &self.content {
                Content::Body(body) => body.blocks(&place, ray),
                Content::Group(group) => group.blocks(ray, time, &place),
            })
    }

    fn each_filter(&self, ray: &Ray, time: f32, place: &Transform, visit: &mut dyn FnMut(&Standing<'_, 's>)) {
        if !self.shadow.filters {
            return;
        }
        let Some(place) = self.place.below(place, time) else { return };
        match &self.content {
            Content::Body(body) => {
                let (object, parameters) = (Some(self.object), self.parameters);
                visit(&Standing { body, place: &place, object, parameters });
            }
            Content::Group(group) => group.each_filter(ray, time, &place, visit),
        }
    }
}
