//! A scene made ready to be rendered, pass by pass.

use crate::camera_ray::CameraRays;
use crate::check::check;
use crate::error::RenderError;
use crate::film::{Film, Keep};
use crate::filter::PixelFilter;
use crate::integrator::Integrator;
use crate::layers::{self, Raster};
use crate::meta::meta;
use crate::post_dof;
use crate::schedule::{self, Control, PassOutcome, Shooter};
use crate::stats::{RenderStats, timed};
use crate::world::World;
use heliostat_scene::settings::PixelRect;
use heliostat_scene::{Camera, Frame, RenderSettings, Scene};
use std::ops::Range;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Stack of a thread without recursion, and per reflection or refraction in a row.
const STACK: usize = 4 << 20;
const STACK_PER_DEPTH: usize = 16 << 10;

/// A scene made ready: its index, its lights, its camera and its threads.
///
pub struct Prepared<'s> {
    settings: RenderSettings,
    camera: &'s Camera,
    rays: CameraRays,
    filter: PixelFilter,
    world: World<'s>,
    integrator: Box<dyn Integrator + 's>,
    pool: rayon::ThreadPool,
    stats: Mutex<RenderStats>,
}

impl std::fmt::Debug for Prepared<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Prepared").field("settings", &self.settings).finish_non_exhaustive()
    }
}

impl<'s> Prepared<'s> {
    /// Makes `scene` ready to be rendered with an integrator of the caller.
    ///
    /// # Errors
    /// When a setting or the camera is out of its range, the film does not fit into memory, or the scene refers to something that
    /// it does not have.
    pub fn with_integrator(
        scene: &'s Scene,
        settings: &RenderSettings,
        integrator: Box<dyn Integrator + 's>,
    ) -> Result<Self, RenderError> {
        let camera = check(scene, settings)?;
        let rays = CameraRays::new(camera, settings.width, settings.height);
        let filter = PixelFilter::new(settings.filter, settings.filter_radius, settings.samples);
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(settings.threads)
            .stack_size(STACK + STACK_PER_DEPTH * settings.max_depth as usize)
            .thread_name(|i| format!("heliostat-{i}"))
            .build()?;
        let (world, seconds) = timed(|| pool.install(|| World::new(scene, settings)));
        let world = world?;
        let mut stats = RenderStats::default();
        stats.seconds.prepare = seconds;
        let settings = settings.clone();
        let stats = Mutex::new(stats);
        let prepared = Self { settings, camera, rays, filter, world, integrator, pool, stats };
        prepared.reserve()?;
        Ok(prepared)
    }

    /// An empty film for this picture.
    pub fn film(&self) -> Film {
        Film::new(self.film_window(), &self.filter, self.keep())
    }

    /// Adds the samples of the range to every pixel that does not hold them yet.
    ///
    /// Samples go in rising order: of a range that lies before what a tile holds, nothing is added. Ranges in a row give
    /// the same bits as one range over all of them.
    pub fn pass(&self, film: &mut Film, samples: Range<u32>, control: &Control<'_>) -> PassOutcome {
        let shooter = Shooter {
            world: &self.world,
            integrator: &*self.integrator,
            camera: &self.rays,
            filter: &self.filter,
            seed: self.settings.seed,
        };
        let ((outcome, tally), seconds) =
            timed(|| self.pool.install(|| schedule::run(&shooter, film, &samples, control)));
        let mut stats = self.lock_stats();
        stats.rays += tally.rays;
        stats.samples += tally.samples;
        stats.non_finite_samples += tally.non_finite;
        stats.seconds.trace += seconds;
        outcome
    }

    /// What the work took so far.
    pub fn stats(&self) -> RenderStats {
        self.lock_stats().clone()
    }

    /// The picture that the film holds now; good at any time, before, between and after passes.
    pub fn frame(&self, film: &Film) -> Frame {
        let (frame, seconds) = timed(|| self.pool.install(|| self.resolve(film)));
        self.lock_stats().seconds.resolve += seconds;
        frame
    }

    /// The scene made ready.
    pub fn world(&self) -> &World<'s> {
        &self.world
    }

    fn resolve(&self, film: &Film) -> Frame {
        let window = self.settings.pixels();
        let masses = film.masses();
        let mut rgba = Raster::of_film(film, [0.0; 4], |tile, i| tile.rgba(i, masses));
        if let Some(focus) = self.rays.post_focus() {
            let depth = Raster::of_film(film, 0.0, |tile, i| tile.nearest(i).depth);
            rgba = post_dof::blur(&rgba, &depth, &self.rays, focus, self.settings.height);
        }
        let mut channels: Vec<_> = layers::beauty(&rgba.crop(window)).collect();
        channels.extend(layers::extra(film, window, &self.settings.layers));
        Frame {
            width: self.settings.width,
            height: self.settings.height,
            window,
            channels,
            meta: meta(&self.settings, self.camera, &self.rays, film),
        }
    }

    /// The pixels of the frame, and around them those that a blur after rendering looks at.
    fn film_window(&self) -> PixelRect {
        let window = self.settings.pixels();
        if self.rays.post_focus().is_none() {
            return window;
        }
        let margin = post_dof::margin(self.settings.height);
        PixelRect {
            x0: window.x0.saturating_sub(margin),
            y0: window.y0.saturating_sub(margin),
            x1: window.x1.saturating_add(margin).min(self.settings.width),
            y1: window.y1.saturating_add(margin).min(self.settings.height),
        }
    }

    fn keep(&self) -> Keep {
        let layers = &self.settings.layers;
        Keep {
            albedo: layers.albedo,
            nearest: layers::keeps_nearest(layers) || self.rays.post_focus().is_some(),
        }
    }

    /// Asks the system once for all that film and frame will take, and gives it back.
    ///
    /// Later they are taken in many small pieces, of which none would be refused before the last.
    fn reserve(&self) -> Result<(), RenderError> {
        let window = self.film_window();
        let pixels = u64::from(window.width()) * u64::from(window.height());
        let channels = layers::channel_count(&self.settings.layers) as u64;
        let frame = pixels * (channels * size_of::<f32>() as u64 + size_of::<[f32; 4]>() as u64);
        let bytes = Film::bytes(pixels, &self.filter, self.keep()) + frame;
        let out_of_memory = || RenderError::OutOfMemory { bytes };
        let size = usize::try_from(bytes).map_err(|_| out_of_memory())?;
        Vec::<u8>::new().try_reserve_exact(size).map_err(|_| out_of_memory())
    }

    /// The statistics, even if a thread died while it held them: they are only counts.
    fn lock_stats(&self) -> MutexGuard<'_, RenderStats> {
        self.stats.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
