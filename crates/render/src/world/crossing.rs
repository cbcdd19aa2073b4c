//! Rays that go on behind a surface, where another surface may lie in the same place.
//!
//! A glass standing on a floor shares its underside with it. A ray that leaves the glass must not start *behind* the
//! underside, as [`heliostat_geometry::Hit::spawn`] would have it: there it is behind the floor as well, and the floor is
//! lost wherever rounding puts it first. So the ray starts before the surface it crosses, and only the things that it
//! crosses in this place are asked with the origin behind them.

use super::hit::SurfaceHit;
use super::thing::Thing;
use crate::ray_cone::RayCone;
use glam::Vec3;
use heliostat_geometry::error_bound::offset_origin;
use heliostat_geometry::{Ray, SurfacePoint};
use heliostat_scene::{Material, MediumId, Rgb};

/// So many surfaces may lie in one place; of more, the ray leaves all behind at once.
const MOST: usize = 4;

/// The ray starts so many error bounds before the surface: the error of another surface in its place is of the same
/// order, and is not known yet.
const BEFORE: f32 = 4.0;

/// What a ray crosses where it starts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Crossing {
    /// The things it leaves behind.
    things: [Thing; MOST],
    count: u32,
    /// The surface crossed last.
    at: SurfacePoint,
    /// Origin behind it.
    behind: Vec3,
}

/// A ray and what it crosses where it starts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PassingRay {
    /// The ray; starts before the surface when there is a crossing.
    pub(crate) ray: Ray,
    /// Nothing for a ray that starts in free space or returns from a surface.
    pub(crate) crossing: Option<Crossing>,
    /// How wide it is.
    pub(crate) cone: RayCone,
}

/// The glass that a ray runs through.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Inside {
    /// Which.
    pub(crate) thing: Thing,
    /// Absorption per metre.
    pub(crate) absorption: Rgb,
    /// Whether light that passes its surface is bent: no shadow ray leaves it then.
    pub(crate) bends: bool,
    /// Its index of refraction, and which of several bodies there is where they overlap.
    pub(crate) ior: f32,
    pub(crate) priority: Option<u32>,
    /// The medium that fills it.
    pub(crate) interior: Option<MediumId>,
}

impl Inside {
    /// The inside of a thing behind a surface of that material.
    pub(crate) fn of(thing: Thing, material: &Material) -> Self {
        let surface = &material.surface;
        // What only has a medium inside absorbs nothing by itself.
        let absorption = if surface.refracts() { surface.absorption() } else { Rgb::ZERO };
        Self {
            thing,
            absorption,
            bends: surface.refracts() && !surface.passes_straight(),
            ior: if surface.refracts() { surface.ior() } else { 1.0 },
            priority: material.priority,
            interior: material.interior,
        }
    }
}

impl PassingRay {
    /// A ray without width that starts in free space or returns from a surface.
    pub(crate) fn free(ray: Ray) -> Self {
        Self { ray, crossing: None, cone: RayCone::POINT }
    }

    /// The same ray as wide as a cone.
    #[inline]
    pub(crate) fn with_cone(self, cone: RayCone) -> Self {
        Self { cone, ..self }
    }

    /// Its cone at a hit that it found.
    #[inline]
    pub(crate) fn cone_at(&self, hit: &SurfaceHit) -> RayCone {
        if self.cone.is_point() { self.cone } else { self.cone.after(hit.hit.t * self.ray.dir.length()) }
    }

    /// A ray in direction `dir` that goes on behind `hit`, which `self` found, with the cone that it had there.
    pub(crate) fn behind(&self, hit: &SurfaceHit, dir: Vec3) -> Self {
        let (at, cone) = (hit.hit.at, self.cone_at(hit));
        let behind = at.spawn(dir);
        let Some(thing) = hit.thing() else { return Self::free(behind).with_cone(cone) };
        // Surfaces crossed before belong to this place too, when this one lies within their error.
        let before = self.crossing.filter(|crossing| crossing.is_at(&at));
        let (mut things, mut count) =
            before.map_or(([thing; MOST], 0), |crossing| (crossing.things, crossing.count));
        if count as usize == MOST {
            return Self::free(behind).with_cone(cone);
        }
        things[count as usize] = thing;
        count += 1;
        let crossing = Crossing { things, count, at, behind: behind.origin };
        let origin = offset_origin(at.p, BEFORE * at.p_err, at.ng, -dir);
        Self { ray: Ray::new(origin, dir), crossing: Some(crossing), cone }
    }

    /// Becomes `ray`, which returns from a hit that it found, with the same cone: what was crossed in its place is met again.
    #[inline]
    pub(crate) fn turn_back(&mut self, hit: &SurfaceHit, ray: Ray) {
        match &self.crossing {
            Some(crossing) if crossing.is_at(&hit.hit.at) => {
                *self = Self::free(ray).behind(hit, ray.dir).with_cone(self.cone);
            }
            _ => self.start_free(ray),
        }
    }

    /// Becomes `ray`, which starts in free space, with the same cone.
    #[inline]
    pub(crate) fn start_free(&mut self, ray: Ray) {
        (self.ray, self.crossing) = (ray, None);
    }

    /// The ray with which a thing is asked: `range` of the search so far, the origin behind things that are crossed. In `room`
    /// only if it is another one.
    #[inline]
    pub(super) fn seen_by<'a>(&self, thing: Thing, search: &'a Ray, room: &'a mut Option<Ray>) -> &'a Ray {
        match &self.crossing {
            Some(crossing) if crossing.things[..crossing.count as usize].contains(&thing) => {
                room.insert(Ray { origin: crossing.behind, ..*search })
            }
            _ => search,
        }
    }
}

impl Crossing {
    /// Whether a surface lies in the place that is crossed.
    fn is_at(&self, other: &SurfacePoint) -> bool {
        coincide(&self.at, other)
    }
}

/// Whether two points of surfaces cannot be told apart across either surface.
pub(crate) fn coincide(a: &SurfacePoint, b: &SurfacePoint) -> bool {
    let way = b.p - a.p;
    let error = 2.0 * (a.p_err + b.p_err);
    [a.ng, b.ng].iter().all(|ng| ng.dot(way).abs() <= ng.abs().dot(error))
}
