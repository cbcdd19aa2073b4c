//! `heliostat render`: frames of a scene into images, one after the other in one process, sharing assets and trees.

mod report;
mod save;
mod settings;
mod trace;

use crate::args::RenderArgs;
use crate::args::value::{FrameList, MOST_FRAMES};
use crate::denoise::Denoiser;
use crate::diagnose::Failure;
use crate::exit::Exit;
use crate::output::{Output, check_writable, outputs};
use crate::progress::Progress;
use crate::signals::Signals;
use crate::{open, progress};
use heliostat_io::png_file::{PngOptions, write_png};
use heliostat_io::{Shot, Source, Warning};
use heliostat_render::TreeCache;
use heliostat_scene::RenderSettings;
use heliostat_scene::settings::IntegratorKind;
use report::Report;
use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;
use std::time::Instant;
use trace::Traced;

/// Renders what the arguments ask for.
pub(crate) fn run(args: &RenderArgs) -> Result<Exit, Failure> {
    let started = Instant::now();
    let outputs = outputs(&args.output.outputs, &args.scene, args.picture.frames.is_some())?;
    // Hours of rendering must not end at a folder that is not there.
    let planned = outputs.iter().map(|output| output.path(0));
    planned.chain(args.run.stats.clone()).try_for_each(|path| check_writable(&path))?;
    let denoiser = args.output.denoise.then(|| Denoiser::find(args.output.oidn.as_deref())).transpose()?;
    let signals = Signals::install()?;
    let picture = &args.picture;
    let (camera, variant) = (picture.camera.as_deref(), picture.variant.as_deref());
    let source = open::source(&args.scene, &settings::overrides(args), camera, variant)?;
    let frames = frames(args, &source)?;
    let progress = Progress::new(args.run.progress, frames.len());
    let report = Report::new(&args.scene, args.run.threads.into(), started);
    let mut run = Run {
        args,
        outputs: &outputs,
        source: &source,
        signals: &signals,
        progress: &progress,
        denoiser,
        cache: TreeCache::default(),
        told: HashSet::new(),
        report,
    };
    let result = run.frames(&frames);
    progress.finish();
    let written = args.run.stats.as_ref().map(|path| run.report.write(path, signals.exit().is_some()));
    // Of two failures the first is the cause.
    let exit = result?;
    written.transpose()?;
    Ok(exit)
}

/// The frames to render, in order.
fn frames(args: &RenderArgs, source: &Source) -> Result<Vec<i32>, Failure> {
    match (&args.picture.frames, source.frames()) {
        (Some(FrameList::Some(frames)), _) => Ok(frames.clone()),
        (Some(FrameList::All), Some(range)) => {
            let count = u64::from(range.end().abs_diff(*range.start())) + 1;
            if count > MOST_FRAMES {
                let line =
                    format!("the scene has {count} frames; write at most {MOST_FRAMES}, as in --frames 1-48");
                return Err(Failure::usage(line));
            }
            Ok(range.collect())
        }
        (Some(FrameList::All), None) => Err(Failure::usage(
            "the scene has no frames of its own; write first_frame and last_frame under [time] in it, or --frames 1-48",
        )),
        (None, _) => Ok(vec![source.first_frame()]),
    }
}

/// What the frames of one run share.
struct Run<'a> {
    args: &'a RenderArgs,
    outputs: &'a [Output],
    source: &'a Source,
    signals: &'a Signals,
    progress: &'a Progress,
    denoiser: Option<Denoiser>,
    cache: TreeCache,
    /// Warnings that were told; every frame has them again.
    told: HashSet<String>,
    report: Report,
}

impl Run<'_> {
    fn frames(&mut self, frames: &[i32]) -> Result<Exit, Failure> {
        for (index, &frame) in frames.iter().enumerate() {
            let paths: Vec<PathBuf> = self.outputs.iter().map(|o| o.path(frame)).collect();
            if self.args.output.skip_existing && paths.iter().all(|path| path.is_file()) {
                let first = progress::clean(&paths[0].to_string_lossy());
                self.progress.result(&format!("skipping existing frame {frame}: '{first}'"));
                continue;
            }
            self.frame(frame, index)?;
            if let Some(exit) = self.signals.exit() {
                return Ok(exit);
            }
        }
        Ok(Exit::Done)
    }

    /// Loads, renders and saves one frame.
    fn frame(&mut self, frame: i32, index: usize) -> Result<(), Failure> {
        let start = Instant::now();
        self.progress.begin(frame, index, "loading");
        let mut shot = self.source.shot(frame)?;
        settings::apply(self.args, &mut shot)?;
        self.warn(&shot.warnings)?;
        let load_seconds = start.elapsed().as_secs_f64();

        let mut traced =
            trace::trace(&shot.scene, &shot.settings, &mut self.cache, self.progress, self.signals.stop())?;
        self.progress.end();
        if shot.settings.noise.is_some() || shot.settings.time.is_some() {
            self.progress.result(&traced.quality());
        }

        let save_start = Instant::now();
        let mut saved = Vec::new();
        if traced.is_empty() {
            self.progress.warn("stopped before the first sample: nothing is saved");
        } else {
            saved = self.save(&shot, &mut traced, frame)?;
        }
        let save_seconds = save_start.elapsed().as_secs_f64();
        self.report.add_textures(shot.scene.texture_bytes());
        self.report.add(frame, &traced, &saved, load_seconds, save_seconds);
        self.progress.time(start.elapsed());
        Ok(())
    }

    /// Writes all outputs of a frame and tells their names.
    fn save(&self, shot: &Shot, traced: &mut Traced, frame: i32) -> Result<Vec<PathBuf>, Failure> {
        if let Some(denoiser) = &self.denoiser {
            denoiser.apply(&mut traced.frame, shot.settings.threads)?;
        }
        let style = save::Style::new(&self.args.output, shot);
        style.prepare(&mut traced.frame);
        if self.source.frames().is_some() {
            save::stamp(&mut traced.frame, frame, self.source.frame_rate());
        }
        let mut saved = Vec::new();
        for output in self.outputs {
            let path = if traced.finished { output.path(frame) } else { output.unfinished(frame) };
            let notes = style.save(output.format, &path, &traced.frame)?;
            notes.iter().for_each(|note| self.progress.warn(note));
            self.progress.saved(&path);
            saved.push(path);
        }
        Ok(saved)
    }

    /// Tells each warning once; with `--strict` the first one ends the run.
    fn warn(&mut self, warnings: &[Warning]) -> Result<(), Failure> {
        for warning in warnings {
            let text = warning.to_string();
            if self.told.insert(text.clone()) {
                self.progress.warn(&text);
                self.report.warn(text);
            }
        }
        match warnings.first() {
            Some(first) if self.args.run.strict => Err(first.clone().into_error().into()),
            _ => Ok(()),
        }
    }
}

/// Renders the work of the index per pixel into a PNG.
pub(crate) fn heatmap(shot: &Shot, path: &Path) -> Result<(), Failure> {
    let settings = RenderSettings { integrator: IntegratorKind::Cost, ..shot.settings.clone() };
    let progress = Progress::new(crate::args::ProgressMode::Auto, 1);
    progress.begin(1, 0, "cost");
    let never = AtomicBool::new(false);
    let traced = trace::trace(&shot.scene, &settings, &mut TreeCache::default(), &progress, &never)?;
    progress.finish();
    write_png(path, &traced.frame, &PngOptions::default())?;
    Ok(())
}
