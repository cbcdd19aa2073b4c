//! What a picture will be, before any ray: which pixels, through which camera and filter, into which layers.

use crate::camera_ray::CameraRays;
use crate::error::RenderError;
use crate::film::stopping::{BLOCK, Measure, Rule};
use crate::film::{Film, Keep};
use crate::filter::PixelFilter;
use crate::layers::{self, Raster};
use crate::meta::meta;
use crate::post_dof;
use heliostat_scene::settings::PixelRect;
use heliostat_scene::{Camera, Frame, RenderSettings, Scene};

/// The samples by which a filter shares out its signs, and sees whether there is only one.
fn planned_samples(settings: &RenderSettings) -> u32 {
    /// Where noise or time decides, there will be at least about so many.
    const USUAL: u32 = 16;
    settings.samples.max(settings.most_samples().min(USUAL))
}

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
    pub(crate) fn new(scene: &Scene, camera: &'s Camera, settings: &RenderSettings) -> Self {
        let is_filtered = settings.mip_maps && !scene.textures.is_empty();
        let rays = CameraRays::new(camera, settings.width, settings.height);
        Self {
            settings: settings.clone(),
            camera,
            rays: if is_filtered { rays.with_cones(planned_samples(settings)) } else { rays },
            filter: PixelFilter::new(settings.filter, settings.filter_radius, planned_samples(settings)),
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

    /// When pixels end, if noise decides.
    pub(crate) fn rule(&self) -> Option<Rule> {
        Rule::new(&self.settings, self.filter.masses())
    }

    /// How errors are weighed.
    pub(crate) fn measure(&self) -> Measure {
        Measure::new(&self.settings, self.filter.masses())
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
        let margin = self.rays.post_focus().map_or(0, |_| post_dof::margin(self.settings.height));
        let window = self.grown(self.settings.pixels(), margin);
        if self.settings.noise.is_none() {
            return window;
        }
        // Whole blocks end together, whatever part of them is asked for.
        let up = |side: u32, most: u32| side.next_multiple_of(BLOCK).min(most);
        PixelRect {
            x0: window.x0 / BLOCK * BLOCK,
            y0: window.y0 / BLOCK * BLOCK,
            x1: up(window.x1, self.settings.width),
            y1: up(window.y1, self.settings.height),
        }
    }

    /// A window with so many pixels around it, as far as the picture goes.
    fn grown(&self, window: PixelRect, margin: u32) -> PixelRect {
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
            batches: layers.variance || self.settings.noise.is_some() || self.settings.time.is_some(),
            blocks: self.settings.noise.is_some(),
            nearest: layers::keeps_nearest(layers) || self.rays.post_focus().is_some(),
        }
    }
}
