//! `singulate key`.

use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::{Failure, terminal};
use crate::keys::{FreshKey, Rate, Scopes, append};

/// The arguments of `key`.
#[derive(Debug, Args)]
pub(super) struct Key {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Make a key and print it once; the keys file gets only its digest
    New(New),
}

#[derive(Debug, Args)]
struct New {
    /// The key's owner, who is named in the log and owns the jobs. Several keys may have the same name
    name: String,
    /// The calls that it opens: plan, jobs, read-only, metrics; separated by commas
    #[arg(long, default_value = "plan,jobs")]
    scopes: Scopes,
    /// Requests per second; one second's worth may come in a burst
    // What a robot asks that plans anew after every step, many times over.
    #[arg(long, default_value = "50")]
    rate: Rate,
    /// Append the entry to this file, or create it; by default the entry is printed below the key
    #[arg(long, value_name = "FILE")]
    api_keys_file: Option<PathBuf>,
}

impl Key {
    pub(super) fn run(self) -> Result<(), Failure> {
        let Command::New(new) = self.command;
        let key = FreshKey::new(&new.name, new.scopes, new.rate).map_err(Failure::Refused)?;
        let Some(path) = new.api_keys_file else {
            return terminal::print(&format!("{}\n\n{}", key.text(), key.entry()));
        };
        append(&key, &path).map_err(|error| Failure::Refused(error.to_string()))?;
        terminal::print(&format!("{}\n", key.text()))
    }
}
