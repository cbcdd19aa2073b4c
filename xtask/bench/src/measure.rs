//! Taking turns: each chunk of rays is traced by all, in rotating order, round after round. What counts is the time of the
//! processor, so that other programs on the machine cost no one a turn.

use crate::contestant::Contestant;
use crate::rays::RaySet;
use cpu_time::ThreadTime;

/// Rays that one traces before it is the next one's turn.
const CHUNK: usize = 8192;

/// What one made of a set of rays.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Score {
    /// Million rays per second: all rays over the sum of each chunk's median processor time.
    pub(crate) rate: f64,
    /// Rays with a hit.
    pub(crate) hits: usize,
}

/// Traces the rays through all, `rounds` times.
pub(crate) fn measure(all: &[Box<dyn Contestant>], set: &RaySet, rounds: usize) -> Vec<Score> {
    let mut distances = vec![0.0_f32; CHUNK];
    let mut seconds = vec![0.0; all.len()];
    let mut hits = vec![0; all.len()];
    for (number, chunk) in set.rays.chunks(CHUNK).enumerate() {
        let mut times = vec![Vec::with_capacity(rounds); all.len()];
        for round in 0..rounds {
            for turn in 0..all.len() {
                let who = (number + round + turn) % all.len();
                let to = &mut distances[..chunk.len()];
                let begin = ThreadTime::now();
                all[who].trace(set.query, chunk, to);
                times[who].push(begin.elapsed().as_secs_f64());
                if round == 0 {
                    hits[who] += to.iter().filter(|d| d.is_finite()).count();
                }
            }
        }
        for (sum, times) in seconds.iter_mut().zip(times) {
            *sum += median(times);
        }
    }
    let rate = |seconds: f64| set.rays.len() as f64 / seconds / 1e6;
    seconds.into_iter().zip(hits).map(|(s, hits)| Score { rate: rate(s), hits }).collect()
}

/// The middle of the sorted values.
pub(crate) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
