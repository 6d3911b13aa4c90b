//! The steps as a table, and the grasp at their end.

use nalgebra::Point2;

use super::super::table::{Column, table};
use super::plain;
use crate::render::turn;
use singulate_planner::scene::{Scene, distance};
use singulate_planner::statement::{PickPlace, StatedGrasp, StatedPose, Statement, Step};

/// A grasp's axis nearer than this to the origin of its object's frame is not told, m: half of the last digit.
const NEAR: f64 = 5e-4;

/// The columns that only some tables need.
struct Extra {
    /// Some step sets its object down on the table.
    placed: bool,
    /// Some step takes its object to a drop-off.
    dropped: bool,
    /// Some step turns its object.
    turned: bool,
    /// Some gripper's axis is elsewhere than its object's origin.
    axes: bool,
}

impl Extra {
    fn new(steps: &[Step]) -> Self {
        let placed = steps.iter().any(|step| step.rests_at().is_some());
        Self {
            placed,
            dropped: !placed || steps.iter().any(|step| step.rests_at().is_none()),
            turned: steps.iter().any(|step| turned(step).is_some()),
            axes: steps.iter().any(off_centre),
        }
    }
}

/// The table, without columns that no step fills.
pub(super) fn steps(statement: &Statement) -> String {
    let extra = Extra::new(statement.steps());
    let rows = statement.steps().iter().enumerate().map(|(at, step)| {
        let mut row = vec![(at + 1).to_string(), plain(step.object())];
        row.extend(cells(step, &extra));
        row
    });
    table(&columns(&extra), rows)
}

fn columns(extra: &Extra) -> Vec<Column> {
    let optional = |wanted: bool, column| wanted.then_some(column);
    let fixed = [Column::right("#"), Column::left("object"), Column::right("from (m)"), Column::left("")];
    let optional = [
        optional(extra.placed, Column::right("to (m)")),
        optional(extra.turned, Column::right("turn")),
        optional(extra.dropped, Column::left(if extra.placed { "drop-off" } else { "to" })),
        optional(extra.axes, Column::right("grasp at (m)")),
        Some(Column::right("grasp yaw")),
        optional(extra.placed && extra.axes, Column::right("release at (m)")),
        optional(extra.placed, Column::right("release yaw")),
        optional(extra.placed, Column::right("gap")),
    ];
    fixed.into_iter().chain(optional.into_iter().flatten()).collect()
}

/// All after the object; empty where the step has nothing to tell.
fn cells(step: &Step, extra: &Extra) -> Vec<String> {
    let (from, grasp) = picked(step);
    let (place, drop_off) = match step {
        Step::PickPlace(step) => (Some(step), None),
        Step::PickDrop(step) => (None, Some(&step.drop_off)),
    };
    let of_place = |told: &dyn Fn(&PickPlace) -> String| place.map(told).unwrap_or_default();
    let gap = |step: &PickPlace| step.gap.map(|gap| format!("{:.1} mm", gap * 1e3)).unwrap_or_default();
    let cells = [
        (true, from.map(pose).unwrap_or_default()),
        (true, "→".to_owned()),
        (extra.placed, of_place(&|step| pose(step.to))),
        (extra.turned, turned(step).unwrap_or_default()),
        (extra.dropped, drop_off.map(|id| plain(id)).unwrap_or_default()),
        (extra.axes, from.map(|from| axis(grasp, from)).unwrap_or_default()),
        (true, yaw(grasp)),
        (extra.placed && extra.axes, of_place(&|step| axis(step.release, step.to))),
        (extra.placed, of_place(&|step| yaw(step.release))),
        (extra.placed, of_place(&gap)),
    ];
    cells.into_iter().filter(|(told, _)| *told).map(|(_, cell)| cell).collect()
}

/// The grasp of what is freed.
pub(super) fn last_grasp(verb: &str, scene: &Scene, statement: &Statement) -> String {
    let by_id = |id: &String| scene.objects().iter().find(|object| object.id() == id);
    let chosen = scene.target().map(|target| scene.object(target)).or(statement.target.as_ref().and_then(by_id));
    let Some((grasp, target)) = statement.target_grasp.zip(chosen) else { return String::new() };
    let from = target.footprint().at();
    let place = if is_off(grasp, from) { format!(" over {}", point(grasp.at.unwrap_or(from))) } else { String::new() };
    format!("{verb} {} at yaw {}{place}.\n", plain(target.id()), yaw(grasp))
}

fn picked(step: &Step) -> (Option<StatedPose>, StatedGrasp) {
    match step {
        Step::PickPlace(step) => (step.from, step.grasp),
        Step::PickDrop(step) => (step.from, step.grasp),
    }
}

fn turned(step: &Step) -> Option<String> {
    step.pick_place().and_then(|step| step.turn).and_then(turn)
}

/// True if the gripper's axis is elsewhere than the object's origin, which is where it is expected.
fn off_centre(step: &Step) -> bool {
    let (from, grasp) = picked(step);
    let released = step.pick_place().is_some_and(|step| is_off(step.release, step.to.at));
    released || from.is_some_and(|from| is_off(grasp, from.at))
}

fn is_off(grasp: StatedGrasp, origin: Point2<f64>) -> bool {
    grasp.at.is_some_and(|axis| distance(axis, origin) > NEAR)
}

fn axis(grasp: StatedGrasp, object: StatedPose) -> String {
    point(grasp.at.unwrap_or(object.at))
}

/// Where an object stands, and how it is turned if that matters: from 0° to 360°, so that equal directions look equal.
fn pose(StatedPose { at, yaw }: StatedPose) -> String {
    let turned = yaw.map(|yaw| {
        let tenths = (yaw.to_degrees() * 10.0).round().rem_euclid(3600.0);
        format!(", {:.1}°", tenths / 10.0)
    });
    point(at) + &turned.unwrap_or_default()
}

fn point(at: Point2<f64>) -> String {
    format!("{:.3}, {:.3}", at.x, at.y)
}

/// The yaw, and how far it may be off to either side.
fn yaw(StatedGrasp { yaw, slack, .. }: StatedGrasp) -> String {
    let slack = slack.map(|slack| format!(" ±{:.1}°", slack.to_degrees())).unwrap_or_default();
    format!("{:.1}°{slack}", yaw.to_degrees())
}
