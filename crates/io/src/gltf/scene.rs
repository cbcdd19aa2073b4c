//! Putting a scene together at a moment.

use super::animation::Moved;
use super::flaw::Flaw;
use super::instancing;
use super::mesh::{self, Bones, Drawn, PrimitiveKey, ShapeOf};
use super::motion::Stage;
use super::textures::Textures;
use super::{GltfModel, Moment, cameras, material, variants};
use crate::obj::unique;
use glam::DAffine3;
use gltf::json::mesh::Primitive;
use heliostat_geometry::{Aabb, Transform, TriMesh};
use heliostat_scene::object::Geometry;
use heliostat_scene::{Group, GroupId, MaterialId, MeshId, Motion, Object, Scene};
use std::collections::{HashMap, HashSet};
use std::sync::{Arc, PoisonError};

/// A scene so far.
pub(super) struct Assembly<'m> {
    model: &'m GltfModel,
    moment: &'m Moment,
    stage: Stage,
    textures: Textures<'m>,
    materials: HashMap<Option<usize>, MaterialId>,
    meshes: HashMap<*const TriMesh, MeshId>,
    taken: Taken,
    scene: Scene,
    flaws: Vec<Flaw>,
    /// Primitives of points and of lines.
    left_out: [usize; 2],
}

/// Names that are given away, by kind.
#[derive(Default)]
struct Taken {
    objects: HashSet<String>,
    materials: HashSet<String>,
    lights: HashSet<String>,
    cameras: HashSet<String>,
}

/// Reads the scene of a model at a moment, and what is wrong with it.
///
/// # Errors
/// When something that is shown is damaged.
pub(super) fn read(model: &GltfModel, moment: &Moment) -> Result<(Scene, Vec<Flaw>), Flaw> {
    let GltfModel { document, nodes, tracks, images, .. } = model;
    let stage = Stage::of(document, nodes, tracks, moment.seconds, moment.shutter)?;
    let mut assembly = Assembly {
        model,
        moment,
        stage,
        textures: Textures::new(document, images),
        materials: HashMap::new(),
        meshes: HashMap::new(),
        taken: Taken::default(),
        scene: Scene::default(),
        flaws: Vec::new(),
        left_out: [0; 2],
    };
    for &node in &nodes.shown {
        assembly.node(node)?;
    }
    Ok(assembly.finish())
}

impl Assembly<'_> {
    fn finish(mut self) -> (Scene, Vec<Flaw>) {
        for (count, what) in self.left_out.into_iter().zip(["points", "lines"]) {
            if count > 0 {
                let message = format!("holds {count} primitives of {what}, which are left out");
                let flaw = Flaw::new("", message);
                self.flaws.push(flaw.with_help("make them of triangles to see them"));
            }
        }
        self.scene.textures = std::mem::take(&mut self.textures.all);
        self.flaws.append(&mut self.textures.flaws);
        (self.scene, self.flaws)
    }

    /// Adds what a node carries.
    fn node(&mut self, node: usize) -> Result<(), Flaw> {
        let model = self.model;
        if let Some(mut camera) = cameras::of_node(&model.document, node, &self.stage, self.moment.aspect)? {
            camera.name = unique(camera.name, &mut self.taken.cameras);
            self.scene.cameras.push(camera);
        }
        if let Some(mut light) = model.lights.at(node, &self.stage.places[node]) {
            light.name = unique(light.name, &mut self.taken.lights);
            self.scene.lights.push(light);
        }
        match model.document.root.nodes[node].mesh {
            Some(mesh) => self.mesh(node, mesh.value()),
            None => Ok(()),
        }
    }

    /// Adds the mesh of a node: an object for each of its primitives.
    fn mesh(&mut self, node: usize, index: usize) -> Result<(), Flaw> {
        let root = &self.model.document.root;
        let dangling = || Flaw::dangling(format!("nodes[{node}].mesh"), "meshes", index, root.meshes.len());
        let (json, mesh) = (&root.nodes[node], root.meshes.get(index).ok_or_else(dangling)?);
        let weights = self.model.tracks.at(node, Moved::Weights, self.moment.seconds);
        let weights =
            weights.or_else(|| json.weights.clone()).or_else(|| mesh.weights.clone()).unwrap_or_default();
        let skin = json.skin.map(|skin| Bones::of(&self.model.document, skin.value(), &self.stage.places));
        let bones = skin.transpose()?;
        let named = json.name.as_ref().or(mesh.name.as_ref()).filter(|name| !name.is_empty());
        let name = named.map_or_else(|| format!("node {node}"), String::clone);
        let mut objects = Vec::new();
        for (i, primitive) in mesh.primitives.iter().enumerate() {
            let place = format!("meshes[{index}].primitives[{i}]");
            let material = variants::material(primitive, self.moment.variant, &place)?;
            let alpha = material::has_alpha(&self.model.document, material);
            let normal_map = material::normal_map_set(&self.model.document, material);
            let shape = ShapeOf { alpha, normal_map, weights: &weights, bones: bones.as_ref() };
            let Some(read) = self.primitive(primitive, &shape, &place)? else { continue };
            let material = self.material(material)?;
            let name = match mesh.primitives.len() {
                1 => name.clone(),
                _ => format!("{name}/{}", self.scene.materials[material.index()].name),
            };
            objects.push(self.object(name, read, material));
        }
        match instancing::places(&self.model.document, node)? {
            Some(copies) => self.place_copies(node, name, objects, copies),
            // Bent vertices are in the world already.
            None if bones.is_some() => self.scene.objects.append(&mut objects),
            None => self.place(node, objects),
        }
        Ok(())
    }

    /// The mesh of a primitive; `None` where it has no triangles.
    fn primitive(
        &mut self,
        primitive: &Primitive,
        shape: &ShapeOf<'_>,
        place: &str,
    ) -> Result<Option<Arc<TriMesh>>, Flaw> {
        match mesh::drawn(primitive) {
            Drawn::Triangles => {}
            Drawn::Points => self.left_out[0] += 1,
            Drawn::Lines => self.left_out[1] += 1,
        }
        let read = || mesh::read(&self.model.document, primitive, shape, place).map(Arc::new);
        let is_still = shape.bones.is_none() && shape.weights.iter().all(|&weight| weight == 0.0);
        let mesh = if is_still {
            // A panic while the lock was held leaves at worst a mesh unread.
            let mut known = self.model.meshes.lock().unwrap_or_else(PoisonError::into_inner);
            let key = PrimitiveKey::of(primitive, shape);
            match known.get(&key) {
                Some(known) => Arc::clone(known),
                None => Arc::clone(known.entry(key).or_insert(read()?)),
            }
        } else {
            read()?
        };
        Ok((!mesh.triangles.is_empty()).then_some(mesh))
    }

    fn material(&mut self, index: Option<usize>) -> Result<MaterialId, Flaw> {
        if let Some(known) = self.materials.get(&index) {
            return Ok(*known);
        }
        let mut material = material::read(&self.model.document, index, &mut self.textures)?;
        material.name = unique(material.name, &mut self.taken.materials);
        let id = MaterialId(self.scene.materials.len() as u32);
        self.scene.materials.push(material);
        self.materials.insert(index, id);
        Ok(id)
    }

    /// An object that stands where its mesh was made.
    fn object(&mut self, name: String, mesh: Arc<TriMesh>, material: MaterialId) -> Object {
        let meshes = &mut self.scene.meshes;
        let id = *self.meshes.entry(Arc::as_ptr(&mesh)).or_insert_with(|| {
            meshes.push(mesh);
            MeshId(meshes.len() as u32 - 1)
        });
        Object {
            name: unique(name, &mut self.taken.objects),
            geometry: Geometry::Mesh(id),
            materials: vec![material],
            motion: Motion::still(Transform::IDENTITY),
            visible: true,
            casts_shadow: true,
        }
    }

    /// Puts objects where their node stands; a node without size shows nothing.
    fn place(&mut self, node: usize, objects: Vec<Object>) {
        for object in objects {
            let bounds = match object.geometry {
                Geometry::Mesh(id) => self.scene.meshes[id.index()].bounds(),
                Geometry::Shape(_) | Geometry::Group(_) => Aabb::EMPTY,
            };
            if let Some(motion) = self.stage.motion(node, bounds) {
                self.scene.objects.push(Object { motion, ..object });
            }
        }
    }

    /// Puts copies of objects into a group at their node.
    fn place_copies(&mut self, node: usize, name: String, objects: Vec<Object>, places: Vec<DAffine3>) {
        if objects.is_empty() || places.is_empty() {
            return;
        }
        let geometry = Geometry::Group(GroupId(self.scene.groups.len() as u32));
        let name = unique(name, &mut self.taken.objects);
        self.scene.groups.push(Group { name: name.clone(), objects, places });
        let motion = Motion::still(Transform::IDENTITY);
        let group =
            Object { name, geometry, materials: Vec::new(), motion, visible: true, casts_shadow: true };
        self.place(node, vec![group]);
    }
}
