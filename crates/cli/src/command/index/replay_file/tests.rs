//! Made-up disagreements: no index gives any.

use super::{Found, read, save};
use crate::command::index::test_scene::{disagreement, scene};
use heliostat_geometry::{Interval, Ray};

fn there_and_back(found: &[Found]) -> Vec<Ray> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.jsonl");
    save(&path, &scene(), found, 0).unwrap();
    let rays = read(&path, &scene()).unwrap();
    assert_eq!(rays.iter().map(|r| r.line).collect::<Vec<_>>(), (1..=found.len()).collect::<Vec<_>>());
    assert!(rays.iter().zip(found).all(|(r, f)| (r.mesh, r.number) == (f.0, f.1.number)));
    rays.into_iter().map(|r| r.ray).collect()
}

#[test]
fn every_float_comes_back_to_the_bit() {
    // From all exponents, both signs, and the borders.
    let mut bits: Vec<u32> = (0..20_000_u32).map(|i| i.wrapping_mul(0x9E37_79B9)).collect();
    bits.extend([0, 1, 0x8000_0000, 0x007F_FFFF, 0x0080_0000, 0x7F7F_FFFF, 0x3F80_0001, 0x3DCC_CCCD]);
    let floats: Vec<f32> = bits.into_iter().map(f32::from_bits).filter(|x| x.is_finite()).collect();
    let found: Vec<Found> = floats
        .chunks_exact(8)
        .map(|x| {
            let range = Interval { min: x[6].min(x[7]), max: x[6].max(x[7]) };
            let ray = Ray { range, ..Ray::new([x[0], x[1], x[2]].into(), [x[3], x[4], x[5]].into()) };
            (0, disagreement(ray))
        })
        .collect();
    let bits = |ray: &Ray| {
        let Ray { origin: o, dir: d, range } = ray;
        [o.x, o.y, o.z, d.x, d.y, d.z, range.min, range.max].map(f32::to_bits)
    };
    let expected: Vec<_> = found.iter().map(|(_, wrong)| bits(&wrong.ray)).collect();
    let rays = there_and_back(&found);
    assert!(rays.iter().map(bits).eq(expected));
}

#[test]
fn a_ray_without_end_stays_without_end() {
    let ray = Ray::new([0.1, 0.2, 1.0].into(), [0.0, 0.0, -0.3].into());
    assert_eq!(there_and_back(&[(0, disagreement(ray))]), [ray]);
}
