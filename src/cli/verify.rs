//! `singulate verify`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::flags::Flags;
use super::terminal::Stopwatch;
use super::{Failure, configure, terminal, text};
use crate::wire::{VerificationBody, read_plan};
use singulate_planner::budget::Budget;
use singulate_planner::check::{POSITION_TOLERANCE_RANGE, Terms, check_on};

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
    /// How far an object may stand from the `from` of its step, m; above 0, stated slacks and gaps are not compared
    #[arg(long, value_name = "M", default_value_t = 0.0, value_parser = position_tolerance)]
    position_tolerance: f64,
    /// The plan has only the steps that are left, or the next one; `target_grasp` may be absent
    #[arg(long)]
    partial: bool,
    #[command(flatten)]
    flags: Flags<false>,
}

fn position_tolerance(text: &str) -> Result<f64, String> {
    let (min, max) = POSITION_TOLERANCE_RANGE;
    let metres: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    if (min..=max).contains(&metres) { Ok(metres) } else { Err(format!("{metres} is not between {min} and {max}")) }
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
        let statement = read_plan(&plan, &request.scene, self.partial)
            .map_err(|problem| terminal::refused(&self.plan, &problem))?;
        let clock = Stopwatch::start();
        let terms = Terms { position_tolerance: self.position_tolerance, partial: self.partial };
        let report = check_on(&request.scene, &statement, &terms, &Budget::new(&clock, request.time_limit));
        match self.format {
            Format::Json => terminal::print_json(&VerificationBody::new(&report)),
            Format::Text => terminal::print(&text::verification(&request.scene, &VerificationBody::new(&report))),
        }
    }
}
