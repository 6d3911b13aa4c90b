//! Plans that are carried out by what a camera sees, in words and tables.

use crate::markdown::{count, listed, millimetres, or_dash, percent, ratio, row, share, table};
use crate::noise::{Cell, ENOUGH, Noise, Pool};
use crate::robot::{Controller, Tally};
use crate::robot_page::{collisions, other_ends};

/// The section of the camera's errors.
pub(crate) fn noise(figures: &Noise) -> String {
    format!(
        "## How much error a plan survives\n\n\
         `client-examples/robot-cell/run noise`: {} objects, {} episodes a cell, a gantry, a camera. In each picture each \
         centre is off by a normal error: σ along x and σ along y. The service is asked for a margin and a yaw tolerance. \
         Success is as in Table III, over the episodes that have a plan to the end. All cells have the same scenes and the \
         same errors. The yaw tolerances are taken together here: each scene counts once for each of them, which makes the \
         intervals narrower than they are for as many scenes.\n\n\
         ![Success against the margin, a line for each σ](results/noise.svg)\n\n\
         The grey line is at {}.\n\n{}\n\
         ### The least margin that is enough\n\n\
         A margin is enough if it and all larger ones succeed in at least {} of the episodes. No plan are episodes that \
         end at a deadlock or without space. Relocations are per episode, those without a plan included.\n\n{}\n{}\n\
         ### What the yaw tolerance does\n\n\
         The same for each yaw tolerance by itself. Success, no plan and relocations are over all margins.\n\n{}\n\
         ### What closes and opens beside a neighbour\n\n\
         Steps in which the closing hand pushes its dish against another one, and in which a finger meets another one while \
         it opens. They are over all margins and yaw tolerances. A hit moves what it meets, a touch is too light for that. \
         What the dish in the hand meets is no failure, but it is not clean.\n\n{}",
        figures.objects,
        figures.episodes,
        percent(ENOUGH),
        table(&successes(figures)),
        percent(ENOUGH),
        table(&enough(figures)),
        never(figures),
        table(&yaw_tolerances(figures)),
        table(&neighbours(figures)),
    )
}

/// A row a sigma, a column a margin.
fn successes(figures: &Noise) -> Vec<Vec<String>> {
    let margins = figures.values(|cell| cell.margin);
    let mut head = row(["σ"]);
    head.extend(margins.iter().map(|margin| format!("margin {}", millimetres(*margin))));
    let of_sigma = |sigma: f64| {
        let mut cells = vec![millimetres(sigma)];
        cells.extend(margins.iter().map(|&margin| {
            let pool = figures.pool(|cell| cell.sigma == sigma && cell.margin == margin);
            success(&pool)
        }));
        cells
    };
    [head].into_iter().chain(figures.values(|cell| cell.sigma).into_iter().map(of_sigma)).collect()
}

fn success(pool: &Pool<'_>) -> String {
    let (success, judged) = pool.success();
    share(success, judged)
}

fn without_plan(pool: &Pool<'_>) -> String {
    let (without, episodes) = pool.without_plan();
    share(without, episodes)
}

fn relocations(pool: &Pool<'_>) -> String {
    or_dash(pool.relocations(), |mean| format!("{mean:.2}"))
}

/// A row a sigma: the least margin that is enough, and what it costs against the least margin of all.
fn enough(figures: &Noise) -> Vec<Vec<String>> {
    let first = figures.values(|cell| cell.margin)[0];
    let with = |what: &str| format!("{what} with {}", millimetres(first));
    let mut rows = vec![row([
        "σ",
        "least margin",
        "success there",
        "no plan there",
        &with("no plan"),
        "relocations there",
        &with("relocations"),
    ])];
    for sigma in figures.values(|cell| cell.sigma) {
        let of = |margin: f64| figures.pool(move |cell| cell.sigma == sigma && cell.margin == margin);
        let (least, without) = (figures.least_margin(|cell| cell.sigma == sigma), of(first));
        let there = |show: fn(&Pool<'_>) -> String| or_dash(least, |margin| show(&of(margin)));
        rows.push(vec![
            millimetres(sigma),
            named(least),
            there(success),
            there(without_plan),
            without_plan(&without),
            there(relocations),
            relocations(&without),
        ]);
    }
    rows
}

fn named(margin: Option<f64>) -> String {
    margin.map_or_else(|| "none".to_owned(), millimetres)
}

/// For which sigmas no margin is enough.
fn never(figures: &Noise) -> String {
    let sigmas = figures.values(|cell| cell.sigma).into_iter();
    let never = sigmas.filter(|&sigma| figures.least_margin(|cell| cell.sigma == sigma).is_none());
    let never: Vec<String> = never.map(millimetres).collect();
    if never.is_empty() {
        return "Some margin is enough for each σ.\n".to_owned();
    }
    format!("No margin holds {} for a σ of {}.\n", percent(ENOUGH), listed(&never))
}

/// A row a sigma and yaw tolerance.
fn yaw_tolerances(figures: &Noise) -> Vec<Vec<String>> {
    let head = ["σ", "yaw tolerance", "success", "least margin", "success there", "no plan", "relocations"];
    let mut rows = vec![row(head)];
    for sigma in figures.values(|cell| cell.sigma) {
        for tolerance in figures.values(|cell| cell.yaw_tolerance) {
            let chosen = |cell: &Cell| cell.sigma == sigma && cell.yaw_tolerance == tolerance;
            let (all, least) = (figures.pool(chosen), figures.least_margin(chosen));
            let there = |margin: f64| success(&figures.pool(|cell| chosen(cell) && cell.margin == margin));
            rows.push(vec![
                millimetres(sigma),
                format!("{tolerance} rad"),
                success(&all),
                named(least),
                or_dash(least, there),
                without_plan(&all),
                relocations(&all),
            ]);
        }
    }
    rows
}

/// A row a sigma: steps with a contact beside a neighbour.
fn neighbours(figures: &Noise) -> Vec<Vec<String>> {
    let mut rows = vec![row([
        "σ",
        "grasps",
        "closing: the dish hits",
        "the dish touches",
        "releases",
        "opening: a finger hits",
        "a finger touches",
    ])];
    for sigma in figures.values(|cell| cell.sigma) {
        let pool = figures.pool(|cell| cell.sigma == sigma);
        let met = |phase: &str, what: &str, of: u32| {
            let steps = pool.sum(|tally| tally.contact(phase, what));
            or_dash(ratio(steps, of), |rate| format!("{} ({})", count(steps), percent(rate)))
        };
        let (grasps, releases) = (pool.sum(|tally| tally.grasps), pool.sum(|tally| tally.relocations));
        rows.push(vec![
            millimetres(sigma),
            count(grasps),
            met("closing", "dish hit", grasps),
            met("closing", "dish touch", grasps),
            count(releases),
            met("release", "finger hit", releases),
            met("release", "finger touch", releases),
        ]);
    }
    rows
}

/// A figure of a controller.
type Figure = (&'static str, fn(&Tally) -> String);

const FIGURES: [Figure; 12] = [
    ("target in hand", |tally| share(tally.end("in_hand"), tally.judged)),
    ("success", |tally| share(tally.success, tally.judged)),
    ("clean", |tally| share(tally.clean, tally.judged)),
    ("deadlock", |tally| of_tried(tally, "deadlock")),
    ("no space", |tally| of_tried(tally, "no_space")),
    ("timed out", |tally| of_tried(tally, "timed_out")),
    ("other ends", |tally| other_ends(tally, &["in_hand", "deadlock", "no_space", "timed_out"])),
    ("collisions", collisions),
    ("calls an episode", |tally| per_episode(tally, tally.plans + tally.verifications)),
    ("plans an episode", |tally| per_episode(tally, tally.plans)),
    ("verifications an episode", |tally| per_episode(tally, tally.verifications)),
    ("relocations an episode", |tally| per_episode(tally, tally.relocations)),
];

fn of_tried(tally: &Tally, end: &str) -> String {
    format!("{} of {}", tally.end(end), tally.episodes)
}

fn per_episode(tally: &Tally, whole: u32) -> String {
    or_dash(ratio(whole, tally.episodes), |mean| format!("{mean:.2}"))
}

/// The section of the controller.
pub(crate) fn controller(figures: &Controller) -> String {
    let mut rows = vec![row(["", "plans after each step", "asks first whether its plan still holds"])];
    rows.extend(
        FIGURES.map(|(what, figure)| vec![what.to_owned(), figure(&figures.plans_only), figure(&figures.asks_first)]),
    );
    format!(
        "## A controller in a noisy world\n\n\
         `client-examples/robot-cell/run controller`: {} objects, {} episodes, a gantry, a camera with a σ of {}, a margin of \
         {}. The controller looks again after each step. It plans anew, or it first asks the service whether what is left of \
         its plan still holds, and plans anew only where it does not. Rates are over the episodes that have a plan to the \
         end.\n\n{}",
        figures.objects,
        figures.episodes,
        millimetres(figures.sigma),
        millimetres(figures.margin),
        table(&rows),
    )
}
