//! Help, version, schema, completions and manual pages.

use crate::common::Folder;

const COMMANDS: [&str; 10] =
    ["render", "check", "info", "index", "compare", "view", "video", "schema", "completions", "man"];

#[test]
fn help_names_all_commands_and_exit_codes() {
    let run = Folder::new().run(&["--help"]).expect(0);
    for command in COMMANDS {
        assert!(run.stdout.contains(&format!("\n  {command}")), "{command}");
    }
    for code in ["  0 ", "  1 ", "  2 ", "  3 ", "  4 ", "  130 "] {
        assert!(run.stdout.contains(code), "{code}");
    }
}

#[test]
fn every_command_has_help_with_an_example() {
    let folder = Folder::new();
    for command in COMMANDS {
        let run = folder.run(&[command, "--help"]).expect(0);
        assert!(run.stdout.contains("Examples:\n  heliostat "), "{command}: {run:#?}");
        assert!(run.stdout.contains(&format!("Usage: heliostat {command}")), "{command}");
        assert!(run.stdout.lines().all(|line| line.chars().count() <= 120), "{command}");
    }
}

#[test]
fn version() {
    let run = Folder::new().run(&["--version"]).expect(0);
    assert_eq!(run.stdout, format!("heliostat {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn the_schema_is_json_and_knows_the_sections() {
    let run = Folder::new().run(&["schema"]).expect(0);
    let schema: serde_json::Value = serde_json::from_str(&run.stdout).expect("JSON");
    for section in ["render", "camera", "material", "object", "light", "animation"] {
        assert!(schema["properties"][section].is_object(), "{section}");
    }
}

#[test]
fn completions_and_manual_pages() {
    let folder = Folder::new();
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let run = folder.run(&["completions", shell]).expect(0);
        assert!(run.stdout.contains("heliostat"), "{shell}");
    }
    assert!(folder.run(&["man"]).expect(0).stdout.contains(".TH heliostat 1"));
    folder.run(&["man", "--dir", "."]).expect(0);
    assert!(folder.names().contains(&"heliostat-render.1".to_owned()), "{:?}", folder.names());
}
