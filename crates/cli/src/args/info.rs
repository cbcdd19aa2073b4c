//! `heliostat info`.

use clap::Args;
use std::path::PathBuf;

const AFTER_HELP: &str = "\
Examples:
  heliostat info scene.toml          objects, triangles, lights, cameras, textures, frames
  heliostat info model.obj           the same, of a model
  heliostat info model.glb           the same, and what else is in the file: animations, variants, extensions
  heliostat info beauty.exr          windows, channels with their ranges, NaN count, attributes
  heliostat info --json beauty.exr | jq '.channels[].name'";

/// Tell what is in a scene, a model or an image
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub(crate) struct InfoArgs {
    /// A scene (.toml), a model (.obj, .gltf, .glb) or an image (.exr, .png, .hdr, .jpg, .webp)
    pub(crate) file: PathBuf,

    /// Print JSON to standard output
    #[arg(long)]
    pub(crate) json: bool,
}
