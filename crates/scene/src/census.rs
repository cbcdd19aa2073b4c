//! What groups add up to: each is counted once and multiplied, so that billions take no longer than the groups they are made
//! of.

use crate::group::Group;
use crate::ids::GroupId;
use crate::object::{Geometry, Object};
use crate::scene::Scene;
use std::fmt;

/// The sums of every group of a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Census {
    tallies: Vec<Tally>,
    order: Vec<GroupId>,
}

/// What a geometry adds up to. Sums beyond the range of a `u64` stay at its end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Shapes and meshes, each as often as it is placed.
    pub parts: u64,
    /// Triangles of meshes, each as often as it is placed.
    pub triangles: u64,
    /// Parts with a material that shines.
    pub lamps: u64,
    /// Groups that lie in one another.
    pub depth: u32,
}

/// Why groups cannot be counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CensusError {
    /// A group holds itself, directly or through others.
    Cycle(GroupId),
    /// Groups lie in one another deeper than [`Group::MAX_DEPTH`], seen from this one.
    TooDeep(GroupId),
    /// There are more parts than a `u64` can number.
    TooMany(GroupId),
    /// An object of the group names a group, mesh or material that does not exist.
    Dangling(GroupId),
}

/// How far the count of a group is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Progress {
    Waiting,
    Begun,
    Done,
}

impl Census {
    /// Counts all groups of a scene.
    ///
    /// # Errors
    /// When groups hold themselves, lie too deep, hold too much, or name what does not exist.
    pub fn new(scene: &Scene) -> Result<Self, CensusError> {
        let count = scene.groups.len();
        let census = Self { tallies: vec![Tally::default(); count], order: Vec::with_capacity(count) };
        let mut counter = Counter { scene, census, progress: vec![Progress::Waiting; count] };
        for id in (0..count as u32).map(GroupId) {
            counter.visit(id, 1)?;
        }
        Ok(counter.census)
    }

    /// All groups; what a group holds comes before it.
    pub fn order(&self) -> &[GroupId] {
        &self.order
    }

    /// The sums of a group.
    ///
    /// # Panics
    /// When the scene that was counted has no such group.
    pub fn group(&self, id: GroupId) -> Tally {
        self.tallies[id.index()]
    }

    /// The sums of an object of the scene, or of one of its groups.
    ///
    /// # Panics
    /// When the scene has no such mesh, material or group.
    pub fn object(&self, scene: &Scene, object: &Object) -> Tally {
        let shines = || object.materials.iter().any(|id| shines(scene, id.index()));
        let triangles = match &object.geometry {
            Geometry::Group(id) => return self.group(*id),
            Geometry::Mesh(id) => scene.meshes[id.index()].triangles.len() as u64,
            Geometry::Shape(_) => 0,
        };
        Tally { parts: 1, triangles, lamps: u64::from(shines()), depth: 0 }
    }
}

fn shines(scene: &Scene, material: usize) -> bool {
    !scene.materials[material].surface.emission().is_zero()
}

struct Counter<'s> {
    scene: &'s Scene,
    census: Census,
    progress: Vec<Progress>,
}

impl Counter<'_> {
    /// Counts a group, those that it holds first. It lies `depth` groups deep.
    fn visit(&mut self, id: GroupId, depth: u32) -> Result<(), CensusError> {
        match self.progress.get(id.index()) {
            Some(Progress::Done) => return Ok(()),
            Some(Progress::Begun) => return Err(CensusError::Cycle(id)),
            Some(Progress::Waiting) => {}
            None => return Err(CensusError::Dangling(id)),
        }
        // More would be a fault of the caller's stack before it is found by its depth.
        if depth > Group::MAX_DEPTH {
            return Err(CensusError::TooDeep(id));
        }
        self.progress[id.index()] = Progress::Begun;
        let scene = self.scene;
        let group = &scene.groups[id.index()];
        let mut sum = Tally::default();
        for object in &group.objects {
            if let Geometry::Group(inner) = object.geometry {
                self.visit(inner, depth + 1)?;
            }
            if is_dangling(scene, object) {
                return Err(CensusError::Dangling(id));
            }
            sum = sum.with(self.census.object(scene, object)).ok_or(CensusError::TooMany(id))?;
        }
        let total = sum.times(group.places.len() as u64).ok_or(CensusError::TooMany(id))?;
        let total = Tally { depth: sum.depth + 1, ..total };
        if total.depth > Group::MAX_DEPTH {
            return Err(CensusError::TooDeep(id));
        }
        self.census.tallies[id.index()] = total;
        self.census.order.push(id);
        self.progress[id.index()] = Progress::Done;
        Ok(())
    }
}

fn is_dangling(scene: &Scene, object: &Object) -> bool {
    let no_mesh = matches!(object.geometry, Geometry::Mesh(id) if id.index() >= scene.meshes.len());
    no_mesh || object.materials.iter().any(|id| id.index() >= scene.materials.len())
}

impl Tally {
    /// Both side by side; `None` with more parts than can be numbered.
    fn with(self, other: Self) -> Option<Self> {
        Some(Self {
            parts: self.parts.checked_add(other.parts)?,
            triangles: self.triangles.saturating_add(other.triangles),
            lamps: self.lamps.saturating_add(other.lamps),
            depth: self.depth.max(other.depth),
        })
    }

    /// So many copies; `None` with more parts than can be numbered.
    fn times(self, copies: u64) -> Option<Self> {
        Some(Self {
            parts: self.parts.checked_mul(copies)?,
            triangles: self.triangles.saturating_mul(copies),
            lamps: self.lamps.saturating_mul(copies),
            depth: self.depth,
        })
    }
}

impl CensusError {
    /// The group to blame.
    pub fn group(&self) -> GroupId {
        match *self {
            Self::Cycle(id) | Self::TooDeep(id) | Self::TooMany(id) | Self::Dangling(id) => id,
        }
    }
}

impl fmt::Display for CensusError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cycle(_) => f.write_str("the group holds itself"),
            Self::TooDeep(_) => {
                write!(f, "groups lie in one another more than {} deep", Group::MAX_DEPTH)
            }
            Self::TooMany(_) => f.write_str("the group holds more parts than can be numbered"),
            Self::Dangling(_) => f.write_str("the group holds something that does not exist"),
        }
    }
}

impl std::error::Error for CensusError {}
