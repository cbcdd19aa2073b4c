//! Makes the tables: integrals over the facets that a viewer sees, by brute force.
//!
//! Tests make some numbers anew and compare; with `HELIOSTAT_DEEP` all of them, and with `HELIOSTAT_MAKE_TABLES` the file is
//! written (`cargo xtask assets`).

use super::axis::{axis_index, axis_width, critical, curve_width, grazing_cos};
use super::chebyshev::{nodes, weights};
use super::curve::curve_weights;
use super::edge::pieces;
use super::even::{even_axis, even_cos};
use super::sheen::axis_cos;
use super::stored::{
    ANGLES, COS, COUNT, CURVE, DRAWN_ANGLES, DRAWN_COS, DRAWN_CURVE, DRAWN_EDGE, DRAWN_GLASS, DRAWN_INDEX,
    DRAWN_INNER, DRAWN_OUT, DRAWN_WIDTH, EDGE, FIBRES, FINE_WIDTH, GLASS, GLASS_WIDTH, INDEX, INNER_GLASS,
    LEAN, LOST, LOWER, LOWERS, PIECES, SHEEN, SHEEN_LOWERS, STEEP, STRENGTH, TURN, Table, WIDTH,
};
use crate::bsdf::diffuse::lean;
use crate::bsdf::fresnel::refraction;
use crate::bsdf::ggx::Ggx;
use crate::bsdf::glass::refract;
use crate::bsdf::quadrature::gauss_legendre;
use crate::bsdf::sheen::{Sheen, axis_roughness};
use glam::{Vec2, Vec3};
use heliostat_geometry::error_bound;
use rayon::prelude::*;
use std::f64::consts::PI;

/// Nodes of the integrals over facets, around the normal (half of them where both halves are alike) and away from it, in
/// parts: kinks are worth more parts, not higher degrees, and edges of total reflection more of them.
const TURNS: usize = 96;
const PARTS: usize = 12;
const INNER_PARTS: usize = 24;
const CAPS: usize = 16;

/// A row of a table: all numbers at one place on all axes but the last.
type Row = Box<dyn Fn() -> Vec<f32> + Sync + Send>;

/// Rows, each with its place among the numbers.
#[derive(Default)]
struct Rows(Vec<(usize, Row)>);

/// All rows.
fn rows() -> Vec<(usize, Row)> {
    let mut rows = Rows::default();
    rows.add_facets();
    rows.add_glass();
    rows.add_drawn_out();
    rows.add_drawn_glass();
    rows.add_matter();
    rows.0
}

fn steep(c: usize, alpha: f32) -> f32 {
    grazing_cos(nodes::<COS>()[c], alpha)
}

impl Rows {
    fn add(
        &mut self,
        table: Table,
        len: usize,
        k: usize,
        row: impl Fn() -> Vec<f32> + Sync + Send + 'static,
    ) {
        self.0.push((table.start() + k * len, Box::new(row)));
    }

    fn add_facets(&mut self) {
        for (k, (w, c)) in pairs(FINE_WIDTH, COS).enumerate() {
            let alpha = axis_width(nodes::<FINE_WIDTH>()[w]);
            let cos = steep(c, alpha);
            self.add(LOST, 1, k, move || vec![lost(&Ggx::isotropic(alpha), facing(cos, 0.0))]);
            let cos = steep(c, curve_width(alpha));
            self.add(ANGLES, CURVE, k, move || angles(&Ggx::isotropic(alpha), facing(cos, 0.0)));
        }
        for (k, (w, c)) in pairs(WIDTH, COS).enumerate() {
            let alpha = axis_width(nodes::<WIDTH>()[w]);
            let cos = steep(c, alpha);
            self.add(LOWERS, LOWER * CURVE, k, move || lower(cos, alpha));
        }
    }

    fn add_glass(&mut self) {
        let width = |w: usize| axis_width(nodes::<GLASS_WIDTH>()[w]);
        for (k, (i, w)) in pairs(INDEX[0], GLASS_WIDTH).enumerate() {
            let (ior, alpha) = (axis_index(nodes::<{ INDEX[0] }>()[i]), width(w));
            for c in 0..COS {
                let (ggx, wo) = (Ggx::isotropic(alpha), facing(steep(c, alpha), 0.0));
                self.add(GLASS, 1 + CURVE, k * COS + c, move || glass::<CURVE>(&ggx, wo, ior));
            }
        }
        for (k, (i, w)) in pairs(INDEX[1], GLASS_WIDTH).enumerate() {
            let (ior, alpha) = (axis_index(nodes::<{ INDEX[1] }>()[i]), width(w));
            for (l, (piece, e)) in pairs(PIECES, EDGE).enumerate() {
                let wo = facing(pieces(critical(ior))[piece].cos(nodes::<EDGE>()[e], alpha), 0.0);
                let (ggx, place) = (Ggx::isotropic(alpha), k * PIECES * EDGE + l);
                self.add(INNER_GLASS, 1 + CURVE, place, move || glass::<CURVE>(&ggx, wo, 1.0 / ior));
            }
        }
    }

    fn add_drawn_out(&mut self) {
        for (k, (w, s)) in pairs(WIDTH, STRENGTH).enumerate() {
            let ggx = Ggx::stretched_by(axis_width(nodes::<WIDTH>()[w]), nodes::<STRENGTH>()[s]);
            for (l, (t, c)) in pairs(TURN, COS).enumerate() {
                let along = ggx.along(nodes::<TURN>()[t]);
                let width = ggx.width_along(along.extend(0.0));
                let (place, angle) = (k * TURN * COS + l, along.to_angle());
                let cos = steep(c, width);
                self.add(DRAWN_OUT, 1, place, move || vec![lost(&ggx, facing(cos, angle))]);
                let cos = steep(c, curve_width(width));
                self.add(DRAWN_ANGLES, CURVE, place, move || angles(&ggx, facing(cos, angle)));
            }
        }
    }

    fn add_drawn_glass(&mut self) {
        let widths = nodes::<DRAWN_WIDTH>().map(axis_width);
        for (k, (i, ab)) in pairs(DRAWN_INDEX, DRAWN_WIDTH * DRAWN_WIDTH).enumerate() {
            let ior = axis_index(nodes::<DRAWN_INDEX>()[i]);
            let (along, across) = (widths[ab / DRAWN_WIDTH], widths[ab % DRAWN_WIDTH]);
            for (c, x) in nodes::<DRAWN_COS>().into_iter().enumerate() {
                let wo = facing(grazing_cos(x, along), 0.0);
                let row = move || glass_more(along, across, wo, ior);
                self.add(DRAWN_GLASS, 1 + DRAWN_CURVE, k * DRAWN_COS + c, row);
            }
            for (l, (piece, e)) in pairs(PIECES, DRAWN_EDGE).enumerate() {
                let wo = facing(pieces(critical(ior))[piece].cos(nodes::<DRAWN_EDGE>()[e], along), 0.0);
                let row = move || glass_more(along, across, wo, 1.0 / ior);
                self.add(DRAWN_INNER, 1 + DRAWN_CURVE, k * PIECES * DRAWN_EDGE + l, row);
            }
        }
    }

    fn add_matter(&mut self) {
        let fibres = |r: usize| Sheen::new(axis_roughness(nodes::<FIBRES>()[r]));
        for (k, (r, c)) in pairs(FIBRES, STEEP).enumerate() {
            let (sheen, cos) = (fibres(r), axis_cos(c as f32 / (STEEP - 1) as f32));
            self.add(SHEEN, 1, k, move || vec![share(&sheen, cos)]);
        }
        for (k, (r, c)) in pairs(FIBRES, COS).enumerate() {
            let (sheen, cos) = (fibres(r), axis_cos(nodes::<COS>()[c]));
            self.add(SHEEN_LOWERS, LOWER, k, move || share_from_lower(&sheen, cos));
        }
        for c in 0..COS {
            self.add(LEAN, COS, c, move || leaning(even_cos(c)));
        }
    }
}

fn pairs(a: usize, b: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..a * b).map(move |k| (k / b, k % b))
}

fn facing(cos: f32, angle: f32) -> Vec3 {
    ((1.0 - cos * cos).max(0.0).sqrt() * Vec2::from_angle(angle)).extend(cos)
}

/// Numbers in the unit square with weights that add up to 1, in so many parts.
fn square(parts: usize) -> impl Iterator<Item = (Vec2, f64)> {
    let caps = gauss_legendre::<CAPS>();
    (0..parts * CAPS * TURNS).map(move |k| {
        let (piece, cap, turn) = (k / (CAPS * TURNS), k / TURNS % CAPS, k % TURNS);
        let y = (piece as f32 + caps[cap].0) / parts as f32;
        let weight = f64::from(caps[cap].1) / (parts * TURNS) as f64;
        (Vec2::new((turn as f32 + 0.5) / TURNS as f32, y), weight)
    })
}

/// Share of the light that facets which reflect all keep at first.
fn lost(ggx: &Ggx, wo: Vec3) -> f32 {
    square(PARTS).map(|(u, weight)| weight * f64::from(reflected(ggx, wo, u).2)).sum::<f64>() as f32
}

/// A facet by two numbers: cosine to the viewer, the direction that it reflects to him, and the share that it keeps.
fn reflected(ggx: &Ggx, wo: Vec3, u: Vec2) -> (f32, Vec3, f32) {
    let h = ggx.visible_reflecting(wo, u);
    let wi = 2.0 * wo.dot(h) * h - wo;
    let hidden = if wi.z > 0.0 { ggx.hidden_reflecting(wo, wi) } else { 1.0 };
    (wo.dot(h).clamp(0.0, 1.0), wi, hidden)
}

fn angles(ggx: &Ggx, wo: Vec3) -> Vec<f32> {
    let mut sums = [0.0_f64; CURVE];
    for (u, weight) in square(PARTS) {
        let (cos, _, hidden) = reflected(ggx, wo, u);
        for (sum, node) in sums.iter_mut().zip(curve_weights(cos)) {
            *sum += weight * f64::from((1.0 - hidden) * node);
        }
    }
    let all: f64 = sums.iter().sum();
    sums.map(|sum| (sum / all) as f32).to_vec()
}

/// Weights of what is 0 at the viewer's cosine and smooth from there to the horizon, at the cosine `wi`.
fn lower_weights(cos: f32, wi: f32) -> [f32; LOWER] {
    let lower = 1.0 - wi / cos;
    let (weights, nodes) = (weights::<LOWER>(lower), nodes::<LOWER>());
    std::array::from_fn(|k| weights[k] * lower / nodes[k])
}

/// Those weights, and those of a curve of reflectance, in light from lower than the viewer.
fn lower(cos: f32, alpha: f32) -> Vec<f32> {
    let (ggx, wo) = (Ggx::isotropic(alpha), facing(cos, 0.0));
    let mut sums = [0.0_f64; LOWER * CURVE];
    for (u, weight) in square(PARTS) {
        let (turn, wi, hidden) = reflected(&ggx, wo, u);
        if wi.z > 0.0 && wi.z < cos {
            let curve = curve_weights(turn);
            for (sums, part) in sums.as_chunks_mut::<CURVE>().0.iter_mut().zip(lower_weights(cos, wi.z)) {
                for (sum, node) in sums.iter_mut().zip(curve) {
                    *sum += weight * f64::from((1.0 - hidden) * part * node);
                }
            }
        }
    }
    sums.map(|sum| sum as f32).to_vec()
}

/// What facets of glass of these widths lose more than those of the width along x.
fn glass_more(along: f32, across: f32, wo: Vec3, eta: f32) -> Vec<f32> {
    let drawn = glass::<DRAWN_CURVE>(&Ggx::of_widths(Vec2::new(along, across)), wo, eta);
    let even = glass::<DRAWN_CURVE>(&Ggx::isotropic(along), wo, eta);
    drawn.iter().zip(even).map(|(drawn, even)| drawn - even).collect()
}

fn glass<const N: usize>(ggx: &Ggx, wo: Vec3, eta: f32) -> Vec<f32> {
    let mut sums = vec![0.0_f64; 1 + N];
    for (u, weight) in square(INNER_PARTS) {
        let h = ggx.visible(wo, u);
        let cos = wo.dot(h).clamp(0.0, 1.0);
        let mirrored = 2.0 * cos * h - wo;
        let kept = if mirrored.z > 0.0 { ggx.hidden(wo, mirrored) } else { 1.0 };
        let other = refraction(cos, eta).cos;
        if other == 0.0 {
            sums[0] += weight * f64::from(kept);
            continue;
        }
        let bent = refract(wo, h, cos, other, eta);
        let stopped = if bent.z < 0.0 { ggx.hidden(wo, bent) } else { 1.0 };
        sums[0] += weight * f64::from(stopped);
        let place = if eta < 1.0 { other } else { cos };
        for (sum, node) in sums[1..].iter_mut().zip(weights::<N>(place.clamp(0.0, 1.0))) {
            *sum += weight * f64::from((kept - stopped) * node);
        }
    }
    sums.into_iter().map(|sum| sum as f32).collect()
}

/// Light that white fibres send to a viewer from directions of cosines up to `most`, with those cosines.
fn sheen(sheen: &Sheen, wo: Vec3, most: f32) -> impl Iterator<Item = (f32, f64)> {
    let sheen = *sheen;
    square(PARTS).map(move |(u, weight)| {
        // Nodes crowd where the angle is grazing: the cosine goes as the fourth power.
        let cos = most * u.y.powi(4);
        let value =
            f64::from(4.0 * most * u.y.powi(3) * sheen.single(wo, facing(cos, std::f32::consts::TAU * u.x)));
        (cos, weight * 2.0 * PI * value)
    })
}

fn share(fibres: &Sheen, cos: f32) -> f32 {
    sheen(fibres, facing(cos, 0.0), 1.0).map(|(_, light)| light).sum::<f64>() as f32
}

fn share_from_lower(fibres: &Sheen, cos: f32) -> Vec<f32> {
    let mut sums = [0.0_f64; LOWER];
    for (lower, light) in sheen(fibres, facing(cos, 0.0), cos) {
        for (sum, part) in sums.iter_mut().zip(lower_weights(cos, lower)) {
            *sum += light * f64::from(part);
        }
    }
    sums.map(|sum| sum as f32).to_vec()
}

fn leaning(cos: f32) -> Vec<f32> {
    let wo = facing(cos, 0.0);
    let mut sums = [0.0_f64; COS];
    for (u, weight) in square(PARTS) {
        // Nodes crowd where the angle is grazing: the cosine is the square.
        let (wi, area) = (facing(u.y * u.y, std::f32::consts::TAU * u.x), 4.0 * u.y.powi(3));
        for (sum, node) in sums.iter_mut().zip(weights::<COS>(even_axis(wi.z))) {
            *sum += weight * f64::from(area * lean(wo, wi) * node);
        }
    }
    sums.map(|sum| sum as f32).to_vec()
}

#[test]
fn bsdf_tables_are_what_they_are_made_from() {
    let step = if std::env::var_os("HELIOSTAT_DEEP").is_some() { 1 } else { 97 };
    let rows: Vec<_> = rows().into_iter().step_by(step).collect();
    rows.par_iter().for_each(|(start, row)| {
        let whole = Table::ALL.from(*start);
        for (k, (made, stored)) in row().into_iter().zip(whole).enumerate() {
            assert!(
                (made - stored).abs() < 0.02 * error_bound::TABLE_ERROR,
                "{start} + {k}: {stored}, and made anew {made}"
            );
        }
    });
}

#[test]
fn bsdf_tables_are_written() {
    if std::env::var_os("HELIOSTAT_MAKE_TABLES").is_none() {
        return;
    }
    let mut numbers = vec![0.0_f32; COUNT];
    let made: Vec<(usize, Vec<f32>)> = rows().par_iter().map(|(start, row)| (*start, row())).collect();
    for (start, row) in made {
        numbers[start..start + row.len()].copy_from_slice(&row);
    }
    let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/src/bsdf/table/tables.f32");
    std::fs::write(path, bytes).unwrap();
}
