//! What we set out to reach against the peers, and what of it the figures bear out.

use crate::markdown::{digits, row, table, time};
use crate::peers::{Instance, Peers, median};

/// The fastest peer's time over ours, in the median of each class.
const LEAST_MEDIAN_RATIO: f64 = 10.0;
/// So many instances with an optimum.
const LEAST_INSTANCES: usize = 500;
/// For our search on each instance of these classes, s.
const PRESSED_BOUND: f64 = 0.010;
const PRESSED: [&str; 2] = ["pressed-300", "pressed-600"];
/// From a scene of 10,000 objects to the knowledge of what can be derived, s.
const CROWD_BOUND: f64 = 0.020;
/// So many misses are named one by one.
const NAMED: usize = 6;

/// How an instance is compared with the peers.
type Ratio = fn(&Instance) -> Option<f64>;

/// The targets, and which of them hold.
pub(crate) fn section(peers: &Peers) -> String {
    let asked: usize = peers.classes().iter().map(|(_, instances)| instances.len()).sum();
    let mut rows = vec![row(["target", "here"])];
    let ratios: [(&str, Ratio); 2] = [("", Instance::ratio), (", the peers solving alone", Instance::ratio_alone)];
    for (how, ratio) in ratios {
        let what =
            format!("the fastest peer takes 10 times as long as ours in the median of each scene-born class{how}");
        rows.push(vec![what, medians(peers, ratio)]);
        rows.push(vec![format!("ours is faster on every scene-born instance{how}"), each(peers, ratio)]);
    }
    let pressed = peers.scene_born().into_iter().filter(|(class, _)| PRESSED.contains(class));
    let pressed: Vec<&Instance> = pressed.flat_map(|(_, instances)| instances).collect();
    let figures = within(&pressed, PRESSED_BOUND, Instance::ours);
    rows.push(row(["pressed clusters of 300 and 600: the proven optimum within 10 ms", &figures]));
    let figures = within(&peers.crowds(), CROWD_BOUND, Instance::with_knowledge);
    rows.push(row(["10,000 objects: knowledge and deadlock within 20 ms", &figures]));
    let many = if asked >= LEAST_INSTANCES { "holds".to_owned() } else { format!("missed: {asked}") };
    rows.push(row(["at least 500 instances with an optimum to prove", &many]));
    format!("### Targets\n\n{}", table(&rows))
}

fn medians(peers: &Peers, ratio: Ratio) -> String {
    let classes = peers.scene_born().into_iter();
    let medians = classes.filter_map(|(class, instances)| {
        Some((class, median(instances.iter().filter_map(|instance| ratio(instance)))?))
    });
    let medians: Vec<(&str, f64)> = medians.collect();
    let missed = medians.iter().filter(|(_, median)| *median < LEAST_MEDIAN_RATIO);
    verdict(medians.len(), missed.map(|(class, median)| format!("`{class}`: {}", digits(*median))).collect())
}

fn each(peers: &Peers, ratio: Ratio) -> String {
    let instances: Vec<&Instance> = peers.scene_born().into_iter().flat_map(|(_, instances)| instances).collect();
    let ratios = instances.iter().filter_map(|instance| Some((instance, ratio(instance)?)));
    let ratios: Vec<_> = ratios.collect();
    let missed = ratios.iter().filter(|(_, ratio)| *ratio <= 1.0);
    verdict(ratios.len(), missed.map(|(instance, ratio)| format!("{}: {}", named(instance), digits(*ratio))).collect())
}

fn within(instances: &[&Instance], bound: f64, seconds: fn(&Instance) -> f64) -> String {
    let missed = instances.iter().filter(|instance| seconds(instance) > bound);
    let told = |instance: &&Instance| {
        let seconds = seconds(instance);
        let figure = if seconds.is_finite() { time(seconds) } else { "not finished".to_owned() };
        format!("{}: {figure}", named(instance))
    };
    verdict(instances.len(), missed.map(told).collect())
}

fn named(instance: &Instance) -> String {
    format!("`{}` {}", instance.class, instance.name)
}

/// Of so many that were measured, these missed it.
fn verdict(measured: usize, missed: Vec<String>) -> String {
    match missed.len() {
        _ if measured == 0 => "not measured".to_owned(),
        0 => "holds".to_owned(),
        count if count <= NAMED => format!("missed: {}", missed.join(", ")),
        count => format!("missed by {count} of {measured}: {}, …", missed[..NAMED].join(", ")),
    }
}
