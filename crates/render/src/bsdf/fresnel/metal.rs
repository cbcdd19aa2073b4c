//! Boundaries of metals, by colour or measured.

use super::conductor::conductor;
use super::{Film, schlick};
use heliostat_scene::Rgb;
use heliostat_scene::material::Conductor;

/// The reflectance of a metal, perhaps under a film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Metal {
    kind: Kind,
    /// Share of the surface under a film, and the film.
    film: Option<(f32, Film)>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    /// Reflectance at normal incidence, Schlick's curve to white, and what is taken from it towards the edge.
    Colored { normal: Rgb, edge: Rgb },
    /// Fresnel's equations.
    Measured(Conductor),
}

impl Metal {
    /// `conductor` is taken in place of `color`, the reflectance at normal incidence, and `edge`, which multiplies Schlick's
    /// curve where the cosine is [`EDGE_COSINE`].
    ///
    /// # Source
    /// Kutz, Hasan, Edmondson, "Novel Aspects of the Adobe Standard Material", 2023, "F82-tint"; Academy Software Foundation,
    /// "`OpenPBR` Surface 1.1", "Metal".
    pub(crate) fn new(color: Rgb, edge: Rgb, conductor: Option<Conductor>) -> Self {
        let at_edge = color.lerp(Rgb::ONE, schlick(EDGE_COSINE));
        let colored = Kind::Colored { normal: color, edge: (Rgb::ONE - edge) * at_edge / bump(EDGE_COSINE) };
        Self { kind: conductor.map_or(colored, Kind::Measured), film: None }
    }

    /// The same with a film on a share of it.
    pub(crate) fn with_film(mut self, share: f32, ior: f32, thickness: f32) -> Self {
        if share > 0.0 {
            self.film = Some((share, Film { ior, thickness }));
        }
        self
    }

    /// The reflectance at an angle of cosine `cos` in `[0, 1]`.
    pub(crate) fn reflectance(&self, cos: f32) -> Rgb {
        let bare = self.bare(cos);
        match self.film {
            None => bare,
            Some((share, film)) => bare.lerp(film.reflectance(cos, self.bare(1.0)), share),
        }
    }

    fn bare(&self, cos: f32) -> Rgb {
        match &self.kind {
            Kind::Colored { normal, edge } => {
                let curve = normal.lerp(Rgb::ONE, schlick(cos)) - edge * bump(cos);
                curve.clamp(Rgb::ZERO, Rgb::ONE)
            }
            Kind::Measured(metal) => conductor(metal, cos),
        }
    }
}

/// The cosine of about 82 degrees: there the bump is highest, and metals are farthest from Schlick's curve.
const EDGE_COSINE: f32 = 1.0 / 7.0;

/// How much of the edge colour counts at an angle of cosine `cos`: none at normal and at grazing angles.
fn bump(cos: f32) -> f32 {
    let x = (1.0 - cos).clamp(0.0, 1.0);
    cos * x.powi(6)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bsdf_metal_has_its_colours_at_normal_edge_and_grazing_angles() {
        let (color, edge) = (Rgb::new(0.9, 0.6, 0.2), Rgb::new(0.7, 1.0, 0.0));
        let metal = Metal::new(color, edge, None);
        let schlick = Metal::new(color, Rgb::ONE, None);
        assert!((metal.reflectance(1.0) - color).abs().max_element() < 1e-6);
        assert!((metal.reflectance(0.0) - Rgb::ONE).abs().max_element() < 1e-6);
        let at_edge = edge * schlick.reflectance(EDGE_COSINE);
        assert!((metal.reflectance(EDGE_COSINE) - at_edge).abs().max_element() < 1e-6);
        for k in 0..=100 {
            let reflectance = metal.reflectance(k as f32 / 100.0);
            assert!(
                reflectance.min_element() >= 0.0 && reflectance.max_element() <= 1.0,
                "{k}: {reflectance}"
            );
            assert!((reflectance.y - schlick.reflectance(k as f32 / 100.0).y).abs() < 1e-6, "{k}");
        }
    }

    #[test]
    fn bsdf_metal_with_an_edge_is_near_the_measured_one() {
        // Iron dips below Schlick's curve towards the edge: its own tint there must bring the curve close at all angles.
        let iron = Conductor::named("iron").unwrap();
        let measured = Metal::new(Rgb::ONE, Rgb::ONE, Some(iron));
        let color = measured.reflectance(1.0);
        let plain = Metal::new(color, Rgb::ONE, None);
        let tinted =
            Metal::new(color, measured.reflectance(EDGE_COSINE) / plain.reflectance(EDGE_COSINE), None);
        let worst = |metal: &Metal| {
            let error =
                |k: i32| (metal.reflectance(0.01 * k as f32) - measured.reflectance(0.01 * k as f32)).abs();
            (0..=100).map(|k| error(k).max_element()).fold(0.0, f32::max)
        };
        assert!(worst(&tinted) < 0.3 * worst(&plain), "{} for {}", worst(&tinted), worst(&plain));
    }
}
