//! What a picture will be, before any ray: which pixels, through which camera and filter, into which layers.

use crate::camera_ray::CameraRays;
use crate::error::RenderError;
use crate::film::{Film, Keep};
use crate::filter::PixelFilter;
use crate::layers::{self, Raster};
use crate::meta::meta;
use crate::post_dof;
use heliostat_scene::settings::PixelRect;
use heliostat_scene::{Camera, Frame, RenderSettings};

/// The picture to be made.
#[derive(Debug)]
pub(crate) struct Plan<'s> {
    pub(crate) settings: RenderSettings,
    camera: &'s Camera,
    pub(crate) rays: CameraRays,
    pub(crate) filter: PixelFilter,
}

impl<'s> Plan<'s> {
    /// A plan of settings and a camera that were checked.
    pub(crate) fn new(camera: &'s Camera, settings: &RenderSettings) -> Self {
        let rays = CameraRays::new(camera, settings.width, settings.height);
        Self {
            settings: settings.clone(),
            camera,
            rays: if settings.mip_maps { rays.with_cones(settings.samples) } else { rays },
            filter: PixelFilter::new(settings.filter, settings.filter_radius, settings.samples),
        }
    }

    /// Asks the system once for all that film and frame will take, and gives it back.
    ///
    /// Later they are taken in many small pieces, of which none would be refused before the last.
    pub(crate) fn reserve(&self) -> Result<(), RenderError> {
        let window = self.film_window();
        let pixels = u64::from(window.width()) * u64::from(window.height());
        let channels = layers::channel_count(&self.settings.layers) as u64;
        let frame = pixels * (channels * size_of::<f32>() as u64 + size_of::<[f32; 4]>() as u64);
        let bytes = Film::bytes(pixels, self.keep()) + frame;
        let out_of_memory = || RenderError::OutOfMemory { bytes };
        let size = usize::try_from(bytes).map_err(|_| out_of_memory())?;
        Vec::<u8>::new().try_reserve_exact(size).map_err(|_| out_of_memory())
    }

    /// An empty film.
    pub(crate) fn film(&self) -> Film {
        Film::new(self.film_window(), &self.filter, self.keep())
    }

    /// # Panics
    /// When the film was made by a plan with other pixels or layers.
    pub(crate) fn assert_fits(&self, film: &Film) {
        assert!(
            film.window() == self.film_window() && film.kept() == self.keep(),
            "the film was made for another picture"
        );
    }

    /// From the film to the frame.
    pub(crate) fn resolve(&self, film: &Film) -> Frame {
        let window = self.settings.pixels();
        let mut rgba = Raster::of_film(film, [0.0; 4], |tile, i| tile.rgba(i, film.masses()));
        if let Some(focus) = self.rays.post_focus() {
            let depth = Raster::of_film(film, 0.0, |tile, i| tile.nearest(i).depth);
            rgba = post_dof::blur(&rgba, &depth, &self.rays, focus, self.settings.height);
        }
        let mut channels: Vec<_> = layers::beauty(&rgba.crop(window)).collect();
        channels.extend(layers::extra(film, window, &self.settings.layers));
        Frame {
            width: self.settings.width,
            height: self.settings.height,
            window,
            channels,
            meta: meta(&self.settings, self.camera, &self.rays, film),
        }
    }

    /// The pixels of the frame, and around them those that a blur after rendering looks at.
    fn film_window(&self) -> PixelRect {
        let window = self.settings.pixels();
        if self.rays.post_focus().is_none() {
            return window;
        }
        let margin = post_dof::margin(self.settings.height);
        PixelRect {
            x0: window.x0.saturating_sub(margin),
            y0: window.y0.saturating_sub(margin),
            x1: window.x1.saturating_add(margin).min(self.settings.width),
            y1: window.y1.saturating_add(margin).min(self.settings.height),
        }
    }

    /// What the film must keep for layers and blur.
    fn keep(&self) -> Keep {
        let layers = &self.settings.layers;
        Keep {
            lobes: self.filter.has_negative_lobes(),
            albedo: layers.albedo,
            nearest: layers::keeps_nearest(layers) || self.rays.post_focus().is_some(),
        }
    }
}
