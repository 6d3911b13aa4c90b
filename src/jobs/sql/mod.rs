//! Jobs in SQLite, for one machine, or in PostgreSQL, for many. One implementation: [`dialect`] holds the differences.
//!
//! From below: [`database`] has the connections; a [`change`] is one write transaction; a [`call`] waits for it; the
//! [`herald`] announces it. [`owner`], [`worker`], [`callbacks`] and [`sweep`] hold the queries, by caller. [`store`]
//! is their entry point, and [`mod@open`] makes it.

mod call;
mod callbacks;
mod change;
mod database;
mod dialect;
mod events;
mod file;
mod herald;
mod open;
mod owner;
mod row;
mod store;
mod sweep;
mod worker;

pub use open::{OpenError, open};
