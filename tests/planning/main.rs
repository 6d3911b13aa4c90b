//! From scenes to checked answers.

mod check;
