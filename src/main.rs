//! The `singulate` binary.

fn main() {}
