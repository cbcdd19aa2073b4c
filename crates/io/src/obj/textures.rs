//! The textures that the materials of a model name, each described once.

use super::channel::{Role, for_role, is_normal_map};
use super::files::ObjFiles;
use super::map::Map;
use super::text::SourceText;
use super::warnings::Warnings;
use crate::error::quote;
use crate::udim;
use heliostat_scene::texture::{Filtering, Minify, Pattern, Tile, Wrap};
use heliostat_scene::{Image, Texture, TextureId};
use std::collections::HashMap;
use std::sync::Arc;

/// What tells textures apart: the library and file, the role, the placement (as bits), the wrapping.
type Key = (String, Role, [u32; 4], bool);

/// Textures of one library in the making.
pub(super) struct Textures<'t, 'a> {
    /// The library whose maps are looked up.
    pub(super) library: &'a SourceText<'a>,
    pub(super) files: &'a mut dyn ObjFiles,
    pub(super) known: &'t mut Known,
    pub(super) warnings: &'a mut Warnings,
}

/// Textures of all libraries of a model.
#[derive(Debug, Default)]
pub(super) struct Known {
    pub(super) textures: Vec<Texture>,
    ids: HashMap<Key, TextureId>,
    /// Images by library and name, in their roles; `None` for what cannot be read.
    images: HashMap<(String, Role), Option<Arc<Image>>>,
}

impl Textures<'_, '_> {
    /// A colour texture; magenta when the file is missing.
    pub(super) fn color(&mut self, map: &Map) -> Option<TextureId> {
        Some(self.texture(map, Role::Color))
    }

    /// A texture of numbers; none when the file is missing, because magenta is no number.
    pub(super) fn number(&mut self, map: &Map, role: Role) -> Option<TextureId> {
        self.image(map, role)?;
        Some(self.texture(map, role))
    }

    /// Whether the image of a bump map is a normal map in truth.
    pub(super) fn looks_like_normal_map(&mut self, map: &Map) -> bool {
        map.channel.is_none() && self.image(map, Role::Color).is_some_and(|image| is_normal_map(&image))
    }

    fn texture(&mut self, map: &Map, role: Role) -> TextureId {
        let uv = [map.uv.scale.x, map.uv.scale.y, map.uv.offset.x, map.uv.offset.y].map(f32::to_bits);
        let key = (self.name(map), role, uv, map.wrap == Wrap::Clamp);
        if let Some(&id) = self.known.ids.get(&key) {
            return id;
        }
        let pattern = match self.image(map, role) {
            Some(_) if udim::is_tiled(&map.file) => self.tiles(map, role),
            None => Pattern::Missing,
            Some(image) => Pattern::Image {
                image,
                wrap_u: map.wrap,
                wrap_v: map.wrap,
                filtering: Filtering::Bilinear,
                minify: Minify::Mip,
            },
        };
        let id = TextureId(self.known.textures.len() as u32);
        self.known.textures.push(Texture { name: map.file.clone(), pattern, uv: map.uv });
        self.known.ids.insert(key, id);
        id
    }

    /// All images of a map whose first one could be read.
    fn tiles(&mut self, map: &Map, role: Role) -> Pattern {
        let found = self.files.tiles(self.library.path, &map.file).unwrap_or_default();
        let as_role = |tile: Tile| Tile {
            image: for_role(&tile.image, role).map_or_else(|| Arc::clone(&tile.image), Arc::new),
            ..tile
        };
        let tiles = found.into_iter().map(as_role).collect();
        Pattern::Tiles { tiles, filtering: Filtering::Bilinear, minify: Minify::Mip }
    }

    fn image(&mut self, map: &Map, role: Role) -> Option<Arc<Image>> {
        let key = (self.name(map), role);
        if let Some(known) = self.known.images.get(&key) {
            return known.clone();
        }
        let image = if role == Role::Color {
            self.read(map)
        } else {
            let as_stored = self.image(map, Role::Color);
            as_stored.map(|image| for_role(&image, role).map_or(image, Arc::new))
        };
        self.known.images.insert(key, image.clone());
        image
    }

    /// Reads the file; warns when that fails.
    fn read(&mut self, map: &Map) -> Option<Arc<Image>> {
        let read = if udim::is_tiled(&map.file) {
            // The first tile stands for all where one image is asked about.
            let tiles = self.files.tiles(self.library.path, &map.file);
            tiles.map(|tiles| Arc::clone(&tiles[0].image))
        } else {
            self.files.image(self.library.path, &map.file)
        };
        match read {
            Ok(image) => Some(image),
            Err(error) => {
                let report = error.report();
                let message = format!("texture {}: {}", quote(&map.file), report.message);
                let warning = self.library.warning_at(map.offset, message);
                self.warnings.push(match &report.help {
                    Some(help) => warning.with_help(help),
                    None => warning,
                });
                None
            }
        }
    }

    /// The same file name means different files in libraries of different folders.
    fn name(&self, map: &Map) -> String {
        let folder = self.library.path.parent().unwrap_or(self.library.path);
        format!("{}/{}", folder.display(), map.file)
    }
}
