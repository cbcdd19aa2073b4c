//! Rules of media.

use super::collect::Collector;
use super::issue::{ItemKind, Problem};
use crate::medium::DensityGrid;
use crate::scene::Scene;

pub(super) fn media<'a>(scene: &'a Scene, c: &mut Collector<'a>) {
    for (i, medium) in scene.media.iter().enumerate() {
        c.turn_to_named(ItemKind::Medium, i, &medium.name);
        c.color("absorption", medium.absorption);
        c.color("scattering", medium.scattering);
        c.number("anisotropy", medium.anisotropy, "above -1 and below 1", |v| v.abs() < 1.0);
        if let Some(grid) = &medium.density {
            check_grid(grid, c);
        }
    }
    if let Some(atmosphere) = &scene.atmosphere {
        c.turn_to(ItemKind::Scene, 0, "");
        c.medium(atmosphere.medium);
        if let Some(radius) = atmosphere.radius {
            c.positive("the radius of the atmosphere", radius);
        }
    }
}

fn check_grid(grid: &DensityGrid, c: &mut Collector<'_>) {
    let cells: u64 = grid.size.iter().map(|&n| u64::from(n)).fold(1, u64::saturating_mul);
    if cells == 0 || cells > DensityGrid::MOST_CELLS || grid.values.len() as u64 != cells {
        c.add(Problem::GridSize);
    }
    if let Some(&value) = grid.values.iter().find(|v| !(v.is_finite() && **v >= 0.0)) {
        c.not_negative("a density", value);
    }
    c.finite("the place of the grid", grid.place.matrix().is_finite());
}
