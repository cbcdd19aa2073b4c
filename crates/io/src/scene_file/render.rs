//! `[render]`: how much work goes into a picture, and which layers come out.
//!
//! # Scene file
//! ```toml
//! [render]                       # these are the defaults
//! width = 960
//! height = 540
//! # region = [0, 0, 480, 270]    # left, top, right, bottom: only these pixels
//! samples = 16                   # camera rays per pixel; the least number where noise or time is set
//! # noise = 0.01                 # error of a pixel relative to its brightness, at which it has enough samples
//! # time = 60                    # seconds after which the render ends with the pass that it is in
//! # max_samples = 16384          # the most samples per pixel where noise or time is set
//! integrator = "whitted"         # "path", "volpath", "path_simple", "direct", "normals", "depth", "uv", "ambient_occlusion", "cost";
//!                                # "path" where a material is physically based, "volpath" where there is a medium
//! filter = "blackman_harris"     # "box", "tent", "gaussian", "mitchell", "lanczos"
//! filter_radius = 1.5            # pixels; the default depends on the filter
//! sampler = "blue"               # "white": how the noise of pixels stands to that of their neighbours
//! seed = 0
//! max_depth = 12                 # reflections and refractions in a row
//! min_weight = 0.001953125       # a branch of less weight is cut
//! transparent_shadows = false    # whether light passes, coloured and straight, through transparent things
//! # depth_limits = { total = 12 } # of the integrator "path"; see the module `depth_limits`
//! # clamp_indirect = 10          # the most that a sample of its indirect light adds; all of it if left out
//! caustics = "paths"             # "photons": what mirrors and clear glass throw onto matte things, from the lamps; under "path"
//! # caustic_photons = 100000     # photons for each sample
//! # caustic_radius = 0.01        # metres around a point in which they count at first; by the size of the glass if left out
//! guiding = "none"               # "learn": paths learn where light comes from before they are counted; under "path"
//! # guiding_paths = 1000000      # paths for practice; a quarter of the camera rays if left out
//! light_choice = "tree"          # which of many lights paths ask; "power", "uniform"
//! ao_samples = 16                # rays per point of the integrator "ambient_occlusion"
//! # ao_distance = 1              # their length in metres; without end if left out
//! mip_maps = true                # whether textures are averaged over what a ray stands for
//! layers = []                    # "depth", "normal", "albedo", "position", "uv", "object_id", "material_id",
//!                                # "sample_count", "variance"
//! transparent_background = false # alpha 0 where rays leave the scene
//! # camera = "main"              # the first camera if left out
//! ```

use super::depth_limits::DepthLimitsTable;
use super::number::{Count, NonNegative, Positive, Whole};
use crate::document::{Fault, Placed};
use heliostat_scene::RenderSettings;
use heliostat_scene::settings::{
    Caustics, Filter, Guiding, IntegratorKind, Layers, LightChoice, PixelRect, SamplerKind,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Pixels along one side of a picture.
pub type Side = Whole<1, 65_535>;

/// Most pixels of a picture: 2^30.
const MOST_PIXELS: i64 = 1 << 30;

/// How much work goes into a picture.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RenderTable {
    /// Width in pixels; 960 if left out.
    pub width: Option<Placed<Side>>,
    /// Height in pixels; 540 if left out.
    pub height: Option<Placed<Side>>,
    /// Left, top, right and bottom of the pixels to render; right and bottom lie outside. All if left out.
    pub region: Option<Placed<[Whole<0, 65_535>; 4]>>,
    /// Camera rays per pixel, the least number where `noise` or `time` is set; 16 if left out.
    pub samples: Option<Count>,
    /// Error of a pixel relative to its brightness, at which it has enough samples; all take the same number if left out.
    pub noise: Option<Positive>,
    /// Seconds after which the render ends with the pass that it is in; without end if left out.
    pub time: Option<Positive>,
    /// The most camera rays per pixel where `noise` or `time` is set; 16384 if left out.
    pub max_samples: Option<Count>,
    /// How radiance is found; `volpath` where there is a medium or light below surfaces, `path` where a
    /// material is physically based, else `whitted`, if left out.
    pub integrator: Option<IntegratorName>,
    /// Reconstruction filter; `blackman_harris` if left out.
    pub filter: Option<FilterName>,
    /// Radius of the filter in pixels; 0.5 for `box`, 1 for `tent`, 1.5 for `gaussian` and `blackman_harris`, 2
    /// for `mitchell`, 3 for `lanczos` if left out.
    pub filter_radius: Option<Positive>,
    /// How the random numbers of pixels stand to each other; `blue` if left out.
    pub sampler: Option<SamplerName>,
    /// Seed of all random numbers; 0 if left out.
    pub seed: Option<u64>,
    /// Reflections and refractions in a row, at most; 12 if left out.
    pub max_depth: Option<Whole<0, 1_024>>,
    /// A branch whose product of weights falls below this is cut; 1/512 if left out.
    pub min_weight: Option<NonNegative>,
    /// Whether light passes straight and coloured through transparent things; `false` if left out.
    pub transparent_shadows: Option<bool>,
    /// How long the paths of `path` may be; without end if left out.
    pub depth_limits: Option<DepthLimitsTable>,
    /// The most that one sample of indirect light adds to a channel under `path`: less noise, and less light. All of it if left
    /// out.
    pub clamp_indirect: Option<Positive>,
    /// How light is found that mirrors and clear glass throw onto matte things: by paths that meet a lamp by chance, or by
    /// photons from the lamps, under `path`: too smooth at first, and right with many samples. `paths` if left out.
    pub caustics: Option<CausticsName>,
    /// Photons for each sample of the picture; 100000 if left out.
    pub caustic_photons: Option<Placed<Whole<1, 16_777_216>>>,
    /// How far around a point photons count at the first sample, in metres; it shrinks with the samples. By the size of what is
    /// clear and mirrors if left out.
    pub caustic_radius: Option<Placed<Positive>>,
    /// Whether paths learn where light comes from before they are counted, under `path`: the same picture, with less noise where
    /// light comes by narrow ways. `none` if left out.
    pub guiding: Option<GuidingName>,
    /// Paths that are followed for practice, over the whole picture; a quarter of its camera rays by `samples`, from 16384 to
    /// 4194304, if left out.
    pub guiding_paths: Option<Placed<Whole<1, 268_435_456>>>,
    /// Which of many lights the integrators of paths ask: the noise is another, the picture the same. `tree` if left out.
    pub light_choice: Option<LightChoiceName>,
    /// Rays per point of the integrator `ambient_occlusion`; 16 if left out.
    pub ao_samples: Option<Count>,
    /// Length of those rays in metres; without end if left out.
    pub ao_distance: Option<Positive>,
    /// Whether textures are averaged over what a ray stands for, so that they do not flicker far away; true if left out.
    pub mip_maps: Option<bool>,
    /// Layers beside the beauty.
    pub layers: Option<Vec<LayerName>>,
    /// Whether alpha is 0 where rays leave the scene; `false` if left out.
    pub transparent_background: Option<bool>,
    /// The name of the camera; the first if left out.
    pub camera: Option<Placed<String>>,
}

/// How radiance is found along a camera ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum IntegratorName {
    /// Whitted's recursion.
    Whitted,
    /// Shading normals as colours.
    Normals,
    /// Distance, near is white.
    Depth,
    /// Texture coordinates as colours.
    Uv,
    /// Openness to the sky.
    AmbientOcclusion,
    /// Steps of the index as a heat map.
    Cost,
    /// Light that comes straight from the lights, physically based.
    Direct,
    /// All light, found by the scattering of surfaces alone: slow, to hold `path` against.
    PathSimple,
    /// All light, physically based; media are not seen.
    Path,
    /// All light, that in media and below surfaces with it.
    Volpath,
}

/// Reconstruction filters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FilterName {
    /// Equal weight.
    Box,
    /// Falling linearly.
    Tent,
    /// A Gaussian of standard deviation radius / 3.
    Gaussian,
    /// Mitchell and Netravali.
    Mitchell,
    /// A four-term Blackman-Harris window.
    BlackmanHarris,
    /// A windowed sinc.
    Lanczos,
}

/// How the random numbers of pixels stand to each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SamplerName {
    /// Not at all: white noise.
    White,
    /// Stratified among neighbours: blue noise, which is less seen.
    Blue,
}

/// Layers beside the beauty.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LayerName {
    /// `Z`: distance along the view.
    Depth,
    /// `N`: shading normal in world space.
    Normal,
    /// `albedo`: colour of the surface.
    Albedo,
    /// `P`: position in world space.
    Position,
    /// `UV`: texture coordinates.
    Uv,
    /// `object_id`: index of the object + 1.
    ObjectId,
    /// `material_id`: index of the material + 1.
    MaterialId,
    /// `sample_count`: samples of the pixel.
    SampleCount,
    /// `variance`: estimated square of the pixel's error.
    Variance,
}

/// How light is found that mirrors and clear glass throw onto matte things.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CausticsName {
    /// By paths that meet a lamp by chance.
    Paths,
    /// By photons from the lamps.
    Photons,
}

/// Whether paths learn where light comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum GuidingName {
    /// They go where surfaces send them.
    None,
    /// By paths for practice.
    Learn,
}

/// Which of many lights a point asks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LightChoiceName {
    /// By what each may throw there, through a tree.
    Tree,
    /// By power.
    Power,
    /// All alike.
    Uniform,
}

/// The names of the choices among lights and their counterparts in the scene.
const LIGHT_CHOICES: [(LightChoiceName, LightChoice); 3] = [
    (LightChoiceName::Tree, LightChoice::Tree),
    (LightChoiceName::Power, LightChoice::Power),
    (LightChoiceName::Uniform, LightChoice::Uniform),
];

/// The names of the filters and their counterparts in the scene.
const FILTERS: [(FilterName, Filter); 6] = [
    (FilterName::Box, Filter::Box),
    (FilterName::Tent, Filter::Tent),
    (FilterName::Gaussian, Filter::Gaussian),
    (FilterName::Mitchell, Filter::Mitchell),
    (FilterName::BlackmanHarris, Filter::BlackmanHarris),
    (FilterName::Lanczos, Filter::Lanczos),
];

/// The names of the integrators and their counterparts in the scene.
const INTEGRATORS: [(IntegratorName, IntegratorKind); 10] = [
    (IntegratorName::Whitted, IntegratorKind::Whitted),
    (IntegratorName::Normals, IntegratorKind::Normals),
    (IntegratorName::Depth, IntegratorKind::Depth),
    (IntegratorName::Uv, IntegratorKind::Uv),
    (IntegratorName::AmbientOcclusion, IntegratorKind::AmbientOcclusion),
    (IntegratorName::Cost, IntegratorKind::Cost),
    (IntegratorName::Direct, IntegratorKind::Direct),
    (IntegratorName::PathSimple, IntegratorKind::PathSimple),
    (IntegratorName::Path, IntegratorKind::Path),
    (IntegratorName::Volpath, IntegratorKind::VolPath),
];

/// The other half of the pair that holds `from`.
fn counterpart<A: Copy + PartialEq, B: Copy>(pairs: &[(A, B)], from: A) -> Option<B> {
    pairs.iter().find(|(a, _)| *a == from).map(|&(_, b)| b)
}

/// The other half of the pair that holds `from`, backwards.
fn counterpart_of<A: Copy, B: Copy + PartialEq>(pairs: &[(A, B)], from: B) -> Option<A> {
    pairs.iter().find(|(_, b)| *b == from).map(|&(a, _)| a)
}

fn default_radius(filter: Filter) -> f32 {
    match filter {
        Filter::Box => 0.5,
        Filter::Tent => 1.0,
        Filter::Gaussian | Filter::BlackmanHarris => 1.5,
        Filter::Mitchell => 2.0,
        Filter::Lanczos => 3.0,
    }
}

impl RenderTable {
    /// The settings, with `camera` as the index of the camera and `natural` as the integrator if none is named.
    pub(crate) fn settings(&self, camera: usize, natural: IntegratorKind) -> Result<RenderSettings, Fault> {
        let normal = RenderSettings::default();
        let (width, height) = self.size(&normal)?;
        let filter = self.filter.and_then(|name| counterpart(&FILTERS, name)).unwrap_or(normal.filter);
        let integrator = self.integrator.and_then(|name| counterpart(&INTEGRATORS, name));
        Ok(RenderSettings {
            width,
            height,
            region: self.region(width, height)?,
            samples: self.samples.map_or(normal.samples, Count::u32),
            noise: self.noise.map(Positive::f32),
            noise_floor: normal.noise_floor,
            time: self.time.map(Positive::get),
            max_samples: self.max_samples.map(Count::u32),
            integrator: integrator.unwrap_or(natural),
            filter,
            filter_radius: self.filter_radius.map_or(default_radius(filter), Positive::f32),
            sampler: match self.sampler {
                Some(SamplerName::White) => SamplerKind::White,
                Some(SamplerName::Blue) => SamplerKind::Blue,
                None => normal.sampler,
            },
            seed: self.seed.unwrap_or(normal.seed),
            max_depth: self.max_depth.map_or(normal.max_depth, Whole::u32),
            min_weight: self.min_weight.map_or(normal.min_weight, NonNegative::f32),
            transparent_shadows: self.transparent_shadows.unwrap_or(normal.transparent_shadows),
            depth_limits: self.depth_limits.as_ref().map_or(normal.depth_limits, DepthLimitsTable::limits),
            clamp_indirect: self.clamp_indirect.map(Positive::f32),
            caustics: self.caustics()?,
            caustic_photons: self
                .caustic_photons
                .as_ref()
                .map_or(normal.caustic_photons, |count| count.u32()),
            caustic_radius: self.caustic_radius.as_ref().map(|radius| radius.f32()),
            guiding: self.guiding()?,
            guiding_paths: self.guiding_paths.as_ref().map(|count| count.u32()),
            light_choice: self
                .light_choice
                .and_then(|name| counterpart(&LIGHT_CHOICES, name))
                .unwrap_or(normal.light_choice),
            ao_samples: self.ao_samples.map_or(normal.ao_samples, Count::u32),
            ao_distance: self.ao_distance.map_or(normal.ao_distance, Positive::f32),
            mip_maps: self.mip_maps.unwrap_or(normal.mip_maps),
            layers: layers(self.layers.as_deref().unwrap_or_default()),
            transparent_background: self.transparent_background.unwrap_or(normal.transparent_background),
            camera,
            threads: normal.threads,
        })
    }

    /// How caustics are found; an error where something is said of photons that nobody asks for.
    fn caustics(&self) -> Result<Caustics, Fault> {
        if self.caustics == Some(CausticsName::Photons) {
            return Ok(Caustics::Photons);
        }
        let count = self.caustic_photons.as_ref().map(|count| ("caustic_photons", count.span()));
        let radius = self.caustic_radius.as_ref().map(|radius| ("caustic_radius", radius.span()));
        match count.or(radius) {
            Some((key, span)) => Err(Fault::new(format!("`{key}` does nothing without photons"))
                .with_help("write caustics = \"photons\", or leave it out")
                .or_at(span)),
            None => Ok(Caustics::Paths),
        }
    }

    /// Whether paths learn; an error where something is said of practice that nobody asks for.
    fn guiding(&self) -> Result<Guiding, Fault> {
        match &self.guiding_paths {
            _ if self.guiding == Some(GuidingName::Learn) => Ok(Guiding::Learn),
            None => Ok(Guiding::None),
            Some(paths) => Err(Fault::new("`guiding_paths` does nothing without guiding")
                .with_help("write guiding = \"learn\", or leave it out")
                .or_at(paths.span())),
        }
    }

    fn size(&self, normal: &RenderSettings) -> Result<(u32, u32), Fault> {
        let width = self.width.as_ref().map_or(normal.width, |side| side.u32());
        let height = self.height.as_ref().map_or(normal.height, |side| side.u32());
        if i64::from(width) * i64::from(height) > MOST_PIXELS {
            let side = self.width.as_ref().or(self.height.as_ref());
            return Err(Fault::new(format!("a picture of {width} x {height} pixels is too large"))
                .with_help(format!("choose at most {MOST_PIXELS} pixels in all"))
                .or_at(side.and_then(Placed::span)));
        }
        Ok((width, height))
    }

    fn region(&self, width: u32, height: u32) -> Result<Option<PixelRect>, Fault> {
        let Some(region) = &self.region else { return Ok(None) };
        let [x0, y0, x1, y1] = region.map(Whole::u32);
        if x0 < x1 && y0 < y1 && x1 <= width && y1 <= height {
            return Ok(Some(PixelRect { x0, y0, x1, y1 }));
        }
        Err(Fault::new("the region is empty or leaves the picture")
            .with_help(format!("write [left, top, right, bottom] within [0, 0, {width}, {height}]"))
            .or_at(region.span()))
    }

    /// The table that gives `settings`, seen through the camera of that name.
    ///
    /// Threads belong to the machine and the noise floor to the exposure: both are left out.
    pub fn from_settings(settings: &RenderSettings, camera: Option<&str>) -> Self {
        let photons = settings.caustics == Caustics::Photons;
        let learns = settings.guiding == Guiding::Learn;
        let region = settings.region.and_then(|r| {
            let side = |v: u32| Whole::new(i64::from(v));
            Some([side(r.x0)?, side(r.y0)?, side(r.x1)?, side(r.y1)?].into())
        });
        Self {
            width: Whole::new(settings.width.into()).map(Placed::from),
            height: Whole::new(settings.height.into()).map(Placed::from),
            region,
            samples: Whole::new(settings.samples.into()),
            noise: settings.noise.and_then(|noise| Positive::new(noise.into())),
            time: settings.time.and_then(Positive::new),
            max_samples: settings.max_samples.and_then(|most| Whole::new(most.into())),
            integrator: counterpart_of(&INTEGRATORS, settings.integrator),
            filter: counterpart_of(&FILTERS, settings.filter),
            filter_radius: Positive::new(settings.filter_radius.into()),
            sampler: Some(match settings.sampler {
                SamplerKind::White => SamplerName::White,
                SamplerKind::Blue => SamplerName::Blue,
            }),
            seed: Some(settings.seed),
            max_depth: Whole::new(settings.max_depth.into()),
            min_weight: NonNegative::new(settings.min_weight.into()),
            transparent_shadows: Some(settings.transparent_shadows),
            depth_limits: Some(DepthLimitsTable::of(&settings.depth_limits)),
            clamp_indirect: settings.clamp_indirect.and_then(|most| Positive::new(most.into())),
            caustics: Some(match settings.caustics {
                Caustics::Paths => CausticsName::Paths,
                Caustics::Photons => CausticsName::Photons,
            }),
            caustic_photons: photons
                .then_some(settings.caustic_photons.into())
                .and_then(Whole::new)
                .map(Placed::from),
            caustic_radius: settings
                .caustic_radius
                .filter(|_| photons)
                .and_then(|radius| Positive::new(radius.into()))
                .map(Placed::from),
            guiding: Some(if learns { GuidingName::Learn } else { GuidingName::None }),
            guiding_paths: settings
                .guiding_paths
                .filter(|_| learns)
                .and_then(|paths| Whole::new(paths.into()))
                .map(Placed::from),
            light_choice: counterpart_of(&LIGHT_CHOICES, settings.light_choice),
            ao_samples: Whole::new(settings.ao_samples.into()),
            ao_distance: Positive::new(settings.ao_distance.into()),
            mip_maps: Some(settings.mip_maps),
            layers: Some(layer_names(settings.layers)),
            transparent_background: Some(settings.transparent_background),
            camera: camera.map(|name| name.to_owned().into()),
        }
    }
}

fn layers(names: &[LayerName]) -> Layers {
    let has = |name| names.contains(&name);
    Layers {
        depth: has(LayerName::Depth),
        normal: has(LayerName::Normal),
        albedo: has(LayerName::Albedo),
        position: has(LayerName::Position),
        uv: has(LayerName::Uv),
        object_id: has(LayerName::ObjectId),
        material_id: has(LayerName::MaterialId),
        sample_count: has(LayerName::SampleCount),
        variance: has(LayerName::Variance),
    }
}

fn layer_names(layers: Layers) -> Vec<LayerName> {
    let pairs = [
        (layers.depth, LayerName::Depth),
        (layers.normal, LayerName::Normal),
        (layers.albedo, LayerName::Albedo),
        (layers.position, LayerName::Position),
        (layers.uv, LayerName::Uv),
        (layers.object_id, LayerName::ObjectId),
        (layers.material_id, LayerName::MaterialId),
        (layers.sample_count, LayerName::SampleCount),
        (layers.variance, LayerName::Variance),
    ];
    pairs.into_iter().filter(|(is_on, _)| *is_on).map(|(_, name)| name).collect()
}
