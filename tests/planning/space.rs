//! Places where space is short or strangely shaped.

use singulate::experiments::{Recipe, generate, varied};
use singulate_planner::budget::Budget;
use singulate_planner::check::check;
use singulate_planner::cost::Cost;
use singulate_planner::plan::{Objective, Settings, plan};
use singulate_planner::scene::{
    Footprint, GoalDraft, ObjectDraft, ObjectIndex, RectangleDraft, Scene, SceneDraft, SceneLimits, ShapeDraft,
};
use singulate_planner::search::SILENT;
use singulate_planner::statement::{PickPlace, Statement, Step, Verdict};

use crate::check::scenes::step_mut;

fn planned(scene: &Scene, objective: Objective) -> Statement {
    plan(scene, &Settings { objective }, &Budget::unlimited(), SILENT).unwrap().statement
}

fn planned_for(draft: SceneDraft, objective: Objective) -> Statement {
    planned(&Scene::new(draft, &SceneLimits::default()).unwrap().0, objective)
}

/// Three discs in a row on a table of `width` m: the outer two hold the middle one.
fn row(width: f64, margin: f64) -> SceneDraft {
    let mut draft = generate(&Recipe { objects: 1, ..Recipe::default() }, 1).unwrap();
    draft.table.top = RectangleDraft { x_min: Some(0.0), y_min: Some(0.0), x_max: Some(1.0), y_max: Some(width) };
    (draft.gripper.fingers, draft.gripper.margin) = (Some(3.0), Some(margin));
    let disc = |(id, x): (&str, f64)| ObjectDraft {
        id: Some(id.to_owned()),
        x: Some(x),
        y: Some(width / 2.0),
        shape: ShapeDraft::disc(0.04),
        ..ObjectDraft::default()
    };
    let apart = 0.08 + margin.max(0.01);
    draft.objects = [("left", 0.5 - apart), ("middle", 0.5), ("right", 0.5 + apart)].map(disc).into();
    draft.goal = Some(GoalDraft::Target("middle".to_owned()));
    draft
}

#[test]
fn a_place_keeps_five_millimetres_from_the_edge_whatever_the_margin_and_nothing_where_there_is_no_room() {
    for (width, margin, edge) in [(0.5, 0.0, 5e-3), (0.5, 0.03, 5e-3), (0.082, 0.0, 0.0), (0.082, 0.03, 0.0)] {
        let stated = planned_for(row(width, margin), Objective::FarFromTarget);
        assert_eq!(stated.verdict, Some(Verdict::Relocate), "{width} {margin}");
        let gap = |at: f64, side: f64| at.min(side - at) - 0.04;
        for step in stated.steps().iter().filter_map(Step::pick_place) {
            let nearest = gap(step.to.at.x, 1.0).min(gap(step.to.at.y, width));
            assert!((nearest - edge).abs() < 1e-5, "{width} {margin}: {nearest}");
            assert!(step.gap.unwrap() >= margin, "{:?}", step.gap);
        }
    }
}

#[track_caller]
fn assert_optimal(stated: &Statement) {
    assert!(stated.verdict == Some(Verdict::Relocate) && stated.optimal == Some(true), "{stated:?}");
    assert_eq!(stated.lower_bound, Some(Cost::of_each(stated.steps().len())));
}

#[test]
fn twenty_thousand_keep_outs_are_not_paired_with_each_other() {
    let mut draft = generate(&Recipe { objects: 25, table: (1.4, 0.7), ..Recipe::default() }, 4).unwrap();
    draft.goal = Some(GoalDraft::Target("o15".into()));
    draft.table.top.x_max = Some(2.4);
    let side = |at: u32, step: f64| (Some(step * f64::from(at)), Some(step * f64::from(at) + 1e-4));
    for n in 0..20_000_u32 {
        let ((x_min, x_max), (y_min, y_max)) = (side(n % 200, 7e-3), side(n / 200, 7e-3));
        draft.table.keep_out.push(RectangleDraft { x_min, y_min, x_max, y_max });
    }
    for objective in [Objective::FarFromTarget, Objective::ShortMoves] {
        assert_optimal(&planned_for(draft.clone(), objective));
    }
}

#[test]
fn a_place_that_is_worse_by_the_objective_is_better_than_one_more_relocation() {
    assert_optimal(&planned_for(varied(208), Objective::FarFromTarget));
    assert_optimal(&planned_for(varied(1035), Objective::ShortMoves));
}

/// A stair on whose steps each disc can only be gripped along the way to the next one, which stands in that way. Crumbs
/// that can't be moved keep the fingers from all other yaws.
fn stair(steps: u32) -> SceneDraft {
    let mut draft = generate(&Recipe { objects: 1, ..Recipe::default() }, 1).unwrap();
    let (pitch, side) = (0.12, Some(0.06 * f64::from(steps) + 1.0));
    draft.table.top = RectangleDraft { x_min: Some(-1.0), y_min: Some(-1.0), x_max: side, y_max: side };
    draft.gripper.fingers = Some(2.0);
    (draft.gripper.finger_width, draft.gripper.clearance) = (Some(0.06), Some(0.03));
    let mut objects = Vec::new();
    let mut disc = |id: String, x: f64, y: f64, radius: f64, fixed: bool| {
        objects.push(ObjectDraft {
            id: Some(id),
            x: Some(x),
            y: Some(y),
            shape: ShapeDraft::disc(radius),
            fixed,
            ..ObjectDraft::default()
        });
    };
    for step in 0..steps {
        let (x, y) = (pitch * f64::from(step.div_ceil(2)), pitch * f64::from(step / 2));
        disc(format!("step-{step}"), x, y, 0.05, false);
        for (n, (ahead, aside)) in [(0.06, 0.0), (0.0425, 0.0425), (0.0425, -0.0425)].into_iter().enumerate() {
            let (dx, dy) = if step % 2 == 0 { (aside, ahead) } else { (ahead, aside) };
            disc(format!("crumb-{step}-{n}"), x + dx, y + dy, 0.005, true);
        }
    }
    draft.objects = objects;
    draft.goal = Some(GoalDraft::Target("step-0".into()));
    draft
}

#[test]
fn a_long_plan_on_a_wide_table_is_found() {
    for objective in [Objective::FarFromTarget, Objective::ShortMoves] {
        let stated = planned_for(stair(150), objective);
        assert_optimal(&stated);
        assert_eq!((stated.cost, stated.steps().len()), (Some(Cost::new(149)), 149));
    }
}

/// Does the disc keep the 5 mm that the planner keeps where it can?
fn keeps_preferred_gap(scene: &Scene, object: ObjectIndex, footprint: &Footprint) -> bool {
    let gap = 0.005;
    let apart = |other: ObjectIndex| footprint.gap(scene.object(other).footprint()) >= gap + scene.gripper().margin();
    scene.indices().filter(|&other| other != object).all(apart)
        && footprint.gap_inside(&scene.table().top()) >= gap
        && scene.table().keep_out().iter().all(|area| footprint.gap_outside(area) >= gap)
}

/// A move that the checker admits and that is no longer than `limit` (m), among 36 directions, 20 distances and 24 release
/// yaws.
fn shorter_move(scene: &Scene, stated: &Statement, step: &PickPlace, limit: f64) -> Option<f64> {
    let plan_only = Statement { lower_bound: None, optimal: None, landmarks: None, ..stated.clone() };
    let (object, from) = (scene.find(&step.object).unwrap(), step.from.unwrap().at);
    (1..=20).map(|n| limit * f64::from(n) / 20.0).find(|&distance| {
        (0..36).map(|n| core::f64::consts::TAU * f64::from(n) / 36.0).any(|angle| {
            let to = from + distance * nalgebra::Vector2::new(libm::cos(angle), libm::sin(angle));
            let placed = scene.object(object).footprint().moved_to(to.into());
            keeps_preferred_gap(scene, object, &placed)
                && (0..24).any(|n| {
                    let mut shorter = plan_only.clone();
                    let moved = step_mut(&mut shorter, 0);
                    (moved.to, moved.gap, moved.release.slack) = (to.into(), None, None);
                    moved.release.yaw = scene.gripper().period() * f64::from(n) / 24.0;
                    shorter.target_grasp.as_mut().unwrap().slack = None;
                    check(scene, &shorter, &Budget::unlimited()).faults.is_empty()
                })
        })
    })
}

#[test]
fn no_short_move_is_much_longer_than_sampling_finds() {
    let mut seen = 0;
    for seed in 0..200 {
        let (scene, _) = Scene::new(varied(seed), &SceneLimits::default()).unwrap();
        let stated = planned(&scene, Objective::ShortMoves);
        let [step] = stated.steps() else { continue };
        let step = step.pick_place().unwrap();
        let own = scene.object(scene.find(&step.object).unwrap()).footprint();
        let moved = (step.to.at - step.from.unwrap().at).norm();
        if step.gap.unwrap() >= 0.005 + scene.gripper().margin()
            && own.moved_to(step.to.into()).gap_inside(&scene.table().top()) >= 0.005
        {
            let limit = (0.8 * moved - 0.002).max(0.0);
            assert_eq!(
                shorter_move(&scene, &stated, step, limit).filter(|_| limit > 0.0),
                None,
                "seed {seed}: moved {moved} m"
            );
            seen += 1;
        }
    }
    assert!(seen > 10, "{seen} plans with one roomy move");
}
