//! Meshes: what a hit knows of the surface, made normals, and what `validate` refuses.

use glam::{Vec2, Vec3};
use heliostat_geometry::strategies::{Random, box_grid, displaced_sphere, grid, icosphere, torus_mesh};
use heliostat_geometry::triangle::{TriangleHit, TriangleRay, intersect};
use heliostat_geometry::{MeshError, Ray, Transform, TriMesh};

/// One triangle with everything a vertex can have.
fn rich_triangle() -> TriMesh {
    TriMesh {
        positions: vec![Vec3::new(1.0, 0.0, 0.0), Vec3::new(5.0, 0.0, 0.0), Vec3::new(1.0, 2.0, 0.0)],
        normals: vec![Vec3::Z, Vec3::X, Vec3::Y],
        uvs: vec![Vec2::new(0.1, 0.2), Vec2::new(0.9, 0.2), Vec2::new(0.1, 0.8)],
        colors: vec![Vec3::X, Vec3::Y, Vec3::Z],
        triangles: vec![[0, 1, 2]],
        slots: vec![3],
        ..TriMesh::default()
    }
}

#[test]
fn a_hit_blends_what_the_vertices_have() {
    let mesh = rich_triangle();
    let hit = TriangleHit { t: 7.0, barycentric: [0.25, 0.5, 0.25] };
    let surface = mesh.surface(0, &hit);
    assert_eq!(surface.t, 7.0);
    assert_eq!(surface.p.as_vec3(), Vec3::new(3.0, 0.5, 0.0));
    assert_eq!(surface.ng.normalize().as_vec3(), Vec3::Z);
    assert_eq!(surface.ns.as_vec3(), Vec3::new(0.5, 0.25, 0.25));
    assert!(surface.uv.distance(Vec2::new(0.5, 0.35)) < 1e-6);
    // Along u the position grows by 4 per 0.8, along v by 2 per 0.6.
    assert!(surface.dpdu.distance(Vec3::new(5.0, 0.0, 0.0)) < 1e-5);
    assert!(surface.dpdv.distance(Vec3::new(0.0, 2.0 / 0.6, 0.0)) < 1e-5);
    assert_eq!(mesh.color(0, &hit), Some(Vec3::new(0.25, 0.5, 0.25)));
    assert_eq!((mesh.slot(0), mesh.area(0)), (3, 4.0));
}

#[test]
fn a_bare_mesh_gives_weights_as_parameters_and_no_shading_normal() {
    let mesh = TriMesh { normals: vec![], uvs: vec![], colors: vec![], slots: vec![], ..rich_triangle() };
    let hit = TriangleHit { t: 1.0, barycentric: [0.25, 0.5, 0.25] };
    let surface = mesh.surface(0, &hit);
    assert_eq!((surface.uv, surface.ns.length()), (Vec2::new(0.5, 0.25), 0.0));
    assert_eq!((surface.dpdu, surface.dpdv), (Vec3::new(4.0, 0.0, 0.0), Vec3::new(0.0, 2.0, 0.0)));
    assert_eq!((mesh.color(0, &hit), mesh.slot(0)), (None, 0));
    // Texture coordinates without area have no tangents.
    let flat = TriMesh { uvs: vec![Vec2::ONE; 3], ..rich_triangle() };
    assert_eq!(flat.surface(0, &hit).dpdu, Vec3::ZERO);
}

/// In world space a shading normal never looks to the other side, mirrors included.
#[test]
fn normals_keep_their_side_under_any_transform() {
    let mut random = Random::new(60);
    let mesh = icosphere(1);
    for _ in 0..2_000 {
        let place = random.transform(1e-2, 1e2, 10.0);
        let centre = place.point(Vec3::ZERO);
        let ray = Ray::new(centre, random.direction());
        let local = place.ray_to_local(&ray);
        let found = (0..mesh.triangles.len() as u32)
            .find_map(|i| Some((i, intersect(&TriangleRay::new(&local), ray.range, mesh.corners(i))?)));
        let (triangle, hit) = found.unwrap();
        let world = place.hit_to_world(&mesh.surface(triangle, &hit));
        assert!(world.at.ng.dot(ray.dir) > 0.0 && world.ns.dot(world.at.ng) > 0.0, "{place:?}");
        assert!((world.ns.length() - 1.0).abs() < 1e-5);
        let on_ray = ray.at(world.t);
        assert!(on_ray.distance(world.at.p) < 1e-5 * (centre.length() + on_ray.distance(centre)));
    }
}

#[test]
fn samples_of_a_triangle_are_even_and_lie_on_it() {
    let mut random = Random::new(61);
    let mesh = rich_triangle();
    let n = 20_000;
    let mut mean = glam::DVec3::ZERO;
    for _ in 0..n {
        let sample = mesh.sample_triangle(0, random.square());
        assert_eq!((sample.pdf, sample.p.z), (0.25, 0.0));
        assert!(
            sample.p.x >= 1.0
                && sample.p.y >= 0.0
                && (sample.p.x - 1.0) / 4.0 + sample.p.y / 2.0 <= 1.0 + 1e-7
        );
        mean += sample.p / f64::from(n);
    }
    // The centroid, within 5 deviations of the mean of n points.
    assert!(mean.distance(glam::DVec3::new(7.0 / 3.0, 2.0 / 3.0, 0.0)) < 5.0 * 1.05 / f64::from(n).sqrt());
}

#[test]
fn made_normals_of_a_sphere_point_away_from_its_centre() {
    for mut mesh in [icosphere(3), displaced_sphere(3, 0.0, 1)] {
        mesh.normals.clear();
        let vertices = mesh.positions.len();
        mesh.compute_normals(1.0);
        mesh.validate().unwrap();
        assert_eq!(mesh.positions.len(), vertices, "nothing is sharp enough to split");
        for (n, p) in mesh.normals.iter().zip(&mesh.positions) {
            assert!(n.dot(*p) > 0.9999, "{n} at {p}");
        }
    }
    // A torus has known normals at its vertices too.
    let exact = torus_mesh(1.0, 0.4, 64, 48);
    let mut made = TriMesh { normals: vec![], ..exact.clone() };
    made.compute_normals(0.6);
    for (n, m) in made.normals.iter().zip(&exact.normals) {
        assert!(n.dot(*m) > 0.999, "{n} {m}");
    }
}

#[test]
fn made_normals_of_a_box_are_sharp_at_its_edges() {
    let mut mesh = box_grid(3);
    mesh.compute_normals(60.0_f32.to_radians());
    mesh.validate().unwrap();
    // Each face keeps a lattice of 4 x 4 vertices of its own.
    assert_eq!(mesh.positions.len(), 6 * 16);
    for triangle in 0..mesh.triangles.len() as u32 {
        let [a, b, c] = mesh.corners(triangle);
        let face = (b - a).cross(c - a).normalize();
        for v in mesh.triangles[triangle as usize] {
            assert!(mesh.normals[v as usize].distance(face) < 1e-6);
        }
    }
    // With an angle above the right one the corners are round and symmetric, however the faces are cut.
    let mut round = box_grid(1);
    round.compute_normals(100.0_f32.to_radians());
    assert_eq!(round.positions.len(), 8);
    for (n, p) in round.normals.iter().zip(&round.positions) {
        assert!(n.distance(p.normalize()) < 1e-6, "{n} at {p}");
    }
}

#[test]
fn made_normals_survive_seams_and_degenerate_triangles() {
    // Two coplanar squares whose shared border has two vertices per position, and a triangle without area.
    let mut mesh = grid(1);
    let second: Vec<Vec3> = mesh.positions.iter().map(|p| *p + Vec3::new(2.0, 0.0, 0.0)).collect();
    mesh.positions.extend(second);
    mesh.uvs.extend(mesh.uvs.clone());
    mesh.triangles.extend([[4, 5, 7], [4, 7, 6], [0, 0, 1], [0, 1, 1]]);
    mesh.normals.clear();
    mesh.compute_normals(0.5);
    mesh.validate().unwrap();
    assert_eq!(mesh.positions.len(), 8);
    assert!(mesh.normals.iter().all(|n| n.distance(Vec3::Y) < 1e-6), "{:?}", mesh.normals);

    let mut nothing = TriMesh::default();
    nothing.compute_normals(0.5);
    assert_eq!(nothing, TriMesh::default());
}

/// The normal at a vertex does not depend on how its polygons are cut into triangles.
#[test]
fn made_normals_ignore_the_diagonals() {
    let positions = || box_grid(1).positions;
    let quads = box_grid(1).triangles;
    for flip in 0..6 {
        let mut triangles = quads.clone();
        let [[a, b, d], [_, _, c]] = [quads[2 * flip], quads[2 * flip + 1]];
        (triangles[2 * flip], triangles[2 * flip + 1]) = ([a, b, c], [b, d, c]);
        let mut mesh = TriMesh { positions: positions(), triangles, ..TriMesh::default() };
        mesh.compute_normals(2.0);
        for (n, p) in mesh.normals.iter().zip(positions()) {
            assert!(n.distance(p.normalize()) < 1e-6, "{n} at {p}");
        }
    }
}

#[test]
fn validate_names_what_is_wrong() {
    let good = rich_triangle();
    assert_eq!(good.validate(), Ok(()));
    let check = |change: fn(&mut TriMesh), expected: MeshError, text: &str| {
        let mut mesh = rich_triangle();
        change(&mut mesh);
        let error = mesh.validate().unwrap_err();
        assert_eq!(error, expected);
        assert_eq!(error.to_string(), text);
    };
    check(
        |m| m.uvs.truncate(2),
        MeshError::Length { array: "uvs", found: 2, expected: 3 },
        "the mesh has 2 uvs where it needs 3 or none",
    );
    check(
        |m| m.slots = vec![0, 0],
        MeshError::Length { array: "slots", found: 2, expected: 1 },
        "the mesh has 2 slots where it needs 1 or none",
    );
    check(
        |m| m.triangles[0][1] = 3,
        MeshError::Index { triangle: 0, vertex: 3, vertices: 3 },
        "triangle 0 names vertex 3, but there are only 3",
    );
    check(
        |m| m.positions[2].y = f32::NAN,
        MeshError::NotFinite { array: "positions", vertex: 2 },
        "positions of vertex 2 are not finite numbers",
    );
    check(
        |m| m.normals[1].x = f32::INFINITY,
        MeshError::NotFinite { array: "normals", vertex: 1 },
        "normals of vertex 1 are not finite numbers",
    );
}

#[test]
fn a_pose_of_a_mesh_hit_keeps_the_identity_exact() {
    let mesh = rich_triangle();
    let hit = TriangleHit { t: 1.0, barycentric: [0.5, 0.25, 0.25] };
    let world = Transform::IDENTITY.hit_to_world(&mesh.surface(0, &hit));
    assert_eq!(world.at.p, Vec3::new(2.0, 0.5, 0.0));
}

/// A vertex shared by a whole mesh costs no more than many small ones.
#[test]
fn made_normals_of_a_large_fan_are_those_of_a_small_one() {
    let cone = |sides: u32| {
        let mut positions = vec![Vec3::new(0.0, 1.0, 0.0)];
        let angle = |k: u32| std::f32::consts::TAU * k as f32 / sides as f32;
        positions.extend((0..sides).map(|k| Vec3::new(angle(k).sin(), 0.0, angle(k).cos())));
        let triangles = (0..sides).map(|k| [0, 1 + k, 1 + (k + 1) % sides]).collect();
        let mut mesh = TriMesh { positions, triangles, ..TriMesh::default() };
        mesh.compute_normals(0.6);
        mesh
    };
    let (small, large) = (cone(1000), cone(200_000));
    // The same place on the cone: the apex corner and the rim of the first triangle.
    for corner in 0..2 {
        let normal = |mesh: &TriMesh| mesh.normals[mesh.triangles[0][corner] as usize];
        assert!(normal(&small).dot(normal(&large)) > 0.99, "{} {}", normal(&small), normal(&large));
    }
    // All triangles on one spot have no area and no order.
    let mut spot =
        TriMesh { positions: vec![Vec3::ONE; 3], triangles: vec![[0, 1, 2]; 300_000], ..TriMesh::default() };
    spot.compute_normals(0.6);
    spot.validate().unwrap();
}
