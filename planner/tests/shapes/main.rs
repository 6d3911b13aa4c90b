//! Footprints of every shape against brute force: sampled yaws, and distances of polygons by another library.

mod assumed;
mod brute;
mod distances;
mod listed;
mod options;
mod random;
mod shadows;
