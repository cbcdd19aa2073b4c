//! Agreement of several indices over one mesh, ray by ray, judged by brute force.
//!
//! Ray number `i` of a seed is always the same ray of a mesh, so that ranges of numbers can be traced on any number of
//! threads. A disagreement holds its ray, to be traced again alone: [`Verifier::replay`].

mod random;

use crate::bsp::{BuildError, BuildParams};
use crate::mesh_tree::{MeshHit, MeshTree, brute_force};
#[cfg(feature = "reference")]
use crate::reference::ReferenceBvh;
use glam::Vec3;
#[cfg(feature = "reference")]
use heliostat_geometry::triangle::{TriangleRay, intersect};
use heliostat_geometry::{Aabb, Ray, TriMesh};
use random::Random;
use std::ops::Range;

/// Kinds of rays; see [`Verifier::ray`].
const KINDS: u64 = 5;

/// A ray on which an index does not say what brute force says.
#[derive(Clone, Debug, PartialEq)]
pub struct Disagreement {
    /// Number of the ray; see [`Verifier::ray`].
    pub number: u64,
    /// The ray.
    pub ray: Ray,
    /// Name of the index.
    pub index: String,
    /// What brute force found.
    pub expected: Option<MeshHit>,
    /// What the index found.
    pub got: Option<MeshHit>,
    /// What its any-hit query said.
    pub got_any: bool,
}

/// What came of a comparison.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Agreement {
    /// Rays traced through every index.
    pub rays: u64,
    /// Rays that hit the mesh.
    pub hits: u64,
    /// Rays that brute force judged; about the others all indices said the same.
    pub judged: u64,
    /// How often an index differs: in whether there is a hit, in the triangle, in any bit of the distance, or when its
    /// any-hit query contradicts.
    pub differing: u64,
    /// The first of these, [`Agreement::KEPT`] at most.
    pub disagreements: Vec<Disagreement>,
}

impl Agreement {
    /// How many disagreements are kept; more are counted, so that an index that is always wrong fills no memory.
    pub const KEPT: usize = 4096;

    /// Adds what came of the rays that follow.
    pub fn merge(&mut self, next: Self) {
        self.rays += next.rays;
        self.hits += next.hits;
        self.judged += next.judged;
        self.differing += next.differing;
        let free = Self::KEPT.saturating_sub(self.disagreements.len());
        self.disagreements.extend(next.disagreements.into_iter().take(free));
    }
}

/// One mesh under several indices.
#[derive(Debug)]
pub struct Verifier<'m> {
    mesh: &'m TriMesh,
    bounds: Aabb,
    trees: Vec<(String, MeshTree)>,
    judge_every: u64,
    #[cfg(feature = "reference")]
    witness: ReferenceBvh,
}

/// What an index says of a ray: the nearest hit, and whether there is any.
type Answer = (Option<MeshHit>, bool);

impl<'m> Verifier<'m> {
    /// Builds a tree for each named setting, and with feature `reference` the BVH of `obvhs`, under that name.
    ///
    /// # Errors
    /// Those of [`MeshTree::build`].
    pub fn new(mesh: &'m TriMesh, settings: &[(&str, BuildParams)]) -> Result<Self, BuildError> {
        mesh.validate().map_err(BuildError::Mesh)?;
        let trees = settings
            .iter()
            .map(|(name, params)| Ok(((*name).to_owned(), MeshTree::build(mesh, params)?)))
            .collect::<Result<_, BuildError>>()?;
        Ok(Self {
            mesh,
            bounds: mesh.bounds(),
            trees,
            judge_every: 1,
            #[cfg(feature = "reference")]
            witness: ReferenceBvh::build(mesh)?,
        })
    }

    /// The trees, with their names.
    pub fn trees(&self) -> &[(String, MeshTree)] {
        &self.trees
    }

    /// Lets brute force judge only one ray in so many, of every kind alike, and every ray about which the indices differ: on
    /// large meshes it would take days to judge all.
    ///
    /// # Panics
    /// When `rays` is 0.
    #[must_use]
    pub fn judging_every(self, rays: u64) -> Self {
        assert!(rays > 0, "one ray in none cannot be judged");
        Self { judge_every: rays, ..self }
    }

    /// Traces the rays of these numbers through all indices.
    pub fn run(&self, numbers: Range<u64>, seed: u64) -> Agreement {
        let mut agreement = Agreement::default();
        for number in numbers {
            let ray = self.ray(number, seed);
            let answers = self.answers(&ray);
            agreement.rays += 1;
            if let Some(hit) = unanimous(&answers)
                && !(number / KINDS).is_multiple_of(self.judge_every)
            {
                agreement.hits += u64::from(hit);
                continue;
            }
            agreement.merge(self.judge(number, ray, answers));
        }
        agreement
    }

    /// Traces one ray through all indices and brute force; `number` is what disagreements will call it.
    ///
    /// Unlike the rays of [`Verifier::run`] it may be any ray, such as one that an earlier build got wrong.
    pub fn replay(&self, number: u64, ray: Ray) -> Agreement {
        let answers = self.answers(&ray);
        Agreement { rays: 1, ..self.judge(number, ray, answers) }
    }

    /// Holds the answers of all indices against brute force; the ray is counted by the caller.
    fn judge(&self, number: u64, ray: Ray, answers: Vec<(&str, Answer)>) -> Agreement {
        let expected = brute_force(self.mesh, &ray);
        let differs =
            |&(_, (got, got_any)): &(&str, Answer)| got != expected || got_any != expected.is_some();
        let disagreements: Vec<_> = answers
            .into_iter()
            .filter(differs)
            .map(|(index, (got, got_any))| {
                let index = index.to_owned();
                Disagreement { number, ray, index, expected, got, got_any }
            })
            .collect();
        let differing = disagreements.len() as u64;
        Agreement { rays: 0, hits: u64::from(expected.is_some()), judged: 1, differing, disagreements }
    }

    /// What each index says of a ray.
    fn answers(&self, ray: &Ray) -> Vec<(&str, Answer)> {
        let trees =
            self.trees.iter().map(|(name, tree)| (name.as_str(), (tree.closest_hit(ray), tree.any_hit(ray))));
        #[cfg(feature = "reference")]
        let trees = trees.chain([("obvhs", (self.closest_by_witness(ray), self.any_by_witness(ray)))]);
        trees.collect()
    }

    #[cfg(feature = "reference")]
    fn closest_by_witness(&self, ray: &Ray) -> Option<MeshHit> {
        use crate::query::RayIndex;
        let sheared = TriangleRay::new(ray);
        let found = self.witness.closest_hit(ray, |i, ray| {
            intersect(&sheared, ray.range, self.mesh.corners(i)).map(|hit| (hit.t, hit))
        })?;
        Some(MeshHit { triangle: found.primitive, hit: found.data })
    }

    #[cfg(feature = "reference")]
    fn any_by_witness(&self, ray: &Ray) -> bool {
        use crate::query::RayIndex;
        let sheared = TriangleRay::new(ray);
        self.witness.any_hit(ray, |i, ray| intersect(&sheared, ray.range, self.mesh.corners(i)).is_some())
    }

    /// The ray of that number: in turn one through the bounds from outside, one along an axis, one at a vertex,
    /// one at a point of an edge, and one from inside the bounds.
    pub fn ray(&self, number: u64, seed: u64) -> Ray {
        let mut random = Random::new(number, seed);
        if self.mesh.triangles.is_empty() {
            return Ray::new(random.direction(), random.direction());
        }
        let outside = self.bounds.centre() + 2.0 * self.bounds.radius() * random.direction();
        let inside = random.point(self.bounds);
        let [a, b, _] = self.mesh.corners(random.below(self.mesh.triangles.len()) as u32);
        let ray = match number % KINDS {
            0 => Ray::new(outside, inside - outside),
            1 => self.parallel_ray(a, inside, &mut random),
            2 => Ray::new(outside, a - outside),
            3 => Ray::new(outside, a.lerp(b, random.unit()) - outside),
            _ => Ray::new(inside, random.direction()),
        };
        // A mesh of one point may lie where the ray starts.
        if ray.is_valid() { ray } else { Ray::new(outside, random.direction()) }
    }

    /// A ray along an axis, through the bounds; one in two runs through a vertex, where planes like to lie.
    fn parallel_ray(&self, vertex: Vec3, inside: Vec3, random: &mut Random) -> Ray {
        let axis = random.below(3);
        let sign = if random.below(2) == 0 { 1.0 } else { -1.0 };
        let mut dir = Vec3::ZERO;
        dir[axis] = sign;
        let mut origin = if random.below(2) == 0 { vertex } else { inside };
        origin[axis] = self.bounds.centre()[axis] - sign * 2.0 * self.bounds.radius();
        Ray::new(origin, dir)
    }
}

/// Whether there is a hit, where at least two indices say the same and do not contradict themselves.
fn unanimous(answers: &[(&str, Answer)]) -> Option<bool> {
    let (_, first) = answers.first()?;
    let agree = answers.len() > 1 && answers.iter().all(|(_, answer)| answer == first);
    (agree && first.0.is_some() == first.1).then_some(first.1)
}

#[cfg(test)]
mod tests;
