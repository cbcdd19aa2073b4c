//! Heliostat's trees.

use crate::contestant::{Contestant, Query};
use heliostat_geometry::{Ray, TriMesh};
use heliostat_index::{Backend, BuildParams, MeshTree};

/// A tree by one preset.
pub(crate) struct Ours {
    name: String,
    pub(crate) tree: MeshTree,
    /// Whether rays are handed over all at once.
    batch: bool,
}

impl Ours {
    /// Builds the tree; `backend` in place of the best one, where given.
    pub(crate) fn build(mesh: &TriMesh, preset: &str, backend: Option<Backend>) -> Result<Self, String> {
        let (preset, batch) = preset.strip_suffix("-batch").map_or((preset, false), |preset| (preset, true));
        let params: BuildParams = preset.parse().map_err(|e| format!("{e}"))?;
        let mut tree = MeshTree::build(mesh, &params).map_err(|e| e.to_string())?;
        let mut name = format!("heliostat {preset}{}", if batch { ", batch" } else { "" });
        if let Some(backend) = backend {
            tree = tree.with_backend(backend);
            name = format!("{name}, {}", backend.name());
        }
        Ok(Self { name, tree, batch })
    }
}

impl Contestant for Ours {
    fn name(&self) -> &str {
        &self.name
    }

    fn build_seconds(&self) -> f64 {
        self.tree.stats().build_seconds
    }

    fn trace(&self, query: Query, rays: &[Ray], distances: &mut [f32]) {
        match query {
            Query::Closest if self.batch => {
                for (found, distance) in self.tree.closest_hits(rays).iter().zip(distances) {
                    *distance = found.map_or(f32::INFINITY, |found| found.hit.t);
                }
            }
            Query::Any if self.batch => {
                for (found, distance) in self.tree.any_hits(rays).iter().zip(distances) {
                    *distance = if *found { 0.0 } else { f32::INFINITY };
                }
            }
            Query::Closest => {
                for (ray, distance) in rays.iter().zip(distances) {
                    *distance = self.tree.closest_hit(ray).map_or(f32::INFINITY, |found| found.hit.t);
                }
            }
            Query::Any => {
                for (ray, distance) in rays.iter().zip(distances) {
                    *distance = if self.tree.any_hit(ray) { 0.0 } else { f32::INFINITY };
                }
            }
        }
    }
}
