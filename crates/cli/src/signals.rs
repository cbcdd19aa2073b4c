//! Ctrl-C and SIGTERM: the first one asks for an orderly stop, the second one ends the process at once.
//!
//! # Source
//! The `signal-hook` documentation, `flag::register_conditional_shutdown`: the shutdown is registered before the flag
//! is, so that the first signal finds the flag down and the second one finds it up.

use crate::diagnose::Failure;
use crate::exit::Exit;
use signal_hook::consts::signal::{SIGINT, SIGTERM};
use signal_hook::flag;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// What the signal handlers have seen.
#[derive(Debug)]
pub(crate) struct Signals {
    stop: Arc<AtomicBool>,
    number: Arc<AtomicUsize>,
}

impl Signals {
    /// Installs the handlers, for the rest of the process.
    pub(crate) fn install() -> Result<Self, Failure> {
        Self::register().map_err(|e| {
            Failure::new(Exit::Failed, format!("signals cannot be caught: {e}; start it in another shell"))
        })
    }

    fn register() -> std::io::Result<Self> {
        let signals = Self { stop: Arc::default(), number: Arc::default() };
        for signal in [SIGINT, SIGTERM] {
            flag::register_conditional_shutdown(signal, 128 + signal, Arc::clone(&signals.stop))?;
            let number = usize::try_from(signal).unwrap_or_default();
            flag::register_usize(signal, Arc::clone(&signals.number), number)?;
            flag::register(signal, Arc::clone(&signals.stop))?;
        }
        Ok(signals)
    }

    /// The flag that a render watches between tiles.
    pub(crate) fn stop(&self) -> &AtomicBool {
        &self.stop
    }

    /// How the process is to end, when a signal came.
    pub(crate) fn exit(&self) -> Option<Exit> {
        let raised = self.stop.load(Ordering::SeqCst);
        let number = u8::try_from(self.number.load(Ordering::SeqCst)).unwrap_or_default();
        raised.then_some(Exit::Signal(number))
    }
}
