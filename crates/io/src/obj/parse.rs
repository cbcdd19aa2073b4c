//! OBJ statements into plain arrays: what the file says, checked, nothing derived.
//!
//! # Source
//! Wavefront Technologies, "Advanced Visualizer Manual", appendix B1 (1995).

use super::face::{Corner, Counts, NONE, corner};
use super::number::finite_list;
use super::raw::{Attributes, Face, GroupName, RawObj};
use super::text::{SourceText, Statement};
use crate::error::{LoadError, quote};
use crate::nearest::nearest_name;
use glam::{Vec2, Vec3};
use std::collections::{HashMap, HashSet};

/// Statements of lines, points, curves and surfaces, which leave no triangles, and of display attributes.
const NOT_DRAWN: [&str; 33] = [
    "l",
    "p",
    "vp",
    "cstype",
    "deg",
    "bmat",
    "step",
    "curv",
    "curv2",
    "surf",
    "parm",
    "trim",
    "hole",
    "scrv",
    "sp",
    "end",
    "con",
    "mg",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "maplib",
    "usemap",
    "shadow_obj",
    "trace_obj",
    "ctech",
    "stech",
    "call",
    "csh",
    "bsp",
    "bzp",
    "cdc",
];

/// Statements that are drawn; the candidates for a misspelt one.
const DRAWN: [&str; 9] = ["v", "vt", "vn", "f", "o", "g", "s", "usemtl", "mtllib"];

/// Different unknown keywords that are reported one by one; a file of rubbish has millions.
const MOST_UNKNOWN: usize = 20;

/// Reads a whole file.
pub(super) fn parse(source: &SourceText<'_>) -> Result<RawObj, LoadError> {
    let mut parser = Parser::new(source);
    for statement in source.statements() {
        parser.statement(&statement)?;
    }
    parser.finish()
}

/// The file so far and the state that the next face gets.
struct Parser<'a> {
    source: &'a SourceText<'a>,
    out: RawObj,
    name: GroupName,
    current: Attributes,
    group_ids: HashMap<GroupName, u32>,
    material_ids: HashMap<String, u32>,
    unknown: HashSet<String>,
    /// Number of statements that were understood.
    understood: usize,
}

impl<'a> Parser<'a> {
    fn new(source: &'a SourceText<'a>) -> Self {
        let out = RawObj { groups: vec![GroupName::default()], ..RawObj::default() };
        Self {
            source,
            out,
            name: GroupName::default(),
            current: Attributes { group: 0, material: None, smoothing: None },
            group_ids: HashMap::from([(GroupName::default(), 0)]),
            material_ids: HashMap::new(),
            unknown: HashSet::new(),
            understood: 0,
        }
    }

    fn statement(&mut self, statement: &Statement<'_>) -> Result<(), LoadError> {
        self.understood += 1;
        match statement.keyword {
            "v" => self.vertex(statement)?,
            "vt" => self.texture_coordinate(statement)?,
            "vn" => self.normal(statement)?,
            // `fo` is the name of `f` in files of version 2.
            "f" | "fo" => self.face(statement)?,
            "o" => {
                self.name = GroupName { object: statement.name().to_owned(), group: String::new() };
                self.enter_group();
            }
            "g" => {
                // Several names are several memberships; a triangle is in one place here.
                self.name.group = statement.words().collect::<Vec<_>>().join(" ");
                self.enter_group();
            }
            "s" => self.smoothing(statement)?,
            "usemtl" => self.use_material(statement),
            "mtllib" => {
                let offset = self.source.offset(statement.keyword);
                self.out.libraries.push((statement.name().to_owned(), offset));
            }
            _ => {
                self.understood -= 1;
                self.unknown_statement(statement);
            }
        }
        Ok(())
    }

    fn vertex(&mut self, statement: &Statement<'_>) -> Result<(), LoadError> {
        let mut n = [0.0; 8];
        let expected = "x y z, then optionally w, or r g b";
        let count = finite_list(self.source, statement, 3..=8, expected, &mut n)?;
        // 4: a weight, for curves only. 6 and 7: r g b (a). 8: a weight and r g b a.
        let color = match count {
            6 | 7 => Some(Vec3::new(n[3], n[4], n[5])),
            8 => Some(Vec3::new(n[4], n[5], n[6])),
            _ => None,
        };
        if color.is_some() && self.out.colors.is_empty() {
            self.out.colors.resize(self.out.positions.len(), None);
        }
        self.out.positions.push(Vec3::new(n[0], n[1], n[2]));
        if color.is_some() || !self.out.colors.is_empty() {
            self.out.colors.push(color);
        }
        Ok(())
    }

    fn texture_coordinate(&mut self, statement: &Statement<'_>) -> Result<(), LoadError> {
        let mut n = [0.0; 3];
        finite_list(self.source, statement, 1..=3, "u, then optionally v and w", &mut n)?;
        self.out.uvs.push(Vec2::new(n[0], n[1]));
        Ok(())
    }

    fn normal(&mut self, statement: &Statement<'_>) -> Result<(), LoadError> {
        let mut n = [0.0; 3];
        finite_list(self.source, statement, 3..=3, "x y z", &mut n)?;
        // In `f64`: the squares of an `f32` may overflow or vanish.
        let unit = glam::DVec3::new(n[0].into(), n[1].into(), n[2].into()).normalize_or_zero();
        self.out.normals.push(unit.as_vec3());
        Ok(())
    }

    fn face(&mut self, statement: &Statement<'_>) -> Result<(), LoadError> {
        let counts = Counts {
            positions: self.out.positions.len(),
            uvs: self.out.uvs.len(),
            normals: self.out.normals.len(),
        };
        let first = self.out.corners.len();
        for word in statement.words() {
            self.out.corners.push(corner(self.source, word, counts)?);
        }
        let corners = self.out.corners.len() - first;
        if corners < 3 {
            let message = format!("a face needs at least 3 corners, this one has {corners}");
            let error = self.source.error(statement.keyword, message);
            return Err(error.with_help("add the missing corners or remove the line"));
        }
        if self.out.attributes.last() != Some(&self.current) {
            self.out.attributes.push(self.current);
        }
        // The limit on the size of the file keeps all three below 2^32.
        self.out.faces.push(Face {
            first: first as u32,
            attributes: (self.out.attributes.len() - 1) as u32,
            offset: self.source.offset(statement.keyword) as u32,
        });
        Ok(())
    }

    fn enter_group(&mut self) {
        self.current.group = match self.group_ids.get(&self.name) {
            Some(&id) => id,
            None => {
                let id = self.out.groups.len() as u32;
                self.out.groups.push(self.name.clone());
                self.group_ids.insert(self.name.clone(), id);
                id
            }
        };
    }

    fn smoothing(&mut self, statement: &Statement<'_>) -> Result<(), LoadError> {
        let word = statement.words().next().unwrap_or("off");
        let group = match word {
            "off" => Some(0),
            "on" => Some(1),
            // Numbers are names here; some programs write them with a sign or a point.
            _ => word.parse::<f64>().ok().filter(|n| n.is_finite()).map(|n| n.abs() as u32),
        };
        let Some(group) = group else {
            let error = self.source.error(word, format!("{} is not a smoothing group", quote(word)));
            return Err(error.with_help("expected a number or `off`"));
        };
        self.current.smoothing = Some(group);
        Ok(())
    }

    fn use_material(&mut self, statement: &Statement<'_>) {
        let name = statement.name();
        let id = match self.material_ids.get(name) {
            Some(&id) => id,
            None => {
                let id = self.out.material_names.len() as u32;
                self.out.material_names.push(name.to_owned());
                self.out.material_offsets.push(self.source.offset(statement.keyword));
                self.material_ids.insert(name.to_owned(), id);
                id
            }
        };
        self.current.material = Some(id);
    }

    /// Warns once per keyword.
    fn unknown_statement(&mut self, statement: &Statement<'_>) {
        let keyword = statement.keyword;
        if self.unknown.len() >= MOST_UNKNOWN || self.unknown.contains(keyword) {
            return;
        }
        self.unknown.insert(keyword.to_owned());
        let warning = if NOT_DRAWN.contains(&keyword) {
            let message = format!("`{keyword}` is left out: only polygons are drawn");
            self.source.warning(keyword, message)
        } else {
            let warning =
                self.source.warning(keyword, format!("the statement {} is not known", quote(keyword)));
            match nearest_name(keyword, DRAWN).filter(|_| keyword.len() > 1) {
                Some(near) => warning.with_help(format!("did you mean `{near}`?")),
                None => warning,
            }
        };
        self.out.warnings.push(warning);
    }

    fn finish(mut self) -> Result<RawObj, LoadError> {
        if self.understood == 0 {
            let error = LoadError::new(self.source.path, "holds no OBJ statement");
            return Err(error.with_help("an OBJ file has lines such as `v 0 0 0` and `f 1 2 3`"));
        }
        if self.out.faces.is_empty() {
            let error = LoadError::new(self.source.path, "holds no faces: there is nothing to draw");
            return Err(error.with_help("export polygons; points, lines and curves are not drawn"));
        }
        self.check_ranges()?;
        self.out.scale_byte_colors();
        Ok(self.out)
    }

    /// Refuses faces that name what never comes.
    fn check_ranges(&self) -> Result<(), LoadError> {
        let out = &self.out;
        let missing = |c: &Corner| {
            let beyond = |index: u32, count: usize| index != NONE && index as usize >= count;
            if beyond(c.position, out.positions.len()) {
                Some(("vertex", c.position, out.positions.len()))
            } else if beyond(c.uv, out.uvs.len()) {
                Some(("texture coordinate", c.uv, out.uvs.len()))
            } else if beyond(c.normal, out.normals.len()) {
                Some(("normal", c.normal, out.normals.len()))
            } else {
                None
            }
        };
        let Some((at, (what, index, count))) =
            out.corners.iter().enumerate().find_map(|(i, c)| missing(c).map(|m| (i, m)))
        else {
            return Ok(());
        };
        let face = out.faces.partition_point(|face| face.first as usize <= at) - 1;
        let offset = out.faces[face].offset as usize;
        let number = u64::from(index) + 1;
        let error =
            self.source.error_at(offset, format!("this face uses {what} {number}, which does not exist"));
        Err(error.with_help(format!("the file has {count}")))
    }
}
