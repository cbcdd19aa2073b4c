//! What is in a scene or a model.

use super::image::depth;
use super::{Info, gltf};
use crate::diagnose::Failure;
use crate::exit::Exit;
use crate::table::{self, Table};
use heliostat_geometry::{Aabb, Shape};
use heliostat_io::{OpenOptions, Shot};
use heliostat_scene::census::Tally;
use heliostat_scene::light::LightKind;
use heliostat_scene::object::Geometry;
use heliostat_scene::texture::Pattern;
use heliostat_scene::{Census, Group, GroupId, Object, Scene};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::Path;

/// Opens the scene at its first frame and counts.
pub(super) fn info(path: &Path) -> Result<Info, Failure> {
    let source = heliostat_io::open(path, &OpenOptions::default())?;
    let frames = source.frames();
    let shot = source.shot(source.first_frame())?;
    let frames = frames.map(|f| [*f.start(), *f.end()]);
    let mut json = json(path, &shot, frames, source.frame_rate())?;
    let mut text = text(&shot, &json);
    if let Some(contents) = source.contents() {
        text.push_str(&gltf::text(&contents));
        json["gltf"] = json!(contents);
    }
    Ok(Info { text, json })
}

fn json(path: &Path, shot: &Shot, frames: Option<[i32; 2]>, frame_rate: f64) -> Result<Value, Failure> {
    let Shot { scene, settings, warnings, .. } = shot;
    let each_mesh: usize = scene.meshes.iter().map(|m| m.triangles.len()).sum();
    let census = Census::new(scene).map_err(|e| Failure::new(Exit::Input, e.to_string()))?;
    let tally = |object: &Object| census.object(scene, object);
    let sum = |count: fn(&Tally) -> u64| {
        scene.objects.iter().map(tally).fold(0_u64, |sum, tally| sum.saturating_add(count(&tally)))
    };
    let memory = scene.texture_bytes();
    let bounds = scene.meshes.iter().fold(Aabb::EMPTY, |b, m| b.union(m.bounds()));
    Ok(json!({
        "path": path.to_string_lossy(),
        "kind": "scene",
        "size": [settings.width, settings.height],
        "samples": settings.samples,
        "frames": frames,
        "frame_rate": frame_rate,
        "triangles": each_mesh,
        "instanced_triangles": sum(|tally| tally.triangles),
        "parts": sum(|tally| tally.parts),
        "mesh_bounds": (!bounds.is_empty()).then(|| [bounds.min.to_array(), bounds.max.to_array()]),
        "objects": scene.objects.iter().map(|o| object(scene, o, tally(o))).collect::<Vec<_>>(),
        "groups": scene.groups.iter().enumerate().map(|(i, g)| group(g, census.group(GroupId(i as u32)))).collect::<Vec<_>>(),
        "lights": scene.lights.iter().map(|l| json!({
            "name": l.name, "kind": light_kind(&l.kind), "samples": l.samples,
        })).collect::<Vec<_>>(),
        "cameras": scene.cameras.iter().map(|c| c.name.as_str()).collect::<Vec<_>>(),
        "materials": scene.materials.iter().map(|m| m.name.as_str()).collect::<Vec<_>>(),
        "textures": scene.textures.iter().map(|t| texture(&t.name, &t.pattern)).collect::<Vec<_>>(),
        "texture_memory": { "bytes": memory.pixels, "mip_bytes": memory.mips },
        "warnings": warnings.iter().map(ToString::to_string).collect::<Vec<_>>(),
    }))
}

fn object(scene: &Scene, object: &Object, tally: Tally) -> Value {
    json!({
        "name": object.name,
        "kind": match &object.geometry {
            Geometry::Shape(shape) => shape_kind(shape),
            Geometry::Mesh(_) => "mesh",
            Geometry::Group(_) => "group",
        },
        "triangles": tally.triangles,
        "parts": tally.parts,
        "materials": object.materials.iter().map(|m| scene.materials[m.index()].name.as_str()).collect::<Vec<_>>(),
        "moving": object.motion.is_moving(),
    })
}

fn group(group: &Group, tally: Tally) -> Value {
    json!({
        "name": group.name,
        "objects": group.objects.len(),
        "copies": group.places.len(),
        "parts": tally.parts,
        "triangles": tally.triangles,
        "depth": tally.depth,
    })
}

fn shape_kind(shape: &Shape) -> &'static str {
    match shape {
        Shape::Sphere(_) => "sphere",
        Shape::Cuboid(_) => "cuboid",
        Shape::Plane(_) => "plane",
        Shape::Rectangle(_) => "rectangle",
        Shape::Disk(_) => "disk",
        Shape::Cylinder(_) => "cylinder",
        Shape::Cone(_) => "cone",
        Shape::Torus(_) => "torus",
        Shape::Triangle(_) => "triangle",
    }
}

fn light_kind(kind: &LightKind) -> &'static str {
    match kind {
        LightKind::Ambient => "ambient",
        LightKind::Point { .. } => "point",
        LightKind::Directional { .. } => "directional",
        LightKind::Spot { .. } => "spot",
        LightKind::Measured { .. } => "measured",
        LightKind::Area { .. } => "area",
    }
}

fn texture(name: &str, pattern: &Pattern) -> Value {
    match pattern {
        Pattern::Image { image, .. } => json!({
            "name": name, "kind": "image", "size": [image.width, image.height],
            "channels": image.channels, "depth": depth(image),
            "bytes": image.bytes(), "mip_bytes": image.mip_bytes(),
        }),
        Pattern::Tiles { tiles, .. } => json!({
            "name": name, "kind": "tiles", "tiles": tiles.iter().map(|tile| tile.number).collect::<Vec<_>>(),
            "depth": tiles.first().map(|tile| depth(&tile.image)),
            "bytes": tiles.iter().map(|tile| tile.image.bytes()).sum::<usize>(),
            "mip_bytes": tiles.iter().map(|tile| tile.image.mip_bytes()).sum::<usize>(),
        }),
        Pattern::Checker { .. } => json!({ "name": name, "kind": "checker" }),
        Pattern::Missing => json!({ "name": name, "kind": "missing" }),
    }
}

/// The same facts as lines; long lists are cut.
fn text(shot: &Shot, json: &Value) -> String {
    const LONGEST: usize = 40;
    let scene = &shot.scene;
    let mut text = String::new();
    let mut line = |name: &str, value: String| {
        // Writing into a `String` cannot fail.
        let _ = writeln!(text, "{name:<10} {value}");
    };
    line("scene", json["path"].as_str().unwrap_or_default().to_owned());
    line(
        "picture",
        format!(
            "{} x {} pixels, {} samples",
            shot.settings.width, shot.settings.height, shot.settings.samples
        ),
    );
    if let Some([first, last]) = json["frames"].as_array().map(|f| [&f[0], &f[1]]) {
        line("frames", format!("{first} to {last}, {} per second", json["frame_rate"]));
    }
    let as_count = |key: &str| table::count(json[key].as_u64().unwrap_or_default() as usize);
    line(
        "triangles",
        format!("{}, {} with repetitions", as_count("triangles"), as_count("instanced_triangles")),
    );
    if !scene.groups.is_empty() {
        let groups = table::count(scene.groups.len());
        line(
            "groups",
            format!("{groups}, copies included; {} shapes and meshes with repetitions", as_count("parts")),
        );
    }
    line("cameras", names(scene.cameras.iter().map(|c| c.name.as_str())));
    line("materials", names(scene.materials.iter().map(|m| m.name.as_str())));
    line("textures", names(scene.textures.iter().map(|t| t.name.as_str())));
    let memory = scene.texture_bytes();
    if memory.pixels > 0 {
        let depths: BTreeSet<_> = scene.textures.iter().flat_map(|t| t.images()).map(|i| depth(i)).collect();
        let depths = depths.into_iter().collect::<Vec<_>>().join(", ");
        let [pixels, mips] = [memory.pixels, memory.mips].map(mebibytes);
        line("", format!("{pixels} in {depths}, {mips} of smaller copies when rendered"));
    }
    line("lights", names(scene.lights.iter().map(|l| l.name.as_str())));
    line("objects", table::count(scene.objects.len()));
    let mut objects = Table::new(["name", "kind", "triangles"]);
    for object in json["objects"].as_array().into_iter().flatten().take(LONGEST) {
        let cell = |key: &str| object[key].as_str().unwrap_or_default().to_owned();
        let triangles = object["triangles"].as_u64().unwrap_or_default() as usize;
        objects.row([cell("name"), cell("kind"), table::count(triangles)]);
    }
    text.push_str(&objects.to_string());
    if let Some(more) = scene.objects.len().checked_sub(LONGEST).filter(|&n| n > 0) {
        let _ = writeln!(text, "  and {more} more (--json lists all)");
    }
    for warning in &shot.warnings {
        let _ = writeln!(text, "warning: {warning}");
    }
    text
}

fn mebibytes(bytes: usize) -> String {
    format!("{:.1} MiB", bytes as f64 / f64::from(1 << 20))
}

pub(super) fn names<'a>(names: impl ExactSizeIterator<Item = &'a str>) -> String {
    const LONGEST: usize = 12;
    let count = names.len();
    let shown: Vec<_> = names.take(LONGEST).collect();
    let more = if count > LONGEST { ", ..." } else { "" };
    if count == 0 { "none".to_owned() } else { format!("{count}: {}{more}", shown.join(", ")) }
}
