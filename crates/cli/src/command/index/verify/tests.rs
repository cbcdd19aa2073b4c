//! What is said and kept of made-up disagreements.

use super::{describe, keep};
use crate::command::index::test_scene::disagreement;
use heliostat_geometry::Ray;
use heliostat_index::verify::Agreement;

#[test]
fn all_disagreements_are_counted_and_the_first_shown() {
    let ray = Ray::new([0.0, 0.0, 1.0].into(), [0.0, 0.0, -1.0].into());
    let disagreements = vec![disagreement(ray); Agreement::KEPT];
    let agreement = Agreement { rays: 9_000, hits: 0, judged: 9_000, differing: 5_000, disagreements };
    let mut text = String::new();
    describe("mesh 0", &agreement, &mut text);
    let lines: Vec<_> = text.lines().collect();
    assert_eq!(lines[0], "verify: mesh 0: 9,000 rays, 0 hits, 5,000 DISAGREEMENTS with brute force");
    assert_eq!((lines.len(), lines[6]), (7, "  and 4,995 more"));
}

#[test]
fn many_meshes_keep_no_more_than_one() {
    let ray = Ray::new([0.0, 0.0, 1.0].into(), [0.0, 0.0, -1.0].into());
    let mut found = Vec::new();
    keep(&mut found, 0, vec![disagreement(ray); Agreement::KEPT - 1]);
    keep(&mut found, 1, vec![disagreement(ray); 2]);
    keep(&mut found, 2, vec![disagreement(ray); 2]);
    assert_eq!(found.len(), Agreement::KEPT);
    assert_eq!(found.last().map(|(mesh, _)| *mesh), Some(1));
}
