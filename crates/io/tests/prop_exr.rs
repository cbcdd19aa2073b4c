//! Laws of OpenEXR files: reading undoes writing; damage is an error or harmless, never a panic.

use half::f16;
use heliostat_io::exr_file::{Compression, ExrOptions, decode_exr, encode_exr};
use heliostat_io::image_file::{Limits, decode_image};
use heliostat_scene::frame::{Channel, Depth, Frame, Meta};
use heliostat_scene::settings::PixelRect;
use proptest::collection::{btree_map, btree_set, vec};
use proptest::prelude::*;
use std::path::Path;

fn config() -> ProptestConfig {
    ProptestConfig { failure_persistence: None, ..ProptestConfig::default() }
}

fn compression() -> impl Strategy<Value = Compression> {
    use Compression::{None, Piz, Zip, Zips};
    prop_oneof![Just(None), Just(Zips), Just(Zip), Just(Piz)]
}

fn meta() -> impl Strategy<Value = Meta> {
    prop_oneof![
        ".{0,40}".prop_map(Meta::Text),
        any::<i32>().prop_map(Meta::Int),
        float().prop_map(Meta::Float),
        any::<(i32, u32)>().prop_map(|(n, d)| Meta::Rational(n, d)),
        proptest::array::uniform2(float()).prop_map(Meta::Vec2),
        proptest::array::uniform3(float()).prop_map(Meta::Vec3),
        proptest::array::uniform16(float()).prop_map(Meta::Matrix),
        vec(".{0,9}", 0..4).prop_map(Meta::Texts),
        vec(any::<u8>(), 0..20).prop_map(|bytes| Meta::Other { kind: "own".to_owned(), bytes }),
    ]
}

/// Finite values of every size.
fn float() -> impl Strategy<Value = f32> {
    use proptest::num::f32::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
    POSITIVE | NEGATIVE | NORMAL | SUBNORMAL | ZERO
}

/// Finite values of every size that survive in a half.
fn half() -> impl Strategy<Value = f32> {
    // All bits of the exponent set is NaN or infinite: clear one.
    let finite = |bits: u16| if bits & 0x7c00 == 0x7c00 { bits & !0x0400 } else { bits };
    any::<u16>().prop_map(move |bits| f16::from_bits(finite(bits)).to_f32())
}

fn channel(pixels: usize) -> impl Strategy<Value = (Depth, Vec<f32>)> {
    prop_oneof![
        vec(half(), pixels).prop_map(|v| (Depth::Half, v)),
        vec(float(), pixels).prop_map(|v| (Depth::Float, v)),
    ]
}

fn frame() -> impl Strategy<Value = Frame> {
    let sides = (1..40u32, 1..40u32, 0..30u32, 0..30u32, 0..9u32, 0..9u32);
    let names = btree_set("[A-Za-z_][A-Za-z0-9_]{0,40}(\\.[A-Z])?", 1..6);
    let meta = btree_map("heliostat/[a-z]{1,40}", meta(), 0..9);
    (sides, names, meta).prop_flat_map(|((w, h, x0, y0, right, below), names, mut meta)| {
        meta.insert("software".to_owned(), Meta::Text("a test".to_owned()));
        let window = PixelRect { x0, y0, x1: x0 + w, y1: y0 + h };
        let channels = vec(channel((w * h) as usize), names.len());
        channels.prop_map(move |channels| {
            let named = |(name, (depth, values)): (&String, _)| Channel { name: name.clone(), depth, values };
            Frame {
                width: window.x1 + right,
                height: window.y1 + below,
                window,
                // Names from a set are in the order of the file.
                channels: names.iter().zip(channels).map(named).collect(),
                meta: meta.clone(),
            }
        })
    })
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn reading_undoes_writing(frame in frame(), compression in compression()) {
        let options = ExrOptions { compression, threads: 1 };
        let (bytes, report) = encode_exr(&frame, &options).unwrap();
        prop_assert_eq!(report, Default::default());
        let back = decode_exr(Path::new("a.exr"), &bytes, &Limits::default()).unwrap();
        prop_assert_eq!(back, frame);
    }

    #[test]
    fn damage_is_no_disaster(
        frame in frame(),
        compression in compression(),
        cut in any::<prop::sample::Index>(),
        flips in vec((any::<prop::sample::Index>(), 1..=255u8), 0..4),
        in_header in any::<bool>(),
    ) {
        let options = ExrOptions { compression, threads: 1 };
        let (mut bytes, _) = encode_exr(&frame, &options).unwrap();
        let limits = Limits { side: 4096, bytes: 1 << 22 };
        let cut_file = &bytes[..cut.index(bytes.len())];
        prop_assert!(decode_exr(Path::new("a.exr"), cut_file, &limits).is_err());
        let range = if in_header { bytes.len().min(400) } else { bytes.len() };
        for (at, bits) in flips {
            bytes[at.index(range)] ^= bits;
        }
        if let Ok(image) = decode_image(Path::new("a.exr"), &bytes, &limits) {
            prop_assert!(image.bytes() as u64 <= limits.bytes);
        }
        if let Ok(frame) = decode_exr(Path::new("a.exr"), &bytes, &limits) {
            prop_assert!(frame.channels.iter().all(|c| c.values.len() == frame.pixel_count()));
        }
    }
}
