//! The numbers of vertices.

use crate::gltf::accessor::Accessor;
use crate::gltf::document::Document;
use crate::gltf::flaw::Flaw;
use glam::{Vec2, Vec3, Vec4};
use gltf::json::accessor::Type;
use gltf::json::mesh::{Primitive, Semantic};
use gltf::json::validation::Checked;
use heliostat_geometry::TriMesh;

/// Which vertices of the accessors a mesh has.
#[derive(Debug)]
pub(super) enum Picked {
    /// All of them.
    All(usize),
    /// These, in this order.
    Some(Vec<u32>),
}

impl Picked {
    /// The vertices that triangles name, renumbered where many of `count` are left out.
    pub(super) fn by(triangles: &mut [[u32; 3]], count: usize) -> Self {
        let mut numbers = vec![u32::MAX; count];
        let mut named = 0_usize;
        for corner in triangles.iter().flatten() {
            let number = &mut numbers[*corner as usize];
            if *number == u32::MAX {
                *number = 0;
                named += 1;
            }
        }
        if named == count {
            return Self::All(count);
        }
        // In the order of the file, so that neighbours stay neighbours.
        let mut picked = Vec::with_capacity(named);
        for (vertex, number) in (0..).zip(&mut numbers) {
            if *number == 0 {
                *number = picked.len() as u32;
                picked.push(vertex);
            }
        }
        triangles.iter_mut().flatten().for_each(|corner| *corner = numbers[*corner as usize]);
        Self::Some(picked)
    }

    /// So many vertices the accessors must have at least.
    pub(super) fn end(&self) -> usize {
        match self {
            Self::All(count) => *count,
            Self::Some(picked) => picked.last().map_or(0, |&last| last as usize + 1),
        }
    }

    /// A number for each vertex, by its number in the accessors.
    pub(super) fn map<T>(&self, mut read: impl FnMut(usize) -> T) -> Vec<T> {
        match self {
            Self::All(count) => (0..*count).map(read).collect(),
            Self::Some(picked) => picked.iter().map(|&vertex| read(vertex as usize)).collect(),
        }
    }
}

/// An attribute of a primitive, if it has it, with one element per vertex.
pub(super) fn attribute(
    document: &Document,
    primitive: &Primitive,
    semantic: Semantic,
    types: &[Type],
    count: Option<usize>,
    place: &str,
) -> Result<Option<Accessor>, Flaw> {
    let place = format!("{place}.attributes.{}", semantic.to_string());
    let Some(index) = primitive.attributes.get(&Checked::Valid(semantic)) else { return Ok(None) };
    let accessor = document.accessor(index.value(), &place)?.of(types)?;
    match count {
        Some(count) => accessor.counted(count).map(Some),
        None => Ok(Some(accessor)),
    }
}

/// The attributes of a primitive that meshes have.
#[derive(Debug)]
pub(super) struct Attributes {
    positions: Accessor,
    normals: Option<Accessor>,
    tangents: Option<Accessor>,
    uvs: [Option<Accessor>; 2],
    colors: Option<Accessor>,
    alpha: bool,
}

impl Attributes {
    /// Finds and checks them.
    pub(super) fn of(
        document: &Document,
        primitive: &Primitive,
        alpha: bool,
        place: &str,
    ) -> Result<Self, Flaw> {
        let get =
            |semantic, types: &[Type], count| attribute(document, primitive, semantic, types, count, place);
        let positions = get(Semantic::Positions, &[Type::Vec3], None)?;
        let positions = positions.ok_or_else(|| {
            Flaw::new(format!("{place}.attributes"), "have no POSITION").with_help("export the file again")
        })?;
        let count = Some(positions.len());
        let normals = get(Semantic::Normals, &[Type::Vec3], count)?;
        let tangents = get(Semantic::Tangents, &[Type::Vec4], count)?;
        Ok(Self {
            // Tangents without normals mean nothing.
            tangents: tangents.filter(|_| normals.is_some()),
            normals,
            uvs: [
                get(Semantic::TexCoords(0), &[Type::Vec2], count)?,
                get(Semantic::TexCoords(1), &[Type::Vec2], count)?,
            ],
            colors: get(Semantic::Colors(0), &[Type::Vec3, Type::Vec4], count)?,
            positions,
            alpha,
        })
    }

    /// How many vertices there are.
    pub(super) fn count(&self) -> usize {
        self.positions.len()
    }

    /// Reads some of the vertices.
    pub(super) fn read(&self, picked: &Picked) -> Result<TriMesh, Flaw> {
        let vectors = |accessor: &Accessor| picked.map(|i| Vec3::from(accessor.floats(i)));
        let some = |accessor: &Option<Accessor>| accessor.as_ref().map(vectors).unwrap_or_default();
        // Ours grow upwards.
        let uv = |accessor: &Accessor| {
            picked.map(|i| {
                let [u, v] = accessor.floats(i);
                Vec2::new(u, 1.0 - v)
            })
        };
        let tangents = self.tangents.as_ref();
        let opacities = self.colors.as_ref().filter(|colors| self.alpha && colors.components() == 4);
        let mesh = TriMesh {
            positions: vectors(&self.positions),
            normals: some(&self.normals),
            tangents: tangents.map(|t| picked.map(|i| Vec4::from(t.floats(i)))).unwrap_or_default(),
            uvs: self.uvs[0].as_ref().map(uv).unwrap_or_default(),
            uvs1: self.uvs[1].as_ref().map(uv).unwrap_or_default(),
            colors: some(&self.colors),
            opacities: opacities.map(|c| picked.map(|i| c.floats::<4>(i)[3])).unwrap_or_default(),
            ..TriMesh::default()
        };
        match mesh.positions.iter().position(|p| !p.is_finite()) {
            None => Ok(mesh),
            Some(vertex) => {
                let message = format!("vertex {vertex} is at no finite place");
                Err(Flaw::new(self.positions.place(), message).with_help("export the file again"))
            }
        }
    }
}
