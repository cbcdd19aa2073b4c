//! The partition as an OBJ file, to be looked at in any other program.

use super::node::Kind;
use super::{BspTree, Place};
use heliostat_geometry::Aabb;
use std::io::{self, Write};

/// Which cells to export.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExportWhat {
    /// The cells of all leaves. They tile the root.
    Leaves,
    /// The partition as it is so many levels below the root: the cells of that depth, and the leaves above it.
    /// They tile the root, too.
    Depth(u32),
    /// The cells of all nodes, nested.
    All,
}

/// The faces of a box over the corners of [`Aabb::corners`] (x in bit 0, y in bit 1, z in bit 2),
/// counter-clockwise seen from outside.
const FACES: [[usize; 4]; 6] =
    [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

/// Writes cells of the tree as boxes of eight vertices and six quads.
///
/// One group `depth_NN` for each depth; in it one object for each cell, `leaf_N` with the number of references,
/// or `node_N`, where `N` counts the exported cells.
///
/// # Errors
/// Those of the writer.
pub fn export_obj(tree: &BspTree, what: ExportWhat, out: &mut impl Write) -> io::Result<()> {
    let mut places: Vec<Place> = tree.places().filter(|place| is_wanted(place, what)).collect();
    // Stable: within a depth the order of the tree remains.
    places.sort_by_key(|place| place.depth);

    let stats = tree.stats();
    writeln!(out, "# Cells of a BSP tree over {} primitives", stats.primitives)?;
    writeln!(out, "# {} nodes, {} leaves, depth {}", stats.nodes, stats.leaves, stats.depth)?;
    let mut group = None;
    for (number, place) in places.iter().enumerate() {
        if group != Some(place.depth) {
            group = Some(place.depth);
            writeln!(out, "g depth_{:02}", place.depth)?;
        }
        match place.kind {
            Kind::Leaf { count, .. } => writeln!(out, "o leaf_{number:06}_{count}")?,
            Kind::Inner { .. } => writeln!(out, "o node_{number:06}")?,
        }
        write_box(place.cell, 8 * number + 1, out)?;
    }
    Ok(())
}

fn is_wanted(place: &Place, what: ExportWhat) -> bool {
    let is_leaf = matches!(place.kind, Kind::Leaf { .. });
    // A tree over nothing has a cell of nothing.
    !place.cell.is_empty()
        && match what {
            ExportWhat::Leaves => is_leaf,
            ExportWhat::Depth(depth) => place.depth == depth || (is_leaf && place.depth < depth),
            ExportWhat::All => true,
        }
}

/// Writes one box whose first vertex is number `first`.
fn write_box(cell: Aabb, first: usize, out: &mut impl Write) -> io::Result<()> {
    for corner in cell.corners() {
        writeln!(out, "v {} {} {}", corner.x, corner.y, corner.z)?;
    }
    for face in FACES {
        let [a, b, c, d] = face.map(|corner| first + corner);
        writeln!(out, "f {a} {b} {c} {d}")?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::FACES;
    use glam::Vec3;
    use heliostat_geometry::Aabb;

    #[test]
    fn faces_look_outward() {
        let cell = Aabb { min: Vec3::new(-3.0, 1.0, 10.0), max: Vec3::new(-1.0, 4.0, 15.0) };
        let corners = cell.corners();
        for face in FACES {
            let [a, b, c, d] = face.map(|i| corners[i]);
            let normal = (c - a).cross(d - b);
            assert!(normal.dot((a + c) / 2.0 - cell.centre()) > 0.0, "{face:?} looks inward");
        }
    }
}
