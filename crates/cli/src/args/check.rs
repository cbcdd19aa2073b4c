//! `heliostat check`.

use clap::Args;
use std::path::PathBuf;

/// Tell what is wrong with a scene, without rendering it
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  heliostat check scene.toml\n  heliostat check --strict --json model.obj"
)]
pub(crate) struct CheckArgs {
    /// A scene (.toml) or a model (.obj, .gltf, .glb)
    pub(crate) scene: PathBuf,

    /// Replace a value of the scene file, as in `render.samples=64`; repeatable
    #[arg(long = "set", value_name = "PATH=VALUE", value_parser = super::value::assignment)]
    pub(crate) set: Vec<(String, String)>,

    /// Look at this variant of a glTF model's materials (`heliostat info` lists them)
    #[arg(long, value_name = "NAME")]
    pub(crate) variant: Option<String>,

    /// Warnings, such as a missing texture, count as errors (exit code 3)
    #[arg(long)]
    pub(crate) strict: bool,

    /// Print the findings as JSON to standard output
    #[arg(long)]
    pub(crate) json: bool,
}
