//! The six types of numbers.

use gltf::json::accessor::ComponentType;

/// The type of a number in a buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::gltf) enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl From<ComponentType> for Component {
    fn from(kind: ComponentType) -> Self {
        match kind {
            ComponentType::I8 => Self::I8,
            ComponentType::U8 => Self::U8,
            ComponentType::I16 => Self::I16,
            ComponentType::U16 => Self::U16,
            ComponentType::U32 => Self::U32,
            ComponentType::F32 => Self::F32,
        }
    }
}

/// The first bytes; 0 in place of those that are not there.
fn first<const N: usize>(bytes: &[u8]) -> [u8; N] {
    bytes.first_chunk().copied().unwrap_or([0; N])
}

impl Component {
    /// Bytes of a number.
    pub(super) fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }

    /// Whether it counts vertices, joints and the like.
    pub(in crate::gltf) fn is_unsigned(self) -> bool {
        matches!(self, Self::U8 | Self::U16 | Self::U32)
    }

    /// The number that `bytes` begin with.
    pub(super) fn number(self, bytes: &[u8]) -> f32 {
        match self {
            Self::I8 => f32::from(i8::from_le_bytes(first(bytes))),
            Self::U8 => f32::from(u8::from_le_bytes(first(bytes))),
            Self::I16 => f32::from(i16::from_le_bytes(first(bytes))),
            Self::U16 => f32::from(u16::from_le_bytes(first(bytes))),
            Self::U32 => u32::from_le_bytes(first(bytes)) as f32,
            Self::F32 => f32::from_le_bytes(first(bytes)),
        }
    }

    /// The bytes of a number; a whole one is the nearest that there is.
    pub(in crate::gltf) fn stored(self, number: f32) -> impl Iterator<Item = u8> {
        let bits = match self {
            Self::I8 => u32::from((number.round() as i8).cast_unsigned()),
            Self::U8 => u32::from(number.round() as u8),
            Self::I16 => u32::from((number.round() as i16).cast_unsigned()),
            Self::U16 => u32::from(number.round() as u16),
            Self::U32 => number.round() as u32,
            Self::F32 => number.to_bits(),
        };
        bits.to_le_bytes().into_iter().take(self.size())
    }

    /// The bytes of a whole number, cut to what fits.
    pub(in crate::gltf) fn whole(self, number: u32) -> impl Iterator<Item = u8> {
        number.to_le_bytes().into_iter().take(self.size())
    }

    /// The same with the largest whole number as 1, and the smallest as -1.
    pub(super) fn share(self, bytes: &[u8]) -> f32 {
        let largest = match self {
            Self::I8 => f32::from(i8::MAX),
            Self::U8 => f32::from(u8::MAX),
            Self::I16 => f32::from(i16::MAX),
            Self::U16 => f32::from(u16::MAX),
            Self::U32 => u32::MAX as f32,
            Self::F32 => return self.number(bytes),
        };
        (self.number(bytes) / largest).max(-1.0)
    }

    /// The whole number that `bytes` begin with; floats and negative ones count as 0.
    pub(super) fn integer(self, bytes: &[u8]) -> u32 {
        match self {
            Self::U8 => u8::from_le_bytes(first(bytes)).into(),
            Self::U16 => u16::from_le_bytes(first(bytes)).into(),
            Self::U32 => u32::from_le_bytes(first(bytes)),
            Self::I8 | Self::I16 | Self::F32 => self.number(bytes) as u32,
        }
    }
}
