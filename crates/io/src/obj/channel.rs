//! Images as numbers: one channel alone, a mask as alpha, and the look of a normal map.

use super::map::Channel;
use half::f16;
use heliostat_scene::color::luminance;
use heliostat_scene::image::{Encoding, Samples};
use heliostat_scene::{Image, Rgb};

/// What a texture is read for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Role {
    /// Colour, encoded as the file says.
    Color,
    /// A number: the stored values themselves.
    Number(Option<Channel>),
    /// Coverage, which the scene reads from the alpha channel.
    Coverage(Option<Channel>),
}

/// The image as `role` wants it; `None` when it can stay as it is.
pub(super) fn for_role(image: &Image, role: Role) -> Option<Image> {
    match role {
        Role::Color => None,
        Role::Number(None) => (image.encoding != Encoding::Linear)
            .then(|| Image { encoding: Encoding::Linear, ..image.clone() }),
        Role::Number(Some(channel)) => Some(extract(image, channel, 1)),
        Role::Coverage(channel) => {
            let channel =
                channel.unwrap_or(if has_cut_outs(image) { Channel::Matte } else { Channel::Luminance });
            Some(extract(image, channel, 2))
        }
    }
}

/// Whether the alpha channel says anything.
fn has_cut_outs(image: &Image) -> bool {
    let channels = usize::from(image.channels);
    let full = |value: f32| value >= 1.0;
    matches!(channels, 2 | 4)
        && match &image.samples {
            Samples::U8(v) => v.iter().skip(channels - 1).step_by(channels).any(|&a| a != u8::MAX),
            Samples::U16(v) => v.iter().skip(channels - 1).step_by(channels).any(|&a| a != u16::MAX),
            Samples::F16(v) => v.iter().skip(channels - 1).step_by(channels).any(|a| !full(a.to_f32())),
            Samples::F32(v) => v.iter().skip(channels - 1).step_by(channels).any(|&a| !full(a)),
        }
}

/// An image of which every channel is `channel` of `image`; with two of them the second is alpha.
fn extract(image: &Image, channel: Channel, copies: usize) -> Image {
    let channels = usize::from(image.channels);
    let samples = match &image.samples {
        Samples::U8(v) => Samples::U8(spread(v, channels, channel, copies, u8::MAX, |x| (x + 0.5) as u8)),
        Samples::U16(v) => Samples::U16(spread(v, channels, channel, copies, u16::MAX, |x| (x + 0.5) as u16)),
        Samples::F16(v) => Samples::F16(spread(v, channels, channel, copies, f16::ONE, f16::from_f32)),
        Samples::F32(v) => Samples::F32(spread(v, channels, channel, copies, 1.0, |x| x)),
    };
    let (width, height) = (image.width, image.height);
    Image::new(width, height, copies as u8, Encoding::Linear, samples)
}

/// `copies` times the value of `channel` for every pixel; `full` is an alpha of 1.
fn spread<T: Copy + Into<f32>>(
    values: &[T],
    channels: usize,
    channel: Channel,
    copies: usize,
    full: T,
    round: impl Fn(f32) -> T,
) -> Vec<T> {
    let value = |pixel: &[T]| match (channel, pixel) {
        (Channel::Matte, &[_, a] | &[_, _, _, a]) => a,
        (Channel::Matte, _) => full,
        (Channel::Green, &[_, g, _] | &[_, g, _, _]) => g,
        (Channel::Blue, &[_, _, b] | &[_, _, b, _]) => b,
        (Channel::Luminance, &[r, g, b] | &[r, g, b, _]) => {
            round(luminance(Rgb::new(r.into(), g.into(), b.into())))
        }
        // Red, and every colour of a grey image.
        _ => pixel[0],
    };
    let mut out = Vec::with_capacity(values.len() / channels * copies);
    for pixel in values.chunks_exact(channels) {
        out.extend(std::iter::repeat_n(value(pixel), copies));
    }
    out
}

/// Whether the mean colour is the blue of a tangent-space normal map: `map_Bump` often names one.
pub(super) fn is_normal_map(image: &Image) -> bool {
    /// Pixels to look at.
    const PROBES: usize = 4096;
    let pixels = image.width as usize * image.height as usize;
    if image.channels < 3 {
        return false;
    }
    let linear = |i: usize| {
        let first = i * usize::from(image.channels);
        Rgb::from_array(std::array::from_fn(|c| stored(image, first + c)))
    };
    let step = (pixels / PROBES).max(1);
    let probes = (0..pixels).step_by(step);
    let mean = probes.clone().map(linear).sum::<Rgb>() / probes.len() as f32;
    // Unit normals of a relief point up on the whole: (0, 0, 1) is stored as (0.5, 0.5, 1).
    let tilt = (mean.truncate() - 0.5).abs().max_element();
    mean.z > 0.7 && tilt < 0.15
}

fn stored(image: &Image, i: usize) -> f32 {
    match &image.samples {
        Samples::U8(v) => f32::from(v[i]) / 255.0,
        Samples::U16(v) => f32::from(v[i]) / 65535.0,
        Samples::F16(v) => v[i].to_f32(),
        Samples::F32(v) => v[i],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(channels: u8, values: &[u8]) -> Image {
        let width = (values.len() / usize::from(channels)) as u32;
        Image::new(width, 1, channels, Encoding::Srgb, Samples::U8(values.to_vec()))
    }

    fn bytes(image: Image) -> Vec<u8> {
        match image.samples {
            Samples::U8(v) => v,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_single_channel_is_picked_without_decoding() {
        let rgba = image(4, &[10, 20, 30, 40, 50, 60, 70, 80]);
        let pick = |channel| bytes(for_role(&rgba, Role::Number(Some(channel))).unwrap());
        assert_eq!(pick(Channel::Red), [10, 50]);
        assert_eq!(pick(Channel::Blue), [30, 70]);
        assert_eq!(pick(Channel::Matte), [40, 80]);
        let grey = for_role(&image(1, &[7, 8]), Role::Number(Some(Channel::Green))).unwrap();
        assert_eq!((grey.encoding, bytes(grey)), (Encoding::Linear, vec![7, 8]));
    }

    #[test]
    fn a_grey_mask_becomes_alpha() {
        let mask = for_role(&image(3, &[0, 0, 0, 255, 255, 255]), Role::Coverage(None)).unwrap();
        assert_eq!((mask.pixel(0, 0).w, mask.pixel(1, 0).w), (0.0, 1.0));
    }

    #[test]
    fn alpha_is_the_mask_where_it_says_something() {
        let cut_out = for_role(&image(4, &[9, 9, 9, 0, 9, 9, 9, 255]), Role::Coverage(None)).unwrap();
        assert_eq!((cut_out.pixel(0, 0).w, cut_out.pixel(1, 0).w), (0.0, 1.0));
        let opaque = for_role(&image(4, &[0, 0, 0, 255, 255, 255, 255, 255]), Role::Coverage(None)).unwrap();
        assert_eq!((opaque.pixel(0, 0).w, opaque.pixel(1, 0).w), (0.0, 1.0));
    }

    #[test]
    fn normal_maps_are_told_from_heights() {
        assert!(is_normal_map(&image(3, &[128, 128, 255, 100, 140, 230])));
        assert!(!is_normal_map(&image(3, &[200, 200, 200, 100, 100, 100])));
        assert!(!is_normal_map(&image(1, &[128, 128, 255])));
    }
}
