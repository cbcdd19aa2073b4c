//! Whether a scene can be rendered: every id points to something, every number means something.
//!
//! Scenes from files have passed stricter checks with places; this is for scenes made in code, and the last gate
//! before the renderer, which trusts what passed it.

mod collect;
mod groups;
mod issue;
mod items;
mod materials;
mod media;

pub use issue::{ItemKind, Problem, SceneIssue};

use crate::scene::Scene;
use collect::Collector;

impl Scene {
    /// Checks the whole scene.
    ///
    /// # Errors
    /// Everything that is wrong, in the order meshes, textures, materials, media, groups, objects, lights, cameras, background.
    ///
    /// ```
    /// use heliostat_scene::{Scene, validate::Problem};
    ///
    /// let issues = Scene::default().validate().unwrap_err();
    /// assert_eq!(issues[0].problem, Problem::NoCamera);
    /// ```
    pub fn validate(&self) -> Result<(), Vec<SceneIssue>> {
        let mut collector = Collector::new(self);
        items::meshes(self, &mut collector);
        items::textures(self, &mut collector);
        materials::materials(self, &mut collector);
        media::media(self, &mut collector);
        groups::groups(self, &mut collector);
        items::objects(self, &mut collector);
        items::lights(self, &mut collector);
        items::cameras(self, &mut collector);
        items::background(self, &mut collector);
        groups::sums(self, &mut collector);
        collector.finish()
    }
}
