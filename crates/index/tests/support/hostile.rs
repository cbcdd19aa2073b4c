//! Meshes and rays that break search trees.

use glam::Vec3;
use heliostat_geometry::{Interval, Ray, TriMesh};
use proptest::prelude::*;

/// A mesh without shared vertices.
pub(crate) fn mesh_of(triangles: impl IntoIterator<Item = [Vec3; 3]>) -> TriMesh {
    let mut mesh = TriMesh::default();
    for corners in triangles {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(corners);
        mesh.triangles.push([first, first + 1, first + 2]);
    }
    mesh
}

fn point() -> impl Strategy<Value = Vec3> {
    [-1.0_f32..1.0, -1.0_f32..1.0, -1.0_f32..1.0].prop_map(Vec3::from_array)
}

/// Few different coordinates: corners, edges and planes coincide, with each other and with split planes.
fn lattice_point() -> impl Strategy<Value = Vec3> {
    [-4_i8..5, -4_i8..5, -4_i8..5].prop_map(|p| Vec3::from_array(p.map(f32::from)) / 4.0)
}

fn triangle() -> impl Strategy<Value = [Vec3; 3]> {
    [point(), point(), point()]
}

fn lattice_triangle() -> impl Strategy<Value = [Vec3; 3]> {
    [lattice_point(), lattice_point(), lattice_point()]
}

/// All in one plane, axis-aligned or not.
fn coplanar() -> impl Strategy<Value = Vec<[Vec3; 3]>> {
    let flat = prop::collection::vec(triangle(), 1..40);
    (flat, 0..3_usize, prop_oneof![Just(0.0), -1.0_f32..1.0]).prop_map(|(mut triangles, axis, slope)| {
        for p in triangles.iter_mut().flatten() {
            p[axis] = 0.25 + slope * p[(axis + 1) % 3];
        }
        triangles
    })
}

/// One triangle again and again, some copies with their corners in another order.
fn copies() -> impl Strategy<Value = Vec<[Vec3; 3]>> {
    (triangle(), 1..60_usize)
        .prop_map(|([a, b, c], n)| (0..n).map(|i| if i % 3 == 0 { [b, c, a] } else { [a, b, c] }).collect())
}

/// Shrinking copies around one point.
fn nested() -> impl Strategy<Value = Vec<[Vec3; 3]>> {
    (triangle(), point(), 1..40_i32).prop_map(|(triangle, centre, n)| {
        (0..n).map(|i| triangle.map(|p| centre + (p - centre) * 0.7_f32.powi(i))).collect()
    })
}

/// Long needles: two corners almost coincide.
fn slivers() -> impl Strategy<Value = Vec<[Vec3; 3]>> {
    let sliver = (point(), point(), point(), prop_oneof![Just(1e-3_f32), Just(1e-6), Just(0.0)]);
    prop::collection::vec(sliver.prop_map(|(a, b, aside, width)| [a, b, a + width * aside]), 1..40)
}

/// A fan around one vertex: no plane separates its neighbourhood.
fn fan() -> impl Strategy<Value = Vec<[Vec3; 3]>> {
    (point(), prop::collection::vec(point(), 2..60))
        .prop_map(|(apex, rim)| rim.windows(2).map(|pair| [apex, pair[0], pair[1]]).collect())
}

/// One huge triangle among tiny ones far from the origin of coordinates.
fn huge_and_tiny() -> impl Strategy<Value = Vec<[Vec3; 3]>> {
    (triangle(), prop::collection::vec(triangle(), 1..40), point()).prop_map(|(huge, tiny, at)| {
        let mut all = vec![huge.map(|p| 1e4 * p)];
        all.extend(tiny.into_iter().map(|t| t.map(|p| 100.0 * at + 1e-2 * p)));
        all
    })
}

/// Steps of a stair: touching boxes, axis-parallel edges.
fn touching() -> impl Strategy<Value = Vec<[Vec3; 3]>> {
    (1..24_u32, 0..3_usize).prop_map(|(n, axis)| {
        let step = |i: u32| {
            let at = |u: f32, v: f32| {
                let mut p = Vec3::splat(v);
                p[axis] = u;
                p[(axis + 1) % 3] = 0.5 * v;
                p
            };
            let (low, high) = (i as f32, i as f32 + 1.0);
            [[at(low, 0.0), at(high, 0.0), at(low, 1.0)], [at(high, 0.0), at(high, 1.0), at(low, 1.0)]]
        };
        (0..n).flat_map(step).collect()
    })
}

/// Any of the above, scaled unevenly and moved off the origin.
pub(crate) fn mesh() -> impl Strategy<Value = TriMesh> {
    let shapes = prop_oneof![
        prop::collection::vec(triangle(), 0..60),
        prop::collection::vec(lattice_triangle(), 1..60),
        coplanar(),
        copies(),
        nested(),
        slivers(),
        fan(),
        huge_and_tiny(),
        touching(),
    ];
    let scale = prop_oneof![Just(Vec3::ONE), Just(Vec3::splat(1e-3)), Just(Vec3::new(1e5, 1.0, 1e2))];
    let shift = prop_oneof![Just(Vec3::ZERO), Just(Vec3::new(3.0, -70.0, 1000.0))];
    (shapes, scale, shift)
        .prop_map(|(shapes, scale, shift)| mesh_of(shapes.into_iter().map(|t| t.map(|p| scale * p + shift))))
}

/// What a ray is made from, before it knows its mesh.
#[derive(Clone, Debug)]
pub(crate) struct RaySeed {
    kind: u8,
    a: Vec3,
    b: Vec3,
    picks: [prop::sample::Index; 3],
    axis: usize,
    negative: bool,
    limits: Option<(f32, f32)>,
}

pub(crate) fn ray_seed() -> impl Strategy<Value = RaySeed> {
    let limits = prop::option::weighted(0.3, (0.0_f32..0.6, 0.3_f32..1.5));
    (0_u8..8, point(), point(), any::<[prop::sample::Index; 3]>(), 0..3_usize, any::<bool>(), limits)
        .prop_map(|(kind, a, b, picks, axis, negative, limits)| RaySeed {
            kind,
            a,
            b,
            picks,
            axis,
            negative,
            limits,
        })
}

impl RaySeed {
    /// The ray, fitted to the mesh: at corners, edges and split planes as often as at open space.
    pub(crate) fn fit(&self, mesh: &TriMesh) -> Ray {
        if mesh.positions.is_empty() {
            return Ray::new(self.a, Vec3::X);
        }
        let bounds = mesh.bounds();
        let (centre, half) = (bounds.centre(), 0.5 * bounds.size());
        let vertex = |i: usize| *self.picks[i].get(&mesh.positions);
        let (inside, outside) = (centre + half * self.a, centre + bounds.radius() * 3.0 * self.b);
        let mut parallel = Vec3::ZERO;
        parallel[self.axis] = if self.negative { -1.0 } else { 1.0 };
        let mut in_plane = parallel;
        in_plane[(self.axis + 1) % 3] = self.a.x;
        let ray = match self.kind {
            0 => Ray::new(outside, inside - outside),
            1 => Ray::new(outside, vertex(0) - outside),
            2 => Ray::new(outside, (vertex(0) + vertex(1)) * 0.5 - outside),
            3 => Ray::new(inside, self.b),
            // Along an axis through a corner; the other axes run in every plane that holds it.
            4 => Ray::new(vertex(0) - 2.0 * bounds.radius() * parallel, parallel),
            // In the plane that halves the root.
            5 => Ray::new(centre - 2.0 * bounds.radius() * in_plane, in_plane),
            // From a corner, and along an edge.
            6 => Ray::new(vertex(0), self.b),
            _ => Ray::new(vertex(0), vertex(1) - vertex(0)),
        };
        let ray = if ray.is_valid() { ray } else { Ray::new(outside, parallel) };
        match self.limits {
            Some((min, max)) => Ray { range: Interval { min, max }, ..ray },
            None => ray,
        }
    }
}
