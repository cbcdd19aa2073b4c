//! The exported partition: closed boxes, seen from outside, that tile the root.

#![expect(clippy::unwrap_used, reason = "tests fail by panicking")]

use glam::{DVec3, Vec3};
use heliostat_geometry::{Aabb, TriMesh};
use heliostat_index::{BspTree, BuildParams, ExportWhat, export_obj};
use std::collections::BTreeMap;

/// What an OBJ file holds, by group.
struct Exported {
    vertices: Vec<DVec3>,
    /// Depth and faces of each object.
    objects: Vec<(String, Vec<[usize; 4]>)>,
}

fn export(tree: &BspTree, what: ExportWhat) -> Exported {
    let mut bytes = Vec::new();
    export_obj(tree, what, &mut bytes).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    let (mut vertices, mut objects, mut group) = (Vec::new(), Vec::new(), String::new());
    for line in text.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[0] {
            "v" => vertices.push(DVec3::from_array([1, 2, 3].map(|i| words[i].parse().unwrap()))),
            "g" => words[1].clone_into(&mut group),
            "o" => objects.push((group.clone(), Vec::new())),
            "f" => {
                let face = [1, 2, 3, 4].map(|i| words[i].parse::<usize>().unwrap() - 1);
                objects.last_mut().unwrap().1.push(face);
            }
            _ => assert_eq!(words[0], "#"),
        }
    }
    Exported { vertices, objects }
}

impl Exported {
    /// The volume inside the faces of each object, by the divergence theorem: negative when they look inward.
    fn volumes(&self) -> impl Iterator<Item = f64> {
        self.objects.iter().map(|(_, faces)| {
            let cone = |face: &[usize; 4]| {
                let [a, b, c, d] = face.map(|i| self.vertices[i]);
                a.dot(b.cross(c)) + a.dot(c.cross(d))
            };
            faces.iter().map(cone).sum::<f64>() / 6.0
        })
    }

    fn groups(&self) -> BTreeMap<&str, usize> {
        let mut groups = BTreeMap::new();
        for (group, _) in &self.objects {
            *groups.entry(group.as_str()).or_insert(0) += 1;
        }
        groups
    }
}

/// A wavy, uneven sheet away from the origin.
fn sheet() -> TriMesh {
    let n = 40_u32;
    let at = |i: u32| {
        let (x, z) = ((i % n) as f32, (i / n) as f32);
        Vec3::new(700.0 + 0.5 * x * x, -3.0 + 4.0 * (0.4 * x).sin() * (0.3 * z).cos(), 90.0 - 0.02 * z)
    };
    let cells = (0..n * (n - 1)).filter(|i| i % n != n - 1);
    TriMesh {
        positions: (0..n * n).map(at).collect(),
        triangles: cells.flat_map(|i| [[i, i + n, i + 1], [i + 1, i + n, i + n + 1]]).collect(),
        ..TriMesh::default()
    }
}

fn assert_tiles(exported: &Exported, root: Aabb) {
    let whole = root.volume();
    let total: f64 = exported.volumes().sum();
    assert!((total - whole).abs() <= 1e-5 * whole, "{total} is not {whole}");
    // The divergence theorem sums large terms: allow them their rounding.
    let noise = 1e-12 * f64::from(root.max.abs().max(root.min.abs()).max_element()).powi(3);
    assert!(exported.volumes().all(|v| v > -noise), "a box looks inward");
}

#[test]
fn leaves_and_any_depth_tile_the_root() {
    let mesh = sheet();
    for params in [BuildParams::MIDPOINT, BuildParams::BALANCED] {
        let tree = BspTree::build(&mesh, &params).unwrap();
        let stats = tree.stats();
        let leaves = export(&tree, ExportWhat::Leaves);
        assert_eq!(leaves.objects.len(), stats.leaves);
        assert_tiles(&leaves, tree.bounds());
        for depth in [0, 1, 5, stats.depth, stats.depth + 7] {
            assert_tiles(&export(&tree, ExportWhat::Depth(depth)), tree.bounds());
        }
        assert_eq!(export(&tree, ExportWhat::Depth(0)).objects.len(), 1);
        assert_eq!(export(&tree, ExportWhat::Depth(stats.depth)).objects.len(), stats.leaves);
    }
}

#[test]
fn all_nodes_come_in_one_group_per_depth() {
    let tree = BspTree::build(&sheet(), &BuildParams::MIDPOINT).unwrap();
    let stats = tree.stats();
    let all = export(&tree, ExportWhat::All);
    assert_eq!(all.objects.len(), stats.nodes);
    let groups = all.groups();
    assert_eq!(groups.len(), stats.depth as usize + 1);
    assert_eq!(groups["depth_00"], 1);
    assert_eq!(groups["depth_01"], 2);
    assert!(all.objects.iter().all(|(_, faces)| faces.len() == 6));
    assert_eq!(all.vertices.len(), 8 * stats.nodes);
    // Twelve edges, each shared by two faces in opposite directions: the box is closed.
    for (_, faces) in &all.objects {
        let mut edges: Vec<[usize; 2]> =
            faces.iter().flat_map(|f| (0..4).map(|k| [f[k], f[(k + 1) % 4]])).collect();
        edges.sort_unstable();
        edges.dedup();
        assert_eq!(edges.len(), 24);
        assert!(edges.iter().all(|&[a, b]| edges.contains(&[b, a])));
    }
}
