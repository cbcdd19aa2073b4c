//! Polygons and normals against the shapes that they were made from.

use crate::memory::MemoryFiles;
use glam::{DMat3, DQuat, DVec3, Vec3};
use heliostat_geometry::TriMesh;
use heliostat_io::obj::{ObjModel, ObjOptions, parse_obj};
use proptest::prelude::*;
use std::f64::consts::TAU;
use std::path::Path;

fn read(text: &str) -> ObjModel {
    let read =
        parse_obj(Path::new("a.obj"), text.as_bytes(), &ObjOptions::default(), &mut MemoryFiles::default());
    read.expect("a good file")
}

fn vertices(points: impl Iterator<Item = DVec3>) -> String {
    points.map(|p| format!("v {} {} {}\n", p.x as f32, p.y as f32, p.z as f32)).collect()
}

/// A turn, a shift in sizes of the thing, and a size.
fn placement() -> impl Strategy<Value = (DMat3, DVec3, f64)> {
    let unit = || -1.0..1.0_f64;
    (unit(), unit(), unit(), 0.0..TAU, unit(), unit(), -3.0..5.0_f64).prop_map(
        |(x, y, z, angle, u, v, exponent)| {
            let axis = DVec3::new(x, y, z).try_normalize().unwrap_or(DVec3::X);
            (
                DMat3::from_quat(DQuat::from_axis_angle(axis, angle)),
                DVec3::new(u, v, x) * 20.0,
                10_f64.powf(exponent),
            )
        },
    )
}

fn covered(mesh: &TriMesh) -> f64 {
    (0..mesh.triangles.len() as u32).map(|i| mesh.area(i)).sum()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// A border that goes once around a point crosses nothing, however jagged it is.
    #[test]
    fn jagged_polygons_are_covered_once(
        radii in proptest::collection::vec(0.05..1.0_f64, 3..80),
        (turn, shift, size) in placement(),
    ) {
        let n = radii.len() as f64;
        let ring: Vec<_> = (0..).zip(&radii).map(|(i, r)| {
            let (sin, cos) = (TAU * f64::from(i) / n).sin_cos();
            size * (turn * DVec3::new(r * cos, r * sin, 0.0) + shift)
        }).collect();
        let face: String = (1..=ring.len()).map(|i| format!(" {i}")).collect();
        let model = read(&format!("{}f{face}\n", vertices(ring.iter().copied())));
        let mesh = &model.objects[0].mesh;
        prop_assert_eq!(mesh.triangles.len(), ring.len() - 2);
        prop_assert!(model.warnings.is_empty());
        // The shoelace formula on the points as the file has them.
        let rounded: Vec<_> = ring.iter().map(|p| p.as_vec3().as_dvec3() - ring[0]).collect();
        let doubled: DVec3 = rounded.iter().zip(rounded.iter().cycle().skip(1)).map(|(a, b)| a.cross(*b)).sum();
        let expected = 0.5 * doubled.length();
        // Rounding of the vertices, some 20 sizes from the origin, bends the polygon out of its plane.
        prop_assert!((covered(mesh) - expected).abs() < 1e-4 * size * size, "{} {expected}", covered(mesh));
        // All triangles look to the same side as the polygon.
        for t in 0..mesh.triangles.len() as u32 {
            let [a, b, c] = mesh.corners(t).map(|p| p.as_dvec3());
            prop_assert!((b - a).cross(c - a).dot(doubled) >= -1e-5 * size * size * doubled.length());
        }
    }

    /// The normals made for a ball of quads and triangles point away from its centre.
    #[test]
    fn made_normals_of_a_ball_are_radial((turn, shift, size) in placement(), rings in 12_u32..24, around in 24_u32..40) {
        let at = |ring: u32, step: u32| {
            let (sin, cos) = (0.5 * TAU * f64::from(ring) / f64::from(rings)).sin_cos();
            let (sin_step, cos_step) = (TAU * f64::from(step) / f64::from(around)).sin_cos();
            DVec3::new(sin * cos_step, cos, -sin * sin_step)
        };
        let places = (0..=rings).flat_map(|ring| (0..around).map(move |step| (ring, step)));
        let mut text = vertices(places.map(|(ring, step)| size * (turn * at(ring, step) + shift)));
        let index = |ring: u32, step: u32| ring * around + step % around + 1;
        for ring in 0..rings {
            for step in 0..around {
                let quad = [index(ring, step), index(ring + 1, step), index(ring + 1, step + 1), index(ring, step + 1)];
                text += &format!("f {} {} {} {}\n", quad[0], quad[1], quad[2], quad[3]);
            }
        }
        let model = read(&text);
        let mesh = &model.objects[0].mesh;
        mesh.validate().expect("a whole mesh");
        let centre = size * shift;
        for &i in mesh.triangles.iter().flatten() {
            let out = (mesh.positions[i as usize].as_dvec3() - centre).normalize().as_vec3();
            let angle = Vec3::angle_between(mesh.normals[i as usize], out).to_degrees();
            prop_assert!(angle < 3.0, "{angle} degrees off at {}", mesh.positions[i as usize]);
        }
    }
}
