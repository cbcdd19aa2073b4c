//! The whole scene: arrays and ids.

use crate::camera::Camera;
use crate::color::Rgb;
use crate::group::Group;
use crate::light::Light;
use crate::material::{Material, Surface};
use crate::medium::{Atmosphere, Medium};
use crate::object::Object;
use crate::settings::IntegratorKind;
use crate::texture::Texture;
use glam::Vec3;
use heliostat_geometry::TriMesh;
use std::collections::HashSet;
use std::sync::Arc;

/// What rays see that leave the scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Background {
    /// One radiance everywhere.
    Constant(Rgb),
    /// From `bottom` below through `horizon` to `top` above, by the height of the direction.
    Gradient {
        /// Straight up.
        top: Rgb,
        /// Level.
        horizon: Rgb,
        /// Straight down.
        bottom: Rgb,
    },
    /// An equirectangular image, linear, its middle towards `-z`.
    Image {
        /// The texture's image, wrapped in u.
        image: Arc<crate::image::Image>,
        /// Factor.
        intensity: Rgb,
        /// Turn about y in radians, counter-clockwise seen from above.
        rotation: f32,
    },
    /// The sky and the sun, as the air makes them.
    Daylight(Daylight),
}

/// The moment of a clear day. Radiance is in W/(m² sr) of white light, of which 1 W are 179 lumens.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Daylight {
    /// Unit direction to the middle of the sun; below the horizon it is twilight, then night.
    pub to_sun: Vec3,
    /// How hazy the air is: 1 has no haze, 2 is very clear, 3 clear, 6 hazy, 10 thick haze.
    pub turbidity: f32,
    /// Share of the light that the ground sends back, in `[0, 1]`: it shows below the horizon and brightens the sky a little.
    pub ground_albedo: Rgb,
    /// Factor of all of it.
    pub intensity: Rgb,
    /// Factor of the disc of the sun alone; 0 leaves the sky.
    pub sun: f32,
}

impl Default for Background {
    fn default() -> Self {
        Self::Constant(Rgb::ZERO)
    }
}

/// A scene at one moment (or over one shutter): arrays that refer to each other by id.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// Meshes, shared by objects.
    pub meshes: Vec<Arc<TriMesh>>,
    /// Textures, shared by materials.
    pub textures: Vec<Texture>,
    /// Materials, shared by objects.
    pub materials: Vec<Material>,
    /// Media, shared by materials.
    pub media: Vec<Medium>,
    /// Objects that are placed together, shared by objects.
    pub groups: Vec<Group>,
    /// What is there to see.
    pub objects: Vec<Object>,
    /// What lights it.
    pub lights: Vec<Light>,
    /// At least one camera; the first is the default.
    pub cameras: Vec<Camera>,
    /// What is seen behind everything.
    pub background: Background,
    /// What fills the space around everything.
    pub atmosphere: Option<Atmosphere>,
}

/// Memory that the images of textures take.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TextureBytes {
    /// The images as they were read.
    pub pixels: usize,
    /// Their smaller copies, once they are made.
    pub mips: usize,
}

impl Scene {
    /// Memory of all images of textures, shared ones counted once.
    pub fn texture_bytes(&self) -> TextureBytes {
        let mut known = HashSet::new();
        let images = self.textures.iter().flat_map(Texture::images);
        let distinct = images.filter(|image| known.insert(Arc::as_ptr(image)));
        distinct.fold(TextureBytes::default(), |sum, image| TextureBytes {
            pixels: sum.pixels + image.bytes(),
            mips: sum.mips + image.mip_bytes(),
        })
    }

    /// The integrator for a scene that names none: paths through media where there is a medium or light walks below surfaces,
    /// paths where a material is physically based, else the report's recursion.
    pub fn natural_integrator(&self) -> IntegratorKind {
        let has_medium =
            |material: &Material| material.interior.is_some() || material.surface.has_subsurface();
        let is_physical = |material: &Material| matches!(material.surface, Surface::Standard(_));
        if self.atmosphere.is_some() || self.materials.iter().any(has_medium) {
            IntegratorKind::VolPath
        } else if self.materials.iter().any(is_physical) {
            IntegratorKind::Path
        } else {
            IntegratorKind::Whitted
        }
    }
}
