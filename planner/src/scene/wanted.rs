//! Checks of what is wanted: that it is there, can be grasped, and can be taken away.

use std::collections::HashMap;

use super::draft::ObjectDraft;
use super::drop_off::DropOff;
use super::fault::{Findings, Place};
use super::flaw::Flaw;
use super::goal::{Goal, GoalDraft};
use super::gripper::Gripper;
use super::object::{Object, ObjectIndex};

/// The goal of a draft, as far as its ids name objects that are not fixed; `None` if one does not, or if an object or an id of
/// the draft could not be read.
pub(super) fn named(
    draft: &GoalDraft,
    ids: &HashMap<&str, usize>,
    objects: &[ObjectDraft],
    faults: &mut Findings,
) -> Option<Goal> {
    let all_read = objects.iter().all(|object| object.id.is_some());
    let find = |id: &str, place, fixed: fn(String) -> Flaw, faults: &mut Findings| match ids.get(id) {
        Some(&at) if objects[at].fixed => {
            faults.add(place, fixed(id.to_owned()));
            None
        }
        Some(&at) => Some(ObjectIndex::new(at)),
        None => {
            // It may be an object whose id could not be read.
            if all_read {
                faults.add(place, Flaw::unknown_id(id, Flaw::UnknownTarget));
            }
            None
        }
    };
    match draft {
        GoalDraft::Target(id) => find(id, Place::Target, Flaw::FixedTarget, faults).map(Goal::Target),
        GoalDraft::Clear => Some(Goal::Clear),
        GoalDraft::AnyOf(list) | GoalDraft::AllOf(list) => {
            let (field, to_goal): (_, fn(Vec<ObjectIndex>) -> Goal) = match draft {
                GoalDraft::AllOf(_) => ("all_of", Goal::AllOf),
                _ => ("any_of", Goal::AnyOf),
            };
            if list.is_empty() {
                faults.add(Place::Goal(field), Flaw::NothingWanted);
                return None;
            }
            let (mut found, mut first) = (Vec::with_capacity(list.len()), HashMap::new());
            for (at, id) in list.iter().enumerate() {
                let (id, place) = (id.as_deref()?, Place::GoalMember(field, at));
                let object = find(id, place, Flaw::FixedMember, faults);
                if let Some(&earlier) = object.as_ref().and_then(|object| first.get(object)) {
                    faults.add(place, Flaw::NamedTwice { id: id.to_owned(), first: earlier });
                }
                if faults.full() {
                    return None;
                }
                object.into_iter().for_each(|object| {
                    first.entry(object).or_insert(at);
                });
                found.push(object);
            }
            found.into_iter().collect::<Option<_>>().map(to_goal)
        }
    }
}

/// The goal without members of which one suffices and that are not graspable. Reports what can't be grasped, or not taken away.
pub(super) fn attainable(
    goal: Goal,
    objects: &[Object],
    gripper: &Gripper,
    drop_offs: &[DropOff],
    faults: &mut Findings,
) -> Goal {
    let flaw = |object: ObjectIndex| objects[object.get()].flaw(gripper);
    match goal {
        Goal::Target(target) => {
            faults.extend(Place::Target, flaw(target));
            goal
        }
        Goal::AnyOf(members) => {
            let mut fitting: Vec<_> = members.iter().copied().filter(|&member| flaw(member).is_none()).collect();
            if fitting.is_empty() {
                faults.extend(Place::Goal("any_of"), flaw(members[0]));
            }
            fitting.sort_unstable();
            Goal::AnyOf(fitting)
        }
        Goal::AllOf(mut members) => {
            if drop_offs.is_empty() {
                faults.add(Place::DropOffs, Flaw::NoDropOff);
            }
            for (at, &member) in members.iter().enumerate() {
                let (place, object) = (Place::GoalMember("all_of", at), &objects[member.get()]);
                faults.extend(place, flaw(member));
                if !drop_offs.is_empty() && !object.accepted {
                    faults.add(place, Flaw::NotAccepted(object.id.clone()));
                }
            }
            members.sort_unstable();
            Goal::AllOf(members)
        }
        Goal::Clear => {
            if drop_offs.is_empty() {
                faults.add(Place::DropOffs, Flaw::NoDropOff);
            }
            goal
        }
    }
}
