//! The way of a ray down through the levels of a group.

use super::super::body::Body;
use super::super::crossing::PassingRay;
use super::super::solid::Content;
use super::super::thing::{Met, Standing, Thing};
use super::boxes::add;
use super::{Member, PreparedGroup};
use crate::world::Eye;
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
    /// Who looks.
    pub(in super::super) eye: Eye,
    /// Where the work on all levels is added up.
    pub(in super::super) cost: Option<&'q Cell<TraversalCost>>,
}

impl Look<'_> {
    /// The nearest meeting with the body of one part in the range of `search`: where on the ray, and the rest in `met`, which
    /// holds what it likes where there is none.
    #[inline(always)]
    pub(in super::super) fn closest(
        &self,
        body: &Body<'_>,
        part: u64,
        search: &Ray,
        place: &Transform,
        met: &mut Met,
    ) -> Option<f32> {
        let mut room = None;
        let ray = self.passing.seen_by(Thing { solid: self.solid, part }, search, &mut room);
        let t = match self.cost {
            None => body.closest(place, ray, &mut met.meeting),
            Some(cost) => {
                let mut below = TraversalCost::default();
                let found = body.closest_counted(place, ray, &mut met.meeting, &mut below);
                add(cost, below);
                found
            }
        };
        t.inspect(|_| met.part = part)
    }
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
            return self.at_copy(0, place, |place| self.closest_in(look, search, place, first));
        }
        let found = self.copies.closest(&place.ray_to_local(search), look.cost, |copy, local| {
            let search = Ray { range: local.range, ..*search };
            let first = first + u64::from(copy) * self.parts;
            self.at_copy(copy as usize, place, |place| self.closest_in(look, &search, place, first))
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
        let in_place = |place: &Transform| {
            if let [member] = self.members.as_slice() {
                return member.blocks(ray, time, place);
            }
            self.inside
                .any(&place.ray_to_local(ray), |i, _| self.members[i as usize].blocks(ray, time, place))
        };
        let in_copy = |copy| self.at_copy(copy, place, |place| in_place(place).then_some(())).is_some();
        if self.group.places.len() == 1 {
            return in_copy(0);
        }
        self.copies.any(&place.ray_to_local(ray), |copy, _| in_copy(copy as usize))
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
            // A copy without a place filters nothing.
            let _ = self.at_copy(copy as usize, place, |place| {
                self.inside.each(&place.ray_to_local(ray), |i| {
                    self.members[i as usize].each_filter(ray, time, place, visit);
                });
                Some(())
            });
        });
    }
}

impl<'s> Member<'s> {
    /// See [`PreparedGroup::closest`]; `place` and `first` are those of the copy that it lies in.
    fn closest(&self, look: &Look<'_>, search: &Ray, place: &Transform, first: u64) -> Option<(f32, Met)> {
        if !look.eye.sees(self.object) {
            return None;
        }
        let part = first + self.first;
        self.place.below(place, look.time, |place| {
            let body = match &self.content {
                Content::Body(body) => body,
                Content::Group(group) => return group.closest(look, search, place, part),
            };
            let mut met = Met::default();
            look.closest(body, part, search, place, &mut met).map(|t| (t, met))
        })
    }

    fn blocks(&self, ray: &Ray, time: f32, place: &Transform) -> bool {
        let blocks = |place: &Transform| match &self.content {
            Content::Body(body) => body.blocks(place, ray),
            Content::Group(group) => group.blocks(ray, time, place),
        };
        self.shadow.stops && self.place.below(place, time, |place| blocks(place).then_some(())).is_some()
    }

    fn each_filter(&self, ray: &Ray, time: f32, place: &Transform, visit: &mut dyn FnMut(&Standing<'_, 's>)) {
        if !self.shadow.filters {
            return;
        }
        // What has no place at this moment filters nothing.
        let _ = self.place.below(place, time, |place| {
            match &self.content {
                Content::Body(body) => {
                    let (object, parameters) = (Some(self.object), self.parameters);
                    visit(&Standing { body, place, object, parameters });
                }
                Content::Group(group) => group.each_filter(ray, time, place, visit),
            }
            Some(())
        });
    }
}
