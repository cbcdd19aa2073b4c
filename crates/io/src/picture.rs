//! One layer of a frame as RGBA pixels of the whole picture: what the eye, a texture or a comparison looks at.

use glam::{Vec3, Vec4};
use heliostat_scene::frame::Frame;

/// Pixels of the whole picture, row by row from the top: linear, premultiplied by alpha.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width * height` pixels; transparent black outside the window of the frame.
    pub pixels: Vec<Vec4>,
}

/// The channels that make up the colours of a layer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layer {
    /// One name for grey, two or three for colours.
    color: Vec<String>,
    alpha: Option<String>,
}

impl Layer {
    /// Whether a channel belongs to it.
    pub fn contains(&self, name: &str) -> bool {
        self.color.iter().chain(&self.alpha).any(|c| c == name)
    }

    /// Channels, alpha included.
    pub fn channel_count(&self) -> usize {
        self.color.len() + usize::from(self.alpha.is_some())
    }

    /// Whether one channel gives all colours.
    pub fn is_grey(&self) -> bool {
        self.color.len() == 1
    }

    /// Whether there is an alpha channel; else everything is opaque.
    pub fn has_alpha(&self) -> bool {
        self.alpha.is_some()
    }
}

/// Components of a layer that can be shown as colours, the best first.
const COMPONENTS: [&[&str]; 9] = [
    &["R", "G", "B"],
    &["r", "g", "b"],
    &["red", "green", "blue"],
    &["X", "Y", "Z"],
    &["x", "y", "z"],
    &["U", "V"],
    &["u", "v"],
    &["Y"],
    &["Z"],
];

/// The layer that stands for the file: R, G and B of the base layer, else of the first layer that has them, else
/// whatever can be shown.
pub fn main_layer<S: AsRef<str>>(names: &[S]) -> Option<Layer> {
    let prefixes = || std::iter::once("").chain(names.iter().map(|n| prefix(n.as_ref())));
    COMPONENTS
        .iter()
        .find_map(|components| prefixes().find_map(|p| layer_of(names, p, components)))
        .or_else(|| names.first().map(|n| Layer { color: vec![n.as_ref().to_owned()], alpha: None }))
}

/// The layer of that name (`""` is the base layer), or the single channel of that name.
pub fn named_layer<S: AsRef<str>>(names: &[S], name: &str) -> Option<Layer> {
    let prefix = if name.is_empty() { String::new() } else { format!("{name}.") };
    let single = || names.iter().any(|n| n.as_ref() == name);
    COMPONENTS
        .iter()
        .find_map(|components| layer_of(names, &prefix, components))
        .or_else(|| single().then(|| Layer { color: vec![name.to_owned()], alpha: None }))
}

/// `layer.` of a channel name; empty in the base layer.
fn prefix(name: &str) -> &str {
    name.rfind('.').map_or("", |dot| &name[..=dot])
}

fn layer_of<S: AsRef<str>>(names: &[S], prefix: &str, components: &[&str]) -> Option<Layer> {
    let find = |component: &str| {
        let name = format!("{prefix}{component}");
        names.iter().any(|n| n.as_ref() == name).then_some(name)
    };
    let color = components.iter().map(|c| find(c)).collect::<Option<Vec<_>>>()?;
    let alpha = ["A", "a", "alpha"].into_iter().find_map(find);
    Some(Layer { color, alpha })
}

impl Picture {
    /// The main layer of a frame; nothing where it has no channels.
    pub fn of(frame: &Frame) -> Option<Self> {
        let names: Vec<_> = frame.channels.iter().map(|c| c.name.as_str()).collect();
        main_layer(&names).map(|layer| Self::of_layer(frame, &layer))
    }

    /// A layer of a frame; channels that are missing are 0, a missing alpha is 1.
    pub fn of_layer(frame: &Frame, layer: &Layer) -> Self {
        let rows = Rows::new(frame, layer);
        let mut pixels = vec![Vec4::ZERO; frame.width as usize * frame.height as usize];
        (0..).zip(pixels.chunks_mut(frame.width as usize)).for_each(|(y, row)| rows.read(y, row));
        Self { width: frame.width, height: frame.height, pixels }
    }
}

/// The pixels of a [`Picture`] row by row, for whoever does not need all of them at once.
pub(crate) struct Rows<'a> {
    frame: &'a Frame,
    color: Vec<Option<&'a [f32]>>,
    alpha: Option<&'a [f32]>,
}

impl<'a> Rows<'a> {
    pub(crate) fn new(frame: &'a Frame, layer: &Layer) -> Self {
        let values = |name: &String| frame.channel(name).map(|c| c.values.as_slice());
        Self {
            frame,
            color: layer.color.iter().map(values).collect(),
            alpha: layer.alpha.as_ref().and_then(values),
        }
    }

    /// Writes row `y` of the whole picture over `row`, which is as long as the picture is wide and zero.
    pub(crate) fn read(&self, y: u32, row: &mut [Vec4]) {
        let window = self.frame.window;
        if !(window.y0..window.y1).contains(&y) {
            return;
        }
        let first = (y - window.y0) as usize * window.width() as usize;
        let inside = &mut row[window.x0 as usize..window.x1 as usize];
        for (i, out) in (first..).zip(inside) {
            let at = |c: usize| self.color.get(c).copied().flatten().map_or(0.0, |v| v[i]);
            let grey = self.color.len() == 1;
            let rgb = if grey { Vec3::splat(at(0)) } else { Vec3::new(at(0), at(1), at(2)) };
            *out = rgb.extend(self.alpha.map_or(1.0, |v| v[i]));
        }
    }
}

/// The colour of a premultiplied pixel before multiplication.
///
/// Where alpha is 0 nothing was multiplied: light without coverage (a flame) stays as it is, and does not explode.
/// Alpha above 1, which filters with negative lobes make, counts as 1.
pub fn straight(pixel: Vec4) -> Vec3 {
    if pixel.w > 0.0 { pixel.truncate() / pixel.w.min(1.0) } else { pixel.truncate() }
}
