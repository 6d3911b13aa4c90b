//! The command line: one file per command.

mod experiment;
mod flags;
mod generate;
mod healthcheck;
mod key;
mod open_files;
mod plan;
mod progress;
mod results;
mod serve;
mod survey;
mod table;
mod terminal;
mod text;
mod verify;

use clap::{Parser, Subcommand};

use self::flags::Unlisted;
use crate::api;
use crate::config::{self, Config, ConfigError, Stated};
use crate::telemetry;

const EXIT_CODES: &str = "\
Exit status: 0 for an answer, whatever its verdict; 2 for bad arguments, settings or scenes, \
with every fault on stderr; 1 for any other failure.";

/// Plans the fewest relocations that free an object on a crowded table, and proves it.
///
/// Without a command it serves HTTP, as `singulate serve` does, and takes the flags of `serve`.
#[derive(Debug, Parser)]
#[command(name = "singulate", version, after_help = EXIT_CODES, args_conflicts_with_subcommands = true)]
pub struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    serve: Unlisted<serve::Serve>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Serve over HTTP
    Serve(serve::Serve),
    /// Plan for the scene in a file
    Plan(plan::Plan),
    /// Check a plan against its scene
    Verify(verify::Verify),
    /// Count the relocations that every movable object would need
    Survey(survey::Survey),
    /// Generate a scene and print it as a request
    Generate(generate::Generate),
    /// Make API keys
    Key(key::Key),
    /// Run one of the paper's tables on generated scenes
    Experiment(experiment::Experiment),
    /// Print the interface document
    Openapi,
    /// Ask a running service whether it is ready
    Healthcheck(healthcheck::Healthcheck),
}

/// Why a command failed.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Failure {
    /// Bad arguments, settings or scene.
    #[error("{0}")]
    Refused(String),
    /// Anything else.
    #[error("{0}")]
    Broken(String),
}

impl Failure {
    /// The process's exit status.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Refused(_) => 2,
            Self::Broken(_) => 1,
        }
    }
}

impl From<ConfigError> for Failure {
    fn from(error: ConfigError) -> Self {
        Self::Refused(error.to_string())
    }
}

impl Cli {
    /// Run the command.
    ///
    /// # Errors
    /// [`Failure`], with what to print on stderr.
    pub fn run(self) -> Result<(), Failure> {
        match self.command.unwrap_or(Command::Serve(self.serve.0)) {
            Command::Serve(command) => command.run(),
            Command::Plan(command) => command.run(),
            Command::Verify(command) => command.run(),
            Command::Survey(command) => command.run(),
            Command::Generate(command) => command.run(),
            Command::Key(command) => command.run(),
            Command::Experiment(command) => command.run(),
            Command::Openapi => terminal::print(&api::openapi_json()),
            Command::Healthcheck(command) => command.run(),
        }
    }
}

/// Load the settings and start logging.
fn configure(stated: &Stated) -> Result<Config, Failure> {
    let config = config::load(stated, std::env::vars_os())?;
    telemetry::init(&config.log, config.log_format, None).map_err(Failure::Broken)?;
    warn_of_variables(&config);
    Ok(config)
}

/// Warns about unknown variables with our prefix; they do no harm.
fn warn_of_variables(config: &Config) {
    for variable in &config.unknown_variables {
        tracing::warn!("{variable}");
    }
}
