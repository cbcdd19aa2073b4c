//! Accessors: typed numbers in the bytes of a buffer, whatever their form.
//!
//! Everything that a file says of lengths is checked against what is there before anything is allocated for it.

mod component;
mod layout;

pub(super) use component::Component;

use super::document::{Bytes, Document};
use super::flaw::Flaw;
use gltf::json::accessor::{self, Type};
use layout::{Layout, checked_end};

/// So many elements without any bytes behind them are fine in every file.
const FEW: u64 = 1 << 16;

/// Numbers in rows, checked: every element is there.
#[derive(Clone, Debug)]
pub(super) struct Accessor {
    bytes: Bytes,
    layout: Layout,
    count: usize,
    /// Whether whole numbers stand for -1..1 or 0..1.
    normalized: bool,
    /// Where it is, for messages.
    place: String,
}

impl Document {
    /// An accessor; `place` is who asks for it.
    ///
    /// # Errors
    /// When it does not exist or names bytes that are not there.
    pub(super) fn accessor(&self, index: usize, place: &str) -> Result<Accessor, Flaw> {
        let all = &self.root.accessors;
        let json = all.get(index).ok_or_else(|| Flaw::dangling(place, "accessors", index, all.len()))?;
        let place = format!("{place} (accessors[{index}])");
        let layout = Layout::of(json, &place)?;
        if let Some((bytes, count)) =
            self.unpacked_elements(index, layout.component, layout.components, &place)?
        {
            return Ok(Accessor { bytes, layout, count, normalized: json.normalized, place });
        }
        let too_many =
            || Flaw::new(&place, format!("has {} elements", json.count.0)).with_help("export the file again");
        let count = usize::try_from(json.count.0).map_err(|_| too_many())?;
        let (mut bytes, mut layout) = match json.buffer_view {
            Some(view) => {
                let offset = json.byte_offset.map_or(0, |offset| offset.0);
                self.elements(view.value(), offset, count, layout, &place)?
            }
            // Without a view all is 0. Nothing in the file bounds their number: let its bytes do so.
            None if json.count.0 <= FEW.max(self.held_bytes() as u64) => {
                (vec![0; count * layout.size()].into(), layout)
            }
            None => {
                return Err(
                    too_many().with_help("zeros that no buffer view holds are more than the file has bytes")
                );
            }
        };
        if let Some(sparse) = &json.sparse {
            bytes = self.patched(&bytes, layout, count, sparse, &place)?.into();
            layout = layout.packed();
        }
        Ok(Accessor { bytes, layout, count, normalized: json.normalized, place })
    }

    /// The bytes of `count` elements in a view, and how far one is from the next.
    fn elements(
        &self,
        view: usize,
        offset: u64,
        count: usize,
        layout: Layout,
        place: &str,
    ) -> Result<(Bytes, Layout), Flaw> {
        let (bytes, stride) = self.view(view, place)?;
        let layout = layout.with_stride(stride);
        let end = checked_end(count, &layout);
        let offset = usize::try_from(offset).ok();
        let part = offset.zip(end).and_then(|(offset, end)| bytes.slice(offset, end));
        part.map(|bytes| (bytes, layout)).ok_or_else(|| {
            let message = format!("reaches beyond the {} bytes of bufferViews[{view}]", bytes.len());
            Flaw::new(place, message).with_help("export the file again")
        })
    }

    /// All elements in a row, some of them replaced.
    fn patched(
        &self,
        base: &Bytes,
        layout: Layout,
        count: usize,
        sparse: &accessor::sparse::Sparse,
        place: &str,
    ) -> Result<Vec<u8>, Flaw> {
        let size = layout.size();
        let number = usize::try_from(sparse.count.0).unwrap_or(usize::MAX);
        let place = format!("{place}.sparse");
        let indices = Layout::of_indices(&sparse.indices, &place)?;
        let from = (sparse.indices.buffer_view.value(), sparse.indices.byte_offset.0);
        let (index_bytes, indices) = self.elements(from.0, from.1, number, indices, &place)?;
        let from = (sparse.values.buffer_view.value(), sparse.values.byte_offset.0);
        let (values, _) = self.elements(from.0, from.1, number, layout.packed(), &place)?;
        let mut patched = Vec::with_capacity(count * size);
        (0..count).for_each(|i| patched.extend_from_slice(&base[i * layout.stride()..][..size]));
        for i in 0..number {
            let at = indices.component.integer(&index_bytes[i * indices.stride()..]) as usize;
            if at >= count {
                let message = format!("replaces element {at} of {count}");
                return Err(Flaw::new(place, message).with_help("export the file again"));
            }
            patched[at * size..][..size].copy_from_slice(&values[i * size..][..size]);
        }
        Ok(patched)
    }
}

impl Accessor {
    /// How many elements there are.
    pub(super) fn len(&self) -> usize {
        self.count
    }

    /// Numbers per element.
    pub(super) fn components(&self) -> usize {
        self.layout.components
    }

    /// The type of the numbers.
    pub(super) fn component(&self) -> Component {
        self.layout.component
    }

    /// Where it is, for messages.
    pub(super) fn place(&self) -> &str {
        &self.place
    }

    /// The accessor, if its elements are of one of these types.
    pub(super) fn of(self, types: &[Type]) -> Result<Self, Flaw> {
        let fits = types.contains(&self.layout.kind);
        let names = || types.iter().map(|kind| format!("{kind:?}")).collect::<Vec<_>>().join(" or ");
        if fits { Ok(self) } else { Err(self.wrong(&format!("must hold {}", names()))) }
    }

    /// The accessor, if it has so many elements.
    pub(super) fn counted(self, count: usize) -> Result<Self, Flaw> {
        let found = self.count;
        if found == count {
            Ok(self)
        } else {
            Err(self.wrong(&format!("has {found} elements, must have {count}")))
        }
    }

    /// The accessor, if it has as many elements as the first one that was asked.
    pub(super) fn counted_like(self, count: &mut Option<usize>) -> Result<Self, Flaw> {
        let count = *count.get_or_insert(self.count);
        self.counted(count)
    }

    /// The accessor, if it has that many elements or more.
    pub(super) fn at_least(self, count: usize) -> Result<Self, Flaw> {
        if self.count < count { self.counted(count) } else { Ok(self) }
    }

    fn wrong(&self, message: &str) -> Flaw {
        Flaw::new(&self.place, message).with_help("export the file again")
    }

    /// The numbers of an element as the file means them; components that it does not have are 0.
    pub(super) fn floats<const N: usize>(&self, element: usize) -> [f32; N] {
        let (component, size) = (self.layout.component, self.layout.component.size());
        let bytes = &self.bytes[element * self.layout.stride()..][..self.layout.size()];
        let mut values = [0.0; N];
        for (value, bytes) in values.iter_mut().zip(bytes.chunks_exact(size)) {
            *value = if self.normalized { component.share(bytes) } else { component.number(bytes) };
        }
        values
    }

    /// The whole numbers of an element.
    pub(super) fn integers<const N: usize>(&self, element: usize) -> [u32; N] {
        let (component, size) = (self.layout.component, self.layout.component.size());
        let bytes = &self.bytes[element * self.layout.stride()..][..self.layout.size()];
        let mut values = [0; N];
        for (value, bytes) in values.iter_mut().zip(bytes.chunks_exact(size)) {
            *value = component.integer(bytes);
        }
        values
    }
}

#[cfg(test)]
mod tests;
