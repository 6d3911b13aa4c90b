//! Ours against the peers, in words and tables.

use crate::markdown::{digits, table, time};
use crate::peers::{Instance, PEERS, Peers, median, worst};
use crate::targets;

/// A table: its rows, each a list of cells; the first is the head.
type Rows = Vec<Vec<String>>;

/// The section.
pub(crate) fn section(peers: &Peers) -> String {
    let versions = PEERS.map(|(key, name)| format!("{name} {}", peers.versions[key])).join(", ");
    let asked: usize = peers.classes().iter().map(|(_, instances)| instances.len()).sum();
    format!(
        "## Ours against other solvers\n\n\
         {asked} knowledge bases with a target, and {} of 10,000 objects without a target, are the same for all solvers: our \
         exact search, {versions}. [`benches/peers/README.md`](../benches/peers/README.md) describes the encodings, the \
         timing and the classes. Times are from the base in memory to the proven optimum, median / worst. `>` marks the \
         time limit. The number of unsolved instances is in brackets. {} \
         The ratio is the fastest peer's time over ours on the same instance.\n\n\
         ![Each instance's time, per class and solver](results/peers.svg)\n\n{}\n\
         {}\n\
         ### Solving alone\n\n\
         For the peers, the median time of solving alone, without building and grounding the model. For our search, the time \
         from the scene to the optimum, building the base included.\n\n{}\n\
         ### The synthetic class\n\n\
         No scene gives such bases. They are made to be hard for a search by landmarks and hitting sets.\n\n{}\n{}\n\
         ### 10,000 objects\n\n\
         The question here is not the optimum, but which objects can be derived at all: one forward chaining. {}\n",
        peers.crowds().len(),
        agreement(peers),
        table(&times(peers, "class", &peers.classes())),
        targets::section(peers),
        table(&alone(peers)),
        table(&times(peers, "family", &peers.families())),
        reasons(peers),
        crowds(peers),
    )
}

/// What the figures can't say of a family in which a peer is ahead.
const REASONS: [(&str, &str); 4] = [
    (
        "vertex cover",
        "nothing but a hitting set, with two members a set. Our Lagrangian bound equals that of linear programming, \
        which odd cycles keep below the optimum. Our search must branch over the gap.",
    ),
    (
        "hitting set",
        "nothing but a hitting set, again with a gap between linear programming and whole numbers. Solvers that \
        learn clauses and bound with cores close it better.",
    ),
    ("web", "each landmark is large and overlaps many others; it takes many failed chains to bound well."),
    (
        "stack",
        "many objects share what they need, so the linear programme over the landmarks leaves a wide gap to the optimum \
        in whole numbers. Our search must notice that before it turns to clauses over the options, with which the \
        others begin.",
    ),
];

/// Why the lost families are lost.
fn reasons(peers: &Peers) -> String {
    let ahead = |(_, instances): &(&str, Vec<&Instance>)| {
        median(instances.iter().filter_map(|instance| instance.ratio())).is_some_and(|ratio| ratio < 1.0)
    };
    let lost: Vec<&str> = peers.families().into_iter().filter(ahead).map(|(family, _)| family).collect();
    if lost.is_empty() {
        return "None of these families is lost in the median.\n".to_owned();
    }
    let reason = |family: &&str| REASONS.iter().find(|(name, _)| name == family).map(|(_, reason)| *reason);
    let line = |family: &&str| format!("* `{family}`: {}\n", reason(family).unwrap_or("no reason known."));
    format!("Lost in the median:\n\n{}", lost.iter().map(line).collect::<String>())
}

fn agreement(peers: &Peers) -> String {
    let solved = peers.instances.iter().filter(|instance| instance.derivable.is_some()).count();
    format!(
        "All solvers that finished agree on each of the {solved} answers, including those on 10,000 objects (`benches/peers/run` \
         fails otherwise)."
    )
}

/// A row a group: what it holds, everybody's times, the ratios.
fn times(peers: &Peers, what: &str, groups: &[(&str, Vec<&Instance>)]) -> Rows {
    let mut head = vec![what, "instances", "optimum", "deadlocks", "ours"];
    head.extend(PEERS.map(|(_, name)| name));
    head.extend(["ratio, median", "ratio, least", "ours faster"]);
    let mut rows = vec![head.into_iter().map(str::to_owned).collect()];
    for (name, instances) in groups {
        let mut row = vec![format!("`{name}`"), instances.len().to_string(), optima(instances)];
        row.push(instances.iter().filter(|instance| instance.derivable == Some(false)).count().to_string());
        row.push(spread(instances, peers.time_limit_seconds, Instance::ours));
        row.extend(PEERS.map(|(key, _)| spread(instances, peers.limit(key), |instance| instance.peer(key))));
        let ratios: Vec<f64> = instances.iter().filter_map(|instance| instance.ratio()).collect();
        row.push(times_as_long(median(ratios.iter().copied())));
        row.push(times_as_long(ratios.iter().copied().min_by(f64::total_cmp)));
        let faster = ratios.iter().filter(|ratio| **ratio > 1.0).count();
        row.push(format!("{faster} of {}", ratios.len()));
        rows.push(row);
    }
    rows
}

/// A row a class: the peers without their preparations, we with ours.
fn alone(peers: &Peers) -> Rows {
    let mut head = vec!["class".to_owned(), "ours, scene to optimum".to_owned()];
    head.extend(PEERS.map(|(_, name)| format!("{name}, solving alone")));
    head.push("ratio to our search, median".to_owned());
    let mut rows = vec![head];
    for (name, instances) in peers.classes() {
        let scenes = instances.iter().filter(|instance| instance.knowledge.is_some());
        let known: Vec<f64> = scenes.map(|instance| instance.with_knowledge()).collect();
        let ours = median(known.iter().copied()).zip(worst(known.iter().copied()));
        let ours = ours.map_or_else(
            || "no scene".to_owned(),
            |(middle, worst)| {
                format!("{} / {}", within(middle, peers.time_limit_seconds), within(worst, peers.time_limit_seconds))
            },
        );
        let mut row = vec![format!("`{name}`"), ours];
        row.extend(PEERS.map(|(key, _)| {
            let middle = median(instances.iter().map(|instance| instance.peer_alone(key)));
            middle.map_or_else(unmeasured, |middle| within(middle, peers.limit(key)))
        }));
        row.push(times_as_long(median(instances.iter().filter_map(|instance| instance.ratio_alone()))));
        rows.push(row);
    }
    rows
}

fn crowds(peers: &Peers) -> String {
    let crowds = peers.crowds();
    let figures = median(crowds.iter().map(|crowd| crowd.ours()))
        .zip(worst(crowds.iter().map(|crowd| crowd.with_knowledge())))
        .zip(median(crowds.iter().map(|crowd| crowd.peer("clingo"))));
    let told = |((closing, whole), clingo): ((f64, f64), f64)| {
        format!(
            "From the base our median time is {}, clingo's is {} ({} times as long). From the scene, with the base of all \
             10,000 objects, our worst time is {} in {} scenes.",
            time(closing),
            within(clingo, peers.limit("clingo")),
            times_as_long(Some(clingo / closing)),
            time(whole),
            crowds.len(),
        )
    };
    figures.map_or_else(|| "Not measured.".to_owned(), told)
}

fn optima(instances: &[&Instance]) -> String {
    let least = instances.iter().filter_map(|instance| instance.optimum).min();
    let greatest = instances.iter().filter_map(|instance| instance.optimum).max();
    least.zip(greatest).map_or_else(|| "none".to_owned(), |(least, greatest)| format!("{least} to {greatest}"))
}

/// Median and worst; how many were not solved.
fn spread(instances: &[&Instance], limit: f64, time: impl Fn(&Instance) -> f64) -> String {
    let seconds = || instances.iter().map(|instance| time(instance));
    let unsolved = seconds().filter(|time| time.is_infinite()).count();
    let note = if unsolved > 0 { format!(" ({unsolved})") } else { String::new() };
    let figures = median(seconds()).zip(worst(seconds()));
    figures.map_or_else(unmeasured, |(middle, worst)| {
        format!("{} / {}{note}", within(middle, limit), within(worst, limit))
    })
}

fn within(seconds: f64, limit: f64) -> String {
    if seconds.is_finite() { time(seconds) } else { format!("> {}", time(limit)) }
}

fn times_as_long(ratio: Option<f64>) -> String {
    ratio.map_or_else(unmeasured, |ratio| if ratio.is_finite() { digits(ratio) } else { "∞".to_owned() })
}

fn unmeasured() -> String {
    "not measured".to_owned()
}
