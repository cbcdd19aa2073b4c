//! Everything a change must pass, in the order in which it fails fastest.

use crate::process::{cargo, run as execute, say};
use crate::{Outcome, assets, tidy};
use std::time::{SystemTime, UNIX_EPOCH};

/// Runs every check; the tests come last, so that their closing line ends the output.
pub(crate) fn run(deep: bool) -> Outcome {
    execute(cargo(&["fmt", "--all", "--check"]))?;
    execute(cargo(&["clippy", "--workspace", "--all-targets", "--all-features", "--", "-D", "warnings"]))?;
    let mut doc = cargo(&["doc", "--workspace", "--no-deps", "--all-features"]);
    doc.env("RUSTDOCFLAGS", "-D warnings");
    execute(doc)?;
    tidy::run()?;
    if deep {
        let seed = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |age| age.as_secs()).to_string();
        say("deep: 20,000 cases per law and full ray counts, on the release build; then all assets anew");
        say(&format!("the cases are those of PROPTEST_RNG_SEED={seed}"));
        let mut laws = cargo(&["test", "--release", "--workspace"]);
        laws.env("PROPTEST_CASES", "20000").env("PROPTEST_RNG_SEED", seed).env("HELIOSTAT_DEEP", "100000");
        execute(laws)?;
        assets::check()?;
    }
    execute(cargo(&["test", "--workspace"]))
}
