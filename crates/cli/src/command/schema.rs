//! `heliostat schema`: the JSON Schema of the scene file, on standard output.

use crate::exit::Exit;
use crate::out;

/// Prints the schema.
pub(crate) fn run() -> Exit {
    out::line(format_args!("{:#}", heliostat_io::schema::json_schema()));
    Exit::Done
}
