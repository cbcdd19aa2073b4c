//! Pictures against their golden mean and variance. On failure the rendering lies in `target/golden/`.

use heliostat_io::exr_file::{ExrOptions, read_exr, write_exr};
use heliostat_io::image_file::Limits;
use heliostat_tests::{golden, scenes};

#[test]
fn pictures_converge_to_their_golden_means() {
    let mut failures = Vec::new();
    for name in golden::NAMES {
        let reference =
            read_exr(&golden::path(name), &Limits::default()).expect("golden pictures are committed");
        let frame = golden::rendering(name, 7).expect("scenes of the repository render");
        let verdict = golden::compare(&reference, &frame).expect("same channels");
        if !verdict.is_pass() {
            let folder = scenes::root().join("target/golden");
            std::fs::create_dir_all(&folder).expect("target can be written");
            let evidence = folder.join(format!("{name}.exr"));
            write_exr(&evidence, &frame, &ExrOptions::default()).expect("target can be written");
            failures.push(format!("{name}: {verdict:?}, see {}", evidence.display()));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn another_picture_fails() {
    // The test must be able to fail: two scenes that differ in one term are told apart.
    let reference = read_exr(&golden::path("fig02_phong"), &Limits::default()).expect("committed");
    let other = golden::rendering("fig02_diffuse", 7).expect("renders");
    assert!(!golden::compare(&reference, &other).expect("same channels").is_pass());
}
