//! The parts of groups that shine: each is a light of its own.

use super::super::place::Place;
use super::super::solid::Content;
use super::PreparedGroup;
use glam::DAffine3;
use heliostat_geometry::{Aabb, Transform};
use heliostat_scene::Object;

/// A part of a group that may shine.
#[derive(Debug)]
pub(crate) struct Lamp<'s> {
    /// The solid that holds it, and the number of the part.
    pub(crate) owner: (u32, u64),
    /// The object with the material.
    pub(crate) object: &'s Object,
    /// Whether it, and every group around it, casts shadows: only then scattered rays meet it.
    pub(crate) is_met: bool,
    /// Where it stands.
    pub(crate) chain: Chain<'s>,
}

/// A place through all groups that lead to it, the outermost first.
#[derive(Clone, Debug)]
pub(crate) struct Chain<'s> {
    links: Vec<Link<'s>>,
    /// The map to world space, where nothing moves.
    still: Option<Transform>,
}

/// One step of a chain.
#[derive(Clone, Copy, Debug)]
enum Link<'s> {
    Place(Place<'s>),
    Copy(&'s DAffine3),
}

impl<'s> PreparedGroup<'s> {
    /// Visits every part that may shine, where the group is a solid placed by `object`, in the order of parts.
    pub(crate) fn each_lamp(&self, solid: u32, object: &'s Object, visit: &mut dyn FnMut(Lamp<'s>)) {
        let links = &mut vec![Link::Place(Place::of(&object.motion))];
        self.lamps_below((solid, 0), object.casts_shadow, links, visit);
    }

    /// `owner` holds the number of the first part.
    fn lamps_below(
        &self,
        owner: (u32, u64),
        is_met: bool,
        links: &mut Vec<Link<'s>>,
        visit: &mut dyn FnMut(Lamp<'s>),
    ) {
        let shining = || self.members.iter().filter(|member| member.lamps > 0);
        if shining().next().is_none() {
            return;
        }
        for (i, copy) in (0..).zip(&self.group.places) {
            for member in shining() {
                let owner = (owner.0, owner.1 + i * self.parts + member.first);
                let is_met = is_met && member.object.casts_shadow;
                links.extend([Link::Copy(copy), Link::Place(member.place)]);
                match &member.content {
                    Content::Group(group) => group.lamps_below(owner, is_met, links, visit),
                    Content::Body(_) => {
                        visit(Lamp { owner, object: member.object, is_met, chain: Chain::new(links) });
                    }
                }
                links.truncate(links.len() - 2);
            }
        }
    }
}

impl<'s> Chain<'s> {
    fn new(links: &[Link<'s>]) -> Self {
        let mut chain = Self { links: links.to_vec(), still: None };
        let moves = |link: &Link<'_>| matches!(link, Link::Place(Place::Moving(_)));
        if !chain.links.iter().any(moves) {
            chain.still = chain.at(0.0);
        }
        chain
    }

    /// The map to world space, where nothing on the way moves.
    pub(crate) fn still(&self) -> Option<&Transform> {
        self.still.as_ref()
    }

    /// The map to world space at a moment; `None` where it has no inverse.
    pub(crate) fn now(&self, time: f32) -> Option<Transform> {
        self.still.or_else(|| self.at(time))
    }

    fn at(&self, time: f32) -> Option<Transform> {
        self.links.iter().try_fold(Transform::IDENTITY, |outer, link| match link {
            Link::Place(place) => place.below(&outer, time, |now| Some(*now)),
            Link::Copy(copy) => Transform::new(outer.matrix() * **copy),
        })
    }

    /// The box in world space of what has the box `local`, over the whole shutter.
    pub(crate) fn bounds(&self, local: Aabb) -> Aabb {
        self.links.iter().rev().fold(local, |inner, link| match link {
            Link::Place(place) => place.bounds(inner),
            Link::Copy(copy) => Transform::new(**copy).map_or(inner, |copy| copy.bounds(inner)),
        })
    }
}
