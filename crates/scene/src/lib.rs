//! The nouns of a rendered scene, in physical units, without behaviour.
//!
//! A [`Scene`] says *what* is there, [`RenderSettings`] *how much* work goes into its picture, and a [`Frame`] is the
//! picture: named channels of numbers. Nothing here traces, reads or writes; files become scenes in
//! `heliostat-io`, scenes become frames in `heliostat-render`, and neither of the two knows the other.
//!
//! Units and axes are those of [`heliostat_geometry`]. Colours are linear Rec.709 ([`Rgb`]).

pub mod camera;
pub mod census;
pub mod color;
pub mod frame;
pub mod group;
pub mod group_boxes;
pub mod ids;
pub mod image;
pub mod light;
pub mod material;
pub mod medium;
pub mod motion;
pub mod object;
mod profile;
pub mod scene;
pub mod settings;
pub mod texture;
pub mod validate;

pub use camera::Camera;
pub use census::Census;
pub use color::Rgb;
pub use frame::Frame;
pub use group::Group;
pub use group_boxes::GroupBoxes;
pub use ids::{GroupId, MaterialId, MediumId, MeshId, TextureId};
pub use image::Image;
pub use light::Light;
pub use material::Material;
pub use medium::Medium;
pub use motion::Motion;
pub use object::Object;
pub use profile::Profile;
pub use scene::Scene;
pub use settings::RenderSettings;
pub use texture::Texture;
