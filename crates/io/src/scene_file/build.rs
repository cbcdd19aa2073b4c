//! From the tables of a scene file to a scene.

use super::assets::{Assets, Trouble};
use super::environment::EnvironmentTable;
use super::groups::Made;
use super::light::LightTable;
use super::models::Model;
use super::motion::{Motions, PixelSize};
use super::object::ObjectTable;
use super::stage::{Cast, Stage};
use super::targets::Targets;
use super::texture::EncodingMode;
use super::textures::Textures;
use super::{Directory, SceneFile};
use crate::document::{Fault, Placed, Sources};
use crate::error::Warning;
use heliostat_geometry::{Aabb, Transform};
use heliostat_scene::light::LightKind;
use heliostat_scene::material::Phong;
use heliostat_scene::object::Geometry;
use heliostat_scene::scene::Background;
use heliostat_scene::{Camera, Light, Material, MaterialId, MeshId, Motion, RenderSettings, Rgb, Scene};

/// Name of the material of objects that name none.
const DEFAULT_MATERIAL: &str = "default";

/// A scene with what the file says about its picture.
#[derive(Debug)]
pub(crate) struct Built {
    pub(crate) scene: Scene,
    pub(crate) settings: RenderSettings,
    pub(crate) warnings: Vec<Warning>,
}

/// The file at other moments: a share of the shutter in `[0, 1]`.
pub(crate) type FileAt<'a> = &'a dyn Fn(f64) -> Result<SceneFile, Fault>;

/// The names of the cameras of a file.
pub(crate) fn camera_names(file: &SceneFile) -> Result<Vec<String>, Fault> {
    Ok(file.directory()?.cameras.iter().map(str::to_owned).collect())
}

/// Builds the scene of `file`; things move over the shutter when `file_at` is there.
///
/// # Errors
/// Where tables contradict themselves or each other, and those of the files they name.
pub(crate) fn build(
    file: &SceneFile,
    file_at: Option<FileAt<'_>>,
    assets: &mut Assets,
    sources: &Sources,
) -> Result<Built, Trouble> {
    let directory = file.directory()?;
    file.check(&directory)?;
    let mut builder = Builder {
        file,
        directory: &directory,
        sources,
        assets,
        scene: Scene::default(),
        warnings: Vec::new(),
    };
    builder.media()?;
    builder.materials()?;
    let meshes = builder.meshes()?;
    builder.groups()?;
    let models = builder.models()?;
    let made = builder.made_objects()?;
    let boxes = builder.boxes(&made, &meshes, &models)?;
    let cast = Cast { directory: &directory, boxes };
    let stage = cast.stage(file)?;
    let targets = cast.targets(&stage.things);
    builder.cameras(&stage, &targets)?;
    let settings = file.render.settings(builder.chosen_camera()?, builder.scene.natural_integrator())?;
    let motions = builder.motions(&cast, &stage, file_at, &settings)?;
    builder.move_cameras(motions.cameras);
    let (objects, rest) = motions.things.split_at(file.object.len());
    let (placed_models, members) = rest.split_at(file.model.len());
    builder.objects(made, objects);
    builder.move_members(members);
    builder.place_models(&models, placed_models)?;
    builder.lights(&targets)?;
    builder.background()?;
    Ok(Built { scene: builder.scene, settings, warnings: builder.warnings })
}

/// Adds warnings, each once: several tables may name the same file.
pub(super) fn warn(warnings: &mut Vec<Warning>, new: &[Warning]) {
    for warning in new {
        if !warnings.contains(warning) {
            warnings.push(warning.clone());
        }
    }
}

/// Magenta: what stands for an image that could not be read.
const MISSING: Rgb = Rgb::new(1.0, 0.0, 1.0);

pub(super) struct Builder<'a> {
    pub(super) file: &'a SceneFile,
    pub(super) directory: &'a Directory,
    sources: &'a Sources,
    pub(super) assets: &'a mut Assets,
    pub(super) scene: Scene,
    pub(super) warnings: Vec<Warning>,
}

impl Builder<'_> {
    fn materials(&mut self) -> Result<(), Fault> {
        let mut textures = Textures::new(self.directory, &self.file.texture, self.assets, self.sources);
        for table in &self.file.material {
            self.scene.materials.push(table.build(&mut textures, &self.directory.media)?);
        }
        let (textures, warnings) = textures.finish();
        self.scene.textures = textures;
        self.warnings.extend(warnings);
        Ok(())
    }

    fn media(&mut self) -> Result<(), Fault> {
        for table in &self.file.medium {
            let mut medium = table.build(table.span())?;
            if let Some(grid) = &table.grid {
                let volume = self.assets.volume(&grid.file, grid.made_by.as_deref())?;
                medium.density = Some(grid.build(&volume)?);
            }
            self.scene.media.push(medium);
        }
        self.scene.atmosphere = self.file.environment.atmosphere(&self.directory.media)?;
        Ok(())
    }

    /// The boxes around the meshes, in local space.
    fn meshes(&mut self) -> Result<Vec<Aabb>, Trouble> {
        let mut boxes = Vec::new();
        for table in &self.file.mesh {
            let (loaded, warnings) = self.assets.mesh(table)?;
            warn(&mut self.warnings, warnings);
            self.scene.meshes.push(loaded.mesh);
            boxes.push(loaded.bounds);
        }
        Ok(boxes)
    }

    /// The boxes of objects, models and objects of groups in local space.
    fn boxes(&self, objects: &[Made], meshes: &[Aabb], models: &[Model]) -> Result<Vec<Aabb>, Fault> {
        let groups = self.group_boxes(objects)?;
        let objects = objects.iter().map(|made| match &made.geometry {
            Geometry::Mesh(id) => meshes[id.index()],
            other => groups.geometry(&self.scene, other),
        });
        let models = models.iter().map(|model| model.bounds(&self.scene, &groups));
        Ok(objects.chain(models).chain(self.member_boxes(&groups)).collect())
    }

    fn cameras(&mut self, stage: &Stage, targets: &Targets<'_>) -> Result<(), Fault> {
        for (i, (camera, _)) in self.file.camera.tables().into_iter().enumerate() {
            let pose = stage.cameras[i];
            let focus = camera.focus.as_ref().map(|focus| focus.build(camera, &pose, targets));
            self.scene.cameras.push(Camera {
                name: self.directory.cameras.name(i).to_owned(),
                motion: Motion::still(pose),
                projection: camera.projection()?,
                focus: focus.transpose()?,
            });
        }
        Ok(())
    }

    fn chosen_camera(&self) -> Result<usize, Fault> {
        self.file.render.camera.as_ref().map_or(Ok(0), |name| self.directory.cameras.find(name))
    }

    fn motions(
        &self,
        cast: &Cast<'_>,
        stage: &Stage,
        file_at: Option<FileAt<'_>>,
        settings: &RenderSettings,
    ) -> Result<Motions, Fault> {
        let Some(file_at) = file_at else { return Motions::still(stage) };
        let camera = &self.scene.cameras[settings.camera];
        let pixel = PixelSize::new(stage.cameras[settings.camera].translation, &camera.projection, settings);
        Motions::over_shutter(cast, file_at, &pixel)
    }

    fn move_cameras(&mut self, motions: Vec<Motion<glam::DAffine3>>) {
        for (camera, motion) in self.scene.cameras.iter_mut().zip(motions) {
            camera.motion = motion;
        }
    }

    fn made_objects(&mut self) -> Result<Vec<Made>, Fault> {
        let file = self.file;
        let objects = file.object.iter().enumerate();
        objects.map(|(i, object)| self.made(object, self.directory.things.name(i))).collect()
    }

    fn objects(&mut self, made: Vec<Made>, motions: &[Motion<Transform>]) {
        for (i, (made, motion)) in made.into_iter().zip(motions).enumerate() {
            let name = self.directory.things.name(i);
            self.scene.objects.push(made.object(&self.file.object[i], name, motion.clone()));
        }
    }

    pub(super) fn geometry(
        &self,
        shape: Option<heliostat_geometry::Shape>,
        mesh: Option<&Placed<String>>,
    ) -> Result<Geometry, Fault> {
        match (shape, mesh) {
            (Some(shape), _) => Ok(Geometry::Shape(shape)),
            (None, Some(name)) => Ok(Geometry::Mesh(MeshId(self.directory.meshes.find(name)? as u32))),
            // `check` has refused it already.
            (None, None) => Err(Fault::new("there is no shape")),
        }
    }

    pub(super) fn materials_of(
        &mut self,
        object: &ObjectTable,
        geometry: &Geometry,
    ) -> Result<Vec<MaterialId>, Fault> {
        let named = object.material_indices(&self.directory.materials)?;
        if named.is_empty() {
            return Ok(vec![self.default_material()]);
        }
        if named.len() > 1 {
            let slots = self.slots(geometry);
            if let Some(unused) = object.materials.as_ref().and_then(|names| names.get(slots)) {
                let fault = Fault::new(format!("this material is not used: the object has room for {slots}"))
                    .with_help("remove it, or give the mesh more `usemtl`")
                    .or_at(unused.span());
                self.warnings.push(self.sources.warning(&fault));
            }
        }
        Ok(named.into_iter().map(|index| MaterialId(index as u32)).collect())
    }

    /// How many materials a geometry can have.
    fn slots(&self, geometry: &Geometry) -> usize {
        match geometry {
            Geometry::Shape(_) | Geometry::Group(_) => 1,
            Geometry::Mesh(id) => {
                let slots = &self.scene.meshes[id.index()].slots;
                1 + slots.iter().copied().max().map_or(0, usize::from)
            }
        }
    }

    /// The material of objects that name none; a material of the file with that name takes its place.
    fn default_material(&mut self) -> MaterialId {
        let known = self.scene.materials.iter().position(|material| material.name == DEFAULT_MATERIAL);
        let index = known.unwrap_or_else(|| {
            self.scene.materials.push(Material::new(DEFAULT_MATERIAL, Phong::default()));
            self.scene.materials.len() - 1
        });
        MaterialId(index as u32)
    }

    fn lights(&mut self, targets: &Targets<'_>) -> Result<(), Fault> {
        for (i, table) in self.file.light.iter().enumerate() {
            let mut intensity = table.radiance();
            let kind = match (table.ies(), table.simple_kind(targets)?) {
                (Some((point, file)), _) => {
                    let profile = self.assets.profile(file)?;
                    intensity *= point.scale(&profile);
                    point.measured(profile)?
                }
                (None, Some(kind)) => kind,
                (None, None) => self.area_light(table, targets)?,
            };
            self.scene.lights.push(Light {
                name: self.directory.lights.name(i).to_owned(),
                intensity,
                samples: table.samples.map_or(1, super::number::Count::u32),
                kind,
            });
        }
        Ok(())
    }

    fn area_light(&self, light: &LightTable, targets: &Targets<'_>) -> Result<LightKind, Fault> {
        // `check` has made sure of the kind.
        let area = light.area.as_ref().ok_or_else(|| Fault::new("the light has no kind"))?;
        let keys = area.shape_keys();
        let affine = area.affine(targets)?;
        let transform = Transform::new(affine)
            .ok_or_else(|| Fault::new("the transform has no inverse").or_at(area.span()))?;
        Ok(LightKind::Area {
            geometry: self.geometry(keys.shape()?, keys.mesh)?,
            transform,
            two_sided: area.two_sided.unwrap_or(false),
            visible: area.visible.unwrap_or(true),
            falloff: super::light::falloff(area.falloff),
        })
    }

    fn background(&mut self) -> Result<(), Fault> {
        let table: &EnvironmentTable = &self.file.environment;
        let Some(file) = &table.image else {
            self.scene.background = table.simple_background()?;
            return Ok(());
        };
        let made_by = table.made_by.as_ref().map(|command| command.as_str());
        self.scene.background = match self.assets.image(file, EncodingMode::Auto, made_by) {
            Ok(image) => {
                Background::Image { image, intensity: table.intensity(), rotation: table.rotation() }
            }
            Err(fault) => {
                self.warnings.push(self.sources.warning(&fault));
                Background::Constant(MISSING)
            }
        };
        Ok(())
    }
}
