//! Jobs in SQLite, for one machine, or in PostgreSQL, for many. One implementation: [`database`] holds the differences.
//!
//! From below: [`database`] has the connections; a [`change`] is one write transaction; a [`call`] waits for it; the
//! [`herald`] announces it. [`owner`], [`leases`] and [`sweep`] hold the queries, by caller. [`store`] is their
//! entry point, and [`mod@open`] makes it.

mod call;
mod change;
mod database;
mod herald;
mod leases;
mod open;
mod owner;
mod row;
mod store;
mod sweep;

pub use open::{OpenError, open};
