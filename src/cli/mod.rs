//! The command line: one thin file per verb, which calls the modules above and prints.

mod assignment;
mod report;
mod bench;
mod bench_targets;
mod all;
mod check;
mod compare;
mod compare_text;
mod completions;
mod context;
mod data;
mod doctor;
mod emit;
mod eval;
mod exit;
mod factor;
mod factor_pictures;
mod factor_table;
mod fit;
mod fit_table;
mod import;
mod list;
mod output;
mod points;
mod render;
mod simulate;

use std::process::ExitCode;

use clap::{Args, Parser, Subcommand};

use crate::counted::{COUNT_VERB, count_kernels};
pub use exit::Ending;

const EXIT_CODES: &str = "\
Exit codes: 0 done, 1 a gate failed, 2 bad usage or bad input, 3 a fit did not converge,
4 a GPU was required and none was found.

Example:
  striae list forms";

/// Fits and validates the approximations that real-time renderers use for scratched, glinting and
/// diffractive surfaces.
///
/// Results go to stdout, progress and diagnostics to stderr. A project is a folder with `fits/`;
/// it is found by walking up from the current folder.
#[derive(Debug, Parser)]
#[command(name = "striae", version, about, long_about, after_help = EXIT_CODES, max_term_width = 100)]
pub struct CommandLine {
    #[command(flatten)]
    global: Global,
    #[command(subcommand)]
    verb: Verb,
}

/// Options that every verb takes.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Everywhere")]
pub struct Global {
    /// Print JSON instead of tables
    #[arg(long, global = true)]
    json: bool,
    /// Print results and errors only, no notes and no progress
    #[arg(long, global = true)]
    quiet: bool,
    /// Whether headings and verdicts are coloured; NO_COLOR turns auto off
    #[arg(long, global = true, value_name = "WHEN", default_value_t = clap::ColorChoice::Auto)]
    color: clap::ColorChoice,
    /// Threads to use; no result depends on it [default: all cores]
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// Seed of every random choice [default: the spec's]
    #[arg(long, global = true, value_name = "N")]
    seed: Option<u64>,
    /// Project folder [default: $STRIAE_PROJECT, else found from the current folder upwards]
    #[arg(long, global = true, value_name = "DIR")]
    project: Option<std::path::PathBuf>,
}

#[derive(Debug, Subcommand)]
enum Verb {
    All(all::Arguments),
    List(list::Arguments),
    Fit(fit::Arguments),
    Factor(factor::Arguments),
    Eval(eval::Arguments),
    Simulate(simulate::Arguments),
    Render(render::Arguments),
    Bench(bench::Arguments),
    Report(report::Arguments),
    Check(check::Arguments),
    Compare(compare::Arguments),
    Emit(emit::Arguments),
    Import(import::Arguments),
    Doctor(doctor::Arguments),
    Completions(completions::Arguments),
    /// Counts kernels for a parent; see `striae::counted`.
    #[command(hide = true, name = COUNT_VERB)]
    CountKernels,
}

/// Reads the command line, runs its verb and returns the process's exit code.
pub fn main() -> ExitCode {
    let line = CommandLine::parse();
    let json = line.global.json;
    match run(line) {
        Ok(ending) => ending.into(),
        Err(error) => exit::report(&error, json).into(),
    }
}

fn run(line: CommandLine) -> anyhow::Result<Ending> {
    let context = context::Context::new(&line.global)?;
    match line.verb {
        Verb::All(arguments) => all::run(&arguments, &context),
        Verb::List(arguments) => list::run(&arguments, &context),
        Verb::Fit(arguments) => fit::run(&arguments, &context),
        Verb::Factor(arguments) => factor::run(&arguments, &context),
        Verb::Eval(arguments) => eval::run(&arguments, &context),
        Verb::Simulate(arguments) => simulate::run(&arguments, &context),
        Verb::Render(arguments) => render::run(&arguments, &context),
        Verb::Bench(arguments) => bench::run(&arguments, &context),
        Verb::Report(arguments) => report::run(&arguments, &context),
        Verb::Check(arguments) => check::run(&arguments, &context),
        Verb::Compare(arguments) => compare::run(&arguments, &context),
        Verb::Emit(arguments) => emit::run(&arguments, &context),
        Verb::Import(arguments) => import::run(&arguments, &context),
        Verb::Doctor(arguments) => doctor::run(&arguments, &context),
        Verb::Completions(arguments) => completions::run(&arguments),
        Verb::CountKernels => {
            count_kernels(std::io::stdin(), std::io::stdout())?;
            Ok(Ending::Done)
        }
    }
}
