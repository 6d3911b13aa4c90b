//! The verdict in one line.

use super::fill::drops;
use super::phrases::counted;
use singulate_planner::cost::Cost;
use singulate_planner::paper::Judged;
use singulate_planner::scene::{Destination, Goal, Scene};
use singulate_planner::statement::{Deadlock, Statement, Step, Verdict};

/// The verdict in one line. The only id in it is that of a chosen candidate.
pub fn headline(scene: &Scene, judged: &Judged) -> String {
    let stated = judged.statement();
    match stated.verdict {
        Some(Verdict::Graspable) if judged.faulty() => {
            "graspable: nothing has to move (does not pass its check)".to_owned()
        }
        Some(Verdict::Graspable) => format!("graspable: {}nothing has to move", chosen(scene, stated, "", ", ")),
        Some(Verdict::Relocate) if judged.faulty() => format!("{} (does not pass its check)", relocate(scene, stated)),
        Some(Verdict::Relocate) => format!("{} ({})", relocate(scene, stated), proof(scene, stated)),
        Some(Verdict::Deadlock) => deadlock(scene, stated),
        Some(Verdict::NoSpace) => format!("no space: {} ({})", no_space(scene), bound(scene, stated.lower_bound)),
        Some(Verdict::TimedOut) if stated.lower_bound > Some(Cost::ZERO) => {
            format!("timed out: no plan yet ({})", bound(scene, stated.lower_bound))
        }
        Some(Verdict::TimedOut) => "timed out: nothing is proven yet".to_owned(),
        Some(Verdict::Cleared | Verdict::PartlyCleared) => cleared(stated),
        None => "no verdict".to_owned(),
    }
}

/// The chosen candidate between `before` and `after`: `cup-3, one of 4`. Empty unless one of several candidates was chosen.
fn chosen(scene: &Scene, stated: &Statement, before: &str, after: &str) -> String {
    match (scene.goal(), &stated.target) {
        (Goal::AnyOf(candidates), Some(id)) => format!("{before}{id}, one of {}{after}", candidates.len()),
        _ => String::new(),
    }
}

fn relocate(scene: &Scene, stated: &Statement) -> String {
    let mut objects: Vec<&str> = stated.steps().iter().map(Step::object).collect();
    objects.sort_unstable();
    objects.dedup();
    let (steps, count) = (stated.steps().len(), objects.len());
    if let Goal::AllOf(wanted) = scene.goal() {
        let wanted = wanted.len();
        let others = if steps == wanted { String::new() } else { format!(" in {}", counted(steps as u64, "step")) };
        return format!("take away {}{others}", counted(wanted as u64, "object"));
    }
    let steps = if count == steps { String::new() } else { format!(" in {}", counted(steps as u64, "move")) };
    let off_table = match drops(stated).count() {
        0 => String::new(),
        dropped if dropped == count => " off the table".to_owned(),
        dropped => format!(", {dropped} of them off the table"),
    };
    let chosen = chosen(scene, stated, if off_table.contains(',') { ", to reach " } else { " to reach " }, "");
    format!("relocate {}{steps}{off_table}{chosen}", counted(count as u64, "object"))
}

fn proof(scene: &Scene, stated: &Statement) -> String {
    if stated.optimal == Some(true) {
        return "proven least".to_owned();
    }
    if stated.lower_bound == Some(Cost::ZERO) {
        "not proven least".to_owned()
    } else {
        bound(scene, stated.lower_bound)
    }
}

fn bound(scene: &Scene, bound: Option<Cost>) -> String {
    bound.map_or_else(|| "nothing is proven".to_owned(), |bound| format!("{} needed", at_least(scene, bound)))
}

fn at_least(scene: &Scene, cost: Cost) -> String {
    let noun = if scene.drop_offs().is_empty() { "relocation" } else { "step" };
    format!("at least {} {}", counted(cost.get(), noun), if cost == Cost::new(1) { "is" } else { "are" })
}

fn deadlock(scene: &Scene, stated: &Statement) -> String {
    let Some(Deadlock { core, .. }) = &stated.deadlock else {
        return "deadlock, not proven: the method that was asked for finds no plan".to_owned();
    };
    let end = match scene.goal() {
        Goal::AnyOf(candidates) => format!("none of {} can be freed", counted(candidates.len() as u64, "candidate")),
        Goal::AllOf(wanted) if wanted.len() == 1 => "the wanted object can't be taken away".to_owned(),
        Goal::AllOf(wanted) => format!("not all of {} wanted objects can be taken away", wanted.len()),
        _ if scene.drop_offs().is_empty() => "no pick-and-place can free the target".to_owned(),
        _ => "nothing can free the target".to_owned(),
    };
    format!("deadlock: {} each other, {end}", holding(core.len() as u64))
}

fn holding(count: u64) -> String {
    format!("{} {}", counted(count, "object"), if count == 1 { "holds" } else { "hold" })
}

fn no_space(scene: &Scene) -> &'static str {
    match (scene.goal(), scene.destination()) {
        (_, Destination::DropOff) => "no room in the drop-offs for what has to move",
        (Goal::AllOf(_), _) | (_, Destination::TableThenDropOff) => {
            "neither a place nor room in a drop-off found for what has to move"
        }
        (_, Destination::Table) => "no place found for what has to move",
    }
}

fn cleared(stated: &Statement) -> String {
    let (taken, left) = (stated.steps().len(), stated.left.as_deref().unwrap_or_default().len());
    if stated.verdict == Some(Verdict::Cleared) {
        return match taken {
            0 => "cleared: there is nothing to take away".to_owned(),
            _ => format!("cleared: {} taken away", counted(taken as u64, "object")),
        };
    }
    let proof = match stated.proven {
        Some(true) => ", no order takes more",
        _ => " (not proven that no order takes more)",
    };
    format!("partly cleared: {taken} of {} taken away{proof}", counted((taken + left) as u64, "object"))
}
