//! Parsers of the values that flags take. Each error says what was expected; clap adds the flag and the value.

use heliostat_scene::settings::PixelRect;

/// Pixels per side, at most: what EXR and PNG readers commonly accept.
const LARGEST_SIDE: u32 = 65_535;
/// Frames of one run, at most: more is a slip of the keyboard.
pub(crate) const MOST_FRAMES: u64 = 1_000_000;

/// Width and height in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size {
    pub(crate) width: u32,
    pub(crate) height: u32,
}

/// `WxH`.
pub(crate) fn size(text: &str) -> Result<Size, String> {
    let expected = || format!("write WIDTHxHEIGHT, as in 1920x1080, each from 1 to {LARGEST_SIDE}");
    let (width, height) = text.split_once(['x', 'X']).ok_or_else(expected)?;
    let side = |s: &str| s.parse().ok().filter(|n| (1..=LARGEST_SIDE).contains(n)).ok_or_else(expected);
    Ok(Size { width: side(width)?, height: side(height)? })
}

/// `X0,Y0,X1,Y1`, not empty.
pub(crate) fn region(text: &str) -> Result<PixelRect, String> {
    let numbers: Option<Vec<u32>> = text.split(',').map(|n| n.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[x0, y0, x1, y1]) if x0 < x1 && y0 < y1 => Ok(PixelRect { x0, y0, x1, y1 }),
        Some([_, _, _, _]) => {
            Err("the region is empty; write the third number above the first and the fourth above the \
            second"
                .into())
        }
        _ => Err("write four whole numbers LEFT,TOP,RIGHT,BOTTOM, as in 100,50,300,200".into()),
    }
}

/// A run of frame numbers with a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct FrameRun {
    first: i32,
    last: i32,
    step: u32,
}

/// Frame numbers in the order in which they are asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum FrameList {
    /// Whatever the scene has.
    All,
    /// These, each once.
    Some(Vec<i32>),
}

/// `1-48`, `1-48x2`, `1,5,10-20`, `all`. Frame numbers may be negative, as in `-5--1`.
pub(crate) fn frames(text: &str) -> Result<FrameList, String> {
    if text == "all" {
        return Ok(FrameList::All);
    }
    let runs = text.split(',').map(frame_run).collect::<Result<Vec<_>, _>>()?;
    let count: u64 = runs.iter().map(|r| u64::from(r.last.abs_diff(r.first) / r.step) + 1).sum();
    if count > MOST_FRAMES {
        return Err(format!("{count} frames are more than one run takes; write at most {MOST_FRAMES}"));
    }
    let mut numbers = Vec::new();
    let mut seen = std::collections::HashSet::new();
    for run in runs {
        let each = (run.first..=run.last).step_by(run.step as usize);
        numbers.extend(each.filter(|&n| seen.insert(n)));
    }
    Ok(FrameList::Some(numbers))
}

fn frame_run(text: &str) -> Result<FrameRun, String> {
    let expected = || format!("`{text}` is no frame or range; write 7, 1-48, 1-48x2 or all");
    let (range, step) = text.split_once('x').unwrap_or((text, "1"));
    let step: u32 = step.parse().ok().filter(|&s| s > 0).ok_or_else(expected)?;
    // The first character may be a sign: the dash between two numbers comes after it.
    let dash = range.char_indices().skip(1).find(|&(_, c)| c == '-').map(|(i, _)| i);
    let (first, last) = dash.map_or((range, range), |i| (&range[..i], &range[i + 1..]));
    let first: i32 = first.parse().map_err(|_| expected())?;
    let last: i32 = last.parse().map_err(|_| expected())?;
    if last < first {
        return Err(format!("the range `{text}` runs backwards; write the smaller frame first"));
    }
    Ok(FrameRun { first, last, step })
}

/// `PATH=VALUE`.
pub(crate) fn assignment(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((path, value)) if !path.trim().is_empty() && !value.trim().is_empty() => {
            Ok((path.trim().to_owned(), value.trim().to_owned()))
        }
        _ => Err("write PATH=VALUE, as in render.samples=64".into()),
    }
}

/// A finite number.
pub(crate) fn finite(text: &str) -> Result<f32, String> {
    text.parse().ok().filter(|x: &f32| x.is_finite()).ok_or_else(|| "write a finite number".into())
}

/// A finite number above 0.
pub(crate) fn positive(text: &str) -> Result<f32, String> {
    let number = text.parse().ok().filter(|x: &f32| x.is_finite() && *x > 0.0);
    number.ok_or_else(|| "write a finite number above 0, as in 0.01".into())
}

/// Seconds, from a number with `s`, `m`, `h` or nothing behind it.
pub(crate) fn duration(text: &str) -> Result<f64, String> {
    let unit = text.chars().last().filter(char::is_ascii_alphabetic);
    let number = text.strip_suffix(|c: char| c.is_ascii_alphabetic()).unwrap_or(text);
    let seconds = match unit {
        None | Some('s') => 1.0,
        Some('m') => 60.0,
        Some('h') => 3600.0,
        Some(_) => f64::NAN,
    };
    let time = number.parse().ok().map(|n: f64| n * seconds).filter(|t| t.is_finite() && *t > 0.0);
    time.ok_or_else(|| "write a time above 0, as in 90, 90s, 5m or 2h".into())
}

/// A finite number, 0 or above.
pub(crate) fn non_negative(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|x: &f64| x.is_finite() && *x >= 0.0);
    number.ok_or_else(|| "write a finite number, 0 or above".into())
}

/// Frames per second.
pub(crate) fn frame_rate(text: &str) -> Result<f64, String> {
    let rate = text.parse().ok().filter(|x: &f64| (0.01..=1000.0).contains(x));
    rate.ok_or_else(|| "write a number of frames per second, from 0.01 to 1000".into())
}

/// 8 or 16.
pub(crate) fn bits(text: &str) -> Result<u8, String> {
    match text {
        "8" => Ok(8),
        "16" => Ok(16),
        _ => Err("write 8 or 16".into()),
    }
}

/// One of the trees of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Tree {
    /// Over the objects.
    Objects,
    /// Over the triangles of a mesh.
    Mesh(usize),
    /// Over the objects of a group.
    Group(usize),
    /// Over the copies of a group.
    Copies(usize),
}

/// `objects`, the number of a mesh, or `group=` or `copies=` and the number of a group.
pub(crate) fn tree(text: &str) -> Result<Tree, String> {
    let number = |text: &str, tree: fn(usize) -> Tree| text.parse().ok().map(tree);
    let tree = match text.split_once('=') {
        Some(("group", text)) => number(text, Tree::Group),
        Some(("copies", text)) => number(text, Tree::Copies),
        None if text == "objects" => Some(Tree::Objects),
        _ => number(text, Tree::Mesh),
    };
    tree.ok_or_else(|| {
        "write `objects`, the number of a mesh, from 0, or `group=` or `copies=` and the number of a group"
            .into()
    })
}

/// The nodes of a tree whose boxes are exported.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Boxes {
    /// Nodes without children.
    Leaves,
    /// Every node.
    All,
    /// The nodes so far below the root.
    Depth(u32),
}

/// `leaves`, `all` or `depth=N`.
pub(crate) fn boxes(text: &str) -> Result<Boxes, String> {
    let depth = text.strip_prefix("depth=").and_then(|n| n.parse().ok());
    match (text, depth) {
        ("leaves", _) => Ok(Boxes::Leaves),
        ("all", _) => Ok(Boxes::All),
        (_, Some(depth)) => Ok(Boxes::Depth(depth)),
        _ => Err("write leaves, all, or depth=N with a whole number".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frame_lists() {
        let numbers = |text| match frames(text) {
            Ok(FrameList::Some(n)) => n,
            other => panic!("{text}: {other:?}"),
        };
        assert_eq!(numbers("7"), [7]);
        assert_eq!(numbers("1-4"), [1, 2, 3, 4]);
        assert_eq!(numbers("1-8x3"), [1, 4, 7]);
        assert_eq!(numbers("9,1,3-4,2-5"), [9, 1, 3, 4, 2, 5]);
        assert_eq!(numbers("-3--1"), [-3, -2, -1]);
        assert_eq!(numbers("-1-1"), [-1, 0, 1]);
        assert_eq!(frames("all"), Ok(FrameList::All));
    }

    #[test]
    fn wrong_frame_lists() {
        for text in [
            "",
            "a",
            "1-",
            "-",
            "1-4x0",
            "1-4x",
            "4-1",
            "1,,2",
            "1-2-3",
            "0-2147483647",
            "1--",
            "99999999999",
        ] {
            assert!(frames(text).is_err(), "{text}");
        }
    }

    #[test]
    fn sizes_and_regions() {
        assert_eq!(size("640x480"), Ok(Size { width: 640, height: 480 }));
        for text in ["640", "640x", "x480", "0x4", "4x0", "-4x4", "70000x1", "4x4x4", "4.5x3"] {
            assert!(size(text).is_err(), "{text}");
        }
        assert_eq!(region("1,2,3,4"), Ok(PixelRect { x0: 1, y0: 2, x1: 3, y1: 4 }));
        for text in ["1,2,3", "1,2,3,4,5", "1,2,1,4", "1,4,3,4", "-1,2,3,4", "a,b,c,d", "1,2,3,x"] {
            assert!(region(text).is_err(), "{text}");
        }
    }

    #[test]
    fn assignments() {
        assert_eq!(assignment("a.b = [1, 2]"), Ok(("a.b".into(), "[1, 2]".into())));
        assert_eq!(assignment("a=b=c"), Ok(("a".into(), "b=c".into())));
        for text in ["a", "=1", "a=", "="] {
            assert!(assignment(text).is_err(), "{text}");
        }
    }
}
