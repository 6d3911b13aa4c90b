//! Answers for humans: the steps and the reasons.

mod steps;
mod why;

use core::time::Duration;

use self::steps::{last_grasp, steps};
use self::why::{no_proof, so_far, why_least, why_left, why_never};
use super::table::{Column, table};
use crate::render::{fills, goal, headline};
use crate::wire::{FaultBody, PlanRequest, VerificationBody, warnings};
use singulate_planner::paper::Judged;
use singulate_planner::plan::{Answer, Statistics, SurveyEntry, SurveyVerdict};
use singulate_planner::scene::Scene;
use singulate_planner::statement::{Statement, Verdict};

/// The most ids in one sentence.
const MANY: usize = 40;
/// So many drop-offs are all told; of more only those that are used.
const FEW: usize = 8;

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
    let Judged { answer: Answer { statement, statistics }, .. } = judged;
    let mut paragraphs = vec![format!("{}\n{}", plain(&headline(scene, judged)), aim(request, statement))];
    paragraphs.extend(match statement.verdict {
        Some(Verdict::Graspable) => vec![last_grasp("Grasp", scene, statement)],
        Some(Verdict::Relocate) => {
            vec![steps(statement), last_grasp("Then grasp", scene, statement), why_least(scene, statement)]
        }
        Some(Verdict::Cleared | Verdict::PartlyCleared) if statement.steps().is_empty() => why_left(scene, statement),
        Some(Verdict::Cleared | Verdict::PartlyCleared) => {
            [vec![steps(statement)], why_left(scene, statement)].concat()
        }
        // Without a proof, headline and warnings say everything.
        Some(Verdict::Deadlock) => statement.deadlock.iter().map(|deadlock| why_never(scene, deadlock)).collect(),
        Some(Verdict::NoSpace) => vec![so_far(scene, statement), no_proof(scene).to_owned()],
        Some(Verdict::TimedOut) => vec![so_far(scene, statement)],
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

/// What is wanted, and how full the drop-offs are in the end.
fn aim(request: &PlanRequest, statement: &Statement) -> String {
    let scene = &request.scene;
    let name = |id: &String| format!(" in scene {}", plain(id));
    let place = request.scene_id.as_ref().map(name).unwrap_or_default();
    let word = if scene.target().is_some() { "target" } else { "goal" };
    format!("{word}: {}{place}\n{}", plain(&goal(scene, MANY)), drop_offs(scene, statement))
}

/// Those that are used; all of a few.
fn drop_offs(scene: &Scene, statement: &Statement) -> String {
    let fills = fills(scene, statement);
    if fills.is_empty() {
        return String::new();
    }
    let told = fills.iter().filter(|fill| fills.len() <= FEW || fill.held > 0).take(MANY);
    let told: Vec<String> = told.map(|fill| format!("{} ({})", plain(fill.id), fill.amount())).collect();
    let more = match (told.len(), fills.len() - told.len()) {
        (_, 0) => String::new(),
        (0, count) => format!("{count}, none used"),
        (_, more) => format!(" and {more} more"),
    };
    format!("drop-offs: {}{more}\n", told.join(", "))
}

fn ids(objects: &[impl AsRef<str>]) -> String {
    objects.iter().map(|id| plain(id.as_ref())).collect::<Vec<_>>().join(", ")
}

fn times(statistics: &Statistics) -> String {
    let ms = |duration: Duration| format!("{:.2} ms", duration.as_secs_f64() * 1e3);
    let Statistics { knowledge, search, placement, check } = *statistics;
    let parts = [(knowledge, "knowledge"), (search, "search"), (placement, "placement"), (check, "check")];
    let parts = parts.map(|(duration, name)| format!("{name} {}", ms(duration)));
    format!("{} in all: {}\n", ms(knowledge + search + placement + check), parts.join(", "))
}

/// The checker's report.
pub(super) fn verification(scene: &Scene, body: &VerificationBody) -> String {
    if body.valid {
        return "valid: all that it states holds\n".to_owned();
    }
    let count = body.faults.len();
    let lines: String = body.faults.iter().map(|fault| self::fault(fault) + "\n").collect();
    let again = match body.first_failing_step {
        Some(step) => {
            let grasped = !scene.goal().candidates().is_empty();
            let last = if grasped { " The grasp of the target counts as the last step." } else { "" };
            format!("Plan again: step {} fails.{last}\n", step + 1)
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
    let note = if scene.drop_offs().is_empty() {
        "The numbers do not consider places. `plan` finds out whether there are places for the relocated objects.\n"
    } else {
        "The numbers consider neither places nor how much a drop-off takes. `plan` finds out whether there is room.\n"
    };
    format!("{}\n{note}", table(&columns, rows))
}

#[cfg(test)]
mod tests;
