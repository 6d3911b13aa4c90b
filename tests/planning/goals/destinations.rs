//! Where objects go that have to move.

use singulate_planner::budget::Budget;
use singulate_planner::plan::{Settings, plan};
use singulate_planner::scene::{Destination, Scene};
use singulate_planner::search::SILENT;
use singulate_planner::statement::{Statement, Step, Verdict};

use crate::check::scenes::Builder;

/// Four plates round a cup, of which two on opposite sides must go, and one place on the table for a plate.
fn crossed() -> Builder {
    Builder::new(2)
        .disc("cup", 1.0, 1.0, 0.03)
        .disc("east", 1.135, 1.0, 0.09)
        .disc("north", 1.0, 1.135, 0.09)
        .disc("west", 0.865, 1.0, 0.09)
        .disc("south", 1.0, 0.865, 0.09)
        .keep_out([0.0, 0.2, 2.0, 2.0])
        .keep_out([0.2, 0.0, 2.0, 0.2])
}

fn planned(scene: &Scene) -> Statement {
    plan(scene, &Settings::default(), &Budget::unlimited(), SILENT).unwrap().statement
}

/// How many objects are put aside, and how many taken away; `None` without a plan.
fn ways(scene: &Scene) -> Option<(usize, usize)> {
    let stated = planned(scene);
    let drops = stated.steps().iter().filter(|step| matches!(step, Step::PickDrop(_))).count();
    match stated.verdict.unwrap() {
        Verdict::Relocate => Some((stated.steps().len() - drops, drops)),
        Verdict::NoSpace => None,
        verdict => panic!("{verdict:?}"),
    }
}

#[test]
fn only_what_finds_no_place_on_the_table_leaves_it() {
    let tray = |capacity| crossed().drop_off("tray", capacity, None);
    assert_eq!(ways(&crossed().build("cup")), None);
    assert_eq!(ways(&tray(None).build("cup")), Some((1, 1)));
    assert_eq!(ways(&tray(Some(1)).build("cup")), Some((1, 1)));
    assert_eq!(ways(&tray(None).destination(Destination::Table).build("cup")), None);
}

#[test]
fn everything_leaves_the_table_where_only_drop_offs_are_named() {
    let tray = |capacity| crossed().drop_off("tray", capacity, None).destination(Destination::DropOff).build("cup");
    assert_eq!(ways(&tray(None)), Some((0, 2)));
    assert_eq!(ways(&tray(Some(2))), Some((0, 2)));
    assert_eq!(ways(&tray(Some(1))), None);
}

/// A plate that no drop-off accepts stays, and so the plates at right angles to it go.
#[test]
fn what_no_drop_off_accepts_is_as_if_fixed() {
    let drops = |accepts: &[&str]| crossed().drop_off("tray", None, Some(accepts)).destination(Destination::DropOff);
    let stated = planned(&drops(&["north", "south", "east"]).build("cup"));
    let mut moved: Vec<&str> = stated.steps().iter().map(Step::object).collect();
    moved.sort_unstable();
    assert_eq!((moved, stated.optimal), (vec!["north", "south"], Some(true)));
    assert_eq!(planned(&drops(&["north", "east"]).build("cup")).verdict, Some(Verdict::Deadlock));
}

#[test]
fn where_capacity_is_short_another_set_of_the_same_size_goes() {
    let scene = crossed().drop_off("tray", Some(1), None).drop_off("box", Some(1), Some(&["east"]));
    let stated = planned(&scene.destination(Destination::DropOff).build("cup"));
    let mut moved: Vec<&str> = stated.steps().iter().map(Step::object).collect();
    moved.sort_unstable();
    assert_eq!((moved, stated.optimal), (vec!["east", "west"], Some(true)));
}
