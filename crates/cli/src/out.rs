//! The only place that writes to the terminal: whole lines, flushed, and deaf to a closed pipe.
//!
//! `println!` panics when the reader of the pipe has gone, as `heliostat schema | head -1` does to it; here a closed
//! pipe ends the output and nothing else, so that a render whose log reader died still saves its picture.

use std::fmt::Arguments;
use std::io::{self, Write};

/// Writes one line to standard output.
pub(crate) fn line(text: Arguments<'_>) {
    write_line(&mut io::stdout().lock(), text);
}

/// Writes bytes to standard output as they are.
pub(crate) fn bytes(bytes: &[u8]) {
    let mut out = io::stdout().lock();
    ignore(out.write_all(bytes).and_then(|()| out.flush()));
}

/// Writes one line to standard error.
pub(crate) fn note(text: Arguments<'_>) {
    write_line(&mut io::stderr().lock(), text);
}

/// One write per line, so that lines of several processes that share a log do not mix.
fn write_line(to: &mut impl Write, text: Arguments<'_>) {
    let line = format!("{text}\n");
    ignore(to.write_all(line.as_bytes()).and_then(|()| to.flush()));
}

/// Nobody is left to tell when the terminal is gone.
fn ignore(_: io::Result<()>) {}

#[cfg(test)]
mod tests {
    use super::*;

    struct ClosedPipe;

    impl Write for ClosedPipe {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(io::ErrorKind::BrokenPipe.into())
        }

        fn flush(&mut self) -> io::Result<()> {
            Err(io::ErrorKind::BrokenPipe.into())
        }
    }

    #[test]
    fn closed_pipe_is_silent() {
        write_line(&mut ClosedPipe, format_args!("nobody reads this"));
    }

    #[test]
    fn a_line_is_one_write() {
        let mut text = Vec::new();
        write_line(&mut text, format_args!("{} {}", 1, 2));
        assert_eq!(text, b"1 2\n");
    }
}
