//! A last wall against decoders of other authors that panic on damaged files.

use super::Refusal;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// The result of `decode`, or an error when it panics.
///
/// None of the decoders is known to panic on input that passes the checks before them; a texture of a stranger must
/// not end a render if one does.
pub(crate) fn shield<T>(decode: impl FnOnce() -> Result<T, Refusal>) -> Result<T, Refusal> {
    // Whatever the closure leaves half done is dropped with it.
    catch_unwind(AssertUnwindSafe(decode)).unwrap_or_else(|_| Err("is damaged: the decoder gave up".into()))
}
