//! What a ray runs through: the clear bodies and media that it has entered and not left, and which of them there is.
//!
//! Where bodies overlap, the one with the highest priority is there, and the surfaces of the others do not exist: a glass is
//! drawn a little into the water that it holds, and neither a gap nor a doubled surface shows. Bodies without a priority are
//! there from where the ray entered them last.
//!
//! # Source
//! Schmidt, Budge, "Simple Nested Dielectrics in Ray Traced Images", Journal of Graphics Tools 7(2), 2002.

use crate::world::{Inside, Thing};

/// A ray knows so many bodies that it is inside of; of more, the outermost are forgotten.
const MOST: usize = 6;

/// The bodies around a point, the one entered last at the end.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Interiors {
    bodies: [Option<Inside>; MOST],
    count: usize,
}

/// What passing a surface does to the bodies around a ray.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Change {
    /// Nothing.
    None,
    /// It enters a body.
    Enter(Inside),
    /// It leaves one.
    Leave(Thing),
}

impl Interiors {
    /// Open space.
    pub(crate) const NONE: Self = Self { bodies: [None; MOST], count: 0 };

    /// The body entered last.
    #[inline]
    pub(crate) fn last(&self) -> Option<&Inside> {
        self.bodies().last()
    }

    /// The body that is there.
    #[inline]
    pub(crate) fn ruling(&self) -> Option<&Inside> {
        self.bodies().reduce(stronger)
    }

    /// The body on the other side of the surface of a thing.
    #[inline]
    pub(crate) fn beside(&self, thing: Thing) -> Option<&Inside> {
        self.bodies().filter(|inside| inside.thing != thing).reduce(stronger)
    }

    /// Whether the surface of a thing with that priority does not exist here.
    #[inline]
    pub(crate) fn hides(&self, thing: Thing, priority: Option<u32>) -> bool {
        self.count > 0
            && priority.is_some()
            && self.beside(thing).is_some_and(|other| other.priority > priority)
    }

    /// Index of refraction on the other side of the surface of a thing, where that is a body with a priority; else 1.
    #[inline]
    pub(crate) fn ior_beside(&self, thing: Option<Thing>) -> f32 {
        if self.count == 0 {
            return 1.0;
        }
        let other = match thing {
            Some(thing) => self.beside(thing),
            None => self.ruling(),
        };
        other.filter(|inside| inside.priority.is_some()).map_or(1.0, |inside| inside.ior)
    }

    /// Passes a surface.
    #[inline]
    pub(crate) fn change(&mut self, change: &Change) {
        match change {
            Change::None => {}
            Change::Enter(inside) => self.enter(*inside),
            Change::Leave(thing) => self.leave(*thing),
        }
    }

    pub(crate) fn enter(&mut self, inside: Inside) {
        self.leave(inside.thing);
        if self.count == MOST {
            self.bodies.rotate_left(1);
            self.count -= 1;
        }
        self.bodies[self.count] = Some(inside);
        self.count += 1;
    }

    fn leave(&mut self, thing: Thing) {
        let Some(place) = self.bodies().position(|inside| inside.thing == thing) else { return };
        self.bodies[place..self.count].rotate_left(1);
        self.count -= 1;
        self.bodies[self.count] = None;
    }

    /// Forgets bodies that do not count.
    pub(crate) fn retain(&mut self, counts: impl Fn(&Inside) -> bool) {
        let kept = Self::NONE;
        let kept = self.bodies().filter(|inside| counts(inside)).fold(kept, |mut kept, inside| {
            kept.enter(*inside);
            kept
        });
        *self = kept;
    }

    #[inline]
    fn bodies(&self) -> impl DoubleEndedIterator<Item = &Inside> {
        self.bodies[..self.count].iter().flatten()
    }
}

/// Which of two bodies there is, the second one entered later.
fn stronger<'a>(earlier: &'a Inside, later: &'a Inside) -> &'a Inside {
    match (earlier.priority, later.priority) {
        (Some(a), Some(b)) if a > b => earlier,
        _ => later,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use heliostat_scene::Rgb;

    fn body(solid: u32, priority: Option<u32>) -> Inside {
        let thing = Thing { solid, part: 0 };
        let ior = 1.0 + solid as f32;
        Inside { thing, absorption: Rgb::ZERO, bends: true, ior, priority, interior: None }
    }

    fn solid(inside: Option<&Inside>) -> Option<u32> {
        inside.map(|inside| inside.thing.solid)
    }

    #[test]
    fn without_priorities_the_last_one_rules() {
        let mut around = Interiors::NONE;
        (1..=3).for_each(|i| around.enter(body(i, None)));
        assert_eq!(solid(around.ruling()), Some(3));
        around.leave(body(2, None).thing);
        around.leave(body(3, None).thing);
        assert_eq!(solid(around.ruling()), Some(1));
        assert_eq!(around.ior_beside(None), 1.0);
        around.leave(body(7, None).thing);
        assert_eq!(solid(around.last()), Some(1));
    }

    #[test]
    fn the_higher_priority_is_there_and_hides_the_lower() {
        // Water that laps into its glass.
        let (glass, water) = (body(1, Some(2)), body(2, Some(1)));
        let mut around = Interiors::NONE;
        around.enter(glass);
        assert!(around.hides(water.thing, water.priority));
        around.enter(water);
        assert_eq!(solid(around.ruling()), Some(1));
        assert!(!around.hides(glass.thing, glass.priority));
        assert_eq!(around.ior_beside(Some(glass.thing)), water.ior);
        around.leave(glass.thing);
        assert_eq!(solid(around.ruling()), Some(2));
        assert!(!around.hides(water.thing, water.priority));
        assert_eq!(around.ior_beside(Some(water.thing)), 1.0);
    }

    #[test]
    fn the_outermost_is_forgotten_when_there_are_too_many() {
        let mut around = Interiors::NONE;
        (0..20).for_each(|i| around.enter(body(i, None)));
        assert_eq!(solid(around.last()), Some(19));
        assert_eq!(around.bodies().count(), MOST);
        // A body entered twice is left once.
        around.enter(body(17, None));
        assert_eq!(around.bodies().count(), MOST);
        around.leave(body(17, None).thing);
        assert_eq!(solid(around.last()), Some(19));
    }
}
