//! How the elements of an accessor lie in memory.

use super::Component;
use crate::gltf::flaw::Flaw;
use gltf::json::accessor::{Accessor, Type, sparse};
use gltf::json::validation::Checked;

/// The form of an element, and how far one is from the next.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layout {
    pub(super) kind: Type,
    pub(super) component: Component,
    pub(super) components: usize,
    stride: Option<usize>,
}

impl Layout {
    /// The form that an accessor says.
    pub(super) fn of(json: &Accessor, place: &str) -> Result<Self, Flaw> {
        let (Checked::Valid(kind), Checked::Valid(component)) = (json.type_, json.component_type) else {
            return Err(Flaw::new(place, "is of an unknown type").with_help("export the file again"));
        };
        let component = Component::from(component.0);
        let components = match kind {
            Type::Scalar => 1,
            Type::Vec2 => 2,
            Type::Vec3 => 3,
            Type::Vec4 | Type::Mat2 => 4,
            Type::Mat3 => 9,
            Type::Mat4 => 16,
        };
        // Columns of small numbers are padded; nothing that is read has such matrices.
        if matches!(kind, Type::Mat2 | Type::Mat3) && component.size() < 4 {
            return Err(Flaw::new(place, "is a matrix of small numbers").with_help("export it with floats"));
        }
        Ok(Self { kind, component, components, stride: None })
    }

    /// The form of the numbers of the elements that a sparse accessor replaces.
    pub(super) fn of_indices(json: &sparse::Indices, place: &str) -> Result<Self, Flaw> {
        let Checked::Valid(component) = json.component_type else {
            return Err(Flaw::new(place, "has indices of an unknown type").with_help("export the file again"));
        };
        Ok(Self { kind: Type::Scalar, component: component.0.into(), components: 1, stride: None })
    }

    /// Bytes of an element.
    pub(super) fn size(&self) -> usize {
        self.components * self.component.size()
    }

    /// Bytes from one element to the next.
    pub(super) fn stride(&self) -> usize {
        self.stride.unwrap_or(self.size())
    }

    /// The same with the stride of a view, if it has one.
    pub(super) fn with_stride(self, stride: Option<usize>) -> Self {
        // A stride of 0 is what some exporters write for none.
        Self { stride: stride.filter(|&stride| stride > 0), ..self }
    }

    /// The same without gaps.
    pub(super) fn packed(self) -> Self {
        Self { stride: None, ..self }
    }
}

/// The byte after the last of `count` elements; `None` where it cannot be counted.
pub(super) fn checked_end(count: usize, layout: &Layout) -> Option<usize> {
    match count.checked_sub(1) {
        None => Some(0),
        Some(before) => before.checked_mul(layout.stride())?.checked_add(layout.size()),
    }
}
