//! Light from surfaces: area lights, and objects whose material shines.

mod met;

use super::emitter::{Emitter, EmitterSample, Glow};
use super::flat::WorldFlat;
use super::lamps::Lamps;
use super::spherical_rectangle::WorldRectangle;
use super::{LightSample, Target, Use};
use crate::lanes::{LANES, Lanes, Vec3Lanes};
use crate::world::{Chain, Hull, Lamp, Now, Place};
use crate::world_sphere::WorldSphere;
use glam::{Vec2, Vec3};
use heliostat_geometry::shape::Sphere;
use heliostat_geometry::{Aabb, Shape, SurfacePoint, SurfaceSample, Transform};
use heliostat_scene::light::{Falloff, LightKind};
use heliostat_scene::object::Geometry;
use heliostat_scene::{Light, Object, Rgb};

/// A surface that shines.
#[derive(Debug)]
pub(super) struct AreaLight<'s> {
    emitter: Emitter<'s>,
    stand: Stand<'s>,
    glow: Glow<'s>,
    falloff: Falloff,
    /// Whether both sides shine, somewhere at least.
    two_sided: bool,
    shortcut: Option<Shortcut<'s>>,
    /// Whether the surface stops light.
    stops: bool,
    /// Whether rays meet the surface and find the same light there.
    is_met: bool,
}

/// Where the surface is.
#[derive(Debug)]
enum Stand<'s> {
    Place(Place<'s>),
    /// Inside groups.
    Chain(Box<Chain<'s>>),
}

impl Stand<'_> {
    /// See [`Place::now`].
    #[inline]
    fn now(&self, time: f32) -> Option<Now<'_>> {
        match self {
            Self::Place(place) => place.now(time),
            Self::Chain(chain) => chain.now(time).map(Now::Moving),
        }
    }

    /// The place of what stands still.
    fn still(&self) -> Option<Transform> {
        match self {
            Self::Place(Place::Still(transform)) => Some(**transform),
            Self::Place(_) => None,
            Self::Chain(chain) => chain.still().copied(),
        }
    }

    /// The box in world space of what has the box `local`, over the shutter.
    fn bounds(&self, local: Aabb) -> Aabb {
        match self {
            Self::Place(place) => place.bounds(local),
            Self::Chain(chain) => chain.bounds(local),
        }
    }

    /// See [`Hull::new`]; `None` without a finite box.
    fn hull(&self, local: Aabb, shape: Option<&Shape>) -> Option<Hull> {
        match self {
            Self::Place(place) => place.bounds(local).is_finite().then(|| Hull::new(local, shape, place)),
            Self::Chain(chain) => {
                let still = chain.still().map(|still| Hull::new(local, shape, &Place::Still(still)));
                let bounds = chain.bounds(local);
                bounds.is_finite().then(|| still.unwrap_or_else(|| Hull::of_box(bounds)))
            }
        }
    }
}

/// Surfaces whose points are found without looking at the emitter.
#[derive(Debug)]
enum Shortcut<'s> {
    /// A sphere that stands still and falls off: uniform by solid angle.
    Sphere(&'s Sphere, Box<Now<'s>>, WorldSphere),
    /// A flat lamp.
    Flat(WorldFlat),
    /// A rectangle that falls off: uniform by solid angle where that pays.
    Rectangle(WorldFlat, WorldRectangle),
}

/// A flat lamp that stands still, for many samples at once.
#[derive(Clone, Copy, Debug)]
pub(super) struct FlatLamp<'a> {
    pub(super) flat: &'a WorldFlat,
    pub(super) radiance: Rgb,
    falloff: Falloff,
    two_sided: bool,
}

impl FlatLamp<'_> {
    /// As [`AreaLight::share`], without branches: changes the ways to points of the lamp to unit directions, and gives the
    /// shares; 0 where nothing arrives. The direction to the point itself is not a number.
    #[expect(clippy::needless_range_loop, reason = "a lane is a number")]
    #[inline(always)]
    pub(super) fn shares(&self, ways: &mut Vec3Lanes) -> Lanes {
        let mut distance_squared = [0.0; LANES];
        for i in 0..LANES {
            let way = ways.get(i);
            distance_squared[i] = way.length_squared();
            ways.set(i, way * (1.0 / distance_squared[i].sqrt()));
        }
        if self.falloff == Falloff::None {
            return [1.0; LANES];
        }
        let (normal, area) = (self.flat.normal, self.flat.area);
        let mut shares = [0.0; LANES];
        (0..LANES).for_each(|i| shares[i] = -normal.dot(ways.get(i)));
        if self.two_sided {
            (0..LANES).for_each(|i| shares[i] = shares[i].abs());
        }
        for i in 0..LANES {
            let share = shares[i] * area / distance_squared[i];
            shares[i] = if (share > 0.0) & (share < f32::INFINITY) { share } else { 0.0 };
        }
        shares
    }
}

impl<'s> AreaLight<'s> {
    /// An area light of the scene; `None` when its surface has no finite area above 0.
    pub(super) fn of_light(stock: &mut Lamps<'s>, light: &'s Light) -> Option<Self> {
        let LightKind::Area { geometry, transform, two_sided, falloff, visible } = &light.kind else {
            return None;
        };
        let falls_off = *falloff == Falloff::InverseSquare;
        let used = stock.used;
        let flat = flat_of(geometry, transform, used == Use::Paths && falls_off);
        let sphere = || if falls_off { sphere_of(geometry, Now::Still(transform)) } else { None };
        let glow = Glow::Even(light.intensity);
        Some(Self {
            emitter: stock.emitter(geometry, &[], &glow, falls_off)?,
            stand: Stand::Place(Place::Still(transform)),
            glow,
            falloff: *falloff,
            two_sided: *two_sided,
            shortcut: flat.or_else(sphere),
            stops: *visible && used == Use::Paths,
            is_met: *visible && falls_off,
        })
    }

    /// An object with a material that shines; `None` for all others.
    pub(super) fn of_object(stock: &mut Lamps<'s>, object: &'s Object) -> Option<Self> {
        let still = (!object.motion.is_moving()).then(|| Now::Still(object.motion.first()));
        Self::shining(stock, object, Stand::Place(Place::of(&object.motion)), still, object.casts_shadow)
    }

    /// A part of a group with a material that shines; `None` for all others.
    pub(super) fn of_part(stock: &mut Lamps<'s>, lamp: Lamp<'s>) -> Option<Self> {
        let still = lamp.chain.still().map(|still| Now::Moving(*still));
        Self::shining(stock, lamp.object, Stand::Chain(Box::new(lamp.chain)), still, lamp.is_met)
    }

    /// An object that stands there, and if it does not move, at the place `still`.
    fn shining(
        stock: &mut Lamps<'s>,
        object: &'s Object,
        stand: Stand<'s>,
        still: Option<Now<'s>>,
        is_met: bool,
    ) -> Option<Self> {
        let glow = Glow::of(stock.scene, object);
        let flat = match (&still, glow, stock.used) {
            (Some(place), Glow::Even(_), Use::Paths) => flat_of(&object.geometry, place, true),
            _ => None,
        };
        Some(Self {
            emitter: stock.emitter(&object.geometry, &object.materials, &glow, true)?,
            stand,
            glow,
            falloff: Falloff::InverseSquare,
            two_sided: Glow::is_two_sided(stock.scene, object),
            shortcut: flat.or_else(|| still.and_then(|place| sphere_of(&object.geometry, place))),
            stops: true,
            is_met,
        })
    }

    /// Around the surface over the shutter; `None` when it has no finite box.
    pub(super) fn hull(&self) -> Option<Hull> {
        let local = self.emitter.bounds();
        let shape = match &self.emitter {
            Emitter::Shape(shape, _) => Some(*shape),
            Emitter::Mesh(_) => None,
        };
        self.stand.hull(local, shape)
    }

    /// The light that arrives at `p` from one point of a piece of the surface.
    #[inline]
    pub(super) fn sample(&self, p: Vec3, piece: usize, u: Vec2, time: f32) -> Option<LightSample> {
        let by_shortcut = match &self.shortcut {
            Some(Shortcut::Flat(flat)) => return self.sample_flat(flat, flat.point(u), p),
            Some(Shortcut::Rectangle(flat, rectangle)) => {
                return self.sample_rectangle(flat, rectangle, p, u);
            }
            Some(Shortcut::Sphere(local, transform, sphere)) => {
                self.sample_sphere(local, transform, *sphere, p, u)
            }
            None => None,
        };
        by_shortcut.or_else(|| self.sample_by_area(p, piece, u, time))
    }

    /// A point of a flat lamp.
    #[inline]
    fn sample_flat(&self, flat: &WorldFlat, on_light: Vec3, p: Vec3) -> Option<LightSample> {
        let Glow::Even(radiance) = self.glow else { return None };
        let (to_light, share) = self.share(on_light - p, flat.normal, flat.area)?;
        Some(LightSample {
            to_light,
            arriving: share * radiance,
            pdf: self.density_of(share),
            target: self.target(flat.at(on_light)),
        })
    }

    /// One point of a rectangle.
    #[inline]
    fn sample_rectangle(
        &self,
        flat: &WorldFlat,
        rectangle: &WorldRectangle,
        p: Vec3,
        u: Vec2,
    ) -> Option<LightSample> {
        let Some(seen) = rectangle.seen_from(p) else { return self.sample_flat(flat, flat.point(u), p) };
        let by_area = self.sample_flat(flat, seen.sample(u), p)?;
        let Glow::Even(radiance) = self.glow else { return None };
        let (arriving, pdf) = (seen.solid_angle * radiance, self.density_of(seen.solid_angle));
        Some(LightSample { arriving, pdf, ..by_area })
    }

    /// The lamp, where it is a flat one that stands still.
    #[inline]
    pub(super) fn flat_lamp(&self) -> Option<FlatLamp<'_>> {
        match (&self.shortcut, &self.glow) {
            (Some(Shortcut::Flat(flat)), Glow::Even(radiance)) => {
                Some(FlatLamp { flat, radiance: *radiance, falloff: self.falloff, two_sided: self.two_sided })
            }
            _ => None,
        }
    }

    /// One point of a piece of any surface, by local area and brightness.
    fn sample_by_area(&self, p: Vec3, piece: usize, u: Vec2, time: f32) -> Option<LightSample> {
        let (on_light, slot, radiance) = self.point(piece, u, time)?;
        let (to_light, share) = self.share(on_light.at.p - p, on_light.at.ng, on_light.pdf.recip())?;
        if !self.shines(slot, -to_light.dot(on_light.at.ng)) {
            return None;
        }
        Some(LightSample {
            to_light,
            arriving: share * radiance,
            pdf: self.density_of(share),
            target: self.target(on_light.at),
        })
    }

    /// A point of a piece, the material slot and the radiance there.
    pub(super) fn point(&self, piece: usize, u: Vec2, time: f32) -> Option<(SurfaceSample, u16, Rgb)> {
        let sample = self.emitter.sample(piece, u)?;
        let on_light = self.stand.now(time)?.sample_to_world(&sample.point);
        Some((on_light, sample.slot, self.glow.radiance(sample.slot, sample.at)))
    }

    /// Whether it weakens with the distance, as light does.
    pub(super) fn falls_off(&self) -> bool {
        self.falloff == Falloff::InverseSquare
    }

    /// Whether a slot shines to the side of its surface to which a direction leads that has this cosine to the normal.
    pub(super) fn shines(&self, slot: u16, cos: f32) -> bool {
        cos > 0.0 || (self.two_sided && !self.glow.has_dark_back(slot))
    }

    /// One point of a sphere by the solid angle under which it is seen; `None` inside.
    fn sample_sphere(
        &self,
        local: &Sphere,
        transform: &Transform,
        sphere: WorldSphere,
        p: Vec3,
        u: Vec2,
    ) -> Option<LightSample> {
        let seen = sphere.sample(p, u)?;
        let normal = transform.matrix().matrix3.inverse().mul_vec3(seen.normal).normalize();
        let point = local.point(normal);
        let at = transform.surface_point(point.p, point.p_err, point.ng);
        let sample = EmitterSample::on_shape(point);
        let radiance = self.glow.radiance(sample.slot, sample.at);
        Some(LightSample {
            to_light: seen.dir,
            arriving: seen.solid_angle * radiance,
            pdf: self.density_of(seen.solid_angle),
            target: self.target(at),
        })
    }

    /// The unit direction of `way`, from a point to a point of the surface with normal `ng` that stands for `area`, and
    /// the share of the radiance there that arrives as irradiance; `None` when nothing does.
    #[inline]
    fn share(&self, way: Vec3, ng: Vec3, area: f32) -> Option<(Vec3, f32)> {
        let distance_squared = way.length_squared();
        if distance_squared == 0.0 {
            return None;
        }
        let to_light = way / distance_squared.sqrt();
        // The report's model: a point that sends the same in all directions, undiminished.
        if self.falloff == Falloff::None {
            return Some((to_light, 1.0));
        }
        // Physics: the cosine at the light over the squared distance, by area.
        let cos = -ng.dot(to_light);
        let cos = if self.two_sided { cos.abs() } else { cos };
        let share = cos * area / distance_squared;
        // A piece of the surface that the map flattens to nothing has no area.
        (share > 0.0 && share.is_finite()).then_some((to_light, share))
    }

    fn target(&self, at: SurfacePoint) -> Target {
        if self.stops { Target::Surface(at) } else { Target::Point(at.p) }
    }

    /// See [`LightSample::pdf`], for a sample that stands for so much solid angle.
    #[inline]
    fn density_of(&self, solid_angle: f32) -> f32 {
        if self.is_met { solid_angle.recip() } else { f32::INFINITY }
    }
}

/// The shortcut for a flat lamp; a rectangle is seen by solid angle if `by_angle`.
fn flat_of<'s>(geometry: &Geometry, transform: &Transform, by_angle: bool) -> Option<Shortcut<'s>> {
    let Geometry::Shape(shape) = geometry else { return None };
    let flat = WorldFlat::new(shape, transform)?;
    Some(match flat.rectangle().filter(|_| by_angle) {
        Some(rectangle) => Shortcut::Rectangle(flat, rectangle),
        None => Shortcut::Flat(flat),
    })
}

/// The shortcut for a geometry that is a sphere in world space.
fn sphere_of<'s>(geometry: &'s Geometry, place: Now<'s>) -> Option<Shortcut<'s>> {
    match geometry {
        Geometry::Shape(Shape::Sphere(sphere)) => {
            let world = WorldSphere::new(sphere.radius, &place)?;
            Some(Shortcut::Sphere(sphere, Box::new(place), world))
        }
        _ => None,
    }
}
