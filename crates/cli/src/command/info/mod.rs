//! `heliostat info`: what is in a scene, a model or an image.

mod gltf;
mod image;
mod scene;

use crate::args::InfoArgs;
use crate::diagnose::Failure;
use crate::exit::Exit;
use crate::out;

/// Prints it as text or JSON.
pub(crate) fn run(args: &InfoArgs) -> Result<Exit, Failure> {
    let is_scene = args
        .file
        .extension()
        .is_some_and(|e| ["toml", "obj", "gltf", "glb"].iter().any(|scene| e.eq_ignore_ascii_case(scene)));
    let info = if is_scene { scene::info(&args.file)? } else { image::info(&args.file)? };
    if args.json {
        out::line(format_args!("{:#}", info.json));
    } else {
        out::line(format_args!("{}", info.text.trim_end()));
    }
    Ok(Exit::Done)
}

/// The same facts for people and for programs.
struct Info {
    text: String,
    json: serde_json::Value,
}
