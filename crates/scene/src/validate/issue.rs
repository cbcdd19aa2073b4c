//! What can be wrong with a scene.

use crate::census::CensusError;
use crate::group::Group;
use heliostat_geometry::mesh::MeshError;
use std::fmt;

/// Which array of the scene an issue lies in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ItemKind {
    /// The scene as a whole.
    Scene,
    /// [`crate::Scene::meshes`].
    Mesh,
    /// [`crate::Scene::textures`].
    Texture,
    /// [`crate::Scene::materials`].
    Material,
    /// [`crate::Scene::media`].
    Medium,
    /// [`crate::Scene::groups`].
    Group,
    /// [`crate::Group::objects`]; the name is that of the group, a slash, and that of the object.
    Member,
    /// [`crate::Scene::objects`].
    Object,
    /// [`crate::Scene::lights`].
    Light,
    /// [`crate::Scene::cameras`].
    Camera,
}

impl fmt::Display for ItemKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Scene => "scene",
            Self::Mesh => "mesh",
            Self::Texture => "texture",
            Self::Material => "material",
            Self::Medium => "medium",
            Self::Group => "group",
            Self::Member | Self::Object => "object",
            Self::Light => "light",
            Self::Camera => "camera",
        })
    }
}

/// What is wrong with an item.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Problem {
    /// There is nothing to see the scene through.
    NoCamera,
    /// An id points beyond the end of its array.
    Dangling {
        /// What the id names.
        kind: ItemKind,
        /// The id.
        id: u32,
        /// How many there are.
        count: usize,
    },
    /// An object has no material.
    NoMaterial,
    /// An earlier item of the same kind has the same name.
    DuplicateName,
    /// A number is infinite or not a number.
    NotFinite {
        /// The number.
        what: &'static str,
    },
    /// A number is finite and out of range.
    OutOfRange {
        /// The number.
        what: &'static str,
        /// The range in words.
        expected: &'static str,
        /// What it is.
        found: f64,
    },
    /// An area light has no end.
    InfiniteArea,
    /// A triangle or a mesh has no surface to sample.
    NoArea,
    /// The samples of an image are not as many as its size says, or it has no size.
    ImageSize,
    /// The values of a grid are not as many as its size says, or it has no size.
    GridSize,
    /// A mesh contradicts itself.
    Mesh(MeshError),
    /// A group holds nothing.
    EmptyGroup,
    /// A group stands nowhere.
    NoPlace,
    /// The place of a copy has no inverse.
    Singular {
        /// Index of the copy.
        copy: usize,
    },
    /// An object that places a group has materials, which nothing would use.
    GroupMaterial,
    /// An area light cannot be a group.
    GroupLight,
    /// Groups cannot be counted.
    Groups(CensusError),
    /// The groups of an object and those before it hold too many parts that shine.
    TooManyLamps {
        /// How many.
        count: u64,
    },
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoCamera => f.write_str("there is no camera"),
            Self::Dangling { kind, id, count } => {
                write!(f, "{kind} {id} does not exist, there are {count}")
            }
            Self::NoMaterial => f.write_str("there is no material"),
            Self::DuplicateName => f.write_str("the name is taken by an earlier one"),
            Self::NotFinite { what } => write!(f, "{what} is not finite"),
            Self::OutOfRange { what, expected, found } => {
                write!(f, "{what} must be {expected}, is {found}")
            }
            Self::InfiniteArea => f.write_str("a light cannot have an infinite surface"),
            Self::NoArea => f.write_str("there is no surface"),
            Self::ImageSize => f.write_str("the image has not as many samples as its size says"),
            Self::GridSize => f.write_str("the grid has not as many values as its size says"),
            Self::Mesh(error) => error.fmt(f),
            Self::EmptyGroup => f.write_str("the group holds no objects"),
            Self::NoPlace => f.write_str("the group has no place to stand"),
            Self::Singular { copy } => write!(f, "the transform of copy {copy} has no inverse"),
            Self::GroupMaterial => {
                f.write_str("a group takes no material: the objects that it holds have their own")
            }
            Self::GroupLight => f.write_str("a group cannot be an area light"),
            Self::Groups(error) => error.fmt(f),
            Self::TooManyLamps { count } => write!(
                f,
                "groups bring {count} things that shine, each a light of its own; {} is the most: make fewer copies, or take \
                 the emission from the material",
                Group::MAX_LAMPS
            ),
        }
    }
}

/// One thing that is wrong, and with what.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneIssue {
    /// Which array.
    pub kind: ItemKind,
    /// Index in that array.
    pub index: usize,
    /// Name, where the item has one.
    pub name: String,
    /// What is wrong.
    pub problem: Problem,
}

impl fmt::Display for SceneIssue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.kind, self.name.as_str()) {
            (ItemKind::Scene, _) => write!(f, "{}", self.problem),
            (kind, "") => write!(f, "{kind} {}: {}", self.index, self.problem),
            (kind, name) => write!(f, "{kind} `{name}`: {}", self.problem),
        }
    }
}

impl std::error::Error for SceneIssue {}
