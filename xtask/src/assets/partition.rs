//! The picture in the docs of the index: a slice through the cells of two trees around the bird, as SVG.
//!
//! It is drawn from what `heliostat index --export` writes, as anyone could.

use crate::Outcome;
use crate::heliostat::Heliostat;
use crate::process::{capture, root};
use glam::{DVec3, IVec2, ivec2};
use std::fmt::Write;

const MESH: &str = "assets/meshes/bird.obj";
pub(super) const PICTURE: &str = "crates/index/docs/partition.svg";

/// The plane of the slice: a little beside the middle, where vertices may lie.
const SLICE_X: f64 = 0.01;

/// Trees, and what is said above each.
const TREES: [(&str, &str); 2] =
    [("midpoint", "midpoint: every cell is halved"), ("balanced", "balanced: cut where rays save work")];

/// The size of a panel, the space above it, and from one to the next, in units of the picture.
const PANEL: IVec2 = ivec2(490, 309);
const TOP: i32 = 26;
const STEP: i32 = PANEL.x + 20;

/// The colour of the mesh, and that of cells without triangles.
const MESH_COLOUR: &str = "#e8590c";
const EMPTY_COLOUR: &str = "#e4e2dd";

/// Where the mesh lies in a panel.
struct View {
    middle: DVec3,
    /// Units of the picture a metre.
    scale: f64,
}

/// A cell that the slice cuts, in the plane of the picture.
struct Cell {
    depth: u32,
    is_empty: bool,
    low: IVec2,
    high: IVec2,
}

/// A tree as its export tells of it.
struct Partition {
    cells: Vec<Cell>,
    /// Nodes, leaves and depth.
    figures: String,
}

/// Draws the picture.
pub(super) fn draw(heliostat: &Heliostat) -> Outcome {
    let mesh = read(MESH)?;
    let view = View::of(&mesh)?;
    let mut partitions = Vec::new();
    for (preset, _) in TREES {
        let file = format!("assets/large/{preset}.obj");
        capture(heliostat.command(&["index", MESH, "--preset", preset, "--export", &file]))?;
        partitions.push(partition(&view, &read(&file)?)?);
    }
    let picture = svg(&partitions, &outline(&view, &mesh)?);
    let path = root().join(PICTURE);
    std::fs::write(&path, picture).map_err(|e| format!("{}: {e}", path.display()))
}

fn read(file: &str) -> Result<String, String> {
    std::fs::read_to_string(root().join(file)).map_err(|e| format!("{file}: {e}"))
}

/// The numbers after the first word of a line of OBJ.
fn numbers<const N: usize>(line: &str) -> Result<[f64; N], String> {
    let numbers: Option<Vec<f64>> = line.split_whitespace().skip(1).map(|word| word.parse().ok()).collect();
    numbers.and_then(|n| n.try_into().ok()).ok_or_else(|| format!("not {N} numbers: {line}"))
}

impl View {
    /// The whole mesh, as large as it goes.
    fn of(mesh: &str) -> Result<Self, String> {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for line in mesh.lines().filter(|line| line.starts_with("v ")) {
            let p = DVec3::from_array(numbers(line)?);
            (low, high) = (low.min(p), high.max(p));
        }
        let (size, panel) = (high - low, PANEL.as_dvec2());
        Ok(Self { middle: low.midpoint(high), scale: (panel.x / size.z).min(panel.y / size.y) })
    }

    /// A point of the picture: the bird looks to the right.
    fn place(&self, p: DVec3) -> IVec2 {
        let from_middle = (self.scale * (p - self.middle)).round();
        // Up in space is down in the picture.
        PANEL / 2 + ivec2(from_middle.z as i32, -from_middle.y as i32)
    }
}

/// Reads the boxes of an export; each has eight vertices, the lowest first and the highest last.
fn partition(view: &View, text: &str) -> Result<Partition, String> {
    let (mut cells, mut depth, mut is_empty, mut corners) = (Vec::new(), 0, false, Vec::new());
    let mut figures = String::new();
    for line in text.lines() {
        match line.split_once(' ') {
            Some(("#", rest)) => rest.clone_into(&mut figures),
            Some(("g", group)) => depth = group.trim_start_matches("depth_").parse().map_err(|_| line)?,
            Some(("o", object)) => {
                is_empty = object.ends_with("_0");
                corners.clear();
            }
            Some(("v", _)) => corners.push(DVec3::from_array(numbers(line)?)),
            _ => {}
        }
        if let [low, .., high] = corners[..]
            && corners.len() == 8
        {
            if low.x <= SLICE_X && SLICE_X < high.x {
                let (a, b) = (view.place(low), view.place(high));
                cells.push(Cell { depth, is_empty, low: a.min(b), high: a.max(b) });
            }
            corners.clear();
        }
    }
    Ok(Partition { cells, figures })
}

/// The path on which the slice cuts the mesh.
fn outline(view: &View, text: &str) -> Result<String, String> {
    let (mut positions, mut path) = (Vec::new(), String::new());
    for line in text.lines() {
        if line.starts_with("v ") {
            positions.push(DVec3::from_array(numbers(line)?));
        } else if line.starts_with("f ") {
            let corners = numbers::<3>(line)?.map(|i| positions[i as usize - 1]);
            let ends: Vec<IVec2> = (0..3)
                .filter_map(|i| crossing(corners[i], corners[(i + 1) % 3]))
                .map(|p| view.place(p))
                .collect();
            if let [a, b] = ends[..]
                && a != b
            {
                let _ = write!(path, "M{} {}l{} {}", a.x, a.y, b.x - a.x, b.y - a.y);
            }
        }
    }
    Ok(path)
}

/// Where an edge passes the plane of the slice.
fn crossing(a: DVec3, b: DVec3) -> Option<DVec3> {
    let (below, above) = (a.x - SLICE_X, b.x - SLICE_X);
    ((below < 0.0) != (above < 0.0)).then(|| a.lerp(b, below / (below - above)))
}

/// The picture: lines without a gap, so that Markdown takes it for one block.
fn svg(partitions: &[Partition], outline: &str) -> String {
    let depths = || partitions.iter().flat_map(|p| &p.cells).map(|cell| cell.depth);
    let (least, most) = (depths().min().unwrap_or(0), depths().max().unwrap_or(0));
    let (width, height) = (STEP + PANEL.x, TOP + PANEL.y + 62);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"100%\" role=\"img\" \
         aria-label=\"Slices through the cells of two trees around a bird\" font-size=\"17\" fill=\"currentColor\">\n\
         <defs><path id=\"partition-mesh\" fill=\"none\" stroke=\"{MESH_COLOUR}\" stroke-width=\"2.4\" \
         stroke-linecap=\"round\" d=\"{outline}\"/></defs>\n"
    );
    for (i, (partition, (_, title))) in partitions.iter().zip(TREES).enumerate() {
        let x = i as i32 * STEP;
        // Writing into a `String` cannot fail.
        let _ = writeln!(out, "<g transform=\"translate({x} {TOP})\">\n<text y=\"-9\">{title}</text>");
        out.push_str("<g stroke=\"#fff\" stroke-width=\".8\">\n");
        for depth in least..=most {
            cells(partition, depth, &colour(depth, least, most), &mut out);
        }
        out.push_str("</g>\n<use href=\"#partition-mesh\"/>\n");
        let below = PANEL.y + 20;
        let _ = writeln!(out, "<text y=\"{below}\" font-size=\"14\">{}</text>\n</g>", partition.figures);
    }
    legend(least, most, height - 10, &mut out);
    out.push_str("</svg>\n");
    out
}

/// All cells of one depth: one path for those that hold triangles, and one for those that do not.
fn cells(partition: &Partition, depth: u32, colour: &str, out: &mut String) {
    for (is_empty, fill) in [(false, colour), (true, EMPTY_COLOUR)] {
        let mut path = String::new();
        for cell in partition.cells.iter().filter(|c| c.depth == depth && c.is_empty == is_empty) {
            let size = cell.high - cell.low;
            if size.min_element() > 0 {
                let _ = write!(path, "M{} {}h{}v{}h-{}z", cell.low.x, cell.low.y, size.x, size.y, size.x);
            }
        }
        if !path.is_empty() {
            let _ = writeln!(out, "<path fill=\"{fill}\" d=\"{path}\"/>");
        }
    }
}

/// What the colours mean.
fn legend(least: u32, most: u32, y: i32, out: &mut String) {
    let _ = writeln!(out, "<g font-size=\"14\"><text y=\"{y}\">depth {least}</text>");
    let side = 16;
    let first = 66;
    for depth in least..=most {
        let x = first + side * (depth - least) as i32;
        let fill = colour(depth, least, most);
        let _ = writeln!(out, "<path fill=\"{fill}\" d=\"M{x} {}h{side}v{side}h-{side}z\"/>", y - 13);
    }
    let after = first + side * (most - least + 1) as i32 + 8;
    let _ = writeln!(out, "<text x=\"{after}\" y=\"{y}\">{most}</text>");
    let empty = after + 50;
    let _ = writeln!(out, "<path fill=\"{EMPTY_COLOUR}\" d=\"M{empty} {}h{side}v{side}h-{side}z\"/>", y - 13);
    let _ = writeln!(out, "<text x=\"{}\" y=\"{y}\">empty</text>", empty + side + 8);
    let mesh = empty + 95;
    let _ =
        writeln!(out, "<path stroke=\"{MESH_COLOUR}\" stroke-width=\"2.4\" d=\"M{mesh} {}h{side}\"/>", y - 5);
    let _ = writeln!(out, "<text x=\"{}\" y=\"{y}\">the mesh</text></g>", mesh + side + 8);
}

/// From pale to deep blue.
fn colour(depth: u32, least: u32, most: u32) -> String {
    const STOPS: [DVec3; 3] =
        [DVec3::new(214.0, 232.0, 246.0), DVec3::new(88.0, 154.0, 210.0), DVec3::new(12.0, 52.0, 110.0)];
    let at = 2.0 * f64::from(depth - least) / f64::from((most - least).max(1));
    let [r, g, b] = if at < 1.0 { STOPS[0].lerp(STOPS[1], at) } else { STOPS[1].lerp(STOPS[2], at - 1.0) }
        .round()
        .to_array();
    format!("#{:02x}{:02x}{:02x}", r as u8, g as u8, b as u8)
}
