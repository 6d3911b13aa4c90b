//! Jobs in SQLite, for one machine, or in PostgreSQL, for many. One implementation: where the two differ, [`dialect`] says
//! how.
//!
//! In reading order: [`open`] connects; [`store`] is the way in of every question; a [`call`] waits for a [`change`], which
//! is one transaction, and whoever must know hears of it from the [`herald`]; the other files are the questions, by who
//! asks them.

mod call;
mod callbacks;
mod change;
mod dialect;
mod events;
mod file;
mod herald;
mod open;
mod owner;
mod row;
mod store;
mod submit;
mod sweep;
mod worker;

pub use open::{OpenError, open};
