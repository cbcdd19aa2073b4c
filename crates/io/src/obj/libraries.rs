//! The materials that a model uses, from the libraries that it names.

use super::files::ObjFiles;
use super::material::{convert, neutral};
use super::mtl;
use super::raw::RawObj;
use super::text::SourceText;
use super::textures::{Known, Textures};
use crate::error::{LoadError, quote};
use crate::nearest::suggestion;
use heliostat_geometry::Aabb;
use heliostat_scene::{Material, Texture};
use std::collections::{BTreeSet, HashMap, HashSet};
use std::path::PathBuf;

/// The materials of a model and how to find them.
#[derive(Debug, Default)]
pub(super) struct Materials {
    pub(super) materials: Vec<Material>,
    pub(super) textures: Vec<Texture>,
    /// Index into `materials` for each of [`RawObj::material_names`].
    by_name: Vec<usize>,
    /// Index of the material of faces without one.
    neutral: usize,
}

impl Materials {
    /// The material for an index of [`RawObj::material_names`], or for none.
    pub(super) fn of(&self, name: Option<u32>) -> usize {
        name.map_or(self.neutral, |id| self.by_name[id as usize])
    }
}

/// Reads the libraries and keeps of them what the faces use.
///
/// # Errors
/// On a library with a statement that cannot be understood; a missing one is a warning.
pub(super) fn load(
    source: &SourceText<'_>,
    raw: &mut RawObj,
    files: &mut dyn ObjFiles,
) -> Result<Materials, LoadError> {
    let size = Aabb::of_points(raw.positions.iter().copied()).size().length();
    let libraries = read_all(source, raw, files);
    let mut out = Materials { by_name: vec![usize::MAX; raw.material_names.len()], ..Materials::default() };
    let ids: HashMap<_, _> =
        raw.material_names.iter().enumerate().map(|(id, name)| (name.as_str(), id)).collect();
    let mut defined = BTreeSet::new();
    let mut known = Known::default();
    // Of libraries that define the same name, the last one counts, as within one library.
    for (path, bytes) in libraries.iter().rev() {
        let library = SourceText::decode(path, bytes)?;
        for mtl in mtl::parse(&library, &mut raw.warnings)? {
            if let Some(&id) = ids.get(mtl.name.as_str()).filter(|_| !defined.contains(&mtl.name)) {
                let mut textures =
                    Textures { library: &library, files, known: &mut known, warnings: &mut raw.warnings };
                out.by_name[id] = out.materials.len();
                out.materials.push(convert(&mtl, size, &mut textures));
            }
            defined.insert(mtl.name);
        }
    }
    out.textures = known.textures;
    out.add_unknown(source, raw, !libraries.is_empty(), &defined);
    Ok(out)
}

impl Materials {
    /// Grey stands in for materials that no library defines, and for none.
    fn add_unknown(
        &mut self,
        source: &SourceText<'_>,
        raw: &mut RawObj,
        has_library: bool,
        defined: &BTreeSet<String>,
    ) {
        for (id, name) in raw.material_names.iter().enumerate() {
            if self.by_name[id] != usize::MAX {
                continue;
            }
            self.by_name[id] = self.materials.len();
            self.materials.push(neutral(name));
            // A file without any library means the names for other programs.
            if has_library {
                let message = format!("the material {} is not defined: grey stands in", quote(name));
                let warning = source.warning_at(raw.material_offsets[id], message);
                let near = suggestion(name, defined.iter().map(String::as_str));
                raw.warnings.push(match near {
                    Some(help) => warning.with_help(help),
                    None => warning.with_help("define it in the material library"),
                });
            }
        }
        if raw.attributes.iter().any(|attributes| attributes.material.is_none()) {
            self.neutral = self.materials.len();
            self.materials.push(neutral("default"));
        }
    }
}

/// Path and content of each library that can be read; warns of the others.
fn read_all(source: &SourceText<'_>, raw: &mut RawObj, files: &mut dyn ObjFiles) -> Vec<(PathBuf, Vec<u8>)> {
    let mut libraries: Vec<(PathBuf, Vec<u8>)> = Vec::new();
    let mut seen = HashSet::new();
    for (argument, offset) in &raw.libraries {
        for name in library_names(argument) {
            if !seen.insert(name.clone()) {
                continue;
            }
            match files.library(source.path, &name) {
                Ok(library) => libraries.push(library),
                Err(error) => {
                    let report = error.report();
                    let message = format!("material library {}: {}", quote(&name), report.message);
                    let warning = source.warning_at(*offset, message);
                    raw.warnings.push(match &report.help {
                        Some(help) => warning.with_help(help),
                        None => warning,
                    });
                }
            }
        }
    }
    libraries
}

/// The files of one `mtllib` statement. There may be several, and names may hold blanks: where more than one word ends
/// in `.mtl`, a name ends at each of them.
fn library_names(argument: &str) -> Vec<String> {
    let clean = |name: &str| name.trim().trim_matches('"').replace('\\', "/");
    let is_end = |word: &str| word.trim_end_matches('"').to_ascii_lowercase().ends_with(".mtl");
    let ends: Vec<usize> = argument
        .split_whitespace()
        .filter(|word| is_end(word))
        .map(|word| word.as_ptr() as usize - argument.as_ptr() as usize + word.len())
        .collect();
    if ends.len() < 2 {
        return [clean(argument)].into_iter().filter(|name| !name.is_empty()).collect();
    }
    let starts = std::iter::once(0).chain(ends.iter().copied());
    starts.zip(&ends).map(|(start, &end)| clean(&argument[start..end])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_statement_may_name_several_libraries_or_one_with_blanks() {
        assert_eq!(library_names("a.mtl"), ["a.mtl"]);
        assert_eq!(library_names("my file.mtl"), ["my file.mtl"]);
        assert_eq!(library_names("a.mtl my b.MTL  c.mtl"), ["a.mtl", "my b.MTL", "c.mtl"]);
        assert_eq!(library_names(".\\mat\\a.mtl"), ["./mat/a.mtl"]);
        assert_eq!(library_names("\"a b.mtl\""), ["a b.mtl"]);
        assert_eq!(library_names("materials"), ["materials"]);
        assert_eq!(library_names(""), [""; 0]);
    }
}
