//! `[[light]]`: what lights the scene.
//!
//! Light has radiometric units: W/sr, W/m² and W/(m² sr), the same in every channel for white. Photometric data keeps its
//! numbers: a candela of a glTF light or an IES file counts as 1 W/sr, a lux as 1 W/m². The sky is in watts of white light, of
//! which 1 W is 179 lm; beside lamps in candela and lux give it `intensity = 179`. `exposure` of `[output]`, and `--exposure`,
//! brighten a PNG by stops: rooms in lux want about -7, daylight in watts -6, in lux -14.
//!
//! # Scene file
//! ```toml
//! [[light]]
//! name = "key"                   # `light`, `light2`, ... if left out
//! intensity = 10                 # a number or a colour; its unit depends on the kind
//! color = [1, 0.9, 0.8]          # multiplies the intensity
//! samples = 16                   # shadow rays per point, for area lights and wide directional ones; 1 if left out
//! # exactly one of:
//! ambient = {}                                                   # the same from everywhere, without shadow
//! point = { position = [0, 4, 0], falloff = "inverse_square" }   # W/sr; falloff "none": the same at any distance
//! # as a lamp was measured, in IES LM-63: candela count as W/sr, times the intensity
//! # point = { position = [0, 3, 0], ies = "wall.ies", direction = [0, -1, 0], turn = 90 }
//! directional = { direction = [0, -1, 0], angle = 0.53 }         # W/m²; degrees across the source, 0 if left out
//! # half angles in degrees; direction = [0, -1, 0] can take the place of look_at
//! spot = { position = [0, 4, 0], look_at = "ball", inner = 24, outer = 30, falloff = "inverse_square" }
//! # W/(m² sr); see the module `area`
//! area = { rectangle = { size = [1, 1] }, translate = [0, 4, 0], look_at = [0, 0, 0] }
//! ```

use super::area::AreaTable;
use super::choice::{choice, exactly_one, without_effect};
use super::number::{Count, HalfTurn, Number};
use super::targets::{Targets, unit};
use super::value::{Color, Point, Target, vector};
use crate::document::{Fault, Placed, Span};
use crate::error::quote;
use glam::{DQuat, DVec3};
use heliostat_scene::Profile;
use heliostat_scene::light::{Falloff, LightKind};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Half angle of a spot in degrees.
const OUTER: f64 = 30.0;
/// Share of the half angle within which a spot is full.
const INNER_SHARE: f64 = 0.8;

/// A source of light.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct LightTable {
    /// Name, unique among lights; `light`, `light2`, ... if left out.
    pub name: Option<Placed<String>>,
    /// A number or a colour, in the unit of the kind; 1 if left out.
    pub intensity: Option<Color>,
    /// Multiplies the intensity; 1 if left out.
    pub color: Option<Color>,
    /// Shadow rays per point, for area lights and wide directional ones; 1 if left out.
    pub samples: Option<Count>,
    /// The same light from everywhere, without shadow.
    pub ambient: Option<Placed<AmbientTable>>,
    /// From a point in all directions, in W/sr.
    pub point: Option<Placed<PointTable>>,
    /// From infinitely far, in W/m² on a surface that faces it.
    pub directional: Option<Placed<DirectionalTable>>,
    /// From a point into a cone, in W/sr on its axis.
    pub spot: Option<Placed<SpotTable>>,
    /// From every point of a surface, in W/(m² sr).
    pub area: Option<Placed<AreaTable>>,
}

/// The same light from everywhere.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AmbientTable {}

/// From a point in all directions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PointTable {
    /// Position in metres.
    pub position: Point,
    /// How the light weakens on its way; `inverse_square` if left out.
    pub falloff: Option<FalloffName>,
    /// Path of a photometric file of IES LM-63, relative to the scene file: how much light goes where. Its candela count as W/sr
    /// and are multiplied by the intensity.
    pub ies: Option<Placed<String>>,
    /// Where the lamp of the file points, its vertical angle 0; down if left out.
    pub direction: Option<Placed<Point>>,
    /// Turn of that lamp about its direction in degrees, clockwise as it looks; 0, its horizontal angle 0 towards +x, if left
    /// out.
    pub turn: Option<Placed<Number>>,
    /// Whether its brightest direction counts as 1, so that the intensity is in W/sr there; `false` if left out.
    pub normalize: Option<Placed<bool>>,
}

/// From infinitely far.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DirectionalTable {
    /// The direction in which the light travels; any length but 0.
    pub direction: Placed<Point>,
    /// Degrees across the source: 0.53 for the sun, 0, a hard shadow, if left out.
    pub angle: Option<HalfTurn>,
}

/// From a point into a cone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpotTable {
    /// Position in metres.
    pub position: Point,
    /// The point or object that the axis goes through.
    pub look_at: Option<Placed<Target>>,
    /// The direction of the axis; any length but 0.
    pub direction: Option<Placed<Point>>,
    /// Half angle in degrees up to which the light is full; 0.8 of `outer` if left out.
    pub inner: Option<Placed<HalfTurn>>,
    /// Half angle in degrees from which there is none; 30 if left out.
    pub outer: Option<HalfTurn>,
    /// How the light weakens on its way; `inverse_square` if left out.
    pub falloff: Option<FalloffName>,
}

/// How light weakens on its way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FalloffName {
    /// By the square of the distance.
    InverseSquare,
    /// Not at all.
    None,
}

/// The scene's falloff of an optional name.
pub(super) fn falloff(name: Option<FalloffName>) -> Falloff {
    match name {
        None | Some(FalloffName::InverseSquare) => Falloff::InverseSquare,
        Some(FalloffName::None) => Falloff::None,
    }
}

impl LightTable {
    /// Refuses a light of no kind, or of several.
    pub(super) fn check(&self, name: &str, table: Option<Span>) -> Result<(), Fault> {
        let kinds = [
            choice("ambient", self.ambient.as_ref()),
            choice("point", self.point.as_ref()),
            choice("directional", self.directional.as_ref()),
            choice("spot", self.spot.as_ref()),
            choice("area", self.area.as_ref()),
        ];
        exactly_one(&format!("the light {}", quote(name)), "kind", table, &kinds)
    }

    /// Colour times intensity.
    pub(super) fn radiance(&self) -> heliostat_scene::Rgb {
        self.intensity.unwrap_or(Color::ONE).rgb() * self.color.unwrap_or(Color::ONE).rgb()
    }

    /// The file that says how much goes where.
    pub(super) fn ies(&self) -> Option<(&PointTable, &Placed<String>)> {
        let point: &PointTable = self.point.as_ref()?;
        Some((point, point.ies.as_ref()?))
    }

    /// The kind of every light but an area light and a measured one.
    pub(super) fn simple_kind(&self, targets: &Targets<'_>) -> Result<Option<LightKind>, Fault> {
        if self.ambient.is_some() {
            return Ok(Some(LightKind::Ambient));
        }
        if let Some(point) = self.point.as_ref().filter(|point| point.ies.is_none()) {
            let measured = [
                choice("direction", point.direction.as_ref()),
                choice("turn", point.turn.as_ref()),
                choice("normalize", point.normalize.as_ref()),
            ];
            without_effect("without `ies`", &measured)?;
            let position = vector(&point.position).as_vec3();
            return Ok(Some(LightKind::Point { position, falloff: falloff(point.falloff) }));
        }
        if let Some(sun) = &self.directional {
            let angle = sun.angle.map_or(0.0, |a| a.get().to_radians() as f32);
            return Ok(Some(LightKind::Directional { direction: unit(&sun.direction)?.as_vec3(), angle }));
        }
        self.spot.as_ref().map(|spot| spot.build(targets)).transpose()
    }
}

impl PointTable {
    /// The lamp of a profile.
    pub(super) fn measured(&self, profile: Arc<Profile>) -> Result<LightKind, Fault> {
        let axis = self.direction.as_ref().map_or(Ok(DVec3::NEG_Y), unit)?;
        // The zero of the horizontal angle is as near to +x as it can be; for a lamp that looks along x, to +y.
        let level = if axis.cross(DVec3::X).length() > 0.5 { DVec3::X } else { DVec3::Y };
        let zero = (level - level.dot(axis) * axis).normalize();
        let turn = self.turn.as_ref().map_or(0.0, |turn| turn.get().to_radians());
        Ok(LightKind::Measured {
            position: vector(&self.position).as_vec3(),
            axis: axis.as_vec3(),
            across: (DQuat::from_axis_angle(axis, turn) * zero).as_vec3(),
            profile,
            falloff: falloff(self.falloff),
        })
    }

    /// The factor by which the intensity is multiplied.
    pub(super) fn scale(&self, profile: &Profile) -> f32 {
        let is_relative = self.normalize.as_ref().is_some_and(|normalize| **normalize);
        if is_relative && profile.peak() > 0.0 { 1.0 / profile.peak() } else { 1.0 }
    }
}

impl Placed<SpotTable> {
    fn build(&self, targets: &Targets<'_>) -> Result<LightKind, Fault> {
        let outer = self.outer.map_or(OUTER, HalfTurn::get);
        let inner = self.inner.as_ref().map_or(INNER_SHARE * outer, |inner| inner.get());
        if inner > outer {
            return Err(Fault::new("`inner` must not be larger than `outer`")
                .with_help(format!("choose at most {outer} degrees"))
                .or_at(self.inner.as_ref().and_then(Placed::span)));
        }
        Ok(LightKind::Spot {
            position: vector(&self.position).as_vec3(),
            direction: self.axis(targets)?.as_vec3(),
            inner: inner.to_radians() as f32,
            outer: outer.to_radians() as f32,
            falloff: falloff(self.falloff),
        })
    }

    fn axis(&self, targets: &Targets<'_>) -> Result<DVec3, Fault> {
        let aims = [choice("look_at", self.look_at.as_ref()), choice("direction", self.direction.as_ref())];
        exactly_one("the spot", "aim", self.span(), &aims)?;
        match (&self.look_at, &self.direction) {
            (Some(target), _) => targets.direction(vector(&self.position), target),
            (None, Some(direction)) => unit(direction),
            (None, None) => Err(Fault::new("the spot has no aim").or_at(self.span())),
        }
    }
}
