//! Two meshes that ask for different trees.

use glam::Vec3;
use heliostat_geometry::TriMesh;
use heliostat_geometry::strategies::Random;
use std::fmt;

/// A mesh by its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shape {
    /// Hills: even triangles side by side, as scans and sculptures have them.
    Hills,
    /// Long thin triangles in all directions across each other, as cables and grass: boxes fit them badly.
    Needles,
}

impl fmt::Display for Shape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Hills => "hills",
            Self::Needles => "needles",
        })
    }
}

impl Shape {
    /// The mesh of about so many triangles, about as large as the unit sphere.
    pub(crate) fn mesh(self, triangles: usize) -> TriMesh {
        match self {
            Self::Hills => hills(triangles),
            Self::Needles => needles(triangles),
        }
    }
}

fn hills(triangles: usize) -> TriMesh {
    let n = (triangles as f64 / 2.0).sqrt().max(1.0) as u32;
    let row = n + 1;
    let at = |i: u32| {
        let place = |k: u32| 2.0 * k as f32 / n as f32 - 1.0;
        let (x, z) = (place(i % row), place(i / row));
        let height = 0.2 * (5.0 * x).sin() * (4.0 * z).cos() + 0.03 * (31.0 * x + 23.0 * z).sin();
        Vec3::new(x, height, z)
    };
    let cell = |i: u32| {
        let corner = i / n * row + i % n;
        [[corner, corner + row, corner + 1], [corner + 1, corner + row, corner + row + 1]]
    };
    TriMesh {
        positions: (0..row * row).map(at).collect(),
        triangles: (0..n * n).flat_map(cell).collect(),
        ..TriMesh::default()
    }
}

fn needles(triangles: usize) -> TriMesh {
    let mut random = Random::new(1);
    let mut needle = || {
        let from = random.cube();
        let along = 0.3 * random.unit() * random.direction();
        [from, from + along, from + along + 0.003 * random.direction()]
    };
    TriMesh {
        positions: (0..triangles).flat_map(|_| needle()).collect(),
        triangles: (0..triangles as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        ..TriMesh::default()
    }
}
