//! A scene made ready to be rendered, pass by pass.

use crate::check::check;
use crate::counters::RayCounters;
use crate::error::RenderError;
use crate::film::Film;
use crate::guiding::{Course, Guide};
use crate::integrator::{self, Integrator};
use crate::photons;
use crate::plan::Plan;
use crate::sampler::Pattern;
use crate::schedule::{self, Control, PassOutcome, Shooter, Tally, TileDone};
use crate::stats::{RenderStats, timed};
use crate::world::{TreeCache, World};
use heliostat_scene::{Frame, RenderSettings, Scene};
use std::ops::Range;
use std::sync::atomic::Ordering;
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

/// Stack of a thread without recursion, and per reflection or refraction in a row.
const STACK: usize = 4 << 20;
const STACK_PER_DEPTH: usize = 16 << 10;

/// A scene made ready: its indices, its lights, its camera and its threads.
///
/// The loop over passes belongs to the caller, and with it previews, time limits and cancel:
///
/// ```
/// # use heliostat_render::{Control, Prepared, RenderError};
/// # use heliostat_scene::{RenderSettings, Scene};
/// # use std::sync::atomic::AtomicBool;
/// # fn preview(scene: &Scene, settings: &RenderSettings) -> Result<(), RenderError> {
/// let prepared = Prepared::new(scene, settings)?;
/// let mut film = prepared.film();
/// let cancel = AtomicBool::new(false);
/// let control = Control { cancel: &cancel, on_tile: &|tile| assert!(tile.done <= tile.total) };
/// for sample in 0..settings.samples {
///     prepared.pass(&mut film, sample..sample + 1, &control);
///     let preview = prepared.frame(&film);
///     assert_eq!(preview.width, settings.width);
/// }
/// # Ok(())
/// # }
/// ```
pub struct Prepared<'s> {
    plan: Plan<'s>,
    world: World<'s>,
    integrator: Box<dyn Integrator + 's>,
    /// What the integrator has learnt, once it has been asked.
    guide: OnceLock<Option<Guide>>,
    pool: rayon::ThreadPool,
    stats: Mutex<RenderStats>,
}

impl std::fmt::Debug for Prepared<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Prepared").field("settings", &self.plan.settings).finish_non_exhaustive()
    }
}

impl<'s> Prepared<'s> {
    /// Makes `scene` ready to be rendered with the integrator that the settings name.
    ///
    /// # Errors
    /// When a setting or the camera is out of its range, film and frame do not fit into memory, or the scene cannot be
    /// made ready (see [`crate::WorldError`]).
    pub fn new(scene: &'s Scene, settings: &RenderSettings) -> Result<Self, RenderError> {
        Self::with_cache(scene, settings, &mut TreeCache::default())
    }

    /// As [`Prepared::new`], with the trees of meshes that `cache` knows: frames of an animation share them.
    ///
    /// # Errors
    /// As [`Prepared::new`].
    pub fn with_cache(
        scene: &'s Scene,
        settings: &RenderSettings,
        cache: &mut TreeCache,
    ) -> Result<Self, RenderError> {
        Self::build(scene, settings, integrator::create(settings), cache)
    }

    /// Makes `scene` ready to be rendered with an integrator of the caller.
    ///
    /// # Errors
    /// As [`Prepared::new`].
    pub fn with_integrator(
        scene: &'s Scene,
        settings: &RenderSettings,
        integrator: Box<dyn Integrator + 's>,
    ) -> Result<Self, RenderError> {
        Self::build(scene, settings, integrator, &mut TreeCache::default())
    }

    fn build(
        scene: &'s Scene,
        settings: &RenderSettings,
        integrator: Box<dyn Integrator + 's>,
        cache: &mut TreeCache,
    ) -> Result<Self, RenderError> {
        let camera = check(scene, settings)?;
        let mut plan = Plan::new(scene, camera, settings);
        plan.reserve()?;
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(settings.threads)
            .stack_size(STACK + STACK_PER_DEPTH * settings.max_depth as usize)
            .thread_name(|i| format!("heliostat-{i}"))
            .build()?;
        let (world, seconds) = timed(|| pool.install(|| World::with_cache(scene, settings, cache)));
        let world = world?;
        // What is taken for a setting that was left out is to be recorded.
        plan.settings.caustic_radius =
            settings.caustic_radius.or_else(|| photons::first_radius(&world, settings));
        let stats = Mutex::new(RenderStats::prepared(&world, seconds));
        Ok(Self { plan, world, integrator, guide: OnceLock::new(), pool, stats })
    }

    /// An empty film for this picture.
    pub fn film(&self) -> Film {
        self.pool.install(|| self.plan.film())
    }

    /// Adds the samples of the range to every pixel that does not hold them yet, and wants more: where the settings ask for a noise,
    /// pixels end once they are below it (see [`Film::is_settled`]), after the same samples however the passes are cut.
    ///
    /// Samples go in rising order: what lies before the last sample that a tile holds is not added to it. Ranges in
    /// a row give the same bits as one range over all of them.
    ///
    /// # Panics
    /// When the film was made for a picture with other pixels or layers.
    pub fn pass(&self, film: &mut Film, samples: Range<u32>, control: &Control<'_>) -> PassOutcome {
        self.plan.assert_fits(film);
        let run = || {
            let (guide, rays) = self.learn(control);
            let led = guide.and_then(|guide| self.integrator.led(guide));
            let integrator = led.as_deref().unwrap_or(&*self.integrator);
            let (outcome, mut tally) = match integrator.samples_at_once() {
                None => schedule::run(&self.shooter(integrator), film, &samples, control),
                Some(most) => self.run_in_turns(integrator, film, &samples, most, control),
            };
            tally.rays += rays;
            (outcome, tally)
        };
        let ((outcome, tally), seconds) = timed(|| self.pool.install(run));
        self.lock_stats().add(&tally, seconds);
        outcome
    }

    /// What the integrator has learnt, and the rays that it took to learn it just now. Without it where the pass is cancelled, which
    /// then adds nothing.
    fn learn(&self, control: &Control<'_>) -> (Option<&Guide>, RayCounters) {
        if let Some(guide) = self.guide.get() {
            return (guide.as_ref(), RayCounters::default());
        }
        let size = [self.plan.settings.width, self.plan.settings.height];
        let course = Course { camera: &self.plan.rays, size, cancel: control.cancel };
        let learnt = self.integrator.learn(&self.world, &course);
        if learnt.is_none() && control.cancel.load(Ordering::Relaxed) {
            return (None, RayCounters::default());
        }
        let guide = self.guide.get_or_init(|| learnt).as_ref();
        (guide, guide.map(Guide::rays).unwrap_or_default())
    }

    /// Runs a pass by so many samples at a time, for which the integrator is made ready.
    fn run_in_turns(
        &self,
        integrator: &dyn Integrator,
        film: &mut Film,
        samples: &Range<u32>,
        most: u32,
        control: &Control<'_>,
    ) -> (PassOutcome, Tally) {
        let mut all = (PassOutcome { finished: true, samples: 0 }, Tally::default());
        let turns = samples.len().div_ceil(most as usize);
        for (turn, start) in samples.clone().step_by(most as usize).enumerate() {
            if film.is_settled() {
                break;
            }
            if control.cancel.load(Ordering::Relaxed) {
                return (PassOutcome { finished: false, ..all.0 }, all.1);
            }
            let range = start..samples.end.min(start.saturating_add(most));
            let ready = integrator.for_samples(&self.world, range.clone());
            let integrator = ready.as_deref().unwrap_or(integrator);
            let before = all.1.rays.total();
            let on_tile = |TileDone { done, total, rays }| {
                (control.on_tile)(TileDone {
                    done: turn * total + done,
                    total: turns * total,
                    rays: before + rays,
                });
            };
            let control = Control { on_tile: &on_tile, ..*control };
            let (outcome, tally) = schedule::run(&self.shooter(integrator), film, &range, &control);
            all.0.samples += outcome.samples;
            all.0.finished &= outcome.finished;
            all.1 += tally;
        }
        all
    }

    fn shooter<'a>(&'a self, integrator: &'a dyn Integrator) -> Shooter<'a> {
        Shooter {
            world: &self.world,
            integrator,
            camera: &self.plan.rays,
            filter: &self.plan.filter,
            pattern: Pattern::new(&self.plan.settings),
            rule: self.plan.rule(),
        }
    }

    /// The error of a pixel of the film relative to its brightness, as the root of the mean of the squares over all pixels; `None`
    /// where it is not known: neither `noise` nor the layer `variance` is asked for, or there are too few samples yet.
    pub fn error(&self, film: &Film) -> Option<f64> {
        self.pool.install(|| film.error(&self.plan.measure()))
    }

    /// The camera samples that the film will have taken at its end, as far as can be told now: by the noise that is asked for, or the
    /// most samples that a pixel may take.
    pub fn forecast(&self, film: &Film) -> f64 {
        let most = self.plan.settings.most_samples();
        match self.plan.rule() {
            Some(rule) => self.pool.install(|| film.forecast(&rule, most)),
            None => film.pixels() as f64 * f64::from(most),
        }
    }

    /// The picture that the film holds now; good at any time, before, between and after passes.
    ///
    /// # Panics
    /// When the film was made for a picture with other pixels or layers.
    pub fn frame(&self, film: &Film) -> Frame {
        self.plan.assert_fits(film);
        let (frame, seconds) = timed(|| self.pool.install(|| self.plan.resolve(film)));
        self.lock_stats().seconds.resolve += seconds;
        frame
    }

    /// What the work took so far.
    pub fn stats(&self) -> RenderStats {
        self.lock_stats().clone()
    }

    /// The scene made ready.
    pub fn world(&self) -> &World<'s> {
        &self.world
    }

    /// The statistics, even if a thread died while it held them: they are only counts.
    fn lock_stats(&self) -> MutexGuard<'_, RenderStats> {
        self.stats.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
