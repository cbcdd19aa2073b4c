//! How far a render is: a bar in a terminal, lines that farms parse elsewhere.
//!
//! Progress goes to standard error, results to standard output: `Saved: 'path'` and `Time: mm:ss.ss`, which Flamenco
//! and Afanasy read as they are. Lines hold no carriage return and no colour.

mod bar;
mod lines;
mod text;

pub(crate) use text::{bytes, clean};

use crate::args::ProgressMode;
use crate::{memory, out};
use bar::Bar;
use lines::{Lines, Style};
use std::io::IsTerminal;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Between two reports of the same frame, at least.
const INTERVAL: Duration = Duration::from_millis(200);

/// Tells how far a run of frames is. All methods take `&self`: tiles report from every thread.
#[derive(Debug)]
pub(crate) struct Progress {
    sink: Sink,
    started: Instant,
    frames: usize,
    current: Mutex<Current>,
    done: AtomicU64,
    rays: AtomicU64,
}

#[derive(Debug)]
enum Sink {
    Bar(Bar),
    Lines(Lines),
    Quiet,
}

/// The frame in work.
#[derive(Debug)]
struct Current {
    frame: i32,
    /// Frames before it in this run.
    index: usize,
    /// Camera rays of the whole frame.
    total: u64,
    begun: Instant,
    told: Instant,
}

/// What is to be told at one moment.
#[derive(Clone, Copy, Debug)]
struct Snapshot {
    frame: i32,
    /// Number of the frame in this run, from 1.
    number: usize,
    frames: usize,
    /// Of the whole run, in `[0, 1]`.
    fraction: f64,
    elapsed: Duration,
    remaining: Option<Duration>,
    rays_per_second: f64,
    memory: Option<u64>,
}

impl Progress {
    /// Progress over a run of `frames` frames.
    pub(crate) fn new(mode: ProgressMode, frames: usize) -> Self {
        let terminal = std::io::stderr().is_terminal();
        let sink = match mode {
            ProgressMode::None => Sink::Quiet,
            ProgressMode::Json => Sink::Lines(Lines::new(Style::Json)),
            ProgressMode::Alf => Sink::Lines(Lines::new(Style::Alf)),
            ProgressMode::Auto | ProgressMode::Bar if terminal => Sink::Bar(Bar::new()),
            ProgressMode::Auto | ProgressMode::Bar => Sink::Lines(Lines::new(Style::Plain)),
        };
        let now = Instant::now();
        let current = Current { frame: 0, index: 0, total: 0, begun: now, told: now };
        let zero = || AtomicU64::new(0);
        Self { sink, started: now, frames, current: Mutex::new(current), done: zero(), rays: zero() }
    }

    /// A frame begins, the first having `index` 0; the work before its first ray may take long.
    pub(crate) fn begin(&self, frame: i32, index: usize, activity: &str) {
        let now = Instant::now();
        *self.lock() = Current { frame, index, total: 0, begun: now, told: now };
        self.done.store(0, Ordering::Relaxed);
        self.rays.store(0, Ordering::Relaxed);
        match &self.sink {
            Sink::Bar(bar) => bar.begin(frame, index + 1, self.frames, activity),
            Sink::Lines(lines) => lines.begin(frame, index + 1, self.frames),
            Sink::Quiet => {}
        }
    }

    /// The rays of the frame begin: `total` camera rays in all.
    pub(crate) fn trace(&self, total: u64) {
        let mut current = self.lock();
        current.total = total;
        current.begun = Instant::now();
    }

    /// The frame is now expected to take `total` camera rays in all.
    pub(crate) fn aim(&self, total: u64) {
        self.lock().total = total;
    }

    /// So many camera rays of the frame are done, and so many rays of any kind. Threads may tell this out of order.
    pub(crate) fn reach(&self, samples: u64, rays: u64) {
        self.done.fetch_max(samples, Ordering::Relaxed);
        self.rays.fetch_max(rays, Ordering::Relaxed);
        // Whoever finds the lock taken has nothing newer to tell.
        let Ok(mut current) = self.current.try_lock() else { return };
        if current.told.elapsed() >= INTERVAL {
            current.told = Instant::now();
            self.tell(&self.snapshot(&current));
        }
    }

    /// The rays of the frame are done, or were stopped.
    pub(crate) fn end(&self) {
        let snapshot = self.snapshot(&self.lock());
        self.tell(&snapshot);
    }

    /// A file is there.
    pub(crate) fn saved(&self, path: &Path) {
        if let Sink::Lines(lines) = &self.sink {
            lines.saved(self.lock().frame, path);
        }
        self.result(&format!("Saved: '{}'", clean(&path.to_string_lossy())));
    }

    /// The frame is done; it took so long.
    pub(crate) fn time(&self, elapsed: Duration) {
        self.result(&format!("Time: {}", text::clock_hundredths(elapsed)));
    }

    /// A line of result, on standard output.
    pub(crate) fn result(&self, line: &str) {
        self.above(|| out::line(format_args!("{line}")));
    }

    /// Something that the user should know.
    pub(crate) fn warn(&self, message: &str) {
        match &self.sink {
            Sink::Lines(lines) if lines.is_json() => lines.warning(message),
            _ => self.above(|| out::note(format_args!("warning: {message}"))),
        }
    }

    /// Takes the bar away.
    pub(crate) fn finish(&self) {
        if let Sink::Bar(bar) = &self.sink {
            bar.finish();
        }
    }

    /// Prints while the bar is out of the way.
    fn above(&self, print: impl FnOnce()) {
        match &self.sink {
            Sink::Bar(bar) => bar.suspend(print),
            _ => print(),
        }
    }

    fn tell(&self, snapshot: &Snapshot) {
        match &self.sink {
            Sink::Bar(bar) => bar.tell(snapshot),
            Sink::Lines(lines) => lines.tell(snapshot),
            Sink::Quiet => {}
        }
    }

    fn snapshot(&self, current: &Current) -> Snapshot {
        let done = self.done.load(Ordering::Relaxed);
        let of_frame = if current.total == 0 { 0.0 } else { (done as f64 / current.total as f64).min(1.0) };
        let fraction = (current.index as f64 + of_frame) / self.frames.max(1) as f64;
        let elapsed = self.started.elapsed();
        let tracing = current.begun.elapsed().as_secs_f64();
        let rays = self.rays.load(Ordering::Relaxed) as f64;
        Snapshot {
            frame: current.frame,
            number: current.index + 1,
            frames: self.frames,
            fraction,
            elapsed,
            remaining: text::remaining(elapsed, fraction),
            rays_per_second: if tracing > 0.0 { rays / tracing } else { 0.0 },
            memory: memory::resident(),
        }
    }

    /// The state stays sound when a thread dies with the lock: it is numbers only.
    fn lock(&self) -> MutexGuard<'_, Current> {
        self.current.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
