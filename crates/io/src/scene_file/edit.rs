//! Setting one value of a document by its path: what keyframes and `--set` have in common.
//!
//! A path is a section, the name of one of its tables where it has several, and keys (for an object of a group
//! `group.NAME.object.NAME` and keys); an index, or `x`, `y`, `z`, picks a component of an array. A number that stands for an array (`scale = 2`, a grey) becomes that array when
//! a component of it is set, and so does a `translate`, `rotate`, `scale`, `position` or `up` that was left out.

use super::names::implicit_name;
use crate::document::{Fault, Key, Node, Segment, Span, Table, Value};
use crate::error::quote;

/// Sections that hold several named tables.
const LISTS: [&str; 8] = ["texture", "medium", "material", "mesh", "model", "object", "group", "light"];

/// Puts `value` at `path`.
///
/// # Errors
/// Where no table or component has such a name; the place is that part of the path.
pub(crate) fn set(root: &mut Node, path: &[Segment], value: Node) -> Result<(), Fault> {
    let Value::Table(sections) = &mut root.value else { return Ok(()) };
    let (section, rest) = (&path[0], &path[1..]);
    if rest.is_empty() {
        return Err(whole_table(path));
    }
    if LISTS.contains(&section.text.as_str()) && sections.get(&section.text).is_none() {
        return Err(Fault::new(format!("there is no [[{}]] to set a value in", section.text))
            .with_help(format!("add a [[{}]]", section.text))
            .or_at(section.span));
    }
    let node = sections.entry(key(section), || empty_table(section.span));
    let editor = Editor { section: &section.text, path };
    if let Value::Array(tables) = &mut node.value {
        return editor.set_in_list(tables, 1, value);
    }
    let start = if names_single_camera(path, node) { 2 } else { 1 };
    editor.set_in(node, start, value)
}

/// Whether the path is `camera.NAME...` and the file has a single `[camera]` of that name.
fn names_single_camera(path: &[Segment], node: &Node) -> bool {
    let (Value::Table(table), "camera") = (&node.value, path[0].text.as_str()) else { return false };
    path.len() > 2 && table.get(&path[1].text).is_none() && table_name("camera", 0, table) == path[1].text
}

struct Editor<'a> {
    section: &'a str,
    path: &'a [Segment],
}

impl Editor<'_> {
    /// Goes on in the table of a list that the part `at` names; the part before is the name of the list.
    fn set_in_list(&self, tables: &mut [Node], at: usize, value: Node) -> Result<(), Fault> {
        let (section, segment) = (self.path[at - 1].text.as_str(), &self.path[at]);
        let names: Vec<String> = tables
            .iter()
            .enumerate()
            .map(|(i, node)| match &node.value {
                Value::Table(table) => table_name(section, i, table),
                _ => implicit_name(section, i, None),
            })
            .collect();
        let by_name = names.iter().position(|name| *name == segment.text);
        let by_index = || segment.index().filter(|&i| i < tables.len());
        let Some(index) = by_name.or_else(by_index) else {
            return Err(
                Fault::unknown(section, &segment.text, names.iter().map(String::as_str)).or_at(segment.span)
            );
        };
        if self.path.len() == at + 1 {
            return Err(whole_table(self.path));
        }
        self.set_in(&mut tables[index], at + 1, value)
    }

    /// Puts the value at the rest of the path from `at` on.
    fn set_in(&self, node: &mut Node, at: usize, value: Node) -> Result<(), Fault> {
        let Some(segment) = self.path.get(at) else {
            *node = value;
            return Ok(());
        };
        if node.number().is_some() && segment.index().is_some() {
            self.spread(node, segment.span);
        }
        let kind = node.kind();
        match &mut node.value {
            Value::Table(table) => {
                if at + 1 == self.path.len() {
                    *table.entry(key(segment), || empty_table(segment.span)) = value;
                    return Ok(());
                }
                let child = || self.absent(segment, &self.path[at + 1]);
                self.set_in(table.entry(key(segment), child), at + 1, value)
            }
            Value::Array(tables) if self.is_list_of_group(at) => self.set_in_list(tables, at, value),
            Value::Array(items) => {
                let count = items.len();
                match segment.index().and_then(|i| items.get_mut(i)) {
                    Some(item) => self.set_in(item, at + 1, value),
                    None => Err(Fault::new(format!("there is no component {}", quote(&segment.text)))
                        .with_help(format!("choose 0 to {}", count.saturating_sub(1)))
                        .or_at(segment.span)),
                }
            }
            // Reading it will tell.
            Value::Refused(_) => Ok(()),
            _ => {
                let before = &self.path[at - 1];
                Err(Fault::new(format!("{} is {kind}, it has no parts", quote(&before.text)))
                    .with_help(format!("end the path at {}", quote(&before.text)))
                    .or_at(segment.span))
            }
        }
    }

    /// Whether the part `at` names an object of a group.
    fn is_list_of_group(&self, at: usize) -> bool {
        self.section == "group" && at == 3 && self.path[2].text == "object"
    }

    /// Makes the array that a number stands for.
    fn spread(&self, node: &mut Node, span: Span) {
        let count = if self.section == "texture" { 2 } else { 3 };
        *node = Node { span, value: Value::Array(vec![node.clone(); count]) };
    }

    /// What stands for a key that is left out, when the path goes on with `next`.
    fn absent(&self, segment: &Segment, next: &Segment) -> Node {
        let numbers: &[f64] = match (self.section, segment.text.as_str()) {
            ("texture", "scale") => &[1.0, 1.0],
            ("texture", "offset") => &[0.0, 0.0],
            (_, "scale") => &[1.0, 1.0, 1.0],
            (_, "translate" | "rotate") | ("camera", "position") => &[0.0, 0.0, 0.0],
            ("camera", "up") => &[0.0, 1.0, 0.0],
            _ if next.index().is_some() => return without_components(segment),
            _ => return empty_table(segment.span),
        };
        let item = |&number: &f64| Node { span: segment.span, value: Value::Float(number) };
        Node { span: segment.span, value: Value::Array(numbers.iter().map(item).collect()) }
    }
}

/// Stands for a key that is left out and has no array to take a component of. It is refused when it is read,
/// because an unknown key is refused before that.
fn without_components(segment: &Segment) -> Node {
    let name = quote(&segment.text);
    let fault = Fault::new(format!("{name} is not in the file, so it has no components"))
        .with_help(format!("write {name} there, or set all of it"));
    Node { span: segment.span, value: Value::Refused(fault) }
}

fn key(segment: &Segment) -> Key {
    Key { text: segment.text.clone(), span: segment.span }
}

fn empty_table(span: Span) -> Node {
    Node { span, value: Value::Table(Table::default()) }
}

/// The name by which a path finds a table.
fn table_name(section: &str, index: usize, table: &Table) -> String {
    let text = |key: &str| match table.get(key).map(|node| &node.value) {
        Some(Value::Text(text)) => Some(text.as_str()),
        _ => None,
    };
    match text("name") {
        Some(name) => name.to_owned(),
        None => implicit_name(section, index, text("file")),
    }
}

fn whole_table(path: &[Segment]) -> Fault {
    let last = &path[path.len() - 1];
    Fault::new(format!("{} is a table, not a value", quote(&last.text)))
        .with_help("go on with a dot and one of its keys")
        .or_at(last.span)
}
