//! Collecting issues of the item at hand.

use super::issue::{ItemKind, Problem, SceneIssue};
use crate::color::Rgb;
use crate::ids::{GroupId, MaterialId, MediumId, MeshId, TextureId};
use crate::scene::Scene;
use std::borrow::Cow;
use std::collections::HashSet;

/// The issues so far and the item that is looked at.
pub(super) struct Collector<'a> {
    scene: &'a Scene,
    item: (ItemKind, usize, Cow<'a, str>),
    names: HashSet<(ItemKind, &'a str)>,
    issues: Vec<SceneIssue>,
}

impl<'a> Collector<'a> {
    pub(super) fn new(scene: &'a Scene) -> Self {
        Self {
            scene,
            item: (ItemKind::Scene, 0, Cow::Borrowed("")),
            names: HashSet::new(),
            issues: Vec::new(),
        }
    }

    /// Turns to an item without a name of its own.
    pub(super) fn turn_to(&mut self, kind: ItemKind, index: usize, name: &'a str) {
        self.item = (kind, index, Cow::Borrowed(name));
    }

    /// Turns to an object of a group.
    pub(super) fn turn_to_member(&mut self, group: &str, index: usize, name: &str) {
        self.item = (ItemKind::Member, index, Cow::Owned(format!("{group}/{name}")));
    }

    /// Turns to an item whose name must be unique.
    pub(super) fn turn_to_named(&mut self, kind: ItemKind, index: usize, name: &'a str) {
        self.turn_to(kind, index, name);
        if !self.names.insert((kind, name)) {
            self.add(Problem::DuplicateName);
        }
    }

    pub(super) fn add(&mut self, problem: Problem) {
        let (kind, index, name) = &self.item;
        let (kind, index, name) = (*kind, *index, name.clone().into_owned());
        self.issues.push(SceneIssue { kind, index, name, problem });
    }

    /// Whether all ids that were looked at point to something.
    pub(super) fn is_whole(&self) -> bool {
        !self.issues.iter().any(|issue| matches!(issue.problem, Problem::Dangling { .. }))
    }

    pub(super) fn finish(self) -> Result<(), Vec<SceneIssue>> {
        if self.issues.is_empty() { Ok(()) } else { Err(self.issues) }
    }

    pub(super) fn finite(&mut self, what: &'static str, is_finite: bool) {
        if !is_finite {
            self.add(Problem::NotFinite { what });
        }
    }

    /// A number that must be finite and pass `is_allowed`.
    pub(super) fn number(
        &mut self,
        what: &'static str,
        value: f32,
        expected: &'static str,
        is_allowed: impl Fn(f32) -> bool,
    ) {
        if !value.is_finite() {
            self.add(Problem::NotFinite { what });
        } else if !is_allowed(value) {
            self.add(Problem::OutOfRange { what, expected, found: f64::from(value) });
        }
    }

    pub(super) fn positive(&mut self, what: &'static str, value: f32) {
        self.number(what, value, "above 0", |v| v > 0.0);
    }

    pub(super) fn not_negative(&mut self, what: &'static str, value: f32) {
        self.number(what, value, "at least 0", |v| v >= 0.0);
    }

    pub(super) fn color(&mut self, what: &'static str, color: Rgb) {
        for value in color.to_array() {
            self.not_negative(what, value);
        }
    }

    pub(super) fn mesh(&mut self, id: MeshId) {
        self.id(ItemKind::Mesh, id.0, self.scene.meshes.len());
    }

    pub(super) fn group(&mut self, id: GroupId) {
        self.id(ItemKind::Group, id.0, self.scene.groups.len());
    }

    pub(super) fn material(&mut self, id: MaterialId) {
        self.id(ItemKind::Material, id.0, self.scene.materials.len());
    }

    pub(super) fn texture(&mut self, id: TextureId) {
        self.id(ItemKind::Texture, id.0, self.scene.textures.len());
    }

    pub(super) fn medium(&mut self, id: MediumId) {
        self.id(ItemKind::Medium, id.0, self.scene.media.len());
    }

    fn id(&mut self, kind: ItemKind, id: u32, count: usize) {
        if id as usize >= count {
            self.add(Problem::Dangling { kind, id, count });
        }
    }
}
