//! The paper's tables.

use serde_json::Value;

use crate::{failed, run};

/// The stdout of an experiment. On stderr it may tell how far it is.
#[track_caller]
fn ran(arguments: &[&str]) -> String {
    let output = run(&[&["experiment"], arguments].concat());
    let errors = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(0), "{errors}");
    assert!(errors.lines().all(|line| line.ends_with(" done")), "{errors}");
    String::from_utf8(output.stdout).unwrap()
}

fn json(arguments: &[&str]) -> Value {
    serde_json::from_str(&ran(&[arguments, &["--format", "json"]].concat())).unwrap()
}

fn list(value: &Value) -> &[Value] {
    value.as_array().unwrap()
}

fn count(value: &Value, fields: &[&str]) -> u64 {
    fields.iter().map(|field| value[field].as_u64().unwrap()).sum()
}

/// Without any time that was taken: the names of times say seconds.
fn without_times(value: &Value) -> Value {
    match value {
        Value::Object(fields) => {
            let timeless = fields.iter().filter(|(name, _)| !name.contains("_s_"));
            Value::Object(timeless.map(|(name, value)| (name.clone(), without_times(value))).collect())
        }
        Value::Array(values) => Value::Array(values.iter().map(without_times).collect()),
        other => other.clone(),
    }
}

#[test]
fn table_1_counts_every_episode_of_every_method_once() {
    let table = json(&["table1", "--episodes", "2", "--time-limit-ms", "2000"]);
    assert_eq!((&table["table"], &table["base_episodes"]), (&"table1".into(), &2.into()));
    let objects: Vec<&Value> = list(&table["columns"]).iter().map(|column| &column["objects"]).collect();
    assert_eq!(objects, [16, 18, 20, 25, 37, 50]);
    for column in list(&table["columns"]) {
        let models = list(&column["models"]);
        let names: Vec<&Value> = models.iter().map(|model| &model["grasp_model"]).collect();
        assert_eq!(names, ["sector", "swept_finger"]);
        for method in models.iter().flat_map(|model| list(&model["methods"])) {
            assert_eq!(count(method, &["successes", "late", "too_large"]), 2, "{method}");
            assert!(count(method, &["deadlocks", "graspable"]) <= count(method, &["successes"]), "{method}");
            assert!(method["search_s_mean"].as_f64().unwrap() > 0.0);
        }
        let ours = &models[1]["methods"][2];
        assert_eq!((&ours["method"], &ours["successes"]), (&"landmarks".into(), &2.into()));
        let plans = &column["plans"];
        assert_eq!(count(plans, &["graspable", "relocate", "deadlock", "no_space", "timed_out"]), 2);
        assert_eq!(plans["deadlock"], ours["deadlocks"]);
        assert_eq!(column["extra"]["deadlock"], 0);
        assert_eq!(column["paper"]["methods"][1]["success_rate"], 1.0);
    }
}

#[test]
fn table_2_counts_every_episode_of_every_way_to_find_places_once() {
    let table = json(&["table2", "--episodes", "2", "--time-limit-ms", "2000"]);
    assert_eq!(list(&table["columns"]).len(), 3);
    for (column, paper) in list(&table["columns"]).iter().zip([2.67, 2.93, 2.76]) {
        assert_eq!(column["paper"]["reposition_s_mean"], paper);
        assert!(count(column, &["drawn"]) >= 2);
        let names: Vec<&Value> = list(&column["placements"]).iter().map(|way| &way["placement"]).collect();
        assert_eq!(names, ["raster", "exact"]);
        for way in list(&column["placements"]) {
            assert_eq!(count(way, &["successes", "no_space", "late"]), 2, "{way}");
        }
        let exact = &column["placements"][1];
        assert_eq!((&exact["successes"], &exact["faulty"]), (&2.into(), &0.into()));
    }
}

#[test]
fn more_threads_change_no_figure_but_times() {
    // The baseline is left out: what it gets done in a time limit depends on how busy the machine is.
    for table in [&["table1", "--base-episodes", "0"][..], &["table2"]] {
        let with = |jobs| json(&[table, &["--episodes", "8", "--seed", "3", "--jobs", jobs]].concat());
        let (one, two) = (with("1"), with("2"));
        assert_eq!(without_times(&one).to_string(), without_times(&two).to_string());
        assert_ne!(one, two, "times differ");
    }
}

#[test]
fn the_text_has_the_papers_figures_in_the_next_column() {
    let text = ran(&["table1", "--episodes", "3", "--base-episodes", "0"]);
    let lines: Vec<Vec<&str>> = text.lines().map(|line| line.split_whitespace().collect()).collect();
    let starting = |with: &[&str]| lines.iter().filter(|line| line.starts_with(with)).collect::<Vec<_>>();
    let lobs = starting(&["20", "sector", "LOBS"]);
    assert_eq!((lobs[0][6..8].to_vec(), lobs[0][9]), (vec!["55.0", "34.2-74.2"], "100.0"));
    assert!(lobs[1].ends_with(&["2.44"]) && lobs[1].contains(&"0.21"), "{:?}", lobs[1]);
    let base = starting(&["16", "sector", "Base"]);
    assert_eq!(base[0][3..], ["0", "-", "-", "0.0", "0.0-16.1", "-", "95.0", "0", "0"]);
    assert!(starting(&["50", "sector", "Base"])[1].ends_with(&["60.00", "s", "0", "0", "0", "-", "-", "-"]));
    let [.., relocations, with_target, _] = &starting(&["20", "sector", "ours"])[1][..] else {
        panic!("a row of figures")
    };
    let number = |cell: &str| cell.parse::<f64>().unwrap();
    assert!((number(with_target) - number(relocations) - 1.0).abs() < 1e-9);
    assert!(text.contains("add 1 to compare"));
    let text = ran(&["table2", "--episodes", "1"]);
    assert!(text.contains("exact") && text.contains("2.67 s") && text.contains("72.2-100.0"));
}

#[test]
fn the_text_of_a_table_fits_120_columns() {
    for table in ["table1", "table2"] {
        let text = ran(&[table, "--episodes", "3", "--time-limit-ms", "1000"]);
        let wide: Vec<&str> = text.lines().filter(|line| line.chars().count() > 120).collect();
        assert!(wide.is_empty(), "{wide:#?}");
    }
}

#[test]
fn table_3_says_how_to_run_it() {
    let text = ran(&["table3"]);
    for command in ["table3", "relocations", "noise", "film"] {
        assert!(text.contains(&format!("  client-examples/robot-cell/run {command} ")), "{text}");
    }
    assert!(text.contains("Python 3.11") && text.lines().all(|line| line.chars().count() <= 120), "{text}");
}

#[test]
fn a_table_or_a_count_that_is_none_is_refused() {
    for arguments in [
        &["table4"][..],
        &[],
        &["table3", "--episodes", "2"],
        &["table1", "--episodes", "0"],
        &["table1", "--jobs", "0"],
        &["table1", "--time-limit-ms", "0"],
        &["table2", "--base-episodes", "1"],
        &["table1", "--episodes", "2", "--base-episodes", "3"],
    ] {
        failed(&run(&[&["experiment"], arguments].concat()), 2);
    }
}
