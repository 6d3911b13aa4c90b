//! Why no plan is shorter, why there is none, and why a clearing leaves something.

use std::collections::{HashMap, HashSet};

use super::super::table::{Column, table};
use super::{MANY, ids, plain};
use crate::render::{immovable, left};
use singulate_planner::cost::Cost;
use singulate_planner::scene::{Destination, Goal, ObjectIndex, Scene};
use singulate_planner::statement::{Deadlock, Statement, Verdict};

pub(super) fn why_least(scene: &Scene, statement: &Statement) -> String {
    let (Some(cost), Some(least)) = (statement.cost, statement.lower_bound) else {
        return format!("Whether fewer {} suffice is not known.\n", unit(scene, Cost::new(2)));
    };
    let bound = why_bound(statement);
    if cost == least {
        return format!("{bound}So {} the least.\n", amount(scene, cost));
    }
    let (needed, whether) = if least == Cost::ZERO {
        (String::new(), "Whether")
    } else {
        (format!("{bound}So {least} or more are needed; "), "whether")
    };
    format!("{needed}{whether} fewer than {cost} suffice is not known.\n")
}

/// What the cost counts. Where nothing leaves the table, all steps are relocations.
fn unit(scene: &Scene, cost: Cost) -> &'static str {
    match (scene.drop_offs().is_empty(), cost == Cost::new(1)) {
        (true, _) => "relocations",
        (false, true) => "step",
        (false, false) => "steps",
    }
}

fn amount(scene: &Scene, cost: Cost) -> String {
    match scene.drop_offs().is_empty() {
        true => format!("{cost} is"),
        false => format!("{cost} {} {}", unit(scene, cost), if cost == Cost::new(1) { "is" } else { "are" }),
    }
}

/// The landmarks as sentences.
fn why_bound(statement: &Statement) -> String {
    let landmarks = statement.landmarks.as_deref().unwrap_or_default();
    let (single, several): (Vec<_>, Vec<_>) = landmarks.iter().partition(|set| set.len() == 1);
    let single: Vec<String> = single.into_iter().flatten().cloned().collect();
    let mut lines = if single.is_empty() { String::new() } else { format!("Every plan moves: {}\n", ids(&single)) };
    for set in &several {
        lines += &format!("Every plan moves at least one of: {}\n", ids(set));
    }
    if several.len() + usize::from(!single.is_empty()) < 2 {
        return lines;
    }
    let count = statement.lower_bound.unwrap_or_default();
    let satisfy = if count == Cost::new(1) { "object satisfies" } else { "objects satisfy" };
    format!("{lines}No fewer than {count} {satisfy} all of these.\n")
}

/// The lock of a deadlock, or of what a clearing leaves.
pub(super) fn why_never(scene: &Scene, Deadlock { blocked, core }: &Deadlock) -> String {
    let by_id: HashMap<&str, ObjectIndex> = scene.indices().map(|object| (scene.object(object).id(), object)).collect();
    let part = |id: &String| by_id.get(id.as_str()).map(|&object| part(scene, object)).unwrap_or_default();
    let members = core.iter().map(|id| vec![plain(id), part(id).to_owned()]);
    let members = table(&[Column::left("object"), Column::left("")], members);
    let in_core: HashSet<&str> = core.iter().map(String::as_str).collect();
    let others: Vec<&String> = blocked.iter().filter(|id| !in_core.contains(id.as_str())).collect();
    let others = if others.is_empty() { String::new() } else { format!("\nAlso locked: {}\n", some(&others)) };
    // A disc is tried at every yaw, anything else in the grasps that it has.
    let listed = |id: &&String| by_id.get(id.as_str()).is_some_and(|&at| scene.object(at).grasps().listed().is_some());
    let ways = if core.iter().any(|id| listed(&id)) { "in every grasp" } else { "at every yaw" };
    format!(
        "These objects lock each other: {ways} of each that can be moved, another of them is in the way.\n\n\
         {members}{others}"
    )
}

/// What an object is in a lock.
fn part(scene: &Scene, object: ObjectIndex) -> &'static str {
    let named = scene.goal().named().binary_search(&object).is_ok();
    match (scene.goal(), immovable(scene, object)) {
        (Goal::Target(_), _) if named => "the target",
        (Goal::AnyOf(_), _) if named => "a candidate",
        (Goal::AllOf(_), _) if named => "wanted",
        (_, Some(why)) => why.words(),
        (_, None) => "",
    }
}

/// The first ids, and how many more there are.
fn some(objects: &[impl AsRef<str>]) -> String {
    let more = match objects.len().saturating_sub(MANY) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    ids(&objects[..objects.len().min(MANY)]) + &more
}

/// What a clearing leaves, the lock, and whether more could go.
pub(super) fn why_left(scene: &Scene, statement: &Statement) -> Vec<String> {
    if statement.verdict != Some(Verdict::PartlyCleared) {
        return Vec::new();
    }
    let reasons = left(scene, statement).into_iter().map(|(reason, objects)| {
        let ids: Vec<&str> = objects.iter().map(|&object| scene.object(object).id()).collect();
        vec![reason.words().to_owned(), some(&ids)]
    });
    let reasons = table(&[Column::left("why left"), Column::left("objects")], reasons);
    let lock = statement.stuck.iter().map(|lock| why_never(scene, lock));
    let proof = match statement.proven {
        Some(true) => "No order takes more away.\n",
        _ => "Whether an order takes more away is not known.\n",
    };
    core::iter::once(reasons).chain(lock).chain([proof.to_owned()]).collect()
}

/// Added to `no_space`.
pub(super) fn no_proof(scene: &Scene) -> &'static str {
    match scene.destination() {
        Destination::DropOff => "This is not a proof: only the objects that were tried do not fit the drop-offs.\n",
        _ => "This is not a proof: only the places that were tried do not suffice.\n",
    }
}

pub(super) fn so_far(scene: &Scene, statement: &Statement) -> String {
    let end = match (scene.goal(), &statement.target) {
        (Goal::AnyOf(_), Some(target)) => format!("free {}", plain(target)),
        (Goal::AllOf(_), _) => "reach the goal".to_owned(),
        _ => "free the target".to_owned(),
    };
    let needed = match &statement.needed {
        Some(needed) => format!("Would {end}, moved in this order: {}\n", ids(needed)),
        None => String::new(),
    };
    let bound = match statement.lower_bound {
        Some(bound) if bound > Cost::ZERO => format!("{}So at least {bound} must move.\n", why_bound(statement)),
        _ => String::new(),
    };
    let gap = if needed.is_empty() || bound.is_empty() { "" } else { "\n" };
    format!("{needed}{gap}{bound}")
}
