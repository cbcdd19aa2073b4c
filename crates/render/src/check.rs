//! Whether settings and scene can be rendered, before anything is allocated.

use crate::error::{MAX_DEPTH, MAX_PIXELS, RenderError};
use crate::filter::MAX_RADIUS;
use heliostat_scene::settings::{Caustics, Guiding, IntegratorKind, PixelRect};
use heliostat_scene::{Camera, RenderSettings, Scene};

/// The camera to render with, once settings and scene are found to be in order.
///
/// # Errors
/// Names the first setting that is not in its range, or all that is wrong with the scene.
pub(crate) fn check<'s>(scene: &'s Scene, settings: &RenderSettings) -> Result<&'s Camera, RenderError> {
    picture(settings)?;
    work(settings)?;
    let (index, count) = (settings.camera, scene.cameras.len());
    let camera = scene.cameras.get(index).ok_or(RenderError::NoCamera { index, count })?;
    scene.validate().map_err(RenderError::Scene)?;
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

fn is_empty(rect: &PixelRect) -> bool {
    rect.x0 >= rect.x1 || rect.y0 >= rect.y1
}

/// Samples, filter and recursion.
fn work(settings: &RenderSettings) -> Result<(), RenderError> {
    if settings.samples == 0 {
        return Err(RenderError::NoSamples);
    }
    ends(settings)?;
    let radius = settings.filter_radius;
    if !(radius > 0.0 && radius <= MAX_RADIUS) {
        return Err(RenderError::FilterRadius(radius));
    }
    if settings.max_depth > MAX_DEPTH {
        return Err(RenderError::TooDeep(settings.max_depth));
    }
    caustics(settings)?;
    guiding(settings)?;
    let (weight, distance) = (settings.min_weight, settings.ao_distance);
    let clamp = settings.clamp_indirect.unwrap_or(f32::INFINITY);
    setting("clamp_indirect", clamp, "above 0", clamp > 0.0)?;
    setting("min_weight", weight, "a number from 0 to 1", (0.0..=1.0).contains(&weight))?;
    setting("ao_distance", distance, "above 0", distance > 0.0)
}

/// Photons.
fn caustics(settings: &RenderSettings) -> Result<(), RenderError> {
    let (photons, radius) = (settings.caustic_photons, settings.caustic_radius.unwrap_or(1.0));
    let most = RenderSettings::MOST_PHOTONS;
    setting("caustic_photons", photons as f32, "from 1 to 16777216", (1..=most).contains(&photons))?;
    setting("caustic_radius", radius, "above 0", radius > 0.0 && radius.is_finite())?;
    match (settings.caustics, settings.integrator) {
        (Caustics::Photons, IntegratorKind::VolPath | IntegratorKind::PathSimple) => {
            Err(RenderError::PhotonsNeedPath)
        }
        _ => Ok(()),
    }
}

/// Practice.
fn guiding(settings: &RenderSettings) -> Result<(), RenderError> {
    let (paths, most) = (settings.guiding_paths.unwrap_or(1), RenderSettings::MOST_GUIDING_PATHS);
    setting("guiding_paths", paths as f32, "from 1 to 268435456", (1..=most).contains(&paths))?;
    match (settings.guiding, settings.integrator) {
        (Guiding::Learn, IntegratorKind::VolPath | IntegratorKind::PathSimple) => {
            Err(RenderError::GuidingNeedsPath)
        }
        _ => Ok(()),
    }
}

/// What else than the number of samples ends a render.
fn ends(settings: &RenderSettings) -> Result<(), RenderError> {
    if let Some(noise) = settings.noise {
        setting("noise", noise, "above 0", noise > 0.0 && noise.is_finite())?;
        setting("noise_floor", settings.noise_floor, "above 0", settings.noise_floor > 0.0)?;
        if !settings.integrator.is_noisy() {
            return Err(RenderError::NoNoise);
        }
    }
    if let Some(time) = settings.time {
        setting("time", time as f32, "above 0", time > 0.0)?;
    }
    match (settings.max_samples, settings.samples) {
        (Some(most), samples) if most < samples => Err(RenderError::MaxSamples { samples, most }),
        (Some(_), _) if settings.noise.is_none() && settings.time.is_none() => {
            Err(RenderError::UselessMaxSamples)
        }
        _ => Ok(()),
    }
}

fn setting(name: &'static str, value: f32, range: &'static str, ok: bool) -> Result<(), RenderError> {
    if ok { Ok(()) } else { Err(RenderError::Setting { name, value, range }) }
}
