//! A scene made ready for rays: indices over objects and meshes, and the table of its lights.
//!
//! Levels: each mesh has one tree in its local space, however many objects show it; each group has its indices in its own
//! space, however often it is placed, at whatever depth; the world has one index over the boxes of its objects. The visible
//! surfaces of area lights stand beside the objects: rays see them, but they throw no shadow, so that a bulb does not hide the
//! light inside it; only where paths are traced they stop light, as they stop rays.

mod blocker;
mod body;
mod bound;
mod crossing;
mod error;
mod eye;
mod filter;
mod group;
mod hidden_backs;
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
mod thing;
mod trees;
mod volumes;

use crossing::coincide;
pub(crate) use crossing::{Inside, PassingRay};
pub use error::WorldError;
pub(crate) use eye::{Eye, Sight};
pub(crate) use group::{Chain, Lamp, PreparedGroup};
pub use hit::{Owner, SurfaceHit};
pub(crate) use hull::Hull;
pub(crate) use level::Candidates;
pub(crate) use place::{Now, Place};
pub(crate) use shadow_rays::ShadowRays;
pub(crate) use thing::Thing;
pub use trees::TreeCache;
pub(crate) use volumes::Matter;

use crate::bsdf::KnownBsdfs;
use crate::light::{LightTable, PreparedLight, Use};
use crate::ray_cone::RayCone;
use body::{Parameters, SurfaceAt};
use filter::Clear;
use glam::Vec2;
use group::{Groups, Look};
use heliostat_geometry::{Aabb, Ray};
use heliostat_index::{BspTree, MeshTree, TraversalCost};
use heliostat_scene::object::Geometry;
use heliostat_scene::settings::IntegratorKind;
use heliostat_scene::texture::{Minify, Pattern};
use heliostat_scene::{GroupId, Object, RenderSettings, Rgb, Scene};
use kinds::{Shadow, parameters_of, shadow_of, visible_lights};
use level::Level;
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use solid::{Content, Solid, Stock};
use std::cell::Cell;
use std::sync::Arc;
use thing::{Met, Standing};
use volumes::Volumes;

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
    /// In the order of the scene.
    groups: Vec<Arc<PreparedGroup<'s>>>,
    lights: LightTable<'s>,
    known_bsdfs: KnownBsdfs,
    /// What throws shadows: all of it, what lets nothing through, and the rest.
    casters: Candidates,
    stoppers: Candidates,
    filters: Candidates,
    /// Whether any solid lets light through.
    has_filters: bool,
    /// Which transparent surfaces let light through.
    clear: Clear,
    /// Whether every object is there for camera and scattered rays.
    all_seen: bool,
    /// Whether any material hides its back.
    hides_backs: bool,
    /// Whether light is followed below surfaces.
    walks: bool,
    volumes: Volumes<'s>,
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
        let census = error::check(scene)?;
        let trees = cache.trees(scene)?;
        if settings.mip_maps {
            make_mips(scene);
        }
        let (used, clear) = used(settings);
        let ready = group::Settings { clear, layers: &settings.layers };
        let groups =
            group::prepare(scene, &census, &trees, ready).map_err(|error| error::group(scene, error))?;
        let stock = Stock { scene, trees: &trees, groups: &groups };
        let objects = scene.objects.iter().map(|object| (&object.geometry, Place::of(&object.motion)));
        let (shining, surfaces): (Vec<_>, Vec<_>) = visible_lights(scene).unzip();
        let solids: Vec<_> =
            objects.chain(surfaces).map(|(geometry, place)| Solid::new(&stock, geometry, place)).collect();
        let objects = || scene.objects.iter().zip(&solids);
        let shadows = objects().map(|(object, solid)| shadow_of(scene, object, &solid.content, clear));
        let shadows: Vec<_> = shadows.chain(shining.iter().map(|_| Shadow::of_light(used))).collect();
        let parameters = scene.objects.iter().map(|object| parameters_of(scene, object, &settings.layers));
        let parameters = parameters.chain(shining.iter().map(|_| Parameters::Used)).collect();
        let level = Level::new(&solids).map_err(|source| error::objects(scene, source))?;
        let walks = settings.integrator == IntegratorKind::VolPath;
        let candidates = |is: fn(&Shadow) -> bool| level.candidates(|i| is(&shadows[i as usize]));
        Ok(Self {
            casters: candidates(|shadow| *shadow != Shadow::NONE),
            stoppers: candidates(|shadow| shadow.stops),
            filters: candidates(|shadow| shadow.filters),
            known_bsdfs: KnownBsdfs::new(scene, walks),
            walks,
            volumes: Volumes::new(scene, &census, solids.len(), &level),
            lights: LightTable::new(scene, lamps(scene, &groups), used, settings.light_choice),
            has_filters: shadows.iter().any(|shadow| shadow.filters),
            all_seen: scene.objects.iter().all(|object| object.visible && object.casts_shadow),
            hides_backs: scene.materials.iter().any(heliostat_scene::Material::hides_back),
            groups: in_order(scene, groups),
            level,
            scene,
            solids,
            shadows,
            parameters,
            shining,
            trees,
            clear,
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

    /// Each group of the scene, in their order.
    pub(crate) fn groups(&self) -> &[Arc<PreparedGroup<'s>>] {
        &self.groups
    }

    /// The nearest surface that a ray meets at `time` in `[0, 1]` over the shutter.
    pub fn closest_hit(&self, ray: &Ray, time: f32) -> Option<SurfaceHit> {
        self.seen(&PassingRay::free(*ray), time, Eye::Any)
    }

    /// The nearest surface that the camera sees along a ray.
    pub fn camera_hit(&self, ray: &Ray, time: f32) -> Option<SurfaceHit> {
        self.seen(&PassingRay::free(*ray), time, Eye::Camera)
    }

    /// [`World::camera_hit`] that adds the work on both levels to `cost`.
    pub fn camera_hit_counted(&self, ray: &Ray, time: f32, cost: &mut TraversalCost) -> Option<SurfaceHit> {
        let passing = PassingRay::free(*ray);
        let found = self.nearest_counted(&passing, time, cost);
        self.past_hidden_backs(found, &passing, Eye::Camera, |rest| self.nearest_counted(rest, time, cost))
    }

    /// The nearest thing on the way of a camera ray, hidden or not; adds the work on both levels to `cost`.
    fn nearest_counted(
        &self,
        passing: &PassingRay,
        time: f32,
        cost: &mut TraversalCost,
    ) -> Option<SurfaceHit> {
        let below = Cell::new(TraversalCost::default());
        let found = self.level.closest_counted(&passing.ray, cost, |i, ray, met| {
            let look = Look { passing, solid: i, time, eye: Eye::Camera, cost: Some(&below) };
            self.is_seen(i, Eye::Camera).then(|| self.meet(&look, ray, met))?
        });
        let below = below.get();
        cost.nodes += below.nodes;
        cost.leaves += below.leaves;
        cost.tests += below.tests;
        let found = found?;
        let ray = (&passing.ray, &RayCone::POINT);
        self.surface(found.primitive, ray, time, &found.data, Parameters::Used)
    }

    /// The nearest thing on the way of a ray that the eye sees.
    pub(crate) fn seen(&self, passing: &PassingRay, time: f32, eye: Eye) -> Option<SurfaceHit> {
        self.nearest(passing, time, eye, |_| Parameters::Used)
    }

    #[inline]
    fn nearest(
        &self,
        passing: &PassingRay,
        time: f32,
        eye: Eye,
        parameters: impl Fn(u32) -> Parameters,
    ) -> Option<SurfaceHit> {
        let found = self.nearest_side(passing, time, eye, &parameters);
        self.past_hidden_backs(found, passing, eye, |rest| self.nearest_side(rest, time, eye, &parameters))
    }

    /// [`World::nearest`], from whichever side.
    #[inline]
    fn nearest_side(
        &self,
        passing: &PassingRay,
        time: f32,
        eye: Eye,
        parameters: impl Fn(u32) -> Parameters,
    ) -> Option<SurfaceHit> {
        let found = self.level.closest(&passing.ray, |i, search, met| {
            if !self.is_seen(i, eye) {
                return None;
            }
            self.meet(&Look { passing, solid: i, time, eye, cost: None }, search, met)
        })?;
        let thing = Thing { solid: found.primitive, part: found.data.part };
        let mut room = None;
        let ray = passing.seen_by(thing, &passing.ray, &mut room);
        self.surface(thing.solid, (ray, &passing.cone), time, &found.data, parameters(thing.solid))
    }

    /// The nearest meeting of a ray with one solid: where on the ray, and the rest in `met`.
    #[inline(always)]
    fn meet(&self, look: &Look<'_>, search: &Ray, met: &mut Met) -> Option<f32> {
        let solid = &self.solids[look.solid as usize];
        let Content::Body(body) = &solid.content else { return self.meet_parts(look, search, met) };
        let mut room = None;
        look.closest(body, 0, search, solid.place.at(look.time, &mut room)?, met)
    }

    /// [`World::meet`] for a group; apart, so that shapes and meshes need not make room for it.
    #[inline(never)]
    fn meet_parts(&self, look: &Look<'_>, search: &Ray, met: &mut Met) -> Option<f32> {
        let solid = &self.solids[look.solid as usize];
        let Content::Group(group) = &solid.content else { return None };
        let mut room = None;
        let (t, part) = group.closest(look, search, solid.place.at(look.time, &mut room)?, 0)?;
        *met = part;
        Some(t)
    }

    /// [`World::seen`] for a ray that may run through glass: where the surface of the glass and another one lie in the same
    /// place, the ray leaves the glass first, whichever of the two rounding puts in front.
    ///
    /// Surface parameters are left out where neither material nor layer looks at them.
    pub(crate) fn seen_inside(
        &self,
        passing: &PassingRay,
        inside: Option<&Inside>,
        time: f32,
        eye: Eye,
    ) -> Option<SurfaceHit> {
        let parameters = |i| self.parameters[i as usize];
        // A hit is large: it is made where the caller wants it.
        let Some(inside) = inside else { return self.nearest(passing, time, eye, parameters) };
        let seen = self.nearest(passing, time, eye, parameters);
        self.exit_before(seen.as_ref(), inside, passing, time).or(seen)
    }

    /// Where a ray leaves the glass that it is in, if what it meets next lies in the same place.
    fn exit_before(
        &self,
        seen: Option<&SurfaceHit>,
        inside: &Inside,
        passing: &PassingRay,
        time: f32,
    ) -> Option<SurfaceHit> {
        let surface = seen.filter(|surface| surface.thing() != Some(inside.thing))?;
        self.seen_on(inside.thing, passing, time).filter(|exit| {
            exit.hit.at.ng.dot(passing.ray.dir) > 0.0 && coincide(&exit.hit.at, &surface.hit.at)
        })
    }

    /// The nearest surface of one thing on the way of a ray.
    fn seen_on(&self, thing: Thing, passing: &PassingRay, time: f32) -> Option<SurfaceHit> {
        let (mut room, mut met) = (None, Met { part: thing.part, ..Met::default() });
        let ray = passing.seen_by(thing, &passing.ray, &mut room);
        self.with_thing(thing, time, |standing| {
            standing.body.closest(standing.place, ray, &mut met.meeting)
        })?;
        self.surface(thing.solid, (ray, &passing.cone), time, &met, Parameters::Used)
    }

    /// The lights that shine from somewhere.
    pub(crate) fn lights(&self) -> &[PreparedLight<'s>] {
        &self.lights.lights
    }

    /// All lights, for paths.
    pub(crate) fn light_table(&self) -> &LightTable<'s> {
        &self.lights
    }

    /// Surfaces that are the same everywhere.
    #[inline]
    pub(crate) fn known_bsdfs(&self) -> &KnownBsdfs {
        &self.known_bsdfs
    }

    /// Whether light is followed below surfaces.
    #[inline]
    pub(crate) fn walks(&self) -> bool {
        self.walks
    }

    /// Ia.
    pub(crate) fn ambient(&self) -> Rgb {
        self.lights.ambient
    }

    fn is_seen(&self, solid: u32, eye: Eye) -> bool {
        eye == Eye::Any
            || self.all_seen
            || self.scene.objects.get(solid as usize).is_none_or(|object| eye.sees(object))
    }

    #[inline]
    fn surface(
        &self,
        solid: u32,
        (ray, cone): (&Ray, &RayCone),
        time: f32,
        met: &Met,
        parameters: Parameters,
    ) -> Option<SurfaceHit> {
        let (index, solid) = (solid, &self.solids[solid as usize]);
        let Content::Body(body) = &solid.content else {
            return self.surface_of_part(index, (ray, cone), time, met, parameters);
        };
        let mut room = None;
        let found = body.surface(solid.place.at(time, &mut room)?, ray, &met.meeting, parameters);
        let footprint = parameters.of(|| cone.footprint(&found.hit, ray.dir));
        Some(self.owned((index, 0), self.scene.objects.get(index as usize), found, footprint))
    }

    /// [`World::surface`] for a group; apart, as [`World::meet_parts`].
    #[inline(never)]
    fn surface_of_part(
        &self,
        solid: u32,
        (ray, cone): (&Ray, &RayCone),
        time: f32,
        met: &Met,
        parameters: Parameters,
    ) -> Option<SurfaceHit> {
        self.with_thing(Thing { solid, part: met.part }, time, |part| {
            let parameters = if parameters == Parameters::Used { parameters } else { part.parameters };
            let found = part.body.surface(part.place, ray, &met.meeting, parameters);
            let footprint = parameters.of(|| cone.footprint(&found.hit, ray.dir));
            Some(self.owned((solid, met.part), part.object, found, footprint))
        })
    }

    /// A surface with its owner.
    #[inline(always)]
    fn owned(
        &self,
        (solid, part): (u32, u64),
        object: Option<&Object>,
        found: SurfaceAt,
        footprint: [Vec2; 2],
    ) -> SurfaceHit {
        let SurfaceAt { hit, local, slot, uv1, color, coverage, triangle } = found;
        let owner = match object {
            Some(object) => Owner::Object { index: solid, material: object.material(slot) },
            None => Owner::Light(self.shining[solid as usize - self.scene.objects.len()]),
        };
        SurfaceHit { hit, owner, part, local, uv1, footprint, color, coverage, triangle }
    }

    /// Shows a thing at a moment to a closure; `None` where it has no place then.
    #[inline]
    fn with_thing<T>(
        &self,
        thing: Thing,
        time: f32,
        mut look: impl FnMut(&Standing<'_, 's>) -> Option<T>,
    ) -> Option<T> {
        let Thing { solid: index, part } = thing;
        let solid = &self.solids[index as usize];
        let mut room = None;
        let place = solid.place.at(time, &mut room)?;
        match &solid.content {
            Content::Body(body) => {
                let object = self.scene.objects.get(index as usize);
                look(&Standing { body, place, object, parameters: self.parameters[index as usize] })
            }
            Content::Group(group) => group.with_part(part, place, time, &mut look),
        }
    }

    /// [`World::with_thing`] for the thing behind a hit; `None` for the surface of a light.
    fn with_owner<T>(
        &self,
        hit: &SurfaceHit,
        time: f32,
        look: impl FnMut(&Standing<'_, 's>) -> Option<T>,
    ) -> Option<T> {
        match hit.owner {
            Owner::Object { index, .. } => {
                self.with_thing(Thing { solid: index, part: hit.part }, time, look)
            }
            Owner::Light(_) => None,
        }
    }
}

/// Makes the smaller copies of all images that ask for them, so that no ray waits for them.
fn make_mips(scene: &Scene) {
    scene.textures.par_iter().for_each(|texture| {
        let asks = matches!(
            texture.pattern,
            Pattern::Image { minify: Minify::Mip, .. } | Pattern::Tiles { minify: Minify::Mip, .. }
        );
        if asks {
            texture.images().for_each(|image| _ = image.level(1));
        }
    });
}

/// What lights are for, and which transparent surfaces let light through.
fn used(settings: &RenderSettings) -> (Use, Clear) {
    if settings.integrator.traces_paths() {
        (Use::Paths, Clear::Unbending)
    } else {
        (Use::Recursion, if settings.transparent_shadows { Clear::All } else { Clear::Nothing })
    }
}

/// The parts that shine in the groups of all objects.
fn lamps<'s>(scene: &'s Scene, groups: &Groups<'s>) -> Vec<Lamp<'s>> {
    let mut lamps = Vec::new();
    for (i, object) in (0..).zip(&scene.objects) {
        if let Geometry::Group(id) = &object.geometry {
            groups[id].each_lamp(i, object, &mut |lamp| lamps.push(lamp));
        }
    }
    lamps
}

fn in_order<'s>(scene: &Scene, mut groups: Groups<'s>) -> Vec<Arc<PreparedGroup<'s>>> {
    (0..scene.groups.len() as u32).filter_map(|id| groups.remove(&GroupId(id))).collect()
}
