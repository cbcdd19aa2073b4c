//! The scene file: TOML tables for everything in a scene, and their meaning.
//!
//! This is the manual of the format: one module for each section, with its keys and their defaults; the JSON
//! Schema that editors use is made from the same types ([`crate::schema`]).
//!
//! - Right-handed, y up. Lengths in metres, angles in degrees, times in seconds.
//! - Colours are linear Rec.709: a number for grey, or `[red, green, blue]`.
//! - Values of materials may come from textures; see [`texturable`].
//! - Paths of files are relative to the scene file.
//! - Unknown keys, numbers out of range and keys that would do nothing are errors, with their place.
//! - Any number can move; see [`crate::animation`]. The same paths serve `--set PATH=VALUE`.
//!
//! A whole scene:
//! ```toml
//! [camera]
//! position = [0, 1, 5]
//! look_at = "ball"
//!
//! [[light]]
//! directional = { direction = [-1, -2, -1] }
//!
//! [[object]]
//! name = "ball"
//! sphere = { radius = 1 }
//! ```
//!
//! | section | module | what |
//! |---|---|---|
//! | `[render]` | [`render`], [`depth_limits`] | size, samples, integrator, layers |
//! | `[output]` | [`output`] | view transform, bits |
//! | `[time]` | [`time`] | frames, shutter |
//! | `[camera]`, `[[camera]]` | [`camera`], [`focus`] | where from |
//! | `[environment]` | [`environment`], [`sky`] | what is behind everything |
//! | `[[texture]]` | [`texture`] | images and patterns |
//! | `[[medium]]` | [`medium`] | what light flies through |
//! | `[[material]]` | [`material`], [`standard`] | how surfaces answer light |
//! | `[[mesh]]`, `[[model]]` | [`mesh`] | OBJ and glTF files |
//! | `[[object]]` | [`object`], [`shape`], [`placement`], [`copies`] | what is there to see |
//! | `[[group]]` | [`group`] | objects that are placed together |
//! | `[[light]]` | [`light`], [`area`] | what lights it |
//! | `[[animation]]` | [`crate::animation`] | keyframes |

pub mod area;
mod assets;
mod build;
pub mod camera;
mod cameras;
mod choice;
pub mod copies;
pub mod depth_limits;
mod edit;
pub mod environment;
pub mod focus;
pub mod group;
mod groups;
mod hierarchy;
pub mod light;
pub mod material;
pub mod medium;
pub mod mesh;
mod models;
mod motion;
mod names;
pub mod number;
pub mod object;
pub mod output;
pub mod placement;
pub mod render;
pub mod shape;
pub mod sky;
mod stage;
pub mod standard;
mod targets;
pub mod texturable;
pub mod texture;
mod textures;
pub mod time;
pub mod value;

pub use crate::document::Placed;
pub(crate) use assets::{Assets, Trouble};
pub(crate) use build::{Built, FileAt, build, camera_names};
pub(crate) use edit::set;

use crate::animation::AnimationTable;
use crate::document::{Fault, Span};
use names::{Names, name_or_implicit};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A whole scene file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SceneFile {
    /// How much work goes into a picture.
    pub render: render::RenderTable,
    /// How pictures are written.
    pub output: output::OutputTable,
    /// Frames and shutter.
    pub time: time::TimeTable,
    /// Where from: one `[camera]`, or several `[[camera]]`.
    pub camera: Placed<camera::Cameras>,
    /// What rays see that leave the scene.
    pub environment: environment::EnvironmentTable,
    /// Images and patterns.
    pub texture: Vec<Placed<texture::TextureTable>>,
    /// What light flies through, is absorbed and scattered in.
    pub medium: Vec<Placed<medium::MediumTable>>,
    /// How surfaces answer light.
    pub material: Vec<Placed<material::MaterialTable>>,
    /// OBJ files as one mesh each.
    pub mesh: Vec<Placed<mesh::MeshTable>>,
    /// OBJ files as they are.
    pub model: Vec<Placed<mesh::ModelTable>>,
    /// What is there to see.
    pub object: Vec<Placed<object::ObjectTable>>,
    /// Objects that are placed together.
    pub group: Vec<Placed<group::GroupTable>>,
    /// What lights it.
    pub light: Vec<Placed<light::LightTable>>,
    /// Keyframes.
    pub animation: Vec<Placed<AnimationTable>>,
}

/// The names of all sections.
#[derive(Clone, Debug)]
struct Directory {
    cameras: Names,
    textures: Names,
    media: Names,
    materials: Names,
    meshes: Names,
    /// Objects, then models.
    things: Names,
    groups: Names,
    /// The objects of each group.
    members: Vec<Names>,
    lights: Names,
}

impl SceneFile {
    /// Collects all names.
    ///
    /// # Errors
    /// At the second of two equal names.
    fn directory(&self) -> Result<Directory, Fault> {
        let cameras = self.camera.tables().into_iter().enumerate();
        let cameras =
            cameras.map(|(i, (c, table))| name_or_implicit(c.name.as_ref(), table, "camera", i, None));
        let placed = |name: &Placed<String>| (name.to_string(), name.span());
        let objects = self.object.iter().enumerate();
        let objects = objects.map(|(i, o)| name_or_implicit(o.name.as_ref(), o.span(), "object", i, None));
        let models = self.model.iter().enumerate();
        let models =
            models.map(|(i, m)| name_or_implicit(m.name.as_ref(), m.span(), "model", i, Some(&m.file)));
        let lights = self.light.iter().enumerate();
        let lights = lights.map(|(i, l)| name_or_implicit(l.name.as_ref(), l.span(), "light", i, None));
        Ok(Directory {
            cameras: Names::new("camera", cameras)?,
            textures: Names::new("texture", self.texture.iter().map(|t| placed(&t.name)))?,
            media: Names::new("medium", self.medium.iter().map(|m| placed(&m.name)))?,
            materials: Names::new("material", self.material.iter().map(|m| placed(&m.name)))?,
            meshes: Names::new("mesh", self.mesh.iter().map(|m| placed(&m.name)))?,
            things: Names::new("object", objects.chain(models))?,
            groups: Names::new("group", self.group.iter().map(|g| placed(&g.name)))?,
            members: hierarchy::member_names(self)?,
            lights: Names::new("light", lights)?,
        })
    }

    /// Checks each table by itself.
    ///
    /// # Errors
    /// At the first that contradicts itself.
    fn check(&self, directory: &Directory) -> Result<(), Fault> {
        self.time.check()?;
        self.environment.check()?;
        for texture in &self.texture {
            texture.check(texture.span())?;
        }
        for (i, object) in self.object.iter().enumerate() {
            object.check(directory.things.name(i), object.span())?;
        }
        for model in &self.model {
            models::check(model)?;
        }
        hierarchy::check(self, directory)?;
        for (i, light) in self.light.iter().enumerate() {
            light.check(directory.lights.name(i), light.span())?;
            if let Some(area) = &light.area {
                area.check(area.span())?;
            }
        }
        if self.camera.tables().is_empty() {
            return Err(Fault::new("the scene has no camera")
                .with_help("add [camera] with `position` and `look_at`")
                .or_at(Some(Span::default())));
        }
        Ok(())
    }
}
