//! Work on several threads with a result that does not depend on their number.

use std::num::NonZeroUsize;
use std::panic::resume_unwind;
use std::thread::{ScopedJoinHandle, available_parallelism, scope};

/// The threads to use where `wanted` are asked for: all for 0.
pub(crate) fn threads(wanted: usize) -> usize {
    if wanted == 0 { available_parallelism().map_or(1, NonZeroUsize::get) } else { wanted }
}

/// `task` for every item, by `wanted` threads, in the order of the items.
pub(crate) fn map_in_order<T: Sync, R: Send>(
    items: &[T],
    wanted: usize,
    task: impl Fn(&T) -> R + Sync,
) -> Vec<R> {
    let threads = threads(wanted).min(items.len());
    if threads <= 1 {
        return items.iter().map(task).collect();
    }
    let share = |items: &[T]| items.iter().map(&task).collect::<Vec<_>>();
    scope(|scope| {
        let shares = items.chunks(items.len().div_ceil(threads));
        let workers: Vec<_> = shares.map(|items| scope.spawn(|| share(items))).collect();
        let join =
            |worker: ScopedJoinHandle<'_, Vec<R>>| worker.join().unwrap_or_else(|panic| resume_unwind(panic));
        workers.into_iter().flat_map(join).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_order_is_that_of_the_items() {
        let items: Vec<u32> = (0..101).collect();
        for threads in [0, 1, 2, 7, 500] {
            assert!(map_in_order(&items, threads, |i| i * 3).into_iter().eq((0..101).map(|i| i * 3)));
        }
        assert!(map_in_order(&[0; 0], 4, |i| *i).is_empty());
    }
}
