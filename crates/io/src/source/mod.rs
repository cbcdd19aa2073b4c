//! Opening a scene: a `.toml` scene file, or a lone `.obj`, `.gltf` or `.glb`.
//!
//! A [`Source`] keeps the document and the files that it names; [`Source::shot`] evaluates it at a frame. Meshes
//! and images are read once and shared by all shots.

mod document;
mod lone_model;

use crate::document::Sources;
use crate::error::{LoadError, Warning};
use crate::file::read_file;
use crate::gltf::Contents;
use crate::scene_file::output::Output;
use crate::scene_file::time::TimeTable;
use crate::scene_file::{Assets, Built, FileAt, SceneFile, Trouble, build, camera_names};
use crate::view::View;
use document::Timeline;
use heliostat_scene::{RenderSettings, Scene};
use lone_model::LoneModel;
use std::ops::RangeInclusive;
use std::path::Path;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Longest scene file in bytes.
const MOST_BYTES: u64 = 64 << 20;

/// What the command line adds to a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct OpenOptions {
    /// Values that replace those of the file, as `--set PATH=VALUE`: a path as in [`crate::animation`], and a
    /// TOML value; a word without quotes is a text. They win over keyframes of the same value.
    pub overrides: Vec<(String, String)>,
    /// The name of the camera, as `--camera NAME`.
    pub camera: Option<String>,
    /// The name of the variant of a glTF model's materials, as `--variant NAME`.
    pub variant: Option<String>,
}

/// A scene that is open.
#[derive(Debug)]
pub struct Source {
    sources: Sources,
    timeline: Timeline,
    time: TimeTable,
    camera_names: Vec<String>,
    assets: Mutex<Assets>,
    /// The model, where the scene is one alone.
    model: Option<LoneModel>,
}

/// One frame: what to render, and how its picture is to be shown.
#[derive(Clone, Debug)]
pub struct Shot {
    /// What is there.
    pub scene: Scene,
    /// How much work goes into it.
    pub settings: RenderSettings,
    /// How it becomes a picture for the eye.
    pub view: View,
    /// How files of it want to be written.
    pub output: Output,
    /// What is not as the file wants it, such as missing textures.
    pub warnings: Vec<Warning>,
}

/// Opens a scene and checks it at its first frame. Of the files that it names none is read before the first shot.
///
/// # Errors
/// When the file cannot be read, or where it is wrong; errors in an override name the flag in place of the file.
///
/// ```no_run
/// # fn main() -> Result<(), heliostat_io::LoadError> {
/// let mut options = heliostat_io::OpenOptions::default();
/// options.overrides.push(("render.samples".into(), "4".into()));
/// let source = heliostat_io::open("scenes/minimal.toml".as_ref(), &options)?;
/// let shot = source.shot(source.first_frame())?;
/// assert_eq!(shot.settings.samples, 4);
/// # Ok(())
/// # }
/// ```
pub fn open(path: &Path, options: &OpenOptions) -> Result<Source, LoadError> {
    let is_model = LoneModel::is_at(path);
    let text = if is_model { String::new() } else { read_text(path)? };
    let mut sources = Sources::new(path, &text);
    let opened = Timeline::new(&text, &mut sources, options).and_then(|timeline| {
        let first = timeline.at(0.0)?;
        Ok((camera_names(&first)?, first.time, timeline))
    });
    let (camera_names, time, timeline) = opened.map_err(|fault| sources.error(&fault))?;
    let assets = Mutex::new(Assets::new(path.parent().unwrap_or(Path::new(""))));
    let mut source = Source { sources, timeline, time, camera_names, assets, model: None };
    if is_model {
        let model = LoneModel::open(path, &source.timeline, &mut source.assets(), options);
        let model = model.map_err(|trouble| source.error(trouble))?;
        source.camera_names = model.camera_names();
        source.model = Some(model);
    } else if options.variant.is_some() {
        return Err(LoadError::new(path, "has no variants").with_help("name a .gltf or .glb model"));
    }
    Ok(source)
}

fn read_text(path: &Path) -> Result<String, LoadError> {
    let bytes = read_file(path, MOST_BYTES)?;
    String::from_utf8(bytes).map_err(|error| {
        let good = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + good.iter().filter(|&&byte| byte == b'\n').count();
        LoadError::new(path, format!("line {line} is not UTF-8")).with_help("save the file as UTF-8")
    })
}

impl Source {
    /// The scene at a frame, with the movement while the shutter is open.
    ///
    /// Frames outside [`Source::frames`] show the values of the nearest key.
    ///
    /// # Errors
    /// Where the file contradicts itself at that time, and those of the files that it names.
    pub fn shot(&self, frame: i32) -> Result<Shot, LoadError> {
        self.try_shot(self.time.seconds(frame)).map_err(|trouble| self.error(trouble))
    }

    fn try_shot(&self, seconds: f64) -> Result<Shot, Trouble> {
        let file = self.timeline.at(seconds)?;
        let (built, usual_exposure) = match &self.model {
            Some(model) => model.build(&file, seconds, self.time.exposure())?,
            None => (self.build(&file, seconds)?, 0.0),
        };
        Ok(Shot {
            scene: built.scene,
            settings: built.settings,
            view: file.output.view(usual_exposure),
            output: file.output.output(),
            warnings: built.warnings,
        })
    }

    fn build(&self, file: &SceneFile, seconds: f64) -> Result<Built, Trouble> {
        let exposure = self.time.exposure();
        // The shutter is open around the moment of the frame.
        let over_shutter: FileAt<'_> = &|share| self.timeline.at(seconds + (share - 0.5) * exposure);
        let moves = exposure > 0.0 && self.timeline.moves();
        build(file, moves.then_some(over_shutter), &mut self.assets(), &self.sources)
    }

    fn assets(&self) -> MutexGuard<'_, Assets> {
        // A panic while the lock was held leaves at worst a file unread.
        self.assets.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn error(&self, trouble: Trouble) -> LoadError {
        match trouble {
            Trouble::Here(fault) => self.sources.error(&fault),
            Trouble::Elsewhere(error) => error,
        }
    }

    /// The frames of an animation; `None` for a single picture.
    pub fn frames(&self) -> Option<RangeInclusive<i32>> {
        let of_model = self.model.as_ref().and_then(LoneModel::last_key);
        self.time.frames(self.timeline.last_key().or(of_model))
    }

    /// The number of the first frame.
    pub fn first_frame(&self) -> i32 {
        self.time.first_frame()
    }

    /// Frames per second.
    pub fn frame_rate(&self) -> f64 {
        self.time.frame_rate()
    }

    /// What the file holds, shown or not, when it is a glTF model.
    pub fn contents(&self) -> Option<Contents> {
        self.model.as_ref()?.contents()
    }

    /// The names of the cameras, in the order of the scene.
    pub fn camera_names(&self) -> &[String] {
        &self.camera_names
    }
}
