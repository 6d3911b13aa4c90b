//! The lines above the table, and the same for screen readers.

use nalgebra::Point2;
use svg::node::element::Group;

use super::fill::drop_off;
use super::headline::headline;
use super::label;
use super::paint;
use super::phrases::listed;
use super::scene_line::{drop_off_line, hand_line, scene_line};
use super::stays::left;
use super::view::{PADDING, View};
use singulate_planner::paper::{Judged, Warning};
use singulate_planner::scene::Scene;
use singulate_planner::statement::{Statement, Step, Verdict};

/// The most ids for each reason to stay.
const MOST: usize = 12;
/// Size of the lines below the first, px.
const SMALL: f64 = 13.0;
/// Space between the lines, px.
const LEADING: f64 = 6.0;

/// The objects, which the headline leaves out.
fn detail(stated: &Statement) -> String {
    match stated.verdict {
        Some(Verdict::Relocate | Verdict::Cleared | Verdict::PartlyCleared) if !stated.steps().is_empty() => {
            in_order(stated)
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
        _ => String::new(),
    }
}

/// The objects in order; after those that go to one drop-off its name.
fn in_order(stated: &Statement) -> String {
    let runs = stated.steps().chunk_by(|one, next| drop_off(one) == drop_off(next)).map(|run| {
        let moved = run.iter().map(Step::object).collect::<Vec<_>>().join(", ");
        drop_off(&run[0]).map_or_else(|| moved.clone(), |drop_off| format!("{moved} to {drop_off}"))
    });
    format!("in order: {}", runs.collect::<Vec<_>>().join("; "))
}

/// What a clearing leaves, with the reasons; without what the caller calls fixed.
fn staying(scene: &Scene, stated: &Statement) -> String {
    let told = left(scene, stated).into_iter().map(|(reason, objects)| {
        let ids: Vec<String> = objects.iter().take(MOST).map(|&object| scene.object(object).id().to_owned()).collect();
        format!("{} ({})", listed(&ids, objects.len()), reason.words())
    });
    let told: Vec<String> = told.collect();
    if told.is_empty() { String::new() } else { format!("left: {}", told.join("; ")) }
}

/// The codes of the answer's warnings.
fn warned(judged: &Judged) -> String {
    let mut codes: Vec<&str> = judged.warnings.iter().map(Warning::code).collect();
    codes.sort_unstable();
    codes.dedup();
    if codes.is_empty() { String::new() } else { format!("warnings: {}", codes.join(", ")) }
}

/// The whole text, for screen readers.
pub(super) fn description(scene: &Scene, judged: &Judged) -> String {
    let stated = judged.statement();
    let parts = [detail(stated), staying(scene, stated), scene_line(scene), hand_line(scene), drop_off_line(scene)];
    parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join(". ")
}

/// The lines above the table.
#[derive(Debug)]
pub(super) struct Lines {
    /// Each with its size, px.
    lines: Vec<(String, f64)>,
    /// How much higher they are than those of a scene without drop-offs, clearing and palm, px.
    pub(super) added: f64,
}

impl Lines {
    pub(super) fn new(scene: &Scene, judged: &Judged) -> Self {
        let stated = judged.statement();
        let (left, hand, drop_offs) = (staying(scene, stated), hand_line(scene), drop_off_line(scene));
        let added = [&left, &hand, &drop_offs].iter().filter(|line| !line.is_empty()).count();
        let small =
            [detail(stated), left, warned(judged), scene_line(scene), hand, drop_offs].map(|line| (line, SMALL));
        let lines = core::iter::once((headline(scene, judged), 20.0)).chain(small);
        Self { lines: lines.filter(|(text, _)| !text.is_empty()).collect(), added: added as f64 * (SMALL + LEADING) }
    }

    pub(super) fn drawn(&self, view: &View) -> Group {
        let room = view.width() - 2.0 * PADDING;
        let mut baseline = 12.0;
        let mut group = Group::new().set("class", "headline");
        for (text, size) in &self.lines {
            let Some((text, fitted)) = label::fit(text, *size, room) else { continue };
            baseline += LEADING + size;
            let line = label::line(&text, fitted, Point2::new(PADDING, baseline));
            group = group.add(if *size > SMALL {
                line.set("fill", paint::INK).set("font-weight", "bold")
            } else {
                line.set("fill", paint::FAINT_INK)
            });
        }
        group
    }
}
