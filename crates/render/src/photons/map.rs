//! Photons of one iteration, found by where they are: a hashed grid of cells as wide as the disc that counts.
//!
//! Photons of a cell stand in a row, in the order in which they were sent, so that sums over them are the same whoever made the
//! map.
//!
//! # Source
//! Teschner et al., "Optimized Spatial Hashing for Collision Detection of Deformable Objects", VMV 2003 (the hash); Silverman,
//! "Density Estimation for Statistics and Data Analysis", 1986, equation 4.5 (the kernel of Epanechnikov in the plane).

use crate::bsdf::Event;
use glam::{IVec3, Vec3};
use heliostat_scene::Rgb;
use std::f32::consts::PI;

/// Photons count where their surface is turned at most by so much: the cosine of 45 degrees. Others lie beyond an edge.
const SAME_SIDE: f32 = std::f32::consts::FRAC_1_SQRT_2;

/// Flux that has arrived at a surface that scatters it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Photon {
    pub(crate) p: Vec3,
    /// The geometric normal of the surface, to its outside.
    pub(crate) ng: Vec3,
    /// Unit direction to where it came from.
    pub(crate) to_light: Vec3,
    /// In W.
    pub(crate) flux: Rgb,
    pub(crate) bounces: Bounces,
}

/// What has happened to a photon on its way.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Bounces {
    pub(crate) total: u16,
    /// All but the first, which is the last of a path from the camera: none is too long for its last step.
    pub(crate) glossy: u16,
    pub(crate) transmission: u16,
}

impl Bounces {
    pub(super) fn count(&mut self, event: Event) {
        let is_first = self.total == 0;
        self.total = self.total.saturating_add(1);
        let count = if event == Event::Transmission { &mut self.transmission } else { &mut self.glossy };
        *count = count.saturating_add(u16::from(!is_first));
    }
}

/// All photons of an iteration.
#[derive(Debug)]
pub(crate) struct PhotonMap {
    radius: f32,
    photons: Vec<Photon>,
    /// For each number of a hash where its photons begin, and at the end how many there are.
    starts: Vec<u32>,
}

impl PhotonMap {
    /// A map of photons of which each counts so far away.
    pub(super) fn new(sent: &[Photon], radius: f32) -> Self {
        let count = sent.len().max(1).next_power_of_two();
        let mut map = Self { radius, photons: Vec::new(), starts: vec![0; count + 1] };
        let keys: Vec<usize> = sent.iter().map(|photon| map.key(map.cell(photon.p))).collect();
        // Count, add up, and put each behind those before it.
        keys.iter().for_each(|&key| map.starts[key + 1] += 1);
        (0..count).for_each(|key| map.starts[key + 1] += map.starts[key]);
        let mut next = map.starts.clone();
        let mut order = vec![0; sent.len()];
        for (i, &key) in keys.iter().enumerate() {
            order[next[key] as usize] = i;
            next[key] += 1;
        }
        map.photons = order.into_iter().map(|i| sent[i]).collect();
        map
    }

    /// Shows each photon near a point whose surface has the geometric normal `ng`, with what it counts per square metre.
    pub(crate) fn near(&self, p: Vec3, ng: Vec3, mut show: impl FnMut(&Photon, f32)) {
        if self.photons.is_empty() {
            return;
        }
        let least = self.cell(p - self.radius);
        let radius_squared = self.radius * self.radius;
        let peak = 2.0 / (PI * radius_squared);
        for corner in 0..8 {
            let cell = least + IVec3::new(corner & 1, corner >> 1 & 1, corner >> 2);
            let key = self.key(cell);
            for photon in &self.photons[self.starts[key] as usize..self.starts[key + 1] as usize] {
                let away = photon.p.distance_squared(p) / radius_squared;
                // Other cells may have the same hash.
                if away < 1.0 && photon.ng.dot(ng) > SAME_SIDE && self.cell(photon.p) == cell {
                    show(photon, peak * (1.0 - away));
                }
            }
        }
    }

    /// The cell of a point, wide enough that the ball around a point touches two along each axis.
    fn cell(&self, p: Vec3) -> IVec3 {
        // Leave room for the next cell in integers.
        (p / (2.0 * self.radius)).floor().clamp(Vec3::splat(-1.0e9), Vec3::splat(1.0e9)).as_ivec3()
    }

    fn key(&self, cell: IVec3) -> usize {
        let [x, y, z] = cell.to_array().map(|i| i as u32);
        let hash = x.wrapping_mul(73_856_093) ^ y.wrapping_mul(19_349_663) ^ z.wrapping_mul(83_492_791);
        // The upper bits of a product depend on all bits below.
        let mixed = u64::from(hash).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32;
        mixed as usize & (self.starts.len() - 2)
    }
}
