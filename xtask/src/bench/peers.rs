//! Heliostat against POV-Ray on the same scene, written for both: `scenes/peers/whitted.{toml,pov}`.

use super::{median, seconds};
use crate::Outcome;
use crate::heliostat::Heliostat;
use crate::process::{command, root, say};
use image::imageops::overlay;

/// Runs both in turn and prints the ratio of the medians; says so and stops where there is no POV-Ray.
pub(crate) fn run(rounds: usize) -> Outcome {
    if command("povray", &["--version"]).output().is_err() {
        say("bench peers: no `povray` on the path, nothing to compare with (Debian: apt-get install povray)");
        return Ok(());
    }
    let folder = root().join("out/peers");
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let heliostat = Heliostat::build()?;
    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    for round in 1..=rounds {
        ours.push(seconds(heliostat.command(&[
            "render",
            "scenes/peers/whitted.toml",
            "--threads",
            "2",
            "--progress",
            "none",
            "-o",
            "out/peers/heliostat.png",
        ]))?);
        theirs.push(seconds(povray())?);
        say(&format!("round {round}: heliostat {:.2} s, povray {:.2} s", ours[round - 1], theirs[round - 1]));
    }
    let (ours, theirs) = (median(ours), median(theirs));
    side_by_side()?;
    say("| 1920x1080, 2 threads | seconds (median) | ratio |\n|---|---|---|");
    say(&format!("| heliostat | {ours:.2} | 1 |\n| POV-Ray | {theirs:.2} | {:.2} |", theirs / ours));
    Ok(())
}

/// POV-Ray on its scene, with the output in the folder where it may write.
fn povray() -> std::process::Command {
    let mut povray =
        command("povray", &["+I../../scenes/peers/whitted.pov", "+Opovray.png", "+W1920", "+H1080"]);
    povray.args(["-A", "+WT2", "-D", "-V", "-GA"]).current_dir(root().join("out/peers"));
    povray
}

/// Both pictures in one, ours on the left.
fn side_by_side() -> Outcome {
    let open = |name: &str| {
        let path = root().join("out/peers").join(name);
        image::open(&path).map(|i| i.to_rgb8()).map_err(|e| format!("{}: {e}", path.display()))
    };
    let (ours, theirs) = (open("heliostat.png")?, open("povray.png")?);
    let mut both = image::RgbImage::new(ours.width() + theirs.width(), ours.height());
    overlay(&mut both, &ours, 0, 0);
    overlay(&mut both, &theirs, i64::from(ours.width()), 0);
    both.save(root().join("out/peers/side_by_side.png")).map_err(|e| format!("side_by_side.png: {e}"))
}
