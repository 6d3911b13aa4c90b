//! `singulate survey`.

use std::path::PathBuf;

use clap::Args;

use super::flags::Flags;
use super::plan::failed;
use super::terminal::Stopwatch;
use super::verify::Format;
use super::{Failure, configure, terminal, text};
use crate::wire::SurveyBody;
use singulate_planner::budget::Budget;
use singulate_planner::plan::survey;

/// The arguments of `survey`.
#[derive(Debug, Args)]
pub(super) struct Survey {
    /// The scene; `-` reads stdin. Its target or goal does not change the answer
    scene: PathBuf,
    /// json: the answer of POST /v1/survey, for programs; text: for people
    #[arg(long, value_enum, default_value_t)]
    format: Format,
    #[command(flatten)]
    flags: Flags<false>,
}

impl Survey {
    pub(super) fn run(self) -> Result<(), Failure> {
        let config = configure(&self.flags.0)?;
        let request = terminal::scene(&self.scene, &config.server.limits)?;
        let clock = Stopwatch::start();
        let entries = survey(&request.scene, &Budget::new(&clock, request.time_limit));
        let entries = entries.map_err(|error| failed(&self.scene, &error))?;
        match self.format {
            Format::Json => terminal::print_json(&SurveyBody::new(&request.scene, &entries)),
            Format::Text => terminal::print(&text::survey(&request.scene, &entries)),
        }
    }
}
