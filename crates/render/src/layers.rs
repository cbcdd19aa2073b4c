//! From the film to named channels.
//!
//! | channel | value | stored |
//! |---|---|---|
//! | `R G B A` | radiance, premultiplied, and coverage; filtered | half |
//! | `albedo.R albedo.G albedo.B` | share of light that the first surface sends on; filtered like the beauty | half |
//! | `sample_count.Y` | samples of the pixel | float |
//! | `variance.R variance.G variance.B` | estimated variance of the pixel's value, from the spread of batches of its samples; before any blur, and 0 where fewer than two batches are there | float |
//! | `Z` | depth, see `heliostat/depthType`; 1e10 on a miss | float |
//! | `N.X N.Y N.Z` | shading normal in world space, 0 on a miss | float |
//! | `P.X P.Y P.Z` | position in world space, 0 on a miss | float |
//! | `UV.U UV.V` | surface parameters, 0 on a miss | float |
//! | `object_id.Y` | index of the object + 1, 0 on a miss and on the surface of a light | float |
//! | `material_id.Y` | index of the material + 1, 0 likewise | float |
//!
//! From `Z` on all are data: one sample each, the one nearest to the centre of the pixel, never mixed
//! and not premultiplied. (A mean of two ids, or of a depth and 1e10, is nothing.)

use crate::film::{Film, Nearest, Tile};
use heliostat_scene::frame::{Channel, Depth};
use heliostat_scene::settings::{Layers, PixelRect};
use rayon::iter::{IntoParallelIterator, IntoParallelRefIterator, ParallelIterator};

/// A film's pixels, row by row over a window.
#[derive(Clone, Debug)]
pub(crate) struct Raster<T> {
    pub(crate) window: PixelRect,
    pub(crate) pixels: Vec<T>,
}

impl<T: Copy + Send + Sync> Raster<T> {
    /// Reads every pixel of a film, rows of tiles in parallel.
    pub(crate) fn of_film(film: &Film, empty: T, pixel: impl Fn(&Tile, usize) -> T + Sync) -> Self {
        let window = film.window();
        let columns = window.width() as usize;
        let mut pixels = vec![empty; columns * window.height() as usize];
        let mut rest = pixels.as_mut_slice();
        let mut bands = Vec::new();
        for tiles in film.tiles().chunk_by(|a, b| a.rect.y0 == b.rect.y0) {
            let (band, below) = rest.split_at_mut(columns * tiles[0].rect.height() as usize);
            bands.push((tiles, band));
            rest = below;
        }
        bands.into_par_iter().for_each(|(tiles, band)| {
            for tile in tiles {
                let (width, left) = (tile.rect.width() as usize, (tile.rect.x0 - window.x0) as usize);
                for (row, line) in band.chunks_mut(columns).enumerate() {
                    for (column, place) in line[left..left + width].iter_mut().enumerate() {
                        *place = pixel(tile, row * width + column);
                    }
                }
            }
        });
        Self { window, pixels }
    }

    /// The part of it in `window`, which must lie inside.
    pub(crate) fn crop(self, window: PixelRect) -> Self {
        if window == self.window {
            return self;
        }
        let columns = self.window.width() as usize;
        let row = |y: u32| {
            let start = (y - self.window.y0) as usize * columns + (window.x0 - self.window.x0) as usize;
            &self.pixels[start..start + window.width() as usize]
        };
        let pixels = (window.y0..window.y1).flat_map(row).copied().collect();
        Self { window, pixels }
    }

    fn channel(&self, name: &str, depth: Depth, value: impl Fn(&T) -> f32 + Sync + Send) -> Channel {
        Channel { name: name.to_owned(), depth, values: self.pixels.par_iter().map(value).collect() }
    }
}

/// The channels of the beauty.
pub(crate) fn beauty(rgba: &Raster<[f32; 4]>) -> impl Iterator<Item = Channel> {
    (0..4).map(|c| rgba.channel(["R", "G", "B", "A"][c], Depth::Half, |pixel| pixel[c]))
}

/// The channels of the extra layers, over `window`.
pub(crate) fn extra(film: &Film, window: PixelRect, layers: &Layers) -> Vec<Channel> {
    let mut channels = Vec::new();
    if layers.albedo {
        let albedo = Raster::of_film(film, [0.0; 3], |tile, i| tile.albedo(i, film.masses())).crop(window);
        let names = ["albedo.R", "albedo.G", "albedo.B"];
        channels.extend((0..3).map(|c| albedo.channel(names[c], Depth::Half, |pixel| pixel[c])));
    }
    if layers.sample_count {
        let count = Raster::of_film(film, 0, Tile::sample_count).crop(window);
        channels.push(count.channel("sample_count.Y", Depth::Float, |&count| count as f32));
    }
    if layers.variance {
        let of = |tile: &Tile, i| tile.variance(i, film.masses()).unwrap_or_default();
        let variance = Raster::of_film(film, [0.0; 3], of).crop(window);
        let names = ["variance.R", "variance.G", "variance.B"];
        channels.extend((0..3).map(|c| variance.channel(names[c], Depth::Float, |v| v[c] as f32)));
    }
    if keeps_nearest(layers) {
        let nearest = Raster::of_film(film, Nearest::NONE, |tile, i| tile.nearest(i)).crop(window);
        let wanted = data_channels().into_iter().filter(|channel| (channel.wanted)(layers));
        channels.extend(wanted.map(|channel| nearest.channel(channel.name, Depth::Float, channel.value)));
    }
    channels
}

/// Whether any layer needs the nearest sample.
pub(crate) fn keeps_nearest(layers: &Layers) -> bool {
    data_channels().iter().any(|channel| (channel.wanted)(layers))
}

/// How many channels a frame with these layers has.
pub(crate) fn channel_count(layers: &Layers) -> usize {
    let data = data_channels().iter().filter(|channel| (channel.wanted)(layers)).count();
    let sets = [(layers.albedo, 3), (layers.sample_count, 1), (layers.variance, 3)];
    4 + data + sets.iter().filter(|(wanted, _)| *wanted).map(|(_, count)| count).sum::<usize>()
}

/// A channel of data: when it is wanted and what it says.
struct DataChannel {
    name: &'static str,
    wanted: fn(&Layers) -> bool,
    value: fn(&Nearest) -> f32,
}

/// Every channel of data, in the order of the table above.
fn data_channels() -> [DataChannel; 11] {
    let channel = |name, wanted, value| DataChannel { name, wanted, value };
    [
        channel("Z", |l| l.depth, |n| n.depth),
        channel("N.X", |l| l.normal, |n| n.normal.x),
        channel("N.Y", |l| l.normal, |n| n.normal.y),
        channel("N.Z", |l| l.normal, |n| n.normal.z),
        channel("P.X", |l| l.position, |n| n.p.x),
        channel("P.Y", |l| l.position, |n| n.p.y),
        channel("P.Z", |l| l.position, |n| n.p.z),
        channel("UV.U", |l| l.uv, |n| n.uv.x),
        channel("UV.V", |l| l.uv, |n| n.uv.y),
        // Exact up to 2^24 objects.
        channel("object_id.Y", |l| l.object_id, |n| n.object as f32),
        channel("material_id.Y", |l| l.material_id, |n| n.material as f32),
    ]
}
