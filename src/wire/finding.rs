//! Findings of the scene's checks, as faults with a pointer.

use super::code::ErrorCode;
use super::path::Path;
use super::problem::WarningItem;
use super::reader::RequestFaults;
use singulate_planner::paper::{Cause, Warning};
use singulate_planner::scene::{Finding, Flaw, Place, Scene};

/// A finding as a warning; `scene` is the scene's path in the body.
pub(super) fn item(scene: &Path<'_>, finding: &Finding) -> WarningItem {
    let pointer = at(scene, finding.place, &mut |path| path.to_string());
    WarningItem { code: code(&finding.flaw).to_string(), pointer, detail: finding.flaw.to_string() }
}

/// A warning about an answer. Its scene is the whole body.
pub(super) fn warning(scene: &Scene, warning: &Warning) -> WarningItem {
    let pointer = match warning.cause() {
        Cause::Setting(name) => format!("/settings/{name}"),
        Cause::Request => String::new(),
        Cause::Object(id) => {
            let at = scene.objects().iter().position(|object| object.id() == id);
            at.map_or_else(|| "/objects".to_owned(), |at| format!("/objects/{at}"))
        }
    };
    WarningItem { code: warning.code().to_owned(), pointer, detail: warning.to_string() }
}

/// A finding as a fault.
pub(super) fn note(scene: &Path<'_>, finding: &Finding, faults: &mut RequestFaults) {
    at(scene, finding.place, &mut |path| faults.add(code(&finding.flaw), path, format_args!("{}", finding.flaw)));
}

/// Builds the path of `place`.
fn at<T>(scene: &Path<'_>, place: Place, arrive: &mut dyn FnMut(&Path<'_>) -> T) -> T {
    let objects = scene.field("objects");
    match place {
        Place::Objects => arrive(&objects),
        Place::Object(n, name) => arrive(&objects.item(n).field(name)),
        Place::WholeObject(n) => arrive(&objects.item(n)),
        Place::Shape(n, name) => arrive(&objects.item(n).field("shape").field(name)),
        Place::Point(n, m, name) => arrive(&objects.item(n).field("shape").field("points").item(m).field(name)),
        Place::Grasp(n, m, name) => arrive(&objects.item(n).field("grasps").item(m).field(name)),
        Place::WholeTable => arrive(&scene.field("table")),
        Place::Table(name) => arrive(&scene.field("table").field(name)),
        Place::KeepOut(n, name) => arrive(&scene.field("table").field("keep_out").item(n).field(name)),
        Place::Gripper(name) => arrive(&scene.field("gripper").field(name)),
        Place::Target => arrive(&scene.field("target")),
        Place::Goal(name) => arrive(&scene.field("goal").field(name)),
        Place::GoalMember(name, n) => arrive(&scene.field("goal").field(name).item(n)),
        Place::Destination => arrive(&scene.field("settings").field("destination")),
        Place::DropOffs => arrive(&scene.field("drop_offs")),
        Place::DropOff(n, name) => arrive(&scene.field("drop_offs").item(n).field(name)),
        Place::Accepts(n, m) => arrive(&scene.field("drop_offs").item(n).field("accepts").item(m)),
    }
}

fn code(flaw: &Flaw) -> ErrorCode {
    match flaw {
        Flaw::OutOfRange { .. } | Flaw::AngleOutOfRange { .. } | Flaw::WideTolerance { .. } => ErrorCode::OutOfRange,
        Flaw::NotWhole(_) => ErrorCode::NotWhole,
        Flaw::EmptyRectangle { .. } => ErrorCode::EmptyRectangle,
        Flaw::IdLength { .. } => ErrorCode::IdLength,
        Flaw::DuplicateId { .. } | Flaw::DuplicateDropOff { .. } | Flaw::NamedTwice { .. } => ErrorCode::DuplicateId,
        Flaw::TooManyDropOffs { .. } => ErrorCode::TooManyDropOffs,
        Flaw::NoDropOff | Flaw::NoMaxOpening | Flaw::PalmByHalf(_) => ErrorCode::Missing,
        Flaw::NothingAccepted => ErrorCode::NoDropOff,
        Flaw::UnknownObject(_) => ErrorCode::UnknownObject,
        Flaw::NothingWanted => ErrorCode::EmptyList,
        Flaw::TooWide { .. } | Flaw::NeedsOpening { .. } => ErrorCode::TooWide,
        Flaw::NoGrasp { .. } => ErrorCode::NoGrasp,
        Flaw::AxisBesideObject(_) => ErrorCode::AxisBesideObject,
        Flaw::DefaultGrasps(_) => ErrorCode::DefaultGrasps,
        Flaw::UnknownHeight(_) => ErrorCode::UnknownHeight,
        Flaw::TooManyGrasps { .. } | Flaw::TooMuchClosing => ErrorCode::TooManyGrasps,
        Flaw::TooManyPoints { .. } => ErrorCode::TooManyPoints,
        Flaw::NoArea => ErrorCode::NoArea,
        Flaw::ConvexHull { .. } => ErrorCode::ConvexHull,
        Flaw::NotAccepted(_) => ErrorCode::NotAccepted,
        Flaw::TooManyObjects { .. } => ErrorCode::TooManyObjects,
        Flaw::UnknownTarget(_) => ErrorCode::UnknownTarget,
        Flaw::FixedTarget(_) | Flaw::FixedMember(_) => ErrorCode::FixedTarget,
        Flaw::OffTable { .. } => ErrorCode::OffTable,
        Flaw::Overlap { .. } => ErrorCode::Overlap,
        Flaw::TooManyNeighbours { .. } => ErrorCode::TooManyNeighbours,
        Flaw::FingersOverlap { .. } => ErrorCode::FingersOverlap,
        Flaw::HangsOverTable { .. } => ErrorCode::HangsOverTable,
        Flaw::WideYawTolerance { .. } => ErrorCode::WideYawTolerance,
        Flaw::OutOfProportion { .. } | Flaw::ManyTurns(_) => ErrorCode::OutOfProportion,
    }
}
