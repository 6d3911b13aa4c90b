//! Places where space is short or strangely shaped.

use singulate::budget::Budget;
use singulate::experiments::{Recipe, generate, varied};
use singulate::plan::{Objective, Settings, Verdict, plan};
use singulate::scene::{RectangleDraft, Scene, SceneDraft, SceneLimits};

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
