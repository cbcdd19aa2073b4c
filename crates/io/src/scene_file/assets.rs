//! Files that a scene names, read once and shared by all its frames.

use super::mesh::{MeshTable, ModelTable, smooth_angle};
use super::texture::EncodingMode;
use crate::document::{Fault, Placed};
use crate::error::{LoadError, Warning, quote};
use crate::file::read_file;
use crate::gltf::GltfModel;
use crate::ies;
use crate::image_file::{Limits, read_image};
use crate::nearest::nearest_name;
use crate::obj::{ObjModel, ObjOptions, Split, load_obj};
use crate::texture_cache::TextureCache;
use crate::volume_file::{Volume, read_volume};
use heliostat_geometry::{Aabb, TriMesh};
use heliostat_scene::image::Encoding;
use heliostat_scene::texture::Tile;
use heliostat_scene::{Image, Profile};
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What is wrong: with the scene file, or inside another file.
#[derive(Debug)]
pub(crate) enum Trouble {
    /// At a place of the scene file.
    Here(Fault),
    /// In a file that it names.
    Elsewhere(LoadError),
}

impl From<Fault> for Trouble {
    fn from(fault: Fault) -> Self {
        Self::Here(fault)
    }
}

/// What makes two readings of an OBJ file the same.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct ModelKey {
    path: PathBuf,
    smooth_angle_bits: u32,
    is_whole: bool,
    has_materials: bool,
}

/// A model with the box around all of it.
#[derive(Debug)]
pub(crate) struct LoadedModel {
    pub(crate) model: ObjModel,
    pub(crate) bounds: Aabb,
}

/// A mesh with the box around it.
#[derive(Clone, Debug)]
pub(crate) struct LoadedMesh {
    pub(crate) mesh: Arc<TriMesh>,
    pub(crate) bounds: Aabb,
}

/// Files that have been read.
#[derive(Debug)]
pub(crate) struct Assets {
    folder: PathBuf,
    models: HashMap<ModelKey, Arc<LoadedModel>>,
    gltf: HashMap<PathBuf, Arc<GltfModel>>,
    /// Images as their files say, as sRGB, and as plain numbers.
    images: [TextureCache; 3],
    volumes: HashMap<PathBuf, Arc<Volume>>,
    profiles: HashMap<PathBuf, Arc<Profile>>,
}

impl Assets {
    /// Nothing read yet; paths are relative to `folder`.
    pub(crate) fn new(folder: &Path) -> Self {
        let encoded = |encoding: Option<Encoding>| {
            TextureCache::with_reader(move |path| {
                let mut image = read_image(path, &Limits::default())?;
                image.encoding = encoding.unwrap_or(image.encoding);
                Ok(image)
            })
        };
        Self {
            folder: folder.to_owned(),
            models: HashMap::new(),
            gltf: HashMap::new(),
            profiles: HashMap::new(),
            images: [encoded(None), encoded(Some(Encoding::Srgb)), encoded(Some(Encoding::Linear))],
            volumes: HashMap::new(),
        }
    }

    /// An image.
    ///
    /// # Errors
    /// At the name, when the file cannot be read.
    pub(crate) fn image(
        &mut self,
        file: &Placed<String>,
        encoding: EncodingMode,
        made_by: Option<&str>,
    ) -> Result<Arc<Image>, Fault> {
        let path = self.folder.join(file.as_str());
        self.images[cache_of(encoding)].image(&path).map_err(|error| fault_at(file, &path, &error, made_by))
    }

    /// The images that a name with `<UDIM>` stands for.
    ///
    /// # Errors
    /// At the name, when there are none, or one of them cannot be read.
    pub(crate) fn tiles(
        &mut self,
        file: &Placed<String>,
        encoding: EncodingMode,
    ) -> Result<Vec<Tile>, Fault> {
        let path = self.folder.join(file.as_str());
        let cache = &mut self.images[cache_of(encoding)];
        cache.tiles(&path).map_err(|error| {
            let report = error.report();
            let fault = Fault::new(format!("{}: {}", quote(file), report.message)).or_at(file.span());
            fault.with_help(report.help.clone().unwrap_or_default())
        })
    }

    /// A grid of densities.
    ///
    /// # Errors
    /// At the name, when the file cannot be read.
    pub(crate) fn volume(
        &mut self,
        file: &Placed<String>,
        made_by: Option<&str>,
    ) -> Result<Arc<Volume>, Fault> {
        let path = self.folder.join(file.as_str());
        match self.volumes.entry(path.clone()) {
            Entry::Occupied(entry) => Ok(Arc::clone(entry.get())),
            Entry::Vacant(entry) => {
                let volume = read_volume(&path).map_err(|error| fault_at(file, &path, &error, made_by))?;
                Ok(Arc::clone(entry.insert(Arc::new(volume))))
            }
        }
    }

    /// The profile of a lamp.
    ///
    /// # Errors
    /// At the name, when the file cannot be read or makes no sense.
    pub(crate) fn profile(&mut self, file: &Placed<String>) -> Result<Arc<Profile>, Fault> {
        let path = self.folder.join(file.as_str());
        if let Some(known) = self.profiles.get(&path) {
            return Ok(Arc::clone(known));
        }
        let bytes = read_file(&path, ies::MOST_BYTES).map_err(|error| fault_at(file, &path, &error, None))?;
        let profile = ies::parse(&String::from_utf8_lossy(&bytes)).map_err(|error| {
            let message = format!("{}: line {}: {}", quote(file), error.line, error.message);
            Fault::new(message).with_help(error.help).or_at(file.span())
        })?;
        let profile = Arc::new(profile);
        self.profiles.insert(path, Arc::clone(&profile));
        Ok(profile)
    }

    /// All of an OBJ file as one mesh, and what its reader warns of.
    ///
    /// # Errors
    /// When the file cannot be read, is damaged, or has no faces.
    pub(crate) fn mesh(&mut self, table: &MeshTable) -> Result<(LoadedMesh, &[Warning]), Trouble> {
        let options = ObjOptions {
            smooth_angle: smooth_angle(table.smooth_angle),
            split: Split::Whole,
            materials: false,
            ..ObjOptions::default()
        };
        let loaded = self.obj(&table.file, &options, table.made_by.as_deref())?;
        let object = loaded.model.objects.first().ok_or_else(|| without_faces(&table.file))?;
        Ok((LoadedMesh { mesh: Arc::clone(&object.mesh), bounds: loaded.bounds }, &loaded.model.warnings))
    }

    /// An OBJ file as it is.
    ///
    /// # Errors
    /// When the file cannot be read, is damaged, or has no faces.
    pub(crate) fn model(&mut self, table: &ModelTable) -> Result<Arc<LoadedModel>, Trouble> {
        let options = ObjOptions {
            smooth_angle: smooth_angle(table.smooth_angle),
            materials: table.material.is_none(),
            ..ObjOptions::default()
        };
        self.obj(&table.file, &options, table.made_by.as_deref()).map(Arc::clone)
    }

    /// A glTF file.
    ///
    /// # Errors
    /// When it cannot be read or is damaged.
    pub(crate) fn gltf(
        &mut self,
        file: &Placed<String>,
        made_by: Option<&str>,
    ) -> Result<Arc<GltfModel>, Trouble> {
        let path = self.folder.join(file.as_str());
        if let Some(known) = self.gltf.get(&path) {
            return Ok(Arc::clone(known));
        }
        let model = GltfModel::open(&path).map_err(|error| {
            if path.is_file() {
                Trouble::Elsewhere(error)
            } else {
                Trouble::Here(fault_at(file, &path, &error, made_by))
            }
        })?;
        let model = Arc::new(model);
        self.gltf.insert(path, Arc::clone(&model));
        Ok(model)
    }

    /// An OBJ file that is the whole scene.
    ///
    /// # Errors
    /// When the file cannot be read, is damaged, or has no faces.
    pub(crate) fn lone_model(&mut self, path: &Path) -> Result<ObjModel, LoadError> {
        load_obj(path, &ObjOptions::default(), &mut self.images[0])
    }

    fn obj(
        &mut self,
        file: &Placed<String>,
        options: &ObjOptions,
        made_by: Option<&str>,
    ) -> Result<&Arc<LoadedModel>, Trouble> {
        let path = self.folder.join(file.as_str());
        let key = ModelKey {
            path: path.clone(),
            smooth_angle_bits: options.smooth_angle.to_bits(),
            is_whole: options.split == Split::Whole,
            has_materials: options.materials,
        };
        match self.models.entry(key) {
            Entry::Occupied(entry) => Ok(entry.into_mut()),
            Entry::Vacant(entry) => {
                let model = load_obj(&path, options, &mut self.images[0]).map_err(|error| {
                    // An error with a place lies inside a file; one without is about the file that the scene names.
                    match error.report().place {
                        Some(_) => Trouble::Elsewhere(error),
                        None => Trouble::Here(fault_at(file, &path, &error, made_by)),
                    }
                })?;
                let boxes = model.objects.iter().map(|object| object.mesh.bounds());
                let bounds = boxes.fold(Aabb::EMPTY, Aabb::union);
                Ok(entry.insert(Arc::new(LoadedModel { model, bounds })))
            }
        }
    }
}

/// The cache of images in an encoding.
fn cache_of(encoding: EncodingMode) -> usize {
    match encoding {
        EncodingMode::Auto => 0,
        EncodingMode::Srgb => 1,
        EncodingMode::Linear => 2,
    }
}

fn without_faces(file: &Placed<String>) -> Fault {
    Fault::new(format!("{} has no faces", quote(file)))
        .with_help("name an OBJ file with `f` lines")
        .or_at(file.span())
}

/// The trouble with a file, at the place that names it.
fn fault_at(file: &Placed<String>, path: &Path, error: &LoadError, made_by: Option<&str>) -> Fault {
    let report = error.report();
    let fault = Fault::new(format!("{}: {}", quote(file), report.message)).or_at(file.span());
    if path.exists() {
        return match &report.help {
            Some(help) => fault.with_help(help.clone()),
            None => fault,
        };
    }
    match (made_by, near_file(path)) {
        (Some(command), _) => fault.with_help(format!("make it with {}", quote(command))),
        (None, Some(near)) => fault.with_help(format!("did you mean {}?", quote(&near))),
        (None, None) => fault.with_help(format!("looked for {}", path.display())),
    }
}

/// The name in the folder of `path` that is most like its own.
fn near_file(path: &Path) -> Option<String> {
    let name = path.file_name()?.to_str()?;
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let names: Vec<String> = std::fs::read_dir(folder)
        .ok()?
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .collect();
    nearest_name(name, names.iter().map(String::as_str)).map(str::to_owned)
}
