//! Light from surfaces: area lights, and objects whose material shines.

use super::emitter::{Emitter, EmitterSample};
use super::sphere::WorldSphere;
use super::{LightSample, Target};
use crate::material_eval::MaterialEval;
use crate::texture_eval::TexturePoint;
use crate::world::Place;
use glam::{Vec2, Vec3};
use heliostat_geometry::{Shape, SurfacePoint, Transform};
use heliostat_scene::light::{Falloff, LightKind};
use heliostat_scene::material::Surface;
use heliostat_scene::object::Geometry;
use heliostat_scene::{Light, Object, Rgb, Scene};

/// A surface that shines.
#[derive(Debug)]
pub(super) struct AreaLight<'s> {
    emitter: Emitter<'s>,
    place: Place<'s>,
    radiance: Radiance<'s>,
    falloff: Falloff,
    two_sided: bool,
    /// The surface as a sphere, where it is one that stands still.
    sphere: Option<WorldSphere>,
}

/// What the surface gives off.
#[derive(Debug)]
enum Radiance<'s> {
    /// The same everywhere. The surface itself throws no shadow.
    Constant(Rgb),
    /// The emission of the object's materials. The object throws shadows.
    Object(&'s Scene, &'s Object),
}

impl<'s> AreaLight<'s> {
    /// An area light of the scene; `None` when its surface has no finite area above 0.
    pub(super) fn of_light(scene: &'s Scene, light: &'s Light) -> Option<Self> {
        let LightKind::Area { geometry, transform, two_sided, falloff, .. } = &light.kind else {
            return None;
        };
        Some(Self {
            emitter: Emitter::new(scene, geometry, |_| true)?,
            place: Place::Still(transform),
            radiance: Radiance::Constant(light.intensity),
            falloff: *falloff,
            two_sided: *two_sided,
            sphere: sphere_of(geometry, transform),
        })
    }

    /// An object with a material that shines, on both sides; `None` for all others.
    pub(super) fn of_object(scene: &'s Scene, object: &'s Object) -> Option<Self> {
        let shines = |slot: u16| {
            let Surface::Phong(phong) = &scene.materials[object.material(slot).index()].surface;
            !phong.emission.is_zero()
        };
        let still = (!object.motion.is_moving()).then(|| object.motion.first());
        Some(Self {
            emitter: Emitter::new(scene, &object.geometry, shines)?,
            place: Place::of(&object.motion),
            radiance: Radiance::Object(scene, object),
            falloff: Falloff::InverseSquare,
            two_sided: true,
            sphere: still.and_then(|transform| sphere_of(&object.geometry, transform)),
        })
    }

    /// The light that arrives at `p` from one point of the surface.
    #[inline]
    pub(super) fn sample(&self, p: Vec3, u: Vec2, time: f32) -> Option<LightSample> {
        match self.falloff {
            Falloff::None => self.sample_as_points(p, u, time),
            Falloff::InverseSquare => match self.sphere.and_then(|sphere| self.sample_sphere(sphere, p, u)) {
                Some(sample) => Some(sample),
                None => self.sample_by_area(p, u, time),
            },
        }
    }

    /// The report's model: a point that sends the same in all directions, undiminished.
    fn sample_as_points(&self, p: Vec3, u: Vec2, time: f32) -> Option<LightSample> {
        let sample = self.emitter.sample(u)?;
        let at = self.place.at(time, |transform| transform.sample_to_world(&sample.point).at)?;
        let to_light = (at.p - p).try_normalize()?;
        Some(LightSample { to_light, arriving: self.radiance_at(&sample), target: self.target(at) })
    }

    /// Radiance times the cosine at the light over the squared distance, over the density by area.
    fn sample_by_area(&self, p: Vec3, u: Vec2, time: f32) -> Option<LightSample> {
        let sample = self.emitter.sample(u)?;
        let on_light = self.place.at(time, |transform| transform.sample_to_world(&sample.point))?;
        let way = on_light.at.p - p;
        let distance_squared = way.length_squared();
        if distance_squared == 0.0 {
            return None;
        }
        let to_light = way / distance_squared.sqrt();
        let cos = self.emitted_cos(on_light.at.ng.dot(to_light));
        let weight = cos / (distance_squared * on_light.pdf);
        // A piece of the surface that the map flattens to nothing has an infinite density.
        (weight > 0.0 && weight.is_finite()).then(|| LightSample {
            to_light,
            arriving: weight * self.radiance_at(&sample),
            target: self.target(on_light.at),
        })
    }

    /// Radiance times the solid angle; `None` inside the sphere.
    fn sample_sphere(&self, sphere: WorldSphere, p: Vec3, u: Vec2) -> Option<LightSample> {
        let seen = sphere.sample(p, u)?;
        let Place::Still(transform) = self.place else { return None };
        let Emitter::Shape(Shape::Sphere(local_sphere)) = &self.emitter else { return None };
        let local_normal = transform.matrix().matrix3.inverse().mul_vec3(seen.normal).normalize();
        let sample = local_sphere.point(local_normal);
        let at = transform.sample_to_world(&sample).at;
        let radiance = self.radiance_at(&EmitterSample { point: sample, slot: 0 });
        Some(LightSample {
            to_light: seen.dir,
            arriving: seen.solid_angle * radiance,
            target: self.target(at),
        })
    }

    /// The cosine at the light from that of its normal with the direction to it; 0 on a dark side.
    fn emitted_cos(&self, cos: f32) -> f32 {
        if self.two_sided { cos.abs() } else { (-cos).max(0.0) }
    }

    fn radiance_at(&self, sample: &EmitterSample) -> Rgb {
        match self.radiance {
            Radiance::Constant(radiance) => radiance,
            Radiance::Object(scene, object) => {
                let material = &scene.materials[object.material(sample.slot).index()];
                let Surface::Phong(phong) = &material.surface;
                let at = TexturePoint { uv: sample.point.uv, local: sample.point.p.as_vec3() };
                let eval = MaterialEval { textures: &scene.textures, at };
                eval.opacity(material) * eval.color(&phong.emission)
            }
        }
    }

    fn target(&self, at: SurfacePoint) -> Target {
        match self.radiance {
            Radiance::Constant(_) => Target::Point(at.p),
            Radiance::Object(..) => Target::Surface(at),
        }
    }
}

/// The world sphere of a geometry, if it is one.
fn sphere_of(geometry: &Geometry, transform: &Transform) -> Option<WorldSphere> {
    match geometry {
        Geometry::Shape(Shape::Sphere(sphere)) => WorldSphere::new(sphere.radius, transform),
        _ => None,
    }
}
