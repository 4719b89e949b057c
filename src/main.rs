//! The command line of striae; see `striae::cli`.

use std::process::ExitCode;

fn main() -> ExitCode {
    striae::cli::main()
}
