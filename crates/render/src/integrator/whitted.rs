//! The recursion of Whitted: local light, plus what mirror and glass show, as deep as it matters.
//!
//! The recursion is unrolled: a branch carries the product of the weights on its way from the camera, and what it finds is
//! added with that weight. So depth costs no stack, and a branch whose weight no longer matters is cut where it begins.
//! Light is linear and adds up without bound. There is no light from diffuse surfaces on others: Ia stands for it.
//!
//! # Source
//! Whitted, "An Improved Illumination Model for Shaded Display", CACM 1980; Hall and Greenberg, "A Testbed for Realistic
//! Image Synthesis", IEEE CG&A 1983 (cutting by weight).

use super::first::on_light;
use super::next_event::left_of;
use super::{CameraRay, FirstHit, Integrator, Sample};
use crate::counters::RayCounters;
use crate::light::{self, direct};
use crate::sampler::Sampler;
use crate::shading::ShadingPoint;
use crate::world::{Eye, Inside, Owner, PassingRay, SurfaceHit, World};
use heliostat_scene::{RenderSettings, Rgb};

/// Streams of random numbers of the branches.
const MIRROR_BRANCH: u32 = 1;
const GLASS_BRANCH: u32 = 2;
const STRAIGHT_BRANCH: u32 = 3;

/// The report's integrator.
#[derive(Clone, Debug, PartialEq)]
pub struct Whitted {
    max_depth: u32,
    min_weight: f32,
    transparent_background: bool,
}

/// A branch of the recursion that waits to be followed.
#[derive(Clone, Copy, Debug)]
struct Branch {
    passing: PassingRay,
    /// Product of the weights on the way here.
    weight: Rgb,
    /// Reflections and refractions on the way here.
    depth: u32,
    /// The glass that it runs through.
    inside: Option<Inside>,
    /// Whether it comes straight from the camera, cut-outs aside: invisible objects are not seen.
    from_camera: bool,
    /// Whether it has only passed through things: then it sees no background that is to stay transparent.
    passed_only: bool,
    sampler: Sampler,
}

/// What the branches have found so far.
#[derive(Debug, Default)]
struct Found {
    radiance: Rgb,
    /// Weight with which rays left the scene where the background is to stay transparent.
    through: f32,
    first: Option<FirstHit>,
    pending: Vec<Branch>,
}

impl Whitted {
    /// By the settings for depth, weight and background.
    pub fn new(settings: &RenderSettings) -> Self {
        Self {
            max_depth: settings.max_depth,
            min_weight: settings.min_weight,
            transparent_background: settings.transparent_background,
        }
    }
}

impl Integrator for Whitted {
    fn radiance(
        &self,
        world: &World<'_>,
        ray: &CameraRay,
        sampler: &mut Sampler,
        counters: &mut RayCounters,
    ) -> Sample {
        let mut found = Found::default();
        let mut branch = Branch {
            passing: PassingRay::free(ray.ray).with_cone(ray.cone),
            weight: Rgb::ONE,
            depth: 0,
            inside: None,
            from_camera: true,
            passed_only: true,
            sampler: sampler.fork(0),
        };
        loop {
            self.follow(world, &mut branch, ray.time, &mut found, counters);
            let Some(next) = found.pending.pop() else { break };
            branch = next;
        }
        Sample { radiance: found.radiance, alpha: 1.0 - found.through, first: found.first }
    }
}

impl Whitted {
    /// Adds what a branch sees, and leaves the branches that start there.
    fn follow(
        &self,
        world: &World<'_>,
        branch: &mut Branch,
        time: f32,
        found: &mut Found,
        counters: &mut RayCounters,
    ) {
        // Find what the ray meets first, and colour what comes through glass.
        let eye = if branch.from_camera { Eye::Camera } else { Eye::Mirrored };
        let seen = world.seen_inside(&branch.passing, branch.inside.as_ref(), time, eye);
        let Some(surface) = &seen else {
            self.leave(world, branch, found);
            return;
        };
        let dir = branch.passing.ray.dir;
        let way = surface.hit.t * dir.length();
        if let Some(inside) = branch.inside {
            branch.weight *= left_of(inside.absorption, way);
        }
        let (object, material) = match surface.owner {
            Owner::Object { index, material } => (index, material),
            Owner::Light(light) => {
                let light = &world.scene().lights[light as usize];
                found.radiance += branch.weight * light::seen(light, surface.hit.at.ng, dir);
                found.first.get_or_insert_with(|| on_light(surface, dir));
                return;
            }
        };

        // A ray that leaves glass it was not known to be in: the camera stands in it, or one thing in another.
        let point = ShadingPoint::new(world, surface, material, dir, time);
        if let (None, Some(absorption)) = (branch.inside, point.left_absorption()) {
            branch.weight *= left_of(absorption, way);
        }

        // Let the ray go on where the surface is cut away.
        if point.opacity < 1.0 {
            let straight = Branch {
                passing: branch.passing.behind(surface, dir),
                weight: (1.0 - point.opacity) * branch.weight,
                sampler: branch.sampler.fork(STRAIGHT_BRANCH),
                ..*branch
            };
            self.push(straight, found, &mut counters.refraction);
            branch.weight *= point.opacity;
            if point.opacity == 0.0 {
                return;
            }
        }
        found.first.get_or_insert_with(|| point.first_hit(object, material));

        // Add the light of the surface itself and of the lamps.
        let mut local = point.phong.emission + point.phong.ambient * world.ambient();
        local += direct::lighting(world, &point.lit(world), &mut branch.sampler.clone(), counters);
        found.radiance += branch.weight * local;

        // Follow mirror and glass.
        if branch.depth < self.max_depth {
            self.mirror_and_glass(branch, surface, &point, found, counters);
        }
    }

    /// Leaves a branch for the mirror direction and one for the refracted direction.
    fn mirror_and_glass(
        &self,
        branch: &Branch,
        surface: &SurfaceHit,
        point: &ShadingPoint<'_>,
        found: &mut Found,
        counters: &mut RayCounters,
    ) {
        let split = point.split();
        if split.mirror != Rgb::ZERO {
            let reflected = Branch {
                passing: PassingRay::free(surface.hit.spawn(split.mirror_dir))
                    .with_cone(branch.passing.cone_at(surface)),
                weight: branch.weight * split.mirror,
                depth: branch.depth + 1,
                from_camera: false,
                passed_only: false,
                sampler: branch.sampler.fork(MIRROR_BRANCH),
                ..*branch
            };
            self.push(reflected, found, &mut counters.reflection);
        }
        if let Some((weight, dir)) = split.glass {
            let refracted = Branch {
                passing: branch.passing.behind(surface, dir),
                weight: branch.weight * weight,
                depth: branch.depth + 1,
                inside: surface
                    .thing()
                    .filter(|_| point.enters)
                    .map(|thing| Inside::of(thing, point.material)),
                from_camera: false,
                sampler: branch.sampler.fork(GLASS_BRANCH),
                ..*branch
            };
            self.push(refracted, found, &mut counters.refraction);
        }
    }

    /// Keeps a branch whose weight still matters.
    fn push(&self, branch: Branch, found: &mut Found, counter: &mut u64) {
        if branch.weight.max_element() >= self.min_weight {
            *counter += 1;
            found.pending.push(branch);
        }
    }

    /// Adds the background, or leaves it transparent.
    fn leave(&self, world: &World<'_>, branch: &Branch, found: &mut Found) {
        if self.transparent_background && branch.passed_only {
            found.through += branch.weight.element_sum() / 3.0;
        } else {
            let dir = branch.passing.ray.dir.normalize();
            found.radiance += branch.weight * world.light_table().seen(dir);
        }
    }
}
