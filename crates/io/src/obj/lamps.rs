//! Which side of a lamp shines: its front, as everywhere else, unless it is a body that was turned inside out.
//!
//! A sheet under a ceiling that shone to both sides would light a strip of it from a centimetre away.

use super::ObjObject;
use glam::{DVec3, Vec3};
use heliostat_scene::Material;
use heliostat_scene::material::Back;

/// A body is inside out whose volume is below 0 by more than one so many parts of the cube of its diameter.
const NEARLY_FLAT: f64 = 1000.0;

/// Darkens the backs of what shines.
pub(super) fn darken_backs(objects: &[ObjObject], materials: &mut [Material]) {
    for (i, material) in materials.iter_mut().enumerate() {
        let shines = !material.surface.emission().is_zero();
        if shines && !objects.iter().any(|object| is_inside_out(object, i)) {
            material.back = Back::Dark;
        }
    }
}

/// Whether the faces of a material enclose a volume below 0: they look inward.
fn is_inside_out(object: &ObjObject, material: usize) -> bool {
    let Some(slot) = object.materials.iter().position(|&used| used == material) else { return false };
    let mesh = &object.mesh;
    // Without slots all faces have the first.
    let slot_of = |face: usize| mesh.slots.get(face).map_or(0, |&own| usize::from(own));
    let faces = (0..mesh.triangles.len()).filter(|&face| slot_of(face) == slot);
    let corners: Vec<[Vec3; 3]> = faces.map(|face| mesh.corners(face as u32)).collect();
    let points = corners.iter().flatten();
    let low = points.clone().fold(Vec3::INFINITY, |low, &p| low.min(p)).as_dvec3();
    let high = points.fold(Vec3::NEG_INFINITY, |high, &p| high.max(p)).as_dvec3();
    // From the middle, so that a flat sheet has no volume at all.
    let middle = 0.5 * (low + high);
    let volume: f64 = corners
        .iter()
        .map(|corners| corners.map(|p| p.as_dvec3() - middle))
        .map(|[a, b, c]: [DVec3; 3]| a.dot(b.cross(c)) / 6.0)
        .sum();
    NEARLY_FLAT * volume < -(high - low).length().powi(3)
}
