//! Refuses scenes whose parts refer to parts that are not there, before anything is indexed.

use super::WorldError;
use heliostat_scene::image::Samples;
use heliostat_scene::light::LightKind;
use heliostat_scene::material::{ColorInput, FloatInput, Material, Relief, Surface};
use heliostat_scene::object::Geometry;
use heliostat_scene::scene::Background;
use heliostat_scene::texture::Pattern;
use heliostat_scene::{Image, Scene, TextureId};

/// Checks every id and the size of every image of a scene.
pub(super) fn check(scene: &Scene) -> Result<(), WorldError> {
    for texture in &scene.textures {
        if let Pattern::Image { image, .. } = &texture.pattern {
            check_image(image, || format!("texture `{}`", texture.name))?;
        }
    }
    if let Background::Image { image, .. } = &scene.background {
        check_image(image, || "the background".to_owned())?;
    }
    for material in &scene.materials {
        for id in textures_of(material) {
            let user = || format!("material `{}`", material.name);
            in_range(id.0, scene.textures.len(), "texture", user)?;
        }
    }
    for object in &scene.objects {
        let user = || format!("object `{}`", object.name);
        check_geometry(scene, &object.geometry, user)?;
        if object.materials.is_empty() {
            return Err(WorldError::NoMaterial { object: object.name.clone() });
        }
        for id in &object.materials {
            in_range(id.0, scene.materials.len(), "material", user)?;
        }
    }
    for light in &scene.lights {
        if let LightKind::Area { geometry, .. } = &light.kind {
            check_geometry(scene, geometry, || format!("light `{}`", light.name))?;
        }
    }
    Ok(())
}

fn check_geometry(scene: &Scene, geometry: &Geometry, user: impl Fn() -> String) -> Result<(), WorldError> {
    match geometry {
        Geometry::Shape(_) => Ok(()),
        Geometry::Mesh(id) => in_range(id.0, scene.meshes.len(), "mesh", user),
    }
}

fn in_range(
    index: u32,
    count: usize,
    what: &'static str,
    user: impl Fn() -> String,
) -> Result<(), WorldError> {
    if (index as usize) < count {
        return Ok(());
    }
    Err(WorldError::Dangling { user: user(), what, index, count })
}

fn check_image(image: &Image, user: impl Fn() -> String) -> Result<(), WorldError> {
    let samples = match &image.samples {
        Samples::U8(v) => v.len(),
        Samples::U16(v) => v.len(),
        Samples::F32(v) => v.len(),
    };
    let expected = [image.width, image.height, u32::from(image.channels)];
    let expected = expected.iter().try_fold(1_usize, |product, &n| product.checked_mul(n as usize));
    if expected == Some(samples) && samples > 0 {
        return Ok(());
    }
    Err(WorldError::Image { user: user(), width: image.width, height: image.height })
}

/// Every texture that a material looks at.
fn textures_of(material: &Material) -> impl Iterator<Item = TextureId> {
    let Surface::Phong(p) = &material.surface;
    let colors: [&ColorInput; 6] =
        [&p.ambient, &p.diffuse, &p.specular, &p.emission, &p.mirror, &p.transparency];
    let floats: [&FloatInput; 2] = [&p.shininess, &material.opacity];
    let relief = material.relief.map(|relief| match relief {
        Relief::Bump { texture, .. } | Relief::Normal { texture, .. } => texture,
    });
    colors.map(|c| c.texture).into_iter().chain(floats.map(|f| f.texture)).chain([relief]).flatten()
}
