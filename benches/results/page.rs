//! `docs/RESULTS.md` and its pictures, from the files in `docs/results/`.

use std::fs;
use std::path::Path;

use crate::figures::Peers;
use crate::{peers_page, plots};

/// Where the figures are read, seen from the crate's root.
const PEERS: &str = "docs/results/peers.json";

/// Every file that is made, with its path below the crate's root and its text.
pub(crate) fn files() -> Vec<(&'static str, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = fs::read_to_string(root.join(PEERS)).expect("the committed figures");
    let peers: Peers = serde_json::from_str(&text).expect("what benches/peers/run writes");
    let head = "# Results\n\n\
        `cargo bench --bench results` writes this page and its pictures from the files in [`results/`](results/): \
        every figure here is one of theirs. They were measured on a shared machine with 2 cores; all that is compared \
        was measured in the same run.\n\n";
    vec![
        ("docs/RESULTS.md", format!("{head}{}", peers_page::section(&peers))),
        ("docs/results/peers.svg", plots::peers(&peers).expect("a plot of finite figures")),
    ]
}
