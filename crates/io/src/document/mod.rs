//! TOML with places: every value knows where it was written.
//!
//! A text becomes a tree of [`Node`]s, the tree can be edited (`--set`, keyframes) and then read into typed
//! tables through serde. Whatever is wrong, on whichever of these ways, is a [`Fault`] with the span of the key
//! or value that is to blame, even when the value came from a keyframe or a flag. Nothing here knows what a scene
//! is.
//!
//! The `toml` crate parses; its own deserializer is not used, because its errors are finished sentences: the list
//! of allowed keys behind "did you mean", the value of an animated number and the origin of an override are lost
//! in them.

mod deserialize;
mod fault;
mod node;
mod path;
mod placed;
mod sources;

pub(crate) use fault::Fault;
pub(crate) use node::{Key, Node, Table, Value, parse_document, parse_value};
pub(crate) use path::{DottedPath, Segment};
pub use placed::Placed;
pub(crate) use placed::Span;
pub(crate) use sources::Sources;
