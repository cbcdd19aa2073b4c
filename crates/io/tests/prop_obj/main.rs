//! Laws of the OBJ reader: it agrees with `tobj` on well-formed files and survives damaged ones.

mod damage;
#[path = "../obj/memory.rs"]
mod memory;
#[path = "../obj/models.rs"]
mod models;
mod oracle;
