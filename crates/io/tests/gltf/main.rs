//! glTF: features with models made here, real models, and damaged ones.

mod assets;
mod damage;
mod features;
mod made;
