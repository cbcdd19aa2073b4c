//! Frames without noise: which channels Open Image Denoise is given, and where its picture goes.
//!
//! The denoised picture takes the place of `R`, `G`, `B`, which is what viewers and compositors show; the noisy one stays
//! beside it as `noisy.R`, `noisy.G`, `noisy.B`, as in Blender's "Noisy Image".

use crate::diagnose::Failure;
use crate::exit::Exit;
use heliostat_oidn::{Oidn, OidnError, Picture};
use heliostat_scene::Frame;
use heliostat_scene::frame::{Channel, Meta};
use std::path::Path;

const BEAUTY: [&str; 3] = ["R", "G", "B"];
const NOISY: [&str; 3] = ["noisy.R", "noisy.G", "noisy.B"];
const ALBEDO: [&str; 3] = ["albedo.R", "albedo.G", "albedo.B"];
const NORMAL: [&str; 3] = ["N.X", "N.Y", "N.Z"];
/// The header entry that says what was done.
const NOTE: &str = "heliostat/denoised";

/// The library, opened before the work, so that hours of rendering do not end at its absence.
#[derive(Debug)]
pub(crate) struct Denoiser {
    oidn: Oidn,
    version: String,
}

impl Denoiser {
    /// Finds the library.
    pub(crate) fn find(library: Option<&Path>) -> Result<Self, Failure> {
        let oidn = Oidn::find(library).map_err(|e| failed(&e))?;
        let version = oidn.version().map_err(|e| failed(&e))?;
        Ok(Self { oidn, version })
    }

    /// Denoises the colours of a frame. A frame that was denoised before is denoised anew from what is noisy in it.
    pub(crate) fn apply(&self, frame: &mut Frame, threads: usize) -> Result<(), Failure> {
        let source = if has(frame, NOISY) { NOISY } else { BEAUTY };
        let Some(color) = interleaved(frame, source, f32::MIN, f32::MAX) else {
            return Err(Failure::new(
                Exit::Input,
                "the picture has no channels R, G and B; denoise one with colours",
            ));
        };
        let albedo = interleaved(frame, ALBEDO, 0.0, 1.0);
        let normal = interleaved(frame, NORMAL, -1.0, 1.0);
        let picture = Picture {
            width: frame.window.width() as usize,
            height: frame.window.height() as usize,
            color: &color,
            albedo: albedo.as_deref(),
            normal: normal.as_deref(),
        };
        let clean = self.oidn.denoise(&picture, threads).map_err(|e| failed(&e))?;
        if source == BEAUTY {
            keep_noisy(frame);
        }
        replace(frame, &clean);
        let helped = match (albedo, normal) {
            (Some(_), Some(_)) => "by colour, albedo and normal",
            (Some(_), None) => "by colour and albedo",
            (None, _) => "by colour alone",
        };
        let note = format!("Open Image Denoise {}, {helped}", self.version);
        frame.meta.insert(NOTE.to_owned(), Meta::Text(note));
        Ok(())
    }
}

fn failed(error: &OidnError) -> Failure {
    Failure::new(Exit::Failed, error.to_string())
}

fn has(frame: &Frame, names: [&str; 3]) -> bool {
    names.iter().all(|name| frame.channel(name).is_some())
}

/// Three channels as one image within a range; what is no number becomes 0.
fn interleaved(frame: &Frame, names: [&str; 3], least: f32, most: f32) -> Option<Vec<f32>> {
    let [x, y, z] = names.map(|name| frame.channel(name).map(|channel| &channel.values));
    let (x, y, z) = (x?, y?, z?);
    let fit = |v: f32| if v.is_nan() { 0.0 } else { v.clamp(least, most) };
    Some(x.iter().zip(y).zip(z).flat_map(|((&x, &y), &z)| [x, y, z].map(fit)).collect())
}

/// Copies the colours to their second name.
fn keep_noisy(frame: &mut Frame) {
    for (name, kept) in BEAUTY.iter().zip(NOISY) {
        let copies: Vec<Channel> = frame.channel(name).cloned().into_iter().collect();
        frame.channels.extend(copies.into_iter().map(|channel| Channel { name: kept.to_owned(), ..channel }));
    }
}

/// Puts an image into the colours.
fn replace(frame: &mut Frame, image: &[f32]) {
    for (c, name) in BEAUTY.iter().enumerate() {
        if let Some(channel) = frame.channels.iter_mut().find(|channel| channel.name == *name) {
            channel.values = image.iter().skip(c).step_by(3).copied().collect();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use heliostat_scene::frame::Depth;
    use heliostat_scene::settings::PixelRect;
    use std::collections::BTreeMap;

    fn frame(names: &[&str]) -> Frame {
        let values = |i: usize| vec![i as f32, f32::NAN];
        let channel = |(i, name): (usize, &&str)| Channel {
            name: (*name).to_owned(),
            depth: Depth::Half,
            values: values(i),
        };
        Frame {
            width: 2,
            height: 1,
            window: PixelRect { x0: 0, y0: 0, x1: 2, y1: 1 },
            channels: names.iter().enumerate().map(channel).collect(),
            meta: BTreeMap::new(),
        }
    }

    #[test]
    fn images_are_interleaved_within_their_range() {
        let frame = frame(&["R", "G", "B", "A"]);
        assert_eq!(interleaved(&frame, BEAUTY, 0.0, 1.0), Some(vec![0.0, 1.0, 1.0, 0.0, 0.0, 0.0]));
        assert_eq!(interleaved(&frame, ALBEDO, 0.0, 1.0), None);
    }

    #[test]
    fn the_noisy_picture_is_kept_and_the_rest_untouched() {
        let mut frame = frame(&["R", "G", "B", "A", "Z"]);
        let before = frame.clone();
        keep_noisy(&mut frame);
        replace(&mut frame, &[10.0, 20.0, 30.0, 11.0, 21.0, 31.0]);
        let values = |name: &str| frame.channel(name).unwrap().values.clone();
        assert_eq!(
            (values("R"), values("G"), values("B")),
            (vec![10.0, 11.0], vec![20.0, 21.0], vec![30.0, 31.0])
        );
        for (name, kept) in [("R", "noisy.R"), ("G", "noisy.G"), ("B", "noisy.B"), ("A", "A"), ("Z", "Z")] {
            let kept = frame.channel(kept).unwrap();
            assert_eq!(kept.values[0].to_bits(), before.channel(name).unwrap().values[0].to_bits());
            assert_eq!(kept.depth, Depth::Half);
        }
    }
}
