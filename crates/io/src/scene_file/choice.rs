//! Keys of which a table takes exactly one.

use crate::document::{Fault, Placed, Span};
use crate::error::quote;

/// A key that excludes others: its name, and where its value stands if it is there.
pub(super) type Choice = (&'static str, Option<Option<Span>>);

/// The choice `key` of an optional value.
pub(super) fn choice<T>(key: &'static str, value: Option<&Placed<T>>) -> Choice {
    (key, value.map(Placed::span))
}

/// Refuses a second one.
///
/// # Errors
/// At the second value that is there.
pub(super) fn at_most_one(choices: &[Choice]) -> Result<(), Fault> {
    let mut present = choices.iter().filter_map(|&(key, span)| span.map(|span| (key, span)));
    match (present.next(), present.next()) {
        (Some((first, _)), Some((second, span))) => {
            Err(Fault::new(format!("{} and {} exclude each other", quote(first), quote(second)))
                .with_help("remove one of them")
                .or_at(span))
        }
        _ => Ok(()),
    }
}

/// Refuses a second one and none; `owner` and `what` are the words for "... has no ...".
///
/// # Errors
/// At the second value, or at `table` when there is none.
pub(super) fn exactly_one(
    owner: &str,
    what: &str,
    table: Option<Span>,
    choices: &[Choice],
) -> Result<(), Fault> {
    at_most_one(choices)?;
    if choices.iter().any(|(_, span)| span.is_some()) {
        return Ok(());
    }
    let keys: Vec<_> = choices.iter().map(|(key, _)| quote(key)).collect();
    Err(Fault::new(format!("{owner} has no {what}"))
        .with_help(format!("add one of {}", keys.join(", ")))
        .or_at(table))
}

/// Refuses keys that would do nothing: `why` ends the sentence "... has no effect".
///
/// # Errors
/// At the first value that is there.
pub(super) fn without_effect(why: &str, choices: &[Choice]) -> Result<(), Fault> {
    match choices.iter().find_map(|&(key, span)| span.map(|span| (key, span))) {
        None => Ok(()),
        Some((key, span)) => Err(Fault::new(format!("{} has no effect {why}", quote(key)))
            .with_help(format!("remove {}", quote(key)))
            .or_at(span)),
    }
}
