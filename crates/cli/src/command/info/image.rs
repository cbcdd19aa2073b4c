//! What is in an image: size, windows, channels with their ranges, attributes.

use super::Info;
use crate::diagnose::Failure;
use crate::table::{self, Table};
use heliostat_io::LoadError;
use heliostat_io::exr_file;
use heliostat_io::image_file::{self, Limits};
use heliostat_scene::frame::{Depth, Frame, Meta};
use heliostat_scene::image::{Encoding, Image, Samples};
use serde_json::{Map, Value, json};
use std::fmt::Write;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// The bytes that every OpenEXR file begins with.
const EXR_MAGIC: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];

/// Reads the image and measures its channels.
pub(super) fn info(path: &Path) -> Result<Info, Failure> {
    let limits = Limits::default();
    let json = if is_exr(path)? {
        of_frame(path, &exr_file::read_exr(path, &limits)?)
    } else {
        of_image(path, &image_file::read_image(path, &limits)?)
    };
    Ok(Info { text: text(&json), json })
}

/// Whether the content is OpenEXR, whatever the name says.
fn is_exr(path: &Path) -> Result<bool, Failure> {
    let mut first = [0; 4];
    let mut file = File::open(path).map_err(|e| LoadError::io(path, &e))?;
    // A file shorter than that is no EXR; its reader says what it is.
    Ok(file.read_exact(&mut first).is_ok() && first == EXR_MAGIC)
}

fn of_frame(path: &Path, frame: &Frame) -> Value {
    let window = frame.window;
    let channels: Vec<Value> = frame
        .channels
        .iter()
        .map(|c| {
            let depth = match c.depth {
                Depth::Half => "half",
                Depth::Float => "float",
            };
            channel(&c.name, depth, c.values.iter().copied())
        })
        .collect();
    let attributes: Map<_, _> = frame.meta.iter().map(|(name, value)| (name.clone(), meta(value))).collect();
    json!({
        "path": path.to_string_lossy(),
        "kind": "image",
        "format": "OpenEXR",
        "size": [frame.width, frame.height],
        "data_window": [window.x0, window.y0, window.x1, window.y1],
        "channels": channels,
        "attributes": attributes,
    })
}

/// The form of the samples of an image.
pub(super) fn depth(image: &Image) -> &'static str {
    match image.samples {
        Samples::U8(_) => "8 bit",
        Samples::U16(_) => "16 bit",
        Samples::F16(_) => "half",
        Samples::F32(_) => "float",
    }
}

fn of_image(path: &Path, image: &Image) -> Value {
    let names: &[&str] = match image.channels {
        1 => &["Y"],
        2 => &["Y", "A"],
        3 => &["R", "G", "B"],
        _ => &["R", "G", "B", "A"],
    };
    let depth = depth(image);
    let encoding = match image.encoding {
        Encoding::Srgb => "sRGB",
        Encoding::Linear => "linear",
    };
    let channels: Vec<Value> =
        names.iter().enumerate().map(|(i, name)| channel(name, depth, stored(image, i))).collect();
    json!({
        "path": path.to_string_lossy(),
        "kind": "image",
        "format": "image",
        "encoding": encoding,
        "size": [image.width, image.height],
        "channels": channels,
    })
}

/// The values of one channel as they are stored, whole numbers divided by the largest one.
fn stored(image: &Image, channel: usize) -> impl Iterator<Item = f32> {
    let step = usize::from(image.channels.max(1));
    let count = image.width as usize * image.height as usize;
    (0..count).map(move |pixel| {
        let i = pixel * step + channel;
        match &image.samples {
            Samples::U8(v) => f32::from(v[i]) / 255.0,
            Samples::U16(v) => f32::from(v[i]) / 65535.0,
            Samples::F16(v) => v[i].to_f32(),
            Samples::F32(v) => v[i],
        }
    })
}

/// Range and mean of the finite values, and how many are not finite.
fn channel(name: &str, depth: &str, values: impl Iterator<Item = f32>) -> Value {
    let (mut min, mut max, mut sum) = (f32::INFINITY, f32::NEG_INFINITY, 0.0);
    let (mut finite, mut nan, mut infinite) = (0_u64, 0_u64, 0_u64);
    for value in values {
        if value.is_finite() {
            finite += 1;
            min = min.min(value);
            max = max.max(value);
            sum += f64::from(value);
        } else if value.is_nan() {
            nan += 1;
        } else {
            infinite += 1;
        }
    }
    let known = |value: f64| (finite > 0).then_some(value);
    json!({
        "name": name,
        "type": depth,
        "min": known(min.into()),
        "max": known(max.into()),
        "mean": known(sum / finite as f64),
        "nan": nan,
        "infinite": infinite,
    })
}

fn meta(value: &Meta) -> Value {
    match value {
        Meta::Text(text) => json!(text),
        Meta::Int(number) => json!(number),
        Meta::Float(number) => json!(number),
        Meta::Rational(numerator, denominator) => json!([numerator, denominator]),
        Meta::Vec2(v) => json!(v),
        Meta::Vec3(v) => json!(v),
        Meta::Matrix(m) => json!(m),
        Meta::Texts(texts) => json!(texts),
        Meta::Other { kind, bytes } => json!(format!("{kind}, {} bytes", bytes.len())),
    }
}

fn text(json: &Value) -> String {
    let mut text = String::new();
    // Writing into a `String` cannot fail.
    let mut line = |name: &str, value: String| {
        let _ = writeln!(text, "{name:<12} {value}");
    };
    let encoding = json["encoding"].as_str().map_or_else(String::new, |e| format!(", {e}"));
    line("image", format!("{}, {}{encoding}", plain(&json["path"]), plain(&json["format"])));
    line("size", format!("{} x {} pixels", json["size"][0], json["size"][1]));
    if let Some(w) = json["data_window"].as_array() {
        line("data window", format!("from {},{} to {},{}", w[0], w[1], w[2], w[3]));
    }
    let mut channels = Table::new(["channel", "type", "min", "max", "mean", "NaN", "infinite"]);
    for channel in json["channels"].as_array().into_iter().flatten() {
        let number = |key: &str| channel[key].as_f64().map_or_else(|| "-".to_owned(), table::number);
        channels.row([
            plain(&channel["name"]),
            plain(&channel["type"]),
            number("min"),
            number("max"),
            number("mean"),
            plain(&channel["nan"]),
            plain(&channel["infinite"]),
        ]);
    }
    text.push_str(&channels.to_string());
    for (name, value) in json["attributes"].as_object().into_iter().flatten() {
        let _ = writeln!(text, "{name:<24} {}", short(&plain(value)));
    }
    text
}

fn plain(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}

/// Manifests run to megabytes.
fn short(text: &str) -> String {
    const LONGEST: usize = 100;
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("{}... (--json shows all)", &text[..end]),
        None => text.to_owned(),
    }
}
