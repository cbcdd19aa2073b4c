//! The promise of the error bounds: a spawned ray never meets the surface it leaves, at any scale and place.

mod common;

use common::{KINDS, depth};
use glam::{DVec3, Vec3};
use heliostat_geometry::ray::LocalRay;
use heliostat_geometry::shape::{Plane, Shape};
use heliostat_geometry::strategies::Random;
use heliostat_geometry::triangle::{TriangleRay, intersect};
use heliostat_geometry::{Hit, Ray, SurfacePoint, Transform, TriMesh};

/// Cases per kind of shape.
const CASES: usize = 100_000;

/// Directions closer to the tangent plane than this are beyond an `f32` normal: its own rounding is 6e-8.
const GRAZING: f64 = 3e-7;

/// A shape at a place, with a point on it.
struct Placed {
    shape: Shape,
    place: Transform,
    at: SurfacePoint,
}

/// A random point on a shape under a random transform, by sampling or by a camera ray.
fn placed(random: &mut Random, kind: usize) -> Option<Placed> {
    let shape = random.shape_of(kind);
    let place = match random.below(4) {
        0 => Transform::IDENTITY,
        _ => random.transform(1e-3, 1e5, 1e4),
    };
    let sample = shape.geometry().sample(random.square())?;
    let at = place.sample_to_world(&sample).at;
    if random.below(2) == 0 {
        return Some(Placed { shape, place, at });
    }
    // The same region, but as a ray from afar finds it.
    let towards = random.direction();
    let distance = random.magnitude(1.0, 1e3) * place.vector(Vec3::ONE).length();
    let hit = world_hit(&shape, &place, &Ray::new(at.p - distance * towards, towards))?;
    Some(Placed { shape, place, at: hit.at })
}

fn world_hit(shape: &Shape, place: &Transform, ray: &Ray) -> Option<Hit> {
    let local = place.local_ray(ray);
    shape.hit(&local).map(|root| place.hit_to_world(&shape.geometry().surface(&local, root)))
}

/// A direction at any angle to `n`, often grazing.
fn direction(random: &mut Random, n: Vec3) -> Vec3 {
    let dir = random.direction();
    if random.below(2) == 0 {
        return dir * random.magnitude(1e-3, 1e3);
    }
    let across = n.cross(dir).normalize_or_zero();
    across + random.magnitude(1e-6, 1e-1) * [1.0, -1.0][random.below(2)] * n
}

fn cosine(n: Vec3, dir: Vec3) -> f64 {
    n.as_dvec3().dot(dir.as_dvec3().normalize_or_zero())
}

/// Whether every line meets the boundary at most twice, or once for a flat shape.
fn is_convex(shape: &Shape) -> bool {
    match shape {
        Shape::Cylinder(s) => s.capped,
        Shape::Cone(s) => s.capped,
        Shape::Torus(_) => false,
        _ => true,
    }
}

/// Whether numbers are fine enough there to tell the inside: a shape thinner than their spacing has none, and within
/// their spacing of an edge the point itself may be rounded out of the other face.
fn is_resolved(placed: &Placed) -> bool {
    let bounds = placed.shape.geometry().bounds();
    let columns = [Vec3::X, Vec3::Y, Vec3::Z].map(|axis| placed.place.vector(axis).length());
    let thickness = bounds.size().min_element() * columns[0].min(columns[1]).min(columns[2]);
    let error = placed.at.p_err.max_element();
    let below = placed.at.p - 10.0 * error * placed.at.ng;
    let around = [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z];
    let is_inside = |p: Vec3| {
        let local = placed.place.local_ray(&Ray::new(p, Vec3::X)).origin;
        depth(&placed.shape, local).is_some_and(|depth| depth > 0.0)
    };
    thickness > 1e3 * error && around.iter().all(|axis| is_inside(below + 5.0 * error * *axis))
}

#[test]
fn outward_rays_never_meet_the_convex_shape_they_leave() {
    let mut random = Random::new(10);
    for kind in KINDS {
        let (mut cases, mut failures) = (0, 0);
        while cases < CASES {
            let Some(placed) = placed(&mut random, kind) else { continue };
            let dir = direction(&mut random, placed.at.ng);
            let cosine = cosine(placed.at.ng, dir);
            let is_flat = depth(&placed.shape, DVec3::ZERO).is_none();
            cases += 1;
            if !is_convex(&placed.shape) || cosine.abs() < GRAZING || (cosine < 0.0 && !is_flat) {
                continue;
            }
            let ray = placed.place.local_ray(&placed.at.spawn(dir));
            failures += usize::from(placed.shape.hit(&ray).is_some());
        }
        assert_eq!(failures, 0, "of {CASES} for kind {kind}");
    }
}

/// A spawned ray starts on the side that it goes to, so that a parity of crossings holds from there on.
#[test]
fn origins_are_on_the_side_of_the_direction() {
    let mut random = Random::new(11);
    for kind in KINDS {
        let (mut checked, mut failures) = (0, 0);
        for _ in 0..CASES {
            let Some(placed) = placed(&mut random, kind) else { continue };
            let dir = direction(&mut random, placed.at.ng);
            let cosine = cosine(placed.at.ng, dir);
            let ray = placed.place.local_ray(&placed.at.spawn(dir));
            let Some(depth) = depth(&placed.shape, ray.origin) else { continue };
            let is_hole = matches!(placed.shape, Shape::Torus(_));
            if cosine.abs() < GRAZING || ((cosine < 0.0 || is_hole) && !is_resolved(&placed)) {
                continue;
            }
            checked += 1;
            let wrong = if cosine > 0.0 { depth >= 0.0 } else { depth <= 0.0 };
            failures += usize::from(wrong);
        }
        assert_eq!(failures, 0, "of {checked} for kind {kind}");
    }
}

/// Inside a closed solid, every ray gets out.
#[test]
fn inward_rays_find_the_way_out() {
    let mut random = Random::new(12);
    for kind in KINDS {
        let mut failures = 0;
        for _ in 0..CASES {
            let Some(placed) = placed(&mut random, kind) else { continue };
            let dir = direction(&mut random, placed.at.ng);
            if depth(&placed.shape, DVec3::ZERO).is_none()
                || cosine(placed.at.ng, dir) > -GRAZING
                || !is_resolved(&placed)
            {
                continue;
            }
            let ray = placed.place.local_ray(&placed.at.spawn(dir));
            failures += usize::from(placed.shape.hit(&ray).is_none());
        }
        assert_eq!(failures, 0, "kind {kind}");
    }
}

/// From a torus, every hit is a real crossing: halfway to it the ray is on the side where it started.
#[test]
fn spawned_rays_meet_a_torus_only_where_it_is() {
    let mut random = Random::new(13);
    let mut hits = 0;
    for _ in 0..CASES {
        let Some(placed) = placed(&mut random, 6) else { continue };
        let dir = direction(&mut random, placed.at.ng);
        if !is_resolved(&placed) || cosine(placed.at.ng, dir).abs() < GRAZING {
            continue;
        }
        let ray = placed.place.local_ray(&placed.at.spawn(dir));
        let Some(root) = placed.shape.hit(&ray) else { continue };
        hits += 1;
        let depth_at = |t: f64| depth(&placed.shape, ray.at(t)).unwrap();
        assert!(depth_at(0.5 * root.t) * depth_at(0.0) > 0.0, "{:?} {ray:?} {root:?}", placed.shape);
    }
    assert!(hits > CASES / 10);
}

/// The infinite plane has no far side to come back to: a spawned ray meets it never again, near or far.
#[test]
fn rays_never_meet_the_plane_they_leave() {
    let mut random = Random::new(17);
    let plane = Shape::Plane(Plane);
    let (mut checked, mut failures) = (0, 0);
    for _ in 0..5 * CASES {
        let place = random.transform(1e-3, 1e5, 1e4);
        let camera = Ray::new(random.magnitude(1.0, 1e4) * random.cube(), random.direction());
        let Some(hit) = world_hit(&plane, &place, &camera) else { continue };
        let dir = direction(&mut random, hit.at.ng);
        if cosine(hit.at.ng, dir).abs() < GRAZING {
            continue;
        }
        checked += 1;
        failures += usize::from(plane.hit(&place.local_ray(&hit.spawn(dir))).is_some());
    }
    assert_eq!(failures, 0, "of {checked}");
}

/// Two convex shapes that see each other: the shadow ray between points of theirs meets neither.
#[test]
fn shadow_rays_between_shapes_are_free() {
    let mut random = Random::new(14);
    let mut checked = 0;
    for _ in 0..4 * CASES {
        let kinds = [0, 1, 2, 3, 4, 5, 7];
        let (a, b) = (kinds[random.below(7)], kinds[random.below(7)]);
        let (Some(a), Some(b)) = (placed(&mut random, a), placed(&mut random, b)) else { continue };
        let way = b.at.p - a.at.p;
        let faces = cosine(a.at.ng, way) > 1e-5 && cosine(b.at.ng, -way) > 1e-5;
        if !faces || !is_convex(&a.shape) || !is_convex(&b.shape) {
            continue;
        }
        checked += 1;
        let shadow = a.at.spawn_to_surface(&b.at);
        for (name, placed) in [("start", &a), ("end", &b)] {
            let ray: LocalRay = placed.place.local_ray(&shadow);
            let hit = placed.shape.hit(&ray);
            assert!(hit.is_none(), "{name}: {:?} {:?} {shadow:?} {hit:?}", placed.shape, placed.place);
        }
    }
    assert!(checked > CASES / 4, "{checked}");
}

/// A triangle of a mesh at a place, with a random point of it in world space.
fn placed_triangle(random: &mut Random) -> (TriMesh, Transform, SurfacePoint) {
    let scale = random.magnitude(1e-3, 1e5);
    let offset = [0.0, 1.0, 1e4][random.below(3)] * random.cube();
    let a = random.cube();
    let b = random.cube();
    // Often a sliver.
    let c = match random.below(3) {
        0 => a.lerp(b, random.unit()) + random.magnitude(1e-5, 1e-1) * random.cube(),
        _ => random.cube(),
    };
    let mesh = TriMesh {
        positions: [a, b, c].map(|p| scale * (p + offset)).to_vec(),
        triangles: vec![[0, 1, 2]],
        ..TriMesh::default()
    };
    let place = match random.below(3) {
        0 => Transform::IDENTITY,
        _ => random.transform(1e-3, 1e3, 1e4),
    };
    let sample = mesh.sample_triangle(0, random.square());
    let at = place.surface_point(sample.p, sample.p_err, sample.ng);
    (mesh, place, at)
}

fn mesh_hit(mesh: &TriMesh, place: &Transform, ray: &Ray) -> bool {
    let ray = place.ray_to_local(ray);
    intersect(&TriangleRay::new(&ray), ray.range, mesh.corners(0)).is_some()
}

#[test]
fn rays_never_meet_the_triangle_they_leave() {
    let mut random = Random::new(15);
    let mut failures = 0;
    for _ in 0..5 * CASES {
        let (mesh, place, at) = placed_triangle(&mut random);
        let dir = direction(&mut random, at.ng);
        // The direction is rounded once more on the way to the space of the mesh, whose axes may differ in scale.
        if at.ng == Vec3::ZERO || cosine(at.ng, dir).abs() < 10.0 * GRAZING {
            continue;
        }
        failures += usize::from(mesh_hit(&mesh, &place, &at.spawn(dir)));
    }
    assert_eq!(failures, 0);
}

#[test]
fn shadow_rays_between_triangles_are_free() {
    let mut random = Random::new(16);
    let mut checked = 0;
    for _ in 0..2 * CASES {
        let a = placed_triangle(&mut random);
        let b = placed_triangle(&mut random);
        let way = b.2.p - a.2.p;
        if a.2.ng == Vec3::ZERO || b.2.ng == Vec3::ZERO {
            continue;
        }
        if cosine(a.2.ng, way).abs() < 1e-5 || cosine(b.2.ng, way).abs() < 1e-5 {
            continue;
        }
        checked += 1;
        let shadow = a.2.spawn_to_surface(&b.2);
        assert!(!mesh_hit(&a.0, &a.1, &shadow), "start: {a:?} {shadow:?}");
        assert!(!mesh_hit(&b.0, &b.1, &shadow), "end: {b:?} {shadow:?}");
    }
    assert!(checked > CASES / 4, "{checked}");
}
