//! The practice of paths, turn by turn.

use super::growth::Growth;
use super::trail::{Record, Trail};
use super::{Guide, GuidingSettings, Lobe};
use crate::camera_ray::CameraRays;
use crate::counters::RayCounters;
use crate::integrator::CameraRay;
use crate::sampler::{Sampler, branch};
use glam::{DVec2, Vec3};
use heliostat_scene::Rgb;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

/// Turns; each has twice the paths of the one before.
const TURNS: u32 = 7;
/// Paths that are followed before what they found is laid down; no more is held at once.
const BATCH: u32 = 1 << 15;
/// Paths that are followed in a row by one thread.
const ROW: u32 = 512;
/// Places of a turn that say where leaves are to be cut.
const MOST_PLACES: usize = 1 << 20;

/// The picture that paths practise for.
#[derive(Clone, Copy)]
pub struct Course<'a> {
    pub(crate) camera: &'a CameraRays,
    /// Columns and rows of the whole picture, whatever is rendered of it.
    pub(crate) size: [u32; 2],
    /// Once true, practice ends.
    pub(crate) cancel: &'a AtomicBool,
}

impl std::fmt::Debug for Course<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Course").field("size", &self.size).finish_non_exhaustive()
    }
}

/// Follows a path along a camera ray, led by a guide; what it found, and what it leaves behind.
type Follow<'a> = dyn Fn(&CameraRay, &mut Sampler, &Guide, &mut RayCounters) -> (Rgb, Trail) + Sync + 'a;

/// A turn of practice.
struct Turn<'a> {
    index: u32,
    seed: u64,
    course: &'a Course<'a>,
    guide: &'a Guide,
    follow: &'a Follow<'a>,
}

/// What a turn has found.
struct Found {
    /// By leaves.
    growths: Vec<Growth>,
    /// Where light was scattered first of all.
    places: Vec<Vec3>,
    /// How often it was in all.
    count: usize,
    rays: RayCounters,
}

/// What paths learn of a scene; `None` if it was cancelled.
pub(crate) fn learn(settings: GuidingSettings, course: &Course<'_>, follow: &Follow<'_>) -> Option<Guide> {
    let mut guide = Guide::new();
    let mut growths = vec![Growth::new()];
    let unit = (settings.paths >> TURNS).max(1);
    for index in 0..TURNS {
        let turn = Turn { index, seed: settings.seed, course, guide: &guide, follow };
        let found = turn.run(unit << index, growths)?;
        guide.rays += found.rays;
        guide.lobes = found.growths.par_iter().map(Lobe::learnt).collect();
        if index + 1 == TURNS {
            break;
        }
        growths = divide(&mut guide, &found);
    }
    Some(guide)
}

/// Cuts leaves that have found light often, so that in the next turn each will find it as often as there are leaves; and the squares of their trees over directions: growths for the next turn.
fn divide(guide: &mut Guide, found: &Found) -> Vec<Growth> {
    let share = found.places.len() as f64 / found.count.max(1) as f64;
    let records = (2.0 * found.count as f64).sqrt();
    let most = (0.5 * records * share).ceil() as usize;
    let origins = guide.places.divide(&found.places, most);
    let refined: Vec<_> = found.growths.par_iter().map(Growth::refined).collect();
    guide.lobes = origins.iter().map(|&origin| guide.lobes[origin as usize].clone()).collect();
    origins.iter().map(|&origin| refined[origin as usize].clone()).collect()
}

impl Lobe {
    fn learnt(growth: &Growth) -> Self {
        Self { directions: growth.directions(), own: growth.own() }
    }
}

impl Turn<'_> {
    /// Follows so many paths, and lays down what they find. `None` if it was cancelled.
    fn run(&self, paths: u32, growths: Vec<Growth>) -> Option<Found> {
        let mut found = Found { growths, places: Vec::new(), count: 0, rays: RayCounters::default() };
        for start in (0..paths).step_by(BATCH as usize) {
            if self.course.cancel.load(Ordering::Relaxed) {
                return None;
            }
            let (mut records, rays) = self.batch(start..paths.min(start + BATCH));
            found.rays += rays;
            found.count += records.len();
            let room = MOST_PLACES - found.places.len();
            found.places.extend(records.iter().take(room).map(|record| record.p));
            // The sort is stable: each leaf sees its records in the order of the paths.
            records.par_sort_by_key(|record| record.leaf);
            let add = |(leaf, growth): (usize, &mut Growth)| {
                let start = records.partition_point(|record| (record.leaf as usize) < leaf);
                let own = records[start..].iter().take_while(|record| record.leaf as usize == leaf);
                own.for_each(|record| growth.add(record));
            };
            found.growths.par_iter_mut().enumerate().for_each(add);
        }
        Some(found)
    }

    /// What a range of paths finds, in their order.
    fn batch(&self, paths: Range<u32>) -> (Vec<Record>, RayCounters) {
        let row = |start: u32| {
            let (mut records, mut rays) = (Vec::new(), RayCounters::default());
            (start..paths.end.min(start + ROW)).for_each(|path| self.path(path, &mut records, &mut rays));
            (records, rays)
        };
        let starts: Vec<_> = paths.clone().step_by(ROW as usize).collect();
        let rows: Vec<_> = starts.into_par_iter().map(row).collect();
        let mut all = (Vec::new(), RayCounters::default());
        for (records, rays) in rows {
            all.0.extend(records);
            all.1 += rays;
        }
        all
    }

    /// Follows one path.
    fn path(&self, path: u32, records: &mut Vec<Record>, rays: &mut RayCounters) {
        let sampler = Sampler::of_practice(self.seed, self.index, path);
        let [width, height] = self.course.size;
        let place =
            sampler.fork(branch::POSITIVE).next_2d().as_dvec2() * DVec2::new(width.into(), height.into());
        let mut draws = sampler.fork(branch::CAMERA);
        let Some(ray) = self.course.camera.ray(place, draws.next_2d(), draws.next_1d()) else { return };
        rays.camera += 1;
        let mut draws = sampler.fork(branch::INTEGRATOR);
        let (found, trail) = (self.follow)(&ray, &mut draws, self.guide, rays);
        let leaf = |record: Record| Record { leaf: self.guide.places.leaf(record.p), ..record };
        records.extend(trail.records(found).map(leaf));
    }
}
