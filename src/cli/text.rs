//! Answers for humans: the steps and the reasons.

use core::time::Duration;
use std::collections::HashSet;

use super::table::{Column, table};
use crate::render::headline;
use crate::wire::{FaultBody, PlanRequest, VerificationBody, warnings};
use singulate_planner::cost::Cost;
use singulate_planner::paper::Judged;
use singulate_planner::plan::{Answer, Statistics, SurveyEntry, SurveyVerdict};
use singulate_planner::scene::{Object, Pose, Scene};
use singulate_planner::statement::{Deadlock, PickDrop, PickPlace, StatedGrasp, Statement, Step, Verdict};

/// The most ids in one sentence.
const MANY: usize = 40;

/// Added to `no_space`.
const NO_PROOF: &str = "This is not a proof: only the places that were tried do not suffice.\n";

/// The text with control characters made visible: an id must not move the cursor, forge a line, or turn it round.
pub(super) fn plain(text: &str) -> String {
    let line_or_direction =
        |c: char| matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    let shown =
        |c: char| if c.is_control() || line_or_direction(c) { c.escape_default().to_string() } else { c.to_string() };
    text.chars().map(shown).collect()
}

/// The answer to a planning request.
pub(super) fn answer(request: &PlanRequest, judged: &Judged) -> String {
    let scene = &request.scene;
    let name = |id: &String| format!(" in scene {}", plain(id));
    let place = request.scene_id.as_ref().map(name).unwrap_or_default();
    let target = scene.target().map(|target| plain(scene.object(target).id())).unwrap_or_default();
    let Judged { answer: Answer { statement, statistics }, .. } = judged;
    let mut paragraphs = vec![format!("{}\ntarget: {target}{place}\n", headline(judged))];
    paragraphs.extend(match statement.verdict {
        Some(Verdict::Graspable) => vec![last_grasp("Grasp", &target, statement)],
        Some(Verdict::Relocate) => vec![steps(&target, statement), why_least(statement)],
        Some(Verdict::Cleared | Verdict::PartlyCleared) => vec![steps(&target, statement)],
        // Without a proof, headline and warnings say everything.
        Some(Verdict::Deadlock) => statement.deadlock.iter().map(|deadlock| why_never(scene, deadlock)).collect(),
        Some(Verdict::NoSpace) => vec![so_far(statement), NO_PROOF.to_owned()],
        Some(Verdict::TimedOut) => vec![so_far(statement)],
        None => Vec::new(),
    });
    paragraphs.push(
        warnings(request, judged)
            .iter()
            .map(|warning| format!("warning: {} ({})\n", plain(&warning.detail), plain(&warning.pointer)))
            .collect(),
    );
    paragraphs.push(times(statistics));
    paragraphs.retain(|paragraph| !paragraph.is_empty());
    paragraphs.join("\n")
}

fn last_grasp(verb: &str, target: &str, statement: &Statement) -> String {
    statement.target_grasp.map(|grasp| format!("{verb} {target} at yaw {}.\n", yaw(grasp))).unwrap_or_default()
}

fn steps(target: &str, statement: &Statement) -> String {
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
    let rows = statement.steps().iter().enumerate().map(|(at, step)| match step {
        Step::PickPlace(PickPlace { object, from, to, grasp, release, gap }) => {
            let gap = gap.map(|gap| format!("{:.1} mm", gap * 1e3)).unwrap_or_default();
            let from = from.map(point).unwrap_or_default();
            let (object, arrow) = (plain(object), "→".to_owned());
            vec![(at + 1).to_string(), object, from, arrow, point(*to), yaw(*grasp), yaw(*release), gap]
        }
        Step::PickDrop(PickDrop { object, from, grasp, drop_off }) => {
            let from = from.map(point).unwrap_or_default();
            let arrow = "→".to_owned();
            let place = plain(drop_off);
            vec![(at + 1).to_string(), plain(object), from, arrow, place, yaw(*grasp), String::new(), String::new()]
        }
    });
    format!("{}\n{}", table(&columns, rows), last_grasp("Then grasp", target, statement))
}

fn point(pose: Pose) -> String {
    format!("{:.3}, {:.3}", pose.at.x, pose.at.y)
}

/// The yaw, and how far it may be off to either side.
fn yaw(StatedGrasp { yaw, slack }: StatedGrasp) -> String {
    let slack = slack.map(|slack| format!(" ±{:.1}°", slack.to_degrees())).unwrap_or_default();
    format!("{:.1}°{slack}", yaw.to_degrees())
}

fn why_least(statement: &Statement) -> String {
    let (Some(cost), Some(least)) = (statement.cost, statement.lower_bound) else {
        return "Whether fewer relocations suffice is not known.\n".to_owned();
    };
    let bound = why_bound(statement);
    if cost == least {
        return format!("{bound}So {cost} is the least.\n");
    }
    let (needed, whether) = if least == Cost::ZERO {
        (String::new(), "Whether")
    } else {
        (format!("{bound}So {least} or more are needed; "), "whether")
    };
    format!("{needed}{whether} fewer than {cost} suffice is not known.\n")
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

fn ids<S: AsRef<str>>(objects: &[S]) -> String {
    objects.iter().map(|id| plain(id.as_ref())).collect::<Vec<_>>().join(", ")
}

fn why_never(scene: &Scene, Deadlock { blocked, core }: &Deadlock) -> String {
    let fixed = scene.objects().iter().filter(|object| object.fixed()).map(Object::id);
    let fixed: HashSet<&str> = fixed.collect();
    let target = scene.target().map(|target| scene.object(target).id()).unwrap_or_default();
    let members = core.iter().map(|id| {
        let part = match (id == target, fixed.contains(id.as_str())) {
            (true, _) => "the target",
            (false, true) => "fixed",
            (false, false) => "",
        };
        vec![plain(id), part.to_owned()]
    });
    let members = table(&[Column::left("object"), Column::left("")], members);
    let in_core: HashSet<&str> = core.iter().map(String::as_str).collect();
    let others: Vec<&String> = blocked.iter().filter(|id| !in_core.contains(id.as_str())).collect();
    let others = if others.is_empty() {
        String::new()
    } else {
        let more = match others.len().saturating_sub(MANY) {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        format!("\nAlso locked: {}{more}\n", ids(&others[..others.len().min(MANY)]))
    };
    format!(
        "These objects lock each other: at every yaw of each that can be moved, another of them is in the way.\n\n\
         {members}{others}"
    )
}

fn so_far(statement: &Statement) -> String {
    let needed = match &statement.needed {
        Some(needed) => format!("Would free the target, moved in this order: {}\n", ids(needed)),
        None => String::new(),
    };
    let bound = match statement.lower_bound {
        Some(bound) if bound > Cost::ZERO => format!("{}So at least {bound} must move.\n", why_bound(statement)),
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
        return "valid: all that it states holds\n".to_owned();
    }
    let count = body.faults.len();
    let lines: String = body.faults.iter().map(|fault| self::fault(fault) + "\n").collect();
    let again = match body.first_failing_step {
        Some(step) => {
            format!("Plan again: step {} fails. The grasp of the target counts as the last step.\n", step + 1)
        }
        None if body.replan => "Plan again: time ran out before all steps were replayed.\n".to_owned(),
        None => String::new(),
    };
    format!("not valid: {count} {}\n{lines}{again}", if count == 1 { "fault" } else { "faults" })
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
    let note =
        "The numbers do not consider places. `plan` finds out whether there are places for the relocated objects.\n";
    format!("{}\n{note}", table(&columns, rows))
}

#[cfg(test)]
mod tests;
