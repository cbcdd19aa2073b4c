//! What is no error and yet not what anyone wants: names that nothing uses, and scenes without light.

use heliostat_io::Warning;
use heliostat_io::error::Place;
use heliostat_scene::material::Material;
use heliostat_scene::object::Geometry;
use heliostat_scene::scene::Background;
use heliostat_scene::{Rgb, Scene};
use std::path::Path;
use std::sync::Arc;

/// Looks a loaded scene over. Libraries of materials that a model brings along may hold more than it needs: only what
/// the scene file itself names is told.
pub(super) fn lint(path: &Path, scene: &Scene) -> Vec<Warning> {
    let Some(text) = text(path) else { return Vec::new() };
    let mut warnings = Vec::new();
    let mut unused = |what: &str, name: &str| {
        if let Some(place) = place(&text, name) {
            let warning = Warning::new(path, format!("{what} `{name}` is not used"));
            warnings.push(warning.at(place).with_help("use it, or take it out"));
        }
    };
    let objects = || scene.objects.iter().chain(scene.groups.iter().flat_map(|group| &group.objects));
    let shown = |index: usize| objects().any(|o| o.materials.iter().any(|m| m.index() == index));
    let materials = scene.materials.iter().enumerate().filter(|&(index, _)| !shown(index));
    materials.for_each(|(_, material)| unused("the material", &material.name));
    let read = |index: usize| scene.materials.iter().any(|m| m.textures().iter().any(|t| t.index() == index));
    let textures = scene.textures.iter().enumerate().filter(|&(index, _)| !read(index));
    textures.for_each(|(_, texture)| unused("the texture", &texture.name));
    let fills = |index: usize| {
        let interior = scene.materials.iter().any(|m| m.interior.is_some_and(|id| id.index() == index));
        interior || scene.atmosphere.is_some_and(|atmosphere| atmosphere.medium.index() == index)
    };
    let media = scene.media.iter().enumerate().filter(|&(index, _)| !fills(index));
    media.for_each(|(_, medium)| unused("the medium", &medium.name));
    let placed =
        |index: usize| objects().any(|o| matches!(o.geometry, Geometry::Group(id) if id.index() == index));
    let groups = scene.groups.iter().enumerate().filter(|&(index, _)| !placed(index));
    groups.for_each(|(_, group)| unused("the group", &group.name));
    if is_dark(scene) {
        let warning = Warning::new(path, "nothing gives light: the picture will be black");
        warnings.push(warning.with_help("add a [[light]] or an [environment]"));
    }
    warnings
}

/// The scene file; a lone model has none.
fn text(path: &Path) -> Option<Arc<str>> {
    let is_scene = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml"));
    // The scene was read from there a moment ago.
    let text = if is_scene { std::fs::read_to_string(path).ok() } else { None };
    text.map(Into::into)
}

/// Where the file gives something this name: `name = "wood"`.
fn place(text: &Arc<str>, name: &str) -> Option<Place> {
    let quoted = format!("\"{name}\"");
    let start = text.match_indices(&quoted).map(|(at, _)| at).find(|&at| {
        let line = text[..at].rfind('\n').map_or(0, |end| end + 1);
        text[line..at].trim_end().strip_suffix('=').is_some_and(|key| key.trim() == "name")
    })?;
    Some(Place::in_file(Arc::clone(text), start..start + quoted.len()))
}

fn is_dark(scene: &Scene) -> bool {
    let glows = |material: &Material| !material.surface.emission().is_zero();
    scene.lights.is_empty()
        && scene.background == Background::Constant(Rgb::ZERO)
        && !scene.materials.iter().any(glows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_place_of_a_name() {
        let text: Arc<str> = "[[object]]\nmaterial = \"red\"\n[[material]]\nname = \"red\"\n".into();
        let place = place(&text, "red").expect("it is there");
        assert_eq!((place.line, place.column), (4, 8));
        assert!(super::place(&text, "blue").is_none());
    }
}
