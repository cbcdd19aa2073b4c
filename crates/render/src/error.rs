//! Why a render cannot start. Once it runs, nothing fails.

use crate::filter::MAX_RADIUS;
use crate::world::WorldError;
use heliostat_scene::settings::PixelRect;
use heliostat_scene::validate::SceneIssue;
use thiserror::Error;

/// Most pixels of a picture.
pub(crate) const MAX_PIXELS: u64 = 1 << 31;

/// Most reflections and refractions in a row: each takes stack.
pub(crate) const MAX_DEPTH: u32 = 4096;

/// Why a render cannot start. Each message says what is allowed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RenderError {
    /// A side of the picture is 0.
    #[error("the picture is {width} x {height} pixels; both sides must be at least 1")]
    EmptyPicture {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// The picture is too large.
    #[error("the picture is {width} x {height} pixels; at most {MAX_PIXELS} pixels are possible")]
    TooManyPixels {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// The region and the picture have no pixel in common.
    #[error(
        "the region {},{} to {},{} holds no pixel of the picture of {width} x {height}; give x0 < x1 and y0 < y1 inside it",
        .region.x0, .region.y0, .region.x1, .region.y1
    )]
    EmptyRegion {
        /// The region.
        region: PixelRect,
        /// Columns of the picture.
        width: u32,
        /// Rows of the picture.
        height: u32,
    },
    /// No samples.
    #[error("0 samples per pixel; at least 1 is needed")]
    NoSamples,
    /// An end by noise is asked for where there is none.
    #[error("noise is asked for and the integrator has none; leave it out, or choose `path`")]
    NoNoise,
    /// More samples are asked for than may be taken.
    #[error("samples is {samples} and max_samples {most}; max_samples must not be less")]
    MaxSamples {
        /// The least number.
        samples: u32,
        /// The most.
        most: u32,
    },
    /// The most samples are set where nothing asks for more than the least.
    #[error("max_samples does nothing without noise or time; set one of them, or samples")]
    UselessMaxSamples,
    /// Photons are asked for, of an integrator that has none.
    #[error(
        "caustics are asked of photons, which the integrator does not know; choose `path`, or caustics by `paths`"
    )]
    PhotonsNeedPath,
    /// Guiding is asked for, of an integrator that learns nothing.
    #[error("guiding is asked for, which the integrator does not know; choose `path`, or guiding = `none`")]
    GuidingNeedsPath,
    /// The radius of the filter is out of range.
    #[error("the filter radius is {0} pixels; it must be above 0 and at most {MAX_RADIUS}")]
    FilterRadius(f32),
    /// The recursion is too deep.
    #[error("max_depth is {0}; at most {MAX_DEPTH} is possible")]
    TooDeep(u32),
    /// A setting is not what it must be.
    #[error("{name} is {value}; it must be {range}")]
    Setting {
        /// Name of the setting.
        name: &'static str,
        /// What it is.
        value: f32,
        /// What it must be.
        range: &'static str,
    },
    /// There is no such camera.
    #[error("camera {index} is asked for and the scene has {count}, counted from 0")]
    NoCamera {
        /// Index that was asked for.
        index: usize,
        /// Cameras in the scene.
        count: usize,
    },
    /// Something in the scene means nothing: all that was found.
    #[error("{}", summary(.0))]
    Scene(Vec<SceneIssue>),
    /// The system does not have the memory for the film.
    #[error("a film of {} MiB does not fit into memory; render fewer pixels, a region at a time, or fewer layers", .bytes >> 20)]
    OutOfMemory {
        /// Bytes that were asked for.
        bytes: u64,
    },
    /// Threads could not be started.
    #[error("the threads could not be started: {0}; ask for fewer")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// The scene could not be made ready.
    #[error(transparent)]
    World(#[from] WorldError),
}

/// The first issue, and how many there are besides.
pub(crate) fn summary(issues: &[SceneIssue]) -> String {
    let first = issues.first().map(ToString::to_string).unwrap_or_default();
    match issues.len() {
        0 | 1 => first,
        2 => format!("{first} (and one more)"),
        n => format!("{first} (and {} more)", n - 1),
    }
}
