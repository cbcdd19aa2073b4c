//! Replays of made-up disagreements, and of an index that is still wrong.

use super::{report, run};
use crate::args::{Cli, Command, IndexArgs, Preset};
use crate::command::index::replay_file::{Saved, save};
use crate::command::index::save_disagreements;
use crate::command::index::test_scene::{disagreement, scene};
use clap::Parser;
use heliostat_geometry::Ray;
use heliostat_index::verify::Agreement;
use serde_json::json;

#[test]
fn indices_that_were_wrong_agree_now() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.jsonl");
    let meets = Ray::new([0.25, 0.25, 1.0].into(), [0.0, 0.0, -1.0].into());
    let passes = Ray::new([2.0, 2.0, 1.0].into(), [0.0, 0.0, -1.0].into());
    save(&path, &scene(), &[(0, disagreement(meets)), (0, disagreement(passes))], 0).unwrap();
    let judged = run(&scene(), &[Preset::Midpoint, Preset::Best], &path).unwrap();
    assert!(judged.agrees, "{}", judged.text);
    let outcomes: Vec<_> = judged.text.lines().map(|line| line.rsplit_once(": ").unwrap().1).collect();
    let expected = [
        "hit, all agree with brute force",
        "no hit, all agree with brute force",
        "2 rays, all agree with brute force",
    ];
    assert_eq!(outcomes, expected);
    assert_eq!(judged.json[0]["hit"], true);
    assert_eq!(judged.json[1]["hit"], false);
}

#[test]
fn verify_saves_what_replay_reads() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.jsonl");
    let file = path.to_str().unwrap();
    let line = ["heliostat", "index", "a.toml", "--json", "--verify", "9", "--disagreements", file];
    let args = index_args(&line);
    let mut json = json!({});
    save_disagreements(&scene(), &[], &args, &mut json).unwrap();
    assert!(!path.exists() && json == json!({}));
    let ray = Ray::new([0.1, 0.2, 1.0].into(), [0.0, 0.1, -1.0].into());
    save_disagreements(&scene(), &[(0, disagreement(ray))], &args, &mut json).unwrap();
    assert_eq!(json["disagreements"], file);
    assert!(run(&scene(), &[Preset::Fast], &path).unwrap().agrees);
}

fn index_args(line: &[&str]) -> IndexArgs {
    match Cli::parse_from(line).command {
        Command::Index(args) => args,
        other => panic!("{other:?}"),
    }
}

#[test]
fn an_index_that_is_still_wrong_is_told() {
    let ray = Ray::new([0.25, 0.25, 1.0].into(), [0.0, 0.0, -1.0].into());
    let saved = Saved { line: 3, mesh: 0, number: 7, index: "best".into(), ray };
    let disagreements = vec![disagreement(ray)];
    let agreement = Agreement { rays: 1, hits: 0, judged: 1, differing: 1, disagreements };
    let judged = report(&[(&saved, agreement)], "a.jsonl", |mesh| format!("mesh {mesh}"));
    assert!(!judged.agrees);
    let mut lines = judged.text.lines();
    assert_eq!(
        lines.next(),
        Some(
            "replay: a.jsonl:3: mesh 0, ray 7, saved for best: DIFFERS: best says no hit (but its any-hit query a hit), brute force no hit"
        )
    );
    assert_eq!(lines.next(), Some("replay: 1 rays, 1 STILL DIFFER from brute force"));
    assert_eq!(judged.json[0]["agrees"], false);
    assert_eq!(judged.json[0]["differ"][0], "best");
}
