//! `[material.standard]`: physically based surfaces.
//!
//! # Scene file
//! ```toml
//! [[material]]
//! name = "lacquer"
//!
//! [material.standard]             # all optional; these are the defaults
//! base_color = 0.8                # albedo of the matte part, colour of metal, tint of refracted light
//! diffuse_roughness = 0           # of the matte part
//! metalness = 0                   # share of metal
//! edge_color = 1                  # tint of metal at about 82 degrees
//! roughness = 0.3                 # of reflection and refraction: 0 is a mirror
//! specular = 1                    # weight of the reflection of what is no metal
//! specular_color = 1              # its tint
//! ior = 1.5                       # index of refraction
//! anisotropy = 0                  # how far highlights are drawn out along the tangent
//! anisotropy_rotation = 0         # turn of the tangent in degrees, counter-clockwise
//! transmission = 0                # share of light that is refracted
//! thin_walled = false             # a sheet without an inside
//! absorption = 0                  # per metre inside: exp(-absorption * length) is left
//! dispersion = 0                  # 20 over the Abbe number
//! diffuse_transmission = 0        # share of matte light that leaves on the other side
//! diffuse_transmission_color = 1
//! subsurface = 0                  # share of matte light that walks below the surface, which must close
//! subsurface_color = 0.8          # colour of a thick body
//! subsurface_radius = [0.01, 0.005, 0.0025] # metres that light flies between two scatterings
//! subsurface_anisotropy = 0       # mean cosine of scattering, above -1 and below 1
//! coat = 0                        # share under a clear coat
//! coat_roughness = 0
//! coat_ior = 1.5
//! sheen_color = 0                 # of fibres that stand up
//! sheen_roughness = 0
//! thin_film = 0                   # share under a film that interferes
//! thin_film_ior = 1.3
//! thin_film_thickness = 400       # nanometres
//! emission = 0                    # radiance of its own
//! # conductor = "gold"            # a measured metal, in place of base_color; or its numbers:
//! # conductor = { n = [0.14, 0.37, 1.44], k = [3.98, 2.39, 1.60] }
//! ```

use super::material::{FindTexture, TextureUse, color_input, float_input};
use super::number::{Asymmetry, AtLeastOne, Fraction, NonNegative, Number, Positive};
use super::texturable::Texturable;
use super::value::{Color, Splat};
use crate::document::{Fault, Placed, Span};
use glam::Vec3;
use heliostat_scene::material::{Conductor, FloatInput, Standard, ThinFilm};
use schemars::JsonSchema;
use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserializer, Error, MapAccess, Visitor};
use serde::{Deserialize, Serialize};
use std::fmt;

/// A physically based surface: metal, plastic, glass, cloth, under coat and sheen.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct StandardTable {
    /// Albedo of the matte part, reflection of metal, tint of refracted light; 0.8 if left out.
    pub base_color: Option<Texturable<Color>>,
    /// Roughness of the matte part; 0 if left out.
    pub diffuse_roughness: Option<Texturable<Fraction>>,
    /// Share of metal; 0 if left out.
    pub metalness: Option<Texturable<Fraction>>,
    /// Tint of metal at an angle of about 82 degrees, as `OpenPBR` has it; 1 if left out.
    pub edge_color: Option<Texturable<Color>>,
    /// A measured metal by its name or its numbers, in place of `base_color` and `edge_color`: aluminium, brass, chromium, copper, gold, iron,
    /// mercury, platinum, silver or titanium.
    pub conductor: Option<Placed<Metal>>,
    /// Roughness of reflection and refraction, 0 is a mirror; 0.3 if left out.
    pub roughness: Option<Texturable<Fraction>>,
    /// Weight of the reflection of what is no metal; 1 if left out.
    pub specular: Option<Texturable<Fraction>>,
    /// Tint of that reflection at normal incidence; 1 if left out.
    pub specular_color: Option<Texturable<Color>>,
    /// Index of refraction; 1.5 if left out.
    pub ior: Option<Positive>,
    /// How far highlights are drawn out along the tangent; 0 if left out.
    pub anisotropy: Option<Texturable<Fraction>>,
    /// Turn of the tangent in degrees, counter-clockwise; 0 if left out.
    pub anisotropy_rotation: Option<Number>,
    /// Share of the light under the reflection that is refracted; 0 if left out.
    pub transmission: Option<Texturable<Fraction>>,
    /// Whether the surface is a sheet without an inside; `false` if left out.
    pub thin_walled: Option<bool>,
    /// Absorption per metre inside; 0 if left out.
    pub absorption: Option<Color>,
    /// 20 over the Abbe number: how far glass parts the colours; 0 if left out.
    pub dispersion: Option<NonNegative>,
    /// Share of the matte part whose light leaves on the other side; 0 if left out.
    pub diffuse_transmission: Option<Texturable<Fraction>>,
    /// Tint of that light; 1 if left out.
    pub diffuse_transmission_color: Option<Texturable<Color>>,
    /// Share of the matte part whose light walks below the surface, which must close; 0 if left out.
    pub subsurface: Option<Texturable<Fraction>>,
    /// The colour of a thick body; 0.8 if left out.
    pub subsurface_color: Option<Texturable<Color>>,
    /// How far light flies between two scatterings, in metres; `[0.01, 0.005, 0.0025]` if left out.
    pub subsurface_radius: Option<Splat<Positive, 3>>,
    /// Mean cosine of the angle by which light is scattered there; 0 if left out.
    pub subsurface_anisotropy: Option<Asymmetry>,
    /// Share of the surface under a clear coat; 0 if left out.
    pub coat: Option<Texturable<Fraction>>,
    /// Roughness of the coat; 0 if left out.
    pub coat_roughness: Option<Texturable<Fraction>>,
    /// Index of refraction of the coat; 1.5 if left out.
    pub coat_ior: Option<AtLeastOne>,
    /// Reflection of fibres that stand up; 0 if left out.
    pub sheen_color: Option<Texturable<Color>>,
    /// How far the fibres lean; 0 if left out.
    pub sheen_roughness: Option<Texturable<Fraction>>,
    /// Share of the surface under a film that interferes; 0 if left out.
    pub thin_film: Option<Texturable<Fraction>>,
    /// Index of refraction of the film; 1.3 if left out.
    pub thin_film_ior: Option<AtLeastOne>,
    /// Thickness of the film in nanometres; 400 if left out.
    pub thin_film_thickness: Option<Texturable<NonNegative>>,
    /// Radiance of its own; 0 if left out.
    pub emission: Option<Texturable<Color>>,
}

/// A measured metal.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Metal {
    /// By its name.
    Name(String),
    /// By its numbers.
    Numbers(ConductorTable),
}

impl<'de> Deserialize<'de> for Metal {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(MetalVisitor)
    }
}

struct MetalVisitor;

impl<'de> Visitor<'de> for MetalVisitor {
    type Value = Metal;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the name of a metal or { n = ..., k = ... }")
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<Metal, E> {
        Ok(Metal::Name(name.to_owned()))
    }

    fn visit_map<A: MapAccess<'de>>(self, entries: A) -> Result<Metal, A::Error> {
        ConductorTable::deserialize(MapAccessDeserializer::new(entries)).map(Metal::Numbers)
    }
}

impl Metal {
    /// The metal of the scene; `place` is where it is named.
    fn build(&self, place: Option<Span>) -> Result<Conductor, Fault> {
        match self {
            Self::Name(name) => Conductor::named(name).ok_or_else(|| {
                Fault::unknown("metal", name, Conductor::names().collect::<Vec<_>>()).or_at(place)
            }),
            Self::Numbers(numbers) => Ok(Conductor {
                n: Vec3::from_array(numbers.n.values().map(Positive::f32)),
                k: numbers.k.rgb(),
            }),
        }
    }
}

/// The complex index of refraction of a metal at red, green and blue.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ConductorTable {
    /// Index of refraction.
    pub n: Splat<Positive, 3>,
    /// Extinction.
    pub k: Color,
}

impl StandardTable {
    /// The surface of the scene.
    pub(super) fn build(&self, textures: &mut impl FindTexture) -> Result<Standard, Fault> {
        let normal = Standard::default();
        let mut share = |value: &Option<Texturable<Fraction>>, absent: FloatInput| {
            float_input(value.as_ref(), Fraction::f32, absent, TextureUse::Data, textures)
        };
        let mut standard = Standard {
            diffuse_roughness: share(&self.diffuse_roughness, normal.diffuse_roughness)?,
            metalness: share(&self.metalness, normal.metalness)?,
            roughness: share(&self.roughness, normal.roughness)?,
            specular: share(&self.specular, normal.specular)?,
            anisotropy: share(&self.anisotropy, normal.anisotropy)?,
            transmission: share(&self.transmission, normal.transmission)?,
            diffuse_transmission: share(&self.diffuse_transmission, normal.diffuse_transmission)?,
            subsurface: share(&self.subsurface, normal.subsurface)?,
            coat: share(&self.coat, normal.coat)?,
            coat_roughness: share(&self.coat_roughness, normal.coat_roughness)?,
            sheen_roughness: share(&self.sheen_roughness, normal.sheen_roughness)?,
            thin_film: ThinFilm {
                weight: share(&self.thin_film, normal.thin_film.weight)?,
                ..normal.thin_film
            },
            ..normal
        };
        self.fill_colors(&mut standard, textures)?;
        self.fill_constants(&mut standard);
        let metal = |metal: &Placed<Metal>| metal.build(metal.span());
        standard.conductor = self.conductor.as_ref().map(metal).transpose()?;
        let thickness = &mut standard.thin_film.thickness;
        let given = self.thin_film_thickness.as_ref();
        *thickness = float_input(given, NonNegative::f32, *thickness, TextureUse::Data, textures)?;
        Ok(standard)
    }

    fn fill_colors(&self, standard: &mut Standard, textures: &mut impl FindTexture) -> Result<(), Fault> {
        let colors = [
            (&mut standard.base_color, &self.base_color),
            (&mut standard.edge_color, &self.edge_color),
            (&mut standard.specular_color, &self.specular_color),
            (&mut standard.diffuse_transmission_color, &self.diffuse_transmission_color),
            (&mut standard.subsurface_color, &self.subsurface_color),
            (&mut standard.sheen_color, &self.sheen_color),
            (&mut standard.emission, &self.emission),
        ];
        for (input, value) in colors {
            *input = color_input(value.as_ref(), *input, textures)?;
        }
        Ok(())
    }

    /// What no texture varies.
    fn fill_constants(&self, standard: &mut Standard) {
        standard.ior = self.ior.map_or(standard.ior, Positive::f32);
        let turn = self.anisotropy_rotation.map(|turn| turn.get().to_radians() as f32);
        standard.anisotropy_rotation = turn.unwrap_or(standard.anisotropy_rotation);
        standard.thin_walled = self.thin_walled.unwrap_or(standard.thin_walled);
        standard.absorption = self.absorption.map_or(standard.absorption, |c| c.rgb());
        let radius = self.subsurface_radius.map(|r| Vec3::from_array(r.values().map(Positive::f32)));
        standard.subsurface_radius = radius.unwrap_or(standard.subsurface_radius);
        let asymmetry = self.subsurface_anisotropy.map(Asymmetry::f32);
        standard.subsurface_anisotropy = asymmetry.unwrap_or(standard.subsurface_anisotropy);
        standard.dispersion = self.dispersion.map_or(standard.dispersion, NonNegative::f32);
        standard.coat_ior = self.coat_ior.map_or(standard.coat_ior, AtLeastOne::f32);
        let film_ior = &mut standard.thin_film.ior;
        *film_ior = self.thin_film_ior.map_or(*film_ior, AtLeastOne::f32);
    }
}
