//! `heliostat index`.

use super::value;
use clap::{Args, ValueEnum};
use std::path::PathBuf;

const AFTER_HELP: &str = "\
Every mesh has a tree of its own, over its triangles, every group one over the boxes of its objects and one over those of its
copies, where there are several; the object tree is over the boxes of the objects.

Examples:
  heliostat index model.obj                                  statistics of all trees
  heliostat index model.obj --preset midpoint --verify 100000
  heliostat index model.obj --replay model.disagreements.jsonl
  heliostat index model.obj --export tree.obj --what depth=4
  heliostat index scene.toml --heatmap cost.png              nodes visited per pixel, as colours";

/// Tell how the spatial index divides a scene; export it, and verify it with rays
#[derive(Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub(crate) struct IndexArgs {
    /// A scene (.toml) or a model (.obj, .gltf, .glb)
    pub(crate) scene: PathBuf,

    /// How trees are built; without it, `midpoint` and `balanced` are shown
    #[arg(long, value_enum, value_name = "NAME")]
    pub(crate) preset: Option<Preset>,

    /// Write the boxes of one tree as an OBJ file
    #[arg(long, value_name = "OBJ")]
    pub(crate) export: Option<PathBuf>,

    /// Which tree is exported: `objects`, the number of a mesh (from 0), or `group=N` or `copies=N` for those over the objects or the copies of a group [default: 0 if there is one mesh, else objects]
    #[arg(long, value_name = "TREE", value_parser = value::tree, requires = "export")]
    pub(crate) tree: Option<value::Tree>,

    /// Which boxes are exported: `leaves`, `all` nodes, or the nodes of `depth=N`
    #[arg(long, value_name = "WHAT", value_parser = value::boxes, default_value = "leaves", requires = "export")]
    pub(crate) what: value::Boxes,

    /// Trace this many random rays through the tree, a bounding volume hierarchy and brute force, and compare (exit code 1 if they differ)
    #[arg(long, value_name = "RAYS", value_parser = clap::value_parser!(u32).range(1..=100_000_000))]
    pub(crate) verify: Option<u32>,

    /// Where `--verify` saves the rays that an index gets wrong, the first few thousand if there are more [default: SCENE.disagreements.jsonl]
    #[arg(long, value_name = "FILE", requires = "verify")]
    pub(crate) disagreements: Option<PathBuf>,

    /// Trace the rays that `--verify` saved once more, through all indices or that of --preset (exit code 1 if any still differs)
    #[arg(long, value_name = "FILE", conflicts_with = "verify")]
    pub(crate) replay: Option<PathBuf>,

    /// Render what each pixel costs in the tree, as a heat map
    #[arg(long, value_name = "PNG")]
    pub(crate) heatmap: Option<PathBuf>,

    /// Print JSON to standard output
    #[arg(long)]
    pub(crate) json: bool,
}

/// The ways to build a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Preset {
    /// Split of the longest edge in the middle: the classic build
    Midpoint,
    /// Built in the shortest time
    Fast,
    /// Fast rays after a short build: what renders use
    Balanced,
    /// The fastest rays
    Best,
}
