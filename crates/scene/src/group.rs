//! Groups: objects in a space of their own, placed together as often as wanted.
//!
//! An object whose geometry is a group places all that the group holds. Groups hold groups; none may hold itself. A group
//! is kept once, however often and at whatever depth it is placed.

use crate::object::Object;
use glam::DAffine3;

/// Objects that are placed together.
///
/// ```
/// use glam::{DAffine3, DVec3};
/// use heliostat_geometry::shape::{Shape, Sphere};
/// use heliostat_geometry::Transform;
/// use heliostat_scene::material::Phong;
/// use heliostat_scene::object::Geometry;
/// use heliostat_scene::{Census, Group, GroupId, Material, MaterialId, Motion, Object, Scene};
///
/// let object = |name: &str, geometry, materials| Object {
///     name: name.into(),
///     geometry,
///     materials,
///     motion: Motion::still(Transform::IDENTITY),
///     visible: true,
///     casts_shadow: true,
/// };
/// let ball = Geometry::Shape(Shape::Sphere(Sphere { radius: 0.1 }));
/// // A row of a thousand balls, and a thousand of these rows.
/// let row = |along: DVec3| (0..1000).map(|i| DAffine3::from_translation(f64::from(i) * along)).collect();
/// let balls = Group {
///     name: "balls".into(),
///     objects: vec![object("ball", ball, vec![MaterialId(0)])],
///     places: row(DVec3::X),
/// };
/// let rows = Group {
///     name: "rows".into(),
///     objects: vec![object("balls", Geometry::Group(GroupId(0)), vec![])],
///     places: row(DVec3::Z),
/// };
/// let materials = vec![Material::new("grey", Phong::default())];
/// let scene = Scene { materials, groups: vec![balls, rows], ..Scene::default() };
/// let census = Census::new(&scene).unwrap();
/// assert_eq!(census.group(GroupId(1)).parts, 1_000_000);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Group {
    /// Name, for messages.
    pub name: String,
    /// What it holds, in the space of the group. At least one.
    pub objects: Vec<Object>,
    /// Copies: all of its objects stand at each of these places, maps from the space of its objects to the space of the
    /// group. At least one, each with an inverse.
    pub places: Vec<DAffine3>,
}

impl Group {
    /// Groups may lie in one another so deep: a group of plain objects is one deep.
    pub const MAX_DEPTH: u32 = 16;

    /// So many parts that shine, copies counted one by one, may lie in the groups that the objects of a scene place: each is
    /// a light of its own.
    pub const MAX_LAMPS: u64 = 1024;

    /// Objects in one place.
    pub fn once(name: impl Into<String>, objects: Vec<Object>) -> Self {
        Self { name: name.into(), objects, places: vec![DAffine3::IDENTITY] }
    }
}
