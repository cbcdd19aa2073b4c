//! `[[model]]`: the things of OBJ and glTF files as things of a scene.
//!
//! An OBJ file gives an object for each of its groups. A glTF file gives one group with all that its scene shows at the start of its
//! animations, so that its own motions and copies go on inside the model's; its cameras and lights stay behind.

use super::assets::{LoadedModel, Trouble};
use super::build::{Builder, warn};
use super::mesh::ModelTable;
use crate::document::{Fault, Placed};
use crate::error::quote;
use crate::gltf::{GltfModel, Moment};
use crate::obj::Placement;
use glam::DAffine3;
use heliostat_geometry::{Aabb, Transform};
use heliostat_scene::object::Geometry;
use heliostat_scene::{Group, GroupBoxes, GroupId, MaterialId, Motion, Object, Scene};
use std::path::Path;
use std::sync::Arc;

/// A model that is read.
#[derive(Debug)]
pub(super) enum Model {
    /// Its objects wait for their place.
    Obj(Arc<LoadedModel>),
    /// Its objects are in a group, which waits for its place.
    Gltf(GroupId),
}

impl Model {
    /// The box in local space.
    pub(super) fn bounds(&self, scene: &Scene, boxes: &GroupBoxes) -> Aabb {
        match self {
            Self::Obj(loaded) => loaded.bounds,
            Self::Gltf(group) => boxes.geometry(scene, &Geometry::Group(*group)),
        }
    }
}

/// Whether a name is that of a glTF file.
pub(super) fn is_gltf(name: &str) -> bool {
    let ending = Path::new(name).extension().unwrap_or_default();
    ending.eq_ignore_ascii_case("gltf") || ending.eq_ignore_ascii_case("glb")
}

/// Refuses keys that would do nothing.
pub(super) fn check(table: &ModelTable) -> Result<(), Fault> {
    if is_gltf(&table.file) && table.smooth_angle.is_some() {
        return Err(Fault::new("`smooth_angle` has no effect on a glTF model, which says what is smooth")
            .with_help("remove it")
            .or_at(table.file.span()));
    }
    Ok(())
}

impl Builder<'_> {
    /// Reads all models; to be called when the groups of the scene file are made.
    pub(super) fn models(&mut self) -> Result<Vec<Model>, Trouble> {
        let file = self.file;
        let first = file.object.len();
        let each = file.model.iter().enumerate();
        each.map(|(i, table)| {
            if is_gltf(&table.file) {
                let model = self.assets.gltf(&table.file, table.made_by.as_deref())?;
                let name = self.directory.things.name(first + i).to_owned();
                return self.gltf_group(table, name, &model).map(Model::Gltf);
            }
            let loaded = self.assets.model(table)?;
            warn(&mut self.warnings, &loaded.model.warnings);
            Ok(Model::Obj(loaded))
        })
        .collect()
    }

    /// Puts the models where they stand.
    pub(super) fn place_models(
        &mut self,
        models: &[Model],
        motions: &[Motion<Transform>],
    ) -> Result<(), Fault> {
        let first = self.file.object.len();
        for (i, table) in self.file.model.iter().enumerate() {
            let placement = Placement {
                motion: motions[i].clone(),
                prefix: self.directory.things.name(first + i).to_owned(),
                material: self.chosen_material(table)?,
                visible: table.visible.unwrap_or(true),
                casts_shadow: table.casts_shadow.unwrap_or(true),
            };
            match &models[i] {
                Model::Obj(loaded) => {
                    loaded.model.append_to(&mut self.scene, &placement);
                }
                Model::Gltf(group) => self.scene.objects.push(Object {
                    name: placement.prefix,
                    geometry: Geometry::Group(*group),
                    materials: Vec::new(),
                    motion: placement.motion,
                    visible: placement.visible,
                    casts_shadow: placement.casts_shadow,
                }),
            }
        }
        Ok(())
    }

    fn chosen_material(&self, table: &ModelTable) -> Result<Option<MaterialId>, Fault> {
        let material = table.material.as_ref().map(|name| self.directory.materials.find(name));
        Ok(material.transpose()?.map(|index| MaterialId(index as u32)))
    }

    /// Adds all that a glTF scene shows as one group.
    fn gltf_group(
        &mut self,
        table: &Placed<ModelTable>,
        name: String,
        model: &GltfModel,
    ) -> Result<GroupId, Trouble> {
        let (mut other, warnings) = model.scene(&Moment::default()).map_err(Trouble::Elsewhere)?;
        warn(&mut self.warnings, &warnings);
        if other.objects.is_empty() {
            let fault = Fault::new(format!("{} shows nothing", quote(&table.file)))
                .with_help("name a glTF file whose scene has meshes of triangles")
                .or_at(table.file.span());
            return Err(fault.into());
        }
        self.renumber(&mut other, &name, self.chosen_material(table)?);
        let scene = &mut self.scene;
        scene.meshes.append(&mut other.meshes);
        scene.textures.append(&mut other.textures);
        scene.materials.append(&mut other.materials);
        scene.groups.append(&mut other.groups);
        let id = GroupId(scene.groups.len() as u32);
        scene.groups.push(Group { name, objects: other.objects, places: vec![DAffine3::IDENTITY] });
        Ok(id)
    }

    /// Gives the things of another scene the numbers and names that they will have in this one, and its objects one material if it is
    /// chosen.
    fn renumber(&self, other: &mut Scene, name: &str, chosen: Option<MaterialId>) {
        let scene = &self.scene;
        let [meshes, textures, materials, groups] =
            [scene.meshes.len(), scene.textures.len(), scene.materials.len(), scene.groups.len()]
                .map(|count| count as u32);
        for material in &mut other.materials {
            material.each_texture(|id| id.0 += textures);
            material.name = format!("{name}/{}", material.name);
        }
        let inside = other.groups.iter_mut().flat_map(|group| &mut group.objects);
        for object in other.objects.iter_mut().chain(inside) {
            match &mut object.geometry {
                Geometry::Shape(_) => {}
                Geometry::Mesh(id) => id.0 += meshes,
                Geometry::Group(id) => id.0 += groups,
            }
            for id in &mut object.materials {
                *id = chosen.unwrap_or(MaterialId(id.0 + materials));
            }
        }
    }
}
