//! From the tables of a scene file to a scene.

use super::assets::{Assets, Trouble};
use super::environment::EnvironmentTable;
use super::light::LightTable;
use super::material::{FindTexture, TextureUse};
use super::mesh::ModelTable;
use super::motion::{Motions, PixelSize};
use super::object::ObjectTable;
use super::stage::{Cast, Stage};
use super::targets::Targets;
use super::texture::{EncodingMode, TextureTable};
use super::{Directory, SceneFile};
use crate::document::{Fault, Placed, Sources};
use crate::error::Warning;
use crate::obj::{ObjModel, Placement};
use heliostat_geometry::{Aabb, Transform, TriMesh};
use heliostat_scene::light::LightKind;
use heliostat_scene::material::Phong;
use heliostat_scene::object::Geometry;
use heliostat_scene::scene::Background;
use heliostat_scene::texture::Pattern;
use heliostat_scene::{
    Camera, Light, Material, MaterialId, MeshId, Motion, Object, RenderSettings, Rgb, Scene, Texture,
    TextureId,
};
use std::sync::Arc;

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
    builder.materials()?;
    let meshes = builder.meshes()?;
    let models = builder.models()?;
    let boxes = builder.boxes(&meshes, &models)?;
    let cast = Cast { directory: &directory, boxes };
    let stage = cast.stage(file)?;
    let targets = cast.targets(&stage.things);
    builder.cameras(&stage, &targets)?;
    let settings = file.render.settings(builder.chosen_camera()?)?;
    let motions = builder.motions(&cast, &stage, file_at, &settings)?;
    builder.move_cameras(motions.cameras);
    let (objects, placed_models) = motions.things.split_at(file.object.len());
    builder.objects(objects)?;
    builder.place_models(&models, placed_models)?;
    builder.lights(&targets)?;
    builder.background()?;
    Ok(Built { scene: builder.scene, settings, warnings: builder.warnings })
}

struct Builder<'a> {
    file: &'a SceneFile,
    directory: &'a Directory,
    sources: &'a Sources,
    assets: &'a mut Assets,
    scene: Scene,
    warnings: Vec<Warning>,
}

impl Builder<'_> {
    /// Textures and materials; textures that no material uses are read too, so that a missing file is told.
    fn materials(&mut self) -> Result<(), Fault> {
        let mut textures = Textures {
            directory: self.directory,
            tables: &self.file.texture,
            assets: self.assets,
            sources: self.sources,
            made: vec![[None; 2]; self.file.texture.len()],
            textures: Vec::new(),
            warnings: Vec::new(),
        };
        let materials: Vec<Material> = self
            .file
            .material
            .iter()
            .map(|material| material.build(&mut textures))
            .collect::<Result<_, _>>()?;
        for index in 0..self.file.texture.len() {
            if textures.made[index] == [None; 2] {
                textures.get(index, TextureUse::Color);
            }
        }
        self.scene.textures = textures.textures;
        self.warnings.append(&mut textures.warnings);
        self.scene.materials = materials;
        Ok(())
    }

    fn meshes(&mut self) -> Result<Vec<Arc<TriMesh>>, Trouble> {
        let meshes: Vec<_> =
            self.file.mesh.iter().map(|table| self.assets.mesh(table)).collect::<Result<_, _>>()?;
        self.scene.meshes.clone_from(&meshes);
        Ok(meshes)
    }

    fn models(&mut self) -> Result<Vec<Arc<ObjModel>>, Trouble> {
        let models: Vec<Arc<ObjModel>> =
            self.file.model.iter().map(|table| self.assets.model(table)).collect::<Result<_, _>>()?;
        for model in &models {
            self.warnings.extend(model.warnings.iter().cloned());
        }
        Ok(models)
    }

    /// The boxes of objects and models in local space.
    fn boxes(&self, meshes: &[Arc<TriMesh>], models: &[Arc<ObjModel>]) -> Result<Vec<Aabb>, Fault> {
        let objects = self.file.object.iter().map(|object| {
            let keys = object.shape_keys();
            Ok(match (keys.shape()?, keys.mesh) {
                (Some(shape), _) => shape.geometry().bounds(),
                (None, Some(name)) => meshes[self.directory.meshes.find(name)?].bounds(),
                (None, None) => Aabb::EMPTY,
            })
        });
        let union = |model: &Arc<ObjModel>| {
            model.objects.iter().fold(Aabb::EMPTY, |bounds, object| bounds.union(object.mesh.bounds()))
        };
        objects.chain(models.iter().map(|model| Ok(union(model)))).collect()
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

    fn objects(&mut self, motions: &[Motion<Transform>]) -> Result<(), Fault> {
        for (i, (object, motion)) in self.file.object.iter().zip(motions).enumerate() {
            let keys = object.shape_keys();
            let geometry = self.geometry(keys.shape()?, keys.mesh)?;
            let materials = self.materials_of(object)?;
            self.scene.objects.push(Object {
                name: self.directory.things.name(i).to_owned(),
                geometry,
                materials,
                motion: motion.clone(),
                visible: object.visible.unwrap_or(true),
                casts_shadow: object.casts_shadow.unwrap_or(true),
            });
        }
        Ok(())
    }

    fn geometry(
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

    fn materials_of(&mut self, object: &ObjectTable) -> Result<Vec<MaterialId>, Fault> {
        let named = object.material_indices(&self.directory.materials)?;
        if named.is_empty() {
            return Ok(vec![self.default_material()]);
        }
        Ok(named.into_iter().map(|index| MaterialId(index as u32)).collect())
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

    fn place_models(&mut self, models: &[Arc<ObjModel>], motions: &[Motion<Transform>]) -> Result<(), Fault> {
        let first = self.file.object.len();
        for (i, table) in self.file.model.iter().enumerate() {
            let table: &ModelTable = table;
            let material = table.material.as_ref().map(|name| self.directory.materials.find(name));
            let placement = Placement {
                motion: motions[i].clone(),
                prefix: self.directory.things.name(first + i).to_owned(),
                material: material.transpose()?.map(|index| MaterialId(index as u32)),
                visible: table.visible.unwrap_or(true),
                casts_shadow: table.casts_shadow.unwrap_or(true),
            };
            models[i].append_to(&mut self.scene, &placement);
        }
        Ok(())
    }

    fn lights(&mut self, targets: &Targets<'_>) -> Result<(), Fault> {
        for (i, table) in self.file.light.iter().enumerate() {
            let kind = match table.simple_kind(targets)? {
                Some(kind) => kind,
                None => self.area_light(table, targets)?,
            };
            self.scene.lights.push(Light {
                name: self.directory.lights.name(i).to_owned(),
                intensity: table.radiance(),
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
            self.scene.background = table.simple_background();
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

/// Magenta: what stands for an image that could not be read.
const MISSING: Rgb = Rgb::new(1.0, 0.0, 1.0);

/// Makes the textures of the scene as materials ask for them.
struct Textures<'a> {
    directory: &'a Directory,
    tables: &'a [Placed<TextureTable>],
    assets: &'a mut Assets,
    sources: &'a Sources,
    /// For each table its texture for colours and for data.
    made: Vec<[Option<TextureId>; 2]>,
    textures: Vec<Texture>,
    warnings: Vec<Warning>,
}

impl FindTexture for Textures<'_> {
    fn find(&mut self, name: &Placed<String>, used_for: TextureUse) -> Result<TextureId, Fault> {
        let index = self.directory.textures.find(name)?;
        Ok(self.get(index, used_for))
    }
}

impl Textures<'_> {
    fn get(&mut self, index: usize, used_for: TextureUse) -> TextureId {
        let table = &self.tables[index];
        let encoding = match (table.encoding(), used_for) {
            (EncodingMode::Auto, TextureUse::Data) => EncodingMode::Linear,
            (encoding, _) => encoding,
        };
        // Only an image that is read as the file says depends on its use.
        let depends = table.image.is_some() && table.encoding() == EncodingMode::Auto;
        let slot = usize::from(depends && used_for == TextureUse::Data);
        if let Some(id) = self.made[index][slot] {
            return id;
        }
        let id = TextureId(self.textures.len() as u32);
        let pattern = self.pattern(table, encoding);
        self.textures.push(Texture { name: table.name.to_string(), pattern, uv: table.uv_transform() });
        self.made[index][slot] = Some(id);
        id
    }

    fn pattern(&mut self, table: &TextureTable, encoding: EncodingMode) -> Pattern {
        if let Some(checker) = &table.checker {
            return checker.pattern();
        }
        let Some(file) = &table.image else { return Pattern::Missing };
        let made_by = table.made_by.as_ref().map(|command| command.as_str());
        match self.assets.image(file, encoding, made_by) {
            Ok(image) => {
                let [wrap_u, wrap_v] = table.wraps();
                Pattern::Image { image, wrap_u, wrap_v, filtering: table.filtering() }
            }
            Err(fault) => {
                self.warnings.push(self.sources.warning(&fault));
                Pattern::Missing
            }
        }
    }
}
