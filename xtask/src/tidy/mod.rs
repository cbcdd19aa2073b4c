//! What the compiler does not check: who imports whom, sizes, headers, left-overs and links.

mod imports;
mod sources;

use crate::Outcome;
use crate::process::say;

/// Runs every check and lists all findings.
pub(crate) fn run() -> Outcome {
    let mut findings = imports::check()?;
    findings.extend(sources::check()?);
    for finding in &findings {
        say(finding);
    }
    match findings.len() {
        0 => {
            say("tidy: nothing found");
            Ok(())
        }
        n => Err(format!("tidy: {n} findings")),
    }
}
