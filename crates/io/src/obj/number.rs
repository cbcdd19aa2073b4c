//! Numbers in OBJ and MTL statements: finite, counted, with a message that names the word.

use super::text::{SourceText, Statement};
use crate::error::{LoadError, quote};

/// A finite number.
pub(super) fn finite(source: &SourceText<'_>, word: &str) -> Result<f32, LoadError> {
    let value: f32 = word.parse().map_err(|_| {
        let error = source.error(word, format!("{} is not a number", quote(word)));
        error.with_help(if word.contains(',') {
            "write the decimal point as `.`"
        } else {
            "write a number, as 0.5 or -1e-3"
        })
    })?;
    if value.is_finite() {
        return Ok(value);
    }
    Err(source
        .error(word, format!("{} is not a finite number", quote(word)))
        .with_help("values must be smaller than 3.4e38 in magnitude"))
}

/// The numbers of a statement into `into`; how many there were. `expected` says in words how many there may be.
pub(super) fn finite_list(
    source: &SourceText<'_>,
    statement: &Statement<'_>,
    counts: std::ops::RangeInclusive<usize>,
    expected: &str,
    into: &mut [f32],
) -> Result<usize, LoadError> {
    let mut count = 0;
    for word in statement.words() {
        if count == *counts.end() {
            let message = format!("`{}` has more than {} numbers", statement.keyword, counts.end());
            return Err(source.error(word, message).with_help(format!("expected {expected}")));
        }
        into[count] = finite(source, word)?;
        count += 1;
    }
    if count < *counts.start() {
        let have = if count == 1 { "1 number".to_owned() } else { format!("{count} numbers") };
        let message = format!("`{}` has only {have}", statement.keyword);
        return Err(source.error(statement.last_word(), message).with_help(format!("expected {expected}")));
    }
    Ok(count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn read(text: &str) -> Result<Vec<f32>, String> {
        let source = SourceText::decode(Path::new("a.obj"), text.as_bytes()).unwrap();
        let statement = source.statements().next().unwrap();
        let mut numbers = [0.0; 4];
        finite_list(&source, &statement, 2..=4, "2 to 4 numbers", &mut numbers)
            .map(|count| numbers[..count].to_vec())
            .map_err(|error| error.to_string())
    }

    #[test]
    fn numbers_are_read() {
        assert_eq!(read("v 1 -2.5e2 .5 +3.").unwrap(), [1.0, -250.0, 0.5, 3.0]);
    }

    #[test]
    fn what_is_no_finite_number_is_named_with_its_place() {
        assert_eq!(
            read("v 1 x").unwrap_err(),
            "a.obj:1:5: `x` is not a number; write a number, as 0.5 or -1e-3"
        );
        assert!(read("v 1 1,5").unwrap_err().ends_with("write the decimal point as `.`"));
        for word in ["nan", "inf", "-Infinity", "1e39"] {
            assert!(read(&format!("v 1 {word}")).unwrap_err().contains("is not a finite number"), "{word}");
        }
    }

    #[test]
    fn counts_are_checked() {
        assert_eq!(read("v 1").unwrap_err(), "a.obj:1:3: `v` has only 1 number; expected 2 to 4 numbers");
        assert_eq!(read("v").unwrap_err(), "a.obj:1:1: `v` has only 0 numbers; expected 2 to 4 numbers");
        assert!(read("v 1 2 3 4 5").unwrap_err().starts_with("a.obj:1:11: `v` has more than 4 numbers"));
    }
}
