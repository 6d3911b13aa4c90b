//! Ours against the peers, in words and tables.

use crate::markdown::{digits, ms, table};
use crate::peers::{Instance, PEERS, Peers, median, worst};

/// A table: its rows, each a list of cells; the first is the head.
type Rows = Vec<Vec<String>>;

/// The section.
pub(crate) fn section(peers: &Peers) -> String {
    let versions = PEERS.map(|(key, name)| format!("{name} {}", peers.versions[key])).join(", ");
    let asked: usize = peers.classes().iter().map(|(_, instances)| instances.len()).sum();
    format!(
        "## Ours against other solvers\n\n\
         {asked} knowledge bases, the same for all: our exact search, {versions}. What each is given, how it is timed and \
         what the classes are: [`benches/peers/README.md`](../benches/peers/README.md). Times in milliseconds from the \
         base in memory to the proven optimum, median / worst; `>` is the time limit, with the number of instances that a \
         solver left unsolved in brackets. {} The ratio is the fastest peer's time over ours on the same instance.\n\n\
         ![Each instance's time, per class and solver](results/peers.svg)\n\n{}\n\
         The same without what comes before the solving: how long the peers solve alone, models built and grounded, \
         median; and how long we take with what comes before it, from the scene to the base.\n\n{}\n\
         ### The synthetic class\n\n\
         No scene gives such bases: they are made to hurt a search by landmarks and hitting sets.\n\n{}\n{WHY}\n\
         ### 10,000 objects\n\n\
         No optimum is asked for here, but which of all objects can be derived at all: one closure. {}\n",
        agreement(peers),
        table(&times(peers, "class", &peers.classes())),
        table(&alone(peers)),
        table(&times(peers, "family", &peers.families())),
        crowds(peers),
    )
}

/// What the figures below can't say.
const WHY: &str = "A hitting set is what our search has to solve again and again, and here there is nothing else: no rule \
    to chain through, no forced object but those that are forced at once. Solvers that learn clauses and bound with \
    cores do that for a living. In webs and stacks each landmark is large and overlaps many others, so few are disjoint \
    and the bound climbs one by one.\n";

fn agreement(peers: &Peers) -> String {
    let solved = peers.instances.iter().filter(|instance| instance.derivable.is_some()).count();
    format!("All who finished agree on every one of {solved} answers (`benches/peers/run` fails otherwise).")
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
        row.push(times_as_long(ratios.iter().copied().fold(f64::INFINITY, f64::min)));
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
        let whole = |instance: &Instance| instance.knowledge.map(|knowledge| knowledge + instance.ours());
        let known: Vec<f64> = instances.iter().filter_map(|instance| whole(instance)).collect();
        let ours = if known.is_empty() {
            "no scene".to_owned()
        } else {
            format!("{} / {}", ms(median(known.iter().copied())), ms(worst(known.iter().copied())))
        };
        let mut row = vec![format!("`{name}`"), ours];
        row.extend(PEERS.map(|(key, _)| {
            let middle = median(instances.iter().map(|instance| instance.peer_alone(key)));
            within(middle, peers.limit(key))
        }));
        row.push(times_as_long(median(instances.iter().filter_map(|instance| instance.ratio_alone()))));
        rows.push(row);
    }
    rows
}

fn crowds(peers: &Peers) -> String {
    let crowds = peers.crowds();
    let closing = median(crowds.iter().map(|crowd| crowd.ours()));
    let whole = worst(crowds.iter().map(|crowd| crowd.knowledge.unwrap_or_default() + crowd.ours()));
    let clingo = median(crowds.iter().map(|crowd| crowd.peer("clingo")));
    format!(
        "From the base we take {} ms, clingo {} ms ({} times as long); from the scene, the base of all 10,000 objects \
         included, we take {} ms at the most of {} scenes.",
        ms(closing),
        ms(clingo),
        times_as_long(clingo / closing),
        ms(whole),
        crowds.len(),
    )
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
    format!("{} / {}{note}", within(median(seconds()), limit), within(worst(seconds()), limit))
}

fn within(seconds: f64, limit: f64) -> String {
    if seconds.is_finite() { ms(seconds) } else { format!("> {}", ms(limit)) }
}

fn times_as_long(ratio: f64) -> String {
    if ratio.is_finite() { digits(ratio) } else { "∞".to_owned() }
}
