//! The verdict as text.

use nalgebra::Point2;
use svg::node::element::Group;

use super::label;
use super::paint;
use super::view::{PADDING, View};
use singulate_planner::cost::Cost;
use singulate_planner::paper::{Judged, Warning};
use singulate_planner::scene::Scene;
use singulate_planner::statement::{Deadlock, Statement, Step, Verdict};

/// The verdict in one line, without ids.
pub fn headline(judged: &Judged) -> String {
    let stated = judged.statement();
    match stated.verdict {
        Some(Verdict::Graspable) if judged.faulty() => {
            "graspable: nothing has to move (does not pass its check)".to_owned()
        }
        Some(Verdict::Graspable) => "graspable: nothing has to move".to_owned(),
        Some(Verdict::Relocate) if judged.faulty() => format!("{} (does not pass its check)", relocate(stated)),
        Some(Verdict::Relocate) => format!("{} ({})", relocate(stated), proof(stated)),
        Some(Verdict::Deadlock) => deadlock(stated),
        Some(Verdict::NoSpace) => {
            format!("no space: no place found for what has to move ({})", bound(stated.lower_bound))
        }
        Some(Verdict::TimedOut) if stated.lower_bound > Some(Cost::ZERO) => {
            format!("timed out: no plan yet ({})", bound(stated.lower_bound))
        }
        Some(Verdict::TimedOut) => "timed out: nothing is proven yet".to_owned(),
        Some(Verdict::Cleared | Verdict::PartlyCleared) => relocate(stated),
        None => "no verdict".to_owned(),
    }
}

fn relocate(stated: &Statement) -> String {
    let mut objects: Vec<&str> = stated.steps().iter().map(Step::object).collect();
    objects.sort_unstable();
    objects.dedup();
    let (steps, moved) = (stated.steps().len(), counted(objects.len() as u64, "object"));
    if objects.len() == steps {
        return format!("relocate {moved}");
    }
    format!("relocate {moved} in {}", counted(steps as u64, "move"))
}

fn proof(stated: &Statement) -> String {
    if stated.optimal == Some(true) {
        return "proven least".to_owned();
    }
    if stated.lower_bound == Some(Cost::ZERO) { "not proven least".to_owned() } else { bound(stated.lower_bound) }
}

fn bound(bound: Option<Cost>) -> String {
    bound.map_or_else(|| "nothing is proven".to_owned(), |bound| format!("{} needed", at_least(bound)))
}

fn at_least(cost: Cost) -> String {
    format!("at least {} {}", counted(cost.get(), "relocation"), if cost == Cost::new(1) { "is" } else { "are" })
}

fn deadlock(stated: &Statement) -> String {
    let Some(Deadlock { core, .. }) = &stated.deadlock else {
        return "deadlock, not proven: the method that was asked for finds no plan".to_owned();
    };
    format!("deadlock: {} each other, no pick-and-place can free the target", holding(core.len() as u64))
}

fn holding(count: u64) -> String {
    format!("{} {}", counted(count, "object"), if count == 1 { "holds" } else { "hold" })
}

fn counted(count: u64, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

/// The objects, which the headline leaves out.
fn detail(stated: &Statement) -> String {
    match stated.verdict {
        Some(Verdict::Relocate | Verdict::Cleared | Verdict::PartlyCleared) => {
            let moved: Vec<&str> = stated.steps().iter().map(Step::object).collect();
            format!("in order: {}", moved.join(", "))
        }
        Some(Verdict::Deadlock) => stated
            .deadlock
            .as_ref()
            .map(|deadlock| format!("holding each other: {}", deadlock.core.join(", ")))
            .unwrap_or_default(),
        Some(Verdict::NoSpace | Verdict::TimedOut) => stated
            .needed
            .as_ref()
            .map(|needed| format!("would have to move, in order: {}", needed.join(", ")))
            .unwrap_or_default(),
        Some(Verdict::Graspable) | None => String::new(),
    }
}

/// The codes of the answer's warnings.
fn warned(judged: &Judged) -> String {
    let mut codes: Vec<&str> = judged.warnings.iter().map(Warning::code).collect();
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
        wanted(scene),
        counted(scene.objects().len() as u64, "object"),
        gripper.fingers(),
        millimetres(gripper.finger_width()),
        millimetres(gripper.clearance()),
    )
}

fn wanted(scene: &Scene) -> String {
    let ids = scene.goal().named().iter().map(|&object| scene.object(object).id());
    ids.collect::<Vec<_>>().join(", ")
}

fn millimetres(metres: f64) -> f64 {
    (metres * 1e5).round() / 100.0
}

/// The whole text, for screen readers.
pub(super) fn description(scene: &Scene, judged: &Judged) -> String {
    let detail = detail(judged.statement());
    let stop = if detail.is_empty() { "" } else { ". " };
    format!("{detail}{stop}{}", scene_line(scene))
}

/// The lines above the table.
pub(super) fn block(scene: &Scene, judged: &Judged, view: &View) -> Group {
    let room = view.width() - 2.0 * PADDING;
    let lines = [
        (headline(judged), 20.0),
        (detail(judged.statement()), 13.0),
        (warned(judged), 13.0),
        (scene_line(scene), 13.0),
    ];
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
