//! The textures of a scene, made as materials ask for them.

use super::Directory;
use super::assets::Assets;
use super::material::{FindTexture, TextureUse};
use super::texture::{EncodingMode, TextureTable};
use crate::document::{Fault, Placed, Sources};
use crate::error::Warning;
use crate::udim;
use heliostat_scene::texture::Pattern;
use heliostat_scene::{Texture, TextureId};

/// Makes the textures of the scene as materials ask for them.
pub(super) struct Textures<'a> {
    directory: &'a Directory,
    tables: &'a [Placed<TextureTable>],
    assets: &'a mut Assets,
    sources: &'a Sources,
    /// For each table its texture for colours and for data.
    made: Vec<[Option<TextureId>; 2]>,
    textures: Vec<Texture>,
    warnings: Vec<Warning>,
}

impl FindTexture for Textures<'_> {
    fn find(&mut self, name: &Placed<String>, used_for: TextureUse) -> Result<TextureId, Fault> {
        let index = self.directory.textures.find(name)?;
        Ok(self.get(index, used_for))
    }
}

impl<'a> Textures<'a> {
    /// None made yet.
    pub(super) fn new(
        directory: &'a Directory,
        tables: &'a [Placed<TextureTable>],
        assets: &'a mut Assets,
        sources: &'a Sources,
    ) -> Self {
        let made = vec![[None; 2]; tables.len()];
        Self { directory, tables, assets, sources, made, textures: Vec::new(), warnings: Vec::new() }
    }

    /// The textures, those that nobody asked for with them, so that a missing file is told.
    pub(super) fn finish(mut self) -> (Vec<Texture>, Vec<Warning>) {
        for index in 0..self.tables.len() {
            if self.made[index] == [None; 2] {
                self.get(index, TextureUse::Color);
            }
        }
        (self.textures, self.warnings)
    }

    fn get(&mut self, index: usize, used_for: TextureUse) -> TextureId {
        let table = &self.tables[index];
        let is_data = self.is_data(table, used_for);
        let encoding = if is_data { EncodingMode::Linear } else { table.encoding() };
        let slot = usize::from(is_data);
        if let Some(id) = self.made[index][slot] {
            return id;
        }
        let id = TextureId(self.textures.len() as u32);
        let pattern = self.pattern(table, encoding);
        self.textures.push(Texture { name: table.name.to_string(), pattern, uv: table.uv_transform() });
        self.made[index][slot] = Some(id);
        id
    }

    /// Whether an image is read as plain numbers because of its use: only one that is read as the file says depends on it.
    fn is_data(&mut self, table: &TextureTable, used_for: TextureUse) -> bool {
        let Some(file) = table.image.as_ref().filter(|_| table.encoding() == EncodingMode::Auto) else {
            return false;
        };
        match used_for {
            TextureUse::Color => false,
            TextureUse::Data => true,
            // Alpha serves from the image that gives the colour, where it is read anyway.
            TextureUse::Coverage if udim::is_tiled(file) => match self.assets.tiles(file, EncodingMode::Auto)
            {
                Ok(tiles) => !tiles.iter().any(|tile| tile.image.has_alpha()),
                Err(_) => false,
            },
            TextureUse::Coverage => match self.assets.image(file, EncodingMode::Auto, None) {
                Ok(image) => !image.has_alpha(),
                Err(_) => false,
            },
        }
    }

    /// The pattern of many images; what is missing between them is told.
    fn tiles(&mut self, table: &TextureTable, file: &Placed<String>, encoding: EncodingMode) -> Pattern {
        match self.assets.tiles(file, encoding) {
            Ok(tiles) => {
                let numbers: Vec<u32> = tiles.iter().map(|tile| tile.number).collect();
                if let Some(gaps) = udim::gaps(file, &numbers) {
                    self.warnings.push(self.sources.warning(&Fault::new(gaps).or_at(file.span())));
                }
                Pattern::Tiles { tiles, filtering: table.filtering(), minify: table.minify() }
            }
            Err(fault) => {
                self.warnings.push(self.sources.warning(&fault));
                Pattern::Missing
            }
        }
    }

    fn pattern(&mut self, table: &TextureTable, encoding: EncodingMode) -> Pattern {
        if let Some(checker) = &table.checker {
            return checker.pattern();
        }
        let Some(file) = &table.image else { return Pattern::Missing };
        if udim::is_tiled(file) {
            return self.tiles(table, file, encoding);
        }
        let made_by = table.made_by.as_ref().map(|command| command.as_str());
        match self.assets.image(file, encoding, made_by) {
            Ok(image) => {
                let [wrap_u, wrap_v] = table.wraps();
                Pattern::Image { image, wrap_u, wrap_v, filtering: table.filtering(), minify: table.minify() }
            }
            Err(fault) => {
                self.warnings.push(self.sources.warning(&fault));
                Pattern::Missing
            }
        }
    }
}
