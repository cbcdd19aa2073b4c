//! What an OBJ file says, as plain arrays.

use super::face::Corner;
use super::warnings::Warnings;
use glam::{Vec2, Vec3};

/// The state that applies to faces: all faces between two changes share one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Attributes {
    /// Index into [`RawObj::groups`].
    pub(super) group: u32,
    /// Index into [`RawObj::material_names`]; `None` before the first `usemtl`.
    pub(super) material: Option<u32>,
    /// `None` where the file does not say, 0 for flat.
    pub(super) smoothing: Option<u32>,
}

/// A polygon: a range of [`RawObj::corners`] that ends where the next face starts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    /// Its first corner.
    pub(super) first: u32,
    /// Index into [`RawObj::attributes`].
    pub(super) attributes: u32,
    /// Byte offset of its statement, for messages.
    pub(super) offset: u32,
}

/// The name of an object and of its group; empty where the file gives none.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub(super) struct GroupName {
    pub(super) object: String,
    pub(super) group: String,
}

/// What an OBJ file says.
#[derive(Debug, Default)]
pub(super) struct RawObj {
    pub(super) positions: Vec<Vec3>,
    /// Colours as written, for the vertices that have one; empty or as many as positions.
    pub(super) colors: Vec<Option<Vec3>>,
    pub(super) uvs: Vec<Vec2>,
    pub(super) normals: Vec<Vec3>,
    pub(super) corners: Vec<Corner>,
    pub(super) faces: Vec<Face>,
    pub(super) attributes: Vec<Attributes>,
    pub(super) groups: Vec<GroupName>,
    pub(super) material_names: Vec<String>,
    /// Offsets of the first `usemtl` of each material name.
    pub(super) material_offsets: Vec<usize>,
    /// Arguments of the `mtllib` statements, with their offsets.
    pub(super) libraries: Vec<(String, usize)>,
    pub(super) warnings: Warnings,
}

impl RawObj {
    /// The range of corners of face `i`.
    pub(super) fn corners_of(&self, i: usize) -> std::ops::Range<usize> {
        let end = self.faces.get(i + 1).map_or(self.corners.len(), |next| next.first as usize);
        self.faces[i].first as usize..end
    }

    /// The attributes of face `i`.
    pub(super) fn attributes_of(&self, i: usize) -> Attributes {
        self.attributes[self.faces[i].attributes as usize]
    }

    /// Colours are in `[0, 1]`, but some programs write 0 to 255.
    pub(super) fn scale_byte_colors(&mut self) {
        let largest = self.colors.iter().flatten().fold(0.0_f32, |most, c| most.max(c.max_element()));
        if largest > 1.0 {
            self.colors.iter_mut().flatten().for_each(|c| *c /= 255.0);
        }
    }
}
