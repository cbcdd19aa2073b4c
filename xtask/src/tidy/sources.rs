//! Each source file by itself: its header, its length, what was left in it; and the links of the pages.

use crate::process::{capture, command, root, say};
use std::path::{Path, PathBuf};

/// Lines that a Rust file should stay under, and the most that it may have.
const SOFT_LIMIT: usize = 250;
const HARD_LIMIT: usize = 500;

/// The one place that may hold tolerances.
const ERROR_BOUND: &str = "crates/geometry/src/error_bound.rs";

/// Words that say that something is not finished. Split, so that this file does not find itself.
const LEFT_OVERS: [&str; 5] = [
    concat!("TO", "DO"),
    concat!("FIX", "ME"),
    concat!("XX", "X"),
    concat!("unimplemented", "!"),
    concat!("#[igno", "re]"),
];

/// One line per finding over all files that git tracks or would track.
pub(super) fn check() -> Result<Vec<String>, String> {
    let list = ["ls-files", "--cached", "--others", "--exclude-standard"];
    let files = capture(command("git", &list))?;
    let mut findings = Vec::new();
    let mut long = 0;
    for name in files.lines() {
        let Ok(text) = std::fs::read_to_string(root().join(name)) else { continue };
        match Path::new(name).extension().and_then(|e| e.to_str()) {
            Some("rs") => {
                long += usize::from(text.lines().count() > SOFT_LIMIT);
                findings.extend(check_rust(name, &text));
            }
            Some("md") => findings.extend(check_links(name, &text)),
            _ => {}
        }
    }
    say(&format!("tidy: {long} Rust files are longer than {SOFT_LIMIT} lines"));
    Ok(findings)
}

fn check_rust(name: &str, text: &str) -> Vec<String> {
    let mut findings = Vec::new();
    let lines = text.lines().count();
    if lines > HARD_LIMIT {
        findings.push(format!("{name}: {lines} lines, at most {HARD_LIMIT}: split it by concept"));
    }
    if !text.starts_with("//!") && !text.starts_with("#![doc") {
        findings.push(format!("{name}:1: no `//!` header that says what the file does"));
    }
    let is_test = name.ends_with("/tests.rs") || name.contains("/tests/");
    let is_library = name.starts_with("crates/") && !name.starts_with("crates/cli/");
    let tolerances_matter = is_library && name.contains("/src/") && !is_test && name != ERROR_BOUND;
    let mut in_tests = false;
    for (number, line) in text.lines().enumerate() {
        let place = format!("{name}:{}", number + 1);
        in_tests |= line.trim_start().starts_with("#[cfg(test)]");
        if line.ends_with([' ', '\t']) {
            findings.push(format!("{place}: white space at the end of the line"));
        }
        if let Some(word) = LEFT_OVERS.iter().find(|w| line.contains(**w)) {
            findings.push(format!("{place}: `{word}` left in the tree"));
        }
        if tolerances_matter && !in_tests && has_tolerance(line) {
            findings.push(format!("{place}: a tolerance outside {ERROR_BOUND}"));
        }
    }
    findings
}

/// Whether code (not a comment, not text in quotes) holds a literal such as `1e-6`.
fn has_tolerance(line: &str) -> bool {
    let code: String = line.split("//").next().unwrap_or_default().split('"').step_by(2).collect();
    let bytes = code.as_bytes();
    code.match_indices("e-").any(|(at, _)| {
        let digit = |i: Option<&u8>| i.is_some_and(u8::is_ascii_digit);
        let number_before = at > 0 && (digit(bytes.get(at - 1)) || bytes[at - 1] == b'_');
        number_before && digit(bytes.get(at + 2))
    })
}

/// Links of a page to files that are not there.
fn check_links(name: &str, text: &str) -> Vec<String> {
    let folder = root().join(name).parent().map_or_else(PathBuf::new, Path::to_path_buf);
    text.split("](")
        .skip(1)
        .filter_map(|rest| rest.split([')', ' ', '#']).next())
        .filter(|link| !link.is_empty() && !link.contains("://") && !link.starts_with("mailto:"))
        .filter(|link| !folder.join(link).exists())
        .map(|link| format!("{name}: link to `{link}`, which does not exist"))
        .collect()
}
