//! The sections of docs/RESULTS.md about plans that a robot carries out on exact data.

use std::collections::BTreeMap;

use crate::markdown::{count, length, millimetres, or_dash, percent, ratio, row, share, table, time};
use crate::robot::{Apart, Column3, Hand, Palm, Relocations, Table3, Tallied, Tally, Tolerance};

/// The ends that have a column, and that of a success.
const NAMED_ENDS: [&str; 4] = ["in_hand", "out_of_reach", "no_path", "no_space"];

/// The section of Table III.
pub(crate) fn table3(figures: &Table3) -> String {
    format!(
        "## The paper's Table III\n\n\
         `client-examples/robot-cell/run table3`: a client of the service carries plans out in MuJoCo {}, {} episodes for \
         each N and each set of methods. {} Scenes and targets are those of Table I. A scene that the methods call a \
         deadlock is passed over, so each set has scenes of its own. The paper's methods in our code are the sector model, \
         LOBS and the raster. Their plans are carried out even where our checker finds a fault in them.\n\n\
         Success is a target in the hand, with nothing hit by hand, arm or the dish in the hand, and nothing dropped. A contact \
         that is too light to move what it meets is a touch and no hit. What a dish meets while the hand closes on it and lifts \
         it is a press and no hit: the hand pulls the dish to where it was seen, and no margin prevents that. An episode is clean \
         if it is a success without touches, presses and disturbances. Rates are over the judged episodes, with their 95 % \
         intervals (Wilson). Not judged are episodes that end in a deadlock, without space or out of the arm's reach, unless \
         something was hit or dropped before. No path is a failure: the arm reaches both ends of a way, but none between them is found. Unlike in Table II, no space is not counted as a failure.\n\n\
         The controller plans anew after each step. Planning time is that of all calls of an episode, as the client waits \
         for them; beside it is what the service counts itself. Execution time is simulated. All three are means over all \
         episodes, those that ended early included.\n\n{}\n\
         Collisions count steps, by phase and by what met something. Disturbances are dishes moved by more than 1 mm that \
         the step was not about.\n\n{}",
        figures.versions.mujoco,
        figures.episodes,
        mechanism(figures),
        table(&outcomes(figures)),
        table(&troubles(figures)),
    )
}

/// What carries the hand.
fn mechanism(figures: &Table3) -> String {
    if figures.mechanism == "arm" {
        format!(
            "The arm is a UR10e, since the paper's own, an M1013, is in no registry: execution times are another arm's. \
             OMPL {} finds its ways.",
            figures.versions.ompl
        )
    } else {
        format!("A {} carries the hand, so execution times are not those of an arm.", figures.mechanism)
    }
}

fn methods(column: &Column3) -> &'static str {
    if column.method == "ours" { "our methods" } else { "the paper's methods, in our code" }
}

/// A row for what the paper prints, before the rows of each N.
fn outcomes(figures: &Table3) -> Vec<Vec<String>> {
    let mut rows = vec![row([
        "N",
        "whose",
        "judged",
        "success",
        "clean",
        "planning time",
        "in the service",
        "execution time",
        "relocations an episode",
    ])];
    let mut last = None;
    for Tallied { of, tally } in &figures.columns {
        if last.replace(of.objects) != Some(of.objects) {
            let [n, success] = [of.objects.to_string(), percent(of.paper.success)];
            let [planning, execution] = [of.paper.planning_s, of.paper.execution_s].map(time);
            rows.push(row([&n, "the paper", "–", &success, "–", &planning, "–", &execution, "–"]));
        }
        let mut cells = row(["", methods(of), &format!("{} of {}", tally.judged, tally.episodes)]);
        cells.extend([tally.success, tally.clean].map(|part| share(part, tally.judged)));
        let times = [of.planning_s_mean, of.service_s_mean, of.execution_s_mean];
        cells.extend(times.map(|seconds| or_dash(seconds, time)));
        cells.push(per_episode(tally, tally.relocations));
        rows.push(cells);
    }
    rows
}

/// What else became of the episodes.
fn troubles(figures: &Table3) -> Vec<Vec<String>> {
    let mut rows = vec![row([
        "N",
        "whose",
        "deadlocks passed over",
        "out of reach",
        "no path",
        "no space",
        "other ends",
        "collisions",
        "disturbances",
        "dropped",
        "plans with faults",
    ])];
    for Tallied { of, tally } in &figures.columns {
        let mut cells = row([&of.objects.to_string(), methods(of), &count(of.deadlocks_passed_over)]);
        cells.extend(["out_of_reach", "no_path", "no_space"].map(|end| count(tally.end(end))));
        cells.extend([other_ends(tally, &NAMED_ENDS), collisions(tally)]);
        cells.extend([tally.disturbances, tally.drops, of.faulty_plans].map(count));
        rows.push(cells);
    }
    rows
}

/// Ends but those that are named elsewhere.
pub(crate) fn other_ends(tally: &Tally, named: &[&str]) -> String {
    let others = tally.ends.iter().filter(|(end, _)| !named.contains(&end.as_str()));
    listed(others.map(|(end, count)| format!("`{end}` {count}")).collect(), ", ")
}

/// Steps with a contact: `descent: finger hit 3`.
pub(crate) fn collisions(tally: &Tally) -> String {
    let of_phase = |(phase, kinds): (&String, &BTreeMap<String, u32>)| {
        let kinds: Vec<String> = kinds.iter().map(|(what, count)| format!("{what} {count}")).collect();
        format!("{phase}: {}", kinds.join(", "))
    };
    listed(tally.contacts.iter().map(of_phase).collect(), "; ")
}

/// A count over the episodes.
pub(crate) fn per_episode(tally: &Tally, whole: u32) -> String {
    or_dash(ratio(whole, tally.episodes), |mean| format!("{mean:.2}"))
}

fn listed(words: Vec<String>, between: &str) -> String {
    if words.is_empty() { "none".to_owned() } else { words.join(between) }
}

/// The section of the relocations, with what the simulator itself may get wrong.
pub(crate) fn relocations(figures: &Tallied<Relocations>, tolerance: &Tolerance) -> String {
    let total = &figures.tally;
    format!(
        "## A thousand relocations\n\n\
         `client-examples/robot-cell/run relocations`: a gantry carries out {} relocations in {} episodes. It reaches \
         everything, and it is told where each dish stands, so neither an arm's reach nor a camera's error plays a part. The \
         dishes of a kind called `paper` are all alike, as the paper's are, the others have different radii. Two jaws are a \
         2F-85, all others a hand with three pads. Each target is the object of its scene that needs the most relocations \
         and can be freed. Success, clean, collisions and disturbances are as in Table III. A place's error is the \
         distance between where a dish was to be and where it is in the end.\n\n{}\n\
         ### The simulator's own tolerance\n\n\
         `client-examples/robot-cell/run tolerance`: pairs that stand a few micrometres apart. What the simulator reports of \
         them is its own error.\n\n{}\n{}",
        count(total.relocations),
        count(total.episodes),
        table(&kinds(figures)),
        table(&pairs(tolerance)),
        threshold(tolerance),
    )
}

fn kinds(figures: &Tallied<Relocations>) -> Vec<Vec<String>> {
    let mut rows = vec![row([
        "scenes",
        "episodes",
        "relocations",
        "success",
        "clean",
        "other ends",
        "collisions",
        "disturbances",
        "dropped",
        "place error, mean",
        "greatest",
    ])];
    let all = figures.of.by_kind.iter().map(|(kind, tally)| (format!("`{kind}`"), tally));
    for (label, tally) in all.chain([("all".to_owned(), &figures.tally)]) {
        let mut cells = vec![label];
        cells.extend([tally.episodes, tally.relocations].map(count));
        cells.extend([tally.success, tally.clean].map(|part| share(part, tally.judged)));
        cells.extend([other_ends(tally, &["in_hand"]), collisions(tally)]);
        cells.extend([tally.disturbances, tally.drops].map(count));
        cells.extend([tally.place_error_mean, tally.place_error_max].map(|error| or_dash(error, length)));
        rows.push(cells);
    }
    rows
}

fn pairs(tolerance: &Tolerance) -> Vec<Vec<String>> {
    let head = row(["what", "pairs", "reported to overlap", "deepest"]);
    let of = |(kind, apart): (&String, &Apart)| {
        vec![kind.clone(), count(apart.pairs), count(apart.reported), length(apart.deepest)]
    };
    [head].into_iter().chain(tolerance.kinds.iter().map(of)).collect()
}

/// Whether the judge overlooks all that the simulator makes up.
fn threshold(tolerance: &Tolerance) -> String {
    let deepest = tolerance.kinds.values().map(|apart| apart.deepest).fold(0.0, f64::max);
    let so_deep = if deepest < tolerance.judged_from { "none of these is" } else { "some of these are" };
    let depth = length(tolerance.judged_from);
    format!("All experiments count a contact only if it is deeper than {depth}; {so_deep}.\n")
}

/// The section of hands.
pub(crate) fn hand(figures: &Hand) -> String {
    let mut offsets: Vec<f64> = figures.rows.iter().map(|row| row.offset).collect();
    offsets.sort_unstable_by(f64::total_cmp);
    offsets.dedup();
    let mut hands: Vec<&str> = figures.rows.iter().map(|row| row.hand.as_str()).collect();
    hands.dedup();
    let mut rows = vec![row(["hand"])];
    rows[0].extend(offsets.iter().map(|offset| format!("seen {} off", millimetres(*offset))));
    for hand in hands {
        let mut cells = row([hand]);
        cells.extend(offsets.iter().map(|offset| {
            let found = figures.rows.iter().find(|row| row.hand == hand && row.offset == *offset);
            or_dash(found, |found| format!("{} / {}", length(found.mean), length(found.worst)))
        }));
        rows.push(cells);
    }
    format!(
        "## What a hand makes of an error\n\n\
         `client-examples/robot-cell/run hand`: a dish stands beside where it was seen, in a random direction. A gantry \
         relocates it. The table has the distance between the dish and its new place, mean / greatest of {} grasps. Two jaws \
         push a dish along one line only, three pads or more push it towards the middle.\n\n{}",
        figures.grasps,
        table(&rows),
    )
}

/// The section of palms.
pub(crate) fn palm(figures: &Palm) -> String {
    let mut rows = vec![row(["fingers", "steps", "the palm meets a neighbour"])];
    for fingers in &figures.rows {
        let met = share(fingers.palm_meets, fingers.steps);
        rows.push(row([&millimetres(fingers.finger_length), &fingers.steps.to_string(), &met]));
    }
    let [low, high] = figures.heights.map(millimetres);
    format!(
        "## Palms over neighbours\n\n\
         `client-examples/robot-cell/run palm`: dishes are {low} to {high} high. Only those that go under the palm are grasped, \
         with the fingertips at the table.\n\n{}",
        table(&rows),
    )
}
