//! The exit codes, part of the promise to scripts and farms; `heliostat --help` lists them.

use std::process::ExitCode;

/// How the process ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Exit {
    /// Everything that was asked for is there.
    Done,
    /// The render failed, or a comparison is past its limit.
    Failed,
    /// The command line is wrong.
    Usage,
    /// A scene or an asset is wrong.
    Input,
    /// An output could not be written.
    Output,
    /// A signal of this number came; the picture with the samples so far is saved.
    Signal(u8),
}

impl Exit {
    /// The number that the shell sees.
    pub(crate) fn code(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::Failed => 1,
            Self::Usage => 2,
            Self::Input => 3,
            Self::Output => 4,
            Self::Signal(number) => 128 + number,
        }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit.code())
    }
}
