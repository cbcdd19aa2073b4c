//! Everything a change must pass, in the order in which it fails fastest.

use crate::process::{cargo, run as execute, say};
use crate::{Outcome, assets, tidy};

/// Runs every check; the tests come last, so that their closing line ends the output.
pub(crate) fn run(deep: bool) -> Outcome {
    execute(cargo(&["fmt", "--all", "--check"]))?;
    execute(cargo(&["clippy", "--workspace", "--all-targets", "--all-features", "--", "-D", "warnings"]))?;
    let mut doc = cargo(&["doc", "--workspace", "--no-deps", "--all-features"]);
    doc.env("RUSTDOCFLAGS", "-D warnings");
    execute(doc)?;
    tidy::run()?;
    if deep {
        say("deep: 20,000 cases per law and full ray counts, on the release build; then all assets anew");
        let mut laws = cargo(&["test", "--release", "--workspace"]);
        laws.env("PROPTEST_CASES", "20000").env("HELIOSTAT_DEEP", "100000");
        execute(laws)?;
        assets::check()?;
    }
    execute(cargo(&["test", "--workspace"]))
}
