//! A triangle cut into four again and again: cells of equal area, numbered by the way down to them.
//!
//! The digits of a number in base 4 name, from the highest, the corner next to which the cell lies, or with 3 the middle.

/// The point with weights `inside` in a cell, by weights of the corners of the whole triangle.
pub(super) fn to_triangle(cell: u32, level: u8, inside: [f32; 3]) -> [f32; 3] {
    let step = |weights: [f32; 3], digit: usize| {
        if digit == 3 {
            return weights.map(|w| 0.5 * (1.0 - w));
        }
        let mut halves = weights.map(|w| 0.5 * w);
        halves[digit] += 0.5;
        halves
    };
    (0..level).fold(inside, |weights, i| step(weights, (cell >> (2 * i)) as usize & 3))
}

/// The cell in which a point lies.
pub(super) fn cell_of(level: u8, mut weights: [f32; 3]) -> u32 {
    let mut cell = 0;
    for _ in 0..level {
        let corner = weights.iter().position(|&w| w >= 0.5);
        cell = 4 * cell + corner.unwrap_or(3) as u32;
        weights = match corner {
            Some(corner) => {
                let mut twice = weights.map(|w| 2.0 * w);
                twice[corner] -= 1.0;
                twice
            }
            None => weights.map(|w| 1.0 - 2.0 * w),
        };
    }
    cell
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_of_a_cell_is_found_there() {
        let middle = [0.25, 0.45, 0.3];
        for level in 0..5 {
            for cell in 0..4_u32.pow(level.into()) {
                assert_eq!(cell_of(level, to_triangle(cell, level, middle)), cell, "level {level}");
            }
        }
        assert_eq!(to_triangle(1, 1, middle), [0.125, 0.725, 0.15]);
    }
}
