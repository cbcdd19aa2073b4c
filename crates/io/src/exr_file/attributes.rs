//! Header attributes as the entries of a frame, and back.
//!
//! Numbers are little-endian. Texts are bytes without an end mark; we read and write them as UTF-8.
//!
//! # Source
//! "OpenEXR File Layout", section "Predefined Attribute Types".

use super::header::{Attribute, Cursor, Part};
use heliostat_scene::frame::Meta;
use std::collections::BTreeMap;

/// Attributes that describe how the pixels are stored: never entries of a frame.
pub(super) const STRUCTURE: [&str; 12] = [
    "channels",
    "chromaticities",
    "chunkCount",
    "compression",
    "dataWindow",
    "displayWindow",
    "lineOrder",
    "maxSamplesPerPixel",
    "name",
    "tiles",
    "type",
    "version",
];

/// Attributes that every file has; entries of a frame where they say something else.
pub(super) const DEFAULTS: [(&str, Meta); 3] = [
    ("pixelAspectRatio", Meta::Float(1.0)),
    ("screenWindowCenter", Meta::Vec2([0.0, 0.0])),
    ("screenWindowWidth", Meta::Float(1.0)),
];

/// The entries of a part.
pub(super) fn read(part: &Part<'_>) -> BTreeMap<String, Meta> {
    let entry = |a: &Attribute<'_>| {
        let name = String::from_utf8_lossy(a.name).into_owned();
        let meta = value(a);
        let says_something = !STRUCTURE.contains(&name.as_str())
            && !DEFAULTS.iter().any(|(default, value)| *default == name && *value == meta);
        says_something.then_some((name, meta))
    };
    part.0.iter().filter_map(entry).collect()
}

fn value(attribute: &Attribute<'_>) -> Meta {
    let bytes = attribute.value;
    let known = match attribute.kind {
        b"string" => Some(Meta::Text(String::from_utf8_lossy(bytes).into_owned())),
        b"stringvector" => texts(bytes).map(Meta::Texts),
        b"int" => numbers(bytes, i32::from_le_bytes).map(|[v]| Meta::Int(v)),
        b"float" => numbers(bytes, f32::from_le_bytes).map(|[v]| Meta::Float(v)),
        b"v2f" => numbers(bytes, f32::from_le_bytes).map(Meta::Vec2),
        b"v3f" => numbers(bytes, f32::from_le_bytes).map(Meta::Vec3),
        b"m44f" => numbers(bytes, f32::from_le_bytes).map(Meta::Matrix),
        b"rational" => numbers(bytes, i32::from_le_bytes).map(|[n, d]| Meta::Rational(n, d.cast_unsigned())),
        _ => None,
    };
    let kind = String::from_utf8_lossy(attribute.kind).into_owned();
    known.unwrap_or_else(|| Meta::Other { kind, bytes: bytes.to_vec() })
}

/// Exactly `N` numbers of 4 bytes.
fn numbers<T: Copy + Default, const N: usize>(bytes: &[u8], number: fn([u8; 4]) -> T) -> Option<[T; N]> {
    let (chunks, rest) = bytes.as_chunks::<4>();
    let values = (chunks.len() == N && rest.is_empty()).then(|| chunks.iter().map(|c| number(*c)));
    values.map(|values| {
        let mut array = [T::default(); N];
        array.iter_mut().zip(values).for_each(|(a, v)| *a = v);
        array
    })
}

/// Texts, each after its length.
fn texts(bytes: &[u8]) -> Option<Vec<String>> {
    let mut cursor = Cursor::new(bytes);
    let mut texts = Vec::new();
    while !cursor.is_at_end() {
        let length = usize::try_from(i32::from_le_bytes(cursor.array().ok()?)).ok()?;
        texts.push(String::from_utf8_lossy(cursor.take(length).ok()?).into_owned());
    }
    Some(texts)
}

/// Type and bytes of an entry.
pub(super) fn write(meta: &Meta) -> (&str, Vec<u8>) {
    let floats = |values: &[f32]| values.iter().flat_map(|v| v.to_le_bytes()).collect();
    match meta {
        Meta::Text(text) => ("string", text.as_bytes().to_vec()),
        Meta::Int(v) => ("int", v.to_le_bytes().to_vec()),
        Meta::Float(v) => ("float", floats(&[*v])),
        Meta::Rational(n, d) => ("rational", [n.to_le_bytes(), d.to_le_bytes()].concat()),
        Meta::Vec2(v) => ("v2f", floats(v)),
        Meta::Vec3(v) => ("v3f", floats(v)),
        Meta::Matrix(v) => ("m44f", floats(v)),
        Meta::Texts(texts) => {
            let sized = |t: &String| [&(t.len() as u32).to_le_bytes(), t.as_bytes()].concat();
            ("stringvector", texts.iter().flat_map(sized).collect())
        }
        Meta::Other { kind, bytes } => (kind, bytes.clone()),
    }
}
