//! Density grids from Mitsuba's volume files, version 3.
//!
//! | bytes | what |
//! |---|---|
//! | 0..3 | `VOL` |
//! | 3 | version, 3 |
//! | 4..8 | encoding, `i32`: 1 for `f32` |
//! | 8..20 | cells along x, y and z, `i32` each |
//! | 20..24 | channels, `i32`: 1 |
//! | 24..48 | least and largest x, y, z of the box that the cells fill, `f32` each |
//! | 48.. | values, `f32`, x fastest and z slowest |
//!
//! All numbers are little-endian.
//!
//! # Source
//! Jakob et al., "Mitsuba 3", plugin `gridvolume`, checked against a file that Mitsuba wrote.

use crate::error::LoadError;
use crate::file::read_file;
use glam::Vec3;
use heliostat_scene::medium::DensityGrid;
use std::path::Path;
use std::sync::Arc;

/// Length of the head in bytes.
const HEAD: usize = 48;

/// A grid of densities in a box.
#[derive(Clone, Debug, PartialEq)]
pub struct Volume {
    /// Cells along x, y and z.
    pub size: [u32; 3],
    /// Corners of the box that they fill.
    pub bounds: [Vec3; 2],
    /// Densities, at least 0; x runs fastest.
    pub values: Arc<[f32]>,
}

/// Reads a volume file.
///
/// # Errors
/// When the file cannot be read, is no volume file of version 3 with one channel of `f32`, is shorter or longer than its head
/// says, has an empty box, or holds a density below 0 or one that is no number.
pub fn read_volume(path: &Path) -> Result<Volume, LoadError> {
    let bytes = read_file(path, HEAD as u64 + 4 * DensityGrid::MOST_CELLS)?;
    decode(&bytes).map_err(|(message, help)| LoadError::new(path, message).with_help(help))
}

type Flaw = (String, &'static str);

fn decode(bytes: &[u8]) -> Result<Volume, Flaw> {
    let Some((head, data)) = bytes.split_first_chunk::<HEAD>().filter(|(head, _)| head.starts_with(b"VOL"))
    else {
        return Err(("is no volume file".to_owned(), "name a file of Mitsuba's format `.vol`, version 3"));
    };
    let word = |at: usize| [head[at], head[at + 1], head[at + 2], head[at + 3]];
    let int = |at: usize| i32::from_le_bytes(word(at));
    let float = |at: usize| f32::from_le_bytes(word(at));
    if head[3] != 3 {
        return Err((format!("has version {} of the format", head[3]), "write it in version 3"));
    }
    if int(4) != 1 {
        return Err((
            format!("has values in encoding {}", int(4)),
            "write them in encoding 1, 32-bit floats",
        ));
    }
    if int(20) != 1 {
        return Err((format!("has {} channels", int(20)), "write one channel, the density"));
    }
    let size = [int(8), int(12), int(16)];
    let cells = size.iter().map(|&n| u64::try_from(n).unwrap_or(0)).fold(1, u64::saturating_mul);
    if cells == 0 || cells > DensityGrid::MOST_CELLS {
        let [x, y, z] = size;
        return Err((format!("has {x} x {y} x {z} cells"), "write at least 1 cell, and at most 2^30"));
    }
    if data.len() as u64 != 4 * cells {
        let (found, expected) = (data.len(), 4 * cells);
        return Err((
            format!("holds {found} bytes of values where its head announces {expected}"),
            "write the file again",
        ));
    }
    let bounds = [24, 36].map(|at| Vec3::new(float(at), float(at + 4), float(at + 8)));
    let extent = bounds[1] - bounds[0];
    // False for numbers that are none.
    let has_room = extent.cmpgt(Vec3::ZERO).all() && extent.is_finite();
    if !has_room {
        return Err(("has an empty box".to_owned(), "give each axis of the box a length above 0"));
    }
    let values: Vec<f32> = data.as_chunks().0.iter().map(|&value| f32::from_le_bytes(value)).collect();
    if let Some((i, value)) = values.iter().enumerate().find(|(_, v)| !(v.is_finite() && **v >= 0.0)) {
        return Err((format!("has the density {value} in cell {i}"), "write densities of at least 0"));
    }
    Ok(Volume { size: size.map(i32::unsigned_abs), bounds, values: values.into() })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What Mitsuba writes for 2 x 1 x 3 cells.
    fn file() -> Vec<u8> {
        let mut bytes = b"VOL\x03".to_vec();
        [1, 2, 1, 3, 1].iter().for_each(|n: &i32| bytes.extend(n.to_le_bytes()));
        [-1.0, 0.0, 0.5, 1.0, 2.0, 3.5].iter().for_each(|v: &f32| bytes.extend(v.to_le_bytes()));
        (0..6).for_each(|i| bytes.extend((i as f32).to_le_bytes()));
        bytes
    }

    #[test]
    fn a_file_is_read() {
        let volume = decode(&file()).unwrap();
        assert_eq!(volume.size, [2, 1, 3]);
        assert_eq!(volume.bounds, [Vec3::new(-1.0, 0.0, 0.5), Vec3::new(1.0, 2.0, 3.5)]);
        assert_eq!(*volume.values, [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
    }

    #[test]
    fn damage_is_told() {
        let with = |at: usize, bytes: [u8; 4]| {
            let mut file = file();
            file[at..at + 4].copy_from_slice(&bytes);
            decode(&file).unwrap_err().0
        };
        assert_eq!(with(0, *b"VOX\x03"), "is no volume file");
        assert_eq!(with(0, *b"VOL\x02"), "has version 2 of the format");
        assert_eq!(with(4, 2_i32.to_le_bytes()), "has values in encoding 2");
        assert_eq!(with(20, 3_i32.to_le_bytes()), "has 3 channels");
        assert_eq!(with(8, (-2_i32).to_le_bytes()), "has -2 x 1 x 3 cells");
        assert_eq!(with(8, i32::MAX.to_le_bytes()), "has 2147483647 x 1 x 3 cells");
        assert_eq!(with(8, 3_i32.to_le_bytes()), "holds 24 bytes of values where its head announces 36");
        assert_eq!(with(24, 7.0_f32.to_le_bytes()), "has an empty box");
        assert_eq!(with(24, f32::NAN.to_le_bytes()), "has an empty box");
        assert_eq!(with(52, (-1.0_f32).to_le_bytes()), "has the density -1 in cell 1");
        for length in 0..file().len() {
            assert!(decode(&file()[..length]).is_err(), "{length}");
        }
    }
}
