//! Input that breaks builders: nothing, next to nothing, too much in one place, and what is no number.

#![expect(clippy::unwrap_used, reason = "tests fail by panicking")]

use glam::Vec3;
use heliostat_geometry::{Aabb, Interval, Ray, TriMesh};
use heliostat_index::bsp::params::MAX_DEPTH;
use heliostat_index::mesh_tree::brute_force;
use heliostat_index::{
    BspTree, BuildError, BuildParams, ExportWhat, MeshTree, RayIndex, SahCosts, SplitRule, TraversalCost,
    export_obj,
};

const PRESETS: [BuildParams; 4] =
    [BuildParams::MIDPOINT, BuildParams::FAST, BuildParams::BALANCED, BuildParams::BEST];

fn cube(centre: Vec3, half: f32) -> Aabb {
    Aabb { min: centre - Vec3::splat(half), max: centre + Vec3::splat(half) }
}

/// Triangles that share one set of vertices.
fn mesh(positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> TriMesh {
    TriMesh { positions, triangles, ..TriMesh::default() }
}

fn assert_agrees(mesh: &TriMesh, rays: &[Ray]) {
    for params in PRESETS {
        let tree = MeshTree::build(mesh, &params).unwrap();
        tree.tree().validate(mesh).unwrap();
        for ray in rays {
            assert_eq!(tree.closest_hit(ray), brute_force(mesh, ray), "{ray:?}");
        }
    }
}

#[test]
fn a_tree_over_nothing_hits_nothing() {
    for params in PRESETS {
        let tree = BspTree::build(&Vec::<Aabb>::new(), &params).unwrap();
        assert_eq!(tree.validate(&Vec::<Aabb>::new()), Ok(()));
        assert!(tree.bounds().is_empty());
        let ray = Ray::new(Vec3::ZERO, Vec3::X);
        assert!(tree.closest_hit(&ray, |_, _| Some((1.0, ()))).is_none());
        assert!(!tree.any_hit(&ray, |_, _| true));
        tree.for_each_hit(&ray, |i| panic!("visited {i}"));
        let mut obj = Vec::new();
        export_obj(&tree, ExportWhat::All, &mut obj).unwrap();
        assert!(!String::from_utf8(obj).unwrap().contains("\nv "));
    }
}

#[test]
fn one_or_two_primitives_cost_one_leaf() {
    for n in 1..=2 {
        let boxes: Vec<Aabb> = (0..n).map(|i| cube(Vec3::X * 3.0 * i as f32, 1.0)).collect();
        for params in PRESETS {
            let stats = BspTree::build(&boxes, &params).unwrap().stats();
            assert_eq!((stats.nodes, stats.depth, stats.references), (1, 0, n));
        }
    }
}

#[test]
fn boxes_that_are_none_are_refused_by_name() {
    let nan = Aabb { min: Vec3::new(0.0, f32::NAN, 0.0), max: Vec3::ONE };
    let flipped = Aabb { min: Vec3::ONE, max: Vec3::ZERO };
    for bad in [nan, flipped, Aabb::EMPTY] {
        let boxes = vec![cube(Vec3::ZERO, 1.0), cube(Vec3::X, 1.0), bad];
        let error = BspTree::build(&boxes, &BuildParams::BALANCED).unwrap_err();
        assert!(matches!(error, BuildError::Bounds { primitive: 2, .. }), "{error}");
        assert!(error.to_string().contains("primitive 2"), "{error}");
    }
}

#[test]
fn meshes_that_do_not_hold_together_are_refused() {
    let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
    let missing = mesh(corners.clone(), vec![[0, 1, 3]]);
    assert!(matches!(MeshTree::build(&missing, &BuildParams::BALANCED), Err(BuildError::Mesh(_))));
    let infinite = mesh(vec![Vec3::ZERO, Vec3::X, Vec3::splat(f32::INFINITY)], vec![[0, 1, 2]]);
    assert!(matches!(MeshTree::build(&infinite, &BuildParams::BALANCED), Err(BuildError::Mesh(_))));
    let nan = mesh(vec![Vec3::ZERO, Vec3::X, Vec3::new(0.0, f32::NAN, 0.0)], vec![[0, 1, 2]]);
    assert!(matches!(
        BspTree::build(&nan, &BuildParams::BALANCED),
        Err(BuildError::Bounds { primitive: 0, .. })
    ));
}

#[test]
fn settings_out_of_range_are_refused() {
    let free = SplitRule::Sah(SahCosts { traversal: 0.0, ..SahCosts::DEFAULT });
    let nan = SplitRule::Sah(SahCosts { intersection: f64::NAN, ..SahCosts::DEFAULT });
    for wrong in [
        BuildParams { leaf_limit: 0, ..BuildParams::BALANCED },
        BuildParams { max_depth: MAX_DEPTH + 1, ..BuildParams::BALANCED },
        BuildParams { max_duplication: 0.5, ..BuildParams::BALANCED },
        BuildParams { max_duplication: f32::NAN, ..BuildParams::BALANCED },
        BuildParams { split: free, ..BuildParams::BALANCED },
        BuildParams { split: nan, ..BuildParams::BALANCED },
    ] {
        let built = BspTree::build(&vec![cube(Vec3::ZERO, 1.0)], &wrong);
        assert!(matches!(built, Err(BuildError::Params { .. })), "{wrong:?}");
    }
}

#[test]
fn a_tree_may_duplicate_without_end() {
    let params = BuildParams { max_duplication: f32::MAX, ..BuildParams::BALANCED };
    let boxes: Vec<Aabb> = (0..100).map(|i| cube(Vec3::X * i as f32, 1.5)).collect();
    let tree = BspTree::build(&boxes, &params).unwrap();
    tree.validate(&boxes).unwrap();
    assert!(tree.stats().leaves > 1);
}

#[test]
fn presets_have_names() {
    assert_eq!("midpoint".parse(), Ok(BuildParams::MIDPOINT));
    assert_eq!("balanced".parse(), Ok(BuildParams::BALANCED));
    for name in BuildParams::NAMES {
        assert!(name.parse::<BuildParams>().is_ok());
    }
    let error = "slow".parse::<BuildParams>().unwrap_err();
    assert_eq!(error.to_string(), "no build preset `slow`; there are: midpoint, fast, balanced, best");
}

#[test]
fn unbounded_primitives_are_tested_by_every_query() {
    let plane = Aabb {
        min: Vec3::new(-f32::INFINITY, 0.0, -f32::INFINITY),
        max: Vec3::new(f32::INFINITY, 0.0, f32::INFINITY),
    };
    let boxes = vec![cube(Vec3::Y * 5.0, 1.0), plane, cube(Vec3::Y * 9.0, 1.0)];
    for params in PRESETS {
        let tree = BspTree::build(&boxes, &params).unwrap();
        tree.validate(&boxes).unwrap();
        assert_eq!(tree.unbounded(), [1]);
        // Far from everything bounded.
        let ray = Ray::new(Vec3::new(1e6, 3.0, 0.0), Vec3::NEG_Y);
        let floor = |i: u32, _: &Ray| (i == 1).then_some((3.0, "floor"));
        let found = tree.closest_hit(&ray, floor).unwrap();
        assert_eq!((found.primitive, found.t, found.data), (1, 3.0, "floor"));
        assert!(tree.any_hit(&ray, |i, _| i == 1));
        let mut visited = Vec::new();
        tree.for_each_hit(&ray, |i| visited.push(i));
        assert_eq!(visited, [1]);
    }
}

#[test]
fn a_million_coincident_triangles_end_in_time_and_memory() {
    let positions = vec![Vec3::ZERO, Vec3::X, Vec3::new(0.3, 1.0, 0.2)];
    // The midpoint build cannot know that cutting is in vain, and takes longer.
    for (params, n) in [(BuildParams::BALANCED, 1_000_000), (BuildParams::MIDPOINT, 50_000)] {
        let mesh = mesh(positions.clone(), vec![[0, 1, 2]; n]);
        let tree = MeshTree::build(&mesh, &params).unwrap();
        let stats = tree.tree().stats();
        assert!(stats.references_per_primitive <= f64::from(params.max_duplication) + 0.01, "{stats:?}");
        let ray = Ray::new(Vec3::new(0.4, 0.3, 5.0), Vec3::NEG_Z);
        // Of all hits at one distance, the first triangle has the lowest id.
        assert_eq!(tree.closest_hit(&ray).unwrap().triangle, 0);
    }
}

#[test]
fn large_triangles_that_all_overlap_end_in_time_and_memory() {
    // Spokes through the middle of a cube, each turned a little: every cut meets almost all.
    let n = 20_000_u32;
    let spoke = |i: u32| {
        let (a, b) = (i as f32 * 0.618, i as f32 * 0.414);
        let tip = Vec3::new(a.cos() * b.sin(), b.cos(), a.sin() * b.sin());
        [tip, -tip, tip.cross(Vec3::new(0.3, 0.5, 0.8))]
    };
    let positions: Vec<Vec3> = (0..n).flat_map(spoke).collect();
    let mesh = mesh(positions, (0..n).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect());
    for params in PRESETS {
        let tree = BspTree::build(&mesh, &params).unwrap();
        let stats = tree.stats();
        assert!(stats.references_per_primitive <= f64::from(params.max_duplication) + 0.01, "{stats:?}");
        assert!(stats.depth <= params.max_depth);
    }
}

#[test]
fn one_huge_triangle_among_tiny_ones() {
    let mut positions =
        vec![Vec3::new(-1e6, -1e6, -3.0), Vec3::new(1e6, -1e6, -3.0), Vec3::new(0.0, 1e6, -3.0)];
    let mut triangles = vec![[0, 1, 2]];
    for i in 0..1000_u32 {
        let at = Vec3::new((i % 32) as f32, (i / 32) as f32, 0.01 * (i % 7) as f32);
        let first = positions.len() as u32;
        positions.extend([at, at + 0.4 * Vec3::X, at + 0.4 * Vec3::Y]);
        triangles.push([first, first + 1, first + 2]);
    }
    let mesh = mesh(positions, triangles);
    let rays: Vec<Ray> = (0..400_u32)
        .map(|i| Ray::new(Vec3::new(0.1 + (i % 40) as f32, 0.1 + (i / 16) as f32, 50.0), Vec3::NEG_Z))
        .collect();
    assert_agrees(&mesh, &rays);
}

#[test]
fn one_huge_triangle_does_not_blur_the_others() {
    // A sheet of millimetres, alone and above a floor of a thousand kilometres.
    let corner = |i: u32| Vec3::new(1e-3 * (i % 80) as f32, 0.5, 1e-3 * (i / 80) as f32);
    let mut positions: Vec<Vec3> = (0..6400).map(corner).collect();
    positions.extend([Vec3::new(-1e6, 0.0, -1e6), Vec3::new(1e6, 0.0, -1e6), Vec3::new(0.0, 0.0, 2e6)]);
    let cells = (0..6320_u32).filter(|i| i % 80 != 79);
    let sheet: Vec<[u32; 3]> = cells.flat_map(|i| [[i, i + 80, i + 1], [i + 1, i + 80, i + 81]]).collect();
    let alone = mesh(positions.clone(), sheet.clone());
    let with_floor = mesh(positions, [sheet, vec![[6400, 6402, 6401]]].concat());

    let tests = |mesh: &TriMesh| {
        let tree = MeshTree::build(mesh, &BuildParams::BALANCED).unwrap();
        let mut cost = TraversalCost::default();
        for i in 0..1000 {
            let target = Vec3::new(0.078 * (0.618 * i as f32).fract(), 0.5, 0.078 * i as f32 / 1000.0);
            let ray = Ray::new(Vec3::new(0.04, 0.6, -0.02), target - Vec3::new(0.04, 0.6, -0.02));
            assert_eq!(tree.closest_hit_counted(&ray, &mut cost), brute_force(mesh, &ray));
        }
        cost.tests
    };
    let (few, more) = (tests(&alone), tests(&with_floor));
    // The error of the floor's own corners reaches the sheet: each cell knows it, and so it is tested now and
    // then. Blurred cells would cost thousands of tests for each ray.
    assert!(more < 10 * few, "{more} tests with the floor, {few} without");
}

#[test]
fn triangles_without_area_do_no_harm() {
    // Points, lines along and across the axes, and one triangle that can be hit.
    let positions = vec![Vec3::ZERO, Vec3::X, Vec3::splat(2.0), Vec3::new(0.0, 3.0, 0.0)];
    let mesh = mesh(positions, vec![[0, 0, 0], [0, 1, 1], [1, 1, 1], [2, 0, 2], [0, 1, 3], [3, 3, 0]]);
    let rays = [Ray::new(Vec3::new(0.2, 0.2, 9.0), Vec3::NEG_Z), Ray::new(Vec3::NEG_X, Vec3::X)];
    assert_agrees(&mesh, &rays);
    let tree = MeshTree::build(&mesh, &BuildParams::BALANCED).unwrap();
    assert_eq!(tree.closest_hit(&rays[0]).unwrap().triangle, 4);
}

#[test]
fn all_on_one_line_or_in_one_point() {
    let line: Vec<Aabb> = (0..200).map(|i| cube(Vec3::X * i as f32, 0.0)).collect();
    let point = vec![cube(Vec3::new(7.0, -1e5, 1e-3), 0.0); 200];
    for boxes in [line, point] {
        for params in PRESETS {
            let tree = BspTree::build(&boxes, &params).unwrap();
            tree.validate(&boxes).unwrap();
            for (i, b) in boxes.iter().enumerate() {
                let ray = Ray::new(b.min + Vec3::Y, Vec3::NEG_Y);
                let mut visited = Vec::new();
                tree.for_each_hit(&ray, |i| visited.push(i as usize));
                assert!(visited.contains(&i), "the ray at box {i} does not see it");
            }
        }
    }
}

#[test]
fn the_largest_and_the_smallest_floats() {
    let huge: Vec<Aabb> = (0..40).map(|i| cube(Vec3::X * (i as f32 - 20.0) * 1e37, 1e36)).collect();
    let tiny: Vec<Aabb> = (0..40).map(|i| cube(Vec3::X * i as f32 * 1e-40, 1e-41)).collect();
    for boxes in [huge, tiny] {
        for params in PRESETS {
            let tree = BspTree::build(&boxes, &params).unwrap();
            tree.validate(&boxes).unwrap();
            for (i, b) in boxes.iter().enumerate() {
                let ray = Ray::new(b.centre(), Vec3::Y);
                let mut visited = Vec::new();
                tree.for_each_hit(&ray, |i| visited.push(i as usize));
                assert!(visited.contains(&i), "the ray from box {i} does not see it");
            }
        }
    }
}

#[test]
fn rays_that_are_none_get_an_answer() {
    let boxes: Vec<Aabb> = (0..100).map(|i| cube(Vec3::X * i as f32, 0.4)).collect();
    let tree = BspTree::build(&boxes, &BuildParams::BALANCED).unwrap();
    let nan = Vec3::splat(f32::NAN);
    let everything = Interval { min: f32::NEG_INFINITY, max: f32::INFINITY };
    for ray in [
        Ray::new(nan, Vec3::X),
        Ray::new(Vec3::ZERO, nan),
        Ray::new(Vec3::ZERO, Vec3::ZERO),
        Ray::new(Vec3::splat(f32::INFINITY), Vec3::X),
        Ray { range: everything, ..Ray::new(Vec3::ZERO, Vec3::ZERO) },
    ] {
        tree.for_each_hit(&ray, |_| {});
        tree.any_hit(&ray, |_, _| false);
        tree.closest_hit(&ray, |_, _| None::<(f32, ())>);
    }
}

#[test]
fn answers_outside_the_range_are_ignored() {
    let boxes = vec![cube(Vec3::ZERO, 1.0), cube(Vec3::X * 3.0, 1.0)];
    let tree = BspTree::build(&boxes, &BuildParams::BALANCED).unwrap();
    let ray = Ray::new(Vec3::new(-5.0, 0.0, 0.0), Vec3::X).until(6.0);
    for wrong in [7.0, -1.0, f32::NAN, f32::INFINITY] {
        assert!(tree.closest_hit(&ray, |_, _| Some((wrong, ()))).is_none(), "{wrong} lies outside");
    }
}
