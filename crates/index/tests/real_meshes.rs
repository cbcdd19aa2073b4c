//! The trees against brute force on real models.
//!
//! `HELIOSTAT_DEEP=N` traces N rays through each mesh instead of a few hundred.

#![expect(clippy::unwrap_used, reason = "tests fail by panicking")]

mod support;

use heliostat_index::verify::{Agreement, Verifier};
use heliostat_index::{BuildParams, MeshTree};

const PRESETS: [(&str, BuildParams); 2] =
    [("midpoint", BuildParams::MIDPOINT), ("balanced", BuildParams::BALANCED)];

fn rays(fewer: u64) -> u64 {
    std::env::var("HELIOSTAT_DEEP").ok().and_then(|n| n.parse().ok()).unwrap_or(fewer)
}

#[test]
fn trees_agree_with_brute_force_on_every_model() {
    for path in support::obj_files() {
        let mesh = support::read_obj(&path);
        if mesh.triangles.is_empty() {
            continue;
        }
        let verifier = Verifier::new(&mesh, &PRESETS).unwrap();
        let agreement = run(&verifier, rays(200));
        let name = path.display();
        assert!(agreement.hits > agreement.rays / 20, "{name}: too few rays meet it: {}", agreement.hits);
        assert_eq!(agreement.disagreements, [], "{name}");
    }
}

/// On two threads when there is much to do.
fn run(verifier: &Verifier<'_>, rays: u64) -> Agreement {
    let middle = rays / 2;
    std::thread::scope(|scope| {
        let second = scope.spawn(|| verifier.run(middle..rays, 1));
        let mut agreement = verifier.run(0..middle, 1);
        agreement.merge(second.join().unwrap());
        agreement
    })
}

#[test]
fn trees_of_every_model_are_valid_and_bounded() {
    for path in support::obj_files() {
        let mesh = support::read_obj(&path);
        // Clipping every triangle against every leaf takes its time.
        if mesh.triangles.len() as u64 > rays(30_000) {
            continue;
        }
        for (preset, params) in PRESETS {
            let tree = MeshTree::build(&mesh, &params).unwrap();
            tree.tree().validate(&mesh).unwrap();
            let stats = tree.tree().stats();
            let most = f64::from(params.max_duplication) * mesh.triangles.len() as f64 + 64.0;
            assert!(stats.references as f64 <= most, "{} {preset}: {stats:?}", path.display());
        }
    }
}
