//! The tree over a triangle mesh, with the watertight test built into the walk.
//!
//! The tree holds no vertices: every query is given the mesh again, so that meshes stay where they are.

use crate::bsp::traverse::{Counter, Uncounted};
use crate::bsp::visited::Visited;
use crate::bsp::{BspTree, BuildError, BuildParams, TraversalCost};
use heliostat_geometry::triangle::{TriangleHit, TriangleRay, intersect};
use heliostat_geometry::{Ray, TriMesh};

/// A hit on a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshHit {
    /// Index of the triangle.
    pub triangle: u32,
    /// Distance and place in the triangle.
    pub hit: TriangleHit,
}

impl MeshHit {
    /// Whether this is the one to keep: nearer, or as near on a triangle of lower index.
    #[inline]
    pub(crate) fn beats(&self, best: Option<&Self>) -> bool {
        best.is_none_or(|best| {
            self.hit.t < best.hit.t || (self.hit.t == best.hit.t && self.triangle < best.triangle)
        })
    }
}

/// A [`BspTree`] over the triangles of a mesh.
///
/// ```
/// use glam::Vec3;
/// use heliostat_geometry::{Ray, TriMesh};
/// use heliostat_index::{BuildParams, MeshTree};
///
/// let mesh = TriMesh {
///     positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.0, 1.0, 0.0)],
///     triangles: vec![[0, 1, 2], [2, 1, 3]],
///     ..TriMesh::default()
/// };
/// let tree = MeshTree::build(&mesh, &BuildParams::SAH)?;
/// let ray = Ray::new(Vec3::new(0.75, 0.75, 2.0), Vec3::NEG_Z);
/// let found = tree.closest_hit(&mesh, &ray).expect("the ray meets the second triangle");
/// assert_eq!((found.triangle, found.hit.t), (1, 2.0));
/// # Ok::<(), heliostat_index::BuildError>(())
/// ```
///
/// # Panics
/// Queries may panic when they are given another mesh than the tree was built over.
#[derive(Clone, Debug)]
pub struct MeshTree {
    tree: BspTree,
}

impl MeshTree {
    /// Builds a tree over all triangles.
    ///
    /// # Errors
    /// When the mesh is [not valid](TriMesh::validate), or for the reasons of [`BspTree::build`].
    pub fn build(mesh: &TriMesh, params: &BuildParams) -> Result<Self, BuildError> {
        mesh.validate().map_err(BuildError::Mesh)?;
        Ok(Self { tree: BspTree::build(mesh, params)? })
    }

    /// The tree inside.
    pub fn tree(&self) -> &BspTree {
        &self.tree
    }

    /// The nearest hit within the range of the ray; of two at the same distance the one on the lower triangle.
    pub fn closest_hit(&self, mesh: &TriMesh, ray: &Ray) -> Option<MeshHit> {
        self.closest(mesh, ray, &mut Uncounted)
    }

    /// [`MeshTree::closest_hit`] that adds its work to `cost`.
    pub fn closest_hit_counted(
        &self,
        mesh: &TriMesh,
        ray: &Ray,
        cost: &mut TraversalCost,
    ) -> Option<MeshHit> {
        self.closest(mesh, ray, cost)
    }

    #[inline]
    fn closest(&self, mesh: &TriMesh, ray: &Ray, counter: &mut impl Counter) -> Option<MeshHit> {
        let sheared = TriangleRay::new(ray);
        let mut range = ray.range;
        let mut best = None;
        self.tree.walk(ray, range.max, counter, |triangles| {
            for &triangle in triangles {
                if let Some(hit) = intersect(&sheared, range, mesh.corners(triangle)) {
                    let candidate = MeshHit { triangle, hit };
                    if candidate.beats(best.as_ref()) {
                        range.max = hit.t;
                        best = Some(candidate);
                    }
                }
            }
            range.max
        });
        best
    }

    /// Whether any triangle is hit within the range of the ray.
    pub fn any_hit(&self, mesh: &TriMesh, ray: &Ray) -> bool {
        let sheared = TriangleRay::new(ray);
        let mut found = false;
        self.tree.walk(ray, ray.range.max, &mut Uncounted, |triangles| {
            found =
                found || triangles.iter().any(|&i| intersect(&sheared, ray.range, mesh.corners(i)).is_some());
            // Nothing lies before minus infinity: that ends the walk.
            if found { f32::NEG_INFINITY } else { ray.range.max }
        });
        found
    }

    /// Visits every hit within the range of the ray, each triangle once, in no certain order.
    pub fn for_each_hit(&self, mesh: &TriMesh, ray: &Ray, mut visit: impl FnMut(MeshHit)) {
        let sheared = TriangleRay::new(ray);
        let mut visited = Visited::new();
        self.tree.walk(ray, ray.range.max, &mut Uncounted, |triangles| {
            for &triangle in triangles {
                // Only hits are remembered: they are few.
                if let Some(hit) = intersect(&sheared, ray.range, mesh.corners(triangle))
                    && visited.insert(triangle)
                {
                    visit(MeshHit { triangle, hit });
                }
            }
            ray.range.max
        });
    }
}

/// The nearest hit by testing every triangle: the truth that trees are judged by.
///
/// # Panics
/// When a triangle of the mesh names a vertex that does not exist.
pub fn brute_force(mesh: &TriMesh, ray: &Ray) -> Option<MeshHit> {
    let sheared = TriangleRay::new(ray);
    let mut range = ray.range;
    let mut best = None;
    for triangle in 0..mesh.triangles.len() as u32 {
        if let Some(hit) = intersect(&sheared, range, mesh.corners(triangle)) {
            let candidate = MeshHit { triangle, hit };
            if candidate.beats(best.as_ref()) {
                range.max = hit.t;
                best = Some(candidate);
            }
        }
    }
    best
}
