//! Scenes made for measurements: lights above a floor with things on it, and a ball of many triangles.

use crate::process::root;
use std::fmt::Write;
use std::io::{BufWriter, Write as _};
use std::path::PathBuf;

/// Side of the square over which lights are spread, in metres.
const SIDE: f64 = 100.0;
/// All lights together, in W/sr.
const POWER: f64 = 30_000.0;
/// Radius of a bulb in metres.
const BULB: f64 = 0.03;

/// Numbers that look like chance and are the same every time.
struct Chance(u64);

impl Chance {
    /// In `[0, 1)`. A step of Knuth's MMIX generator.
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as f64 / f64::from(1_u32 << 31)
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + self.next() * (high - low)
    }
}

/// The folder for what is made, and for what comes of it.
pub(super) fn folder() -> Result<PathBuf, String> {
    let folder = root().join("out/bench");
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    Ok(folder)
}

/// Writes a scene with so many coloured lights, a quarter each of bulbs, glowing triangles, points and spots, all beyond the
/// upper edge of the picture; its path.
pub(super) fn lights(count: usize) -> Result<String, String> {
    let mut chance = Chance(7);
    let mut scene = String::from(
        "render = { width = 320, height = 180, integrator = 'direct' }\n\
         camera = { position = [0, 2.2, 0], look_at = [0, 0, -5], fov = 40 }\n\
         [[material]]\nname = 'matte'\nphong = { ambient = 0, diffuse = 0.6 }\n\
         [[object]]\nplane = {}\nmaterial = 'matte'\n",
    );
    for _ in 0..60 {
        let height = chance.between(0.5, 1.5);
        let (turn, x, z) =
            (chance.between(0.0, 90.0), chance.between(-8.0, 8.0), chance.between(-20.0, -2.5));
        let _ = writeln!(
            scene,
            "[[object]]\ncuboid = {{ size = [0.4, {height}, 0.4] }}\nmaterial = 'matte'\nrotate = [0, {turn}, 0]\n\
             translate = [{x}, {}, {z}]",
            0.5 * height
        );
    }
    let each = POWER / count as f64;
    // What a disk of that radius must shine with.
    let radiance = each / (std::f64::consts::PI * BULB * BULB);
    let mut colors = Vec::new();
    for k in 0..8 {
        let color: [f64; 3] = std::array::from_fn(|_| chance.between(0.2, 1.0));
        let [r, g, b] = color.map(|c| c * radiance);
        let _ = writeln!(
            scene,
            "[[material]]\nname = 'glow{k}'\nphong = {{ ambient = 0, diffuse = 0, emission = [{r}, {g}, {b}] }}"
        );
        colors.push(color);
    }
    for i in 0..count {
        let at = [
            chance.between(-0.5 * SIDE, 0.5 * SIDE),
            chance.between(2.5, 4.0),
            chance.between(-0.5 * SIDE, 0.5 * SIDE),
        ];
        let power = chance.between(0.3, 1.7);
        let scaled = |by: f64| colors[i % 8].map(|c| c * by * power);
        let _ = match i % 4 {
            0 => writeln!(
                scene,
                "[[light]]\nintensity = {:?}\narea = {{ sphere = {{ radius = {BULB} }}, translate = {at:?} }}",
                scaled(radiance)
            ),
            1 => {
                let mut corner = || -> [f64; 3] { std::array::from_fn(|_| chance.between(-0.05, 0.05)) };
                let (a, b, c) = (corner(), corner(), corner());
                writeln!(
                    scene,
                    "[[object]]\ntriangle = {{ a = {a:?}, b = {b:?}, c = {c:?} }}\nmaterial = 'glow{}'\ntranslate = {at:?}",
                    i % 8
                )
            }
            2 => {
                writeln!(scene, "[[light]]\nintensity = {:?}\npoint = {{ position = {at:?} }}", scaled(each))
            }
            _ => {
                let (x, z) = (chance.between(-1.0, 1.0), chance.between(-1.0, 1.0));
                writeln!(
                    scene,
                    "[[light]]\nintensity = {:?}\nspot = {{ position = {at:?}, direction = [{x}, -1, {z}], inner = 20, outer = 40 }}",
                    scaled(3.0 * each)
                )
            }
        };
    }
    let name = format!("out/bench/lights{count}.toml");
    std::fs::write(folder()?.join(format!("lights{count}.toml")), scene)
        .map_err(|e| format!("{name}: {e}"))?;
    Ok(name)
}

/// Writes a wavy ball of about so many triangles as a GLB; its path, and how many there are.
pub(super) fn ball(triangles: usize) -> Result<(String, usize), String> {
    let rows = ((triangles as f64 / 4.0).sqrt().round() as u32).max(2);
    let columns = 2 * rows;
    let count = 2 * rows as usize * columns as usize;
    let vertices = (rows + 1) as usize * (columns + 1) as usize;
    let (places, corners) = (12 * vertices, 12 * count);
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],"buffers":[{{"byteLength":{}}}],
"bufferViews":[{{"buffer":0,"byteLength":{places}}},{{"buffer":0,"byteOffset":{places},"byteLength":{corners}}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":{vertices},"type":"VEC3","min":[-1.1,-1.1,-1.1],"max":[1.1,1.1,1.1]}},
{{"bufferView":1,"componentType":5125,"count":{},"type":"SCALAR"}}]}}"#,
        places + corners,
        3 * count
    );
    let json = format!("{json:<width$}", width = json.len().next_multiple_of(4));
    let name = format!("out/bench/ball{triangles}.glb");
    let path = folder()?.join(format!("ball{triangles}.glb"));
    let file = std::fs::File::create(&path).map_err(|e| format!("{name}: {e}"))?;
    let mut out = BufWriter::new(file);
    let mut put = |bytes: &[u8]| out.write_all(bytes).map_err(|e| format!("{name}: {e}"));
    let whole = 12 + 8 + json.len() + 8 + places + corners;
    put(b"glTF")?;
    for word in [2, whole as u32, json.len() as u32, 0x4E4F_534A] {
        put(&word.to_le_bytes())?;
    }
    put(json.as_bytes())?;
    for word in [(places + corners) as u32, 0x004E_4942] {
        put(&word.to_le_bytes())?;
    }
    for i in 0..=rows {
        for j in 0..=columns {
            let (down, around) = (
                std::f32::consts::PI * i as f32 / rows as f32,
                std::f32::consts::TAU * j as f32 / columns as f32,
            );
            let radius = 1.0 + 0.05 * (9.0 * down).sin() * (11.0 * around).sin();
            let ring = radius * down.sin();
            for v in [ring * around.cos(), radius * down.cos(), -ring * around.sin()] {
                put(&v.to_le_bytes())?;
            }
        }
    }
    for i in 0..rows {
        for j in 0..columns {
            let a = i * (columns + 1) + j;
            let b = a + columns + 1;
            for v in [a, b, a + 1, a + 1, b, b + 1] {
                put(&v.to_le_bytes())?;
            }
        }
    }
    Ok((name, count))
}
