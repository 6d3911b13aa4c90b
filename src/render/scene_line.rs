//! Lines about the scene: one names the goal, counts the objects and gives the hand's lengths; one tells of its palm and heights,
//! one lists the drop-offs.

use super::phrases::{counted, listed};
use super::stays::{Stays, immovable};
use singulate_planner::scene::{Destination, DropOff, Goal, ObjectIndex, Opening, Scene};

/// The most ids or drop-offs that a line names.
const MOST: usize = 6;

/// The goal, to be written after `target` or `goal:`. For a target it is the id, else for example `any of a, b and 3 more`. At
/// most `most` ids are named.
pub fn goal(scene: &Scene, most: usize) -> String {
    let named = |objects: &[ObjectIndex]| {
        let ids = objects.iter().map(|&object| scene.object(object).id().to_owned());
        listed(&ids.take(most).collect::<Vec<_>>(), objects.len())
    };
    match scene.goal() {
        Goal::Target(target) => scene.object(*target).id().to_owned(),
        Goal::AnyOf(candidates) => format!("any of {}", named(candidates)),
        Goal::AllOf(wanted) => format!("take away all of {}", named(wanted)),
        Goal::Clear => "clear the table".to_owned(),
    }
}

/// Goal, objects and hand.
pub(super) fn scene_line(scene: &Scene) -> String {
    let (gripper, goal) = (scene.gripper(), goal(scene, MOST));
    let goal = if scene.target().is_some() { format!("target {goal}") } else { format!("goal: {goal}") };
    format!(
        "{goal}; {}{}; {} fingers, {} mm wide, {} mm clearance{}",
        counted(scene.objects().len() as u64, "object"),
        standing(scene),
        gripper.fingers(),
        millimetres(gripper.finger_width()),
        millimetres(gripper.clearance()),
        opening(scene),
    )
}

/// How many can't be moved, and why.
fn standing(scene: &Scene) -> String {
    let mut counts = [(Stays::Fixed, 0), (Stays::TooWide, 0), (Stays::NoGrasp, 0), (Stays::NotAccepted, 0)];
    for reason in scene.indices().filter_map(|object| immovable(scene, object)) {
        counts.iter_mut().filter(|(counted, _)| *counted == reason).for_each(|(_, count)| *count += 1);
    }
    let told = counts.iter().filter(|(_, count)| *count > 0);
    let told: Vec<String> = told.map(|(reason, count)| format!("{count} {}", reason.words())).collect();
    if told.is_empty() { String::new() } else { format!(" ({})", told.join(", ")) }
}

fn opening(scene: &Scene) -> String {
    let Some(opening) = scene.gripper().max_opening() else { return String::new() };
    let full = if scene.gripper().opening() == Opening::Full { ", always opened fully" } else { "" };
    format!(", greatest opening {} mm{full}", millimetres(opening))
}

/// The heights of the hand, and its palm; empty where neither is stated.
pub(super) fn hand_line(scene: &Scene) -> String {
    let gripper = scene.gripper();
    let low = match (gripper.tip_height(), gripper.palm()) {
        (low, _) if low <= 0.0 => None,
        // At what is tall the palm keeps them higher.
        (low, Some(_)) => Some(format!("fingertips at least {} mm above the table", millimetres(low))),
        (low, None) => Some(format!("fingertips {} mm above the table", millimetres(low))),
    };
    let palm = gripper.palm().map(|palm| {
        let (across, length) = (millimetres(2.0 * palm.radius), millimetres(palm.finger_length));
        format!("palm {across} mm across, {length} mm above the fingertips")
    });
    let parts: Vec<String> = palm.into_iter().chain(low).collect();
    if parts.is_empty() { String::new() } else { format!("hand: {}", parts.join("; ")) }
}

/// The drop-offs, and where goes what has to move; empty without drop-offs.
pub(super) fn drop_off_line(scene: &Scene) -> String {
    let drop_offs = scene.drop_offs();
    if drop_offs.is_empty() {
        return String::new();
    }
    let first: Vec<String> = drop_offs.iter().take(MOST).map(|drop_off| words(scene, drop_off)).collect();
    let kind = if drop_offs.len() == 1 { "drop-off" } else { "drop-offs" };
    format!("{kind}: {}{}", listed(&first, drop_offs.len()), destination(scene))
}

fn words(scene: &Scene, drop_off: &DropOff) -> String {
    let capacity = drop_off.capacity().map(|capacity| format!("takes {capacity}"));
    let accepts = drop_off.accepts();
    let accepts = accepts.map(|objects| format!("accepts {} of {}", objects.len(), scene.objects().len()));
    let limits: Vec<String> = capacity.into_iter().chain(accepts).collect();
    let limits = if limits.is_empty() { String::new() } else { format!(" ({})", limits.join(", ")) };
    drop_off.id().to_owned() + &limits
}

fn destination(scene: &Scene) -> &'static str {
    match (scene.goal(), scene.destination()) {
        (Goal::Clear, _) => "",
        (_, Destination::Table) => "; what is in the way stays on the table",
        (_, Destination::DropOff) => "; what is in the way leaves the table",
        (_, Destination::TableThenDropOff) => "; what is in the way stays on the table if there is a place",
    }
}

fn millimetres(metres: f64) -> f64 {
    (metres * 1e5).round() / 100.0
}
