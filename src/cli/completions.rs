//! `completions`: shell completions from the same definitions as the help.

use clap::{Args, CommandFactory};

use super::{CommandLine, Ending, output};

/// Print shell completions
#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  striae completions bash > ~/.local/share/bash-completion/completions/striae"
)]
pub(super) struct Arguments {
    /// Which shell
    shell: clap_complete::Shell,
}

pub(super) fn run(arguments: &Arguments) -> anyhow::Result<Ending> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut CommandLine::command(), "striae", &mut script);
    output::to_stdout(&String::from_utf8_lossy(&script))?;
    Ok(Ending::Done)
}
