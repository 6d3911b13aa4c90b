//! Why an object stays where it is.

use std::collections::{HashMap, HashSet};

use super::fill::fills;
use singulate_planner::scene::{ObjectIndex, Scene};
use singulate_planner::statement::Statement;

/// Why an object is not taken away.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stays {
    /// The caller calls it fixed.
    Fixed,
    /// It is wider than the greatest opening of the hand.
    TooWide,
    /// It has no grasp that the hand can do, whatever its width.
    NoGrasp,
    /// No drop-off accepts it, and nothing is put aside on the table.
    NotAccepted,
    /// It is in the lock.
    Locked,
    /// The drop-offs that accept it are full.
    NoRoom,
    /// Others that stay are in its way, or time was short.
    NotReached,
}

impl Stays {
    /// All of them, in the order in which they are told.
    const ALL: [Self; 7] =
        [Self::Fixed, Self::Locked, Self::NoRoom, Self::NotAccepted, Self::TooWide, Self::NoGrasp, Self::NotReached];

    /// The reason as a phrase that goes with one object and with several.
    pub fn words(self) -> &'static str {
        match self {
            Self::Fixed => "fixed",
            Self::TooWide => "too wide for the hand",
            Self::NoGrasp => "without a grasp",
            Self::NotAccepted => "accepted by no drop-off",
            Self::Locked => "locked",
            Self::NoRoom => "no room in a drop-off",
            Self::NotReached => "not reached",
        }
    }
}

/// Why no plan for the scene's goal moves the object; `None` if one may, and for what is grasped in the end.
pub fn immovable(scene: &Scene, index: ObjectIndex) -> Option<Stays> {
    let object = scene.object(index);
    match () {
        () if object.fixed() => Some(Stays::Fixed),
        () if object.lacks_grasp() => Some(Stays::NoGrasp),
        () if !object.can_be_grasped() => Some(Stays::TooWide),
        () if !scene.movable(index) && !scene.goal().is_candidate(index) => Some(Stays::NotAccepted),
        () => None,
    }
}

/// What a clearing leaves, by reason in the order of [`Stays::ALL`]; nothing for another goal.
pub fn left(scene: &Scene, stated: &Statement) -> Vec<(Stays, Vec<ObjectIndex>)> {
    let Some(left) = stated.left.as_deref().filter(|left| !left.is_empty()) else { return Vec::new() };
    let by_id: HashMap<&str, ObjectIndex> = scene.indices().map(|object| (scene.object(object).id(), object)).collect();
    let locked: HashSet<&str> = stated.stuck.iter().flat_map(|lock| &lock.blocked).map(String::as_str).collect();
    let room = room(scene, stated);
    let objects = left.iter().filter_map(|id| by_id.get(id.as_str()).copied());
    let reason = |object: ObjectIndex| match immovable(scene, object) {
        Some(reason) => reason,
        None if locked.contains(scene.object(object).id()) => Stays::Locked,
        None if room[object.get()] => Stays::NotReached,
        None => Stays::NoRoom,
    };
    let reasons: Vec<(Stays, ObjectIndex)> = objects.map(|object| (reason(object), object)).collect();
    let of = |wanted| reasons.iter().filter(move |(why, _)| *why == wanted).map(|(_, object)| *object).collect();
    let groups = Stays::ALL.into_iter().map(|why| (why, of(why)));
    groups.filter(|(_, objects): &(_, Vec<_>)| !objects.is_empty()).collect()
}

/// Per object whether a drop-off that accepts it takes one more after all steps.
fn room(scene: &Scene, stated: &Statement) -> Vec<bool> {
    let open = || {
        let fills = scene.drop_offs().iter().zip(fills(scene, stated));
        fills.filter(|(_, fill)| !fill.full()).map(|(drop_off, _)| drop_off)
    };
    let mut room = vec![open().any(|drop_off| drop_off.accepts().is_none()); scene.objects().len()];
    open().filter_map(|drop_off| drop_off.accepts()).flatten().for_each(|object| room[object.get()] = true);
    room
}
