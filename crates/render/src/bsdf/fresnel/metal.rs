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
    /// Reflectance at normal incidence; Schlick's curve to white.
    Colored(Rgb),
    /// Fresnel's equations.
    Measured(Conductor),
}

impl Metal {
    /// `conductor` is taken in place of `color`.
    pub(crate) fn new(color: Rgb, conductor: Option<Conductor>) -> Self {
        Self { kind: conductor.map_or(Kind::Colored(color), Kind::Measured), film: None }
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
            Kind::Colored(color) => color.lerp(Rgb::ONE, schlick(cos)),
            Kind::Measured(metal) => conductor(metal, cos),
        }
    }
}
