//! The organic model: a sitting bird, the smooth union of a few soft bodies with a coat of feathers.

use super::noise::fractal;
use super::obj::Mesh;
use super::sphere_points::sphere;
use glam::{DVec3, dvec3};

/// Every part of the surface can be seen from here.
const CENTRE: DVec3 = dvec3(0.0, 0.52, 0.02);

/// The bird with `vertices` vertices, `2 * vertices - 4` triangles; it sits on `y = 0` and looks along `+z`.
pub(super) fn mesh(vertices: usize) -> Mesh {
    let mut mesh = sphere(vertices);
    for p in &mut mesh.positions {
        *p = surface_along(*p);
    }
    mesh
}

/// The outermost point of the surface in direction `dir`, moved by the feathers.
fn surface_along(dir: DVec3) -> DVec3 {
    let mut outside = 2.0;
    // Sphere tracing from outside: the distance is a safe step.
    for _ in 0..400 {
        let distance = distance(CENTRE + outside * dir);
        outside -= 0.6 * distance;
        if distance.abs() < 1e-7 || outside < 0.05 {
            break;
        }
    }
    let p = CENTRE + outside * dir;
    p + feathers(p) * dir
}

/// Signed distance to the bare body, a little short where parts blend.
fn distance(p: DVec3) -> f64 {
    let mirrored = dvec3(p.x.abs(), p.y, p.z);
    let body = ellipsoid(p - dvec3(0.0, 0.42, -0.02), dvec3(0.40, 0.42, 0.52));
    let head = (p - dvec3(0.0, 0.90, 0.34)).length() - 0.265;
    let cheek = (mirrored - dvec3(0.10, 0.84, 0.44)).length() - 0.15;
    let wing = ellipsoid(mirrored - dvec3(0.36, 0.46, -0.12), dvec3(0.12, 0.26, 0.46));
    let tail = capsule(p, dvec3(0.0, 0.42, -0.40), dvec3(0.0, 0.52, -1.02), 0.17, 0.07);
    let beak = capsule(p, dvec3(0.0, 0.895, 0.55), dvec3(0.0, 0.86, 0.76), 0.075, 0.012);
    let soft = smooth_union(smooth_union(smooth_union(body, head, 0.18), wing, 0.05), tail, 0.16);
    let whole = smooth_union(smooth_union(soft, cheek, 0.08), beak, 0.025);
    // Flat underneath, so that it sits.
    smooth_max(whole, 0.012 - p.y, 0.04)
}

/// Height of the plumage: rows of scallops that end at the face, and a little disorder.
fn feathers(p: DVec3) -> f64 {
    let face = smoothstep(0.40, 0.62, p.z) * smoothstep(0.70, 0.80, p.y);
    let ground = 1.0 - smoothstep(0.02, 0.10, p.y);
    let disorder = fractal(p * 5.0, 64, 4);
    let row = (p.z - 0.35 * p.y) * 16.0 + 0.5 * disorder;
    let angle = p.x.atan2(p.y - 0.45) * 7.0 + if row.floor() as i64 % 2 == 0 { 0.5 } else { 0.0 };
    let across = (angle.fract().abs() - 0.5).abs();
    // On the chest the columns meet in a point: the rows fade out before they do.
    let chest = smoothstep(0.06, 0.24, p.x.hypot(p.y - 0.45));
    let scallop = chest * (row - row.floor()) * (1.0 - 2.0 * across);
    (1.0 - face) * (1.0 - ground) * (0.016 * scallop + 0.006 * disorder) + 0.002 * disorder
}

/// An ellipsoid by its first-order distance (Quilez, "Distance functions").
fn ellipsoid(p: DVec3, radii: DVec3) -> f64 {
    let k0 = (p / radii).length();
    let k1 = (p / (radii * radii)).length();
    k0 * (k0 - 1.0) / k1.max(1e-9)
}

/// A capsule whose radius goes from `ra` at `a` to `rb` at `b`.
fn capsule(p: DVec3, a: DVec3, b: DVec3, ra: f64, rb: f64) -> f64 {
    let along = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
    (p - a.lerp(b, along)).length() - (ra + (rb - ra) * along)
}

/// The smaller of two distances, rounded over a width of `k` (Quilez, "Smooth minimum").
fn smooth_union(a: f64, b: f64, k: f64) -> f64 {
    let h = (k - (a - b).abs()).max(0.0);
    a.min(b) - if k > 0.0 { h * h / (4.0 * k) } else { 0.0 }
}

fn smooth_max(a: f64, b: f64, k: f64) -> f64 {
    -smooth_union(-a, -b, k)
}

fn smoothstep(from: f64, to: f64, x: f64) -> f64 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
