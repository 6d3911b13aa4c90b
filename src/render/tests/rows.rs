//! Scenes of discs in a row, their steps, and their drawings in parts.

use super::*;
use crate::experiments::Recipe;
use singulate_planner::scene::DropOffDraft;
use singulate_planner::statement::PickDrop;

/// The id, the capacity and what it accepts.
pub(super) type DropOff<'a> = (&'a str, Option<f64>, Option<&'a [&'a str]>);

/// Discs in a row, 0.4 m apart, the first at (0.2, 0.3), with these radii, on a table of 4 × 1 m.
pub(super) fn row(radii: &[(&str, f64)], goal: GoalDraft, drop_offs: &[DropOff<'_>]) -> SceneDraft {
    let object = |(at, (id, radius)): (usize, &(&str, f64))| ObjectDraft {
        id: Some((*id).to_owned()),
        x: Some(0.2 + 0.4 * at as f64),
        y: Some(0.3),
        shape: ShapeDraft::disc(*radius),
        fixed: id.starts_with("fixed"),
        ..ObjectDraft::default()
    };
    let accepts = |ids: &[&str]| ids.iter().map(|id| Some((*id).to_owned())).collect();
    let drop_off = |(id, capacity, accepted): &DropOff<'_>| DropOffDraft {
        id: Some((*id).to_owned()),
        capacity: *capacity,
        accepts: accepted.map(accepts),
    };
    SceneDraft {
        table: TableDraft { top: rectangle(0.0, 0.0, 4.0, 1.0), keep_out: Vec::new() },
        gripper: Recipe::default().gripper,
        objects: radii.iter().enumerate().map(object).collect(),
        goal: Some(goal),
        drop_offs: (!drop_offs.is_empty()).then(|| drop_offs.iter().map(drop_off).collect()),
        destination: None,
    }
}

pub(super) fn sound(draft: SceneDraft) -> Scene {
    Scene::new(draft, &SceneLimits::default()).unwrap().0
}

pub(super) const GRASP: StatedGrasp = StatedGrasp { at: None, yaw: 0.0, slack: Some(0.1) };

pub(super) fn dropped(scene: &Scene, object: usize, drop_off: &str) -> Step {
    let object = &scene.objects()[object];
    let (object, from) = (object.id().to_owned(), Some(object.footprint().at().into()));
    Step::PickDrop(PickDrop { object, from, grasp: GRASP, drop_off: drop_off.to_owned() })
}

pub(super) fn placed(scene: &Scene, object: usize) -> Step {
    let object = &scene.objects()[object];
    let from = object.footprint().at();
    Step::PickPlace(PickPlace {
        object: object.id().to_owned(),
        from: Some(from.into()),
        to: Point2::new(from.x, 0.8).into(),
        grasp: GRASP,
        release: GRASP,
        turn: None,
        gap: Some(0.1),
    })
}

pub(super) fn plan(verdict: Verdict, steps: Vec<Step>) -> Statement {
    let cost = Some(Cost::of_each(steps.len()));
    Statement { verdict: Some(verdict), cost, relocations: Some(steps), ..Statement::default() }
}

pub(super) fn any(ids: &[&str]) -> GoalDraft {
    GoalDraft::AnyOf(ids.iter().map(|id| Some((*id).to_owned())).collect())
}

pub(super) fn all(ids: &[&str]) -> GoalDraft {
    GoalDraft::AllOf(ids.iter().map(|id| Some((*id).to_owned())).collect())
}

/// The drawing, which is sound XML.
pub(super) fn drawn(scene: &Scene, stated: Statement) -> String {
    let drawing = svg(scene, &answer(stated));
    parse(&drawing);
    drawing
}

/// The drawing's groups of this class.
pub(super) fn groups<'a>(drawing: &'a str, class: &str) -> Vec<&'a str> {
    drawing.split(&format!("class=\"{class}\"")).skip(1).collect()
}

/// The value of an attribute, the first time that it occurs.
pub(super) fn number(text: &str, name: &str) -> f64 {
    text.split_once(&format!(" {name}=\"")).unwrap().1.split('"').next().unwrap().parse().unwrap()
}

pub(super) const THREE: &[(&str, f64)] = &[("a", 0.08), ("b", 0.08), ("c", 0.08)];
