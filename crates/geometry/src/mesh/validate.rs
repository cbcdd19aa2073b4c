//! What makes a mesh whole: arrays that fit together and finite numbers.

use super::TriMesh;
use std::fmt;

/// Why a mesh cannot be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MeshError {
    /// A vertex array is neither empty nor as long as the positions, or the slots as long as the triangles.
    Length {
        /// Which array, by the name of its field.
        array: &'static str,
        /// Its length.
        found: usize,
        /// The length it must have, if not 0.
        expected: usize,
    },
    /// A triangle names a vertex that does not exist.
    Index {
        /// The triangle.
        triangle: usize,
        /// The vertex it names.
        vertex: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A number of a vertex is infinite or not a number.
    NotFinite {
        /// Which array, by the name of its field.
        array: &'static str,
        /// The vertex.
        vertex: usize,
    },
    /// There are more triangles or vertices than a `u32` can count.
    TooLarge,
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Length { array, found, expected } => {
                write!(f, "the mesh has {found} {array} where it needs {expected} or none")
            }
            Self::Index { triangle, vertex, vertices } => {
                write!(f, "triangle {triangle} names vertex {vertex}, but there are only {vertices}")
            }
            Self::NotFinite { array, vertex } => {
                write!(f, "{array} of vertex {vertex} are not finite numbers")
            }
            Self::TooLarge => write!(f, "the mesh has more than {} triangles or vertices", u32::MAX),
        }
    }
}

impl std::error::Error for MeshError {}

impl TriMesh {
    /// Checks that every other method can be called without a panic.
    ///
    /// # Errors
    /// The first thing that is wrong: array lengths, then indices, then numbers that are not finite.
    pub fn validate(&self) -> Result<(), MeshError> {
        let vertices = self.positions.len();
        if vertices.max(self.triangles.len()) > u32::MAX as usize {
            return Err(MeshError::TooLarge);
        }
        let fits = |array, found, expected| {
            if found == 0 || found == expected {
                Ok(())
            } else {
                Err(MeshError::Length { array, found, expected })
            }
        };
        fits("normals", self.normals.len(), vertices)?;
        fits("uvs", self.uvs.len(), vertices)?;
        fits("uvs1", self.uvs1.len(), vertices)?;
        fits("tangents", self.tangents.len(), vertices)?;
        fits("colors", self.colors.len(), vertices)?;
        fits("opacities", self.opacities.len(), vertices)?;
        fits("slots", self.slots.len(), self.triangles.len())?;
        for (triangle, corners) in self.triangles.iter().enumerate() {
            if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= vertices) {
                return Err(MeshError::Index { triangle, vertex, vertices });
            }
        }
        let finite = |array, bad: Option<usize>| match bad {
            Some(vertex) => Err(MeshError::NotFinite { array, vertex }),
            None => Ok(()),
        };
        finite("positions", self.positions.iter().position(|v| !v.is_finite()))?;
        finite("normals", self.normals.iter().position(|v| !v.is_finite()))?;
        finite("uvs", self.uvs.iter().position(|v| !v.is_finite()))?;
        finite("uvs1", self.uvs1.iter().position(|v| !v.is_finite()))?;
        finite("tangents", self.tangents.iter().position(|v| !v.is_finite()))?;
        finite("colors", self.colors.iter().position(|v| !v.is_finite()))?;
        finite("opacities", self.opacities.iter().position(|v| !v.is_finite()))
    }
}
