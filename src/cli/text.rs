//! Answers for humans: the steps and the reasons.

use core::time::Duration;

use nalgebra::Point2;

use super::table::{Column, table};
use crate::render::headline;
use crate::wire::{FaultBody, PlanRequest, VerificationBody, warnings};
use singulate_planner::plan::{
    Answer, Deadlock, Grasp, LowerBound, Plan, Statistics, SurveyEntry, SurveyVerdict, Unplanned, Verdict,
};
use singulate_planner::scene::{ObjectIndex, Scene};

/// The most ids in one sentence.
const MANY: usize = 40;

/// Added to `no_space`.
const NO_PROOF: &str = "This is no proof: the places that were tried do not suffice, others may.\n";

/// The text with control characters made visible: an id must not move the cursor or forge a line.
pub(super) fn plain(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { c.escape_default().to_string() } else { c.to_string() }).collect()
}

/// The answer to a planning request.
pub(super) fn answer(request: &PlanRequest, answer: &Answer) -> String {
    let scene = &request.scene;
    let name = |id: &String| format!(" in scene {}", plain(id));
    let place = request.scene_id.as_ref().map(name).unwrap_or_default();
    let target = plain(scene.object(scene.target()).id());
    let mut paragraphs = vec![format!("{}\ntarget: {target}{place}\n", headline(answer))];
    match &answer.verdict {
        Verdict::Graspable(grasp) => paragraphs.push(format!("Grasp {target} at yaw {}.\n", yaw(*grasp))),
        Verdict::Relocate(plan) => paragraphs.extend([steps(scene, plan), why_least(scene, plan)]),
        Verdict::Deadlock(Some(deadlock)) => paragraphs.push(why_never(scene, deadlock)),
        // Headline and warnings say everything.
        Verdict::Deadlock(None) => {}
        Verdict::NoSpace(known) => paragraphs.extend([so_far(scene, known), NO_PROOF.to_owned()]),
        Verdict::TimedOut(known) => paragraphs.push(so_far(scene, known)),
    }
    paragraphs.push(
        warnings(request, answer)
            .iter()
            .map(|warning| format!("warning: {} ({})\n", plain(&warning.detail), plain(&warning.pointer)))
            .collect(),
    );
    paragraphs.push(times(&answer.statistics));
    paragraphs.retain(|paragraph| !paragraph.is_empty());
    paragraphs.join("\n")
}

fn steps(scene: &Scene, plan: &Plan) -> String {
    let columns = [
        Column::right("#"),
        Column::left("object"),
        Column::right("from (m)"),
        Column::left(""),
        Column::right("to (m)"),
        Column::right("grasp yaw"),
        Column::right("release yaw"),
        Column::right("gap"),
    ];
    let rows = plan.relocations.iter().enumerate().map(|(at, step)| {
        let object = plain(scene.object(step.object).id());
        let gap = format!("{:.1} mm", step.gap * 1e3);
        let (from, to) = (point(step.from), point(step.to));
        vec![(at + 1).to_string(), object, from, "→".to_owned(), to, yaw(step.grasp), yaw(step.release), gap]
    });
    let target = plain(scene.object(scene.target()).id());
    format!("{}\nThen grasp {target} at yaw {}.\n", table(&columns, rows), yaw(plan.target_grasp))
}

fn point(at: Point2<f64>) -> String {
    format!("{:.3}, {:.3}", at.x, at.y)
}

/// The yaw, and how far it may be off to either side.
fn yaw(grasp: Grasp) -> String {
    format!("{:.1}° ±{:.1}°", grasp.yaw.to_degrees(), grasp.slack.to_degrees())
}

fn why_least(scene: &Scene, plan: &Plan) -> String {
    let Some(known) = &plan.bound else { return "Whether fewer relocations suffice is not known.\n".to_owned() };
    let (cost, least) = (plan.cost(), known.cost);
    let bound = why_bound(scene, known);
    if plan.optimal() {
        return format!("{bound}So {cost} is the least.\n");
    }
    let needed = if least == 0 { String::new() } else { format!("{bound}So {least} or more are needed; ") };
    let whether = if least == 0 { "Whether" } else { "whether" };
    format!("{needed}{whether} fewer than {cost} suffice is not known.\n")
}

/// The landmarks as sentences.
fn why_bound(scene: &Scene, bound: &LowerBound) -> String {
    let (single, several): (Vec<_>, Vec<_>) = bound.landmarks.iter().partition(|set| set.len() == 1);
    let single: Vec<ObjectIndex> = single.into_iter().flatten().copied().collect();
    let mut lines =
        if single.is_empty() { String::new() } else { format!("Every plan moves: {}\n", ids(scene, &single)) };
    for set in &several {
        lines += &format!("Every plan moves at least one of: {}\n", ids(scene, set));
    }
    if several.len() + usize::from(!single.is_empty()) < 2 {
        return lines;
    }
    let (count, satisfy) = (bound.cost, if bound.cost == 1 { "object satisfies" } else { "objects satisfy" });
    format!("{lines}No fewer than {count} {satisfy} all of these.\n")
}

fn ids(scene: &Scene, objects: &[ObjectIndex]) -> String {
    objects.iter().map(|&object| plain(scene.object(object).id())).collect::<Vec<_>>().join(", ")
}

fn why_never(scene: &Scene, deadlock: &Deadlock) -> String {
    let members = deadlock.core.iter().map(|&index| {
        let object = scene.object(index);
        let part = match (index == scene.target(), object.fixed()) {
            (true, _) => "the target",
            (false, true) => "fixed",
            (false, false) => "",
        };
        vec![plain(object.id()), part.to_owned()]
    });
    let members = table(&[Column::left("object"), Column::left("")], members);
    let others: Vec<ObjectIndex> =
        deadlock.blocked.iter().copied().filter(|object| !deadlock.core.contains(object)).collect();
    let others = if others.is_empty() {
        String::new()
    } else {
        let more = match others.len().saturating_sub(MANY) {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        format!("\nOut of reach for good as well: {}{more}\n", ids(scene, &others[..others.len().min(MANY)]))
    };
    format!(
        "These objects lock each other: at every yaw of each that can be moved, another of them is in the way.\n\n\
         {members}{others}"
    )
}

fn so_far(scene: &Scene, known: &Unplanned) -> String {
    let needed = match &known.needed {
        Some(needed) => format!("Would free the target, moved in this order: {}\n", ids(scene, needed)),
        None => String::new(),
    };
    let bound = match &known.bound {
        Some(bound) if bound.cost > 0 => {
            format!("{}So at least {} must move.\n", why_bound(scene, bound), bound.cost)
        }
        _ => String::new(),
    };
    let gap = if needed.is_empty() || bound.is_empty() { "" } else { "\n" };
    format!("{needed}{gap}{bound}")
}

fn times(statistics: &Statistics) -> String {
    let ms = |duration: Duration| format!("{:.2} ms", duration.as_secs_f64() * 1e3);
    let Statistics { knowledge, search, placement, check } = *statistics;
    let parts = [(knowledge, "knowledge"), (search, "search"), (placement, "placement"), (check, "check")];
    let parts = parts.map(|(duration, name)| format!("{name} {}", ms(duration)));
    format!("{} in all: {}\n", ms(knowledge + search + placement + check), parts.join(", "))
}

/// The checker's report.
pub(super) fn verification(body: &VerificationBody) -> String {
    if body.valid {
        return "valid: the plan holds\n".to_owned();
    }
    let count = body.faults.len();
    let lines: String = body.faults.iter().map(|fault| self::fault(fault) + "\n").collect();
    format!("not valid: {count} {}\n{lines}", if count == 1 { "fault" } else { "faults" })
}

/// One fault, steps counted from 1 as in the table of steps.
pub(super) fn fault(fault: &FaultBody) -> String {
    let step = fault.step.map(|step| format!("step {}", step + 1));
    let place: Vec<String> = step.into_iter().chain(fault.object.as_deref().map(plain)).collect();
    let place = if place.is_empty() { String::new() } else { format!("{}: ", place.join(", ")) };
    format!("  {place}{} ({})", plain(&fault.detail), fault.code)
}

/// The verdict for every object as the target.
pub(super) fn survey(scene: &Scene, entries: &[SurveyEntry]) -> String {
    let columns = [Column::left("object"), Column::left("verdict"), Column::left("relocations")];
    let rows = entries.iter().map(|entry| {
        let verdict = match entry.verdict {
            SurveyVerdict::Graspable => "graspable",
            SurveyVerdict::Relocate => "relocate",
            SurveyVerdict::Deadlock => "deadlock",
            SurveyVerdict::TimedOut => "timed out",
        };
        let relocations = match (entry.lower_bound, entry.optimal) {
            (Some(bound), Some(true)) => bound.to_string(),
            (Some(bound), _) => format!("at least {bound}"),
            (None, _) => String::new(),
        };
        vec![plain(scene.object(entry.object).id()), verdict.to_owned(), relocations]
    });
    let note = "Relocations are those that logic asks for; whether each finds a place is for `plan` to say.\n";
    format!("{}\n{note}", table(&columns, rows))
}

#[cfg(test)]
mod tests;
