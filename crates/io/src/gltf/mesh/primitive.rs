//! Corners of triangles from the modes of drawing, and what makes two primitives the same mesh.

use super::skin::Bones;
use crate::gltf::document::Document;
use crate::gltf::flaw::Flaw;
use gltf::json::accessor::Type;
use gltf::json::mesh::{Mode, Primitive};
use gltf::json::validation::Checked;

/// What is done to the vertices of a primitive.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::gltf) struct ShapeOf<'a> {
    /// Whether the alpha of vertex colours counts.
    pub(in crate::gltf) alpha: bool,
    /// The set of coordinates of its normal map, if it has one.
    pub(in crate::gltf) normal_map: Option<usize>,
    /// Weights of the morph targets.
    pub(in crate::gltf) weights: &'a [f32],
    /// The bones that bend it.
    pub(in crate::gltf) bones: Option<&'a Bones>,
}

/// What makes two primitives one mesh: the same accessors, read in the same way.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(in crate::gltf) struct PrimitiveKey {
    mode: u32,
    indices: Option<usize>,
    attributes: Vec<(String, usize)>,
    targets: Vec<[Option<usize>; 3]>,
    weights: Vec<u32>,
    alpha: bool,
    normal_map: Option<usize>,
}

impl PrimitiveKey {
    /// The key of a primitive; bones aside.
    pub(in crate::gltf) fn of(primitive: &Primitive, shape: &ShapeOf<'_>) -> Self {
        let attributes = primitive.attributes.iter().filter_map(|(name, accessor)| match name {
            Checked::Valid(name) => Some((name.to_string(), accessor.value())),
            Checked::Invalid => None,
        });
        // Targets without weight change nothing.
        let is_morphed = shape.weights.iter().any(|&weight| weight != 0.0);
        let targets = primitive.targets.iter().flatten().filter(|_| is_morphed);
        let numbers = |target: &gltf::json::mesh::MorphTarget| {
            [target.positions, target.normals, target.tangents].map(|index| index.map(|index| index.value()))
        };
        let weights = shape.weights.iter().filter(|_| is_morphed).map(|weight| weight.to_bits());
        Self {
            mode: mode(primitive).map_or(0, Mode::as_gl_enum),
            indices: primitive.indices.map(|index| index.value()),
            attributes: attributes.collect(),
            targets: targets.map(numbers).collect(),
            weights: weights.collect(),
            alpha: shape.alpha,
            normal_map: shape.normal_map,
        }
    }
}

fn mode(primitive: &Primitive) -> Option<Mode> {
    match primitive.mode {
        Checked::Valid(mode) => Some(mode),
        Checked::Invalid => None,
    }
}

/// The triangles of a primitive over `vertices` vertices. Those without area by their numbers are left out.
pub(super) fn triangles(
    document: &Document,
    primitive: &Primitive,
    vertices: usize,
    place: &str,
) -> Result<Vec<[u32; 3]>, Flaw> {
    let corners = corners(document, primitive, vertices, place)?;
    let order: Box<dyn Fn(usize) -> [usize; 3]> = match mode(primitive) {
        Some(Mode::Triangles) => Box::new(|i| [3 * i, 3 * i + 1, 3 * i + 2]),
        // Every second triangle of a strip turns the other way.
        Some(Mode::TriangleStrip) => Box::new(|i| [i, i + 1 + i % 2, i + 2 - i % 2]),
        Some(Mode::TriangleFan) => Box::new(|i| [i + 1, i + 2, 0]),
        _ => return Ok(Vec::new()),
    };
    let count = match mode(primitive) {
        Some(Mode::Triangles) => corners.len() / 3,
        _ => corners.len().saturating_sub(2),
    };
    let triangles = (0..count).map(|i| order(i).map(|corner| corners[corner]));
    Ok(triangles.filter(|[a, b, c]| a != b && b != c && c != a).collect())
}

/// The vertices of the corners in their order.
fn corners(
    document: &Document,
    primitive: &Primitive,
    vertices: usize,
    place: &str,
) -> Result<Vec<u32>, Flaw> {
    let Some(index) = primitive.indices else {
        let count = u32::try_from(vertices).map_err(|_| Flaw::new(place, "has too many vertices"))?;
        return Ok((0..count).collect());
    };
    let place = format!("{place}.indices");
    let accessor = document.accessor(index.value(), &place)?.of(&[Type::Scalar])?;
    if !accessor.component().is_unsigned() {
        return Err(Flaw::new(place, "are no unsigned whole numbers").with_help("export the file again"));
    }
    let corners: Vec<u32> = (0..accessor.len()).map(|i| accessor.integers::<1>(i)[0]).collect();
    match corners.iter().position(|&vertex| vertex as usize >= vertices) {
        None => Ok(corners),
        Some(at) => {
            let message = format!("corner {at} is vertex {}, but there are only {vertices}", corners[at]);
            Err(Flaw::new(place, message).with_help("export the file again"))
        }
    }
}
