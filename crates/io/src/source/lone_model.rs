//! A lone model as a scene: a fitted camera and a neutral light where it has none, with the settings of flags.

use super::OpenOptions;
use super::document::Timeline;
use crate::document::Fault;
use crate::error::{LoadError, Warning, quote};
use crate::gltf::{Contents, GltfModel, Moment};
use crate::model::{FITTED_CAMERA, complete_gltf, exposure_of, has_glass, scene_of};
use crate::obj::ObjModel;
use crate::scene_file::{Assets, Built, SceneFile, Trouble};
use heliostat_scene::light::LightKind;
use heliostat_scene::settings::IntegratorKind;
use heliostat_scene::{RenderSettings, Scene};
use std::path::Path;

/// Sections that flags can set beside a model.
const SECTIONS: [&str; 3] = ["render", "output", "time"];

/// A model that is read.
#[derive(Debug)]
pub(super) enum LoneModel {
    Obj {
        name: String,
        model: ObjModel,
    },
    Gltf {
        model: Box<GltfModel>,
        /// Index of the variant of its materials.
        variant: Option<usize>,
    },
}

impl LoneModel {
    /// Whether a path is that of a model, by its ending.
    pub(super) fn is_at(path: &Path) -> bool {
        is_obj(path) || is_gltf(path)
    }

    /// Reads the model.
    ///
    /// # Errors
    /// When the file is missing or damaged, or a flag sets what a model does not have.
    pub(super) fn open(
        path: &Path,
        timeline: &Timeline,
        assets: &mut Assets,
        options: &OpenOptions,
    ) -> Result<Self, Trouble> {
        if let Some(outside) = timeline.override_outside(&SECTIONS) {
            let segment = &outside.segments()[0];
            return Err(Fault::new(format!("a model alone has no {}", quote(&segment.text)))
                .with_help("set it in a scene file with a [[model]]")
                .or_at(segment.span)
                .into());
        }
        if is_gltf(path) {
            return Self::open_gltf(path, options.variant.as_deref()).map_err(Trouble::Elsewhere);
        }
        if options.variant.is_some() {
            let error = LoadError::new(path, "has no variants").with_help("name a .gltf or .glb model");
            return Err(Trouble::Elsewhere(error));
        }
        Ok(Self::Obj {
            name: path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
            model: assets.lone_model(path).map_err(Trouble::Elsewhere)?,
        })
    }

    fn open_gltf(path: &Path, variant: Option<&str>) -> Result<Self, LoadError> {
        let model = Box::new(GltfModel::open(path)?);
        let variant = variant.map(|name| model.variant(name)).transpose()?;
        Ok(Self::Gltf { model, variant })
    }

    /// The model in a scene at a time, with the settings of `file`; and the stops that bring it to a middling brightness.
    ///
    /// # Errors
    /// When a flag names a camera that is not there, settings contradict each other, or something that is shown is damaged.
    pub(super) fn build(
        &self,
        file: &SceneFile,
        seconds: f64,
        shutter: f64,
    ) -> Result<(Built, f32), Trouble> {
        let settings = file.render.settings(0, IntegratorKind::Whitted)?;
        let aspect = settings.width as f32 / settings.height as f32;
        let moment = Moment { seconds, shutter, aspect, variant: None };
        let (mut scene, warnings, exposure) = self.scene(moment).map_err(Trouble::Elsewhere)?;
        let names = || scene.cameras.iter().map(|camera| camera.name.as_str());
        let camera = match &file.render.camera {
            None => 0,
            Some(name) => names().position(|known| known == name.as_str()).ok_or_else(|| {
                Fault::unknown("camera", name, names().collect::<Vec<_>>()).or_at(name.span())
            })?,
        };
        // Nobody sets up a lone model by hand: its glass and water let the light through.
        let transparent_shadows = file.render.transparent_shadows.unwrap_or_else(|| has_glass(&scene));
        let integrator =
            if file.render.integrator.is_some() { settings.integrator } else { scene.natural_integrator() };
        // What surfaces and sky send on stands for ambient light where paths follow it.
        if integrator.traces_paths() {
            scene.lights.retain(|light| light.kind != LightKind::Ambient);
        }
        let settings = RenderSettings { camera, transparent_shadows, integrator, ..settings };
        Ok((Built { settings, scene, warnings }, exposure))
    }

    fn scene(&self, moment: Moment) -> Result<(Scene, Vec<Warning>, f32), LoadError> {
        match self {
            Self::Obj { name, model } => {
                let scene = scene_of(model, name, moment.aspect);
                let exposure = exposure_of(&scene);
                Ok((scene, model.warnings.clone(), exposure))
            }
            Self::Gltf { model, variant } => {
                let (mut scene, warnings) = model.scene(&Moment { variant: *variant, ..moment })?;
                let exposure = complete_gltf(&mut scene, moment.aspect);
                Ok((scene, warnings, exposure))
            }
        }
    }

    /// The time of the last key of its animations in seconds.
    pub(super) fn last_key(&self) -> Option<f64> {
        match self {
            Self::Obj { .. } => None,
            Self::Gltf { model, .. } => model.last_key(),
        }
    }

    /// What the file holds, for formats that hold more than is shown.
    pub(super) fn contents(&self) -> Option<Contents> {
        match self {
            Self::Obj { .. } => None,
            Self::Gltf { model, .. } => Some(model.contents()),
        }
    }

    /// The names of the cameras.
    pub(super) fn camera_names(&self) -> Vec<String> {
        let own = match self {
            Self::Obj { .. } => Vec::new(),
            Self::Gltf { model, .. } => model.camera_names(),
        };
        own.into_iter().chain([FITTED_CAMERA.to_owned()]).collect()
    }
}

fn is_obj(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("obj"))
}

fn is_gltf(path: &Path) -> bool {
    path.extension()
        .is_some_and(|ending| ["gltf", "glb"].iter().any(|known| ending.eq_ignore_ascii_case(known)))
}
