//! What the scene's own checks found, as faults with a pointer.

use super::problem::ErrorItem;
use super::reader::{Faults, Path};
use crate::plan::{Cause, Warning};
use crate::scene::{Finding, Flaw, Place, Scene};

/// The code of a list of objects that is too long.
pub(super) const TOO_MANY_OBJECTS: &str = "too_many_objects";

/// A finding as a warning; `scene` is where the scene stands in the body.
pub(super) fn item(scene: &Path<'_>, finding: &Finding) -> ErrorItem {
    let pointer = at(scene, finding.place, &mut |path| path.to_string());
    ErrorItem { code: code(&finding.flaw), pointer, detail: finding.flaw.to_string() }
}

/// A warning about an answer. Its scene is the whole request.
pub(super) fn warning(scene: &Scene, warning: &Warning) -> ErrorItem {
    let pointer = match warning.cause() {
        Cause::Setting(name) => format!("/settings/{name}"),
        Cause::Request => String::new(),
        Cause::Object(id) => {
            let at = scene.objects().iter().position(|object| object.id() == id);
            at.map_or_else(|| "/objects".to_owned(), |at| format!("/objects/{at}"))
        }
    };
    ErrorItem { code: warning.code(), pointer, detail: warning.to_string() }
}

/// A finding as a fault.
pub(super) fn note(scene: &Path<'_>, finding: &Finding, faults: &mut Faults) {
    at(scene, finding.place, &mut |path| faults.add(code(&finding.flaw), path, format_args!("{}", finding.flaw)));
}

/// Walk to `place`.
fn at<T>(scene: &Path<'_>, place: Place, arrive: &mut dyn FnMut(&Path<'_>) -> T) -> T {
    let objects = scene.field("objects");
    match place {
        Place::Objects => arrive(&objects),
        Place::Object(n, name) => arrive(&objects.item(n).field(name)),
        Place::WholeObject(n) => arrive(&objects.item(n)),
        Place::Table(name) => arrive(&scene.field("table").field(name)),
        Place::KeepOut(n, name) => arrive(&scene.field("table").field("keep_out").item(n).field(name)),
        Place::Gripper(name) => arrive(&scene.field("gripper").field(name)),
        Place::Target => arrive(&scene.field("target")),
    }
}

fn code(flaw: &Flaw) -> &'static str {
    match flaw {
        Flaw::OutOfRange { .. } => "out_of_range",
        Flaw::NotWhole(_) => "not_whole",
        Flaw::EmptyRectangle { .. } => "empty_rectangle",
        Flaw::IdLength { .. } => "id_length",
        Flaw::DuplicateId { .. } => "duplicate_id",
        Flaw::TooManyObjects { .. } => TOO_MANY_OBJECTS,
        Flaw::UnknownTarget(_) => "unknown_target",
        Flaw::FixedTarget(_) => "fixed_target",
        Flaw::OffTable { .. } => "off_table",
        Flaw::Overlap { .. } => "overlap",
        Flaw::TooManyNeighbours { .. } => "too_many_neighbours",
        Flaw::FingersOverlap { .. } => "fingers_overlap",
    }
}
