//! `heliostat completions` and `heliostat man`: what packagers install.

use clap::Args;
use clap_complete::Shell;
use std::path::PathBuf;

/// Print the completion script of a shell
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    heliostat completions bash > ~/.local/share/bash-completion/completions/heliostat\n  \
    heliostat completions zsh > ~/.zfunc/_heliostat\n  \
    heliostat completions fish > ~/.config/fish/completions/heliostat.fish")]
pub(crate) struct CompletionsArgs {
    /// The shell
    pub(crate) shell: Shell,
}

/// Print the manual page, or write one page per command
#[derive(Debug, Args)]
#[command(
    after_help = "Examples:\n  heliostat man | man -l -\n  heliostat man --dir /usr/local/share/man/man1"
)]
pub(crate) struct ManArgs {
    /// Write heliostat.1, heliostat-render.1 and so on into this folder
    #[arg(long, value_name = "FOLDER")]
    pub(crate) dir: Option<PathBuf>,
}
