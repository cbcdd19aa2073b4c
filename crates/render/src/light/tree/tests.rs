//! Checks of the tree over lights.

use super::*;
use crate::light::cluster::Cone;
use crate::sampler::Sampler;
use glam::Vec3;
use heliostat_geometry::Aabb;
use std::f32::consts::{FRAC_PI_2, PI};

/// Lamps in a cube of side 10, small and large, weak and strong, turned anyhow.
fn lights(count: u32) -> Vec<Cluster> {
    let light = |i: u32| {
        let mut draws = Sampler::new(3, [0, 0], i);
        let p = 10.0 * draws.next_2d().extend(draws.next_1d());
        let axis = heliostat_geometry::warp::square_to_sphere(draws.next_2d());
        let size = 0.2 * draws.next_1d();
        Cluster {
            bounds: Aabb { min: p, max: p + size },
            intensity: 0.01 + draws.next_1d(),
            normals: Cone { axis, angle: if i.is_multiple_of(3) { PI } else { 0.0 } },
            spread: FRAC_PI_2,
            two_sided: i.is_multiple_of(5),
        }
    };
    (0..count).map(light).collect()
}

#[test]
fn lights_are_picked_as_often_as_they_say() {
    let lights = lights(60);
    let tree = LightTree::new(&lights).unwrap();
    for (p, n) in [(Vec3::splat(5.0), Vec3::Y), (Vec3::new(-20.0, 3.0, 1.0), Vec3::X), (Vec3::ZERO, Vec3::Z)]
    {
        let from = Lookout { p, n, time: 0.0, is_open: true };
        let count = 1 << 16;
        let (mut picks, mut missed) = (vec![0_u32; lights.len()], 0_u32);
        for i in 0..count {
            // Below a cluster that might send light there may be none that does.
            let Some((light, probability)) = tree.pick(&from, (i as f32 + 0.5) / count as f32) else {
                missed += 1;
                continue;
            };
            assert!((tree.probability(&from, light) / probability - 1.0).abs() < 1e-4);
            picks[light] += 1;
        }
        let sum: f32 = (0..lights.len()).map(|light| tree.probability(&from, light)).sum();
        assert!((sum + missed as f32 / count as f32 - 1.0).abs() < 1e-3, "{sum} {missed}");
        for (light, picked) in picks.into_iter().enumerate() {
            let expected = tree.probability(&from, light) * count as f32;
            assert!((picked as f32 - expected).abs() < 3.0, "{light}: {picked} for {expected}");
        }
    }
}

#[test]
fn no_light_that_reaches_a_point_is_forgotten() {
    let lights = lights(500);
    let tree = LightTree::new(&lights).unwrap();
    for i in 0..50 {
        let mut draws = Sampler::new(9, [0, 0], i);
        let p = 20.0 * draws.next_2d().extend(draws.next_1d()) - 5.0;
        let n = heliostat_geometry::warp::square_to_sphere(draws.next_2d());
        let from = Lookout { p, n, time: 0.0, is_open: i % 2 == 0 };
        for (light, cluster) in lights.iter().enumerate() {
            let mut beams = Beams::NONE;
            beams.set(3, cluster);
            let reaches = beams.importances(&from)[3] > 0.0;
            assert!(!reaches || tree.probability(&from, light) > 0.0, "{light} {cluster:?}");
        }
    }
}

#[test]
fn lamps_in_one_place_make_a_tree_all_the_same() {
    let lamp = lights(1)[0];
    let tree = LightTree::new(&vec![lamp; 1000]).unwrap();
    let from = Lookout { p: Vec3::splat(-3.0), n: Vec3::Y, time: 0.0, is_open: true };
    let probability = tree.probability(&from, 77);
    assert!(probability == 0.0 || (probability * 1000.0 - 1.0).abs() < 0.1, "{probability}");
}
