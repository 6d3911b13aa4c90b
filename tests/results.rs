//! The page of results is what its command writes.

#[path = "../benches/results/markdown.rs"]
mod markdown;
#[path = "../benches/results/noise.rs"]
mod noise;
#[path = "../benches/results/noise_page.rs"]
mod noise_page;
#[path = "../benches/results/noise_plot.rs"]
mod noise_plot;
#[path = "../benches/results/page.rs"]
mod page;
#[path = "../benches/results/peers.rs"]
mod peers;
#[path = "../benches/results/peers_page.rs"]
mod peers_page;
#[path = "../benches/results/plots.rs"]
mod plots;
#[path = "../benches/results/robot.rs"]
mod robot;
#[path = "../benches/results/robot_page.rs"]
mod robot_page;
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

use markdown::{digits, length, millimetres, time};
use noise::Noise;
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

#[test]
fn a_length_is_in_the_unit_that_suits_it_and_a_chosen_one_in_millimetres() {
    let shown = [0.0, 4e-9, 9.4e-6, 0.000_999_4, 0.000_999_6, 0.0155].map(length);
    assert_eq!(shown, ["0", "0.0040 µm", "9.40 µm", "999 µm", "1.00 mm", "15.5 mm"]);
    assert_eq!([0.0, 0.0005, 0.003, 0.01].map(millimetres), ["0 mm", "0.5 mm", "3 mm", "10 mm"]);
}

/// A run with one sigma: of each margin, in mm, the successes of 100 judged episodes, and the deadlocks besides.
fn noisy(margins: &[(f64, u32, u32)]) -> Noise {
    let cell = |(margin, success, deadlocks): &(f64, u32, u32)| {
        serde_json::json!({
            "sigma": 0.001, "margin": margin / 1e3, "yaw_tolerance": 0.0, "episodes": 100 + deadlocks,
            "ends": {"in_hand": 100, "deadlock": deadlocks}, "judged": 100, "success": success, "clean": success,
            "harmed": 100 - success,
            "pressed": 3, "relocations": 50, "grasps": 150, "contacts": {"release": {"finger touch": 3}, "carrying": {"dish hit": 1}}, "disturbances": 0,
            "drops": 0, "place_error_mean": 1e-05, "place_error_max": null, "pictures": 150, "plans": 150, "verifications": 0,
        })
    };
    let cells: Vec<_> = margins.iter().map(cell).collect();
    let run = serde_json::json!({"command": "run noise", "objects": 20, "episodes": 100, "cells": cells});
    serde_json::from_str(&run.to_string()).expect("a run as it is written")
}

#[test]
fn an_arms_troubles_are_counted_apart_and_its_name_is_told() {
    let column = serde_json::json!({
        "objects": 16, "method": "paper", "deadlocks_passed_over": 4, "planning_s_mean": 0.02, "service_s_mean": 0.001,
        "execution_s_mean": null, "faulty_plans": 2, "paper": {"success": 1.0, "planning_s": 2.82, "execution_s": 77.99},
        "episodes": 10, "ends": {"gave_up": 1, "in_hand": 6, "no_path": 1, "out_of_reach": 2}, "judged": 8, "success": 5,
        "clean": 4, "harmed": 1, "pressed": 1, "relocations": 9, "grasps": 15, "disturbances": 3, "drops": 1, "pictures": 20, "plans": 20,
        "verifications": 0,
        "contacts": {"closing": {"dish touch": 1}, "descent": {"finger hit": 2, "finger touch": 1}},
        "place_error_mean": null, "place_error_max": null,
    });
    let run = serde_json::json!({
        "command": "run table3", "versions": {"mujoco": "4", "ompl": "2", "numpy": "1"}, "mechanism": "arm", "episodes": 10,
        "columns": [column],
    });
    let figures: robot::Table3 = serde_json::from_str(&run.to_string()).expect("a run as it is written");
    let text = robot_page::table3(&figures);
    let methods = "the paper's methods, in our code";
    let outcome = "8 of 10 | 62.5 % (31 to 86) | 50 % (22 to 78) | 20.0 ms | 1.00 ms | – | 0.90";
    let collisions = "closing: dish touch 1; descent: finger hit 2, finger touch 1";
    assert!(text.contains("| 16 | the paper | – | 100 % | – | 2.82 s | – | 78.0 s | – |"), "{text}");
    assert!(text.contains(&format!("|  | {methods} | {outcome} |")), "{text}");
    let troubles = format!("| 16 | {methods} | 4 | 2 | 1 | 0 | `gave_up` 1 | {collisions} | 3 | 1 | 2 |");
    assert!(text.contains(&troubles) && text.contains("UR10e") && text.contains("OMPL 2 "), "{text}");
}

#[test]
fn a_margin_is_enough_only_if_all_larger_ones_are() {
    let figures = noisy(&[(0.0, 80, 0), (1.0, 99, 5), (2.0, 98, 10), (3.0, 99, 25), (4.0, 100, 60)]);
    let text = noise_page::noise(&figures);
    let row = "| 1 mm | 0 rad | 3 mm | 99 % (95 to 100) | 20 % (14 to 28) | 0 % (0 to 4) | 0.40 | 0.50 |";
    assert!(text.contains(row) && text.contains("some margin is enough for each σ."), "{text}");
    let row = "| 1 mm | 0 rad | 4 mm | 150 | 0 (0 %) | 50 | 1 (2 %) | 0 (0 %) | 3 (6 %) | 100 | 3 (3 %) |";
    assert!(text.contains(row), "{text}");
    let text = noise_page::noise(&noisy(&[(0.0, 100, 0), (1.0, 98, 5)]));
    assert!(text.contains("| 1 mm | 0 rad | none | – | – | 0 % (0 to 4) | – | 0.50 |"), "{text}");
    assert!(text.contains("No margin holds 99 % for a σ of 1 mm."), "{text}");
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
