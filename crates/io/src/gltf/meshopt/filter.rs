//! What is done to numbers after they have been unpacked. Each gives `false` where the stride does not fit.

/// Unit vectors of which two coordinates on an octahedron were kept: four numbers of one or two bytes.
pub(super) fn octahedral(bytes: &mut [u8], stride: usize) -> bool {
    match stride {
        4 => bytes.chunks_exact_mut(4).for_each(|row| {
            let [x, y, one, _] = [0, 1, 2, 3].map(|i| f32::from(row[i] as i8));
            let unit = unfolded([x, y, one], f32::from(i8::MAX));
            row.iter_mut().zip(unit).for_each(|(byte, v)| *byte = v as i8 as u8);
        }),
        8 => bytes.chunks_exact_mut(8).for_each(|row| {
            let [x, y, one, _] = words(row).map(f32::from);
            let unit = unfolded([x, y, one], f32::from(i16::MAX));
            row.chunks_exact_mut(2)
                .zip(unit)
                .for_each(|(word, v)| word.copy_from_slice(&(v as i16).to_le_bytes()));
        }),
        _ => return false,
    }
    true
}

/// The unit vector, its length `largest`, of a point on the octahedron whose size is `one`.
fn unfolded([x, y, one]: [f32; 3], largest: f32) -> [f32; 3] {
    let z = one - x.abs() - y.abs();
    // The lower half is folded outward over the edges of the upper one.
    let over = z.min(0.0);
    let unfold = |v: f32| if v >= 0.0 { v + over } else { v - over };
    let (x, y) = (unfold(x), unfold(y));
    let scale = largest / (x * x + y * y + z * z).sqrt();
    [x, y, z].map(|v| rounded(v * scale))
}

/// Rounded away from zero at halves; 0 for what is no number.
fn rounded(v: f32) -> f32 {
    if v.is_nan() { 0.0 } else { v.round() }
}

/// Turns of which the largest component was left out: four numbers of two bytes.
pub(super) fn quaternion(bytes: &mut [u8], stride: usize) -> bool {
    for row in bytes.chunks_exact_mut(8) {
        let [x, y, z, rest] = words(row);
        // The low bits say which one was left out, the others are the scale.
        let scale = std::f32::consts::FRAC_1_SQRT_2 / f32::from(rest | 3);
        let [x, y, z] = [x, y, z].map(|v| f32::from(v) * scale);
        let w = (1.0 - x * x - y * y - z * z).max(0.0).sqrt();
        let left_out = (rest & 3) as usize;
        for (i, v) in [(1, x), (2, y), (3, z), (0, w)] {
            let word = rounded(v * f32::from(i16::MAX)) as i16;
            row[2 * ((left_out + i) % 4)..][..2].copy_from_slice(&word.to_le_bytes());
        }
    }
    stride == 8
}

/// Floats of a whole number in 24 bits and a power of two in 8.
pub(super) fn exponential(bytes: &mut [u8], stride: usize) -> bool {
    for row in bytes.chunks_exact_mut(4) {
        let packed = i32::from_le_bytes([row[0], row[1], row[2], row[3]]);
        let (power, whole) = (packed >> 24, packed << 8 >> 8);
        row.copy_from_slice(&(2_f32.powi(power) * whole as f32).to_le_bytes());
    }
    stride.is_multiple_of(4)
}

fn words(row: &[u8]) -> [i16; 4] {
    [0, 2, 4, 6].map(|i| i16::from_le_bytes([row[i], row[i + 1]]))
}

#[cfg(test)]
mod tests {
    use super::*;

    // Input and output of the filters of meshoptimizer 0.22 for the same vectors, turns and floats.

    #[test]
    fn unit_vectors_come_off_the_octahedron() {
        let mut small = [0, 0, 127, 0, 127, 73, 127, 0, 176, 92, 127, 127, 28, 219, 127, 129];
        assert!(octahedral(&mut small, 4));
        assert_eq!(small, [0, 0, 127, 0, 76, 0, 154, 0, 196, 81, 179, 127, 46, 195, 102, 129]);
        let mut large = bytes(&[-20575, 23623, 32767, 32767, 7193, -9590, 32767, -32767]);
        assert!(octahedral(&mut large, 8));
        assert_eq!(large, bytes(&[-15728, 20970, -19661, 32767, 11797, -15728, 26214, -32767]));
    }

    #[test]
    fn turns_get_their_largest_component_back() {
        let mut turns = bytes(&[0, 0, 0, 32767, -23170, 23170, 23170, 32764, 4634, -32438, -4634, 32765]);
        assert!(quaternion(&mut turns, 8));
        let expected = [0, 0, 0, 32767, 16383, -16384, 16384, 16384, -3277, 22937, 3277, -22937];
        assert_eq!(turns, bytes(&expected));
    }

    #[test]
    fn floats_get_their_power_of_two_back() {
        let packed: [u32; 4] = [0xf200_0000, 0xf300_2000, 0xf4ff_d800, 0xfc00_3e82];
        let mut floats: Vec<u8> = packed.iter().flat_map(|v| v.to_le_bytes()).collect();
        assert!(exponential(&mut floats, 4));
        let expected = [0.0_f32, 1.0, -2.5, 1000.125];
        assert_eq!(floats, expected.iter().flat_map(|v| v.to_le_bytes()).collect::<Vec<_>>());
    }

    #[test]
    fn strides_that_do_not_fit_are_refused() {
        assert!(
            !octahedral(&mut [0; 12], 12) && !quaternion(&mut [0; 12], 12) && !exponential(&mut [0; 6], 6)
        );
    }

    fn bytes(words: &[i16]) -> Vec<u8> {
        words.iter().flat_map(|v| v.to_le_bytes()).collect()
    }
}
