//! The `singulate` binary.

use std::io::Write;
use std::process::ExitCode;

use clap::Parser;
use singulate::cli::Cli;

fn main() -> ExitCode {
    match Cli::parse().run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            // Nobody can be told where stderr is gone.
            let _ = writeln!(std::io::stderr(), "{failure}");
            ExitCode::from(failure.exit_code())
        }
    }
}
