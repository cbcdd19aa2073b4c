//! Extremes: nothing that comes out is no number, negative or without bound.

use super::*;

/// Surfaces at the ends of all ranges.
fn extremes() -> Vec<StandardPoint> {
    let mut points = Vec::new();
    for (_, change) in LOSSLESS {
        for roughness in [0.0, 0.0157, 0.05, 0.5, 1.0] {
            for ior in [None, Some(0.0), Some(0.5), Some(1.0), Some(1.000_1), Some(1e4)] {
                let mut point = rough(*change, roughness);
                point.ior = ior.unwrap_or(point.ior);
                points.push(point);
                points.push(StandardPoint { base_color: Rgb::ZERO, ..point });
                points.push(StandardPoint { specular: 0.0, base_color: Rgb::new(1.0, 0.0, 0.3), ..point });
            }
        }
    }
    points
}

fn assert_sane(point: &StandardPoint, bsdf: &StandardBsdf, wo: Vec3) {
    for u in lattice(48) {
        if let Some(sample) = bsdf.seen_from(wo).sample(u) {
            let weight = sample.weight;
            assert!(weight.is_finite() && weight.min_element() >= 0.0, "{point:?} {wo} {u}: {sample:?}");
            assert!(
                sample.pdf > 0.0 && (sample.wi.length() - 1.0).abs() < 1e-4,
                "{point:?} {wo} {u}: {sample:?}"
            );
        }
        let wi = direction(2.0 * u.x - 1.0, u.y);
        let (value, pdf) = (bsdf.seen_from(wo).answer(wi).0, bsdf.seen_from(wo).answer(wi).1);
        assert!(value.is_finite() && value.min_element() >= 0.0, "{point:?} {wo} {wi}: {value}");
        assert!(pdf.is_finite() && pdf >= 0.0, "{point:?} {wo} {wi}: {pdf}");
    }
    let albedo = bsdf.seen_from(wo).albedo();
    assert!(albedo.is_finite() && albedo.min_element() >= 0.0, "{point:?} {wo}: {albedo}");
}

#[test]
fn bsdf_extremes_are_numbers() {
    for point in extremes() {
        for is_outside in [true, false] {
            let bsdf = StandardBsdf::new(&point, is_outside, Vec3::new(0.6, 0.0, 0.8));
            for cos in [1.0, 0.5, 1e-3, 1e-7, 1e-20, 1e-38] {
                assert_sane(&point, &bsdf, viewer(cos));
            }
        }
    }
}
