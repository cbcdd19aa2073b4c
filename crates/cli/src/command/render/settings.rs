//! Flags over the scene: what `render` was told beats what the file says.

use crate::args::{ExrDepth, Integrator, Layer, RenderArgs};
use crate::diagnose::Failure;
use heliostat_io::Shot;
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
    shot.output.exr_depth = output.exr_depth.map_or(shot.output.exr_depth, |depth| match depth {
        ExrDepth::Half => Depth::Half,
        ExrDepth::Float => Depth::Float,
    });
    Ok(())
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
        }
    }
    layers
}
