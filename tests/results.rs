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
#[path = "../benches/results/targets.rs"]
mod targets;

use std::fs;
use std::path::Path;

use markdown::{digits, time};
use peers::Peers;

#[test]
fn the_results_are_what_their_command_writes() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for (path, text) in page::files() {
        let committed = fs::read_to_string(root.join(path)).unwrap();
        assert!(committed == text, "rewrite {path}: cargo bench --bench results");
    }
}

#[test]
fn a_number_has_three_digits_on_both_sides_of_a_power_of_ten() {
    let shown = [0.0123, 0.09996, 0.9994, 0.9996, 9.996, 99.94, 99.96, 999.4, 999.6, 31_415.9, 1_234_567.0].map(digits);
    let expected = ["0.0123", "0.100", "0.999", "1.00", "10.0", "99.9", "100", "999", "1,000", "31,416", "1,234,567"];
    assert_eq!(shown, expected);
    let shown = [6e-9, 1.1e-6, 0.000_999_4, 0.000_999_6, 0.023_456, 0.0994, 0.14, 60.0].map(time);
    assert_eq!(shown, ["0.0060 µs", "1.10 µs", "999 µs", "1.00 ms", "23.5 ms", "99.4 ms", "0.140 s", "60.0 s"]);
}

/// A run of one instance of each of these classes: the name, our time and the peers', s.
fn run(instances: &[(&str, &str, f64, f64)]) -> Peers {
    let timing = |seconds: f64| serde_json::json!({"seconds": seconds, "solve_seconds": seconds / 4.0});
    let instance = |(class, name, ours, theirs): &(&str, &str, f64, f64)| {
        serde_json::json!({
            "class": class, "name": name, "optimum": 2, "derivable": true, "ours": ours, "knowledge": 0.0,
            "peers": {"clingo": timing(*theirs)},
        })
    };
    let instances: Vec<_> = instances.iter().map(instance).collect();
    let versions = serde_json::json!({"clingo": "1", "cpsat": "2", "pyperplan": "3"});
    let run = serde_json::json!({
        "time_limit_seconds": 20.0, "pyperplan_limit_seconds": 5.0, "versions": versions, "instances": instances,
    });
    serde_json::from_value(run).expect("a run as it is written")
}

#[test]
fn a_missed_target_is_named_and_so_is_one_that_was_not_measured() {
    let figures = run(&[
        ("paper", "a", 1e-3, 11e-3),
        ("mixed-80", "b", 1e-3, 9e-3),
        ("pressed-300", "c", 11e-3, 1.0),
        ("crowd-10000", "d", 19e-3, 1.0),
        ("synthetic", "stack: e", 1.0, 0.5),
    ]);
    let text = targets::section(&figures);
    let row = |what: &str| text.lines().find(|line| line.contains(what)).unwrap();
    assert!(row("10 times").ends_with("| missed: `mixed-80`: 9.00 |"), "{}", row("10 times"));
    assert!(row("on every scene-born instance").ends_with("| holds |"));
    assert!(row("within 10 ms").ends_with("| missed: `pressed-300` c: 11.0 ms |"));
    assert!(row("within 20 ms").ends_with("| holds |"));
    assert!(row("500").ends_with("| missed: 4 |"));
    let text = targets::section(&run(&[("paper", "a", 1e-3, 1.0)]));
    let unmeasured = text.lines().filter(|line| line.ends_with("| not measured |")).count();
    assert_eq!(unmeasured, 2, "{text}");
}

#[test]
fn the_page_says_why_only_of_families_that_are_lost() {
    let page = peers_page::section(&run(&[("synthetic", "stack: a", 1.0, 0.5), ("synthetic", "web: b", 1.0, 2.0)]));
    assert!(page.contains("\n* `stack`: ") && !page.contains("\n* `web`: "), "{page}");
    let page = peers_page::section(&run(&[("synthetic", "stack: a", 0.1, 0.5)]));
    assert!(page.contains("None of these families") && page.contains("not measured"), "{page}");
}
