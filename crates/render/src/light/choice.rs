//! Which of many lights a point asks.

use super::Lookout;
use super::cluster::Cluster;
use super::sums;
use super::tree::LightTree;
use heliostat_geometry::Aabb;
use heliostat_scene::settings::LightChoice;
use std::f32::consts::PI;

/// Share of the choices between near and far lights, and among the far ones, that are made without regard to what arrives: no
/// light is forgotten because it was thought weak.
const EVEN: f32 = 0.25;

/// What a choice has to know of a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Reach {
    /// It stands somewhere, and weakens with the distance.
    Near(Cluster),
    /// It throws about this irradiance everywhere.
    Far(f32),
}

/// A piece of a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Piece {
    pub(super) light: usize,
    /// Among those of the light.
    pub(super) piece: usize,
}

/// All lights: a tree of the near ones beside the list of the far ones.
#[derive(Debug)]
pub(crate) struct LightSampler {
    tree: Option<LightTree>,
    /// The piece for each leaf of the tree, and for each of the far ones.
    near: Vec<Piece>,
    far: Vec<Piece>,
    /// Running sums of the probabilities among the far ones, and about what they throw together.
    sums: Vec<f64>,
    far_irradiance: f32,
    /// Place of the first piece of each light in its list; the others follow.
    places: Vec<Place>,
}

#[derive(Clone, Copy, Debug)]
enum Place {
    Near(usize),
    Far(usize),
}

impl LightSampler {
    /// A choice among lights by the pieces of each; all pieces of a light are near, or there is one.
    pub(super) fn new(lights: &[Vec<Reach>], choice: LightChoice) -> Self {
        let radius = extent(lights);
        let (mut clusters, mut irradiances) = (Vec::new(), Vec::new());
        let (mut near, mut far, mut places) = (Vec::new(), Vec::new(), Vec::new());
        for (light, pieces) in lights.iter().enumerate() {
            let reach = |reach: &Reach| match choice {
                LightChoice::Tree => *reach,
                LightChoice::Power => Reach::Far(reach.power(radius)),
                LightChoice::Uniform => Reach::Far(1.0),
            };
            let is_near = matches!(pieces.first().map(reach), Some(Reach::Near(_)));
            places.push(if is_near { Place::Near(near.len()) } else { Place::Far(far.len()) });
            for (piece, reach) in pieces.iter().map(reach).enumerate() {
                match reach {
                    Reach::Near(cluster) => {
                        near.push(Piece { light, piece });
                        clusters.push(cluster);
                    }
                    Reach::Far(irradiance) => {
                        far.push(Piece { light, piece });
                        irradiances.push(irradiance);
                    }
                }
            }
        }
        let far_irradiance: f32 = irradiances.iter().sum();
        let even = 1.0 / irradiances.len() as f32;
        let share = |irradiance: f32| match irradiance / far_irradiance {
            share if share.is_finite() => EVEN * even + (1.0 - EVEN) * share,
            _ => even,
        };
        let sums = sums::running(irradiances.into_iter().map(|e| f64::from(share(e)))).collect();
        Self { tree: LightTree::new(&clusters), near, far, sums, far_irradiance, places }
    }

    /// A light for a point, and its probability; `None` where none is worth asking.
    #[inline]
    pub(super) fn pick(&self, from: &Lookout, u: f32) -> Option<(Piece, f32)> {
        let (tree, share) = self.near_share(from);
        if let Some(tree) = tree.filter(|_| u < share) {
            let (leaf, probability) = tree.pick(from, u / share)?;
            return Some((self.near[leaf], share * probability));
        }
        if self.far.is_empty() {
            return None;
        }
        let (i, _) = sums::pick(&self.sums, (u - share) / (1.0 - share));
        Some((self.far[i], (1.0 - share) * self.far_probability(i)))
    }

    /// The probability with which [`Self::pick`] chooses the piece.
    #[inline]
    pub(super) fn probability(&self, from: &Lookout, piece: Piece) -> f32 {
        let (tree, share) = self.near_share(from);
        match (self.places[piece.light], tree) {
            (Place::Near(first), Some(tree)) if share > 0.0 => {
                share * tree.probability(from, first + piece.piece)
            }
            (Place::Near(_), _) => 0.0,
            (Place::Far(first), _) => (1.0 - share) * self.far_probability(first + piece.piece),
        }
    }

    /// The tree, and the probability with which it is asked.
    #[inline]
    fn near_share(&self, from: &Lookout) -> (Option<&LightTree>, f32) {
        let Some(tree) = &self.tree else { return (None, 0.0) };
        if self.far.is_empty() {
            return (Some(tree), 1.0);
        }
        let near = tree.importance(from);
        let share = near / (near + self.far_irradiance);
        let share = if near > 0.0 { 0.5 * EVEN + (1.0 - EVEN) * share.min(1.0) } else { 0.0 };
        (Some(tree), share)
    }

    fn far_probability(&self, i: usize) -> f32 {
        sums::share(&self.sums, i) as f32
    }
}

impl Reach {
    /// About what it sends into a ball of that radius, in W.
    fn power(&self, radius: f32) -> f32 {
        match self {
            Self::Near(cluster) => cluster.power(),
            Self::Far(irradiance) => PI * radius * radius * irradiance,
        }
    }
}

/// Radius of the ball around all near lights; 1 where they do not span any.
fn extent(lights: &[Vec<Reach>]) -> f32 {
    let bounds = |reach: &Reach| match reach {
        Reach::Near(cluster) => cluster.bounds,
        Reach::Far(_) => Aabb::EMPTY,
    };
    let all = lights.iter().flatten().map(bounds).fold(Aabb::EMPTY, Aabb::union);
    let radius = if all.is_empty() { 0.0 } else { all.radius() };
    if radius > 0.0 { radius } else { 1.0 }
}
