//! Every setting as a flag.

use std::path::PathBuf;

use clap::{Arg, ArgMatches, Args, Command, Error, FromArgMatches};

use crate::config::{Config, NeededBy, SETTINGS, Setting, Stated};

/// The flags of a command that serves (`SERVICE`) or only plans, which needs few settings.
#[derive(Debug, Default)]
pub(super) struct Flags<const SERVICE: bool>(pub(super) Stated);

impl<const SERVICE: bool> Flags<SERVICE> {
    fn settings() -> impl Iterator<Item = &'static Setting> {
        SETTINGS.iter().filter(|setting| SERVICE || setting.needed_by == NeededBy::Planning)
    }
}

impl<const SERVICE: bool> FromArgMatches for Flags<SERVICE> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let mut flags = Self::default();
        flags.update_from_arg_matches(matches)?;
        Ok(flags)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        self.0.config = matches.get_one::<PathBuf>("config").cloned();
        let value = |setting: &'static Setting| Some((setting, matches.get_one::<String>(setting.name)?.clone()));
        self.0.flags = Self::settings().filter_map(value).collect();
        Ok(())
    }
}

impl<const SERVICE: bool> Args for Flags<SERVICE> {
    fn augment_args(command: Command) -> Command {
        let defaults = Config::default();
        let config = Arg::new("config")
            .long("config")
            .value_name("FILE")
            .value_parser(clap::value_parser!(PathBuf))
            .help_heading("Settings")
            .help("A TOML file with settings; a key is the flag's name with _ for - [env: SINGULATE_CONFIG]");
        Self::settings().fold(command.arg(config), |command, setting| {
            let (default, variable) = (setting.get(&defaults), setting.variable());
            let flag = Arg::new(setting.name)
                .long(setting.flag())
                .value_name(setting.placeholder)
                // A value that begins with a dash is an invalid value, not another flag.
                .allow_hyphen_values(true)
                .help_heading("Settings")
                .help(format!("{} [env: {variable}] [default: {default}]", setting.help));
            // A value is only accepted as --flag=value; otherwise the next word would be taken for one.
            let switch = |flag: Arg| flag.num_args(0..=1).require_equals(true).default_missing_value("true");
            command.arg(if setting.is_switch() { switch(flag) } else { flag })
        })
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

/// The same flags without help: another command lists them.
#[derive(Debug, Default)]
pub(super) struct Unlisted<A>(pub(super) A);

impl<A: FromArgMatches> FromArgMatches for Unlisted<A> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        A::from_arg_matches(matches).map(Self)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        self.0.update_from_arg_matches(matches)
    }
}

impl<A: Args> Args for Unlisted<A> {
    fn augment_args(command: Command) -> Command {
        A::augment_args(command).mut_args(|arg| arg.hide(true))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}
