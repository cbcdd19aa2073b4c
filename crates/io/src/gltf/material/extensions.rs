//! The extensions of materials as they are written: <https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Khronos>.

use crate::gltf::textures::TextureInfo;
use serde::Deserialize;

/// Declares the parameters of an extension: a number or colour with its default, or a texture.
macro_rules! parameters {
    ($(#[$doc:meta])* $name:ident { $($field:ident: $kind:ty = $default:expr,)* }) => {
        $(#[$doc])*
        #[derive(Clone, Debug, Deserialize)]
        #[serde(rename_all = "camelCase", default)]
        pub(super) struct $name {
            $(pub(super) $field: $kind,)*
        }

        impl Default for $name {
            fn default() -> Self {
                Self { $($field: $default,)* }
            }
        }
    };
}

parameters!(
    /// `KHR_materials_anisotropy`
    Anisotropy {
        anisotropy_strength: f32 = 0.0,
        anisotropy_rotation: f32 = 0.0,
        anisotropy_texture: Option<TextureInfo> = None,
    }
);
parameters!(
    /// `KHR_materials_clearcoat`
    Clearcoat {
        clearcoat_factor: f32 = 0.0,
        clearcoat_texture: Option<TextureInfo> = None,
        clearcoat_roughness_factor: f32 = 0.0,
        clearcoat_roughness_texture: Option<TextureInfo> = None,
        clearcoat_normal_texture: Option<TextureInfo> = None,
    }
);
parameters!(
    /// `KHR_materials_diffuse_transmission`
    DiffuseTransmission {
        diffuse_transmission_factor: f32 = 0.0,
        diffuse_transmission_texture: Option<TextureInfo> = None,
        diffuse_transmission_color_factor: [f32; 3] = [1.0; 3],
        diffuse_transmission_color_texture: Option<TextureInfo> = None,
    }
);
parameters!(
    /// `KHR_materials_dispersion`
    Dispersion {
        dispersion: f32 = 0.0,
    }
);
parameters!(
    /// `KHR_materials_emissive_strength`
    EmissiveStrength {
        emissive_strength: f32 = 1.0,
    }
);
parameters!(
    /// `KHR_materials_ior`
    Ior {
        ior: f32 = 1.5,
    }
);
parameters!(
    /// `KHR_materials_iridescence`
    Iridescence {
        iridescence_factor: f32 = 0.0,
        iridescence_texture: Option<TextureInfo> = None,
        iridescence_ior: f32 = 1.3,
        iridescence_thickness_minimum: f32 = 100.0,
        iridescence_thickness_maximum: f32 = 400.0,
        iridescence_thickness_texture: Option<TextureInfo> = None,
    }
);
parameters!(
    /// `KHR_materials_sheen`
    Sheen {
        sheen_color_factor: [f32; 3] = [0.0; 3],
        sheen_color_texture: Option<TextureInfo> = None,
        sheen_roughness_factor: f32 = 0.0,
        sheen_roughness_texture: Option<TextureInfo> = None,
    }
);
parameters!(
    /// `KHR_materials_specular`
    Specular {
        specular_factor: f32 = 1.0,
        specular_texture: Option<TextureInfo> = None,
        specular_color_factor: [f32; 3] = [1.0; 3],
        specular_color_texture: Option<TextureInfo> = None,
    }
);
parameters!(
    /// `KHR_materials_transmission`
    Transmission {
        transmission_factor: f32 = 0.0,
        transmission_texture: Option<TextureInfo> = None,
    }
);
parameters!(
    /// `KHR_materials_volume`; its thickness texture serves renderers that do not trace rays.
    Volume {
        thickness_factor: f32 = 0.0,
        attenuation_distance: f32 = f32::INFINITY,
        attenuation_color: [f32; 3] = [1.0; 3],
    }
);
parameters!(
    /// `KHR_materials_pbrSpecularGlossiness`
    SpecularGlossiness {
        diffuse_factor: [f32; 4] = [1.0; 4],
        diffuse_texture: Option<TextureInfo> = None,
        specular_factor: [f32; 3] = [1.0; 3],
        glossiness_factor: f32 = 1.0,
        specular_glossiness_texture: Option<TextureInfo> = None,
    }
);
