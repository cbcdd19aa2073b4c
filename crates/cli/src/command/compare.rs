//! `heliostat compare`: how two images differ, in numbers, as the eye sees it, and as a picture.

use crate::args::{CompareArgs, Metric};
use crate::diagnose::Failure;
use crate::exit::Exit;
use crate::output::check_writable;
use crate::table::{self, Table};
use crate::{out, progress};
use heliostat_io::LoadError;
use heliostat_io::compare::{ChannelNumbers, Comparison, Range, compare, compare_channels, difference_frame};
use heliostat_io::image_file::{Limits, read_frame};
use heliostat_io::picture::Picture;
use heliostat_io::png_file::{PngOptions, write_png};
use heliostat_scene::Frame;
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::Path;

/// Compares, tells, draws, judges.
pub(crate) fn run(args: &CompareArgs) -> Result<Exit, Failure> {
    check_arguments(args)?;
    let limits = Limits::default();
    let mut frames = [read_frame(&args.reference, &limits)?, read_frame(&args.image, &limits)?];
    check_sizes(args, &frames)?;
    keep_common_channels(args, &mut frames)?;
    let [reference, image] = &frames;
    let differs = |what: String| Failure::new(Exit::Input, format!("{}: {what}", args.image.display()));
    let channels = compare_channels(reference, image).map_err(differs)?;
    // A single channel is data: the eye has no say.
    let seen = if args.channel.is_some() { None } else { Some(look(args, reference, image)?) };

    if args.json {
        out::line(format_args!("{:#}", json(args, seen.as_ref(), &channels)));
    } else {
        out::line(format_args!("{}", text(args, seen.as_ref(), &channels).trim_end()));
    }
    judge(args, seen.as_ref(), &channels)
}

/// What clap cannot see.
fn check_arguments(args: &CompareArgs) -> Result<(), Failure> {
    if args.channel.is_some() && args.metric == Metric::Flip {
        return Err(Failure::usage(
            "--metric flip looks at colours; write --metric rmse or max beside --channel",
        ));
    }
    match &args.diff {
        Some(_) if args.channel.is_some() => {
            Err(Failure::usage("--diff draws colours; leave out --diff or --channel"))
        }
        Some(diff) => check_writable(diff),
        None => Ok(()),
    }
}

fn check_sizes(args: &CompareArgs, [reference, image]: &[Frame; 2]) -> Result<(), Failure> {
    let size = |frame: &Frame| format!("{} x {} pixels", frame.width, frame.height);
    if (reference.width, reference.height) == (image.width, image.height) && reference.window == image.window
    {
        return Ok(());
    }
    let whole = if size(reference) == size(image) { "another region of the same picture" } else { "" };
    let message = match whole {
        "" => format!("{}, but {} has {}", size(image), args.reference.display(), size(reference)),
        region => format!("{region} than {}", args.reference.display()),
    };
    Err(LoadError::new(&args.image, message).with_help("compare images of one size").into())
}

/// Layers that one image alone has do not make the others incomparable; no channel in common does.
fn keep_common_channels(args: &CompareArgs, frames: &mut [Frame; 2]) -> Result<(), Failure> {
    let names = |frame: &Frame| frame.channels.iter().map(|c| c.name.clone()).collect::<Vec<_>>();
    let [first, second] = [names(&frames[0]), names(&frames[1])];
    let wanted = |name: &String| args.channel.as_ref().is_none_or(|channel| channel == name);
    let common: Vec<String> =
        first.iter().filter(|name| second.contains(name) && wanted(name)).cloned().collect();
    if common.is_empty() {
        let message = match &args.channel {
            Some(channel) => format!("no channel `{channel}` in both images"),
            None => "the two images have no channel in common".to_owned(),
        };
        let help = format!("they have {} and {}", first.join(", "), second.join(", "));
        return Err(LoadError::new(&args.image, message).with_help(help).into());
    }
    for frame in frames {
        frame.channels.retain(|c| common.contains(&c.name));
    }
    Ok(())
}

/// Compares the colours, and draws the difference where asked to.
fn look(args: &CompareArgs, reference: &Frame, image: &Frame) -> Result<Comparison, Failure> {
    let wrong = |what: &str| Failure::new(Exit::Input, format!("{}: {what}", args.image.display()));
    let picture = |frame: &Frame| Picture::of(frame).ok_or_else(|| wrong("has no channels to look at"));
    let (reference, image) = (picture(reference)?, picture(image)?);
    let range = if is_hdr(&args.reference) || is_hdr(&args.image) { Range::Hdr } else { Range::Ldr };
    let comparison = compare(&reference, &image, range).map_err(|e| wrong(&e))?;
    if let Some(diff) = &args.diff {
        write_png(diff, &difference_frame(&comparison, &reference, &image), &PngOptions::default())?;
        out::note(format_args!("Saved: '{}'", progress::clean(&diff.to_string_lossy())));
    }
    Ok(comparison)
}

fn is_hdr(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("exr") || e.eq_ignore_ascii_case("hdr"))
}

/// The value of the metric that `--max` limits.
fn measured(args: &CompareArgs, seen: Option<&Comparison>, channels: &[ChannelNumbers]) -> f64 {
    match (args.metric, seen) {
        (Metric::Flip, Some(seen)) => seen.mean_flip(),
        (Metric::Rmse, Some(seen)) => seen.numbers.rmse,
        (Metric::Rmse, None) => channels.iter().map(|c| c.rmse).fold(0.0, f64::max),
        // The largest difference of any channel, data layers too.
        (Metric::Max, _) | (Metric::Flip, None) => channels.iter().map(|c| c.max).fold(0.0, f64::max),
    }
}

fn judge(
    args: &CompareArgs,
    seen: Option<&Comparison>,
    channels: &[ChannelNumbers],
) -> Result<Exit, Failure> {
    let value = measured(args, seen, channels);
    match args.max {
        Some(max) if value.is_nan() || value > max => {
            let name = metric_name(args.metric);
            let line = format!(
                "{}: {name} {} is above the limit {}; see where with --diff",
                args.image.display(),
                table::number(value),
                table::number(max)
            );
            Err(Failure::new(Exit::Failed, line))
        }
        _ => Ok(Exit::Done),
    }
}

fn metric_name(metric: Metric) -> &'static str {
    match metric {
        Metric::Rmse => "RMSE",
        Metric::Flip => "FLIP",
        Metric::Max => "the largest difference",
    }
}

/// JSON has no infinity: such values become null.
fn json(args: &CompareArgs, seen: Option<&Comparison>, channels: &[ChannelNumbers]) -> Value {
    let channels: Vec<Value> = channels
        .iter()
        .map(|c| json!({ "name": c.name, "rmse": c.rmse, "max": c.max, "differing": c.differing }))
        .collect();
    let mut json = json!({
        "reference": args.reference.to_string_lossy(),
        "image": args.image.to_string_lossy(),
        "channels": channels,
    });
    if let Some(seen) = seen {
        let numbers = &seen.numbers;
        json["size"] = json!([seen.width, seen.height]);
        json["rmse"] = json!(numbers.rmse);
        json["relative_mse"] = json!(numbers.rel_mse);
        json["flip"] = json!(seen.mean_flip());
        json["max"] = json!(numbers.max);
        json["max_at"] = json!(numbers.max_at);
        json["differing_pixels"] = json!(numbers.differing);
        json["broken_pixels"] = json!(numbers.broken);
    }
    json
}

fn text(args: &CompareArgs, seen: Option<&Comparison>, channels: &[ChannelNumbers]) -> String {
    let mut text = format!("{} against {}\n", args.image.display(), args.reference.display());
    if let Some(seen) = seen {
        let numbers = &seen.numbers;
        let pixels = seen.width as usize * seen.height as usize;
        // Writing into a `String` cannot fail.
        let mut line = |name: &str, value: String| {
            let _ = writeln!(text, "{name:<10} {value}");
        };
        line("RMSE", table::number(numbers.rmse));
        line("FLIP", table::number(seen.mean_flip()));
        let [x, y] = numbers.max_at;
        line("largest", format!("{} at {x},{y}", table::number(numbers.max)));
        let differing = table::count(numbers.differing as usize);
        line("differing", format!("{differing} of {} pixels", table::count(pixels)));
        if numbers.broken > 0 {
            line(
                "broken",
                format!("{} pixels are not finite in one image", table::count(numbers.broken as usize)),
            );
        }
    }
    let mut table = Table::new(["channel", "RMSE", "largest", "differing"]);
    for c in channels {
        let differing = table::count(c.differing as usize);
        table.row([c.name.clone(), table::number(c.rmse), table::number(c.max), differing]);
    }
    text.push_str(&table.to_string());
    text
}
