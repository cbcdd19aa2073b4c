//! The built binary, run as users and farms run it.

mod common;
mod denoise;
mod determinism;
mod exit_codes;
mod frames;
mod help;
mod images;
mod pipes;
mod replay;
#[cfg(unix)]
mod signals;
mod stats;
mod video;
mod wrong_inputs;
