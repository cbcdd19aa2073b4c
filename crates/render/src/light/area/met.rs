//! What rays find that meet the surface of a light by themselves.

use super::super::choice::Reach;
use super::super::cluster::{Cluster, Cone};
use super::{AreaLight, Radiance, Shortcut};
use crate::world::SurfaceHit;
use glam::Vec3;
use heliostat_geometry::Transform;
use heliostat_scene::color::luminance;
use heliostat_scene::light::Falloff;
use std::f32::consts::FRAC_PI_2;

impl AreaLight<'_> {
    /// The density by solid angle with which [`AreaLight::sample`] draws, for `p`, the direction to a hit on its surface;
    /// infinite where samples alone count.
    #[inline]
    pub(in super::super) fn density(&self, p: Vec3, hit: &SurfaceHit, time: f32) -> f32 {
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
        self.density_by_area(hit.hit.at.ng, time) * distance_squared / cos
    }

    /// The density of points per square metre of world space where the normal there is `ng`.
    fn density_by_area(&self, ng: Vec3, time: f32) -> f32 {
        if let Some(Shortcut::Flat(flat) | Shortcut::Rectangle(flat, _)) = &self.shortcut {
            return flat.area.recip();
        }
        let Some(place) = self.stand.now(time) else { return 0.0 };
        (1.0 / (self.emitter.area() * stretch(&place, ng))) as f32
    }

    /// What a choice among lights has to know of it.
    pub(in super::super) fn reach(&self) -> Reach {
        let radiance = match self.radiance {
            Radiance::Constant(radiance) => luminance(radiance),
            Radiance::Object(scene, object) => {
                let shine = |id: usize| luminance(scene.materials[id].surface.emission().factor);
                object.materials.iter().map(|id| shine(id.index())).fold(0.0, f32::max)
            }
        };
        let bounds = self.stand.bounds(self.emitter.bounds());
        if self.falloff == Falloff::None || !bounds.is_finite() {
            return Reach::Far(radiance);
        }
        let (normals, area) = match &self.shortcut {
            Some(Shortcut::Flat(flat) | Shortcut::Rectangle(flat, _)) => {
                (Cone { axis: flat.normal, angle: 0.0 }, flat.area)
            }
            // A convex body shows a quarter of its area from any side, in the mean.
            Some(Shortcut::Sphere(..)) | None => (Cone::ALL, 0.25 * self.mean_area()),
        };
        let (intensity, two_sided) = (area * radiance, self.two_sided);
        Reach::Near(Cluster { bounds, intensity, normals, spread: FRAC_PI_2, two_sided })
    }

    /// Area in world space, as if the map stretched all directions alike.
    fn mean_area(&self) -> f32 {
        let determinant = self.stand.now(0.0).map_or(0.0, |place| place.matrix().matrix3.determinant().abs());
        (self.emitter.area() * determinant.cbrt().powi(2)) as f32
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
