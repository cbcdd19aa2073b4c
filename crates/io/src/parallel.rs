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
    // Item by item in turn, so that heavy items that lie side by side are shared.
    let share = |first: usize| items.iter().skip(first).step_by(threads).map(&task).collect::<Vec<_>>();
    scope(|scope| {
        let workers: Vec<_> = (0..threads)
            .map(|first| {
                scope.spawn({
                    let share = &share;
                    move || share(first)
                })
            })
            .collect();
        let join =
            |worker: ScopedJoinHandle<'_, Vec<R>>| worker.join().unwrap_or_else(|panic| resume_unwind(panic));
        let mut shares: Vec<_> = workers.into_iter().map(|worker| join(worker).into_iter()).collect();
        (0..items.len()).filter_map(|i| shares[i % threads].next()).collect()
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
