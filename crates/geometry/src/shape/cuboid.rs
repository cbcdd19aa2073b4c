//! A box around the origin.

use super::{AreaSample, Geometry, LocalHit, Root};
use crate::aabb::Aabb;
use crate::error_bound::shape_point;
use crate::ray::LocalRay;
use glam::{DVec3, Vec2, Vec3};

/// A box around the origin; every face fills the parameter square, upright seen from outside.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid {
    /// Full lengths along x, y and z in metres, above 0.
    pub size: Vec3,
}

/// A face of the box: numbers 0 to 5 are `-x, +x, -y, +y, -z, +z`.
#[derive(Clone, Copy)]
struct Face {
    /// Outward normal.
    normal: DVec3,
    /// Direction of growing `u`; seen from outside to the right.
    right: DVec3,
    /// Direction of growing `v`; seen from outside upwards.
    up: DVec3,
}

impl Face {
    fn of(part: u8) -> Self {
        let (normal, up) = match part {
            0 => (DVec3::NEG_X, DVec3::Y),
            1 => (DVec3::X, DVec3::Y),
            2 => (DVec3::NEG_Y, DVec3::Z),
            3 => (DVec3::Y, DVec3::NEG_Z),
            4 => (DVec3::NEG_Z, DVec3::Y),
            _ => (DVec3::Z, DVec3::Y),
        };
        Self { normal, right: up.cross(normal), up }
    }

    /// Parameters of a point `p` on the face of a box of that size.
    fn uv(self, p: DVec3, size: DVec3) -> Vec2 {
        let u = 0.5 + p.dot(self.right) / size.dot(self.right).abs();
        let v = 0.5 + p.dot(self.up) / size.dot(self.up).abs();
        Vec2::new(u as f32, v as f32).clamp(Vec2::ZERO, Vec2::ONE)
    }
}

impl Cuboid {
    fn half(&self) -> DVec3 {
        0.5 * self.size.as_dvec3()
    }
}

impl Geometry for Cuboid {
    #[inline]
    fn hit(&self, ray: &LocalRay) -> Option<Root> {
        let half = self.half();
        let (mut enter, mut exit) = (f64::NEG_INFINITY, f64::INFINITY);
        let (mut enter_part, mut exit_part) = (0, 0);
        for (axis, low_part) in [(0, 0_u8), (1, 2), (2, 4)] {
            let (origin, dir, half) = (ray.origin[axis], ray.dir[axis], half[axis]);
            if dir == 0.0 {
                if origin.abs() > half {
                    return None;
                }
                continue;
            }
            // The near plane is on the side the ray comes from.
            let (inverse, side) = (1.0 / dir, half.copysign(dir));
            let (near, far) = ((-side - origin) * inverse, (side - origin) * inverse);
            let forward = u8::from(dir > 0.0);
            if near > enter {
                (enter, enter_part) = (near, low_part + 1 - forward);
            }
            if far < exit {
                (exit, exit_part) = (far, low_part + forward);
            }
        }
        if enter > exit {
            None
        } else if ray.accepts(enter) {
            Some(Root { t: enter, part: enter_part })
        } else {
            ray.accepts(exit).then_some(Root { t: exit, part: exit_part })
        }
    }

    fn surface(&self, ray: &LocalRay, root: Root) -> LocalHit {
        let (half, size, face) = (self.half(), self.size.as_dvec3(), Face::of(root.part));
        // Exactly onto the face, and not over its border.
        let at = ray.at(root.t).clamp(-half, half);
        let p = at + face.normal * (half.dot(face.normal.abs()) - at.dot(face.normal));
        LocalHit {
            t: root.t,
            p,
            p_err: shape_point(half.max_element()),
            ng: face.normal,
            ns: face.normal,
            uv: face.uv(p, size),
            dpdu: (size * face.right).as_vec3(),
            dpdv: (size * face.up).as_vec3(),
        }
    }

    fn bounds(&self) -> Aabb {
        Aabb { min: -0.5 * self.size, max: 0.5 * self.size }
    }

    fn area(&self) -> f64 {
        let d = self.size.as_dvec3();
        2.0 * (d.x * d.y + d.y * d.z + d.z * d.x)
    }

    fn sample(&self, u: Vec2) -> Option<AreaSample> {
        let (half, size, area) = (self.half(), self.size.as_dvec3(), self.area());
        if area <= 0.0 {
            return None;
        }
        // Choose a face by its area, and use what is left of the number inside the face.
        let mut left = f64::from(u.x) * area;
        let face_area = |axis: usize| size[(axis + 1) % 3] * size[(axis + 2) % 3];
        let mut part = 0;
        while part < 5 && left >= face_area(part / 2) {
            left -= face_area(part / 2);
            part += 1;
        }
        let along = (left / face_area(part / 2)).clamp(0.0, 1.0);
        let face = Face::of(part as u8);
        let (right, up) = (along - 0.5, f64::from(u.y) - 0.5);
        let p = half * face.normal + size * (right * face.right + up * face.up);
        Some(AreaSample {
            p,
            p_err: shape_point(half.max_element()),
            ng: face.normal,
            uv: face.uv(p, size),
            pdf: 1.0 / area,
        })
    }
}
