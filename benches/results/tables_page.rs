//! The paper's tables beside ours.

use crate::markdown::{digits, ms, or_dash, percent, row, table};
use crate::tables::{Column1, Method, Plans, Table1, Table2};

const SECTOR: &str = "sector";
const SWEPT: &str = "swept_finger";
const BASE: &str = "forward_astar";
const LOBS: &str = "lobs";
const OURS: &str = "landmarks";

/// The section of Table I.
pub(crate) fn table1(figures: &Table1) -> String {
    format!(
        "## The paper's Table I\n\n\
         `singulate experiment table1`: {} scenes a column, the baseline (\"Base\") on the first {} of them, at most {} s \
         a search. The paper has {} scenes a column and a minute. Each target is the object with the largest least option \
         by the sector model, for both models.\n\n\
         ### Deadlocks\n\n\
         Rates with their 95 % intervals (Wilson; the paper gives none). Where the sector model calls a deadlock, its \
         widened fingers do not fit; the swept finger asks the real ones.\n\n\
         ![Deadlock rates: the paper's, ours by the sector model, ours by the swept finger](results/deadlocks.svg)\n\n\
         {}\n{}\n\n\
         ### Time\n\n\
         Mean search time in milliseconds; a search that did not end counts as the limit.\n\n\
         ![Search time against the number of objects](results/times.svg)\n\n{}\n\
         ### Answers\n\n\
         Mean relocations of the scenes with a sequence, and success: a sequence or a deadlock within the limit. A wrong \
         answer is a deadlock that is none, or a sequence longer than the least, by our proof on the same base.\n\n\
         {}\n\
         ### Every scene planned, with places and the check\n\n\
         The verdicts of the whole planner by the swept finger; in brackets those on the scenes that only the sector \
         model calls a deadlock, each plan a plan that the paper's model misses.\n\n{}",
        figures.episodes,
        figures.base_episodes,
        digits(f64::from(figures.time_limit_ms) / 1e3),
        figures.columns[0].paper.episodes,
        table(&deadlocks(figures)),
        disagreements(figures),
        table(&times(figures)),
        table(&answers(figures)),
        table(&plans(figures)),
    )
}

fn name(column: &Column1) -> String {
    let [width, height] = column.table;
    format!("{} on {width} × {height} m", column.objects)
}

fn deadlocks(figures: &Table1) -> Vec<Vec<String>> {
    let head = ["N", "the paper's LOBS", "our LOBS, sector", "ours, swept finger", "swept finger / sector"];
    let mut rows = vec![row(head)];
    for column in &figures.columns {
        let printed = column.printed(LOBS);
        let of = |method: &Method| interval(method.deadlock_rate, method.deadlock_interval);
        rows.push(vec![
            name(column),
            interval(Some(printed.deadlock_rate), printed.deadlock_interval),
            of(column.method(SECTOR, LOBS)),
            of(column.method(SWEPT, OURS)),
            or_dash(column.deadlock_ratio, digits),
        ]);
    }
    rows
}

fn interval(rate: Option<f64>, [low, high]: [f64; 2]) -> String {
    let whole = |rate: f64| format!("{:.0}", rate * 100.0);
    or_dash(rate, |rate| format!("{} ({} to {})", percent(rate), whole(low), whole(high)))
}

/// Which columns differ from the paper's, and in which the swept finger has more than half of the deadlocks.
fn disagreements(figures: &Table1) -> String {
    let named = |chosen: fn(&Column1) -> bool| {
        let named: Vec<String> = figures
            .columns
            .iter()
            .filter(|column| chosen(column))
            .map(|column| format!("N={}", column.objects))
            .collect();
        if named.is_empty() { "none".to_owned() } else { named.join(", ") }
    };
    format!(
        "Columns in which our interval by the sector model and the paper's don't overlap: {}. Columns in which the swept \
         finger has more than half as many deadlocks as the sector model: {}.",
        named(|column| column.disagrees),
        named(|column| !column.at_most_half),
    )
}

fn times(figures: &Table1) -> Vec<Vec<String>> {
    let head = [
        "N",
        "the paper's Base",
        "its LOBS",
        "our Base, sector",
        "our LOBS, sector",
        "ours, sector",
        "ours, swept finger",
    ];
    let mut rows = vec![row(head)];
    for column in &figures.columns {
        let mut cells = vec![name(column)];
        cells.extend([BASE, LOBS].map(|method| ms(column.printed(method).search_s_mean)));
        let methods = [(SECTOR, BASE), (SECTOR, LOBS), (SECTOR, OURS), (SWEPT, OURS)];
        cells.extend(methods.map(|(model, method)| or_dash(column.method(model, method).search_s_mean, ms)));
        rows.push(cells);
    }
    rows
}

fn answers(figures: &Table1) -> Vec<Vec<String>> {
    let mut rows = vec![row(["N", "method", "success", "relocations", "false deadlocks", "not optimal"])];
    for column in &figures.columns {
        for (method, label) in [(BASE, "the paper's Base"), (LOBS, "the paper's LOBS")] {
            let printed = column.printed(method);
            let relocations = format!("{:.2}", printed.relocations_mean);
            let cells = [&name(column), label, &percent(printed.success_rate), &relocations, "–", "–"];
            rows.push(row(cells));
        }
        let ours = [
            (SECTOR, BASE, "our Base, sector"),
            (SECTOR, LOBS, "our LOBS, sector"),
            (SECTOR, OURS, "ours, sector"),
            (SWEPT, OURS, "ours, swept finger"),
        ];
        for (model, method, label) in ours {
            let figures = column.method(model, method);
            let relocations = or_dash(figures.relocations_mean, |mean| format!("{mean:.2}"));
            let wrong = [figures.false_deadlocks, figures.not_optimal].map(|count| count.to_string());
            let success = or_dash(figures.success_rate, percent);
            rows.push(row(["", label, &success, &relocations, &wrong[0], &wrong[1]]));
        }
    }
    rows
}

fn plans(figures: &Table1) -> Vec<Vec<String>> {
    let head = ["N", "graspable", "relocate", "proven optimal", "deadlock", "no space", "timed out", "mean time, ms"];
    let mut rows = vec![row(head)];
    for column in &figures.columns {
        let counts = |plans: &Plans| {
            [plans.graspable, plans.relocate, plans.optimal, plans.deadlock, plans.no_space, plans.timed_out]
        };
        let mut cells = vec![format!("{}: {} ({})", column.objects, column.plans.episodes, column.extra.episodes)];
        let both = counts(&column.plans).into_iter().zip(counts(&column.extra));
        cells.extend(both.map(|(all, extra)| format!("{all} ({extra})")));
        cells.push(or_dash(column.plans.plan_s_mean, ms));
        rows.push(cells);
    }
    rows
}

/// The section of Table II.
pub(crate) fn table2(figures: &Table2) -> String {
    let head =
        ["N", "places by", "success", "no space", "late", "mean time, ms", "plans with faults", "release blocked"];
    let mut rows = vec![row(head)];
    for column in &figures.columns {
        let n = column.objects.to_string();
        let success = percent(column.paper.success_rate);
        rows.push(row([&n, "the paper", &success, "–", "–", &ms(column.paper.reposition_s_mean), "–", "–"]));
        for ours in &column.placements {
            let label = if ours.placement == "raster" { "its method, in our code" } else { "border curves (ours)" };
            let [no_space, late, faulty, blocked] =
                [ours.no_space, ours.late, ours.faulty, ours.release_blocked].map(|count| count.to_string());
            let success = or_dash(ours.success_rate, percent);
            let time = or_dash(ours.reposition_s_mean, ms);
            rows.push(row(["", label, &success, &no_space, &late, &time, &faulty, &blocked]));
        }
    }
    let placed = figures.columns.iter().flat_map(|column| column.placements.first());
    let moved: Vec<String> = placed
        .map(|placement| format!("{} of {}", placement.episodes - placement.graspable, placement.episodes))
        .collect();
    format!(
        "## The paper's Table II\n\n\
         `singulate experiment table2`: places for the sequences of LOBS by the sector model, {} scenes a column, of which \
         {} need a place at all. Faults are the checker's, by the swept finger: a finger that meets an obstacle when it \
         lets go, above all.\n\n{}",
        figures.episodes,
        moved.join(", "),
        table(&rows),
    )
}

/// What no run can settle.
pub(crate) fn apart(figures: &Table1) -> String {
    let first = &figures.columns[0];
    format!(
        "## What could not be the same\n\n\
         * The machine: the paper's times are those of its own, ours of a shared one with 2 cores, in another language.\n\
         * The scenes: the paper does not say how it drew its own.\n\
         * Whether the target counts as a relocation: the paper does not say. Ours does not.\n\
         * The paper's Base and LOBS can't have seen the same scenes: with {} objects Base succeeds in {} of them without a \
         single deadlock, and LOBS calls {} a deadlock.\n\
         * Our Base knows a set again that it has reached in another order. As the paper words it, the search may go \
         through every order.\n",
        first.objects,
        percent(first.printed(BASE).success_rate),
        percent(first.printed(LOBS).deadlock_rate),
    )
}
