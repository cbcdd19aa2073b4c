//! What `look_at` and `focus.at` can name: objects and models, at the centre of the box around them.

use super::names::Names;
use super::value::{Target, vector};
use crate::document::{Fault, Placed};
use glam::DVec3;

/// Named points in world space at one moment.
#[derive(Clone, Debug)]
pub(super) struct Targets<'a> {
    /// Names of objects, then of models.
    pub(super) names: &'a Names,
    /// One point for each name, and more that have none.
    pub(super) centres: Vec<DVec3>,
}

impl Targets<'_> {
    /// The point that `target` means.
    ///
    /// # Errors
    /// When no object has the name.
    pub(super) fn resolve(&self, target: &Placed<Target>) -> Result<DVec3, Fault> {
        match &**target {
            Target::Point(point) => Ok(vector(point)),
            Target::Object(name) => match self.names.index(name) {
                Some(index) => Ok(self.centres[index]),
                None => Err(self.names.unknown(name).or_at(target.span())),
            },
        }
    }

    /// The unit vector from `from` to `target`.
    ///
    /// # Errors
    /// When both are the same point, or the name is unknown.
    pub(super) fn direction(&self, from: DVec3, target: &Placed<Target>) -> Result<DVec3, Fault> {
        (self.resolve(target)? - from).try_normalize().ok_or_else(|| {
            Fault::new("the target is the position itself, so there is no direction")
                .with_help("move one of the two")
                .or_at(target.span())
        })
    }
}

/// The unit vector of a direction in the file.
///
/// # Errors
/// When it is zero.
pub(super) fn unit(direction: &Placed<super::value::Point>) -> Result<DVec3, Fault> {
    vector(direction).try_normalize().ok_or_else(|| {
        Fault::new("the direction is zero")
            .with_help("at least one of the three numbers must differ from 0")
            .or_at(direction.span())
    })
}
