//! The paper's tables beside ours.

use crate::markdown::{digits, interval, listed, or_dash, percent, row, share, table, time};
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
         `singulate experiment table1`: {} scenes a column, the baseline (\"Base\") on the first {} of them, at most {} a \
         search. The paper has {} scenes a column and a minute. Each target is the object with the largest least option \
         by the sector model, for both models.\n\n\
         ### Deadlocks\n\n\
         Rates with their 95 % intervals (Wilson; the paper gives none). The sector model widens each finger, so some of \
         its deadlocks are false. The swept finger tests the finger itself.\n\n\
         ![Deadlock rates: the paper's, ours by the sector model, ours by the swept finger](results/deadlocks.svg)\n\n\
         {}\n{}\n\n\
         ### Time\n\n\
         Mean search time. A search that did not end counts as the limit.\n\n\
         ![Search time against the number of objects](results/times.svg)\n\n{}\n\
         ### Answers\n\n\
         Success is a sequence or a deadlock within the limit. Other searches were late or too large: our Base may hold \
         5,000,000 sets. Relocations are the mean over the scenes with a sequence. +1 counts the target too, as the paper \
         does. Wrong answers are false deadlocks, and sequences longer than the least, by our proof on the same base.\n\n\
         {}\n\
         ### Every scene planned, with places and the check\n\n\
         The verdicts of the whole planner by the swept finger. In brackets are those on scenes that only the sector model \
         calls a deadlock: each plan among them is one that the paper's model misses.\n\n{}",
        figures.episodes,
        figures.base_episodes,
        time(f64::from(figures.time_limit_ms) / 1e3),
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
        cells.extend([BASE, LOBS].map(|method| time(column.printed(method).search_s_mean)));
        let methods = [(SECTOR, BASE), (SECTOR, LOBS), (SECTOR, OURS), (SWEPT, OURS)];
        cells.extend(methods.map(|(model, method)| or_dash(column.method(model, method).search_s_mean, time)));
        rows.push(cells);
    }
    rows
}

fn answers(figures: &Table1) -> Vec<Vec<String>> {
    let mut rows = vec![row([
        "N",
        "method",
        "episodes",
        "success",
        "late or too large",
        "relocations",
        "+1",
        "false deadlocks",
        "not optimal",
    ])];
    let methods = [
        (SECTOR, BASE, "our Base, sector"),
        (SECTOR, LOBS, "our LOBS, sector"),
        (SECTOR, OURS, "ours, sector"),
        (SWEPT, OURS, "ours, swept finger"),
    ];
    for column in &figures.columns {
        let mut label = name(column);
        for (method, whose) in [(BASE, "the paper's Base"), (LOBS, "the paper's LOBS")] {
            let printed = column.printed(method);
            // It prints 0.00 where it has no sequence to take a mean of.
            let relocations = Some(printed.relocations_mean).filter(|&mean| mean > 0.0);
            let mut cells = vec![std::mem::take(&mut label), whose.to_owned(), column.paper.episodes.to_string()];
            cells.extend([percent(printed.success_rate), "–".to_owned(), "–".to_owned()]);
            cells.extend([or_dash(relocations, hundredths), "–".to_owned(), "–".to_owned()]);
            rows.push(cells);
        }
        for (model, method, whose) in methods {
            let found = column.method(model, method);
            let mut cells = vec![String::new(), whose.to_owned(), found.episodes.to_string()];
            cells.extend([or_dash(found.success_rate, percent), found.capped().to_string()]);
            let relocations = [found.relocations_mean, found.relocations_mean.map(|mean| mean + 1.0)];
            cells.extend(relocations.map(|mean| or_dash(mean, hundredths)));
            cells.extend([found.false_deadlocks, found.not_optimal].map(|count| count.to_string()));
            rows.push(cells);
        }
    }
    rows
}

fn hundredths(mean: f64) -> String {
    format!("{mean:.2}")
}

fn plans(figures: &Table1) -> Vec<Vec<String>> {
    let first = "N: scenes (deadlock by sector alone)";
    let head = [first, "graspable", "relocate", "proven optimal", "deadlock", "no space", "timed out", "mean time"];
    let mut rows = vec![row(head)];
    for column in &figures.columns {
        let counts = |plans: &Plans| {
            [plans.graspable, plans.relocate, plans.optimal, plans.deadlock, plans.no_space, plans.timed_out]
        };
        let mut cells = vec![format!("{}: {} ({})", column.objects, column.plans.episodes, column.extra.episodes)];
        let both = counts(&column.plans).into_iter().zip(counts(&column.extra));
        cells.extend(both.map(|(all, extra)| format!("{all} ({extra})")));
        cells.push(or_dash(column.plans.plan_s_mean, time));
        rows.push(cells);
    }
    rows
}

/// The section of Table II.
pub(crate) fn table2(figures: &Table2) -> String {
    let head = ["N", "places by", "success", "no space", "late", "mean time", "plans with faults", "release blocked"];
    let mut rows = vec![row(head)];
    for column in &figures.columns {
        let (n, paper) = (column.objects.to_string(), &column.paper);
        // A count of episodes.
        let successes = (paper.success_rate * f64::from(paper.episodes)).round() as u32;
        let success = share(successes, paper.episodes);
        rows.push(row([&n, "the paper", &success, "–", "–", &time(paper.reposition_s_mean), "–", "–"]));
        for ours in &column.placements {
            let label = if ours.placement == "raster" { "its method, in our code" } else { "border curves (ours)" };
            let [no_space, late, faulty, blocked] =
                [ours.no_space, ours.late, ours.faulty, ours.release_blocked].map(|count| count.to_string());
            let success = share(ours.successes, ours.episodes);
            let mean = or_dash(ours.reposition_s_mean, time);
            rows.push(row(["", label, &success, &no_space, &late, &mean, &faulty, &blocked]));
        }
    }
    let placed: Vec<_> = figures.columns.iter().filter_map(|column| column.placements.first()).collect();
    let moved: Vec<String> =
        placed.iter().map(|placement| (placement.episodes - placement.graspable).to_string()).collect();
    format!(
        "## The paper's Table II\n\n\
         `singulate experiment table2`: places for the sequences of LOBS by the sector model, {} scenes a column in which \
         LOBS finds a sequence. In {} of them an object has to be moved; the times are over these. Rates have their 95 % \
         intervals (Wilson). The checker counts faults by the swept finger, most of them fingers that meet an obstacle at the \
         release. Our own places are searched for by the sector model too. It overlooks the fingers' outer corners, hence \
         their faults.\n\n{}",
        figures.episodes,
        listed(&moved),
        table(&rows),
    )
}

/// What no run can settle.
pub(crate) fn apart(table1: &Table1, table2: &Table2) -> String {
    let (first, places) = (&table1.columns[0], &table2.columns[0]);
    format!(
        "## Differences from the paper\n\n\
         * The machine: the paper's times are from its own machine, ours from a shared one with 2 cores and in another language.\n\
         * The scenes: the paper does not say how it drew its own.\n\
         * Algorithm 1 as printed starts its sequence with the target and returns it, and the paper counts the length of the \
         sequence. Here the target isn't counted: add 1 to compare.\n\
         * The paper's Base and LOBS can't have seen the same scenes: with {} objects Base succeeds in {} of them without a \
         single deadlock, and LOBS calls {} a deadlock.\n\
         * Our Base recognises a set that it reached before in another order, so it ends on a deadlock and finds it. The \
         paper's text allows a search through every order.\n\
         * The image: the paper names no resolution. Here a pixel is 5 mm wide. The paper's places are for {} scenes a column.\n\
         * The θ_g of Eq. 7, \"the angle from the center of the circle when it overlaps by r_g\": here it is that of the lens of two \
         equal circles, which fits the formula. With that of a segment r_g high, discs would overlap.\n\
         * The distance to objects that are still to be moved: the paper asks that a place does not affect what follows. Here \
         places keep r_g from them and from the target.\n",
        first.objects,
        percent(first.printed(BASE).success_rate),
        percent(first.printed(LOBS).deadlock_rate),
        places.paper.episodes,
    )
}
