//! `heliostat check`: everything that is wrong with a scene, without rendering it.

mod lint;

use crate::args::CheckArgs;
use crate::diagnose::{Failure, print_warning};
use crate::exit::Exit;
use crate::{open, out};
use heliostat_io::LoadError;
use heliostat_io::error::Report;
use serde_json::{Value, json};

/// Loads the scene as a render would, at its first and its last frame, and tells what it finds.
pub(crate) fn run(args: &CheckArgs) -> Result<Exit, Failure> {
    let (warnings, error) = findings(args);
    let strict = args.strict && !warnings.is_empty();
    if args.json {
        let findings: Vec<Value> = warnings
            .iter()
            .map(|w| finding("warning", w.report()))
            .chain(error.iter().map(|e| finding("error", e.report())))
            .collect();
        let ok = error.is_none() && !strict;
        let path = args.scene.to_string_lossy();
        out::line(format_args!("{:#}", json!({ "path": path, "ok": ok, "findings": findings })));
    } else {
        warnings.iter().for_each(print_warning);
    }
    match (error, warnings.into_iter().next()) {
        (Some(error), _) => Err(error.into()),
        (None, Some(first)) if strict => Err(first.into_error().into()),
        (None, first) => {
            if !args.json {
                let verdict = if first.is_some() { "renders, with the warnings above" } else { "ok" };
                out::line(format_args!("{}: {verdict}", args.scene.display()));
            }
            Ok(Exit::Done)
        }
    }
}

/// All warnings, and the error that ended the search.
fn findings(args: &CheckArgs) -> (Vec<heliostat_io::Warning>, Option<LoadError>) {
    let mut warnings = Vec::new();
    let source = match open::source(&args.scene, &args.set, None, args.variant.as_deref()) {
        Ok(source) => source,
        Err(error) => return (warnings, Some(error)),
    };
    let first = source.first_frame();
    let last = source.frames().map_or(first, |frames| *frames.end());
    for frame in [first, last] {
        let shot = match source.shot(frame) {
            Ok(shot) => shot,
            Err(error) => return (warnings, Some(error)),
        };
        let more = shot.warnings.into_iter().chain(lint::lint(&args.scene, &shot.scene));
        // What is wrong at both frames is told once.
        for warning in more {
            if !warnings.contains(&warning) {
                warnings.push(warning);
            }
        }
    }
    (warnings, None)
}

fn finding(severity: &str, report: &Report) -> Value {
    json!({
        "severity": severity,
        "path": report.path.to_string_lossy(),
        "line": report.place.as_ref().map(|p| p.line),
        "column": report.place.as_ref().map(|p| p.column),
        "message": report.message,
        "help": report.help,
    })
}
