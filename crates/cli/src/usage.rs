//! Wrong command lines: clap's error as lines whose last one says it all.

use crate::exit::Exit;
use crate::out;
use clap::error::{ContextKind, ContextValue, ErrorKind};

/// Prints help, version or what is wrong with the command line, and tells how the process ends.
pub(crate) fn report(error: &clap::Error) -> Exit {
    match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => {
            // Clap colours its text where the terminal can; a closed pipe ends the help, nothing else.
            let _ = error.print();
            Exit::Done
        }
        ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            let _ = error.print();
            out::note(format_args!("error: no command given; try `heliostat render SCENE`"));
            Exit::Usage
        }
        _ => {
            let text = error.render().to_string();
            if let Some(usage) = paragraphs(&text).find(|p| p.starts_with("Usage:")) {
                out::note(format_args!("{usage}"));
            }
            out::note(format_args!("{}", last_line(error, &text)));
            Exit::Usage
        }
    }
}

fn paragraphs(text: &str) -> impl Iterator<Item = &str> {
    text.split("\n\n").map(str::trim)
}

/// `error: what; mend`.
fn last_line(error: &clap::Error, text: &str) -> String {
    let what = paragraphs(text).next().unwrap_or_default().trim_start_matches("error: ");
    let what = what.split_whitespace().collect::<Vec<_>>().join(" ");
    let mend = suggestion(error).or_else(|| has_mend(&what).then(String::new));
    match mend.as_deref() {
        Some("") => format!("error: {what}"),
        Some(mend) => format!("error: {what}; {mend}"),
        None => format!("error: {what}; see `{} --help`", command(text)),
    }
}

/// The name that clap takes for the one that was meant.
fn suggestion(error: &clap::Error) -> Option<String> {
    let kinds = [
        ContextKind::SuggestedArg,
        ContextKind::SuggestedValue,
        ContextKind::SuggestedSubcommand,
        ContextKind::SuggestedCommand,
    ];
    let name = kinds.iter().find_map(|&kind| match error.get(kind)? {
        ContextValue::String(name) => Some(name.clone()),
        ContextValue::Strings(names) => names.first().cloned(),
        _ => None,
    })?;
    Some(format!("did you mean `{name}`?"))
}

/// Our own parsers, and clap's lists of values, say themselves what to write.
fn has_mend(what: &str) -> bool {
    what.contains("write ") || what.contains("possible values")
}

/// The command of the usage line, such as `heliostat render`.
fn command(text: &str) -> String {
    let usage = paragraphs(text).find_map(|p| p.strip_prefix("Usage: ")).unwrap_or("heliostat");
    let words = usage.split_whitespace().take(2).filter(|w| w.chars().all(|c| c.is_ascii_lowercase()));
    words.collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::Cli;
    use clap::Parser;

    fn line(words: &[&str]) -> String {
        let error = Cli::try_parse_from(words).unwrap_err();
        last_line(&error, &error.render().to_string())
    }

    #[test]
    fn names_what_is_wrong_and_the_near_name() {
        let flag = line(&["heliostat", "render", "a.toml", "--sampels", "4"]);
        assert_eq!(flag, "error: unexpected argument '--sampels' found; did you mean `--samples`?");
        let command = line(&["heliostat", "rendr"]);
        assert_eq!(command, "error: unrecognized subcommand 'rendr'; did you mean `render`?");
        let value = line(&["heliostat", "render", "a.toml", "--integrator", "whited"]);
        assert!(value.ends_with("did you mean `whitted`?"), "{value}");
    }

    #[test]
    fn says_what_to_write() {
        let size = line(&["heliostat", "render", "a.toml", "--size", "640"]);
        assert_eq!(
            size,
            "error: invalid value '640' for '--size <WxH>': write WIDTHxHEIGHT, as in 1920x1080, each from 1 to 65535"
        );
        let missing = line(&["heliostat", "render"]);
        assert!(missing.starts_with("error: the following required arguments were not provided: <SCENE>"));
        assert!(missing.ends_with("see `heliostat render --help`"), "{missing}");
    }
}
