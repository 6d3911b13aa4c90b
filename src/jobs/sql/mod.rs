//! Jobs in SQLite, for one machine, or in PostgreSQL, for many. One implementation: where the two differ, [`dialect`] says
//! how.
//!
//! From below: the [`database`] has the connections; a [`change`] is one transaction in it, for which a [`call`] waits, and
//! whoever must know hears of it from the [`herald`]; [`owner`], [`worker`], [`callbacks`] and [`sweep`] are the questions,
//! by who asks them; [`store`] is the way in of all of them, and [`mod@open`] makes it.

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
