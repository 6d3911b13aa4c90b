//! The files that the results are made of.

use std::collections::BTreeMap;

use serde::Deserialize;

/// What `benches/peers/run --out` writes. Times in seconds.
#[derive(Deserialize)]
pub(crate) struct Peers {
    /// For each solve.
    pub(crate) time_limit_seconds: f64,
    /// The same for pyperplan.
    pub(crate) pyperplan_limit_seconds: f64,
    /// Of each peer.
    pub(crate) versions: BTreeMap<String, String>,
    pub(crate) instances: Vec<Instance>,
}

/// One question and everybody's answer.
#[derive(Deserialize)]
pub(crate) struct Instance {
    pub(crate) class: String,
    /// A synthetic one's begins with its family and a colon.
    pub(crate) name: String,
    pub(crate) optimum: Option<u32>,
    /// False for a deadlock; absent where nobody finished.
    pub(crate) derivable: Option<bool>,
    /// Absent where the search did not finish.
    pub(crate) ours: Option<f64>,
    /// From the scene to the base.
    pub(crate) knowledge: Option<f64>,
    /// A peer that did not finish has none; one that was not asked is not there.
    pub(crate) peers: BTreeMap<String, Option<Timing>>,
}

/// A peer's answer.
#[derive(Deserialize)]
pub(crate) struct Timing {
    /// From the base to the optimum.
    pub(crate) seconds: f64,
    /// The same without model building and grounding.
    pub(crate) solve_seconds: f64,
}

/// The peers' keys, and how they are called.
pub(crate) const PEERS: [(&str, &str); 3] = [("clingo", "clingo"), ("cpsat", "CP-SAT"), ("pyperplan", "pyperplan")];

impl Peers {
    /// The classes in which an optimum is asked for, in the order of the run, each with its instances.
    pub(crate) fn classes(&self) -> Vec<(&str, Vec<&Instance>)> {
        let asked = self.instances.iter().filter(|instance| instance.class != CROWD);
        grouped(asked, |instance| &instance.class)
    }

    /// The classes that come from scenes, where a target is set.
    pub(crate) fn scene_born(&self) -> Vec<(&str, Vec<&Instance>)> {
        self.classes().into_iter().filter(|(class, _)| *class != SYNTHETIC).collect()
    }

    /// The families of the synthetic class.
    pub(crate) fn families(&self) -> Vec<(&str, Vec<&Instance>)> {
        let synthetic = self.instances.iter().filter(|instance| instance.class == SYNTHETIC);
        grouped(synthetic, |instance| instance.name.split(':').next().expect("one part at least"))
    }

    /// The instances of 10,000 objects.
    pub(crate) fn crowds(&self) -> Vec<&Instance> {
        self.instances.iter().filter(|instance| instance.class == CROWD).collect()
    }

    /// How long a peer may take, s.
    pub(crate) fn limit(&self, peer: &str) -> f64 {
        if peer == "pyperplan" { self.pyperplan_limit_seconds } else { self.time_limit_seconds }
    }
}

/// The class without scenes.
const SYNTHETIC: &str = "synthetic";
const CROWD: &str = "crowd-10000";

fn grouped<'a>(
    instances: impl Iterator<Item = &'a Instance>,
    key: impl Fn(&'a Instance) -> &'a str,
) -> Vec<(&'a str, Vec<&'a Instance>)> {
    let mut groups: Vec<(&str, Vec<&Instance>)> = Vec::new();
    for instance in instances {
        match groups.iter_mut().find(|(name, _)| *name == key(instance)) {
            Some((_, group)) => group.push(instance),
            None => groups.push((key(instance), vec![instance])),
        }
    }
    groups
}

impl Instance {
    /// A peer's time, s; infinite where it did not finish.
    pub(crate) fn peer(&self, peer: &str) -> f64 {
        self.timing(peer).map_or(f64::INFINITY, |timing| timing.seconds)
    }

    /// The same without model building and grounding.
    pub(crate) fn peer_alone(&self, peer: &str) -> f64 {
        self.timing(peer).map_or(f64::INFINITY, |timing| timing.solve_seconds)
    }

    /// Our time, s; infinite where the search did not finish.
    pub(crate) fn ours(&self) -> f64 {
        self.ours.unwrap_or(f64::INFINITY)
    }

    /// The same with the way from the scene to the base, where there is a scene.
    pub(crate) fn with_knowledge(&self) -> f64 {
        self.ours() + self.knowledge.unwrap_or_default()
    }

    /// How many times as long as ours the fastest peer takes; `None` where neither finished.
    pub(crate) fn ratio(&self) -> Option<f64> {
        self.over_ours(Self::peer)
    }

    /// The same without the peers' model building and grounding.
    pub(crate) fn ratio_alone(&self) -> Option<f64> {
        self.over_ours(Self::peer_alone)
    }

    fn over_ours(&self, time: impl Fn(&Self, &str) -> f64) -> Option<f64> {
        let best = PEERS.iter().map(|(peer, _)| time(self, peer)).fold(f64::INFINITY, f64::min);
        (best.is_finite() || self.ours.is_some()).then(|| best / self.ours())
    }

    fn timing(&self, peer: &str) -> Option<&Timing> {
        self.peers.get(peer).and_then(Option::as_ref)
    }
}

/// The middle one, or the mean of the middle two; `None` where there is none.
pub(crate) fn median(values: impl Iterator<Item = f64>) -> Option<f64> {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_unstable_by(f64::total_cmp);
    let (low, high) = (sorted.get((sorted.len().max(1) - 1) / 2)?, sorted.get(sorted.len() / 2)?);
    Some(if low == high { *low } else { f64::midpoint(*low, *high) })
}

/// The greatest; `None` where there is none.
pub(crate) fn worst(values: impl Iterator<Item = f64>) -> Option<f64> {
    values.max_by(f64::total_cmp)
}
