//! Whitted ray tracing and path tracing over Heliostat scenes: camera, film, integrators.
//!
//! A [`Scene`] says what is there, [`RenderSettings`] how much work goes into it, and [`render`] makes the picture:
//!
//! ```
//! use glam::{DAffine3, DVec3, Vec3};
//! use heliostat_geometry::shape::{Shape, Sphere};
//! use heliostat_render::render;
//! use heliostat_scene::camera::Projection;
//! use heliostat_scene::light::LightKind;
//! use heliostat_scene::material::Phong;
//! use heliostat_scene::object::Geometry;
//! use heliostat_scene::{Camera, Light, Material, MaterialId, Motion, Object, RenderSettings, Scene};
//!
//! let scene = Scene {
//!     materials: vec![Material::new("grey", Phong::default())],
//!     objects: vec![Object {
//!         name: "ball".into(),
//!         geometry: Geometry::Shape(Shape::Sphere(Sphere { radius: 1.0 })),
//!         materials: vec![MaterialId(0)],
//!         motion: Motion::still(heliostat_geometry::Transform::IDENTITY),
//!         visible: true,
//!         casts_shadow: true,
//!     }],
//!     lights: vec![Light {
//!         name: "sky".into(),
//!         intensity: Vec3::ONE,
//!         samples: 1,
//!         kind: LightKind::Ambient,
//!     }],
//!     cameras: vec![Camera {
//!         name: "front".into(),
//!         motion: Motion::still(DAffine3::from_translation(DVec3::new(0.0, 0.0, 5.0))),
//!         projection: Projection::Perspective { fov_y: 0.5 },
//!         focus: None,
//!     }],
//!     ..Scene::default()
//! };
//! let settings =
//!     RenderSettings { width: 16, height: 16, transparent_background: true, ..RenderSettings::default() };
//!
//! let frame = render(&scene, &settings)?;
//! let alpha = &frame.channel("A").unwrap().values;
//! // A ball of radius 1 at distance 5 is seen under asin(1/5); the picture is 2 tan(0.25) high.
//! let radius = 0.2_f32.asin().tan() / (2.0 * 0.25_f32.tan());
//! let mean = alpha.iter().sum::<f32>() / 256.0;
//! assert!((mean - std::f32::consts::PI * radius * radius).abs() < 0.01);
//! # Ok::<(), heliostat_render::RenderError>(())
//! ```
//!
//! [`Prepared`] is the same in steps, for whoever wants previews, progress or cancel.
//!
//! # The way of a sample
//!
//! [`schedule`] deals tiles to threads; [`filter`] places the sample in its pixel; the camera turns the place into a
//! ray; an [`Integrator`] finds its radiance in the [`World`], with random numbers from the [`sampler`]; the
//! [`film`] adds it up; and at the end named layers come out as a [`Frame`].
//!
//! # Promise
//!
//! The same scene, settings and version give the same bits: with any number of threads, in one pass or many, in a
//! region or the whole picture. Random numbers are functions of seed, pixel, sample and branch; sums run
//! in the order of samples.

mod atmosphere;
mod background;
mod bits;
mod bsdf;
mod camera_ray;
mod check;
pub mod counters;
pub mod error;
pub mod film;
pub mod filter;
pub mod guiding;
mod horizon;
pub mod integrator;
mod interiors;
mod lanes;
mod layers;
mod light;
mod material_eval;
mod medium;
mod meta;
mod normals;
mod path_point;
mod phong;
mod photons;
mod plan;
mod post_dof;
pub mod prepared;
mod ray_cone;
pub mod sampler;
pub mod schedule;
mod shading;
pub mod stats;
mod texture_eval;
mod track;
pub mod world;
mod world_sphere;

pub use counters::RayCounters;
pub use error::RenderError;
pub use film::Film;
pub use integrator::{CameraRay, FirstHit, Integrator, Sample};
pub use prepared::Prepared;
pub use ray_cone::RayCone;
pub use sampler::Sampler;
pub use schedule::{Control, PassOutcome, TileDone};
pub use stats::RenderStats;
pub use world::{TreeCache, World, WorldError};

use heliostat_scene::{Frame, RenderSettings, Scene};
use std::sync::atomic::AtomicBool;

/// Renders `scene` with all its samples; with a noise in the settings, until all pixels are below it. Time limits belong to
/// whoever loops over passes.
///
/// # Errors
/// When a setting or the camera is out of its range, the picture does not fit into memory, or the scene cannot be made
/// ready. Rendering itself does not fail.
pub fn render(scene: &Scene, settings: &RenderSettings) -> Result<Frame, RenderError> {
    let prepared = Prepared::new(scene, settings)?;
    let mut film = prepared.film();
    let control = Control { cancel: &AtomicBool::new(false), on_tile: &|_| () };
    prepared.pass(&mut film, 0..settings.most_samples(), &control);
    Ok(prepared.frame(&film))
}
