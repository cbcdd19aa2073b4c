//! For each key of the scene file two versions of its table that differ in that key alone.

mod picture;
mod things;

/// Table, key, and the lines of the table in two files.
pub(crate) type Flip = (&'static str, &'static str, &'static str, &'static str);

/// All of them.
pub(crate) fn flips() -> impl Iterator<Item = &'static Flip> {
    picture::FLIPS.iter().chain(things::FLIPS)
}
