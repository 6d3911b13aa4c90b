//! Reads the shape of an object.

use serde::Deserialize;

use super::reader::{FieldNames, Fields, JsonNode, RequestFaults};
use super::shape::ShapePoint;
use super::strict::{Object, present};
use singulate_planner::scene::ShapeDraft;

/// The fields of a sound shape, read straight from its text. Which of them may be there depends on the kind.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(clippy::option_option, reason = "absent, null or a value")]
pub(super) struct ShapeFields {
    kind: String,
    #[serde(default, deserialize_with = "present")]
    radius: Option<Option<f64>>,
    #[serde(default, deserialize_with = "present")]
    length: Option<Option<f64>>,
    #[serde(default, deserialize_with = "present")]
    width: Option<Option<f64>>,
    #[serde(default, deserialize_with = "present")]
    corner_radius: Option<Option<f64>>,
    #[serde(default, deserialize_with = "present")]
    points: Option<Option<Vec<Object<ShapePoint>>>>,
}

impl ShapeFields {
    /// `None` for an unknown kind, a field that is missing, and one that only another kind has.
    pub(super) fn draft(self) -> Option<ShapeDraft> {
        let Self { kind, radius, length, width, corner_radius, points } = self;
        match (kind.as_str(), radius, length, width, corner_radius, points) {
            ("disc", Some(Some(radius)), None, None, None, None) => Some(ShapeDraft::Disc { radius: Some(radius) }),
            ("capsule", Some(Some(radius)), Some(Some(length)), None, None, None) => {
                Some(ShapeDraft::Capsule { length: Some(length), radius: Some(radius) })
            }
            ("rectangle", None, Some(Some(length)), Some(Some(width)), corner_radius, None) => {
                let (length, width) = (Some(length), Some(width));
                Some(ShapeDraft::Rectangle { length, width, corner_radius: corner_radius.flatten() })
            }
            ("polygon", None, None, None, corner_radius, Some(Some(points))) => {
                let points = points.into_iter().map(|Object(ShapePoint { x, y })| [Some(x), Some(y)]).collect();
                Some(ShapeDraft::Polygon { points, corner_radius: corner_radius.flatten() })
            }
            _ => None,
        }
    }
}

/// A kind of shape: the fields that it has, and how they are read.
struct Kind {
    names: FieldNames,
    read: fn(&Fields<'_>, &mut RequestFaults) -> Option<ShapeDraft>,
}

impl Kind {
    const fn of(
        names: &'static [&'static str],
        read: fn(&Fields<'_>, &mut RequestFaults) -> Option<ShapeDraft>,
    ) -> Self {
        Self { names: FieldNames::of(names), read }
    }
}

static KINDS: [(&str, &Kind); 4] = [
    ("disc", &Kind::of(&["kind", "radius"], disc)),
    ("rectangle", &Kind::of(&["kind", "length", "width", "corner_radius"], rectangle)),
    ("capsule", &Kind::of(&["kind", "length", "radius"], capsule)),
    ("polygon", &Kind::of(&["kind", "points", "corner_radius"], polygon)),
];
/// The fields of all kinds.
const ANY: FieldNames = FieldNames::of(&["kind", "length", "width", "radius", "corner_radius", "points"]);
const POINT: FieldNames = FieldNames::of(&["x", "y"]);

/// Read through a JSON value, with every fault.
pub(super) fn read(node: JsonNode<'_>, faults: &mut RequestFaults) -> Option<ShapeDraft> {
    let known = node.peek("kind").and_then(|word| KINDS.iter().find(|(name, _)| *name == word));
    // Of an unknown kind nobody knows which fields it should have.
    let fields = node.fields(known.map_or(&ANY, |(_, kind)| &kind.names), faults)?;
    let kind = fields.required("kind", faults, |node, faults| node.word(&KINDS, faults));
    (kind?.read)(&fields, faults)
}

fn disc(fields: &Fields<'_>, faults: &mut RequestFaults) -> Option<ShapeDraft> {
    Some(ShapeDraft::Disc { radius: fields.number("radius", faults) })
}

fn capsule(fields: &Fields<'_>, faults: &mut RequestFaults) -> Option<ShapeDraft> {
    let length = fields.number("length", faults);
    Some(ShapeDraft::Capsule { length, radius: fields.number("radius", faults) })
}

fn rectangle(fields: &Fields<'_>, faults: &mut RequestFaults) -> Option<ShapeDraft> {
    let (length, width) = (fields.number("length", faults), fields.number("width", faults));
    let corner_radius = corner_radius(fields, faults)?;
    Some(ShapeDraft::Rectangle { length, width, corner_radius })
}

fn polygon(fields: &Fields<'_>, faults: &mut RequestFaults) -> Option<ShapeDraft> {
    let points = fields.required("points", faults, |node, faults| node.list(faults, point));
    let corner_radius = corner_radius(fields, faults)?;
    Some(ShapeDraft::Polygon { points: points?, corner_radius })
}

/// The outer `None` stands for a fault: then nobody knows how far the shape reaches.
#[expect(clippy::option_option, reason = "a fault, the default, or a value")]
fn corner_radius(fields: &Fields<'_>, faults: &mut RequestFaults) -> Option<Option<f64>> {
    fields.optional("corner_radius", None, faults, |node, faults| node.number(faults).map(Some))
}

fn point(node: JsonNode<'_>, faults: &mut RequestFaults) -> Option<[Option<f64>; 2]> {
    let fields = node.fields(&POINT, faults)?;
    Some([fields.number("x", faults), fields.number("y", faults)])
}
