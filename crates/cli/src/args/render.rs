//! `heliostat render`.

use super::value::{self, FrameList, Size};
use super::view::ViewName;
use clap::{Args, ValueEnum};
use heliostat_scene::settings::PixelRect;
use std::path::PathBuf;

const AFTER_HELP: &str = "\
A flag wins over the scene file. The picture of a region has the same pixels as the whole one has there.

Examples:
  heliostat render scene.toml                              into scene.png, in the current folder
  heliostat render scene.toml -o a.exr -o a.png --aov all  all layers, and a picture
  heliostat render scene.toml --size 1920x1080 --samples 256 --view agx
  heliostat render scene.toml --frames 1-48 -o shot.####.exr --skip-existing
  heliostat render scene.toml --set object.ball.translate.1=2.5 --set material.glass.phong.ior=1.33
  heliostat render scene.toml --samples 32 --denoise
  heliostat render scene.toml --noise 0.02 --max-samples 4096 --aov sample_count,variance -o a.exr
  heliostat render scene.toml --time 5m                    as many samples as fit into five minutes
  heliostat render scene.toml --progress json --stats stats.json

Ctrl-C stops at the next tile and saves the picture with the samples so far (exit code 130), a numbered frame under
NAME.0007.partial.exr so that nobody takes it for whole; a second Ctrl-C ends at once.";

/// Render a scene or a model into images
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub(crate) struct RenderArgs {
    /// A scene (.toml) or a model (.obj, .gltf, .glb)
    pub(crate) scene: PathBuf,

    #[command(flatten)]
    pub(crate) output: OutputArgs,

    #[command(flatten)]
    pub(crate) picture: PictureArgs,

    #[command(flatten)]
    pub(crate) run: RunArgs,
}

/// Where pictures go and in which form.
#[derive(Debug, Args)]
#[command(next_help_heading = "Output")]
pub(crate) struct OutputArgs {
    /// Image to write: .exr (all layers) or .png; `####` or `%04d` is the frame number; repeatable
    /// [default: the name of the scene with .png, in the current folder]
    #[arg(short, long = "output", value_name = "OUT")]
    pub(crate) outputs: Vec<PathBuf>,

    /// View transform of PNG [default: the scene's, else standard]
    #[arg(long, value_enum, value_name = "NAME")]
    pub(crate) view: Option<ViewName>,

    /// Brightness of PNG in stops: +1 doubles the light; EXR stays as it is [default: the scene's, else 0]
    #[arg(long, value_name = "STOPS", value_parser = value::finite, allow_hyphen_values = true)]
    pub(crate) exposure: Option<f32>,

    /// Bits per channel of PNG [default: the scene's, else 8]
    #[arg(long, value_name = "8|16", value_parser = value::bits)]
    pub(crate) png_bits: Option<u8>,

    /// How EXR stores colours; data layers are always float [default: the scene's, else half]
    #[arg(long, value_enum, value_name = "TYPE")]
    pub(crate) exr_depth: Option<ExrDepth>,

    /// Compression of EXR, all without loss
    #[arg(long, value_enum, value_name = "NAME", default_value_t = Compression::Zip)]
    pub(crate) compression: Compression,

    /// Leave out frames whose images are all there; a finished image is always whole
    #[arg(long)]
    pub(crate) skip_existing: bool,

    /// Take the noise out with Open Image Denoise; the noisy picture stays in EXR as the layer `noisy`, beside the layers
    /// albedo and N that help
    #[arg(long)]
    pub(crate) denoise: bool,

    /// The library Open Image Denoise, or its folder [default: `HELIOSTAT_OIDN`, else the system's]
    #[arg(long, value_name = "LIB", requires = "denoise")]
    pub(crate) oidn: Option<PathBuf>,
}

/// What is rendered, and how much work goes into it.
#[derive(Debug, Args)]
#[command(next_help_heading = "Picture")]
pub(crate) struct PictureArgs {
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", value_parser = value::size)]
    pub(crate) size: Option<Size>,

    /// Camera rays per pixel; the least number where noise or time is set
    #[arg(short, long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_048_576))]
    pub(crate) samples: Option<u32>,

    /// Error of a pixel relative to its brightness, as 0.01, at which it has enough samples
    #[arg(long, value_name = "X", value_parser = value::positive, allow_hyphen_values = true)]
    pub(crate) noise: Option<f32>,

    /// Time after which each frame ends with the pass that it is in: 90, 90s, 5m or 2h; takes as many samples as fit into it
    #[arg(long, value_name = "TIME", value_parser = value::duration, allow_hyphen_values = true)]
    pub(crate) time: Option<f64>,

    /// The most camera rays per pixel where noise or time is set [default: the scene's, else 16384]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_048_576))]
    pub(crate) max_samples: Option<u32>,

    /// Render this part only: left, top, right and bottom in pixels, the last two exclusive
    #[arg(long, value_name = "X0,Y0,X1,Y1", value_parser = value::region)]
    pub(crate) region: Option<PixelRect>,

    /// Camera by name [default: the scene's]
    #[arg(long, value_name = "NAME")]
    pub(crate) camera: Option<String>,

    /// Render this variant of a glTF model's materials (`heliostat info` lists them)
    #[arg(long, value_name = "NAME")]
    pub(crate) variant: Option<String>,

    /// Frames: `1-48`, every second with `1-48x2`, lists as `1,5,10-20`, or `all` of the scene's
    /// [default: the scene's first frame]
    #[arg(short, long, value_name = "LIST", value_parser = value::frames, allow_hyphen_values = true)]
    pub(crate) frames: Option<FrameList>,

    /// How light is found along a ray [default: the scene's]
    #[arg(long, value_enum, value_name = "NAME")]
    pub(crate) integrator: Option<Integrator>,

    /// Layers beside the colours, with commas between them, as in `depth,normal`
    #[arg(long, value_enum, value_name = "LIST", value_delimiter = ',')]
    pub(crate) aov: Vec<Layer>,

    /// Seed of the random numbers
    #[arg(long, value_name = "N")]
    pub(crate) seed: Option<u64>,

    /// Replace a value of the scene file; the value is TOML, or a bare word for text; repeatable
    #[arg(long = "set", value_name = "PATH=VALUE", value_parser = value::assignment)]
    pub(crate) set: Vec<(String, String)>,
}

/// How the work is done and told.
#[derive(Debug, Args)]
#[command(next_help_heading = "Run")]
pub(crate) struct RunArgs {
    /// Threads; 0 is one per processor. The picture does not depend on it
    #[arg(short = 'j', long, value_name = "N", value_parser = clap::value_parser!(u16).range(0..=1024), default_value_t = 0)]
    pub(crate) threads: u16,

    /// Warnings, such as a missing texture, count as errors (exit code 3)
    #[arg(long)]
    pub(crate) strict: bool,

    /// How progress is told, on standard error
    #[arg(long, value_enum, value_name = "HOW", default_value_t = ProgressMode::Auto)]
    pub(crate) progress: ProgressMode,

    /// Write statistics as JSON: times by phase, rays by kind, index, memory
    #[arg(long, value_name = "FILE")]
    pub(crate) stats: Option<PathBuf>,
}

/// How progress is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ProgressMode {
    /// A bar in a terminal, plain lines elsewhere
    Auto,
    /// A bar with elapsed and remaining time, rays per second and memory
    Bar,
    /// One JSON object per line
    Json,
    /// Lines `ALF_PROGRESS 42%`, which render farms read
    Alf,
    /// Nothing
    None,
}

/// The integrators by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Integrator {
    /// Phong's local light, shadows, mirrors and glass
    Whitted,
    /// Shading normals as colours
    Normals,
    /// Distance from the camera, near is white
    Depth,
    /// Surface parameters as colours
    Uv,
    /// Openness to the sky
    #[value(name = "ambient_occlusion", alias = "ambient-occlusion", alias = "ao")]
    AmbientOcclusion,
    /// Work in the spatial index, as a heat map
    Cost,
    /// Light that comes straight from the lights, physically based
    Direct,
    /// All light, found by the scattering of surfaces alone: slow, to hold `path` against
    #[value(name = "path_simple", alias = "path-simple")]
    PathSimple,
    /// All light, physically based; media are not seen
    Path,
    /// All light, that in media and below surfaces with it
    #[value(name = "volpath")]
    VolPath,
}

/// Types of colour channels in EXR.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ExrDepth {
    /// 16 bits: enough for colours
    Half,
    /// 32 bits
    Float,
}

/// Lossless compressions of EXR.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Compression {
    /// None: large and fast
    None,
    /// Deflate, line by line
    Zips,
    /// Deflate, 16 lines at once
    Zip,
    /// Wavelets: good for noise
    Piz,
}

/// Extra layers by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
pub(crate) enum Layer {
    /// All of them
    All,
    /// Z: perpendicular distance from the camera
    Depth,
    /// N: shading normal in world space
    Normal,
    /// Colour of the surface under white light
    Albedo,
    /// P: position in world space
    Position,
    /// Surface parameters
    Uv,
    /// Number of the object, from 1
    ObjectId,
    /// Number of the material, from 1
    MaterialId,
    /// Samples of the pixel
    SampleCount,
    /// Estimated square of the pixel's error
    Variance,
}
