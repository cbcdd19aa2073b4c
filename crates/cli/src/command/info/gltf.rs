//! What a glTF file holds beside what is shown of it.

use super::scene::names;
use crate::table;
use heliostat_io::gltf::{Contents, Named};
use std::fmt::Write;

/// The facts as lines.
pub(super) fn text(contents: &Contents) -> String {
    let mut text = "in the file\n".to_owned();
    let mut line = |name: &str, value: String| {
        // Writing into a `String` cannot fail.
        let _ = writeln!(text, "  {name:<12} {value}");
    };
    let list = |list: &[String]| names(list.iter().map(String::as_str));
    let counts = |things: &[Named], of: &str| {
        let told: Vec<_> = things.iter().map(|t| format!("{} ({} {of})", t.name, t.count)).collect();
        list(&told)
    };
    if !contents.generator.is_empty() {
        line("written by", contents.generator.clone());
    }
    line("scenes", list(&contents.scenes));
    line("nodes", table::count(contents.nodes));
    let [meshes, parts] = [contents.meshes, contents.primitives].map(table::count);
    line("meshes", format!("{meshes} of {parts} primitives"));
    line("materials", list(&contents.materials));
    let texture = |(name, size): (&String, Option<[u32; 2]>)| match size {
        Some([width, height]) => format!("{name} ({width} x {height})"),
        None => name.clone(),
    };
    let textures: Vec<_> = contents.textures.iter().map(|t| texture((&t.name, t.size))).collect();
    line("textures", list(&textures));
    line("cameras", list(&contents.cameras));
    line("lights", list(&contents.lights));
    line("animations", counts(&contents.animations, "channels"));
    line("skins", counts(&contents.skins, "bones"));
    line("variants", list(&contents.variants));
    line("extensions", list(&contents.extensions));
    let mut ignored = contents.ignored.clone();
    if contents.points_and_lines > 0 {
        ignored.push(format!("{} primitives of points or lines", contents.points_and_lines));
    }
    if contents.unblurred_meshes {
        ignored.push("motion blur of skins and morph targets".to_owned());
    }
    line("ignored", list(&ignored));
    text
}
