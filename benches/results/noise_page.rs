//! The sections of docs/RESULTS.md about plans that rest on a noisy camera.

use crate::markdown::{count, listed, millimetres, or_dash, percent, ratio, row, share, table};
use crate::noise::{ENOUGH, Noise, Pool};
use crate::robot::{Controller, Tally};
use crate::robot_page::{collisions, other_ends, per_episode};

/// The section of the camera's errors.
pub(crate) fn noise(figures: &Noise) -> String {
    format!(
        "## How much error a plan survives\n\n\
         `client-examples/robot-cell/run noise`: {} objects, {} episodes for each σ, margin and yaw tolerance, a gantry, a \
         camera. In each picture each centre is off by a normal error: σ along x and σ along y. The service is asked for a \
         margin and a yaw tolerance. Success is as in Table III. A larger margin makes more deadlocks, which are not judged, so its rate is over fewer and easier scenes. All have the same scenes and the same errors.\n\n\
         ![Success against the margin, a line for each σ](results/noise.svg)\n\n\
         The picture is for the least yaw tolerance. The grey line is at {}.\n\n{}\n\
         ### The least margin that is enough\n\n\
         A margin is enough if with it, and with all larger ones of the same yaw tolerance, nothing is hit or dropped in at \
         least {} of the judged episodes. The intervals say how sure that is. Success asks for more, a target in the hand: now \
         and then a controller goes in circles, because each new picture shows the target blocked again. No plan are episodes \
         that end at a deadlock or without space. Relocations are per episode, those without a plan included.\n\n{}\n{}\n\
         ### Fingers that meet a neighbour, and presses\n\n\
         Grasps at which a finger hits another dish while the hand comes down, relocations in which the dish in the hand hits \
         another one, or a finger does while the hand opens, and judged episodes in which a closing hand presses its dish \
         against another one.\n\n{}",
        figures.objects,
        figures.episodes,
        percent(ENOUGH),
        table(&successes(figures)),
        percent(ENOUGH),
        table(&enough(figures)),
        never(figures),
        table(&neighbours(figures)),
    )
}

/// A row a sigma and yaw tolerance, a column a margin.
fn successes(figures: &Noise) -> Vec<Vec<String>> {
    let margins = figures.values(|cell| cell.margin);
    let mut head = row(["σ", "yaw tolerance"]);
    head.extend(margins.iter().map(|margin| format!("margin {}", millimetres(*margin))));
    let mut rows = vec![head];
    for (sigma, tolerance) in figures.series() {
        let mut cells = vec![millimetres(sigma), radians(tolerance)];
        cells.extend(margins.iter().map(|&margin| success(&figures.pool(|cell| cell.is(sigma, tolerance, margin)))));
        rows.push(cells);
    }
    rows
}

fn radians(angle: f64) -> String {
    format!("{angle} rad")
}

fn success(pool: &Pool<'_>) -> String {
    let (success, judged) = pool.success();
    share(success, judged)
}

fn unharmed(pool: &Pool<'_>) -> String {
    let (unharmed, judged) = pool.unharmed();
    share(unharmed, judged)
}

fn without_plan(pool: &Pool<'_>) -> String {
    let (without, episodes) = pool.without_plan();
    share(without, episodes)
}

fn relocations(pool: &Pool<'_>) -> String {
    or_dash(pool.relocations(), |mean| format!("{mean:.2}"))
}

/// A row a sigma and yaw tolerance: the least margin that is enough, and what it costs against the least one of all.
fn enough(figures: &Noise) -> Vec<Vec<String>> {
    let first = figures.values(|cell| cell.margin)[0];
    let with = |what: &str| format!("{what} with {}", millimetres(first));
    let mut rows = vec![row([
        "σ",
        "yaw tolerance",
        "least margin",
        "nothing hit or dropped there",
        "no plan there",
        &with("no plan"),
        "relocations there",
        &with("relocations"),
    ])];
    for (sigma, tolerance) in figures.series() {
        let of = |margin: f64| figures.pool(move |cell| cell.is(sigma, tolerance, margin));
        let (least, without) = (figures.least_margin(sigma, tolerance), of(first));
        let there = |show: fn(&Pool<'_>) -> String| or_dash(least, |margin| show(&of(margin)));
        rows.push(vec![
            millimetres(sigma),
            radians(tolerance),
            named(least),
            there(unharmed),
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

/// For which sigmas no margin is enough, whatever the yaw tolerance.
fn never(figures: &Noise) -> String {
    let tolerances = figures.values(|cell| cell.yaw_tolerance);
    let never = |sigma: &f64| tolerances.iter().all(|&tolerance| figures.least_margin(*sigma, tolerance).is_none());
    let never: Vec<String> = figures.values(|cell| cell.sigma).into_iter().filter(never).map(millimetres).collect();
    if never.is_empty() {
        return "With one of the yaw tolerances some margin is enough for each σ. Where few episodes were judged the intervals \
                are wide.\n"
            .to_owned();
    }
    format!("No margin holds {} for a σ of {}.\n", percent(ENOUGH), listed(&never))
}

/// A row a sigma and yaw tolerance, with the least margin and the largest one.
fn neighbours(figures: &Noise) -> Vec<Vec<String>> {
    let mut rows = vec![row([
        "σ",
        "yaw tolerance",
        "margin",
        "grasps",
        "a finger hits",
        "relocations",
        "the dish hits",
        "a finger hits at the release",
        "it touches",
        "judged",
        "presses",
    ])];
    let margins = figures.values(|cell| cell.margin);
    for (sigma, tolerance) in figures.series() {
        for margin in [margins[0], margins[margins.len() - 1]] {
            let mut cells = vec![millimetres(sigma), radians(tolerance), millimetres(margin)];
            cells.extend(met(&figures.pool(|cell| cell.is(sigma, tolerance, margin))));
            rows.push(cells);
        }
    }
    rows
}

fn met(pool: &Pool<'_>) -> Vec<String> {
    let part = |part: u32, of: u32| or_dash(ratio(part, of), |rate| format!("{} ({})", count(part), percent(rate)));
    let (grasps, relocations) = (pool.sum(|tally| tally.grasps), pool.sum(|tally| tally.relocations));
    let at = |phase: &'static str, what: &'static str| pool.sum(move |tally| tally.contact(phase, what));
    let judged = pool.sum(|tally| tally.judged);
    vec![
        count(grasps),
        part(at("descent", "finger hit"), grasps),
        count(relocations),
        part(at("carrying", "dish hit"), relocations),
        part(at("release", "finger hit"), relocations),
        part(at("release", "finger touch"), relocations),
        count(judged),
        part(pool.sum(|tally| tally.pressed), judged),
    ]
}

/// A figure of a controller.
type Figure = (&'static str, fn(&Tally) -> String);

const FIGURES: [Figure; 14] = [
    ("target in hand", |tally| share(tally.end("in_hand"), tally.judged)),
    ("success", |tally| share(tally.success, tally.judged)),
    ("clean", |tally| share(tally.clean, tally.judged)),
    ("deadlock", |tally| of_tried(tally, "deadlock")),
    ("no space", |tally| of_tried(tally, "no_space")),
    ("timed out", |tally| of_tried(tally, "timed_out")),
    ("other ends", |tally| other_ends(tally, &["in_hand", "deadlock", "no_space", "timed_out"])),
    ("contacts", collisions),
    ("episodes with a press", |tally| share(tally.pressed, tally.episodes)),
    ("pictures an episode", |tally| per_episode(tally, tally.pictures)),
    ("calls an episode", |tally| per_episode(tally, tally.plans + tally.verifications)),
    ("plans an episode", |tally| per_episode(tally, tally.plans)),
    ("verifications an episode", |tally| per_episode(tally, tally.verifications)),
    ("relocations an episode", |tally| per_episode(tally, tally.relocations)),
];

fn of_tried(tally: &Tally, end: &str) -> String {
    format!("{} of {}", tally.end(end), tally.episodes)
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
         its plan still holds, and plans anew only where it does not. Rates are as in Table III. Contacts of the dish at `closing` and `lifting` are presses.\n\n{}",
        figures.objects,
        figures.episodes,
        millimetres(figures.sigma),
        millimetres(figures.margin),
        table(&rows),
    )
}
