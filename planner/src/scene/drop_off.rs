//! Drop-offs: places off the table to which objects are taken away.

use std::collections::HashMap;

use super::fault::{Findings, Place};
use super::flaw::Flaw;
use super::limits::{CAPACITY_RANGE, MAX_DROP_OFFS, MAX_ID_LENGTH};
use super::object::ObjectIndex;

/// A place off the table.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DropOff {
    pub(super) id: String,
    pub(super) capacity: Option<u64>,
    /// Sorted.
    pub(super) accepts: Option<Vec<ObjectIndex>>,
}

/// Where objects go that have to move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Destination {
    /// To another place on the table. The default of a scene without drop-offs.
    Table,
    /// To a drop-off.
    DropOff,
    /// To another place on the table; to a drop-off only what finds none. The default of a scene with drop-offs.
    TableThenDropOff,
}

/// An unchecked drop-off.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct DropOffDraft {
    /// The caller's name for it.
    pub id: Option<String>,
    /// How many objects it takes.
    pub capacity: Option<f64>,
    /// The ids of the objects that it takes; `None` for all. An id that could not be read is `None`.
    pub accepts: Option<Vec<Option<String>>>,
}

impl DropOff {
    /// The caller's name for it, unique among the drop-offs.
    pub fn id(&self) -> &str {
        &self.id
    }

    /// How many objects it takes; `None` if any number.
    pub fn capacity(&self) -> Option<u64> {
        self.capacity
    }

    /// The only objects that it takes, in index order; `None` if it takes any.
    pub fn accepts(&self) -> Option<&[ObjectIndex]> {
        self.accepts.as_deref()
    }
}

/// The drop-offs of a draft; `None` if one has a fault. `ids` are the objects of the scene.
pub(super) fn drop_offs(
    drafts: &[DropOffDraft],
    ids: &HashMap<&str, usize>,
    faults: &mut Findings,
    warnings: &mut Findings,
) -> Option<Vec<DropOff>> {
    if drafts.len() > MAX_DROP_OFFS {
        faults.add(Place::DropOffs, Flaw::TooManyDropOffs { count: drafts.len(), max: MAX_DROP_OFFS });
        return None;
    }
    let mut earlier = HashMap::new();
    let checked: Vec<Option<DropOff>> = drafts
        .iter()
        .enumerate()
        .map(|(at, draft)| {
            let id = draft.id.as_deref().and_then(|id| unique(at, id, &mut earlier, faults));
            let capacity = capacity(at, draft.capacity, faults);
            let accepts = draft.accepts.as_ref().map(|accepted| accepts(at, accepted, ids, warnings));
            Some(DropOff { id: id?.to_owned(), capacity: capacity?, accepts })
        })
        .collect();
    checked.into_iter().collect()
}

fn unique<'a>(at: usize, id: &'a str, earlier: &mut HashMap<&'a str, usize>, faults: &mut Findings) -> Option<&'a str> {
    let (place, length) = (Place::DropOff(at, "id"), id.chars().count());
    if length == 0 || length > MAX_ID_LENGTH {
        faults.add(place, Flaw::IdLength { length, max: MAX_ID_LENGTH });
        return None;
    }
    if let Some(&first) = earlier.get(id) {
        faults.add(place, Flaw::DuplicateDropOff { id: id.to_owned(), first });
        return None;
    }
    earlier.insert(id, at);
    Some(id)
}

/// The outer `None` stands for a fault.
#[expect(clippy::option_option, reason = "a fault, no limit, or a limit")]
fn capacity(at: usize, value: Option<f64>, faults: &mut Findings) -> Option<Option<u64>> {
    let Some(value) = value else { return Some(None) };
    let (place, (min, max)) = (Place::DropOff(at, "capacity"), CAPACITY_RANGE);
    if !(min..=max).contains(&value) {
        faults.add(place, Flaw::OutOfRange { value, min, max });
        return None;
    }
    if value.fract() != 0.0 {
        faults.add(place, Flaw::NotWhole(value));
        return None;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 1e9")]
    let capacity = value as u64;
    Some(Some(capacity))
}

/// An id of no object is only warned of: a caller may name what was taken away before.
fn accepts(
    at: usize,
    accepted: &[Option<String>],
    ids: &HashMap<&str, usize>,
    warnings: &mut Findings,
) -> Vec<ObjectIndex> {
    let mut objects = Vec::with_capacity(accepted.len());
    for (item, id) in accepted.iter().enumerate().filter_map(|(item, id)| Some((item, id.as_deref()?))) {
        match ids.get(id) {
            Some(&object) => objects.push(ObjectIndex::new(object)),
            None => warnings.add(Place::Accepts(at, item), Flaw::unknown_id(id, Flaw::UnknownObject)),
        }
    }
    objects.sort_unstable();
    objects.dedup();
    objects
}
