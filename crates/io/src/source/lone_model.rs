//! A lone `.obj` as a scene: a fitted camera and a neutral light, with the settings of flags.

use super::document::Timeline;
use crate::document::Fault;
use crate::error::quote;
use crate::model::{FITTED_CAMERA, has_glass, scene_of};
use crate::obj::ObjModel;
use crate::scene_file::{Assets, Built, SceneFile, Trouble};
use heliostat_scene::RenderSettings;
use heliostat_scene::settings::IntegratorKind;
use std::path::Path;

/// Sections that flags can set beside a model.
const SECTIONS: [&str; 3] = ["render", "output", "time"];

/// A model that is read.
#[derive(Debug)]
pub(super) struct LoneModel {
    name: String,
    model: ObjModel,
}

impl LoneModel {
    /// Reads the model.
    ///
    /// # Errors
    /// When the file is missing or damaged, or a flag sets what a model does not have.
    pub(super) fn open(path: &Path, timeline: &Timeline, assets: &mut Assets) -> Result<Self, Trouble> {
        if let Some(outside) = timeline.override_outside(&SECTIONS) {
            let segment = &outside.segments()[0];
            return Err(Fault::new(format!("a model alone has no {}", quote(&segment.text)))
                .with_help("set it in a scene file with a [[model]]")
                .or_at(segment.span)
                .into());
        }
        Ok(Self {
            name: path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
            model: assets.lone_model(path).map_err(Trouble::Elsewhere)?,
        })
    }

    /// The model in a scene with the settings of `file`.
    ///
    /// # Errors
    /// When a flag names a camera that is not there, or settings contradict each other.
    pub(super) fn build(&self, file: &SceneFile) -> Result<Built, Fault> {
        let settings = file.render.settings(0, IntegratorKind::Whitted)?;
        let aspect = settings.width as f32 / settings.height as f32;
        let scene = scene_of(&self.model, &self.name, aspect);
        let names = || scene.cameras.iter().map(|camera| camera.name.as_str());
        let camera = match &file.render.camera {
            None => 0,
            Some(name) => names().position(|known| known == name.as_str()).ok_or_else(|| {
                Fault::unknown("camera", name, names().collect::<Vec<_>>()).or_at(name.span())
            })?,
        };
        // Nobody sets up a lone model by hand: its glass and water let the light through.
        let transparent_shadows = file.render.transparent_shadows.unwrap_or_else(|| has_glass(&scene));
        let warnings = self.model.warnings.clone();
        let integrator =
            if file.render.integrator.is_some() { settings.integrator } else { scene.natural_integrator() };
        let settings = RenderSettings { camera, transparent_shadows, integrator, ..settings };
        Ok(Built { settings, scene, warnings })
    }

    /// The names of the cameras.
    pub(super) fn camera_names(&self) -> Vec<String> {
        vec![FITTED_CAMERA.to_owned()]
    }
}
