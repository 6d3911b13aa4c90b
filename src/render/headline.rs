//! The verdict as text.

use nalgebra::Point2;
use svg::node::element::Group;

use super::label;
use super::paint;
use super::view::{PADDING, View};
use singulate_planner::plan::{Answer, LowerBound, Plan, Verdict, Warning};
use singulate_planner::scene::{ObjectIndex, Scene};

/// The verdict in one line, without ids.
pub fn headline(answer: &Answer) -> String {
    match &answer.verdict {
        Verdict::Graspable(_) if answer.faulty() => {
            "graspable: nothing has to move (does not pass its check)".to_owned()
        }
        Verdict::Graspable(_) => "graspable: nothing has to move".to_owned(),
        Verdict::Relocate(plan) if answer.faulty() => format!("{} (does not pass its check)", relocate(plan)),
        Verdict::Relocate(plan) => format!("{} ({})", relocate(plan), proof(plan)),
        Verdict::Deadlock(None) => "deadlock, not proven: the method that was asked for finds no plan".to_owned(),
        Verdict::Deadlock(Some(deadlock)) => {
            let count = deadlock.core.len();
            format!("deadlock: {} each other, no pick-and-place can free the target", holding(count))
        }
        Verdict::NoSpace(known) => {
            format!("no space: no place found for what has to move ({})", bound(known.bound.as_ref()))
        }
        Verdict::TimedOut(known) if known.bound.as_ref().is_some_and(|bound| bound.cost > 0) => {
            format!("timed out: no plan yet ({})", bound(known.bound.as_ref()))
        }
        Verdict::TimedOut(_) => "timed out: nothing is proven yet".to_owned(),
    }
}

fn relocate(plan: &Plan) -> String {
    let mut objects: Vec<ObjectIndex> = plan.relocations.iter().map(|step| step.object).collect();
    objects.sort_unstable();
    objects.dedup();
    let moved = counted(objects.len(), "object");
    if objects.len() == plan.cost() {
        return format!("relocate {moved}");
    }
    format!("relocate {moved} in {}", counted(plan.cost(), "move"))
}

fn proof(plan: &Plan) -> String {
    match &plan.bound {
        _ if plan.optimal() => "proven least".to_owned(),
        Some(known) if known.cost == 0 => "not proven least".to_owned(),
        known => bound(known.as_ref()),
    }
}

fn bound(bound: Option<&LowerBound>) -> String {
    bound.map_or_else(|| "nothing is proven".to_owned(), |bound| format!("{} needed", at_least(bound.cost)))
}

fn at_least(cost: usize) -> String {
    format!("at least {} {}", counted(cost, "relocation"), if cost == 1 { "is" } else { "are" })
}

fn holding(count: usize) -> String {
    format!("{} {}", counted(count, "object"), if count == 1 { "holds" } else { "hold" })
}

fn counted(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

/// The objects, which the headline leaves out.
fn detail(scene: &Scene, answer: &Answer) -> String {
    let ids = |objects: &[ObjectIndex]| {
        objects.iter().map(|&object| scene.object(object).id()).collect::<Vec<_>>().join(", ")
    };
    match &answer.verdict {
        Verdict::Graspable(_) => String::new(),
        Verdict::Relocate(plan) => {
            let moved: Vec<ObjectIndex> = plan.relocations.iter().map(|step| step.object).collect();
            format!("in order: {}", ids(&moved))
        }
        Verdict::Deadlock(None) => String::new(),
        Verdict::Deadlock(Some(deadlock)) => format!("holding each other: {}", ids(&deadlock.core)),
        Verdict::NoSpace(known) | Verdict::TimedOut(known) => match &known.needed {
            Some(needed) => format!("would have to move, in order: {}", ids(needed)),
            None => String::new(),
        },
    }
}

/// The codes of the answer's warnings.
fn warned(answer: &Answer) -> String {
    let mut codes: Vec<&str> = answer.warnings.iter().map(Warning::code).collect();
    codes.sort_unstable();
    codes.dedup();
    if codes.is_empty() { String::new() } else { format!("warnings: {}", codes.join(", ")) }
}

fn scene_line(scene: &Scene) -> String {
    let gripper = scene.gripper();
    let fixed = match scene.objects().iter().filter(|object| object.fixed()).count() {
        0 => String::new(),
        count => format!(" ({count} fixed)"),
    };
    format!(
        "target {}; {}{fixed}; {} fingers, {} mm wide, {} mm clearance",
        scene.object(scene.target()).id(),
        counted(scene.objects().len(), "object"),
        gripper.fingers(),
        millimetres(gripper.finger_width()),
        millimetres(gripper.clearance()),
    )
}

fn millimetres(metres: f64) -> f64 {
    (metres * 1e5).round() / 100.0
}

/// The whole text, for screen readers.
pub(super) fn description(scene: &Scene, answer: &Answer) -> String {
    let detail = detail(scene, answer);
    let stop = if detail.is_empty() { "" } else { ". " };
    format!("{detail}{stop}{}", scene_line(scene))
}

/// The lines above the table.
pub(super) fn block(scene: &Scene, answer: &Answer, view: &View) -> Group {
    let room = view.width() - 2.0 * PADDING;
    let lines =
        [(headline(answer), 20.0), (detail(scene, answer), 13.0), (warned(answer), 13.0), (scene_line(scene), 13.0)];
    let mut baseline = 12.0;
    let mut group = Group::new().set("class", "headline");
    for (text, size) in lines.into_iter().filter(|(text, _)| !text.is_empty()) {
        let Some((text, fitted)) = label::fit(&text, size, room) else { continue };
        baseline += 6.0 + size;
        let line = label::line(&text, fitted, Point2::new(PADDING, baseline));
        group = group.add(if size > 13.0 {
            line.set("fill", paint::INK).set("font-weight", "bold")
        } else {
            line.set("fill", paint::FAINT_INK)
        });
    }
    group
}
