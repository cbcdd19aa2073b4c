//! Cameras of a file.
//!
//! A picture of another shape than the camera's shows all that the camera frames, and more to the sides or above and below.

use super::document::Document;
use super::flaw::Flaw;
use super::motion::Stage;
use crate::obj::unique;
use glam::{DAffine3, DMat3};
use gltf::json::camera::{self, Orthographic, Perspective};
use gltf::json::validation::Checked;
use heliostat_geometry::Aabb;
use heliostat_scene::camera::Projection;
use heliostat_scene::{Camera, Motion};
use std::collections::HashSet;
use std::f32::consts::PI;

/// The camera of a node, if it has one, for pictures of the shape `aspect`.
///
/// # Errors
/// When the camera does not exist or has impossible numbers.
pub(super) fn of_node(
    document: &Document,
    node: usize,
    stage: &Stage,
    aspect: f32,
) -> Result<Option<Camera>, Flaw> {
    let Some(index) = document.root.nodes[node].camera else { return Ok(None) };
    let (index, cameras) = (index.value(), &document.root.cameras);
    let json = cameras
        .get(index)
        .ok_or_else(|| Flaw::dangling(format!("nodes[{node}].camera"), "cameras", index, cameras.len()))?;
    let place = format!("cameras[{index}]");
    let projection = match (json.type_, &json.perspective, &json.orthographic) {
        (Checked::Valid(camera::Type::Perspective), Some(lens), _) => perspective(lens, aspect, &place)?,
        (Checked::Valid(camera::Type::Orthographic), _, Some(lens)) => orthographic(lens, aspect, &place)?,
        _ => return Err(Flaw::new(place, "has no projection of its type").with_help("export the file again")),
    };
    // A camera is judged by what stands a metre around it.
    let poses = stage.poses(node, Aabb::EMPTY, unscaled);
    let motion = Motion::through(poses).unwrap_or(Motion::still(DAffine3::IDENTITY));
    Ok(Some(Camera { name: name(document, node, index), motion, projection, focus: None }))
}

/// The names of the cameras of some nodes, as scenes give them.
pub(super) fn names(document: &Document, nodes: &[usize]) -> Vec<String> {
    let mut taken = HashSet::new();
    let camera = |&node: &usize| Some((node, document.root.nodes[node].camera?.value()));
    let known = nodes.iter().filter_map(camera).filter(|(_, camera)| *camera < document.root.cameras.len());
    known.map(|(node, camera)| unique(name(document, node, camera), &mut taken)).collect()
}

fn name(document: &Document, node: usize, camera: usize) -> String {
    let node = document.root.nodes[node].name.as_ref();
    let named = document.root.cameras[camera].name.as_ref().or(node).filter(|name| !name.is_empty());
    named.map_or_else(|| format!("camera {camera}"), String::clone)
}

fn perspective(lens: &Perspective, aspect: f32, place: &str) -> Result<Projection, Flaw> {
    if !(lens.yfov > 0.0 && lens.yfov < PI) {
        let message = format!("yfov is {}, must be between 0 and pi", lens.yfov);
        return Err(Flaw::new(place, message).with_help("export the file again"));
    }
    let own = lens.aspect_ratio.filter(|own| own.is_finite() && *own > 0.0).unwrap_or(aspect);
    let fov_y = 2.0 * ((0.5 * lens.yfov).tan() * (own / aspect).max(1.0)).atan();
    // A lens as wide as the picture needs; written to the last digit, the file's own stays as it is.
    Ok(Projection::Perspective { fov_y: if own > aspect { fov_y } else { lens.yfov } })
}

fn orthographic(lens: &Orthographic, aspect: f32, place: &str) -> Result<Projection, Flaw> {
    let height = 2.0 * lens.ymag.abs().max(lens.xmag.abs() / aspect);
    if height > 0.0 && height.is_finite() {
        return Ok(Projection::Orthographic { height });
    }
    Err(Flaw::new(place, "has neither width nor height").with_help("export the file again"))
}

/// The place of a camera at a node, which takes no part in the scale of the node.
fn unscaled(place: &DAffine3) -> DAffine3 {
    let back = place.matrix3.z_axis.normalize_or(glam::DVec3::Z);
    let right = place.matrix3.y_axis.cross(back).try_normalize();
    let right = right.unwrap_or_else(|| back.any_orthonormal_vector());
    DAffine3 { matrix3: DMat3::from_cols(right, back.cross(right), back), translation: place.translation }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DQuat, DVec3};

    #[test]
    fn scale_and_mirrors_of_nodes_leave_cameras_upright() {
        let turn = DQuat::from_rotation_y(0.4);
        for scale in [DVec3::splat(7.0), DVec3::new(-1.0, 1.0, 1.0), DVec3::new(1.0, 2.0, 3.0)] {
            let place = DAffine3::from_scale_rotation_translation(scale, turn, DVec3::X);
            let pose = unscaled(&place);
            assert!((pose.matrix3.determinant() - 1.0).abs() < 1e-12);
            assert!(pose.matrix3.z_axis.distance(turn * DVec3::Z) < 1e-12);
            assert!(pose.matrix3.y_axis.distance(DVec3::Y) < 1e-12);
        }
    }

    #[test]
    fn pictures_show_all_that_a_camera_frames() {
        let lens = |own| {
            let json = format!(r#"{{"yfov": 1.0, "znear": 0.1, "aspectRatio": {own}}}"#);
            let lens: Perspective = gltf::json::deserialize::from_str(&json).unwrap();
            let Projection::Perspective { fov_y } = perspective(&lens, 1.0, "").unwrap() else { panic!() };
            fov_y
        };
        assert_eq!(lens(0.5), 1.0);
        assert!((lens(2.0) - 2.0 * (2.0 * 0.5_f32.tan()).atan()).abs() < 1e-6);
    }
}
