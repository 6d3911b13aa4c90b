//! `singulate verify`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::flags::Flags;
use super::terminal::Stopwatch;
use super::{Failure, configure, terminal, text};
use crate::wire::{VerificationBody, read_plan};
use singulate_planner::budget::Budget;
use singulate_planner::check::check;

/// The arguments of `verify`.
#[derive(Debug, Args)]
pub(super) struct Verify {
    /// The scene; `-` reads stdin
    scene: PathBuf,
    /// The plan, as `plan` prints it, or just its `relocations` and `target_grasp`; `-` reads stdin
    plan: PathBuf,
    /// json: the answer of POST /v1/plans/verify, for programs; text: for people
    #[arg(long, value_enum, default_value_t)]
    format: Format,
    #[command(flatten)]
    flags: Flags<false>,
}

/// How `verify` and `survey` answer.
#[derive(Debug, Clone, Copy, Default, ValueEnum)]
pub(super) enum Format {
    #[default]
    Json,
    Text,
}

impl Verify {
    pub(super) fn run(self) -> Result<(), Failure> {
        if self.scene.as_os_str() == "-" && self.plan.as_os_str() == "-" {
            return Err(Failure::Refused("scene and plan can't both be read from stdin".to_owned()));
        }
        let config = configure(&self.flags.0)?;
        let request = terminal::scene(&self.scene, &config.server.limits)?;
        let plan = terminal::bytes(&self.plan)?;
        let statement = read_plan(&plan, &request.scene).map_err(|problem| terminal::refused(&self.plan, &problem))?;
        let clock = Stopwatch::start();
        let report = check(&request.scene, &statement, &Budget::new(&clock, request.time_limit));
        match self.format {
            Format::Json => terminal::print_json(&VerificationBody::new(&report)),
            Format::Text => terminal::print(&text::verification(&VerificationBody::new(&report))),
        }
    }
}
