//! A small deterministic source of random numbers.

use crate::shape::{Cone, Cuboid, Cylinder, Disk, Plane, Rectangle, Shape, Sphere, Torus, Triangle};
use crate::transform::Transform;
use crate::warp::square_to_sphere;
use glam::{DAffine3, DMat3, DQuat, Vec2, Vec3};

/// Random numbers from a seed, the same everywhere.
///
/// # Source
/// Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", OOPSLA 2014 (`SplitMix64`).
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// Starts at `seed`.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in `[0, 1)`.
    pub fn unit(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / (1_u64 << 24) as f32
    }

    /// Uniform in the unit square.
    pub fn square(&mut self) -> Vec2 {
        Vec2::new(self.unit(), self.unit())
    }

    /// Uniform between two numbers.
    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }

    /// Between two positive numbers, each order of magnitude equally likely.
    pub fn magnitude(&mut self, low: f32, high: f32) -> f32 {
        self.between(low.ln(), high.ln()).exp()
    }

    /// Uniform below `n`.
    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    /// Uniform in the cube `[-1, 1]^3`.
    pub fn cube(&mut self) -> Vec3 {
        Vec3::new(self.between(-1.0, 1.0), self.between(-1.0, 1.0), self.between(-1.0, 1.0))
    }

    /// A uniform unit vector.
    pub fn direction(&mut self) -> Vec3 {
        square_to_sphere(self.square())
    }

    /// Any bounded shape with lengths about 1, of all proportions that scenes hold.
    pub fn shape(&mut self) -> Shape {
        let kind = self.below(8);
        self.shape_of(kind)
    }

    /// A bounded shape of one kind, counted from 0 to 7; higher numbers give the infinite plane.
    pub fn shape_of(&mut self, kind: usize) -> Shape {
        let mut length = || self.magnitude(0.1, 2.0);
        match kind {
            0 => Shape::Sphere(Sphere { radius: length() }),
            1 => Shape::Cuboid(Cuboid { size: Vec3::new(length(), length(), length()) }),
            2 => Shape::Rectangle(Rectangle { size: Vec2::new(length(), length()) }),
            3 => {
                let radius = length();
                let inner_radius = [0.0, 0.6 * radius][self.below(2)];
                Shape::Disk(Disk { radius, inner_radius })
            }
            4 => {
                let (radius, height) = (length(), length());
                Shape::Cylinder(Cylinder { radius, height, capped: self.below(2) == 0 })
            }
            5 => {
                let (radius, other, height) = (length(), length(), length());
                let (radius, top_radius) = [(radius, 0.0), (radius, other), (0.0, other)][self.below(3)];
                Shape::Cone(Cone { radius, top_radius, height, capped: self.below(2) == 0 })
            }
            6 => {
                let minor = length();
                Shape::Torus(Torus { major: minor * self.magnitude(1.05, 20.0), minor })
            }
            7 => Shape::Triangle(Triangle { a: self.cube(), b: self.cube(), c: self.cube() }),
            _ => Shape::Plane(Plane),
        }
    }

    /// A turn, a scale per axis between `low` and `high` in one order of magnitude or mirrored, and a shift.
    pub fn transform(&mut self, low: f32, high: f32, shift: f32) -> Transform {
        let scale = self.magnitude(low, high);
        let mut factor = || f64::from(scale * self.magnitude(0.3, 3.0)) * [1.0, -1.0][self.below(2)];
        let scales = glam::DVec3::new(factor(), factor(), factor());
        let turn = DMat3::from_quat(self.rotation());
        let map = DAffine3 {
            matrix3: turn * DMat3::from_diagonal(scales),
            translation: (shift * self.cube()).as_dvec3(),
        };
        Transform::new(map).unwrap_or_default()
    }

    /// A uniform rotation.
    pub fn rotation(&mut self) -> DQuat {
        let axis = self.direction().as_dvec3().normalize();
        DQuat::from_axis_angle(axis, f64::from(self.between(0.0, std::f32::consts::TAU)))
    }
}
