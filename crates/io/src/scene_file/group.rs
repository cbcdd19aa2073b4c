//! `[[group]]`: objects that are placed together, as often as wanted.
//!
//! The objects of a group stand in its own space; an `[[object]]` with `group = "name"`, or an object of another group,
//! places all of them. Each keeps its own material. Nothing is copied: what a group holds is kept once in memory, at
//! whatever depth and however often it is placed. In layers that name objects, all of it bears the name of the `[[object]]`.
//!
//! `visible = false` and `casts_shadow = false` work on an object inside a group as on any other, and on the object that places
//! the group for all that it holds. Objects inside a group move by keyframes as well
//! (`target = "group.mill.object.sails.rotate.2"`).
//! Things inside that shine light the scene, each placed one as a light of its own, 1,024 at most.
//!
//! # Scene file
//! ```toml
//! [[group]]
//! name = "mill"
//! [[group.object]]               # as [[object]]: shapes, meshes, other groups, copies
//! cone = { radius = 2, top_radius = 1.5, height = 6 }
//! material = "brick"
//! [[group.object]]
//! name = "sails"                 # unique in the group; `object`, `object2`, ... if left out
//! group = "sails"                # groups may lie in one another, 16 deep, copies counted
//! translate = [0, 6, 2]
//!
//! [[object]]
//! group = "mill"                 # takes no material
//! translate = [10, 0, 0]         # scale, rotate, translate or matrix, copies, visible, casts_shadow
//! ```

use super::object::ObjectTable;
use crate::document::Placed;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Objects in a space of their own.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GroupTable {
    /// Name, unique among groups.
    pub name: Placed<String>,
    /// What it holds: keys as in `[[object]]`.
    #[serde(default)]
    pub object: Vec<Placed<ObjectTable>>,
}
