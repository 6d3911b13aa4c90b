//! Validation: from a draft to a scene, or to the list of its faults.

use core::f64::consts::TAU;
use std::collections::HashMap;
use std::sync::Arc;

use nalgebra::Point2;

use super::drop_off::drop_offs;
use super::fault::{Finding, Findings, Place};
use super::flaw::Flaw;
use super::grasps::Grasps;
use super::gripper::Palm;
use super::limits::{
    COORDINATE_RANGE, FINGERS_RANGE, LENGTH_RANGE, MARGIN_RANGE, MAX_CLOSING_WORK, MAX_ID_LENGTH, SceneLimits,
    TIP_HEIGHT_RANGE, YAW_RANGE, YAW_TOLERANCE_RANGE,
};
use super::relations::{overhangs, overlaps, reach};
use super::shape_draft::ranged;
use super::slips;
use super::wanted::{attainable, named};
use super::{
    Destination, DropOff, Footprint, FootprintIndex, Gripper, GripperDraft, Object, ObjectDraft, Opening, Parts, Pose,
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
    // Told after the slips, which may explain them.
    let mut assumed = Findings::default();
    let mut reader =
        Objects { table: table.as_ref(), gripper: gripper.as_ref(), faults: &mut faults, warnings: &mut assumed };
    let objects: Vec<Option<Object>> =
        draft.objects.iter().enumerate().map(|(at, object)| reader.object(at, object)).collect();
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
    let index = FootprintIndex::new(objects.iter().map(|object| object.footprint.clone()));
    if let (Some(table), Some(gripper)) = (&table, &gripper) {
        // Slips first, before the warnings that follow from them.
        slips::slips(table.top, gripper, &objects, &mut warnings);
        overhangs(table.top, &objects, &mut warnings);
    }
    warnings.append(assumed);
    overlaps(&objects, &index, limits, &mut faults, &mut warnings);
    if let Some(gripper) = &gripper {
        if objects.iter().map(|object| object.grasps.work()).sum::<usize>() > MAX_CLOSING_WORK {
            faults.add(Place::Objects, Flaw::TooMuchClosing);
            return Err(faults.into_vec());
        }
        objects.iter_mut().for_each(|object| object.find_hindrance(gripper));
        // One sentence for many objects first: the list of warnings ends early.
        assumptions(gripper, &draft.objects, &objects, &mut warnings);
        not_graspable(gripper, &objects, &mut warnings);
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

/// Warns of objects that the hand can't grasp.
fn not_graspable(gripper: &Gripper, objects: &[Object], warnings: &mut Findings) {
    for (at, object) in objects.iter().enumerate() {
        warnings.extend(Place::WholeObject(at), object.flaw(gripper));
    }
}

/// Warns of what is assumed of grasps and heights.
fn assumptions(gripper: &Gripper, drafts: &[ObjectDraft], objects: &[Object], warnings: &mut Findings) {
    let ids = |of: &dyn Fn(&ObjectDraft, &Object) -> bool| -> Vec<String> {
        let those = drafts.iter().zip(objects).filter(|(draft, object)| of(draft, object));
        those.map(|(_, object)| object.id.clone()).collect()
    };
    let by_default = ids(&|draft, object| {
        draft.grasps.is_none() && object.can_be_grasped() && matches!(object.grasps, Grasps::Listed(_))
    });
    if !by_default.is_empty() {
        warnings.add(Place::Objects, Flaw::DefaultGrasps(by_default));
    }
    let unknown = if gripper.palm.is_some() { ids(&|_, object| object.height.is_none()) } else { Vec::new() };
    if !unknown.is_empty() {
        warnings.add(Place::Objects, Flaw::UnknownHeight(unknown));
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
    let palm = palm(draft, faults);
    let tip_height = ranged(draft.tip_height.or(Some(0.0)), TIP_HEIGHT_RANGE, Place::Gripper("tip_height"), faults);
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
        palm: palm?,
        tip_height: tip_height?,
    })
}

/// The outer `None` stands for a fault.
#[expect(clippy::option_option, reason = "a fault, no palm, or a palm")]
fn palm(draft: &GripperDraft, faults: &mut Findings) -> Option<Option<Palm>> {
    let mut field = |value: Option<f64>, other: Option<f64>, name| match (value, other) {
        (None, Some(_)) => {
            faults.add(Place::Gripper(name), Flaw::PalmByHalf(name));
            None
        }
        _ => ranged(value, LENGTH_RANGE, Place::Gripper(name), faults),
    };
    let finger_length = field(draft.finger_length, draft.palm_radius, "finger_length");
    let radius = field(draft.palm_radius, draft.finger_length, "palm_radius");
    if draft.finger_length.is_none() && draft.palm_radius.is_none() {
        return Some(None);
    }
    Some(Some(Palm { finger_length: finger_length?, radius: radius? }))
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

/// Reads objects.
struct Objects<'a> {
    table: Option<&'a Table>,
    gripper: Option<&'a Gripper>,
    faults: &'a mut Findings,
    warnings: &'a mut Findings,
}

impl Objects<'_> {
    fn object(&mut self, at: usize, draft: &ObjectDraft) -> Option<Object> {
        let mut field = |value, range, name| ranged(value, range, Place::Object(at, name), self.faults);
        let x = field(draft.x, COORDINATE_RANGE, "x");
        let y = field(draft.y, COORDINATE_RANGE, "y");
        let yaw = field(draft.yaw.or(Some(0.0)), YAW_RANGE, "yaw");
        let height = match draft.height {
            Some(height) => field(Some(height), LENGTH_RANGE, "height").map(Some),
            None => Some(None),
        };
        let shape = draft.shape.checked(at, self.faults, self.warnings);
        let grasps = self.gripper.zip(shape.as_ref()).and_then(|(gripper, shape)| {
            let (id, findings) = (draft.id.as_deref().unwrap_or_default(), (&mut *self.faults, &mut *self.warnings));
            Grasps::new((at, id), (&draft.shape, shape), draft.grasps.as_deref(), gripper, findings)
        });
        let centre = Point2::new(x?, y?);
        if let Some(top) = self.table.map(|table| table.top).filter(|top| !top.contains(centre)) {
            let likely = slips::off_table(top, centre);
            self.faults.add(Place::WholeObject(at), Flaw::OffTable { x: centre.x, y: centre.y, top, likely });
        }
        if let Some(yaw) = yaw.filter(|yaw| yaw.abs() > TAU) {
            self.warnings.add(Place::Object(at, "yaw"), Flaw::ManyTurns(yaw));
        }
        // Without a gripper there is no scene, and how it grasps does not matter.
        let grasps = if self.gripper.is_some() { grasps? } else { Grasps::EveryYaw };
        Some(Object {
            id: draft.id.clone()?,
            footprint: Footprint::new(shape?, Pose { at: centre, yaw: yaw? }),
            height: height?,
            grasps,
            grasps_stated: draft.grasps.is_some(),
            hindrance: None,
            fixed: draft.fixed,
            accepted: false,
        })
    }
}
