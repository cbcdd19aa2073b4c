//! The analytic shapes: a closed list, each in its own file, each in its own local space.
//!
//! Flat shapes lie in the plane `y = 0` with normal `+y`; round ones have the y axis; a cylinder and a cone
//! stand on `y = 0`; sphere, box and torus are centred at the origin. A [`crate::Transform`] puts them into the
//! world. Roots are found in `f64`: next to the rounding of an `f32` ray origin their own error vanishes, which is
//! what lets [`crate::Hit::spawn`] promise that a ray leaves the shape it started on.
//!
//! Surface parameters lie in `[0, 1]` (metres on the infinite plane) and are upright seen from outside: `u` to the
//! right, `v` up, `dpdu x dpdv` along the outward normal. Around the y axis `u = 0.5` faces `+z`. Flat parts are
//! mapped straight, without a pole.

mod cone;
mod cuboid;
mod cylinder;
mod disk;
mod flat;
mod frustum;
mod plane;
mod quartic;
mod rectangle;
mod round;
mod sphere;
mod torus;
mod triangle;

pub use cone::Cone;
pub use cuboid::Cuboid;
pub use cylinder::Cylinder;
pub use disk::Disk;
pub use plane::Plane;
pub use rectangle::Rectangle;
pub use sphere::Sphere;
pub use torus::Torus;
pub use triangle::Triangle;

use crate::aabb::Aabb;
use crate::ray::LocalRay;
use glam::{DVec3, Vec2, Vec3};

/// A point where a ray meets a shape, before the surface around it is worked out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Root {
    /// Ray parameter.
    pub t: f64,
    /// Which part of the shape was met: a face of the box, the cap of a cylinder; 0 where there is one part.
    pub part: u8,
}

/// A hit in local space, in `f64`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalHit {
    /// Ray parameter.
    pub t: f64,
    /// Position, moved onto the surface.
    pub p: DVec3,
    /// Bound of the error of `p` and of the next root that starts there, in `f64` arithmetic, per axis.
    pub p_err: f64,
    /// Geometric normal; any length but zero.
    pub ng: DVec3,
    /// Shading normal; any length, zero for none.
    pub ns: DVec3,
    /// Surface parameters.
    pub uv: Vec2,
    /// Change of position per unit of `u`.
    pub dpdu: Vec3,
    /// Change of position per unit of `v`.
    pub dpdv: Vec3,
}

/// A uniformly distributed point on a shape, in local space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AreaSample {
    /// Position.
    pub p: DVec3,
    /// As [`LocalHit::p_err`].
    pub p_err: f64,
    /// Unit outward normal.
    pub ng: DVec3,
    /// Surface parameters.
    pub uv: Vec2,
    /// Probability per unit of local area: `1 / area`.
    pub pdf: f64,
}

/// What every shape can say of itself.
///
/// ```
/// use glam::Vec2;
/// use heliostat_geometry::shape::{Disk, Geometry};
///
/// let disk = Disk { radius: 2.0, inner_radius: 1.0 };
/// let sample = disk.sample(Vec2::new(0.3, 0.8)).unwrap();
/// assert!((1.0..=2.0).contains(&sample.p.length()));
/// assert_eq!(sample.pdf * disk.area(), 1.0);
/// ```
pub trait Geometry {
    /// The nearest root that the ray accepts.
    fn hit(&self, ray: &LocalRay) -> Option<Root>;
    /// The surface at a root that [`Geometry::hit`] gave for the same ray.
    fn surface(&self, ray: &LocalRay, root: Root) -> LocalHit;
    /// [`Geometry::surface`] for callers that need no surface parameters: `uv`, `dpdu` and `dpdv` may be zero where that saves
    /// work.
    fn bare_surface(&self, ray: &LocalRay, root: Root) -> LocalHit {
        self.surface(ray, root)
    }
    /// Every root in the range of the ray, nearest first.
    fn each_root(&self, ray: &LocalRay, visit: &mut dyn FnMut(Root)) {
        let mut rest = *ray;
        while let Some(root) = self.hit(&rest) {
            visit(root);
            rest.range.min = (root.t as f32).next_up();
        }
    }

    /// The geometric normal at a root that [`Geometry::hit`] gave for the same ray, of any length but zero; cheaper than
    /// the whole surface where a shape says so.
    fn normal(&self, ray: &LocalRay, root: Root) -> DVec3 {
        self.surface(ray, root).ng
    }
    /// The box around the shape; infinite for the infinite plane.
    fn bounds(&self) -> Aabb;
    /// Surface area; infinite for the infinite plane.
    fn area(&self) -> f64;
    /// A point uniform by area from `u` in `[0, 1)^2`; `None` where the area is infinite or zero.
    fn sample(&self, u: Vec2) -> Option<AreaSample>;
}

/// The closed list of analytic shapes.
///
/// ```
/// use glam::Vec3;
/// use heliostat_geometry::shape::{Shape, Sphere};
/// use heliostat_geometry::{Ray, Transform};
///
/// let shape = Shape::Sphere(Sphere { radius: 1.0 });
/// let place = Transform::translation(Vec3::new(0.0, 0.0, -4.0));
/// let ray = place.local_ray(&Ray::new(Vec3::ZERO, Vec3::NEG_Z));
/// let root = shape.hit(&ray).unwrap();
/// let hit = place.hit_to_world(&shape.geometry().surface(&ray, root));
/// assert_eq!((hit.t, hit.at.ng), (3.0, Vec3::Z));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// See [`Sphere`].
    Sphere(Sphere),
    /// See [`Cuboid`].
    Cuboid(Cuboid),
    /// See [`Plane`].
    Plane(Plane),
    /// See [`Rectangle`].
    Rectangle(Rectangle),
    /// See [`Disk`].
    Disk(Disk),
    /// See [`Cylinder`].
    Cylinder(Cylinder),
    /// See [`Cone`].
    Cone(Cone),
    /// See [`Torus`].
    Torus(Torus),
    /// See [`Triangle`].
    Triangle(Triangle),
}

impl Shape {
    /// The nearest root that the ray accepts: [`Geometry::hit`] without the indirect call.
    #[inline(always)]
    pub fn hit(&self, ray: &LocalRay) -> Option<Root> {
        match self {
            Self::Sphere(s) => s.hit(ray),
            Self::Cuboid(s) => s.hit(ray),
            Self::Plane(s) => s.hit(ray),
            Self::Rectangle(s) => s.hit(ray),
            Self::Disk(s) => s.hit(ray),
            Self::Cylinder(s) => s.hit(ray),
            Self::Cone(s) => s.hit(ray),
            Self::Torus(s) => s.hit(ray),
            Self::Triangle(s) => s.hit(ray),
        }
    }

    /// The shape behind its common face, for everything that is not hot; a new shape adds its arm here.
    pub fn geometry(&self) -> &dyn Geometry {
        match self {
            Self::Sphere(s) => s,
            Self::Cuboid(s) => s,
            Self::Plane(s) => s,
            Self::Rectangle(s) => s,
            Self::Disk(s) => s,
            Self::Cylinder(s) => s,
            Self::Cone(s) => s,
            Self::Torus(s) => s,
            Self::Triangle(s) => s,
        }
    }
}
