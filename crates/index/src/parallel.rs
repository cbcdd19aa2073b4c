//! Two threads where feature `parallel` brings them, one otherwise; the results are the same.

/// Does both, at the same time where it can.
#[cfg(feature = "parallel")]
pub(crate) fn join<A: Send, B: Send>(a: impl FnOnce() -> A + Send, b: impl FnOnce() -> B + Send) -> (A, B) {
    rayon::join(a, b)
}

/// Does both.
#[cfg(not(feature = "parallel"))]
pub(crate) fn join<A, B>(a: impl FnOnce() -> A, b: impl FnOnce() -> B) -> (A, B) {
    (a(), b())
}

/// Maps `items` and joins the results, neighbours with neighbours, in order; `None` when there are no items.
#[cfg(feature = "parallel")]
pub(crate) fn map_reduce<T: Sync, R: Send>(
    items: &[T],
    map: impl Fn(&T) -> R + Send + Sync,
    reduce: impl Fn(R, R) -> R + Send + Sync,
) -> Option<R> {
    use rayon::prelude::{IntoParallelRefIterator, ParallelIterator};
    if let [only] = items {
        return Some(map(only));
    }
    items.par_iter().map(map).reduce_with(reduce)
}

/// Maps `items` and joins the results in order; `None` when there are no items.
#[cfg(not(feature = "parallel"))]
pub(crate) fn map_reduce<T, R>(items: &[T], map: impl Fn(&T) -> R, reduce: impl Fn(R, R) -> R) -> Option<R> {
    items.iter().map(map).reduce(reduce)
}

/// Maps `items`; the results are in order.
#[cfg(feature = "parallel")]
pub(crate) fn map_each<T: Send, R: Send>(items: Vec<T>, map: impl Fn(T) -> R + Send + Sync) -> Vec<R> {
    use rayon::prelude::{IntoParallelIterator, ParallelIterator};
    items.into_par_iter().map(map).collect()
}

/// Maps `items`, in order.
#[cfg(not(feature = "parallel"))]
pub(crate) fn map_each<T, R>(items: Vec<T>, map: impl Fn(T) -> R) -> Vec<R> {
    items.into_iter().map(map).collect()
}

/// Maps chunks of `items`; the results are in order.
#[cfg(feature = "parallel")]
pub(crate) fn map_chunks<T: Sync, R: Send>(
    items: &[T],
    chunk: usize,
    map: impl Fn(&[T]) -> R + Send + Sync,
) -> Vec<R> {
    use rayon::prelude::{IndexedParallelIterator, ParallelIterator, ParallelSlice};
    items.par_chunks(chunk).with_min_len(256).map(map).collect()
}

/// Maps chunks of `items`, in order.
#[cfg(not(feature = "parallel"))]
pub(crate) fn map_chunks<T, R>(items: &[T], chunk: usize, map: impl Fn(&[T]) -> R) -> Vec<R> {
    items.chunks(chunk).map(map).collect()
}

/// Maps the numbers below `count`; the results are in order.
#[cfg(feature = "parallel")]
pub(crate) fn map_numbers<R: Send>(count: usize, map: impl Fn(usize) -> R + Send + Sync) -> Vec<R> {
    use rayon::prelude::{IndexedParallelIterator, IntoParallelIterator, ParallelIterator};
    (0..count).into_par_iter().with_min_len(4096).map(map).collect()
}

/// Maps the numbers below `count`, in order.
#[cfg(not(feature = "parallel"))]
pub(crate) fn map_numbers<R>(count: usize, map: impl Fn(usize) -> R) -> Vec<R> {
    (0..count).map(map).collect()
}
