//! The paper's repositioning before the checker: what it puts down touches nothing, but may not come off the gripper.

use nalgebra::Point2;
use singulate::experiments::{Recipe, generate, varied};
use singulate_planner::budget::Budget;
use singulate_planner::check::FaultCode::{self, *};
use singulate_planner::geometry::Grasp;
use singulate_planner::knowledge::SweptFinger;
use singulate_planner::paper::{DEFAULT_RESOLUTION, Raster, reposition};
use singulate_planner::placement::{Arrangement, Move, Relocation};
use singulate_planner::plan::{Settings, plan};
use singulate_planner::scene::{ObjectIndex, Scene, SceneDraft, SceneLimits};
use singulate_planner::search::SILENT;
use singulate_planner::statement::{PickPlace, StatedGrasp, Statement, Step, Verdict};

use crate::check::scenes::{Builder, codes, judge};

fn stated(scene: &Scene, arrangement: &Arrangement) -> Statement {
    let grasp = |grasp: Grasp| StatedGrasp { at: Some(grasp.axis), yaw: grasp.yaw, slack: Some(grasp.slack) };
    let step = |step: &Move| {
        let Move::Place(step) = step else { unreachable!("the paper knows no drop-offs") };
        Step::PickPlace(PickPlace {
            object: scene.object(step.object).id().to_owned(),
            from: Some(step.from.at.into()),
            to: step.to.at.into(),
            grasp: grasp(step.grasp),
            release: grasp(step.release),
            turn: None,
            gap: Some(step.gap),
        })
    };
    let target_grasp = arrangement.target_grasp.map(|(_, found)| grasp(found));
    let relocations = Some(arrangement.moves.iter().map(step).collect());
    Statement { relocations, target_grasp, ..Statement::default() }
}

fn repositioned(scene: &Scene, order: &[ObjectIndex]) -> Option<Arrangement> {
    let raster = Raster::new(DEFAULT_RESOLUTION, scene.table()).unwrap();
    reposition(scene, scene.target().unwrap(), order, &raster, &SweptFinger, &Budget::unlimited()).unwrap()
}

/// All but one place is in a keep-out. Three others stand round it, 30 mm away, each of which takes 48° of the fingers'
/// 120° although it makes only 6 % of the disc black.
#[test]
fn a_place_where_the_gripper_cannot_open_is_taken_all_the_same() {
    let at = |bearing: f64| {
        let bearing = bearing.to_radians();
        (1.0 + 0.18 * libm::cos(bearing), 1.0 + 0.18 * libm::sin(bearing))
    };
    let mut scene = Builder::new(3)
        .keep_out([0.0, 0.0, 2.0, 0.92])
        .keep_out([0.0, 1.08, 2.0, 2.0])
        .keep_out([0.0, 0.92, 0.92, 1.08])
        .keep_out([1.08, 0.92, 2.0, 1.08])
        .disc("t", 0.3, 0.3, 0.075)
        .disc("a", 0.46, 0.3, 0.075);
    for (id, bearing) in [("b", 0.0), ("c", 80.0), ("d", 160.0)] {
        let (x, y) = at(bearing);
        scene = scene.disc(id, x, y, 0.075);
    }
    let scene = scene.build("t");
    let arrangement = repositioned(&scene, &[ObjectIndex::new(1)]).unwrap();
    let Move::Place(Relocation { to, .. }) = arrangement.moves[0] else { unreachable!("no drop-offs") };
    let to = to.at;
    assert!((to - Point2::new(1.0, 1.0)).norm() < 0.007, "{to}");
    assert_eq!(codes(&judge(&scene, &stated(&scene, &arrangement))), [ReleaseBlocked]);
}

/// Faults of the raster's places for the objects of our own plans, or `None` where one of the two finds none.
fn faults(draft: SceneDraft) -> Option<Vec<FaultCode>> {
    let (scene, _) = Scene::new(draft, &SceneLimits::default()).unwrap();
    let ours = plan(&scene, &Settings::default(), &Budget::unlimited(), SILENT).unwrap().statement;
    if ours.verdict != Some(Verdict::Relocate) {
        return None;
    }
    let order: Vec<ObjectIndex> = ours.steps().iter().map(|step| scene.find(step.object()).unwrap()).collect();
    Some(codes(&judge(&scene, &stated(&scene, &repositioned(&scene, &order)?))))
}

#[test]
fn nothing_but_the_opening_of_the_gripper_ever_fails() {
    let of_the_paper = (0..90).filter_map(|seed| {
        let objects = [16, 18, 20][seed as usize % 3];
        generate(&Recipe { objects, ..Recipe::default() }, seed).ok()
    });
    let (mut seen, mut blocked) = (0, 0);
    for found in of_the_paper.chain((0..200).map(varied)).filter_map(faults) {
        // A release stated with no slack falls short of the yaw tolerance too.
        assert!(found.iter().all(|code| [ReleaseBlocked, WrongSlack].contains(code)), "{found:?}");
        seen += 1;
        blocked += usize::from(found.contains(&ReleaseBlocked));
    }
    assert!(seen > 60 && blocked > 1, "{blocked} of {seen} plans with a blocked release");
}
