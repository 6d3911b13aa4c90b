//! Places where space is short or strangely shaped.

use singulate::budget::Budget;
use singulate::experiments::{Recipe, generate, varied};
use singulate::plan::{Objective, Settings, Verdict, plan};
use singulate::scene::{ObjectDraft, RectangleDraft, Scene, SceneDraft, SceneLimits};

fn verdict(draft: SceneDraft, objective: Objective) -> Verdict {
    let (scene, _) = Scene::new(draft, &SceneLimits::default()).unwrap();
    plan(&scene, &Settings { objective }, &Budget::unlimited()).unwrap().verdict
}

#[track_caller]
fn assert_optimal(verdict: &Verdict) {
    assert!(matches!(verdict, Verdict::Relocate(plan) if plan.optimal()), "{verdict:?}");
}

#[test]
fn twenty_thousand_keep_outs_are_not_paired_with_each_other() {
    let mut draft = generate(&Recipe { objects: 25, table: (1.4, 0.7), ..Recipe::default() }, 4).unwrap();
    draft.target = Some("o15".into());
    draft.table.top.x_max = Some(2.4);
    let side = |at: u32, step: f64| (Some(step * f64::from(at)), Some(step * f64::from(at) + 1e-4));
    for n in 0..20_000_u32 {
        let ((x_min, x_max), (y_min, y_max)) = (side(n % 200, 7e-3), side(n / 200, 7e-3));
        draft.table.keep_out.push(RectangleDraft { x_min, y_min, x_max, y_max });
    }
    for objective in [Objective::FarFromTarget, Objective::ShortMoves] {
        assert_optimal(&verdict(draft.clone(), objective));
    }
}

#[test]
fn a_place_that_is_worse_by_the_objective_is_better_than_one_more_relocation() {
    assert_optimal(&verdict(varied(208), Objective::FarFromTarget));
    assert_optimal(&verdict(varied(1035), Objective::ShortMoves));
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
        objects.push(ObjectDraft { id: Some(id), x: Some(x), y: Some(y), radius: Some(radius), fixed });
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
    draft.target = Some("step-0".into());
    draft
}

#[test]
fn a_long_plan_on_a_wide_table_is_found() {
    for objective in [Objective::FarFromTarget, Objective::ShortMoves] {
        let verdict = verdict(stair(80), objective);
        assert_optimal(&verdict);
        assert!(matches!(verdict, Verdict::Relocate(plan) if plan.cost() == 79));
    }
}
