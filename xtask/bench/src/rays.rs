//! The rays of a comparison: the same for all who take part.

use crate::contestant::Query;
use glam::{Vec2, Vec3};

use heliostat_geometry::{Interval, OrthonormalFrame, Ray, TriMesh};
use heliostat_index::MeshTree;

/// Rays of one kind.
pub(crate) struct RaySet {
    pub(crate) kind: &'static str,
    pub(crate) query: Query,
    pub(crate) rays: Vec<Ray>,
}

/// Primary rays of a square picture, one bounce from each hit, and one shadow ray to a square light.
pub(crate) fn ray_sets(mesh: &TriMesh, tree: &MeshTree, size: usize) -> Vec<RaySet> {
    let bounds = mesh.bounds();
    let (centre, radius) = (bounds.centre(), bounds.radius());
    // The camera looks at the whole from the front, a little from the right and from above; what it sees fills the picture.
    let view = Vec3::new(0.35, 0.3, 1.0).normalize();
    let eye = centre + 2.5 * radius * view;
    let right = Vec3::Y.cross(view).normalize();
    let up = view.cross(right);
    let project = |corner: &Vec3| {
        let to = *corner - eye;
        Vec2::new(to.dot(right), to.dot(up)) / -to.dot(view)
    };
    let nothing = (Vec2::INFINITY, Vec2::NEG_INFINITY);
    let seen = mesh.positions.iter().map(project);
    let (low, high) = seen.fold(nothing, |(low, high), p| (low.min(p), high.max(p)));
    let primary: Vec<Ray> = (0..size * size)
        .map(|i| {
            let at = |k: usize| (k as f32 + 0.5) / size as f32;
            let (x, y) = (low.x + at(i % size) * (high.x - low.x), high.y - at(i / size) * (high.y - low.y));
            Ray::new(eye, (x * right + y * up - view).normalize())
        })
        .collect();

    let light = centre + Vec3::new(0.6, 2.0, 1.2) * radius;
    let (mut diffuse, mut shadow) = (Vec::new(), Vec::new());
    for (i, ray) in primary.iter().enumerate() {
        let Some(found) = tree.closest_hit(ray) else { continue };
        let [a, b, c] = mesh.corners(found.triangle);
        let normal = (b - a).cross(c - a).normalize_or(-ray.dir);
        let normal = if normal.dot(ray.dir) > 0.0 { -normal } else { normal };
        let origin = ray.at(found.hit.t) + 1e-4 * radius * normal;
        let random = |dimension| uniform(i as u32, dimension);
        let (r, phi) = (random(0).sqrt(), std::f32::consts::TAU * random(1));
        let local = Vec3::new(r * phi.cos(), r * phi.sin(), (1.0 - random(0)).max(0.0).sqrt());
        diffuse.push(Ray::new(origin, OrthonormalFrame::around(normal).to_world(local)));
        let target = light + 0.5 * radius * Vec3::new(random(2) - 0.5, 0.0, random(3) - 0.5);
        let range = Interval { min: 0.0, max: 0.9999 };
        shadow.push(Ray { range, ..Ray::new(origin, target - origin) });
    }
    vec![
        RaySet { kind: "primary", query: Query::Closest, rays: primary },
        RaySet { kind: "diffuse", query: Query::Closest, rays: diffuse },
        RaySet { kind: "shadow", query: Query::Any, rays: shadow },
    ]
}

/// In `[0, 1)`, from a number and a dimension.
///
/// # Source
/// Jarzynski and Olano, "Hash Functions for GPU Rendering", JCGT 2020 (`pcg`).
fn uniform(i: u32, dimension: u32) -> f32 {
    let v = (16 * i + dimension).wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
    let word = ((v >> ((v >> 28) + 4)) ^ v).wrapping_mul(277_803_737);
    ((word >> 22 ^ word) >> 8) as f32 / (1 << 24) as f32
}
