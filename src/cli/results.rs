//! The paper's tables for people: our figures with the paper's in the next column.

use super::table::{Column, table};
use crate::experiments::{
    ExperimentSettings, Interval, MethodFigures, ModelFigures, PlacementFigures, PlanFigures, Printed, Repositioning,
    Spread, TABLE1_EPISODES, TABLE2_EPISODES, Table1Column, Table2Column,
};
use crate::plan::{GraspModel, SearchMethod};

/// What nobody can repeat.
pub(super) const NOT_THE_SAME: &str = "\
What can't be as it was for the paper's own figures: its machine; its scenes, which it only says
are random; whether it counts the target as a relocation (here it isn't). Its baseline and its LOBS
can't have seen the same scenes: for N=16 the one finds sequences in 95 % of them, the other calls
20 % a deadlock. Our baseline knows a set of objects again that it reached in another order; of that
the paper says nothing.";

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
        "A search that the time limit or the limit of memory ended counts as the time limit.\n".to_owned(),
        plans(columns),
        conclusions(columns),
        format!("{NOT_THE_SAME}\n"),
    ]
    .join("\n")
}

/// Table II.
pub(super) fn table2(settings: &ExperimentSettings, columns: &[Table2Column]) -> String {
    let ExperimentSettings { episodes, seed, .. } = settings;
    let limit = seconds(settings.time_limit.as_secs_f64());
    let titles = [
        Column::right("N"),
        Column::left("places"),
        Column::right("episodes"),
        Column::right("success %"),
        Column::right("paper"),
        Column::right("graspable"),
        Column::right("no space"),
        Column::right("late"),
        Column::right("mean time"),
        Column::right("median"),
        Column::right("paper"),
        Column::right("faulty"),
        Column::right("at release"),
        Column::right("otherwise"),
        Column::left("faults"),
    ];
    let row = |column: &Table2Column, figures: &PlacementFigures| {
        let faults = figures.faults.iter().map(|(code, count)| format!("{code} {count}"));
        let placement = match figures.placement {
            Repositioning::Raster => "raster",
            Repositioning::Exact => "exact",
        };
        vec![
            column.case.objects.to_string(),
            placement.to_owned(),
            figures.episodes.to_string(),
            percent(figures.successes, figures.episodes),
            "100".to_owned(),
            figures.graspable.to_string(),
            figures.no_space.to_string(),
            figures.late.to_string(),
            mean(figures.reposition_s),
            median(figures.reposition_s),
            column.case.reposition_s.map(seconds).unwrap_or_default(),
            figures.faulty.to_string(),
            figures.release_blocked.to_string(),
            figures.otherwise_faulty.to_string(),
            faults.collect::<Vec<_>>().join(", "),
        ]
    };
    let rows = columns.iter().flat_map(|column| column.placements.iter().map(move |figures| row(column, figures)));
    [
        format!(
            "Table II: {episodes} episodes a column (the paper {TABLE2_EPISODES}), seed {seed}, time limit {limit}: places \
             for the sequences that LOBS finds by the sector model\n"
        ),
        table(&titles, rows),
        "Times are over the episodes in which something has to be moved: all but the graspable ones.\n\
         Faulty are plans that the checker refuses, which judges by the swept finger; at release: a finger meets an \
         obstacle when it lets go. The exact places are sought by the sector model too, which overlooks the fingers' outer\n\
         corners: hence their faults.\n"
            .to_owned(),
        format!("{NOT_THE_SAME}\n"),
    ]
    .join("\n")
}

/// Each column's methods by each grasp model, with what the paper prints for the same method.
fn methods(columns: &[Table1Column]) -> impl Iterator<Item = (&Table1Column, &ModelFigures, &MethodFigures)> {
    columns.iter().flat_map(|column| {
        let models = [&column.sector, &column.swept_finger];
        models.into_iter().flat_map(move |model| model.methods.iter().map(move |method| (column, model, method)))
    })
}

/// What the paper prints for a method; it has the sector model only.
fn printed<'c>(column: &'c Table1Column, model: &ModelFigures, method: &MethodFigures) -> Option<&'c Printed> {
    match (model.grasp_model, method.method) {
        (GraspModel::Sector, SearchMethod::ForwardAstar) => Some(&column.case.base),
        (GraspModel::Sector, SearchMethod::Lobs) => Some(&column.case.lobs),
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

fn model_of(model: GraspModel) -> String {
    match model {
        GraspModel::Sector => "sector",
        GraspModel::SweptFinger => "swept finger",
    }
    .to_owned()
}

/// How the searches end.
fn endings(columns: &[Table1Column]) -> String {
    let titles = [
        Column::right("N"),
        Column::left("model"),
        Column::left("method"),
        Column::right("episodes"),
        Column::right("deadlock %"),
        Column::right("(95 %)"),
        Column::right("paper"),
        Column::right("(95 %)"),
        Column::right("success %"),
        Column::right("paper"),
        Column::right("graspable"),
        Column::right("late"),
        Column::right("too large"),
        Column::right("false deadlock"),
        Column::right("not optimal"),
    ];
    let rows = methods(columns).map(|(column, model, method)| {
        let paper = printed(column, model, method);
        vec![
            column.case.objects.to_string(),
            model_of(model.grasp_model),
            name_of(method.method),
            method.episodes.to_string(),
            percent(method.deadlocks, method.episodes),
            if method.episodes == 0 { "-".to_owned() } else { interval(method.deadlock_interval()) },
            paper.map(|paper| percent(paper.deadlocks, TABLE1_EPISODES)).unwrap_or_default(),
            paper.map(|paper| interval(paper.deadlock_interval())).unwrap_or_default(),
            percent(method.successes, method.episodes),
            paper.map(|paper| percent(paper.successes, TABLE1_EPISODES)).unwrap_or_default(),
            method.graspable.to_string(),
            method.late.to_string(),
            method.too_large.to_string(),
            method.false_deadlocks.to_string(),
            method.not_optimal.to_string(),
        ]
    });
    table(&titles, rows)
}

/// How long the searches take, and how many relocations they come to.
fn searches(columns: &[Table1Column]) -> String {
    let titles = [
        Column::right("N"),
        Column::left("model"),
        Column::left("method"),
        Column::right("knowledge"),
        Column::right("search"),
        Column::right("median"),
        Column::right("paper"),
        Column::right("relocations"),
        Column::right("paper"),
    ];
    let rows = methods(columns).map(|(column, model, method)| {
        let paper = printed(column, model, method);
        vec![
            column.case.objects.to_string(),
            model_of(model.grasp_model),
            name_of(method.method),
            mean(model.knowledge_s),
            mean(method.search_s),
            median(method.search_s),
            paper.map(|paper| seconds(paper.search_s)).unwrap_or_default(),
            number(method.relocations_mean),
            paper.map(|paper| number(Some(paper.relocations))).unwrap_or_default(),
        ]
    });
    table(&titles, rows)
}

/// Our planner's answers, places and check included.
fn plans(columns: &[Table1Column]) -> String {
    let titles = [
        Column::right("N"),
        Column::left("planned by the swept finger"),
        Column::right("episodes"),
        Column::right("graspable"),
        Column::right("plan"),
        Column::right("least"),
        Column::right("deadlock"),
        Column::right("no space"),
        Column::right("timed out"),
        Column::right("relocations"),
        Column::right("mean time"),
        Column::right("median"),
    ];
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
    let rows = columns.iter().flat_map(|column| {
        [row(column, "every scene", &column.plans), row(column, "a deadlock by sector alone", &column.extra)]
    });
    table(&titles, rows)
}

/// What does not fit the paper, and what the swept finger gains.
fn conclusions(columns: &[Table1Column]) -> String {
    let named = |of: &dyn Fn(&Table1Column) -> bool| {
        let names: Vec<String> =
            columns.iter().filter(|column| of(column)).map(|column| format!("N={}", column.case.objects)).collect();
        if names.is_empty() { "none".to_owned() } else { names.join(", ") }
    };
    let ratio = |column: &Table1Column| {
        let ratio = column.deadlock_ratio().map_or_else(|| "no deadlock".to_owned(), |ratio| format!("{ratio:.2}"));
        format!("N={}: {ratio}", column.case.objects)
    };
    let ratios: Vec<String> = columns.iter().map(ratio).collect();
    format!(
        "Deadlocks by the swept finger over deadlocks by the sector model: {}\n\
         Columns where that is more than one half: {}\n\
         Columns where LOBS disagrees with the paper's deadlock rate (the 95 % intervals don't overlap): {}\n",
        ratios.join(", "),
        named(&|column| !column.at_most_half()),
        named(&Table1Column::disagrees),
    )
}

fn percent(part: usize, whole: usize) -> String {
    if whole == 0 { "-".to_owned() } else { format!("{:.1}", 100.0 * part as f64 / whole as f64) }
}

fn interval(interval: Interval) -> String {
    format!("{:.1}-{:.1}", 100.0 * interval.low, 100.0 * interval.high)
}

fn number(value: Option<f64>) -> String {
    value.map_or_else(|| "-".to_owned(), |value| format!("{value:.2}"))
}

fn mean(spread: Option<Spread>) -> String {
    spread.map_or_else(|| "-".to_owned(), |spread| seconds(spread.mean))
}

fn median(spread: Option<Spread>) -> String {
    spread.map_or_else(|| "-".to_owned(), |spread| seconds(spread.median))
}

/// A time in the unit that suits it.
fn seconds(value: f64) -> String {
    if value >= 0.1 {
        format!("{value:.2} s")
    } else if value >= 1e-3 {
        format!("{:.2} ms", value * 1e3)
    } else {
        format!("{:.1} µs", value * 1e6)
    }
}
