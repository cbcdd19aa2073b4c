//! The verifier against answers that are wrong on purpose.

use super::{Agreement, Disagreement, KINDS, Verifier};
use crate::bsp::BuildParams;
use crate::mesh_tree::brute_force;
use glam::Vec3;
use heliostat_geometry::{Ray, TriMesh};
use std::ops::Range;

/// One triangle in the plane z = 0.
fn triangle() -> TriMesh {
    TriMesh {
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
        triangles: vec![[0, 1, 2]],
        ..TriMesh::default()
    }
}

#[test]
fn every_wrong_answer_is_a_disagreement() {
    let mesh = triangle();
    let verifier = Verifier::new(&mesh, &[("best", BuildParams::BEST)]).unwrap();
    let ray = Ray::new(Vec3::new(0.25, 0.25, 1.0), Vec3::NEG_Z);
    let right = brute_force(&mesh, &ray);
    let mut far = right;
    far.as_mut().unwrap().hit.t = 1.0_f32.next_up();
    let answers = vec![
        ("right", (right, true)),
        ("blind", (None, false)),
        ("torn", (right, false)),
        ("far", (far, true)),
    ];
    let Agreement { hits, judged, differing, disagreements, .. } = verifier.judge(7, ray, answers);
    assert_eq!((hits, judged, differing), (1, 1, 3));
    let found: Vec<_> = disagreements.iter().map(|d| (d.index.as_str(), d.got, d.got_any)).collect();
    assert_eq!(found, [("blind", None, false), ("torn", right, false), ("far", far, true)]);
    assert!(disagreements.iter().all(|d| d.number == 7 && d.ray == ray && d.expected == right));
}

#[test]
fn a_replay_is_judged_whatever_the_sample() {
    let mesh = triangle();
    let verifier = Verifier::new(&mesh, &[("best", BuildParams::BEST)]).unwrap().judging_every(1000);
    let ray = verifier.ray(1, 0);
    let again = verifier.replay(1, ray);
    assert_eq!((again.rays, again.judged, again.disagreements.len()), (1, 1, 0));
    assert_eq!(again.hits, verifier.run(1..2, 0).hits);
}

#[test]
fn a_sample_holds_rays_of_every_kind() {
    let mesh = triangle();
    let settings = [("best", BuildParams::BEST), ("fast", BuildParams::FAST)];
    let verifier = Verifier::new(&mesh, &settings).unwrap().judging_every(10);
    // One ray in ten is judged, although ten is a multiple of the kinds.
    for kind in 0..KINDS {
        let of_kind = (0..100).map(|i| verifier.run(KINDS * i + kind..KINDS * i + kind + 1, 0).judged);
        assert_eq!(of_kind.sum::<u64>(), 10, "{kind}");
    }
}

#[test]
fn the_first_disagreements_are_kept_and_all_are_counted() {
    let wrong = |number| {
        let ray = Ray::new(Vec3::ZERO, Vec3::X);
        Disagreement { number, ray, index: "blind".into(), expected: None, got: None, got_any: true }
    };
    let run = |numbers: Range<u64>| Agreement {
        differing: numbers.end - numbers.start,
        disagreements: numbers.map(wrong).collect(),
        ..Agreement::default()
    };
    let kept = Agreement::KEPT as u64;
    let mut all = run(0..kept - 1);
    all.merge(run(kept - 1..kept + 1));
    all.merge(run(kept + 1..kept + 3));
    assert_eq!(all.differing, kept + 3);
    assert!(all.disagreements.iter().map(|wrong| wrong.number).eq(0..kept));
}
