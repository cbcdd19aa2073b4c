//! What rays find that meet the surface of a light by themselves.

use super::super::choice::Reach;
use super::super::cluster::{Cluster, Cone};
use super::super::emitter::EmitterPiece;
use super::{AreaLight, Shortcut};
use crate::world::SurfaceHit;
use glam::Vec3;
use heliostat_geometry::Transform;
use heliostat_scene::light::Falloff;
use std::f32::consts::FRAC_PI_2;

impl AreaLight<'_> {
    /// The density by solid angle with which [`AreaLight::sample`] draws, for `p` and the piece, the direction to a hit on its
    /// surface; infinite where samples alone count.
    #[inline]
    pub(in super::super) fn density(&self, p: Vec3, piece: usize, hit: &SurfaceHit, time: f32) -> f32 {
        if !self.is_met {
            return f32::INFINITY;
        }
        let way = hit.hit.at.p - p;
        match &self.shortcut {
            Some(Shortcut::Sphere(_, _, sphere)) => {
                if let Some(solid_angle) = sphere.solid_angle(p) {
                    // Samples are on the near side; through a hole in it, rays see the far one.
                    return if way.dot(hit.hit.at.ng) < 0.0 { solid_angle.recip() } else { 0.0 };
                }
            }
            Some(Shortcut::Rectangle(_, rectangle)) => {
                if let Some(seen) = rectangle.seen_from(p) {
                    return seen.solid_angle.recip();
                }
            }
            Some(Shortcut::Flat(_)) | None => {}
        }
        let distance_squared = way.length_squared();
        let cos = hit.hit.at.ng.dot(way).abs() / distance_squared.sqrt();
        self.density_by_area(piece, hit, time) * distance_squared / cos
    }

    /// The piece of the surface that a hit lies on; `None` where it does not shine.
    #[inline]
    pub(in super::super) fn piece_of(&self, hit: &SurfaceHit) -> Option<usize> {
        self.emitter.piece_of(hit)
    }

    /// The density of points of a piece per square metre of world space.
    fn density_by_area(&self, piece: usize, hit: &SurfaceHit, time: f32) -> f32 {
        if let Some(Shortcut::Flat(flat) | Shortcut::Rectangle(flat, _)) = &self.shortcut {
            return flat.area.recip();
        }
        let Some(place) = self.stand.now(time) else { return 0.0 };
        (self.emitter.density(piece, hit) / stretch(&place, hit.hit.at.ng)) as f32
    }

    /// What a choice among lights has to know of each piece.
    pub(in super::super) fn reaches(&self) -> Vec<Reach> {
        let still = self.stand.still();
        let determinant = self.stand.now(0.0).map_or(0.0, |place| place.matrix().matrix3.determinant().abs());
        // As if the map stretched all directions alike.
        let stretch = determinant.cbrt().powi(2);
        let reach = |piece: EmitterPiece| {
            let bounds = self.stand.bounds(piece.bounds);
            let brightness = (stretch * piece.brightness) as f32;
            if self.falloff == Falloff::None || !bounds.is_finite() {
                return Reach::Far(brightness);
            }
            let normals = still.as_ref().map_or(Cone::ALL, |place| piece.normals.placed(place));
            // A convex body shows a quarter of its area from any side, in the mean.
            let shown = if normals.angle < FRAC_PI_2 { 1.0 } else { 0.25 };
            let (intensity, two_sided) = (shown * brightness, self.two_sided);
            Reach::Near(Cluster { bounds, intensity, normals, spread: FRAC_PI_2, two_sided })
        };
        self.emitter.pieces(&self.glow).into_iter().map(reach).collect()
    }
}

/// How much larger a small piece of surface is in world space than in local space, by its normal in world space.
///
/// # Source
/// As [`Transform::area_stretch`], where `|M^-T n|` of the local normal is one over `|M^T n|` of the unit one in world space.
fn stretch(place: &Transform, ng: Vec3) -> f64 {
    let linear = place.matrix().matrix3;
    linear.determinant().abs() / (linear.transpose() * ng.as_dvec3()).length()
}
