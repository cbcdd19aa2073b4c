//! The scene file from outside: what is read, what is refused and where, what moves.

#![expect(clippy::unwrap_used, clippy::expect_used, reason = "a test that cannot go on has failed")]

mod animation;
mod errors;
mod files;
mod flips;
mod groups;
mod keys;
mod manual;
mod motion;
mod overrides;
mod read;
mod schema;
mod support;
