//! `[[medium]]`: what light flies through, is absorbed and scattered in.
//!
//! A medium fills what a material names it as its `interior` of, or the whole scene as `medium` of `[environment]`. Scenes with
//! media are rendered by the integrator `volpath` if none is named; others do not see them.
//!
//! # Scene file
//! ```toml
//! [[medium]]
//! name = "mist"
//! scattering = 0.2               # per metre: so much light is scattered; 0 if left out
//! absorption = 0.01              # per metre: so much is lost; 0 if left out. Or, in place of it:
//! # color = [0.9, 0.5, 0.1]      # the colour of white light that is left of absorption after
//! # distance = 0.3               # so many metres
//! anisotropy = 0                 # mean cosine of scattering, above -1 and below 1: 0 is even, above 0 goes on forward
//!
//! [[medium]]
//! name = "smoke"
//! albedo = 0.9                   # in place of scattering and absorption: the share that each scattering keeps, and
//! mean_free_path = 0.1           # how far light flies to the next one, in metres, where the density is 1
//!
//! [medium.grid]                  # optional: how dense it is where
//! file = "smoke.vol"             # Mitsuba's volume file, version 3; its box stands in world space,
//! scale = 1                      # scaled, turned and shifted so
//! translate = [0, 1, 0]          # scale, rotate, translate or matrix, as for an object
//! made_by = "cargo xtask assets" # optional: the command that makes the file, shown when it is missing
//! ```

use super::choice::{choice, without_effect};
use super::number::{Asymmetry, Fraction, NonZero, Positive};
use super::placement::{Matrix, impl_placement_keys};
use super::value::{Color, Point, Splat};
use crate::document::{Fault, Placed, Span};
use crate::volume_file::Volume;
use glam::{DAffine3, DMat3, Vec3};
use heliostat_geometry::Transform;
use heliostat_scene::medium::DensityGrid;
use heliostat_scene::{Medium, Rgb};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// What light flies through, is absorbed and scattered in.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MediumTable {
    /// Name, unique among media.
    pub name: Placed<String>,
    /// Light that is scattered, per metre; 0 if left out.
    pub scattering: Option<Placed<Color>>,
    /// Light that is lost, per metre; 0 if left out.
    pub absorption: Option<Placed<Color>>,
    /// In place of `absorption`: what absorption leaves of white light after `distance`.
    pub color: Option<Placed<Splat<Fraction, 3>>>,
    /// The way to `color`, in metres.
    pub distance: Option<Placed<Positive>>,
    /// In place of `scattering` and `absorption`: the share that each scattering keeps.
    pub albedo: Option<Placed<Splat<Fraction, 3>>>,
    /// How far light flies to the next scattering, in metres.
    pub mean_free_path: Option<Placed<Splat<Positive, 3>>>,
    /// Mean cosine of the angle by which light is scattered; 0 if left out.
    pub anisotropy: Option<Asymmetry>,
    /// How dense it is where; 1 everywhere if left out.
    pub grid: Option<Placed<GridTable>>,
}

/// Density on a grid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GridTable {
    /// Path of a volume file of Mitsuba's format, version 3, relative to the scene file.
    pub file: Placed<String>,
    /// The command that makes the file, shown when it is missing.
    pub made_by: Option<String>,
    /// Scale, a number or `[x, y, z]`.
    pub scale: Option<Placed<Splat<NonZero, 3>>>,
    /// Turn in degrees about x, then y, then z.
    pub rotate: Option<Placed<Point>>,
    /// Shift in metres.
    pub translate: Option<Placed<Point>>,
    /// Three rows of four numbers in place of scale, rotate and translate.
    pub matrix: Option<Placed<Matrix>>,
}

impl_placement_keys!(GridTable);

impl MediumTable {
    /// The medium of the scene, of the same density everywhere; `table` is where it stands.
    pub(super) fn build(&self, table: Option<Span>) -> Result<Medium, Fault> {
        let g = self.anisotropy.map_or(0.0, Asymmetry::f32);
        let (absorption, scattering) = match &self.albedo {
            Some(albedo) => self.by_albedo(albedo)?,
            None => (self.absorption()?, self.scattering.as_deref().unwrap_or(&Color::ZERO).rgb()),
        };
        if absorption + scattering == Rgb::ZERO {
            return Err(Fault::new("the medium neither scatters nor absorbs light")
                .with_help("add `scattering`, `absorption`, or `albedo` with `mean_free_path`")
                .or_at(self.name.span().or(table)));
        }
        Ok(Medium::homogeneous(self.name.as_str(), absorption, scattering, g))
    }

    /// Absorption and scattering by the share that each scattering keeps.
    fn by_albedo(&self, albedo: &Placed<Splat<Fraction, 3>>) -> Result<(Rgb, Rgb), Fault> {
        let others = [
            choice("scattering", self.scattering.as_ref()),
            choice("absorption", self.absorption.as_ref()),
            choice("color", self.color.as_ref()),
            choice("distance", self.distance.as_ref()),
        ];
        without_effect("beside `albedo`", &others)?;
        let Some(way) = &self.mean_free_path else {
            return Err(Fault::new("`albedo` needs the way between two scatterings")
                .with_help("add `mean_free_path`")
                .or_at(albedo.span()));
        };
        let albedo = Vec3::from_array(albedo.values().map(Fraction::f32));
        let extinction = Vec3::from_array(way.values().map(Positive::f32)).recip();
        Ok(((Rgb::ONE - albedo) * extinction, albedo * extinction))
    }

    fn absorption(&self) -> Result<Rgb, Fault> {
        without_effect("without `albedo`", &[choice("mean_free_path", self.mean_free_path.as_ref())])?;
        let Some(color) = &self.color else {
            without_effect("without `color`", &[choice("distance", self.distance.as_ref())])?;
            return Ok(self.absorption.as_deref().unwrap_or(&Color::ZERO).rgb());
        };
        without_effect("beside `color`", &[choice("absorption", self.absorption.as_ref())])?;
        let Some(distance) = &self.distance else {
            return Err(Fault::new("`color` needs a way after which it is seen")
                .with_help("add `distance`")
                .or_at(color.span()));
        };
        let color = Vec3::from_array(color.values().map(Fraction::f32));
        if color.min_element() == 0.0 {
            return Err(Fault::new("no medium absorbs all light of a channel on its way")
                .with_help("choose numbers above 0")
                .or_at(color_span(self)));
        }
        Ok((color.ln() / -distance.f32()).max(Rgb::ZERO))
    }
}

fn color_span(table: &MediumTable) -> Option<Span> {
    table.color.as_ref().and_then(Placed::span)
}

impl GridTable {
    /// The grid of the scene.
    pub(super) fn build(&self, volume: &Volume) -> Result<DensityGrid, Fault> {
        let placed = self.placement_keys().affine()?;
        let [least, largest] = volume.bounds.map(Vec3::as_dvec3);
        let fill = DAffine3 { matrix3: DMat3::from_diagonal(largest - least), translation: least };
        let place = Transform::new(placed * fill)
            .ok_or_else(|| Fault::new("the transform has no inverse").or_at(self.file.span()))?;
        Ok(DensityGrid { size: volume.size, values: Arc::clone(&volume.values), place })
    }
}
