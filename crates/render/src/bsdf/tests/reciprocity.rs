//! Directions may be swapped.

use super::*;
use crate::bsdf::phong::PhongBsdf;

/// Pairs of directions on the same side, well away from the horizon.
fn pairs(sign: f32) -> impl Iterator<Item = (Vec3, Vec3)> {
    lattice(64)
        .zip(lattice(128).skip(64))
        .map(move |(a, b)| (direction(0.02 + 0.97 * a.x, a.y), direction(sign * (0.02 + 0.97 * b.x), b.y)))
}

/// `f`, the value without the cosine.
fn f(bsdf: &StandardBsdf, wo: Vec3, wi: Vec3) -> Rgb {
    bsdf.seen_from(wo).answer(wi).0 / wi.z.abs()
}

/// The largest difference between two colours, over their size.
fn difference(a: Rgb, b: Rgb) -> f32 {
    let size = a.abs().max(b.abs()).max_element();
    if size > 0.0 { (a - b).abs().max_element() / size } else { 0.0 }
}

#[test]
fn bsdf_reflection_is_reciprocal() {
    let tinted: (&str, Change) = ("metal, tinted edge", |p| {
        (p.metalness, p.base_color, p.edge_color) = (1.0, Rgb::new(0.9, 0.6, 0.2), Rgb::new(0.3, 1.0, 0.5));
    });
    for (name, change) in LOSSLESS.iter().chain([&tinted]) {
        for roughness in [0.3, 0.6, 1.0] {
            let bsdf = outside(&rough(*change, roughness));
            // A coat over a body takes from refracted light on the way in alone.
            let is_exempt = *name == "coat over glass";
            for (wo, wi) in pairs(1.0).filter(|_| !is_exempt) {
                let error = difference(f(&bsdf, wo, wi), f(&bsdf, wi, wo));
                assert!(error < 2e-4, "{name} {roughness} {wo} {wi}: {error}");
            }
        }
    }
}

#[test]
fn bsdf_thin_walls_are_reciprocal() {
    for (name, change) in LOSSLESS.iter().filter(|(name, _)| name.contains("thin") || *name == "leaf") {
        let bsdf = outside(&rough(*change, 0.5));
        for (wo, wi) in pairs(-1.0) {
            // The same two directions, seen from the other side.
            let error = difference(f(&bsdf, wo, wi), f(&bsdf, -wi, -wo));
            assert!(error < 2e-4, "{name} {wo} {wi}: {error}");
        }
    }
}

/// Kernels of basic radiance: `n_o^2 f(wo, wi) = n_i^2 f(wi, wo)`.
#[test]
fn bsdf_refraction_is_reciprocal_by_the_square_of_the_index() {
    let is_body = |name: &str| name.starts_with("glass") && !name.ends_with("dispersed");
    for (name, change) in LOSSLESS.iter().filter(|(name, _)| is_body(name)) {
        for roughness in [0.4, 0.7, 1.0] {
            let point = rough(*change, roughness);
            let (out, inside) = (outside(&point), StandardBsdf::new(&point, false, Vec3::Z));
            for (wo, wi) in pairs(-1.0) {
                // The frame of the other side: z turned around, and y to keep it right-handed.
                let turned = |w: Vec3| Vec3::new(w.x, -w.y, -w.z);
                // Anisotropic lobes turn with the tangents.
                let (a, b) = (turned(wi), turned(wo));
                let there = point.ior * point.ior * f(&inside, a, b);
                let error = difference(f(&out, wo, wi), there);
                assert!(error < 3e-3, "{name} {roughness} {wo} {wi}: {error}");
            }
        }
    }
}

#[test]
fn what_is_only_matte_is_lamberts() {
    let color = Rgb::new(0.7, 0.4, 0.1);
    for enters in [false, true] {
        let point = StandardPoint { base_color: color, specular: 0.0, roughness: 0.6, ..white() };
        assert_eq!(point.as_matte(), Some(color));
        let (whole, short) = (StandardBsdf::new(&point, enters, Vec3::Z), PhongBsdf::matte(color));
        for at in lattice(200) {
            let (wo, wi) = (direction(at.x, at.y), direction(2.0 * at.z - 1.0, at.x));
            let (value, pdf) = whole.seen_from(wo).answer(wi);
            let (expected, density) = short.eval(wo, wi);
            assert!((value - expected).abs().max_element() < 1e-5, "{enters}: {value} for {expected}");
            assert!((pdf - density).abs() < 1e-5, "{enters}: {pdf} for {density}");
        }
    }
    assert_eq!(StandardPoint { coat: 0.1, specular: 0.0, ..white() }.as_matte(), None);
}
