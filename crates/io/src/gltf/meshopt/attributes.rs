//! Vertices: each byte of them as the difference from that of the vertex before.

use super::stream::Stream;

/// Vertices of a group, whose differences take the same number of bits.
const GROUP: usize = 16;
/// Bytes of a block, at most, and its vertices.
const BLOCK_BYTES: usize = 8192;
const BLOCK_VERTICES: usize = 256;
/// Bytes that the end takes at least.
const TAIL: usize = 32;

/// `count` vertices of `stride` bytes; `None` when they are damaged.
pub(super) fn unpack(bytes: &[u8], count: usize, stride: usize) -> Option<Vec<u8>> {
    if stride == 0 || stride > BLOCK_VERTICES || !stride.is_multiple_of(4) {
        return None;
    }
    let (head, tail) = bytes.split_at_checked(bytes.len().checked_sub(stride.max(TAIL))?)?;
    // The last bytes are the vertex before the first.
    let mut before = tail[tail.len() - stride..].to_vec();
    let mut stream = Stream::new(head);
    if stream.byte()? != 0xa0 {
        return None;
    }
    let block = (BLOCK_BYTES / stride / GROUP * GROUP).min(BLOCK_VERTICES);
    let mut unpacked = vec![0; count * stride];
    for vertices in unpacked.chunks_mut(block * stride) {
        for (k, before) in before.iter_mut().enumerate() {
            column(&mut stream, vertices, k, stride, before)?;
        }
    }
    stream.is_empty().then_some(unpacked)
}

/// Byte `k` of all vertices of a block; `before` is that of the vertex before them, and becomes that of the last.
fn column(
    stream: &mut Stream<'_>,
    vertices: &mut [u8],
    k: usize,
    stride: usize,
    before: &mut u8,
) -> Option<()> {
    let groups = (vertices.len() / stride).div_ceil(GROUP);
    let modes = stream.take(groups.div_ceil(4))?;
    for (i, group) in vertices.chunks_mut(GROUP * stride).enumerate() {
        let differences = group_of(stream, modes[i / 4] >> (2 * (i % 4)) & 3)?;
        for (vertex, v) in group.chunks_exact_mut(stride).zip(differences) {
            *before = before.wrapping_add((v >> 1) ^ (v & 1).wrapping_neg());
            vertex[k] = *before;
        }
    }
    Some(())
}

/// The differences of a group: none, of two bits, of four, or whole bytes.
fn group_of(stream: &mut Stream<'_>, mode: u8) -> Option<[u8; GROUP]> {
    let bits = match mode {
        0 => return Some([0; GROUP]),
        1 => 2,
        2 => 4,
        _ => return stream.take(GROUP)?.try_into().ok(),
    };
    let packed = stream.take(GROUP * bits / 8)?;
    let escape = (1 << bits) - 1;
    let mut group = [0; GROUP];
    for (i, v) in group.iter_mut().enumerate() {
        // The first one lies in the highest bits of a byte.
        let place = i * bits;
        let small = packed[place / 8] >> (8 - bits - place % 8) & escape;
        // What does not fit follows as a whole byte.
        *v = if small == escape { stream.byte()? } else { small };
    }
    Some(group)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twenty vertices of four bytes, packed by `encodeVertexBuffer` of meshoptimizer 0.22.
    #[rustfmt::skip]
    const PACKED: [u8; 98] = [
        0xa0, 0x00, 0x06, 0x00, 0x24, 0x02, 0x40, 0x24, 0x02, 0x40, 0x24, 0x2c, 0x00, 0x00, 0x00, 0x04, 0x07, 0x00,
        0x06, 0x12, 0x1e, 0x2a, 0x36, 0x42, 0x4e, 0x5a, 0x66, 0x72, 0x7e, 0x8a, 0x96, 0xa2, 0xae, 0xff, 0x00, 0x00,
        0x00, 0xba, 0xc6, 0xd2, 0xde, 0x07, 0x00, 0xc2, 0xca, 0xd4, 0xe8, 0xfe, 0xe1, 0xbf, 0x93, 0x65, 0x2d, 0x0c,
        0x50, 0x96, 0xe6, 0xc7, 0xff, 0x00, 0x00, 0x00, 0x6b, 0x0d, 0x5a, 0xc4, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
        0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
        0x00, 0x00, 0x00, 0x00, 0x07, 0x00, 0x00, 0x00,
    ];

    /// The formulas of the vertices above: nothing changes, little, much, anything.
    fn vertices() -> Vec<u8> {
        let vertex = |i: u32| {
            let slow = if i.is_multiple_of(3) { i } else { i - 1 };
            [7, slow, 3 * i * i, 97 * i + i * i * i / 2].map(|v| v as u8)
        };
        (0..20).flat_map(vertex).collect()
    }

    #[test]
    fn vertices_are_those_that_were_packed() {
        assert_eq!(unpack(&PACKED, 20, 4), Some(vertices()));
    }

    #[test]
    fn damaged_bytes_are_refused() {
        assert!((0..PACKED.len()).all(|end| unpack(&PACKED[..end], 20, 4).is_none()));
        for (count, stride) in [(19, 3), (200, 4), (20, 0), (20, 8), (20, 512)] {
            assert_eq!(unpack(&PACKED, count, stride), None, "{count} {stride}");
        }
    }
}
