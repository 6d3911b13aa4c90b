//! The service as its clients see it: a real server on a port of its own, in this process.

mod bodies;
mod connections;
mod document;
mod host;
mod negotiation;
mod planning;
