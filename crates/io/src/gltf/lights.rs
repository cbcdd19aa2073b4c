//! `KHR_lights_punctual`.
//!
//! # Units
//! glTF gives candela and lux, our lights watts per steradian and watts per square metre. A candela is taken for a watt per
//! steradian and a lux for a watt per square metre: light keeps its numbers, as emission does. The picture is that of
//! every common viewer; whoever wants watts divides by 683 lm/W, which is one `--exposure` for all lights at once. What is
//! far brighter or darker than a picture can hold is exposed for as a whole, see [`crate::model`].
//!
//! `range` is left out: it cuts light off where physics does not.

use super::document::Document;
use super::extensions::extension;
use super::flaw::Flaw;
use glam::{DAffine3, DVec3, Vec3};
use heliostat_scene::light::{Falloff, LightKind};
use heliostat_scene::{Light, Rgb};
use serde::Deserialize;
use std::f32::consts::{FRAC_PI_2, FRAC_PI_4};

const NAME: &str = "KHR_lights_punctual";

/// The lights of a file.
#[derive(Deserialize)]
struct All {
    lights: Vec<Punctual>,
}

/// The light of a node.
#[derive(Deserialize)]
struct Of {
    light: usize,
}

#[derive(Clone, Debug, Deserialize)]
struct Punctual {
    #[serde(default)]
    name: String,
    #[serde(default = "white")]
    color: [f32; 3],
    #[serde(default = "one")]
    intensity: f32,
    #[serde(rename = "type")]
    kind: Kind,
    #[serde(default)]
    spot: Spot,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Kind {
    Directional,
    Point,
    Spot,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "camelCase", default)]
struct Spot {
    inner_cone_angle: f32,
    outer_cone_angle: f32,
}

impl Default for Spot {
    fn default() -> Self {
        Self { inner_cone_angle: 0.0, outer_cone_angle: FRAC_PI_4 }
    }
}

fn white() -> [f32; 3] {
    [1.0; 3]
}

/// A number of JSON may be too large for 32 bits.
fn finite(v: f32) -> f32 {
    v.clamp(f32::MIN, f32::MAX)
}

fn one() -> f32 {
    1.0
}

/// Lights by the nodes that carry them.
#[derive(Debug, Default)]
pub(super) struct Lights {
    all: Vec<Punctual>,
    /// For each node.
    of_nodes: Vec<Option<usize>>,
}

impl Lights {
    /// Reads the lights of a file.
    ///
    /// # Errors
    /// When they do not have their form, or a node names one that is not there.
    pub(super) fn of(document: &Document) -> Result<Self, Flaw> {
        let root = &document.root;
        let others = root.extensions.as_ref().map(|extensions| &extensions.others);
        let all = extension::<All>(others, NAME, "")?.map_or(Vec::new(), |all| all.lights);
        let of_node = |(i, node): (usize, &gltf::json::Node)| {
            let place = format!("nodes[{i}]");
            let others = node.extensions.as_ref().map(|extensions| &extensions.others);
            let light = extension::<Of>(others, NAME, &place)?.map(|of| of.light);
            match light {
                Some(light) if light >= all.len() => Err(Flaw::dangling(place, "lights", light, all.len())),
                light => Ok(light),
            }
        };
        let of_nodes = root.nodes.iter().enumerate().map(of_node).collect::<Result<_, _>>()?;
        Ok(Self { all, of_nodes })
    }

    /// The names of the lights.
    pub(super) fn names(&self) -> Vec<String> {
        let named = |(i, light): (usize, &Punctual)| {
            if light.name.is_empty() { format!("light {i}") } else { light.name.clone() }
        };
        self.all.iter().enumerate().map(named).collect()
    }

    /// The light of a node that stands at `place`, under its own name.
    pub(super) fn at(&self, node: usize, place: &DAffine3) -> Option<Light> {
        let index = (*self.of_nodes.get(node)?)?;
        let light = self.all.get(index)?;
        let position = place.translation.as_vec3();
        let direction = place.transform_vector3(DVec3::NEG_Z).try_normalize()?.as_vec3();
        let name = if light.name.is_empty() { format!("light {index}") } else { light.name.clone() };
        let intensity =
            Rgb::from(light.color.map(|v| (finite(v) * finite(light.intensity)).clamp(0.0, f32::MAX)));
        position.is_finite().then(|| Light {
            name,
            intensity,
            samples: 1,
            kind: light.kind_at(position, direction),
        })
    }
}

impl Punctual {
    fn kind_at(&self, position: Vec3, direction: Vec3) -> LightKind {
        let falloff = Falloff::InverseSquare;
        match self.kind {
            Kind::Directional => LightKind::Directional { direction, angle: 0.0 },
            Kind::Point => LightKind::Point { position, falloff },
            Kind::Spot => {
                let outer = self.spot.outer_cone_angle.clamp(0.0, FRAC_PI_2);
                let inner = self.spot.inner_cone_angle.clamp(0.0, outer);
                LightKind::Spot { position, direction, inner, outer, falloff }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;

    #[test]
    fn candela_and_lux_keep_their_numbers_and_lights_shine_along_minus_z() {
        let json = r#"{"asset": {"version": "2.0"}, "extensions": {"KHR_lights_punctual": {"lights": [
            {"type": "point", "intensity": 40, "color": [1, 0.5, 0]},
            {"type": "spot", "name": "spot", "spot": {"innerConeAngle": 0.2}}]}},
            "nodes": [{"extensions": {"KHR_lights_punctual": {"light": 0}}},
                      {"extensions": {"KHR_lights_punctual": {"light": 1}}}, {}]}"#;
        let document = Document::new("a.gltf".as_ref(), json.into()).unwrap();
        let lights = Lights::of(&document).unwrap();
        let turn = DQuat::from_rotation_x(-std::f64::consts::FRAC_PI_2);
        let place = DAffine3::from_scale_rotation_translation(DVec3::splat(3.0), turn, DVec3::X);
        let point = lights.at(0, &place).unwrap();
        assert_eq!((point.intensity, point.name.as_str()), (Rgb::new(40.0, 20.0, 0.0), "light 0"));
        let Some(Light { kind: LightKind::Spot { position, direction, inner, outer, .. }, .. }) =
            lights.at(1, &place)
        else {
            panic!("no spot")
        };
        assert_eq!((position, inner, outer), (Vec3::X, 0.2, FRAC_PI_4));
        assert!(direction.distance(Vec3::NEG_Y) < 1e-6);
        assert!(lights.at(2, &place).is_none());
    }
}
