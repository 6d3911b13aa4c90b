//! `singulate plan`.

use std::fmt::Display;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use super::flags::Flags;
use super::terminal::Stopwatch;
use super::{Failure, configure, terminal, text};
use crate::render;
use crate::wire::{AnswerBody, Problem, VerificationBody};
use singulate_planner::budget::Budget;
use singulate_planner::check::Report;
use singulate_planner::paper::plan_by;
use singulate_planner::plan::PlanError;
use singulate_planner::search::SILENT;

/// The arguments of `plan`.
#[derive(Debug, Args)]
pub(super) struct Plan {
    /// The scene, a request body of POST /v1/plans; `-` reads stdin
    scene: PathBuf,
    /// json: the answer of POST /v1/plans, for programs; text: for people; svg: a drawing
    #[arg(long, value_enum, default_value_t)]
    format: Format,
    #[command(flatten)]
    flags: Flags<false>,
}

#[derive(Debug, Clone, Copy, Default, ValueEnum)]
enum Format {
    #[default]
    Json,
    Text,
    Svg,
}

impl Plan {
    pub(super) fn run(self) -> Result<(), Failure> {
        let config = configure(&self.flags.0)?;
        let request = terminal::scene(&self.scene, &config.server.limits)?;
        let clock = Stopwatch::start();
        let budget = Budget::new(&clock, request.time_limit);
        let judged = plan_by(&request.methods, &request.scene, &request.settings, &budget, SILENT)
            .map_err(|error| failed(&self.scene, &error))?;
        match self.format {
            Format::Json => terminal::print_json(&AnswerBody::new(&request, &judged)),
            Format::Text => terminal::print(&text::answer(&request, &judged)),
            Format::Svg => terminal::print(&render::svg(&request.scene, &judged)),
        }
    }
}

/// There is no answer: the scene is too dense, or the answer failed its check, a bug that is reported with the
/// checker's faults.
pub(super) fn failed(scene: &Path, error: &PlanError) -> Failure {
    let PlanError::Refused(report) = error else {
        return terminal::refused(scene, &Problem::too_dense(error.to_string()));
    };
    withheld(error, report)
}

/// A bug of ours: the answer failed its check.
pub(super) fn withheld(error: &impl Display, report: &Report) -> Failure {
    let mut lines = vec![error.to_string()];
    lines.extend(VerificationBody::new(report).faults.iter().map(text::fault));
    Failure::Broken(lines.join("\n"))
}
