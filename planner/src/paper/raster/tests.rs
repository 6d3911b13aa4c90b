//! Repositioning against its definition.

use proptest::prelude::*;

use super::*;
use crate::budget::clocks::Looks;
use crate::geometry::{ArcSet, Shadow};
use crate::knowledge::{GraspModel, SweptFinger};
use crate::scene::scenes::TestScene;
use crate::scene::{Gripper, Placed};

fn relocations(arrangement: &Arrangement) -> Vec<Relocation> {
    let relocation = |step: &Move| if let Move::Place(relocation) = step { Some(*relocation) } else { None };
    arrangement.moves.iter().filter_map(relocation).collect()
}

fn moved(scene: &Scene, ids: &[&str], resolution: f64) -> Option<Vec<Relocation>> {
    let order: Vec<ObjectIndex> = ids.iter().map(|id| scene.find(id).unwrap()).collect();
    let raster = Raster::new(resolution, scene.table()).unwrap();
    let arrangement =
        reposition(scene, scene.target().unwrap(), &order, &raster, &SweptFinger, &Budget::unlimited()).unwrap();
    arrangement.map(|arrangement| relocations(&arrangement))
}

#[track_caller]
fn check(scene: &Scene, id: &str, resolution: f64, expected: Option<(f64, f64)>) {
    let to = moved(scene, &[id], resolution).map(|moved| moved[0].to.at);
    let near = |to: Point2<f64>| expected.is_some_and(|(x, y)| (to - Point2::new(x, y)).norm() < 1e-12);
    assert!(to.map_or(expected.is_none(), near), "{to:?}");
}

/// The definition, pixel by pixel.
fn by_plain_counting(scene: &Scene, raster: &Raster, object: ObjectIndex) -> Option<Point2<f64>> {
    let (gripper, own) = (scene.gripper(), scene.object(object).footprint());
    let (margin, target) = (gripper.margin(), scene.object(scene.target().unwrap()).footprint());
    let others: Vec<Footprint> =
        scene.indices().filter(|o| *o != object).map(|o| scene.object(o).footprint().clone()).collect();
    let mut pixels = Vec::new();
    for row in 0..raster.rows() {
        pixels.extend((0..raster.columns()).map(|column| raster.centre(column, row)));
    }
    let black = |at: Point2<f64>| others.iter().any(|o| (at - o.at()).norm() < o.circumradius() + gripper.clearance());
    let marked = |at: Point2<f64>| {
        let under: Vec<_> = pixels.iter().filter(|pixel| (*pixel - at).norm() <= own.circumradius() + 1e-9).collect();
        let white = under.iter().filter(|pixel| !black(***pixel)).count();
        255.0 * white as f64 / under.len() as f64 > threshold(own.circumradius(), gripper.clearance(), gripper.period())
    };
    let mut best: Option<Point2<f64>> = None;
    for &at in &pixels {
        let placed = own.moved_to(at.into());
        let keep_out = scene.table().keep_out().iter().any(|area| placed.gap_outside(area) < INSIDE);
        let far = |at: Point2<f64>| (at - target.at()).norm_squared();
        if placed.gap_inside(&scene.table().top()) > INSIDE
            && !keep_out
            && others.iter().all(|other| placed.gap(other) >= margin + INSIDE)
            && placed.gap(target) >= gripper.clearance() + margin + INSIDE
            && best.is_none_or(|best| far(at) > far(best))
            && marked(at)
        {
            best = Some(at);
        }
    }
    best
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn the_place_is_the_farthest_marked_one(
        discs in proptest::collection::vec((0.0..0.6_f64, 0.0..0.44_f64, 0.01..0.08_f64), 1..16),
        (x, y, radius) in (0.1..0.5_f64, 0.1..0.3_f64, 0.02..0.08_f64),
        fingers in 2_u32..5,
        margin in prop_oneof![Just(0.0), 0.0..0.02_f64],
    ) {
        let scene = TestScene::new(fingers)
            .table(0.603, 0.447)
            .keep_out([0.0, 0.0, 0.2, 0.1])
            .margin(margin)
            .disc("t", x, y, radius)
            .scatter(&discs)
            .build("t");
        prop_assume!(scene.objects().len() > 1);
        let (raster, object) = (Raster::new(0.01, scene.table()).unwrap(), ObjectIndex::new(1));
        let placed = moved(&scene, &[scene.object(object).id()], 0.01).map(|moved| moved[0].to.at);
        prop_assert_eq!(placed, by_plain_counting(&scene, &raster, object));
    }

    #[test]
    fn what_is_placed_touches_nothing_and_leaves_room_for_what_comes_later(
        discs in proptest::collection::vec((0.0..1.2_f64, 0.0..0.7_f64, 0.02..0.08_f64), 5..30),
        resolution in 0.003..0.08_f64,
    ) {
        let scene = TestScene::new(3)
            .table(1.2, 0.7)
            .keep_out([0.0, 0.0, 0.2, 0.1])
            .disc("t", 0.6, 0.35, 0.05)
            .scatter(&discs)
            .build("t");
        let order: Vec<ObjectIndex> = scene.indices().skip(1).take(4).collect();
        let ids: Vec<&str> = order.iter().map(|object| scene.object(*object).id()).collect();
        let Some(moved) = moved(&scene, &ids, resolution) else { return Ok(()) };
        let mut now: Vec<Footprint> = scene.objects().iter().map(|object| object.footprint().clone()).collect();
        for (at, step) in moved.iter().enumerate() {
            let placed = now[step.object.get()].moved_to(step.to);
            for (other, disc) in now.iter().enumerate().filter(|(other, _)| *other != step.object.get()) {
                let later = other == 0 || order[at + 1..].contains(&ObjectIndex::new(other));
                let least = if later { 0.05 } else { 0.0 };
                prop_assert!(placed.gap(disc) > least);
                prop_assert!(placed.gap(disc) >= step.gap);
            }
            prop_assert!(placed.gap_inside(&scene.table().top()) > 0.0);
            prop_assert!(placed.gap_outside(&scene.table().keep_out()[0]) > 0.0);
            prop_assert_eq!(now[step.object.get()].pose(), step.from);
            now[step.object.get()] = placed;
        }
    }
}

#[test]
fn of_equally_far_places_the_first_in_row_order_is_taken() {
    // 12 × 8 pixels, the target in the middle: all four corners are equally far.
    let scene = TestScene::new(3).table(1.5, 1.0).disc("t", 0.75, 0.5, 0.05).disc("a", 0.9, 0.5, 0.05).build("t");
    check(&scene, "a", 0.125, Some((0.0625, 0.0625)));
}

#[test]
fn there_is_no_place_on_a_full_table() {
    // Two discs fill the table but for 1 mm on each side and `gap` between them.
    let pair = |gap: f64| {
        let y = 0.226 + gap;
        TestScene::new(2).table(0.152, y + 0.076).disc("t", 0.076, 0.076, 0.075).disc("a", 0.076, y, 0.075).build("t")
    };
    // The old place, if it is not too near to the target; in whole pixels.
    check(&pair(0.051), "a", 0.001, Some((0.0755, 0.2775)));
    check(&pair(0.048), "a", 0.001, None);
}

#[test]
fn an_object_wider_than_the_table_has_no_place() {
    let scene = TestScene::new(3).table(0.5, 0.5).disc("t", 0.25, 0.25, 0.01).disc("a", 0.5, 0.5, 0.26).build("t");
    check(&scene, "a", 0.01, None);
}

/// Blocks all yaws of an object but for those between 1 and 3 rad at its first place.
struct OnlyAtHome;

impl GraspModel for OnlyAtHome {
    fn shadow(&self, gripper: &Gripper, grasped: Placed<'_>, _: Placed<'_>, _: f64) -> Shadow {
        let at_home = grasped.footprint.at() == Point2::new(0.15, 0.06);
        let period = gripper.period();
        Shadow::Yaws(if at_home { ArcSet::fold(period, &[(-0.1, 1.0), (3.0, 3.1)]) } else { ArcSet::full(period) })
    }

    fn options(&self, _: &Scene, _: ObjectIndex, _: &Budget<'_>) -> Result<Vec<Vec<ObjectIndex>>, Interrupted> {
        unreachable!("nothing is searched")
    }
}

#[test]
fn a_grasp_or_release_that_is_blocked_is_stated_without_slack() {
    // `b` is within reach of both places of `a`.
    let scene = TestScene::new(2)
        .table(0.3, 0.3)
        .disc("t", 0.06, 0.06, 0.02)
        .disc("a", 0.15, 0.06, 0.05)
        .disc("b", 0.245, 0.13, 0.04)
        .build("t");
    let raster = Raster::new(0.01, scene.table()).unwrap();
    let steps = [1, 1].map(ObjectIndex::new);
    let plan = reposition(&scene, scene.target().unwrap(), &steps, &raster, &OnlyAtHome, &Budget::unlimited())
        .unwrap()
        .unwrap();
    let [first, second] = relocations(&plan)[..] else { unreachable!("two steps") };
    assert!((first.grasp.yaw - 2.0).abs() < 1e-9 && (first.grasp.slack - 1.0).abs() < 1e-9, "{first:?}");
    assert_eq!(first.release, Grasp { axis: first.to.at, slack: 0.0, ..first.grasp });
    let unknown = |axis| Grasp { axis, yaw: 0.0, slack: 0.0 };
    assert_eq!((second.grasp, second.release), (unknown(second.from.at), unknown(second.to.at)));
}

#[test]
fn a_budget_that_ends_anywhere_interrupts() {
    let scene = TestScene::new(3).table(1.2, 0.7).disc("t", 0.6, 0.35, 0.05).disc("a", 0.7, 0.35, 0.05).build("t");
    let raster = Raster::new(0.02, scene.table()).unwrap();
    let ends_at = |looks: usize| {
        let clock = Looks::ending_after(looks);
        let target = scene.target().unwrap();
        (reposition(&scene, target, &[ObjectIndex::new(1)], &raster, &SweptFinger, &clock.budget()), clock.seen())
    };
    let (done, looks) = ends_at(usize::MAX);
    assert!(matches!(done, Ok(Some(_))) && looks > 100, "{looks}");
    assert!((0..looks).all(|end| ends_at(end).0 == Err(Interrupted)));
}
