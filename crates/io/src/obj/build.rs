//! Polygons of the file into one mesh per group, with the materials as slots.

use super::face::{Corner, NONE};
use super::raw::{GroupName, RawObj};
use super::text::SourceText;
use super::triangulate::{Cut, Triangulator};
use super::{ObjObject, Split};
use crate::error::LoadError;
use glam::{Vec2, Vec3};
use heliostat_geometry::TriMesh;
use heliostat_scene::color::srgb_to_linear;
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

/// Corners of one face at most: the time of ear clipping grows with the square.
const MOST_CORNERS: usize = 1 << 14;

/// The objects of the file. `material_of` gives the material for an index of [`RawObj::material_names`], or for none.
pub(super) fn objects(
    source: &SourceText<'_>,
    raw: &mut RawObj,
    split: Split,
    material_of: &dyn Fn(Option<u32>) -> usize,
) -> Result<Vec<ObjObject>, LoadError> {
    let mut faces_of: Vec<Vec<u32>> = vec![Vec::new(); raw.groups.len()];
    for face in 0..raw.faces.len() {
        let group = match split {
            Split::Groups => raw.attributes_of(face).group,
            Split::Whole => 0,
        };
        faces_of[group as usize].push(face as u32);
    }
    let mut triangulator = Triangulator::new();
    let mut taken = HashSet::new();
    let mut objects = Vec::new();
    for (group, faces) in faces_of.iter().enumerate().filter(|(_, faces)| !faces.is_empty()) {
        let mut builder = MeshBuilder::new(raw, material_of);
        for &face in faces {
            builder.face(source, face as usize, &mut triangulator)?;
        }
        let (mesh, materials, crossing) = builder.finish();
        let name = unique(object_name(&raw.groups[group]), &mut taken);
        objects.push(ObjObject { name, mesh: Arc::new(mesh), materials });
        if let Some(face) = crossing {
            let offset = raw.faces[face].offset as usize;
            let message = "this polygon crosses itself or has no area: its triangles are a guess";
            raw.warnings.push(source.warning_at(offset, message).with_help("split it into simple polygons"));
        }
    }
    Ok(objects)
}

fn object_name(group: &GroupName) -> String {
    match (group.object.as_str(), group.group.as_str()) {
        (name, "") | ("", name) => name.to_owned(),
        (object, group) => format!("{object}/{group}"),
    }
}

/// `name`, or `name.2`, `name.3`, ... when it is taken; takes it.
pub(crate) fn unique(name: String, taken: &mut HashSet<String>) -> String {
    if taken.insert(name.clone()) {
        return name;
    }
    let mut number = 2_u64;
    loop {
        let candidate = format!("{name}.{number}");
        if taken.insert(candidate.clone()) {
            return candidate;
        }
        number += 1;
    }
}

/// Collects the triangles of one object.
struct MeshBuilder<'a> {
    raw: &'a RawObj,
    material_of: &'a dyn Fn(Option<u32>) -> usize,
    mesh: TriMesh,
    has_uvs: bool,
    has_colors: bool,
    vertices: HashMap<Corner, u32>,
    materials: Vec<usize>,
    slots: HashMap<usize, u16>,
    /// The last material and its slot: faces come in runs.
    last_slot: Option<(Option<u32>, u16)>,
    /// Vertices of the polygon at hand.
    polygon: Vec<u32>,
    points: Vec<Vec3>,
    /// First face that could not be cut well.
    crossing: Option<usize>,
}

impl<'a> MeshBuilder<'a> {
    fn new(raw: &'a RawObj, material_of: &'a dyn Fn(Option<u32>) -> usize) -> Self {
        Self {
            raw,
            material_of,
            mesh: TriMesh::default(),
            has_uvs: false,
            has_colors: false,
            vertices: HashMap::new(),
            materials: Vec::new(),
            slots: HashMap::new(),
            last_slot: None,
            polygon: Vec::new(),
            points: Vec::new(),
            crossing: None,
        }
    }

    fn face(
        &mut self,
        source: &SourceText<'_>,
        face: usize,
        triangulator: &mut Triangulator,
    ) -> Result<(), LoadError> {
        let corners = &self.raw.corners[self.raw.corners_of(face)];
        let offset = self.raw.faces[face].offset as usize;
        if corners.len() > MOST_CORNERS {
            let message = format!("this face has {} corners, more than {MOST_CORNERS}", corners.len());
            return Err(source.error_at(offset, message).with_help("cut it into smaller faces"));
        }
        let slot = self.slot(face).ok_or_else(|| {
            let message = "this group uses more than 65536 materials";
            source.error_at(offset, message).with_help("split it with `g` lines")
        })?;
        self.polygon.clear();
        self.points.clear();
        for &corner in corners {
            let vertex = self.vertex(corner);
            self.polygon.push(vertex);
            self.points.push(self.mesh.positions[vertex as usize]);
        }
        if triangulator.cut(&self.points) == Cut::Crossing {
            self.crossing.get_or_insert(face);
        }
        let polygon = &self.polygon;
        self.mesh.triangles.extend(triangulator.triangles.iter().map(|t| t.map(|i| polygon[i as usize])));
        self.mesh.slots.resize(self.mesh.triangles.len(), slot);
        Ok(())
    }

    /// The slot of the face's material; `None` when there are too many.
    fn slot(&mut self, face: usize) -> Option<u16> {
        let name = self.raw.attributes_of(face).material;
        if let Some((_, slot)) = self.last_slot.filter(|last| last.0 == name) {
            return Some(slot);
        }
        let material = (self.material_of)(name);
        let slot = match self.slots.get(&material) {
            Some(&slot) => slot,
            None => {
                let slot = u16::try_from(self.materials.len()).ok()?;
                self.materials.push(material);
                self.slots.insert(material, slot);
                slot
            }
        };
        self.last_slot = Some((name, slot));
        Some(slot)
    }

    /// The vertex of the mesh for a corner: corners with the same three indices share one.
    fn vertex(&mut self, corner: Corner) -> u32 {
        let raw = self.raw;
        let mesh = &mut self.mesh;
        *self.vertices.entry(corner).or_insert_with(|| {
            let position = corner.position as usize;
            self.has_uvs |= corner.uv != NONE;
            let color = raw.colors.get(position).copied().flatten();
            self.has_colors |= color.is_some();
            mesh.positions.push(raw.positions[position]);
            mesh.normals.push(raw.normals[corner.normal as usize]);
            mesh.uvs.push(raw.uvs.get(corner.uv as usize).copied().unwrap_or(Vec2::ZERO));
            // Programs that paint vertices show and write them as they appear on the screen.
            mesh.colors.push(color.map_or(Vec3::ONE, |c| c.max(Vec3::ZERO).map(srgb_to_linear)));
            (mesh.positions.len() - 1) as u32
        })
    }

    /// The mesh, its materials by slot, and the first face that was cut by guess.
    fn finish(mut self) -> (TriMesh, Vec<usize>, Option<usize>) {
        let mesh = &mut self.mesh;
        if !self.has_uvs {
            mesh.uvs = Vec::new();
        }
        if !self.has_colors {
            mesh.colors = Vec::new();
        }
        if self.materials.len() == 1 {
            mesh.slots = Vec::new();
        }
        (self.mesh, self.materials, self.crossing)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn taken_names_get_numbers() {
        let mut taken = HashSet::new();
        let names = ["a", "a", "a.2", "a"].map(|name| unique(name.to_owned(), &mut taken));
        assert_eq!(names, ["a", "a.2", "a.2.2", "a.3"]);
    }

    #[test]
    fn objects_and_groups_name_together() {
        let name = |object: &str, group: &str| {
            object_name(&GroupName { object: object.to_owned(), group: group.to_owned() })
        };
        assert_eq!([name("car", "wheel"), name("car", ""), name("", "wheel")], ["car/wheel", "car", "wheel"]);
    }
}
