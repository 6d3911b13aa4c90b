//! Writes `docs/RESULTS.md` and its pictures. With `--check` it writes nothing and fails where they would change.

mod markdown;
mod page;
mod peers;
mod peers_page;
mod plots;
mod table_plots;
mod tables;
mod tables_page;

use std::env;
use std::fs;
use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let check = env::args().any(|argument| argument == "--check");
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut changed = false;
    for (path, text) in page::files() {
        if fs::read_to_string(root.join(path)).is_ok_and(|committed| committed == text) {
            continue;
        }
        changed = true;
        if check {
            eprintln!("{path} is not what `cargo bench --bench results` writes");
        } else {
            fs::write(root.join(path), text).expect("writable");
            println!("{path}");
        }
    }
    if check && changed { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}
