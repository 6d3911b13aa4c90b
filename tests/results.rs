//! The page of results is what its command writes.

#[path = "../benches/results/markdown.rs"]
mod markdown;
#[path = "../benches/results/page.rs"]
mod page;
#[path = "../benches/results/peers.rs"]
mod peers;
#[path = "../benches/results/peers_page.rs"]
mod peers_page;
#[path = "../benches/results/plots.rs"]
mod plots;
#[path = "../benches/results/table_plots.rs"]
mod table_plots;
#[path = "../benches/results/tables.rs"]
mod tables;
#[path = "../benches/results/tables_page.rs"]
mod tables_page;

use std::fs;
use std::path::Path;

#[test]
fn the_results_are_what_their_command_writes() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for (path, text) in page::files() {
        let committed = fs::read_to_string(root.join(path)).unwrap();
        assert!(committed == text, "rewrite {path}: cargo bench --bench results");
    }
}
