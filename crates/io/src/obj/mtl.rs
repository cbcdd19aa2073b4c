//! MTL statements into plain values: what the file says, checked, nothing interpreted.
//!
//! # Source
//! Wavefront Technologies, "MTL Material Format", in Murray and vanRyper, "Encyclopedia of Graphics File Formats", 1996.

use super::map::Map;
use super::number::{finite, finite_list};
use super::text::{SourceText, Statement};
use super::warnings::Warnings;
use crate::error::{LoadError, quote};
use crate::nearest::nearest_name;
use heliostat_scene::Rgb;
use std::collections::{HashMap, HashSet};

/// Statements that are understood; the candidates for a misspelt one.
const KNOWN: [&str; 20] = [
    "newmtl", "ka", "kd", "ks", "ke", "tf", "ns", "ni", "d", "tr", "illum", "map_ka", "map_kd", "map_ks",
    "map_ke", "map_ns", "map_d", "map_bump", "bump", "norm",
];

/// Statements that other renderers know and a Phong surface has no use for.
const NOT_DRAWN: [&str; 24] = [
    "refl",
    "disp",
    "map_disp",
    "decal",
    "sharpness",
    "map_aat",
    "pr",
    "pm",
    "ps",
    "pc",
    "pcr",
    "aniso",
    "anisor",
    "map_pr",
    "map_pm",
    "map_ps",
    "map_pc",
    "map_pcr",
    "map_rma",
    "map_orm",
    "map_refl",
    "map_tf",
    "map_ni",
    "fps",
];

/// Different unknown keywords that are reported one by one.
const MOST_UNKNOWN: usize = 20;

/// A material as written; `None` where the file says nothing.
#[derive(Clone, Debug, Default)]
pub(super) struct MtlMaterial {
    pub(super) name: String,
    pub(super) ambient: Option<Rgb>,
    pub(super) diffuse: Option<Rgb>,
    pub(super) specular: Option<Rgb>,
    pub(super) emission: Option<Rgb>,
    pub(super) filter: Option<Rgb>,
    pub(super) shininess: Option<f32>,
    pub(super) ior: Option<f32>,
    /// `d`, in `[0, 1]`.
    pub(super) dissolve: Option<f32>,
    /// `Tr`, in `[0, 1]`.
    pub(super) transparency: Option<f32>,
    pub(super) illum: Option<u8>,
    pub(super) map_ambient: Option<Map>,
    pub(super) map_diffuse: Option<Map>,
    pub(super) map_specular: Option<Map>,
    pub(super) map_emission: Option<Map>,
    pub(super) map_shininess: Option<Map>,
    pub(super) map_dissolve: Option<Map>,
    pub(super) bump: Option<Map>,
    pub(super) normal_map: Option<Map>,
}

/// Reads a whole library.
///
/// # Errors
/// On the first statement that cannot be understood.
pub(super) fn parse(source: &SourceText<'_>, warnings: &mut Warnings) -> Result<Vec<MtlMaterial>, LoadError> {
    let mut reader = Reader {
        source,
        materials: Vec::new(),
        ids: HashMap::new(),
        current: 0,
        warned: HashSet::new(),
        warnings,
    };
    for statement in source.statements() {
        reader.statement(&statement)?;
    }
    Ok(reader.materials)
}

struct Reader<'a> {
    source: &'a SourceText<'a>,
    materials: Vec<MtlMaterial>,
    ids: HashMap<String, usize>,
    /// The material that statements speak of.
    current: usize,
    /// Keywords that have been warned of.
    warned: HashSet<String>,
    warnings: &'a mut Warnings,
}

impl Reader<'_> {
    fn statement(&mut self, statement: &Statement<'_>) -> Result<(), LoadError> {
        let keyword = statement.keyword.to_ascii_lowercase();
        if keyword == "newmtl" {
            return self.new_material(statement);
        }
        if self.materials.is_empty() && KNOWN.contains(&keyword.as_str()) {
            let message = format!("`{}` stands before the first `newmtl`", statement.keyword);
            let error = self.source.error(statement.keyword, message);
            return Err(error.with_help("start the material with `newmtl NAME`"));
        }
        match keyword.as_str() {
            "ka" | "kd" | "ks" | "ke" | "tf" => self.color(&keyword, statement),
            "ns" | "ni" | "d" | "tr" | "illum" => self.number(&keyword, statement),
            _ if KNOWN.contains(&keyword.as_str()) => self.map(&keyword, statement),
            // Other spellings of the same maps.
            "map_opacity" => self.map("map_d", statement),
            "map_emissive" => self.map("map_ke", statement),
            "map_norm" | "map_kn" | "norm_map" => self.map("norm", statement),
            _ => {
                self.not_understood(&keyword, statement);
                Ok(())
            }
        }
    }

    fn new_material(&mut self, statement: &Statement<'_>) -> Result<(), LoadError> {
        let name = statement.name().to_owned();
        if name.is_empty() {
            let error = self.source.error(statement.keyword, "`newmtl` gives no name");
            return Err(error.with_help("write the name of the material behind it"));
        }
        let material = MtlMaterial { name: name.clone(), ..MtlMaterial::default() };
        if let Some(&id) = self.ids.get(&name) {
            let message = format!("the material {} is defined again", quote(&name));
            let warning = self.source.warning(statement.keyword, message);
            self.warnings.push(warning.with_help("the last definition counts; rename one of them"));
            self.materials[id] = material;
            self.current = id;
            return Ok(());
        }
        self.current = self.materials.len();
        self.ids.insert(name, self.current);
        self.materials.push(material);
        Ok(())
    }

    fn color(&mut self, keyword: &str, statement: &Statement<'_>) -> Result<(), LoadError> {
        let first = statement.words().next().unwrap_or_default();
        if first == "spectral" || first == "xyz" {
            let warning =
                self.source.warning(first, format!("`{}` as {first} is not drawn", statement.keyword));
            self.warnings.push(warning.with_help("write red, green and blue"));
            return Ok(());
        }
        let mut n = [0.0; 3];
        let count = finite_list(self.source, statement, 1..=3, "red, green and blue", &mut n)?;
        if count == 2 {
            let error =
                self.source.error(statement.last_word(), format!("`{}` has 2 numbers", statement.keyword));
            return Err(error.with_help("expected red, green and blue, or one number for grey"));
        }
        let color = if count == 1 { Rgb::splat(n[0]) } else { Rgb::from_array(n) };
        if color.min_element() < 0.0 {
            let error = self.source.error(statement.keyword, format!("`{}` is negative", statement.keyword));
            return Err(error.with_help("colours are 0 or more"));
        }
        if let Some(material) = self.materials.get_mut(self.current) {
            let field = match keyword {
                "ka" => &mut material.ambient,
                "kd" => &mut material.diffuse,
                "ks" => &mut material.specular,
                "ke" => &mut material.emission,
                _ => &mut material.filter,
            };
            *field = Some(color);
        }
        Ok(())
    }

    fn number(&mut self, keyword: &str, statement: &Statement<'_>) -> Result<(), LoadError> {
        // `d -halo 0.5`: thinner where the surface faces the viewer, which is not drawn.
        let mut words = statement.words().filter(|&word| word != "-halo");
        let Some(word) = words.next() else {
            let error =
                self.source.error(statement.keyword, format!("`{}` has no number", statement.keyword));
            return Err(error.with_help("write the number behind it"));
        };
        let value = finite(self.source, word)?;
        let (smallest, largest) = match keyword {
            "ns" => (0.0, f32::MAX),
            "ni" => (f32::MIN_POSITIVE, f32::MAX),
            "illum" => (0.0, 10.0),
            _ => (0.0, 1.0),
        };
        let value = if (smallest..=largest).contains(&value) {
            value
        } else {
            self.out_of_range(keyword, statement, word)?
        };
        if let Some(material) = self.materials.get_mut(self.current) {
            match keyword {
                "ns" => material.shininess = Some(value),
                "ni" => material.ior = Some(value),
                "d" => material.dissolve = Some(value),
                "tr" => material.transparency = Some(value),
                _ => material.illum = Some(value as u8),
            }
        }
        Ok(())
    }

    /// What is meant by a number out of range where that is clear; warns of it.
    fn out_of_range(
        &mut self,
        keyword: &str,
        statement: &Statement<'_>,
        word: &str,
    ) -> Result<f32, LoadError> {
        let (range, instead) = match keyword {
            "ns" => ("0 or more", 0.0),
            "illum" => ("0 to 10", 2.0),
            "ni" => {
                let error =
                    self.source.error(word, format!("an index of refraction of {word} does not exist"));
                return Err(error.with_help("write a number above 0; air is 1, glass is 1.5"));
            }
            _ => ("0 to 1", if word.starts_with('-') { 0.0 } else { 1.0 }),
        };
        let message = format!("`{}` is {word}, which is out of range", statement.keyword);
        let warning = self.source.warning(word, message);
        self.warnings.push(warning.with_help(format!("expected {range}; {instead} is used")));
        Ok(instead)
    }

    fn map(&mut self, keyword: &str, statement: &Statement<'_>) -> Result<(), LoadError> {
        let map = Map::parse(self.source, statement)?;
        for option in &map.ignored {
            let message = format!("the texture option {option} is not drawn");
            self.warnings.push(self.source.warning(statement.keyword, message));
        }
        if let Some(material) = self.materials.get_mut(self.current) {
            let field = match keyword {
                "map_ka" => &mut material.map_ambient,
                "map_kd" => &mut material.map_diffuse,
                "map_ks" => &mut material.map_specular,
                "map_ke" => &mut material.map_emission,
                "map_ns" => &mut material.map_shininess,
                "map_d" => &mut material.map_dissolve,
                "norm" => &mut material.normal_map,
                _ => &mut material.bump,
            };
            *field = Some(map);
        }
        Ok(())
    }

    /// Warns once per keyword.
    fn not_understood(&mut self, keyword: &str, statement: &Statement<'_>) {
        if self.warned.len() >= MOST_UNKNOWN || !self.warned.insert(keyword.to_owned()) {
            return;
        }
        let quoted = quote(statement.keyword);
        let warning = if NOT_DRAWN.contains(&keyword) {
            self.source.warning(
                statement.keyword,
                format!("{quoted} is left out: a Phong surface has no use for it"),
            )
        } else {
            let warning =
                self.source.warning(statement.keyword, format!("the statement {quoted} is not known"));
            match nearest_name(keyword, KNOWN).filter(|_| keyword.len() > 1) {
                Some(near) => warning.with_help(format!("did you mean `{near}`?")),
                None => warning,
            }
        };
        self.warnings.push(warning);
    }
}
