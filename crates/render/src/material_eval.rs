//! Materials at a point: the textured description becomes a few numbers.

mod standard;

use crate::texture_eval::{self, TexturePoint, uv_step};
use glam::{Vec2, Vec3, Vec4};
use heliostat_geometry::Hit;
use heliostat_scene::color::luminance;
use heliostat_scene::material::{Channel, ColorInput, FloatInput, FresnelMode, Material, Phong, Relief};
use heliostat_scene::{Rgb, Texture, TextureId};

/// Phong's surface at one point; see [`Phong`] for the meaning of the fields.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PhongPoint {
    pub(crate) ambient: Rgb,
    pub(crate) diffuse: Rgb,
    pub(crate) specular: Rgb,
    pub(crate) shininess: f32,
    pub(crate) emission: Rgb,
    pub(crate) mirror: Rgb,
    pub(crate) transparency: Rgb,
    pub(crate) ior: f32,
    pub(crate) absorption: Rgb,
    pub(crate) fresnel: FresnelMode,
}

impl PhongPoint {
    /// The share of the light that the surface sends on, highlights left out.
    pub(crate) fn albedo(&self) -> Rgb {
        (self.diffuse + self.mirror + self.transparency).clamp(Rgb::ZERO, Rgb::ONE)
    }
}

/// Looks at textures at one point of a surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MaterialEval<'s> {
    /// All textures of the scene.
    pub(crate) textures: &'s [Texture],
    /// Where.
    pub(crate) at: TexturePoint,
}

impl MaterialEval<'_> {
    /// Phong's numbers; a vertex colour multiplies the ambient and the diffuse one.
    pub(crate) fn phong(&self, phong: &Phong, vertex_color: Option<Rgb>) -> PhongPoint {
        let tint = vertex_color.unwrap_or(Rgb::ONE);
        // Most textured surfaces have one texture for both.
        let diffuse = self.pattern(phong.diffuse.texture);
        let is_shared = phong.ambient.texture == phong.diffuse.texture;
        let ambient = if is_shared { diffuse } else { self.pattern(phong.ambient.texture) };
        PhongPoint {
            ambient: tint * phong.ambient.factor * ambient,
            diffuse: tint * phong.diffuse.factor * diffuse,
            specular: self.color(&phong.specular),
            shininess: self.float(&phong.shininess).max(0.0),
            emission: self.color(&phong.emission),
            mirror: self.color(&phong.mirror),
            transparency: self.color(&phong.transparency),
            ior: phong.ior,
            absorption: phong.absorption,
            fresnel: phong.fresnel,
        }
    }

    /// A colour.
    pub(crate) fn color(&self, input: &ColorInput) -> Rgb {
        input.factor * self.pattern(input.texture)
    }

    /// What a colour is multiplied by.
    fn pattern(&self, texture: Option<TextureId>) -> Rgb {
        texture.map_or(Rgb::ONE, |id| self.texture(id).truncate())
    }

    /// A number.
    fn float(&self, input: &FloatInput) -> f32 {
        match input.texture {
            None => input.factor,
            Some(id) => input.factor * channel(self.texture(id), input.channel),
        }
    }

    /// Coverage in `[0, 1]`.
    pub(crate) fn opacity(&self, material: &Material) -> f32 {
        let FloatInput { factor, texture, channel: of } = material.opacity;
        // A mean of coverage says nothing about a threshold: cut-outs are looked at in points.
        let at = if material.cutoff.is_some() { self.at.sharp() } else { self.at };
        let coverage = |id: TextureId| match of {
            Channel::Luminance => texture_eval::coverage(&self.textures[id.index()], &at),
            _ => channel(texture_eval::eval(&self.textures[id.index()], &at), of),
        };
        let opacity = (factor * texture.map_or(1.0, coverage) * self.at.coverage).clamp(0.0, 1.0);
        match material.cutoff {
            None => opacity,
            Some(cutoff) => f32::from(u8::from(opacity >= cutoff)),
        }
    }

    /// The shading normal `ns`, bent by a relief; unit, on the side of `ns`.
    pub(crate) fn bent_normal(&self, relief: Option<Relief>, hit: &Hit, ns: Vec3) -> Vec3 {
        let bent = match relief {
            None => return ns,
            Some(Relief::Bump { texture, strength }) => self.bump(texture, strength, hit, ns),
            Some(Relief::Normal { texture, strength }) => self.normal_map(texture, strength, hit, ns),
        };
        match bent.and_then(Vec3::try_normalize) {
            Some(bent) if bent.dot(ns) > 0.0 => bent,
            _ => ns,
        }
    }

    /// The normal of the surface displaced by a height, from the gradient of the height on the surface.
    ///
    /// # Source
    /// Mikkelsen, "Bump Mapping Unparametrized Surfaces on the GPU", 2010, equations 2 to 4; Blinn, 1978.
    fn bump(&self, texture: TextureId, strength: f32, hit: &Hit, ns: Vec3) -> Option<Vec3> {
        let step = uv_step(&self.textures[texture.index()])?;
        let height = |du: f32, dv: f32| {
            let at = self.at.moved(Vec2::new(du, dv));
            luminance(texture_eval::eval(&self.textures[texture.index()], &at).truncate())
        };
        // Central differences over a texel to both sides.
        let dh_du = strength * (height(step.x, 0.0) - height(-step.x, 0.0)) / (2.0 * step.x);
        let dh_dv = strength * (height(0.0, step.y) - height(0.0, -step.y)) / (2.0 * step.y);
        let (along_u, along_v) = (hit.dpdv.cross(ns), ns.cross(hit.dpdu));
        let area = hit.dpdu.dot(along_u);
        (area != 0.0).then(|| ns - (dh_du * along_u + dh_dv * along_v) / area)
    }

    /// The normal that a tangent-space map gives: red along `u`, green along `v`, blue outward.
    fn normal_map(&self, texture: TextureId, strength: f32, hit: &Hit, ns: Vec3) -> Option<Vec3> {
        let encoded = self.texture(texture).truncate();
        let slope = strength * (2.0 * encoded.truncate() - Vec2::ONE);
        let up = 2.0 * encoded.z - 1.0;
        let tangent = (hit.dpdu - hit.dpdu.dot(ns) * ns).try_normalize()?;
        let right_angled = ns.cross(tangent);
        // Mirrored texture coordinates turn the second tangent around.
        let bitangent = if right_angled.dot(hit.dpdv) < 0.0 { -right_angled } else { right_angled };
        Some(slope.x * tangent + slope.y * bitangent + up * ns)
    }

    fn texture(&self, id: TextureId) -> Vec4 {
        texture_eval::eval(&self.textures[id.index()], &self.at)
    }
}

/// One number of a texture's value.
fn channel(value: Vec4, channel: Channel) -> f32 {
    match channel {
        Channel::Luminance => luminance(value.truncate()),
        Channel::R => value.x,
        Channel::G => value.y,
        Channel::B => value.z,
        Channel::A => value.w,
    }
}
