//! Flags over the scene: what `render` was told beats what the file says.

use crate::args::{ExrDepth, Integrator, Layer, RenderArgs};
use crate::diagnose::Failure;
use heliostat_io::Shot;
use heliostat_scene::RenderSettings;
use heliostat_scene::frame::Depth;
use heliostat_scene::settings::{IntegratorKind, Layers};

/// The values of the scene file that flags replace before it is read: `--set`, and the size, on which the fitted camera of
/// a model depends.
pub(super) fn overrides(args: &RenderArgs) -> Vec<(String, String)> {
    let size = args.picture.size.iter().flat_map(|size| {
        [
            ("render.width".to_owned(), size.width.to_string()),
            ("render.height".to_owned(), size.height.to_string()),
        ]
    });
    args.picture.set.iter().cloned().chain(size).collect()
}

/// Puts all other flags into a shot.
pub(super) fn apply(args: &RenderArgs, shot: &mut Shot) -> Result<(), Failure> {
    let (picture, output) = (&args.picture, &args.output);
    let settings = &mut shot.settings;
    settings.threads = args.run.threads.into();
    settings.samples = picture.samples.unwrap_or(settings.samples);
    settings.noise = picture.noise.or(settings.noise);
    settings.time = picture.time.or(settings.time);
    settings.max_samples = picture.max_samples.or(settings.max_samples);
    settings.seed = picture.seed.unwrap_or(settings.seed);
    settings.region = picture.region.or(settings.region);
    settings.integrator = picture.integrator.map_or(settings.integrator, integrator);
    if !picture.aov.is_empty() {
        settings.layers = layers(&picture.aov);
    }
    if output.denoise {
        settings.layers.albedo = true;
        settings.layers.normal = true;
    }
    let pixels = settings.pixels();
    if pixels.x0 >= pixels.x1 || pixels.y0 >= pixels.y1 {
        let (width, height) = (settings.width, settings.height);
        return Err(Failure::usage(format!(
            "the region holds no pixel of the picture; write --region inside 0,0,{width},{height}"
        )));
    }
    shot.view.transform = output.view.map_or(shot.view.transform, Into::into);
    shot.view.exposure = output.exposure.unwrap_or(shot.view.exposure);
    // White of the picture, and with it what is dark, lies elsewhere in radiance.
    shot.settings.noise_floor = RenderSettings::NOISE_FLOOR * (-shot.view.exposure).exp2();
    ends(&shot.settings)?;
    shot.output.exr_depth = output.exr_depth.map_or(shot.output.exr_depth, |depth| match depth {
        ExrDepth::Half => Depth::Half,
        ExrDepth::Float => Depth::Float,
    });
    Ok(())
}

/// Refuses what would do nothing, or contradicts itself.
fn ends(settings: &RenderSettings) -> Result<(), Failure> {
    let is_open = settings.noise.is_some() || settings.time.is_some();
    let line = match settings.max_samples {
        Some(_) if !is_open => {
            "--max-samples does nothing by itself; write --noise or --time with it, or --samples".into()
        }
        Some(most) if most < settings.samples => {
            let samples = settings.samples;
            format!(
                "at least {samples} samples and at most {most}; write --max-samples {samples} or above, or fewer --samples"
            )
        }
        _ if settings.noise.is_some() && !settings.integrator.is_noisy() => {
            "noise is asked for and the integrator has none; leave --noise out, or write --integrator path"
                .into()
        }
        _ => return Ok(()),
    };
    Err(Failure::usage(line))
}

fn integrator(name: Integrator) -> IntegratorKind {
    match name {
        Integrator::Whitted => IntegratorKind::Whitted,
        Integrator::Normals => IntegratorKind::Normals,
        Integrator::Depth => IntegratorKind::Depth,
        Integrator::Uv => IntegratorKind::Uv,
        Integrator::AmbientOcclusion => IntegratorKind::AmbientOcclusion,
        Integrator::Cost => IntegratorKind::Cost,
        Integrator::Direct => IntegratorKind::Direct,
        Integrator::PathSimple => IntegratorKind::PathSimple,
        Integrator::Path => IntegratorKind::Path,
        Integrator::VolPath => IntegratorKind::VolPath,
    }
}

fn layers(names: &[Layer]) -> Layers {
    let mut layers = Layers::default();
    for name in names {
        match name {
            Layer::All => layers = Layers::ALL,
            Layer::Depth => layers.depth = true,
            Layer::Normal => layers.normal = true,
            Layer::Albedo => layers.albedo = true,
            Layer::Position => layers.position = true,
            Layer::Uv => layers.uv = true,
            Layer::ObjectId => layers.object_id = true,
            Layer::MaterialId => layers.material_id = true,
            Layer::SampleCount => layers.sample_count = true,
            Layer::Variance => layers.variance = true,
        }
    }
    layers
}
