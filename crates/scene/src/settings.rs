//! How much work goes into a picture.

/// Reconstruction filters, each with a default radius in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Filter {
    /// Equal weight within the radius (0.5).
    Box,
    /// Falling linearly to the radius (1.0).
    Tent,
    /// A Gaussian of standard deviation radius / 3 (1.5).
    Gaussian,
    /// Mitchell and Netravali with B = C = 1/3 (2.0).
    Mitchell,
    /// A four-term Blackman-Harris window (1.5).
    BlackmanHarris,
    /// A windowed sinc (3.0).
    Lanczos,
}

/// How radiance is found along a camera ray.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum IntegratorKind {
    /// The report's recursion.
    #[default]
    Whitted,
    /// Shading normals as colours.
    Normals,
    /// Perpendicular distance, near is white.
    Depth,
    /// Surface parameters as colours.
    Uv,
    /// Openness to the sky.
    AmbientOcclusion,
    /// Steps of the index as a heat map.
    Cost,
    /// Light that comes from the lights to the first surface, and nothing that surfaces hand on.
    Direct,
    /// All ways of light, found by the scattering of surfaces alone: slow, short, and what [`Self::Path`] is held against.
    PathSimple,
    /// All ways of light, found by lights and surfaces together; media are not seen.
    Path,
    /// The same with the ways through media and below surfaces.
    VolPath,
}

impl IntegratorKind {
    /// Whether pictures of it have noise beside that of edges.
    pub fn is_noisy(self) -> bool {
        self.traces_paths() || matches!(self, Self::Whitted | Self::AmbientOcclusion)
    }

    /// Whether it follows light as physics has it, so that surfaces and lights mean what their units say.
    pub fn traces_paths(self) -> bool {
        matches!(self, Self::Direct | Self::PathSimple | Self::Path | Self::VolPath)
    }
}

/// Which of many lights a point asks, where paths are traced. The picture is the same; the noise is not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LightChoice {
    /// By a tree over all lights that knows where they are and where they shine: as few lights as many.
    #[default]
    Tree,
    /// By power alone, wherever the point is.
    Power,
    /// All alike.
    Uniform,
}

/// How often light may be handed on before it reaches the camera, by what surfaces do to it. 0 leaves light that comes
/// straight from a light to a surface. Every limit is a bias: light beyond it is missing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DepthLimits {
    /// All together.
    pub total: u32,
    /// Scattered by matte layers.
    pub diffuse: u32,
    /// Reflected by smooth or rough layers.
    pub glossy: u32,
    /// Refracted, or let through by thin walls.
    pub transmission: u32,
    /// Scattered by media; these do not count in `total`.
    pub volume: u32,
}

/// How light is found that a mirror or clear glass has thrown onto something matte.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Caustics {
    /// By paths that meet the lamp by chance: unbiased, with noise where lamps are small, and without those of point lights.
    #[default]
    Paths,
    /// By photons that are sent from the lamps with every sample. Too smooth at first, and right in the end: a bias that goes
    /// away with the samples. Of [`IntegratorKind::Path`] alone.
    Photons,
}

/// Whether paths learn where light comes from before they are counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Guiding {
    /// They go where surfaces send them.
    #[default]
    None,
    /// They practise on the whole picture first: the same picture, with less noise where light comes by narrow ways. Of
    /// [`IntegratorKind::Path`] alone.
    Learn,
}

/// How the random numbers of pixels stand to each other. A pixel is equally good by itself either way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SamplerKind {
    /// Nothing: the error of a picture is white noise.
    White,
    /// Stratified among neighbours: the error is blue noise, which is less seen, and goes away with the least blur.
    #[default]
    Blue,
}

impl DepthLimits {
    /// So deep that no light is missed that eye or image file could tell: paths end by chance long before.
    pub const MOST: u32 = 1024;
    /// The same for media that scatter all and absorb nothing, in which light wanders for long.
    pub const MOST_VOLUME: u32 = 1 << 20;
}

impl Default for DepthLimits {
    fn default() -> Self {
        Self {
            total: Self::MOST,
            diffuse: Self::MOST,
            glossy: Self::MOST,
            transmission: Self::MOST,
            volume: Self::MOST_VOLUME,
        }
    }
}

/// A rectangle of pixels: `x0 <= x < x1`, `y0 <= y < y1`, `y` from the top.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PixelRect {
    /// Left column.
    pub x0: u32,
    /// Top row.
    pub y0: u32,
    /// Column after the last.
    pub x1: u32,
    /// Row after the last.
    pub y1: u32,
}

impl PixelRect {
    /// Columns.
    pub fn width(&self) -> u32 {
        self.x1 - self.x0
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.y1 - self.y0
    }
}

/// Which extra layers come out beside the beauty.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Layers {
    /// `Z`: perpendicular distance, of the sample nearest to the pixel centre; 1e10 on a miss.
    pub depth: bool,
    /// `N.X N.Y N.Z`: shading normal in world space.
    pub normal: bool,
    /// `albedo.R albedo.G albedo.B`.
    pub albedo: bool,
    /// `P.X P.Y P.Z`: world position.
    pub position: bool,
    /// `UV.U UV.V`.
    pub uv: bool,
    /// `object_id.Y`: index + 1, 0 on a miss.
    pub object_id: bool,
    /// `material_id.Y`: index + 1, 0 on a miss.
    pub material_id: bool,
    /// `sample_count.Y`: samples of the pixel.
    pub sample_count: bool,
    /// `variance.R variance.G variance.B`: estimated square of the pixel's error.
    pub variance: bool,
}

impl Layers {
    /// Every layer.
    pub const ALL: Self = Self {
        depth: true,
        normal: true,
        albedo: true,
        position: true,
        uv: true,
        object_id: true,
        material_id: true,
        sample_count: true,
        variance: true,
    };
}

/// How much work goes into a picture. Any value of a field is valid unless it says otherwise.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderSettings {
    /// Size of the whole picture in pixels, at least 1.
    pub width: u32,
    /// Size of the whole picture in pixels, at least 1.
    pub height: u32,
    /// Only this part is rendered; pixels are the same as in the whole picture.
    pub region: Option<PixelRect>,
    /// Camera rays per pixel, at least 1; the least number where `noise` or `time` is set.
    pub samples: u32,
    /// Error relative to the brightness of a pixel, above 0, at which it has enough samples. All take `samples` if none is set.
    pub noise: Option<f32>,
    /// Radiance below which a pixel counts as bright as this when its noise is weighed, above 0: nobody sees the noise of black.
    pub noise_floor: f32,
    /// Seconds after which no further pass begins. The loop over passes keeps to it; what a pass adds does not depend on it.
    pub time: Option<f64>,
    /// The most samples per pixel where `noise` or `time` is set, at least `samples`; see [`Self::most_samples`].
    pub max_samples: Option<u32>,
    /// How radiance is found.
    pub integrator: IntegratorKind,
    /// Reconstruction filter.
    pub filter: Filter,
    /// Radius of the filter in pixels, above 0.
    pub filter_radius: f32,
    /// How the random numbers of pixels stand to each other.
    pub sampler: SamplerKind,
    /// Seed of all random numbers.
    pub seed: u64,
    /// Reflections and refractions in a row, at most.
    pub max_depth: u32,
    /// A branch whose product of weights falls below this is cut.
    pub min_weight: f32,
    /// Whether light passes through transparent things, coloured, on its straight way to a surface. Paths never let it pass
    /// straight through what refracts, and always through thin walls.
    pub transparent_shadows: bool,
    /// How long paths may be.
    pub depth_limits: DepthLimits,
    /// The most that one sample of indirect light may add to a channel of a pixel, above 0: less noise, and less light.
    pub clamp_indirect: Option<f32>,
    /// How light is found that a mirror or clear glass has thrown onto something matte.
    pub caustics: Caustics,
    /// Photons for each sample of the picture, from 1 to [`Self::MOST_PHOTONS`], where photons are asked for.
    pub caustic_photons: u32,
    /// How far around a point photons count at the first sample, in metres, above 0; by the size of what is clear and mirrors
    /// if `None`. It shrinks with the samples.
    pub caustic_radius: Option<f32>,
    /// Whether paths learn where light comes from.
    pub guiding: Guiding,
    /// Paths that are followed for practice, from 1 to [`Self::MOST_GUIDING_PATHS`], where guiding is asked for; a quarter of the camera
    /// rays of the picture, as far as `samples` says, if `None`.
    pub guiding_paths: Option<u32>,
    /// Which of many lights paths ask.
    pub light_choice: LightChoice,
    /// Rays per point of the `ambient_occlusion` integrator.
    pub ao_samples: u32,
    /// Length of those rays in metres; infinite sees the whole scene.
    pub ao_distance: f32,
    /// Whether images and checkers are averaged over what a ray stands for, as far as they ask for it; in points if not.
    pub mip_maps: bool,
    /// Extra layers.
    pub layers: Layers,
    /// Whether the background is left out of the alpha channel: alpha 0 and black where rays leave the scene.
    pub transparent_background: bool,
    /// Index of the camera in the scene.
    pub camera: usize,
    /// Threads; 0 for all.
    pub threads: usize,
}

impl Default for RenderSettings {
    fn default() -> Self {
        Self {
            width: 960,
            height: 540,
            region: None,
            samples: 16,
            noise: None,
            noise_floor: Self::NOISE_FLOOR,
            time: None,
            max_samples: None,
            integrator: IntegratorKind::Whitted,
            filter: Filter::BlackmanHarris,
            filter_radius: 1.5,
            sampler: SamplerKind::default(),
            seed: 0,
            max_depth: 12,
            min_weight: 1.0 / 512.0,
            transparent_shadows: false,
            depth_limits: DepthLimits::default(),
            clamp_indirect: None,
            caustics: Caustics::Paths,
            caustic_photons: Self::CAUSTIC_PHOTONS,
            caustic_radius: None,
            guiding: Guiding::None,
            guiding_paths: None,
            light_choice: LightChoice::Tree,
            ao_samples: 16,
            ao_distance: f32::INFINITY,
            mip_maps: true,
            layers: Layers::default(),
            transparent_background: false,
            camera: 0,
            threads: 0,
        }
    }
}

impl RenderSettings {
    /// A twentieth of white: relative noise is seen evenly well down to there, and ever less below.
    pub const NOISE_FLOOR: f32 = 0.05;

    /// Photons for each sample where nobody says otherwise.
    pub const CAUSTIC_PHOTONS: u32 = 100_000;

    /// The most photons for each sample: 2^24, about a gigabyte of them.
    pub const MOST_PHOTONS: u32 = 1 << 24;

    /// The most paths for practice: 2^28.
    pub const MOST_GUIDING_PATHS: u32 = 1 << 28;

    /// The most samples of a pixel where nobody says otherwise.
    pub const MAX_SAMPLES: u32 = 16_384;

    /// The most samples that a pixel takes: `samples`, or more where noise or time decides.
    pub fn most_samples(&self) -> u32 {
        if self.noise.is_none() && self.time.is_none() {
            return self.samples;
        }
        self.max_samples.unwrap_or(Self::MAX_SAMPLES).max(self.samples)
    }

    /// The pixels to render: the region, cut to the picture, or the whole picture.
    pub fn pixels(&self) -> PixelRect {
        let whole = PixelRect { x0: 0, y0: 0, x1: self.width, y1: self.height };
        self.region.map_or(whole, |r| PixelRect {
            x0: r.x0.min(self.width),
            y0: r.y0.min(self.height),
            x1: r.x1.min(self.width),
            y1: r.y1.min(self.height),
        })
    }
}
