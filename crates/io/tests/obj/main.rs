//! OBJ and MTL: every feature with a file of a few lines, and real models.

mod assets;
mod features;
mod memory;
mod models;
