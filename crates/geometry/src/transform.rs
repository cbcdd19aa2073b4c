//! Affine transforms with their inverse, composed in `f64`.

use crate::aabb::Aabb;
use crate::error_bound::{abs, is_unit, round_trip, round_trip_by_shift, rounded_point};
use crate::hit::{Hit, SurfacePoint, SurfaceSample};
use crate::ray::{LocalRay, Ray};
use crate::shape::{AreaSample, LocalHit};
use glam::{DAffine3, DMat3, DVec3, Vec3};

/// An invertible affine map from local space to world space. Scales may differ per axis and may mirror.
///
/// ```
/// use glam::Vec3;
/// use heliostat_geometry::Transform;
///
/// let turn = Transform::rotation_xyz(Vec3::new(0.0, 0.0, std::f32::consts::FRAC_PI_2));
/// let place = turn.then(&Transform::translation(Vec3::new(5.0, 0.0, 0.0))).unwrap();
/// assert!(place.point(Vec3::X).distance(Vec3::new(5.0, 1.0, 0.0)) < 1e-6);
/// assert_eq!(place.point_to_local(Vec3::new(5.0, 0.0, 0.0)), Vec3::ZERO);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    to_world: DAffine3,
    to_local: DAffine3,
    kind: Kind,
}

/// How much of the map there is: the less, the less work for every ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Identity,
    Translation,
    Affine,
}

impl Kind {
    fn of(map: &DAffine3) -> Self {
        match (map.matrix3 == DMat3::IDENTITY, map.translation == DVec3::ZERO) {
            (true, true) => Self::Identity,
            (true, false) => Self::Translation,
            (false, _) => Self::Affine,
        }
    }
}

impl Default for Transform {
    fn default() -> Self {
        Self::IDENTITY
    }
}

impl Transform {
    /// Local space is world space.
    pub const IDENTITY: Self =
        Self { to_world: DAffine3::IDENTITY, to_local: DAffine3::IDENTITY, kind: Kind::Identity };

    /// From the map to world space; `None` when it has no finite inverse.
    pub fn new(to_world: DAffine3) -> Option<Self> {
        let determinant = to_world.matrix3.determinant();
        if !to_world.is_finite() || determinant == 0.0 {
            return None;
        }
        let mut to_local = to_world.inverse();
        // One step of Newton's iteration, so that the error bound of a round trip need not know the determinant.
        let residual = 2.0 * DMat3::IDENTITY - to_world.matrix3 * to_local.matrix3;
        to_local.matrix3 *= residual;
        to_local.translation = -(to_local.matrix3 * to_world.translation);
        to_local.is_finite().then(|| Self { to_world, to_local, kind: Kind::of(&to_world) })
    }

    /// A shift.
    pub fn translation(by: Vec3) -> Self {
        let by = by.as_dvec3();
        let to_world = DAffine3::from_translation(by);
        Self { to_world, to_local: DAffine3::from_translation(-by), kind: Kind::of(&to_world) }
    }

    /// A scale per axis, negative to mirror; `None` when one is 0 or not finite.
    pub fn scaling(by: Vec3) -> Option<Self> {
        Self::new(DAffine3::from_scale(by.as_dvec3()))
    }

    /// A turn about the x axis, then about the y axis, then about the z axis; angles in radians.
    pub fn rotation_xyz(angles: Vec3) -> Self {
        let angles = angles.as_dvec3();
        let turn = DMat3::from_rotation_z(angles.z)
            * DMat3::from_rotation_y(angles.y)
            * DMat3::from_rotation_x(angles.x);
        let inverse = turn.transpose();
        let to_world = DAffine3 { matrix3: turn, translation: DVec3::ZERO };
        let to_local = DAffine3 { matrix3: inverse, translation: DVec3::ZERO };
        Self { to_world, to_local, kind: Kind::of(&to_world) }
    }

    /// The place of a camera at `position`: local `-z` points to `target` and local `+y` as near to `up` as can be.
    ///
    /// `None` when position and target are the same. An `up` along the line of sight gives way to another axis.
    pub fn look_at(position: Vec3, target: Vec3, up: Vec3) -> Option<Self> {
        let back = (position.as_dvec3() - target.as_dvec3()).try_normalize()?;
        let right = perpendicular(up.as_dvec3(), back);
        let matrix3 = DMat3::from_cols(right, back.cross(right), back);
        Self::new(DAffine3 { matrix3, translation: position.as_dvec3() })
    }

    /// The place of a flat shape at `position`: its normal, local `+y`, points to `target` and local `-z` as near to
    /// `up` as can be, so that `v` grows upwards.
    ///
    /// `None` when position and target are the same. An `up` along that line gives way to another axis.
    pub fn face(position: Vec3, target: Vec3, up: Vec3) -> Option<Self> {
        let normal = (target.as_dvec3() - position.as_dvec3()).try_normalize()?;
        let right = perpendicular(up.as_dvec3(), normal);
        let matrix3 = DMat3::from_cols(right, normal, right.cross(normal));
        Self::new(DAffine3 { matrix3, translation: position.as_dvec3() })
    }

    /// This map, then `next`; `None` when together they leave the range of `f64`.
    pub fn then(&self, next: &Self) -> Option<Self> {
        Self::new(next.to_world * self.to_world)
    }

    /// The map between two, with matrices interpolated linearly: every point moves on a straight line.
    ///
    /// `weight` is that of `other`, in `[0, 1]`. `None` where the blend is flat, as halfway through half a turn.
    pub fn lerp(&self, other: &Self, weight: f32) -> Option<Self> {
        if weight == 0.0 || self.to_world == other.to_world {
            return Some(*self);
        }
        let (a, b, weight) = (self.to_world, other.to_world, f64::from(weight));
        let blend = |a: DVec3, b: DVec3| a * (1.0 - weight) + b * weight;
        let (ma, mb) = (a.matrix3, b.matrix3);
        let matrix3 = DMat3::from_cols(
            blend(ma.x_axis, mb.x_axis),
            blend(ma.y_axis, mb.y_axis),
            blend(ma.z_axis, mb.z_axis),
        );
        Self::new(DAffine3 { matrix3, translation: blend(a.translation, b.translation) })
    }

    /// The map from local to world space.
    pub fn matrix(&self) -> DAffine3 {
        self.to_world
    }

    /// The map from world to local space.
    pub fn inverse_matrix(&self) -> DAffine3 {
        self.to_local
    }

    /// Whether local space is world space.
    pub fn is_identity(&self) -> bool {
        self.kind == Kind::Identity
    }

    /// Whether the map turns right hands into left hands.
    pub fn is_mirror(&self) -> bool {
        self.to_world.matrix3.determinant() < 0.0
    }

    /// A point from local to world space.
    pub fn point(&self, p: Vec3) -> Vec3 {
        self.to_world.transform_point3(p.as_dvec3()).as_vec3()
    }

    /// A point from world to local space.
    pub fn point_to_local(&self, p: Vec3) -> Vec3 {
        self.to_local.transform_point3(p.as_dvec3()).as_vec3()
    }

    /// A displacement from local to world space.
    pub fn vector(&self, v: Vec3) -> Vec3 {
        if self.kind != Kind::Affine {
            return v;
        }
        self.to_world.transform_vector3(v.as_dvec3()).as_vec3()
    }

    /// A normal from local to world space, unit again.
    pub fn normal(&self, n: Vec3) -> Vec3 {
        self.normal_f64(n.as_dvec3()).as_vec3()
    }

    /// Normals map by the inverse transpose, so that they stay at right angles to tangents.
    fn normal_f64(&self, n: DVec3) -> DVec3 {
        let normal = if self.kind == Kind::Affine { self.to_local.matrix3.transpose() * n } else { n };
        if is_unit(normal) { normal } else { normal.normalize_or_zero() }
    }

    /// The ray in local space, `t` kept, for triangle meshes.
    #[inline]
    pub fn ray_to_local(&self, ray: &Ray) -> Ray {
        if self.kind == Kind::Identity {
            return *ray;
        }
        let local = self.local_ray(ray);
        Ray { origin: local.origin.as_vec3(), dir: local.dir.as_vec3(), range: ray.range }
    }

    /// The ray in local space, `t` kept, for analytic shapes.
    #[inline]
    pub fn local_ray(&self, ray: &Ray) -> LocalRay {
        let LocalRay { origin, dir, range } = LocalRay::from(ray);
        match self.kind {
            Kind::Identity => LocalRay { origin, dir, range },
            Kind::Translation => LocalRay { origin: origin + self.to_local.translation, dir, range },
            Kind::Affine => LocalRay {
                origin: self.to_local.transform_point3(origin),
                dir: self.to_local.transform_vector3(dir),
                range,
            },
        }
    }

    /// The smallest box around the image of `bounds`, rounded outward. Infinite sides stay infinite.
    pub fn bounds(&self, bounds: Aabb) -> Aabb {
        if self.is_identity() || bounds.is_empty() {
            return bounds;
        }
        if !bounds.is_finite() {
            return Aabb::EVERYTHING;
        }
        bounds.corners().into_iter().fold(Aabb::EMPTY, |around, corner| {
            let p = self.to_world.transform_point3(corner.as_dvec3()).as_vec3();
            let next_down = Vec3::new(p.x.next_down(), p.y.next_down(), p.z.next_down());
            let next_up = Vec3::new(p.x.next_up(), p.y.next_up(), p.z.next_up());
            around.grow(next_down).grow(next_up)
        })
    }

    /// A point of a surface in world space, with the error bound that a ray through this transform needs.
    ///
    /// `p`, `p_err` and `ng` as in [`LocalHit`].
    pub fn surface_point(&self, p: DVec3, p_err: f64, ng: DVec3) -> SurfacePoint {
        let world = match self.kind {
            Kind::Identity => {
                let p = p.as_vec3();
                let p_err = rounded_point(p, Vec3::ZERO, DVec3::splat(p_err));
                return SurfacePoint { p, p_err, ng: self.normal_f64(ng).as_vec3() };
            }
            Kind::Translation => p + self.to_world.translation,
            Kind::Affine => self.to_world.transform_point3(p),
        };
        let magnitude = world.abs() + self.to_world.translation.abs();
        let (spread, slack) = if self.kind == Kind::Translation {
            (p.abs(), DVec3::splat(p_err) + round_trip_by_shift(magnitude))
        } else {
            let linear = abs(self.to_world.matrix3);
            let slack =
                linear * DVec3::splat(p_err) + round_trip(linear, abs(self.to_local.matrix3), magnitude);
            (linear * p.abs(), slack)
        };
        SurfacePoint {
            p: world.as_vec3(),
            p_err: rounded_point(world.as_vec3(), spread.as_vec3(), slack),
            ng: self.normal_f64(ng).as_vec3(),
        }
    }

    /// How much larger a small piece of surface with local normal `ng` (any length) is in world space.
    ///
    /// # Source
    /// The cofactor matrix maps area vectors (Nanson's relation): `dA = |det M| |M^-T n| da`.
    pub fn area_stretch(&self, ng: DVec3) -> f64 {
        let determinant = self.to_world.matrix3.determinant().abs();
        determinant * (self.to_local.matrix3.transpose() * ng.normalize_or_zero()).length()
    }

    /// A point uniform by local area, seen from world space, with its density there.
    ///
    /// Under a scale that differs per axis a point uniform by local area is no longer uniform; the density says so.
    ///
    /// ```
    /// use glam::{Vec2, Vec3};
    /// use heliostat_geometry::Transform;
    /// use heliostat_geometry::shape::{Geometry, Rectangle};
    ///
    /// let lamp = Rectangle { size: Vec2::ONE };
    /// let place = Transform::scaling(Vec3::new(2.0, 7.0, 3.0)).unwrap();
    /// let sample = place.sample_to_world(&lamp.sample(Vec2::ZERO).unwrap());
    /// assert!((sample.pdf * 6.0 - 1.0).abs() < 1e-6);
    /// ```
    pub fn sample_to_world(&self, sample: &AreaSample) -> SurfaceSample {
        SurfaceSample {
            at: self.surface_point(sample.p, sample.p_err, sample.ng),
            uv: sample.uv,
            pdf: (sample.pdf / self.area_stretch(sample.ng)) as f32,
        }
    }

    /// A hit in local space, seen from world space.
    pub fn hit_to_world(&self, local: &LocalHit) -> Hit {
        let at = self.surface_point(local.p, local.p_err, local.ng);
        let ns = if local.ns == local.ng { at.ng } else { self.normal_f64(local.ns).as_vec3() };
        Hit {
            t: local.t as f32,
            at,
            // A zero or wrong-sided shading normal gives way to the geometric one.
            ns: if ns == Vec3::ZERO || ns.dot(at.ng) < 0.0 { at.ng } else { ns },
            uv: local.uv,
            dpdu: self.vector(local.dpdu),
            dpdv: self.vector(local.dpdv),
        }
    }
}

/// The unit vector along `up x axis`; any other across `axis` when `up` is along it.
fn perpendicular(up: DVec3, axis: DVec3) -> DVec3 {
    up.cross(axis).try_normalize().unwrap_or_else(|| axis.any_orthonormal_vector())
}
