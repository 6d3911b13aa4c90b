//! Places where space is short or strangely shaped.

use singulate::experiments::{Recipe, generate, varied};
use singulate_planner::budget::Budget;
use singulate_planner::plan::check::check;
use singulate_planner::plan::{Answer, Claim, Objective, Relocation, Settings, Statistics, Verdict, plan};
use singulate_planner::scene::{Disc, ObjectDraft, ObjectIndex, RectangleDraft, Scene, SceneDraft, SceneLimits};

fn verdict(draft: SceneDraft, objective: Objective) -> Verdict {
    let (scene, _) = Scene::new(draft, &SceneLimits::default()).unwrap();
    plan(&scene, &Settings { objective, ..Settings::default() }, &Budget::unlimited()).unwrap().verdict
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
        radius: Some(0.04),
        fixed: false,
    };
    let apart = 0.08 + margin.max(0.01);
    draft.objects = [("left", 0.5 - apart), ("middle", 0.5), ("right", 0.5 + apart)].map(disc).into();
    draft.target = Some("middle".to_owned());
    draft
}

#[test]
fn a_place_keeps_five_millimetres_from_the_edge_whatever_the_margin_and_nothing_where_there_is_no_room() {
    for (width, margin, edge) in [(0.5, 0.0, 5e-3), (0.5, 0.03, 5e-3), (0.082, 0.0, 0.0), (0.082, 0.03, 0.0)] {
        let Verdict::Relocate(plan) = verdict(row(width, margin), Objective::FarFromTarget) else {
            panic!("{width} {margin}")
        };
        let gap = |at: f64, side: f64| at.min(side - at) - 0.04;
        for step in &plan.relocations {
            let nearest = gap(step.to.x, 1.0).min(gap(step.to.y, width));
            assert!((nearest - edge).abs() < 1e-5, "{width} {margin}: {nearest}");
            assert!(step.gap >= margin, "{}", step.gap);
        }
    }
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
        let verdict = verdict(stair(150), objective);
        assert_optimal(&verdict);
        assert!(matches!(verdict, Verdict::Relocate(plan) if plan.cost() == 149));
    }
}

/// Does the disc keep the 5 mm that the planner keeps where it can?
fn keeps_preferred_gap(scene: &Scene, object: ObjectIndex, disc: &Disc) -> bool {
    let gap = 0.005;
    let apart = |other: ObjectIndex| disc.gap(&scene.object(other).disc()) >= gap + scene.gripper().margin();
    scene.indices().filter(|&other| other != object).all(apart)
        && scene.table().top().inner_gap(disc) >= gap
        && scene.table().keep_out().iter().all(|area| area.outer_gap(disc) >= gap)
}

/// A move that the checker admits and that is no longer than `limit` (m), among 36 directions, 20 distances and 24 release
/// yaws.
fn shorter_move(scene: &Scene, verdict: &Verdict, step: &Relocation, limit: f64) -> Option<f64> {
    let answer = Answer { verdict: verdict.clone(), warnings: Vec::new(), statistics: Statistics::default() };
    let stated = Claim::of(scene, &answer);
    let plan_only = Claim { lower_bound: None, optimal: None, landmarks: None, ..stated };
    (1..=20).map(|n| limit * f64::from(n) / 20.0).find(|&distance| {
        (0..36).map(|n| core::f64::consts::TAU * f64::from(n) / 36.0).any(|angle| {
            let to = step.from + distance * nalgebra::Vector2::new(libm::cos(angle), libm::sin(angle));
            let disc = scene.object(step.object).disc().at(to);
            keeps_preferred_gap(scene, step.object, &disc)
                && (0..24).any(|n| {
                    let mut claim = plan_only.clone();
                    let moved = &mut claim.relocations.as_mut().unwrap()[0];
                    (moved.to, moved.gap, moved.release.slack) = (to, None, None);
                    moved.release.yaw = scene.gripper().period() * f64::from(n) / 24.0;
                    claim.target_grasp.as_mut().unwrap().slack = None;
                    check(scene, &claim, &Budget::unlimited()).faults.is_empty()
                })
        })
    })
}

#[test]
fn no_short_move_is_much_longer_than_sampling_finds() {
    let mut seen = 0;
    for seed in 0..200 {
        let (scene, _) = Scene::new(varied(seed), &SceneLimits::default()).unwrap();
        let settings = Settings { objective: Objective::ShortMoves, ..Settings::default() };
        let verdict = plan(&scene, &settings, &Budget::unlimited()).unwrap().verdict;
        let Verdict::Relocate(found) = &verdict else { continue };
        let [step] = found.relocations[..] else { continue };
        let (moved, own) = ((step.to - step.from).norm(), scene.object(step.object).disc());
        if step.gap >= 0.005 + scene.gripper().margin() && scene.table().top().inner_gap(&own.at(step.to)) >= 0.005 {
            let limit = (0.8 * moved - 0.002).max(0.0);
            assert_eq!(
                shorter_move(&scene, &verdict, &step, limit).filter(|_| limit > 0.0),
                None,
                "seed {seed}: moved {moved} m"
            );
            seen += 1;
        }
    }
    assert!(seen > 10, "{seen} plans with one roomy move");
}
