//! The paper's tables for humans: our figures beside the paper's.

use super::table::{Column, table};
use crate::experiments::{
    ConfidenceInterval, ExperimentSettings, MethodFigures, ModelFigures, PlacementFigures, PlanFigures, Printed,
    Repositioning, Spread, TABLE1_EPISODES, TABLE2_EPISODES, Table1Column, Table2Column,
};
use singulate_planner::paper::{GraspModelName, SearchMethod};

/// The figures that can't be reproduced exactly.
pub(super) const NOT_THE_SAME: &str = "\
Differences from the paper's own experiments. The machine is another one. The scenes differ, since
the paper only says that they are random. Algorithm 1 as printed counts the target. Here it isn't
counted: add 1 to compare. The paper's baseline and its LOBS can't have seen the same scenes: for
N=16 one finds sequences in 95 % of them, the other calls 20 % a deadlock. Our baseline recognises a
set of objects that it reached before in another order; the paper does not mention this. For places
the paper names no resolution (here 5 mm). It leaves open how its θ_g is measured (here by the lens
of two equal circles) and how far a place must be from objects that are still to be moved (here r_g).";

/// Columns of text are left-aligned, those of numbers right-aligned.
const WORDS: [&str; 5] = ["model", "method", "places", "scenes", "faults"];

/// Table I.
pub(super) fn table1(settings: &ExperimentSettings, columns: &[Table1Column]) -> String {
    let ExperimentSettings { episodes, base_episodes, seed, .. } = settings;
    let limit = seconds(settings.time_limit.as_secs_f64());
    [
        format!(
            "Table I: {episodes} episodes a column (Base {base_episodes}, the paper {TABLE1_EPISODES}), seed {seed}, \
             time limit {limit}\n"
        ),
        endings(columns),
        searches(columns),
        "A search that ended at the time limit (late) or the memory limit (too large) counts as the time limit.\n\
         +1: with the target counted, as in the paper's next column.\n"
            .to_owned(),
        plans(columns),
        "Planned by the swept finger, with places and check. sector's deadlocks: scenes that only the sector model calls one.\n"
            .to_owned(),
        conclusions(columns),
        format!("{NOT_THE_SAME}\n"),
    ]
    .join("\n")
}

/// Table II.
pub(super) fn table2(settings: &ExperimentSettings, columns: &[Table2Column]) -> String {
    let ExperimentSettings { episodes, seed, .. } = settings;
    let limit = seconds(settings.time_limit.as_secs_f64());
    [
        format!(
            "Table II: {episodes} episodes a column (the paper {TABLE2_EPISODES}), seed {seed}, time limit {limit}: places \
             for the\nsequences that LOBS finds by the sector model\n"
        ),
        placings(columns),
        "Times are over the episodes in which an object has to be moved: all but the graspable ones.\n".to_owned(),
        faults(columns),
        "Faulty plans are those that the checker, with the swept finger, refuses. At release: a finger meets an obstacle\n\
         when it opens. The exact places are searched for by the sector model too. It overlooks the fingers' outer\n\
         corners, hence their faults.\n"
            .to_owned(),
        format!("{NOT_THE_SAME}\n"),
    ]
    .join("\n")
}

/// One row per column and placement method.
fn placements(
    columns: &[Table2Column],
    row: impl Fn(&Table2Column, &PlacementFigures) -> Vec<String>,
) -> Vec<Vec<String>> {
    let rows = columns.iter().flat_map(|column| column.placements.iter().map(move |figures| (column, figures)));
    let named = |(column, figures): (&Table2Column, &PlacementFigures)| {
        let placement = match figures.placement {
            Repositioning::Raster => "raster",
            Repositioning::Exact => "exact",
        };
        [vec![column.case.objects.to_string(), placement.to_owned()], row(column, figures)].concat()
    };
    rows.map(named).collect()
}

/// How often places are found, and how long that takes.
fn placings(columns: &[Table2Column]) -> String {
    let titles =
        titles("N|places|episodes|success %|(95 %)|paper|(95 %)|graspable|no space|late|mean time|median|paper");
    let rows = placements(columns, |column, figures| {
        let paper = column.case.reposition;
        vec![
            figures.episodes.to_string(),
            percent(figures.successes, figures.episodes),
            sureness(figures.successes, figures.episodes),
            or_dash(paper, |paper| percent(paper.successes, TABLE2_EPISODES)),
            or_dash(paper, |paper| sureness(paper.successes, TABLE2_EPISODES)),
            figures.graspable.to_string(),
            figures.no_space.to_string(),
            figures.late.to_string(),
            mean(figures.reposition_s),
            median(figures.reposition_s),
            or_dash(paper, |paper| seconds(paper.reposition_s)),
        ]
    });
    table(&titles, rows.into_iter())
}

/// The checker's faults in the plans.
fn faults(columns: &[Table2Column]) -> String {
    let rows = placements(columns, |_, figures| {
        let faults: Vec<String> = figures.faults.iter().map(|(code, count)| format!("{code} {count}")).collect();
        let counts = [figures.faulty, figures.release_blocked, figures.otherwise_faulty].map(|count| count.to_string());
        [&counts[..], &[or_dash((!faults.is_empty()).then_some(faults), |faults| faults.join(", "))]].concat()
    });
    table(&titles("N|places|faulty|at release|otherwise|faults"), rows.into_iter())
}

/// Each column's methods by each grasp model, with the paper's figures for the same method.
fn methods(columns: &[Table1Column]) -> impl Iterator<Item = (&Table1Column, &ModelFigures, &MethodFigures)> {
    columns.iter().flat_map(|column| {
        let models = [&column.sector, &column.swept_finger];
        models.into_iter().flat_map(move |model| model.methods.iter().map(move |method| (column, model, method)))
    })
}

/// The paper's figures for a method; it has the sector model only.
fn printed<'c>(column: &'c Table1Column, model: &ModelFigures, method: &MethodFigures) -> Option<&'c Printed> {
    match (model.grasp_model, method.method) {
        (GraspModelName::Sector, SearchMethod::ForwardAstar) => Some(&column.case.base),
        (GraspModelName::Sector, SearchMethod::Lobs) => Some(&column.case.lobs),
        _ => None,
    }
}

fn name_of(method: SearchMethod) -> String {
    match method {
        SearchMethod::ForwardAstar => "Base",
        SearchMethod::Lobs => "LOBS",
        SearchMethod::Landmarks => "ours",
    }
    .to_owned()
}

fn model_of(model: GraspModelName) -> String {
    match model {
        GraspModelName::Sector => "sector",
        GraspModelName::SweptFinger => "swept finger",
    }
    .to_owned()
}

fn titles(titles: &'static str) -> Vec<Column> {
    let column = |title| if WORDS.contains(&title) { Column::left(title) } else { Column::right(title) };
    titles.split('|').map(column).collect()
}

/// The outcomes of the searches, and their errors.
fn endings(columns: &[Table1Column]) -> String {
    let titles =
        titles("N|model|method|episodes|deadlock %|(95 %)|paper|(95 %)|success %|paper|false deadlock|not least");
    let rows = methods(columns).map(|(column, model, method)| {
        let paper = printed(column, model, method);
        vec![
            column.case.objects.to_string(),
            model_of(model.grasp_model),
            name_of(method.method),
            method.episodes.to_string(),
            percent(method.deadlocks, method.episodes),
            sureness(method.deadlocks, method.episodes),
            or_dash(paper, |paper| percent(paper.deadlocks, TABLE1_EPISODES)),
            or_dash(paper, |paper| sureness(paper.deadlocks, TABLE1_EPISODES)),
            percent(method.successes, method.episodes),
            or_dash(paper, |paper| percent(paper.successes, TABLE1_EPISODES)),
            method.false_deadlocks.to_string(),
            method.not_optimal.to_string(),
        ]
    });
    table(&titles, rows)
}

/// The search times, time-outs and memory limits, and the number of relocations: without the target, then with it, as
/// the paper counts.
fn searches(columns: &[Table1Column]) -> String {
    let titles = titles("N|model|method|knowledge|search|median|paper|late|too large|graspable|relocations|+1|paper");
    let rows = methods(columns).map(|(column, model, method)| {
        let paper = printed(column, model, method);
        vec![
            column.case.objects.to_string(),
            model_of(model.grasp_model),
            name_of(method.method),
            mean(model.knowledge_s),
            mean(method.search_s),
            median(method.search_s),
            or_dash(paper, |paper| seconds(paper.search_s)),
            method.late.to_string(),
            method.too_large.to_string(),
            method.graspable.to_string(),
            number(method.relocations_mean),
            number(method.relocations_mean.map(|mean| mean + 1.0)),
            number(paper.map(|paper| paper.relocations).filter(|&mean| mean > 0.0)),
        ]
    });
    table(&titles, rows)
}

/// Our planner's answers, places and check included.
fn plans(columns: &[Table1Column]) -> String {
    let titles = titles("N|scenes|episodes|graspable|plan|least|deadlock|no space|late|relocations|mean time|median");
    let row = |column: &Table1Column, which: &str, figures: &PlanFigures| {
        let counts = [
            figures.episodes,
            figures.graspable,
            figures.relocate,
            figures.optimal,
            figures.deadlock,
            figures.no_space,
            figures.timed_out,
        ];
        let mut row = vec![column.case.objects.to_string(), which.to_owned()];
        row.extend(counts.map(|count| count.to_string()));
        row.extend([number(figures.relocations_mean), mean(figures.plan_s), median(figures.plan_s)]);
        row
    };
    let rows = columns
        .iter()
        .flat_map(|column| [row(column, "all", &column.plans), row(column, "sector's deadlocks", &column.extra)]);
    table(&titles, rows)
}

/// The differences from the paper, and the gain by the swept finger.
fn conclusions(columns: &[Table1Column]) -> String {
    let named = |of: &dyn Fn(&Table1Column) -> bool| {
        let names: Vec<String> =
            columns.iter().filter(|column| of(column)).map(|column| format!("N={}", column.case.objects)).collect();
        if names.is_empty() { "none".to_owned() } else { names.join(", ") }
    };
    let ratio = |column: &Table1Column| format!("N={}: {}", column.case.objects, number(column.deadlock_ratio()));
    let ratios: Vec<String> = columns.iter().map(ratio).collect();
    format!(
        "Deadlocks by the swept finger over deadlocks by the sector model:\n  {}\n\
         Columns where that is more than one half: {}\n\
         Columns where LOBS disagrees with the paper's deadlock rate (the 95 % intervals don't overlap):\n  {}\n",
        ratios.join(", "),
        named(&|column| !column.at_most_half()),
        named(&Table1Column::disagrees),
    )
}

fn percent(part: usize, whole: usize) -> String {
    or_dash((whole > 0).then_some(whole), |whole| format!("{:.1}", 100.0 * part as f64 / whole as f64))
}

/// The 95 % interval of a rate in percent.
fn sureness(part: usize, whole: usize) -> String {
    let interval = (whole > 0).then(|| ConfidenceInterval::wilson(part, whole));
    or_dash(interval, |interval| format!("{:.1}-{:.1}", 100.0 * interval.low, 100.0 * interval.high))
}

/// The value, or a dash.
fn or_dash<T>(value: Option<T>, show: impl Fn(T) -> String) -> String {
    value.map_or_else(|| "-".to_owned(), show)
}

fn number(value: Option<f64>) -> String {
    or_dash(value, |value| format!("{value:.2}"))
}

fn mean(spread: Option<Spread>) -> String {
    or_dash(spread, |spread| seconds(spread.mean))
}

fn median(spread: Option<Spread>) -> String {
    or_dash(spread, |spread| seconds(spread.median))
}

/// A time in a suitable unit.
fn seconds(value: f64) -> String {
    if value >= 0.1 {
        format!("{value:.2} s")
    } else if value >= 1e-3 {
        format!("{:.2} ms", value * 1e3)
    } else {
        format!("{:.1} µs", value * 1e6)
    }
}
