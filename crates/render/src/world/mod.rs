//! A scene made ready for rays: indices over objects and meshes, and the table of its lights.
//!
//! Two levels: each mesh has one tree in its local space, however many objects show it; the world has one index over the
//! boxes of its objects. The visible surfaces of area lights stand beside the objects: rays see them, but they throw
//! no shadow, so that a bulb does not hide the light inside it.

mod blocker;
mod bound;
mod crossing;
mod error;
mod filter;
mod hit;
mod hull;
mod kinds;
mod level;
mod place;
mod shadow;
mod shadow_rays;
mod shaft;
mod solid;
mod terminator;
mod trees;

use crossing::coincide;
pub(crate) use crossing::{Inside, PassingRay};
pub use error::WorldError;
pub use hit::{Owner, SurfaceHit};
pub(crate) use hull::Hull;
pub(crate) use level::Candidates;
pub(crate) use place::Place;
pub(crate) use shadow_rays::ShadowRays;
pub use trees::TreeCache;

use crate::light::{LightTable, PreparedLight};
use heliostat_geometry::{Aabb, Ray};
use heliostat_index::{BspTree, MeshTree, TraversalCost};
use heliostat_scene::{RenderSettings, Rgb, Scene};
use kinds::{Shadow, parameters_of, shadow_of, visible_lights};
use level::Level;
use solid::{Meeting, Parameters, Solid, SurfaceAt};
use std::sync::Arc;

/// A scene made ready for rays.
#[derive(Debug)]
pub struct World<'s> {
    scene: &'s Scene,
    /// The objects in their order, then the visible surfaces of area lights.
    solids: Vec<Solid<'s>>,
    /// How each solid stops light.
    shadows: Vec<Shadow>,
    /// Whether the material of each solid, or a layer, looks at surface parameters.
    parameters: Vec<Parameters>,
    /// Index of the light behind each solid that is not an object.
    shining: Vec<u32>,
    level: Level,
    trees: Vec<Arc<MeshTree>>,
    lights: LightTable<'s>,
    /// What throws shadows: all of it, what lets nothing through, and the rest.
    casters: Candidates,
    stoppers: Candidates,
    filters: Candidates,
    /// Whether any solid lets light through.
    has_filters: bool,
    /// Whether glass lets light through.
    glass: bool,
    /// Whether all objects are seen by camera rays.
    all_visible: bool,
}

/// The nearest thing on the way of a ray.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    /// Index into the solids, for [`PassingRay::behind`].
    pub(crate) solid: u32,
    /// The surface.
    pub(crate) surface: SurfaceHit,
}

impl<'s> World<'s> {
    /// Makes `scene` ready.
    ///
    /// # Errors
    /// When the scene is not [valid](Scene::validate), cameras aside, or an index cannot be built.
    pub fn new(scene: &'s Scene, settings: &RenderSettings) -> Result<Self, WorldError> {
        Self::with_cache(scene, settings, &mut TreeCache::default())
    }

    /// Makes `scene` ready with the trees of meshes that `cache` knows, and leaves those of its own there.
    ///
    /// # Errors
    /// As [`World::new`].
    pub fn with_cache(
        scene: &'s Scene,
        settings: &RenderSettings,
        cache: &mut TreeCache,
    ) -> Result<Self, WorldError> {
        error::check(scene)?;
        let trees = cache.trees(scene)?;
        let objects = scene.objects.iter().map(|object| (&object.geometry, Place::of(&object.motion)));
        let (shining, surfaces): (Vec<_>, Vec<_>) = visible_lights(scene).unzip();
        let solids: Vec<_> = objects
            .chain(surfaces)
            .map(|(geometry, place)| Solid::new(scene, &trees, geometry, place))
            .collect();
        let glass = settings.transparent_shadows;
        let shadows: Vec<_> = scene.objects.iter().map(|object| shadow_of(scene, object, glass)).collect();
        let shadows = [shadows, vec![Shadow::None; shining.len()]].concat();
        let parameters = scene.objects.iter().map(|object| parameters_of(scene, object, &settings.layers));
        let parameters = parameters.chain(shining.iter().map(|_| Parameters::Used)).collect();
        let level = Level::new(&solids).map_err(|source| error::objects(scene, source))?;
        let of_kind = |kind: Shadow| level.candidates(|i| shadows[i as usize] == kind);
        Ok(Self {
            casters: level.candidates(|i| shadows[i as usize] != Shadow::None),
            stoppers: of_kind(Shadow::Solid),
            filters: of_kind(Shadow::Filter),
            level,
            lights: LightTable::new(scene),
            has_filters: shadows.contains(&Shadow::Filter),
            all_visible: scene.objects.iter().all(|object| object.visible),
            scene,
            solids,
            shadows,
            parameters,
            shining,
            trees,
            glass,
        })
    }

    /// The scene behind it.
    pub fn scene(&self) -> &'s Scene {
        self.scene
    }

    /// The box around everything finite over the shutter; empty when there is nothing.
    pub fn bounds(&self) -> Aabb {
        self.level.bounds()
    }

    /// The tree over the objects; `None` where they are few.
    pub fn object_tree(&self) -> Option<&BspTree> {
        self.level.tree()
    }

    /// The tree of each mesh of the scene, in their order.
    pub fn mesh_trees(&self) -> &[Arc<MeshTree>] {
        &self.trees
    }

    /// The nearest surface that a ray meets at `time` in `[0, 1]` over the shutter.
    pub fn closest_hit(&self, ray: &Ray, time: f32) -> Option<SurfaceHit> {
        self.seen(&PassingRay::free(*ray), time, false).map(|seen| seen.surface)
    }

    /// The nearest surface that the camera sees along a ray.
    pub fn camera_hit(&self, ray: &Ray, time: f32) -> Option<SurfaceHit> {
        self.seen(&PassingRay::free(*ray), time, true).map(|seen| seen.surface)
    }

    /// [`World::camera_hit`] that adds the work on both levels to `cost`.
    pub fn camera_hit_counted(&self, ray: &Ray, time: f32, cost: &mut TraversalCost) -> Option<SurfaceHit> {
        let mut below = TraversalCost::default();
        let found = self.level.closest_counted(ray, cost, |i, ray| {
            self.is_seen(i, true).then(|| self.solids[i as usize].closest_counted(ray, time, &mut below))?
        });
        cost.nodes += below.nodes;
        cost.leaves += below.leaves;
        cost.tests += below.tests;
        let found = found?;
        self.surface(found.primitive, ray, time, found.data, Parameters::Used)
    }

    /// The nearest thing on the way of a ray; invisible objects are left out for the camera.
    pub(crate) fn seen(&self, passing: &PassingRay, time: f32, camera: bool) -> Option<Seen> {
        self.nearest(passing, time, camera, |_| Parameters::Used)
    }

    #[inline]
    fn nearest(
        &self,
        passing: &PassingRay,
        time: f32,
        camera: bool,
        parameters: impl Fn(u32) -> Parameters,
    ) -> Option<Seen> {
        let found = self.level.closest(&passing.ray, |i, search| {
            if !self.is_seen(i, camera) {
                return None;
            }
            self.solids[i as usize].closest(&passing.seen_by(i, search), time)
        })?;
        let solid = found.primitive;
        let ray = passing.seen_by(solid, &passing.ray);
        let surface = self.surface(solid, &ray, time, found.data, parameters(solid))?;
        Some(Seen { solid, surface })
    }

    /// [`World::seen`] for a ray that may run through glass: where the surface of the glass and another one lie in the same
    /// place, the ray leaves the glass first, whichever of the two rounding puts in front.
    ///
    /// Surface parameters are left out where neither material nor layer looks at them.
    pub(crate) fn seen_inside(
        &self,
        passing: &PassingRay,
        inside: Option<Inside>,
        time: f32,
        camera: bool,
    ) -> Option<Seen> {
        let seen = self.nearest(passing, time, camera, |i| self.parameters[i as usize])?;
        if let Some(inside) = inside.filter(|inside| inside.solid != seen.solid) {
            let exit = self.seen_on(inside.solid, passing, time).filter(|exit| {
                let ng = exit.surface.hit.at.ng;
                ng.dot(passing.ray.dir) > 0.0 && coincide(&exit.surface.hit.at, &seen.surface.hit.at)
            });
            if exit.is_some() {
                return exit;
            }
        }
        Some(seen)
    }

    /// The nearest surface of one thing on the way of a ray.
    fn seen_on(&self, solid: u32, passing: &PassingRay, time: f32) -> Option<Seen> {
        let ray = passing.seen_by(solid, &passing.ray);
        let (_, meeting) = self.solids[solid as usize].closest(&ray, time)?;
        let surface = self.surface(solid, &ray, time, meeting, Parameters::Used)?;
        Some(Seen { solid, surface })
    }

    /// The lights that shine from somewhere.
    pub(crate) fn lights(&self) -> &[PreparedLight<'s>] {
        &self.lights.lights
    }

    /// Ia.
    pub(crate) fn ambient(&self) -> Rgb {
        self.lights.ambient
    }

    fn is_seen(&self, solid: u32, camera: bool) -> bool {
        !camera
            || self.all_visible
            || self.scene.objects.get(solid as usize).is_none_or(|object| object.visible)
    }

    #[inline]
    fn surface(
        &self,
        solid: u32,
        ray: &Ray,
        time: f32,
        meeting: Meeting,
        parameters: Parameters,
    ) -> Option<SurfaceHit> {
        let SurfaceAt { hit, local, slot, color, triangle } =
            self.solids[solid as usize].surface(ray, time, meeting, parameters)?;
        let owner = match self.scene.objects.get(solid as usize) {
            Some(object) => Owner::Object { index: solid, material: object.material(slot) },
            None => Owner::Light(self.shining[solid as usize - self.scene.objects.len()]),
        };
        Some(SurfaceHit { hit, owner, local, color, triangle })
    }

    /// The thing behind a hit.
    fn solid_of(&self, hit: &SurfaceHit) -> Option<&Solid<'s>> {
        match hit.owner {
            Owner::Object { index, .. } => self.solids.get(index as usize),
            Owner::Light(_) => None,
        }
    }
}
