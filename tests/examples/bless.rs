//! Renders golden pictures anew: all, or those named. Look at them before they are committed.

use heliostat_tests::golden;

fn main() -> Result<(), String> {
    let asked: Vec<String> = std::env::args().skip(1).collect();
    for name in golden::NAMES {
        if asked.is_empty() || asked.iter().any(|a| a == name) {
            let frame = golden::make(name)?;
            let options = heliostat_io::exr_file::ExrOptions::default();
            heliostat_io::exr_file::write_exr(&golden::path(name), &frame, &options)
                .map_err(|e| e.to_string())?;
        }
    }
    Ok(())
}
