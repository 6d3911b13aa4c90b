//! Validation: from a draft to a scene, or to the list of its faults.

use std::collections::HashMap;
use std::sync::Arc;

use nalgebra::Point2;

use super::drop_off::drop_offs;
use super::fault::{Finding, Findings, Place};
use super::flaw::Flaw;
use super::limits::{
    COORDINATE_RANGE, FINGERS_RANGE, LENGTH_RANGE, MARGIN_RANGE, MAX_ID_LENGTH, SceneLimits, YAW_TOLERANCE_RANGE,
};
use super::relations::{overhangs, overlaps, reach};
use super::slips;
use super::wanted::{attainable, named};
use super::{
    Destination, DropOff, Footprint, FootprintIndex, Gripper, GripperDraft, Object, ObjectDraft, Opening, Parts,
    Rectangle, RectangleDraft, Scene, SceneDraft, Table, TableDraft,
};

pub(super) fn validate(draft: SceneDraft, limits: &SceneLimits) -> Result<(Scene, Vec<Finding>), Vec<Finding>> {
    let mut faults = Findings::default();
    let mut warnings = Findings::default();
    if draft.objects.len() > limits.max_objects {
        let flaw = Flaw::TooManyObjects { count: draft.objects.len(), max: limits.max_objects };
        return Err(vec![Finding { place: Place::Objects, flaw }]);
    }
    let table = table(&draft.table, &mut faults);
    let gripper = gripper(&draft.gripper, &mut faults);
    let ids = unique_ids(&draft.objects, &mut faults);
    let objects: Vec<Option<Object>> = draft
        .objects
        .iter()
        .enumerate()
        .map(|(at, object)| self::object(at, object, table.as_ref(), &mut faults))
        .collect();
    let stated = draft.drop_offs.as_deref().unwrap_or_default();
    let mut unknown = Findings::default();
    let drop_offs = drop_offs(stated, &ids, &mut faults, &mut unknown);
    let goal = draft.goal.as_ref().and_then(|goal| named(goal, &ids, &draft.objects, &mut faults));
    let default = if stated.is_empty() { Destination::Table } else { Destination::TableThenDropOff };
    let destination = draft.destination.unwrap_or(default);
    if destination == Destination::DropOff && stated.is_empty() {
        warnings.add(Place::Destination, Flaw::NothingAccepted);
    }
    // Positions must keep their meaning in the index, so relations are judged only where every object is readable.
    let Some(mut objects) = objects.into_iter().collect::<Option<Vec<Object>>>() else { return Err(faults.into_vec()) };
    let index = FootprintIndex::new(objects.iter().map(Object::footprint));
    if let (Some(table), Some(gripper)) = (&table, &gripper) {
        // Slips first, before the warnings that follow from them.
        slips::slips(table.top, gripper, &objects, &mut warnings);
        overhangs(table.top, &objects, &mut warnings);
    }
    overlaps(&objects, &index, limits, &mut faults, &mut warnings);
    if let Some(gripper) = &gripper {
        too_wide(gripper, &mut objects, &mut warnings);
        reach(gripper, &objects, &index, limits, &mut faults, &mut warnings);
    }
    let (Some(table), Some(gripper), Some(drop_offs), Some(goal)) = (table, gripper, drop_offs, goal) else {
        return Err(faults.into_vec());
    };
    accept(&drop_offs, &mut objects);
    let goal = attainable(goal, &objects, &gripper, &drop_offs, &mut faults);
    let faults = faults.into_vec();
    if !faults.is_empty() {
        return Err(faults);
    }
    warnings.append(unknown);
    let parts = Parts { table, gripper, objects, index, drop_offs, destination };
    Ok((Scene { parts: Arc::new(parts), goal: Arc::new(goal) }, warnings.into_vec()))
}

/// Marks and warns of objects that no hand spans.
fn too_wide(gripper: &Gripper, objects: &mut [Object], warnings: &mut Findings) {
    for (at, object) in objects.iter_mut().enumerate() {
        if let Some(flaw) = object.wider_than(gripper) {
            object.too_wide = true;
            warnings.add(Place::WholeObject(at), flaw);
        }
    }
}

/// Marks the objects that some drop-off accepts.
fn accept(drop_offs: &[DropOff], objects: &mut [Object]) {
    let any = drop_offs.iter().any(|drop_off| drop_off.accepts.is_none());
    objects.iter_mut().for_each(|object| object.accepted = any);
    for accepted in drop_offs.iter().filter_map(DropOff::accepts).flatten() {
        objects[accepted.get()].accepted = true;
    }
}

/// The value, if it is present and in its range.
fn ranged(value: Option<f64>, (min, max): (f64, f64), place: Place, faults: &mut Findings) -> Option<f64> {
    let value = value?;
    if (min..=max).contains(&value) {
        return Some(value);
    }
    faults.add(place, Flaw::OutOfRange { value, min, max });
    None
}

fn rectangle(
    draft: &RectangleDraft,
    place: impl Fn(&'static str) -> Place,
    faults: &mut Findings,
) -> Option<Rectangle> {
    let mut side = |value, name| ranged(value, COORDINATE_RANGE, place(name), faults);
    let (x_min, x_max) = (side(draft.x_min, "x_min"), side(draft.x_max, "x_max"));
    let (y_min, y_max) = (side(draft.y_min, "y_min"), side(draft.y_max, "y_max"));
    let mut ordered = |min: Option<f64>, max: Option<f64>, name| {
        let (min, max) = (min?, max?);
        if min < max {
            return Some((min, max));
        }
        faults.add(place(name), Flaw::EmptyRectangle { min, max });
        None
    };
    let (x, y) = (ordered(x_min, x_max, "x_max"), ordered(y_min, y_max, "y_max"));
    let ((x_min, x_max), (y_min, y_max)) = (x?, y?);
    Some(Rectangle { min: Point2::new(x_min, y_min), max: Point2::new(x_max, y_max) })
}

fn table(draft: &TableDraft, faults: &mut Findings) -> Option<Table> {
    let top = rectangle(&draft.top, Place::Table, faults);
    let keep_out: Vec<Option<Rectangle>> = draft
        .keep_out
        .iter()
        .enumerate()
        .map(|(at, draft)| rectangle(draft, |name| Place::KeepOut(at, name), faults))
        .collect();
    Some(Table { top: top?, keep_out: keep_out.into_iter().collect::<Option<_>>()? })
}

fn gripper(draft: &GripperDraft, faults: &mut Findings) -> Option<Gripper> {
    let mut field = |value, range, name| ranged(value, range, Place::Gripper(name), faults);
    let fingers = field(draft.fingers, FINGERS_RANGE, "fingers");
    let finger_width = field(draft.finger_width, LENGTH_RANGE, "finger_width");
    let clearance = field(draft.clearance, LENGTH_RANGE, "clearance");
    let margin = field(draft.margin, MARGIN_RANGE, "margin");
    let max_opening = draft.max_opening.map(|value| field(Some(value), LENGTH_RANGE, "max_opening"));
    let yaw_tolerance = yaw_tolerance(draft.yaw_tolerance, faults);
    let opening = draft.opening.unwrap_or_default();
    if opening == Opening::Full && max_opening.is_none() {
        faults.add(Place::Gripper("max_opening"), Flaw::NoMaxOpening);
        return None;
    }
    let fingers = fingers.and_then(|value| {
        if value.fract() == 0.0 {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "2 to 12")]
            return Some(value as u32);
        }
        faults.add(Place::Gripper("fingers"), Flaw::NotWhole(value));
        None
    });
    Some(Gripper {
        fingers: fingers?,
        finger_width: finger_width?,
        clearance: clearance?,
        margin: margin?,
        yaw_tolerance: yaw_tolerance?,
        max_opening: match max_opening {
            Some(checked) => Some(checked?),
            None => None,
        },
        opening,
    })
}

fn yaw_tolerance(value: Option<f64>, faults: &mut Findings) -> Option<f64> {
    let (place, max) = (Place::Gripper("yaw_tolerance"), YAW_TOLERANCE_RANGE.1);
    if let Some(value) = value.filter(|value| *value > max) {
        faults.add(place, Flaw::AngleOutOfRange { value, max });
        return None;
    }
    ranged(value, YAW_TOLERANCE_RANGE, place, faults)
}

/// The first position of every id that could be read.
fn unique_ids<'a>(objects: &'a [ObjectDraft], faults: &mut Findings) -> HashMap<&'a str, usize> {
    let mut ids = HashMap::with_capacity(objects.len());
    for (at, id) in objects.iter().enumerate().filter_map(|(at, object)| Some((at, object.id.as_deref()?))) {
        let length = id.chars().count();
        if length == 0 || length > MAX_ID_LENGTH {
            faults.add(Place::Object(at, "id"), Flaw::IdLength { length, max: MAX_ID_LENGTH });
        } else if let Some(&first) = ids.get(id) {
            faults.add(Place::Object(at, "id"), Flaw::DuplicateId { id: id.to_owned(), first });
        } else {
            ids.insert(id, at);
        }
    }
    ids
}

fn object(at: usize, draft: &ObjectDraft, table: Option<&Table>, faults: &mut Findings) -> Option<Object> {
    let mut field = |value, range, name| ranged(value, range, Place::Object(at, name), faults);
    let x = field(draft.x, COORDINATE_RANGE, "x");
    let y = field(draft.y, COORDINATE_RANGE, "y");
    let shape = draft.shape.checked(&mut field);
    let centre = Point2::new(x?, y?);
    if let Some(top) = table.map(|table| table.top).filter(|top| !top.contains(centre)) {
        let likely = slips::off_table(top, centre);
        faults.add(Place::WholeObject(at), Flaw::OffTable { x: centre.x, y: centre.y, top, likely });
    }
    Some(Object {
        id: draft.id.clone()?,
        footprint: Footprint { shape: shape?, pose: centre.into() },
        fixed: draft.fixed,
        too_wide: false,
        accepted: false,
    })
}
