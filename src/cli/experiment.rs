//! `singulate experiment`.

use core::time::Duration;
use std::thread::available_parallelism;

use clap::builder::RangedU64ValueParser;
use clap::{Args, Subcommand};

use super::plan::withheld;
use super::progress::Progress;
use super::verify::Format;
use super::{Failure, results, terminal};
use crate::experiments::{EpisodeError, ExperimentError, ExperimentSettings, table1, table2};
use crate::wire::{Table1Body, Table2Body};
use singulate_planner::plan::PlanError;

/// The most episodes in a column: the seeds of the next column begin after them.
const MAX_EPISODES: u64 = 1_000_000;

/// How to run Table III.
const TABLE3: &str = "\
Table III carries plans out in physics. This program does not do that. A client like any other does: it
asks the service for plans and has a simulated robot carry them out. It needs Python 3.11 and is called in
the project's folder:

  client-examples/robot-cell/run table3        the table, by our methods and by the paper's
  client-examples/robot-cell/run relocations   what goes wrong where the robot makes no error
  client-examples/robot-cell/run noise         how large the camera's errors may be
  client-examples/robot-cell/run film          one episode as a moving picture

client-examples/robot-cell/README.md explains these commands, docs/RESULTS.md has the figures.
";

/// The arguments of `experiment`.
#[derive(Debug, Args)]
pub(super) struct Experiment {
    #[command(subcommand)]
    table: PaperTable,
}

#[derive(Debug, Subcommand)]
enum PaperTable {
    /// Table I: deadlocks, successes, search time and relocations of the baseline, LOBS and ours
    #[command(after_help = results::NOT_THE_SAME)]
    Table1 {
        #[command(flatten)]
        arguments: TableArguments,
        /// Episodes for the baseline, which may take the whole time limit for each [default: episodes, at most 20]
        #[arg(long, value_name = "N")]
        base_episodes: Option<usize>,
    },
    /// Table II: places for the sequences that LOBS finds, by the paper's method and ours
    #[command(after_help = results::NOT_THE_SAME)]
    Table2 {
        #[command(flatten)]
        arguments: TableArguments,
    },
    /// Table III: says how to carry plans out in physics, which is another program's work
    Table3,
}

#[derive(Debug, Args)]
struct TableArguments {
    /// Episodes in each column
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = RangedU64ValueParser::<usize>::new().range(1..=MAX_EPISODES))]
    episodes: usize,
    /// The same seed gives the same scenes, on any machine
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Time limit of each search and each plan, ms
    #[arg(long, value_name = "MS", default_value_t = 60_000, value_parser = clap::value_parser!(u64).range(1..))]
    time_limit_ms: u64,
    /// Episodes run at a time; in each the baseline may hold 5,000,000 sets of objects [default: one per core]
    #[arg(long, value_name = "N", value_parser = RangedU64ValueParser::<usize>::new().range(1..=1024))]
    jobs: Option<usize>,
    /// json: for programs; text: for people
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

impl Experiment {
    pub(super) fn run(self) -> Result<(), Failure> {
        match self.table {
            PaperTable::Table1 { arguments, base_episodes } => {
                let settings = arguments.settings(base_episodes)?;
                let columns = measured(|told| table1(&settings, told))?;
                match arguments.format {
                    Format::Json => terminal::print_json(&Table1Body::new(&settings, &columns)),
                    Format::Text => terminal::print(&results::table1(&settings, &columns)),
                }
            }
            PaperTable::Table2 { arguments } => {
                let settings = arguments.settings(Some(0))?;
                let columns = measured(|told| table2(&settings, told))?;
                match arguments.format {
                    Format::Json => terminal::print_json(&Table2Body::new(&settings, &columns)),
                    Format::Text => terminal::print(&results::table2(&settings, &columns)),
                }
            }
            PaperTable::Table3 => terminal::print(TABLE3),
        }
    }
}

/// The columns of a table, with the progress told meanwhile.
fn measured<T>(table: impl FnOnce(&mut dyn FnMut(usize, usize)) -> Result<T, ExperimentError>) -> Result<T, Failure> {
    let mut progress = Progress::start();
    let columns = table(&mut |done, total| progress.tell(done, total));
    progress.end();
    columns.map_err(|error| failed(&error))
}

impl TableArguments {
    /// Fails if the baseline would have more episodes than there are.
    fn settings(&self, base_episodes: Option<usize>) -> Result<ExperimentSettings, Failure> {
        let episodes = self.episodes;
        let base_episodes = base_episodes.unwrap_or(episodes.min(20));
        if base_episodes > episodes {
            let detail = format!("--base-episodes {base_episodes}: there are {episodes} episodes (--episodes)");
            return Err(Failure::Refused(detail));
        }
        Ok(ExperimentSettings {
            episodes,
            base_episodes,
            seed: self.seed,
            time_limit: Duration::from_millis(self.time_limit_ms),
            jobs: self.jobs.unwrap_or_else(|| available_parallelism().map_or(1, usize::from)),
        })
    }
}

fn failed(error: &ExperimentError) -> Failure {
    match &error.cause {
        EpisodeError::Plan(PlanError::Refused(report)) => withheld(error, report),
        _ => Failure::Broken(error.to_string()),
    }
}
