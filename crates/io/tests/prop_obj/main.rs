//! Laws of the OBJ reader: it agrees with `tobj` on well-formed files, survives damaged ones, covers polygons once and makes
//! the normals that the shape has.

mod damage;
#[path = "../obj/memory.rs"]
mod memory;
#[path = "../obj/models.rs"]
mod models;
mod oracle;
mod shapes;
