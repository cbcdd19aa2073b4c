//! Which of many lights a point asks.

use super::cluster::Cluster;
use super::sums;
use super::tree::LightTree;
use glam::Vec3;

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

/// All lights: a tree of the near ones beside the list of the far ones.
#[derive(Debug)]
pub(crate) struct LightSampler {
    tree: Option<LightTree>,
    /// Index of the light for each leaf of the tree, and for each of the far ones.
    near: Vec<usize>,
    far: Vec<usize>,
    /// Running sums of the probabilities among the far ones, and about what they throw together.
    sums: Vec<f64>,
    far_irradiance: f32,
    /// Place of each light in its list.
    places: Vec<Place>,
}

#[derive(Clone, Copy, Debug)]
enum Place {
    Near(usize),
    Far(usize),
}

impl LightSampler {
    pub(super) fn new(lights: impl IntoIterator<Item = Reach>) -> Self {
        let (mut clusters, mut irradiances) = (Vec::new(), Vec::new());
        let (mut near, mut far, mut places) = (Vec::new(), Vec::new(), Vec::new());
        for (i, light) in lights.into_iter().enumerate() {
            match light {
                Reach::Near(cluster) => {
                    places.push(Place::Near(near.len()));
                    near.push(i);
                    clusters.push(cluster);
                }
                Reach::Far(irradiance) => {
                    places.push(Place::Far(far.len()));
                    far.push(i);
                    irradiances.push(irradiance);
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

    /// A light for the point `p` of a surface with normal `n`, and its probability; `None` where none is worth asking.
    #[inline]
    pub(super) fn pick(&self, p: Vec3, n: Vec3, u: f32) -> Option<(usize, f32)> {
        let (tree, share) = self.near_share(p, n);
        if let Some(tree) = tree.filter(|_| u < share) {
            let (leaf, probability) = tree.pick(p, n, u / share)?;
            return Some((self.near[leaf], share * probability));
        }
        if self.far.is_empty() {
            return None;
        }
        let (i, _) = sums::pick(&self.sums, (u - share) / (1.0 - share));
        Some((self.far[i], (1.0 - share) * self.far_probability(i)))
    }

    /// The probability with which [`Self::pick`] chooses the light.
    #[inline]
    pub(super) fn probability(&self, p: Vec3, n: Vec3, light: usize) -> f32 {
        let (tree, share) = self.near_share(p, n);
        match (self.places[light], tree) {
            (Place::Near(leaf), Some(tree)) if share > 0.0 => share * tree.probability(p, n, leaf),
            (Place::Near(_), _) => 0.0,
            (Place::Far(i), _) => (1.0 - share) * self.far_probability(i),
        }
    }

    /// The tree, and the probability with which it is asked.
    #[inline]
    fn near_share(&self, p: Vec3, n: Vec3) -> (Option<&LightTree>, f32) {
        let Some(tree) = &self.tree else { return (None, 0.0) };
        if self.far.is_empty() {
            return (Some(tree), 1.0);
        }
        let near = tree.importance(p, n);
        let share = near / (near + self.far_irradiance);
        let share = if near > 0.0 { 0.5 * EVEN + (1.0 - EVEN) * share.min(1.0) } else { 0.0 };
        (Some(tree), share)
    }

    fn far_probability(&self, i: usize) -> f32 {
        sums::share(&self.sums, i) as f32
    }
}
