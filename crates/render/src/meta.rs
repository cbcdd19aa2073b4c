//! What a frame says of itself: how it was made, and where its camera stood.
//!
//! Nothing that differs between two runs is said: no time, no host, no number of threads.
//!
//! # Matrices
//! By the OpenEXR conventions: points are rows multiplied from the left (`P worldToCamera`), the camera looks down `+z` with
//! `+x` to the right and `+y` up, so that z is the `Z` channel of a flat picture; `worldToNDC` brings the upper left corner
//! of the picture to (0, 0) and the lower right one to (1, 1) after division by w. Both are those of the
//! opening of the shutter. Pictures that look around have no `worldToNDC`: theirs is no matrix.
//!
//! # Source
//! "Standard OpenEXR Attributes", openexr.com.

use crate::camera_ray::CameraRays;
use crate::film::Film;
use crate::guiding::practice;
use glam::{DAffine3, DMat4, DVec3, DVec4};
use heliostat_scene::frame::Meta;
use heliostat_scene::settings::{Caustics, DepthLimits, Filter, Guiding, IntegratorKind, SamplerKind};
use heliostat_scene::{Camera, RenderSettings};
use std::collections::BTreeMap;

/// The header entries of a frame.
pub(crate) fn meta(
    settings: &RenderSettings,
    camera: &Camera,
    rays: &CameraRays,
    film: &Film,
) -> BTreeMap<String, Meta> {
    let mut meta = BTreeMap::new();
    let mut say = |key: &str, value: Meta| meta.insert(key.to_owned(), value);
    let (least, most) = film.samples();
    say("heliostat/version", text(env!("CARGO_PKG_VERSION")));
    say("heliostat/samples", int(least));
    if most != least {
        say("heliostat/samplesMost", int(most));
    }
    if let Some(noise) = settings.noise {
        say("heliostat/noise", Meta::Float(noise));
    }
    // All 64 bits of the seed, which no number type of an image file holds.
    say("heliostat/seed", text(&settings.seed.to_string()));
    say("heliostat/sampler", text(sampler_name(settings.sampler)));
    say("heliostat/integrator", text(integrator_name(settings.integrator)));
    if settings.integrator == IntegratorKind::Path && settings.guiding == Guiding::Learn {
        say("heliostat/guiding", text("learn"));
        say("heliostat/guidingPaths", int(practice(settings)));
    }
    if settings.integrator.traces_paths() {
        say_biases(settings, &mut say);
    }
    say("heliostat/mipMaps", int(settings.mip_maps.into()));
    say("heliostat/filter", text(filter_name(settings.filter)));
    say("heliostat/filterRadius", Meta::Float(settings.filter_radius));
    say("heliostat/camera", text(&camera.name));
    if settings.region.is_some() {
        let r = settings.pixels();
        say("heliostat/region", text(&format!("{},{},{},{}", r.x0, r.y0, r.x1, r.y1)));
    }
    let depth_type = if rays.has_perpendicular_depth() { "perpendicular" } else { "distance" };
    say("heliostat/depthType", text(depth_type));
    let to_camera = world_to_camera(rays);
    say("worldToCamera", rows(to_camera));
    if let Some(to_ndc) = camera_to_ndc(rays) {
        say("worldToNDC", rows(to_ndc * to_camera));
    }
    meta
}

/// What a path may lack: where limits are set, its light is not all there is.
fn say_biases(settings: &RenderSettings, say: &mut impl FnMut(&str, Meta) -> Option<Meta>) {
    let DepthLimits { total, diffuse, glossy, transmission, volume } = settings.depth_limits;
    if settings.depth_limits != DepthLimits::default() {
        say("heliostat/depthLimits", text(&format!("{total},{diffuse},{glossy},{transmission},{volume}")));
    }
    if let Some(clamp) = settings.clamp_indirect {
        say("heliostat/clampIndirect", Meta::Float(clamp));
    }
    if settings.integrator == IntegratorKind::Path && settings.caustics == Caustics::Photons {
        say("heliostat/caustics", text("photons"));
        say("heliostat/causticPhotons", int(settings.caustic_photons));
        if let Some(radius) = settings.caustic_radius {
            say("heliostat/causticRadius", Meta::Float(radius));
        }
    }
}

/// From world space to a camera that looks down +z, for columns.
fn world_to_camera(rays: &CameraRays) -> DMat4 {
    let mirror = DAffine3::from_scale(DVec3::new(1.0, 1.0, -1.0));
    DMat4::from(mirror * rays.opening_pose().inverse())
}

/// From that camera to the picture's unit square, for columns; `None` where the picture looks around.
fn camera_to_ndc(rays: &CameraRays) -> Option<DMat4> {
    let scale = 0.5 / rays.half_extent()?;
    let x = DVec4::new(scale.x, 0.0, 0.0, 0.0);
    let y = DVec4::new(0.0, -scale.y, 0.0, 0.0);
    Some(if rays.is_parallel() {
        DMat4::from_cols(x, y, DVec4::Z, DVec4::new(0.5, 0.5, 0.0, 1.0))
    } else {
        // Division by z; the third component runs from 0 at z = 1 to 1 at infinity, so that the matrix has an inverse.
        DMat4::from_cols(x, y, DVec4::new(0.5, 0.5, 1.0, 1.0), DVec4::new(0.0, 0.0, -1.0, 0.0))
    })
}

/// The rows of the matrix for rows: the columns of the one for columns.
fn rows(columns: DMat4) -> Meta {
    Meta::Matrix(columns.as_mat4().to_cols_array())
}

fn text(value: &str) -> Meta {
    Meta::Text(value.to_owned())
}

fn int(value: u32) -> Meta {
    Meta::Int(i32::try_from(value).unwrap_or(i32::MAX))
}

/// The name that scene files use.
fn integrator_name(kind: IntegratorKind) -> &'static str {
    match kind {
        IntegratorKind::Whitted => "whitted",
        IntegratorKind::Normals => "normals",
        IntegratorKind::Depth => "depth",
        IntegratorKind::Uv => "uv",
        IntegratorKind::AmbientOcclusion => "ambient_occlusion",
        IntegratorKind::Cost => "cost",
        IntegratorKind::Direct => "direct",
        IntegratorKind::PathSimple => "path_simple",
        IntegratorKind::Path => "path",
        IntegratorKind::VolPath => "volpath",
    }
}

/// The name that scene files use.
fn sampler_name(kind: SamplerKind) -> &'static str {
    match kind {
        SamplerKind::White => "white",
        SamplerKind::Blue => "blue",
    }
}

/// The name that scene files use.
fn filter_name(filter: Filter) -> &'static str {
    match filter {
        Filter::Box => "box",
        Filter::Tent => "tent",
        Filter::Gaussian => "gaussian",
        Filter::Mitchell => "mitchell",
        Filter::BlackmanHarris => "blackman_harris",
        Filter::Lanczos => "lanczos",
    }
}
