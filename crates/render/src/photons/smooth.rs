//! Which objects may reflect or refract light as a mirror or clear glass does, anywhere on their surface.
//!
//! In doubt they may: photons are sent to all of them, and to nothing else.

use heliostat_geometry::error_bound::LEAST_WIDTH;
use heliostat_scene::material::{FloatInput, Surface};
use heliostat_scene::object::Geometry;
use heliostat_scene::{Material, Object, Scene};

/// The indices of such objects.
pub(super) fn objects(scene: &Scene) -> impl Iterator<Item = u32> {
    let materials: Vec<bool> = scene.materials.iter().map(is_smooth).collect();
    let mut groups = vec![None; scene.groups.len()];
    let object = |object: &Object| is_smooth_object(scene, &materials, &mut groups, object);
    let smooth: Vec<bool> = scene.objects.iter().map(object).collect();
    (0..).zip(smooth).filter(|(_, smooth)| *smooth).map(|(i, _)| i)
}

/// Groups know each other; what is known of one is kept.
fn is_smooth_object(scene: &Scene, materials: &[bool], groups: &mut [Option<bool>], object: &Object) -> bool {
    let Geometry::Group(id) = object.geometry else {
        return object.materials.iter().any(|id| materials[id.index()]);
    };
    if let Some(known) = groups[id.index()] {
        return known;
    }
    let objects = &scene.groups[id.index()].objects;
    let smooth = objects.iter().any(|object| is_smooth_object(scene, materials, groups, object));
    groups[id.index()] = Some(smooth);
    smooth
}

fn is_smooth(material: &Material) -> bool {
    match &material.surface {
        Surface::Unlit(_) => false,
        Surface::Phong(phong) => !phong.mirror.is_zero() || !phong.transparency.is_zero(),
        Surface::Standard(standard) => {
            let coat = standard.coat.factor > 0.0 && may_be_flat(&standard.coat_roughness);
            // Glass of about the index of its surroundings bends light as if it were smooth.
            coat || standard.transmission.factor > 0.0 || may_be_flat(&standard.roughness)
        }
    }
}

/// Whether a roughness may be that of a mirror.
fn may_be_flat(roughness: &FloatInput) -> bool {
    roughness.texture.is_some() || roughness.factor * roughness.factor <= LEAST_WIDTH
}
