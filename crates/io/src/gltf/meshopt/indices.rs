//! Indices: triangles by the edges and vertices that were seen last, or numbers by their differences.

use super::stream::{Stream, unfolded};

/// Edges, and vertices, that are remembered.
const MEMORY: usize = 16;

/// The last things that were seen; the oldest is forgotten.
#[derive(Clone, Copy, Debug)]
struct Memory<T> {
    seen: [T; MEMORY],
    next: usize,
}

impl<T: Copy> Memory<T> {
    fn new(nothing: T) -> Self {
        Self { seen: [nothing; MEMORY], next: 0 }
    }

    fn push(&mut self, thing: T) {
        self.seen[self.next] = thing;
        self.next = (self.next + 1) % MEMORY;
    }

    /// What was seen `ago` things before the next.
    fn get(&self, ago: usize) -> T {
        self.seen[(self.next + MEMORY - ago % MEMORY) % MEMORY]
    }
}

/// The state between two triangles.
struct Triangles<'a> {
    /// Numbers and codes that do not fit into the code of a triangle.
    data: Stream<'a>,
    /// Frequent codes of triangles without a known edge.
    table: &'a [u8],
    edges: Memory<[u32; 2]>,
    vertices: Memory<u32>,
    /// The lowest number that no triangle has had.
    fresh: u32,
    /// The last number that was written as a difference.
    last: u32,
    /// Codes from here on are not of a remembered vertex.
    most_known: u8,
}

/// `count` indices of triangles, each of `stride` bytes; `None` when they are damaged.
pub(super) fn triangles(bytes: &[u8], count: usize, stride: usize) -> Option<Vec<u8>> {
    let (head, table) = bytes.split_at_checked(bytes.len().checked_sub(16)?)?;
    let mut data = Stream::new(head);
    let most_known = match data.byte()? {
        0xe0 => 15,
        0xe1 => 13,
        _ => return None,
    };
    if !count.is_multiple_of(3) {
        return None;
    }
    let codes = data.take(count / 3)?;
    let (edges, vertices) = (Memory::new([u32::MAX; 2]), Memory::new(u32::MAX));
    let mut state = Triangles { data, table, edges, vertices, fresh: 0, last: 0, most_known };
    let mut unpacked = Vec::with_capacity(count * stride);
    for &code in codes {
        for index in state.triangle(code)? {
            push(&mut unpacked, index, stride)?;
        }
    }
    state.data.is_empty().then_some(unpacked)
}

impl Triangles<'_> {
    fn triangle(&mut self, code: u8) -> Option<[u32; 3]> {
        if code < 0xf0 { self.beside(code) } else { self.apart(code) }
    }

    /// A triangle at an edge that is remembered.
    fn beside(&mut self, code: u8) -> Option<[u32; 3]> {
        let [a, b] = self.edges.get(1 + usize::from(code >> 4));
        let code = code & 15;
        let c = match code {
            0 => self.fresh(),
            code if code < self.most_known => self.vertices.get(1 + usize::from(code)),
            15 => self.far()?,
            // One before or behind the last: 13 or 14.
            code => {
                let step = if code == 13 { u32::MAX } else { 1 };
                self.last = self.last.wrapping_add(step);
                self.last
            }
        };
        if code == 0 || code >= self.most_known {
            self.vertices.push(c);
        }
        self.edges.push([c, b]);
        self.edges.push([a, c]);
        Some([a, b, c])
    }

    /// A triangle by itself: each corner is fresh, remembered or far.
    fn apart(&mut self, code: u8) -> Option<[u32; 3]> {
        let is_listed = code < 0xfe;
        let known = if is_listed { self.table[usize::from(code & 15)] } else { self.data.byte()? };
        if !is_listed && known == 0 {
            self.fresh = 0;
        }
        let (b_code, c_code) = (known >> 4, known & 15);
        let a_code = if code == 0xff { 15 } else { 0 };
        let codes = [a_code, b_code, c_code];
        // First the fresh and the remembered ones, then the far ones: in this order they are written.
        let mut corners = [0; 3];
        for (corner, code) in corners.iter_mut().zip(codes) {
            *corner = match code {
                0 => self.fresh(),
                code => self.vertices.get(usize::from(code)),
            };
        }
        for (corner, code) in corners.iter_mut().zip(codes) {
            if code == 15 && !is_listed {
                *corner = self.far()?;
            }
        }
        for (corner, code) in corners.into_iter().zip(codes) {
            if code == 0 || (code == 15 && !is_listed) {
                self.vertices.push(corner);
            }
        }
        let [a, b, c] = corners;
        [[b, a], [c, b], [a, c]].into_iter().for_each(|edge| self.edges.push(edge));
        Some(corners)
    }

    fn fresh(&mut self) -> u32 {
        let fresh = self.fresh;
        self.fresh = fresh.wrapping_add(1);
        fresh
    }

    /// A number that is written as the difference from the last such.
    fn far(&mut self) -> Option<u32> {
        self.last = self.last.wrapping_add(unfolded(self.data.number()?));
        Some(self.last)
    }
}

/// `count` indices in any order, each of `stride` bytes; `None` when they are damaged.
pub(super) fn sequence(bytes: &[u8], count: usize, stride: usize) -> Option<Vec<u8>> {
    let head = bytes.get(..bytes.len().checked_sub(4)?)?;
    let mut data = Stream::new(head);
    if !matches!(data.byte()?, 0xd0 | 0xd1) {
        return None;
    }
    let mut unpacked = Vec::with_capacity(count * stride);
    // Two numbers take turns as what the next one differs from.
    let mut last = [0_u32; 2];
    for _ in 0..count {
        let v = data.number()?;
        let last = &mut last[(v & 1) as usize];
        *last = last.wrapping_add(unfolded(v >> 1));
        push(&mut unpacked, *last, stride)?;
    }
    data.is_empty().then_some(unpacked)
}

/// Appends an index of two or four bytes.
fn push(bytes: &mut Vec<u8>, index: u32, stride: usize) -> Option<()> {
    match stride {
        2 => bytes.extend((index as u16).to_le_bytes()),
        4 => bytes.extend(index.to_le_bytes()),
        _ => return None,
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(bytes: &[u8]) -> Vec<u32> {
        bytes.chunks_exact(4).map(|b| u32::from_le_bytes(b.try_into().unwrap())).collect()
    }

    /// From meshoptimizer's own tests, `tests.cpp`: `kIndexBuffer`, `kIndexDataV0`.
    const APART: ([u32; 12], [u8; 27]) = (
        [0, 1, 2, 2, 1, 3, 4, 6, 5, 7, 8, 9],
        [
            0xe0, 0xf0, 0x10, 0xfe, 0xff, 0xf0, 0x0c, 0xff, 0x02, 0x02, 0x02, 0x00, 0x76, 0x87, 0x56, 0x67,
            0x78, 0xa9, 0x86, 0x65, 0x89, 0x68, 0x98, 0x01, 0x69, 0x00, 0x00,
        ],
    );

    /// `kIndexBufferTricky`, `kIndexDataV1`: numbering starts again, and steps of one.
    const TRICKY: ([u32; 15], [u8; 24]) = (
        [0, 1, 2, 2, 1, 3, 0, 1, 2, 2, 1, 5, 2, 1, 4],
        [
            0xe1, 0xf0, 0x10, 0xfe, 0x1f, 0x3d, 0x00, 0x0a, 0x00, 0x76, 0x87, 0x56, 0x67, 0x78, 0xa9, 0x86,
            0x65, 0x89, 0x68, 0x98, 0x01, 0x69, 0x00, 0x00,
        ],
    );

    /// `kIndexSequence`, `kIndexSequenceV1`.
    const SEQUENCE: ([u32; 6], [u8; 13]) = (
        [0, 1, 51, 2, 49, 1000],
        [0xd1, 0x00, 0x04, 0xcd, 0x01, 0x04, 0x07, 0x98, 0x1f, 0x00, 0x00, 0x00, 0x00],
    );

    #[test]
    fn triangles_are_those_that_were_packed() {
        assert_eq!(numbers(&triangles(&APART.1, 12, 4).unwrap()), APART.0);
        assert_eq!(numbers(&triangles(&TRICKY.1, 15, 4).unwrap()), TRICKY.0);
    }

    #[test]
    fn sequences_are_those_that_were_packed() {
        assert_eq!(numbers(&sequence(&SEQUENCE.1, 6, 4).unwrap()), SEQUENCE.0);
    }

    #[test]
    fn cut_or_longer_bytes_are_refused() {
        assert!((0..27).all(|end| triangles(&APART.1[..end], 12, 4).is_none()));
        assert!((0..13).all(|end| sequence(&SEQUENCE.1[..end], 6, 4).is_none()));
        assert_eq!(triangles(&APART.1, 11, 4), None);
        assert_eq!(triangles(&APART.1, 12, 3), None);
        assert_eq!(sequence(&SEQUENCE.1, 5, 4), None);
    }
}
