//! The real library, where there is one: `HELIOSTAT_OIDN` names it.

use heliostat_oidn::{ENVIRONMENT, Oidn, OidnError, Picture};
use std::path::Path;

/// Numbers in `[0, 1)` that look random.
///
/// # Source
/// Knuth's multiplicative generator with the constants of PCG.
fn noise(count: usize) -> Vec<f32> {
    let mut state = 1_u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f32 / (1_u64 << 24) as f32
    };
    (0..count).map(|_| next()).collect()
}

#[test]
#[expect(clippy::print_stderr, reason = "a skipped test says so")]
fn noise_becomes_its_mean() {
    if std::env::var_os(ENVIRONMENT).is_none() {
        eprintln!("skipped: {ENVIRONMENT} names no library");
        return;
    }
    let oidn = Oidn::find(None).expect("the library of the environment opens");
    assert!(oidn.version().expect("a version").starts_with("2."));
    let (width, height) = (96, 64);
    let color = noise(3 * width * height);
    let (albedo, normal) = (vec![0.5; color.len()], [0.0, 0.0, 1.0].repeat(width * height));
    let picture = Picture { width, height, color: &color, albedo: Some(&albedo), normal: Some(&normal) };
    let clean = oidn.denoise(&picture, 2).expect("it denoises");
    assert_eq!(clean.len(), color.len());
    let (mean, spread) = moments(&clean);
    let (noisy_mean, noisy_spread) = moments(&color);
    // White noise has a spread of 12^-1/2 around 1/2; nothing but the mean is in it.
    assert!((noisy_spread - 1.0 / 12.0_f64.sqrt()).abs() < 0.01, "{noisy_spread}");
    assert!((mean - noisy_mean).abs() < 0.03 && spread < 0.2 * noisy_spread, "{mean} {spread}");
    assert_eq!(clean, oidn.denoise(&picture, 1).expect("again"), "threads leave no trace");
}

fn moments(values: &[f32]) -> (f64, f64) {
    let count = values.len() as f64;
    let mean = values.iter().map(|&v| f64::from(v)).sum::<f64>() / count;
    let variance = values.iter().map(|&v| (f64::from(v) - mean).powi(2)).sum::<f64>() / count;
    (mean, variance.sqrt())
}

#[test]
fn sizes_are_checked_before_anything_is_handed_over() {
    if let Ok(oidn) = Oidn::find(None) {
        let picture = Picture { width: 2, height: 2, color: &[0.0; 11], albedo: None, normal: None };
        assert!(matches!(oidn.denoise(&picture, 1), Err(OidnError::Size { .. })));
        let nothing = Picture { width: 0, height: 2, color: &[], albedo: None, normal: None };
        assert_eq!(oidn.denoise(&nothing, 1).expect("nothing to do"), Vec::<f32>::new());
    }
}

#[test]
fn what_is_no_library_is_told() {
    let missing = Oidn::find(Some(Path::new("/nowhere/libOpenImageDenoise.so.2"))).unwrap_err().to_string();
    assert!(missing.contains("/nowhere/libOpenImageDenoise.so.2: cannot be opened"), "{missing}");
    let stranger = if cfg!(windows) { "kernel32.dll" } else { "libc.so.6" };
    if let Err(OidnError::Incomplete { function, .. }) = Oidn::find(Some(Path::new(stranger))) {
        assert_eq!(function, "oidnNewDevice");
    }
}
