//! Renders every scene and writes the page that shows them.
//!
//! Pictures go to `out/gallery/` in full size; `scenes/thumbs/` gets the small ones that are committed. Animations become a
//! strip of four frames, and with ffmpeg on the path a video beside the pictures.

mod reference;

use crate::Outcome;
use crate::heliostat::{Heliostat, scenes, stem};
use crate::process::{root, run as execute, say};
use image::codecs::jpeg::JpegEncoder;
use image::imageops::{FilterType, overlay};
use image::{DynamicImage, RgbImage};
use std::fmt::Write;
use std::path::Path;

/// Width and height of a small picture.
const THUMB: (u32, u32) = (480, 270);

/// One picture of a scene.
struct Picture {
    /// File name of the small picture.
    thumb: String,
    /// The command that renders the large one.
    command: String,
}

/// Renders the scenes whose names contain `only` (all when empty) and writes `scenes/README.md`.
pub(crate) fn run(only: &str, videos: bool) -> Outcome {
    for folder in ["out/gallery", "scenes/thumbs"] {
        std::fs::create_dir_all(root().join(folder)).map_err(|e| format!("{folder}: {e}"))?;
    }
    if !root().join("assets/large/bird.obj").exists() {
        crate::assets::run()?;
    }
    let heliostat = Heliostat::build()?;
    let mut page = String::from(HEAD);
    for scene in scenes("scenes")? {
        let pictures = pictures(&heliostat, &scene, stem(&scene).contains(only), videos)?;
        write_entry(&mut page, &scene, &pictures)?;
    }
    page.push_str(TAIL);
    page.push_str(&reference::markdown(&heliostat)?);
    std::fs::write(root().join("scenes/README.md"), page).map_err(|e| format!("scenes/README.md: {e}"))
}

/// Renders the pictures of a scene, or only names them.
fn pictures(heliostat: &Heliostat, scene: &str, render: bool, videos: bool) -> Result<Vec<Picture>, String> {
    let info = heliostat.info(scene)?;
    if let (Some(first), Some(last)) = (info["frames"][0].as_i64(), info["frames"][1].as_i64())
        && last - first > 30
    {
        return Ok(vec![animation(heliostat, scene, [first, last], render, videos)?]);
    }
    let cameras: Vec<&str> =
        info["cameras"].as_array().map_or(&[][..], Vec::as_slice).iter().filter_map(|c| c.as_str()).collect();
    let choices: Vec<Option<&str>> =
        if cameras.len() > 1 { cameras.iter().map(|c| Some(*c)).collect() } else { vec![None] };
    choices.into_iter().map(|camera| still(heliostat, scene, camera, render)).collect()
}

/// One camera of a scene.
fn still(heliostat: &Heliostat, scene: &str, camera: Option<&str>, render: bool) -> Result<Picture, String> {
    let name = camera.map_or_else(|| stem(scene).to_owned(), |c| format!("{}_{c}", stem(scene)));
    let large = format!("out/gallery/{name}.png");
    let thumb = format!("{name}.jpg");
    let mut args = vec!["render", scene];
    args.extend(camera.iter().flat_map(|c| ["--camera", c]));
    let command = format!("heliostat {} -o {name}.png", args.join(" "));
    if render {
        args.extend(["-o", &large]);
        execute(heliostat.command(&args))?;
        shrink(&[&large], &thumb)?;
    }
    Ok(Picture { thumb, command })
}

/// Four frames of an animation side by side, or the whole of it as a video.
fn animation(
    heliostat: &Heliostat,
    scene: &str,
    [first, last]: [i64; 2],
    render: bool,
    videos: bool,
) -> Result<Picture, String> {
    let name = stem(scene);
    let thumb = format!("{name}.jpg");
    let command = format!("heliostat render {scene} --frames {first}-{last} -o {name}.####.png");
    if render {
        let step = (last - first) / 4;
        let shown: Vec<i64> = (0..4).map(|i| first + step / 2 + i * step).collect();
        let frames = if videos {
            format!("{first}-{last}")
        } else {
            shown.iter().map(i64::to_string).collect::<Vec<_>>().join(",")
        };
        let pattern = format!("out/gallery/{name}.####.png");
        execute(heliostat.command(&["render", scene, "--frames", &frames, "-o", &pattern]))?;
        let files: Vec<String> = shown.iter().map(|f| format!("out/gallery/{name}.{f:04}.png")).collect();
        shrink(&files.iter().map(String::as_str).collect::<Vec<_>>(), &thumb)?;
        if videos {
            let video = format!("out/gallery/{name}.mp4");
            if let Err(error) = execute(heliostat.command(&["video", &pattern, "-o", &video])) {
                say(&format!("no video: {error}"));
            }
        }
    }
    Ok(Picture { thumb, command })
}

/// Lays one picture, or four in a square, into a small JPEG.
fn shrink(large: &[&str], thumb: &str) -> Outcome {
    let columns = if large.len() == 1 { 1 } else { 2 };
    let (width, height) = (THUMB.0 / columns, THUMB.1 / columns);
    let mut sheet = RgbImage::new(THUMB.0, THUMB.1);
    for (i, file) in large.iter().enumerate() {
        let picture = image::open(root().join(file)).map_err(|e| format!("{file}: {e}"))?;
        let small = picture.resize_to_fill(width, height, FilterType::CatmullRom).to_rgb8();
        let i = i as u32;
        overlay(&mut sheet, &small, i64::from(i % columns * width), i64::from(i / columns * height));
    }
    let path = root().join("scenes/thumbs").join(thumb);
    let mut bytes = Vec::new();
    JpegEncoder::new_with_quality(&mut bytes, 88)
        .encode_image(&DynamicImage::ImageRgb8(sheet))
        .and_then(|()| std::fs::write(&path, bytes).map_err(Into::into))
        .map_err(|e| format!("{}: {e}", path.display()))
}

/// The part of the page for one scene: its pictures, what its first comment says, its commands.
fn write_entry(page: &mut String, scene: &str, pictures: &[Picture]) -> Outcome {
    let text = std::fs::read_to_string(root().join(scene)).map_err(|e| format!("{scene}: {e}"))?;
    let comment: Vec<&str> = text.lines().map_while(|l| l.strip_prefix('#')).map(str::trim).collect();
    let file = Path::new(scene).file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
    let shown: String = pictures.iter().map(|p| format!("![{0}](thumbs/{0})\n", p.thumb)).collect();
    let commands: Vec<&str> = pictures.iter().map(|p| p.command.as_str()).collect();
    let _ = write!(
        page,
        "\n### [{}]({file})\n\n{shown}\n{}\n\n```sh\n{}\n```\n",
        stem(scene),
        comment.join(" "),
        commands.join("\n")
    );
    Ok(())
}

/// What the page says before the scenes.
const HEAD: &str = include_str!("head.md");

/// What it says after them: the reference of the scene file.
const TAIL: &str = include_str!("tail.md");
