//! Whether settings and camera can be rendered, before anything is allocated.

use crate::error::{MAX_DEPTH, MAX_PIXELS, RenderError};
use crate::filter::MAX_RADIUS;
use heliostat_scene::camera::{Camera, Projection};
use heliostat_scene::{RenderSettings, Scene};
use std::f32::consts::{PI, TAU};

/// The camera to render with, once all settings are found to be in their ranges.
///
/// # Errors
/// Names the first setting that is not.
pub(crate) fn check<'s>(scene: &'s Scene, settings: &RenderSettings) -> Result<&'s Camera, RenderError> {
    picture(settings)?;
    work(settings)?;
    let (index, count) = (settings.camera, scene.cameras.len());
    let camera = scene.cameras.get(index).ok_or(RenderError::NoCamera { index, count })?;
    projection(camera)?;
    focus(camera)?;
    pose(camera)?;
    Ok(camera)
}

/// Size and region.
fn picture(settings: &RenderSettings) -> Result<(), RenderError> {
    let (width, height) = (settings.width, settings.height);
    if width == 0 || height == 0 {
        return Err(RenderError::EmptyPicture { width, height });
    }
    if u64::from(width) * u64::from(height) > MAX_PIXELS {
        return Err(RenderError::TooManyPixels { width, height });
    }
    match settings.region {
        Some(region) if is_empty(&settings.pixels()) => {
            Err(RenderError::EmptyRegion { region, width, height })
        }
        _ => Ok(()),
    }
}

fn is_empty(rect: &heliostat_scene::settings::PixelRect) -> bool {
    rect.x0 >= rect.x1 || rect.y0 >= rect.y1
}

/// Samples, filter and recursion.
fn work(settings: &RenderSettings) -> Result<(), RenderError> {
    if settings.samples == 0 {
        return Err(RenderError::NoSamples);
    }
    let radius = settings.filter_radius;
    if !(radius > 0.0 && radius <= MAX_RADIUS) {
        return Err(RenderError::FilterRadius(radius));
    }
    if settings.max_depth > MAX_DEPTH {
        return Err(RenderError::TooDeep(settings.max_depth));
    }
    let setting = |name, value, range, ok| {
        if ok { Ok(()) } else { Err(RenderError::Setting { name, value, range }) }
    };
    let (weight, distance) = (settings.min_weight, settings.ao_distance);
    setting("min_weight", weight, "a number from 0 to 1", (0.0..=1.0).contains(&weight))?;
    setting("ao_distance", distance, "above 0", distance > 0.0)
}

fn projection(camera: &Camera) -> Result<(), RenderError> {
    let number = number(camera);
    let flat = |name, fov: f32| number(name, fov, "between 0 and 180 degrees", fov > 0.0 && fov < PI);
    let turn = |name, fov: f32| number(name, fov, "above 0 and at most 360 degrees", fov > 0.0 && fov <= TAU);
    match camera.projection {
        Projection::Perspective { fov_y } => flat("field of view in radians", fov_y),
        Projection::Orthographic { height } => {
            number("height", height, "a length above 0", height > 0.0 && height.is_finite())
        }
        Projection::Fisheye { fov } => turn("field of view in radians", fov),
        Projection::Panorama => Ok(()),
        Projection::Cylindrical { fov_x, fov_y } => {
            turn("horizontal field of view in radians", fov_x)?;
            flat("vertical field of view in radians", fov_y)
        }
    }
}

fn focus(camera: &Camera) -> Result<(), RenderError> {
    let Some(focus) = camera.focus else { return Ok(()) };
    let number = number(camera);
    let (distance, radius) = (focus.distance, focus.lens_radius);
    number("focus distance", distance, "a length above 0", distance > 0.0 && distance.is_finite())?;
    number("lens radius", radius, "a length from 0", radius >= 0.0 && radius.is_finite())?;
    let (blades, turn) = (focus.blades, focus.blade_rotation);
    number(
        "number of blades",
        blades as f32,
        "0 for a round iris, or from 3 to 1024",
        blades == 0 || (3..=1024).contains(&blades),
    )?;
    number("blade rotation", turn, "a finite angle", turn.is_finite())
}

fn pose(camera: &Camera) -> Result<(), RenderError> {
    for pose in camera.motion.poses() {
        let size = pose.matrix3.determinant() as f32;
        number(camera)(
            "size of its pose (the determinant)",
            size,
            "a finite pose that is not flat",
            pose.is_finite() && size != 0.0,
        )?;
    }
    Ok(())
}

/// Makes the check of one number of a camera.
fn number(camera: &Camera) -> impl Fn(&'static str, f32, &'static str, bool) -> Result<(), RenderError> {
    move |name, value, range, ok| {
        let error = || RenderError::Camera { camera: camera.name.clone(), name, value, range };
        if ok { Ok(()) } else { Err(error()) }
    }
}
