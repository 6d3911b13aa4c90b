//! Writes `docs/RESULTS.md` and its pictures. `tests/results.rs` fails where they would change.

mod markdown;
mod noise;
mod noise_page;
mod noise_plot;
mod page;
mod peers;
mod peers_page;
mod plots;
mod robot;
mod robot_page;
mod table_plots;
mod tables;
mod tables_page;
mod targets;

use std::fs;
use std::path::Path;

fn main() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for (path, text) in page::files() {
        if fs::read_to_string(root.join(path)).is_ok_and(|committed| committed == text) {
            continue;
        }
        fs::write(root.join(path), text).expect("writable");
        println!("{path}");
    }
}
