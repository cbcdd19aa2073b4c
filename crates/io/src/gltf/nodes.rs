//! The hierarchy of nodes: who stands on whom, what belongs to the scene, and where everything is at a time.

use super::animation::{Moved, Tracks};
use super::document::Document;
use super::extensions::extension;
use super::flaw::Flaw;
use super::mesh::affine;
use glam::{DAffine3, DQuat, DVec3};
use gltf::json::Node;
use serde::Deserialize;

/// The order of the nodes and what is shown of them; checked to be a forest.
#[derive(Debug)]
pub(super) struct Nodes {
    parents: Vec<Option<usize>>,
    /// Parents before their children.
    order: Vec<usize>,
    /// The nodes of the scene that are visible, in the order of the hierarchy.
    pub(super) shown: Vec<usize>,
}

#[derive(Deserialize)]
struct Visibility {
    #[serde(default = "yes")]
    visible: bool,
}

fn yes() -> bool {
    true
}

impl Nodes {
    /// Finds the hierarchy of a file, and the nodes of its default scene: of all scenes where it has none.
    ///
    /// # Errors
    /// When a node has two parents, is its own ancestor, or does not exist.
    pub(super) fn of(document: &Document) -> Result<Self, Flaw> {
        let parents = parents(document)?;
        let count = parents.len();
        let mut order: Vec<usize> = (0..count).filter(|&node| parents[node].is_none()).collect();
        let mut at = 0;
        while let Some(&node) = order.get(at) {
            order.extend(children(document, node));
            at += 1;
        }
        if order.len() < count {
            let mut is_lost = vec![true; count];
            order.iter().for_each(|&node| is_lost[node] = false);
            let lost = is_lost.iter().position(|&lost| lost).unwrap_or(0);
            return Err(
                Flaw::new(format!("nodes[{lost}]"), "is its own ancestor").with_help("export the file again")
            );
        }
        let shown = shown(document, &parents)?;
        Ok(Self { parents, order, shown })
    }

    /// The places of all nodes in the world at a time in seconds.
    pub(super) fn places(&self, document: &Document, tracks: &Tracks, seconds: f64) -> Vec<DAffine3> {
        let mut places = vec![DAffine3::IDENTITY; self.parents.len()];
        for &node in &self.order {
            let below = self.parents[node].map_or(DAffine3::IDENTITY, |parent| places[parent]);
            places[node] = below * local(node, &document.root.nodes[node], tracks, seconds);
        }
        places
    }
}

fn children(document: &Document, node: usize) -> impl Iterator<Item = usize> {
    document.root.nodes[node].children.iter().flatten().map(|child| child.value())
}

fn parents(document: &Document) -> Result<Vec<Option<usize>>, Flaw> {
    let count = document.root.nodes.len();
    let mut parents = vec![None; count];
    for node in 0..count {
        for child in children(document, node) {
            let parent = parents
                .get_mut(child)
                .ok_or_else(|| Flaw::dangling(format!("nodes[{node}].children"), "nodes", child, count))?;
            if parent.replace(node).is_some() {
                let message = "has two parents";
                return Err(Flaw::new(format!("nodes[{child}]"), message).with_help("export the file again"));
            }
        }
    }
    Ok(parents)
}

/// The visible nodes of the default scene, in the order of the hierarchy.
fn shown(document: &Document, parents: &[Option<usize>]) -> Result<Vec<usize>, Flaw> {
    let (root, count) = (&document.root, parents.len());
    let scene = root.scene.map_or(0, |scene| scene.value());
    let mut waiting: Vec<usize> = match root.scenes.get(scene) {
        Some(scene) => scene.nodes.iter().map(|node| node.value()).collect(),
        None if root.scenes.is_empty() => (0..count).filter(|&node| parents[node].is_none()).collect(),
        None => return Err(Flaw::dangling("scene", "scenes", scene, root.scenes.len())),
    };
    waiting.reverse();
    let mut shown = Vec::new();
    let mut is_seen = vec![false; count];
    while let Some(node) = waiting.pop() {
        let place = format!("scenes[{scene}].nodes");
        let seen = is_seen.get_mut(node).ok_or_else(|| Flaw::dangling(place, "nodes", node, count))?;
        // A scene may list a node that stands on another one of it.
        if std::mem::replace(seen, true) {
            continue;
        }
        let others = root.nodes[node].extensions.as_ref().map(|extensions| &extensions.others);
        let visibility = extension::<Visibility>(others, "KHR_node_visibility", &format!("nodes[{node}]"))?;
        if visibility.is_none_or(|visibility| visibility.visible) {
            shown.push(node);
            let first = waiting.len();
            waiting.extend(children(document, node));
            waiting[first..].reverse();
        }
    }
    Ok(shown)
}

/// The map from the space of a node to that of its parent.
fn local(index: usize, node: &Node, tracks: &Tracks, seconds: f64) -> DAffine3 {
    let moved = |moved| tracks.at(index, moved, seconds);
    let vector = |values: Option<Vec<f32>>, json: Option<[f32; 3]>, usual: DVec3| {
        let still = json.map_or(usual, |v| DVec3::from(v.map(f64::from)));
        values.map_or(still, |v| DVec3::new(v[0].into(), v[1].into(), v[2].into()))
    };
    let [translation, rotation, scale] = [Moved::Translation, Moved::Rotation, Moved::Scale].map(moved);
    let is_still = translation.is_none() && rotation.is_none() && scale.is_none();
    if let Some(matrix) = node.matrix.filter(|_| is_still) {
        return affine(matrix);
    }
    let turn = rotation.or_else(|| node.rotation.map(|turn| turn.0.to_vec()));
    let turn = turn
        .map_or(DQuat::IDENTITY, |v| DQuat::from_xyzw(v[0].into(), v[1].into(), v[2].into(), v[3].into()));
    let turn = turn.normalize();
    DAffine3::from_scale_rotation_translation(
        vector(scale, node.scale, DVec3::ONE),
        if turn.is_finite() { turn } else { DQuat::IDENTITY },
        vector(translation, node.translation, DVec3::ZERO),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nodes(json: &str) -> Result<(Document, Nodes), Flaw> {
        let text = format!(r#"{{"asset": {{"version": "2.0"}}, {json}}}"#);
        let document = Document::new("a.gltf".as_ref(), text.into_bytes())?;
        let nodes = Nodes::of(&document)?;
        Ok((document, nodes))
    }

    #[test]
    fn places_add_up_along_the_hierarchy() {
        let (document, nodes) = nodes(
            r#""nodes": [{"translation": [0, 0, 5]}, {"children": [0], "scale": [2, 2, -2]},
                {"children": [1], "matrix": [0,1,0,0, -1,0,0,0, 0,0,1,0, 7,0,0,1]}]"#,
        )
        .unwrap();
        let places = nodes.places(&document, &Tracks::default(), 0.0);
        assert_eq!(places[0].translation, DVec3::new(7.0, 0.0, -10.0));
        assert_eq!(places[0].transform_vector3(DVec3::X), DVec3::new(0.0, 2.0, 0.0));
        assert_eq!(nodes.shown, [2, 1, 0]);
    }

    #[test]
    fn the_default_scene_is_shown_without_what_is_invisible() {
        let json = r#""scene": 1, "scenes": [{"nodes": [0]}, {"nodes": [1, 3]}], "nodes": [{}, {"children": [2]}, {},
            {"children": [4], "extensions": {"KHR_node_visibility": {"visible": false}}}, {}]"#;
        assert_eq!(nodes(json).unwrap().1.shown, [1, 2]);
    }

    #[test]
    fn what_is_no_forest_is_refused() {
        for json in [
            r#""nodes": [{"children": [0]}]"#,
            r#""nodes": [{}, {"children": [2]}, {"children": [1]}]"#,
            r#""nodes": [{"children": [2]}, {"children": [2]}, {}]"#,
            r#""nodes": [{"children": [1]}]"#,
            r#""nodes": [{}], "scenes": [{"nodes": [1]}]"#,
            r#""nodes": [{}], "scene": 1, "scenes": [{"nodes": [0]}]"#,
        ] {
            assert!(nodes(json).is_err(), "{json}");
        }
    }

    #[test]
    fn a_chain_of_a_hundred_thousand_nodes_takes_no_stack() {
        let chain: Vec<_> = (1..100_000).map(|i| format!(r#"{{"children": [{i}]}}"#)).collect();
        let (document, nodes) = nodes(&format!(r#""nodes": [{}, {{}}]"#, chain.join(","))).unwrap();
        assert_eq!(nodes.places(&document, &Tracks::default(), 0.0).len(), 100_000);
    }
}
