//! The independent checker: it passes what is right, and sees each kind of fault.

mod faults;
mod goals;
mod limits;
mod physics;
mod proofs;
pub(crate) mod scenes;
mod served;
mod terms;
