//! What the checks across crates share: finding the scenes, rendering them small, and comparing pictures by statistics.

pub mod golden;
pub mod scenes;
