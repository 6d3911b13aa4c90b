//! The shape of an object as JSON: its schemas, and how it is written.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use singulate_planner::scene::{Kind, Shape};

/// What an object covers of the table, in the object's own frame. The service must know the kind.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
#[serde(untagged)]
#[schema(example = json!({"kind": "rectangle", "length": 0.4, "width": 0.3, "corner_radius": 0.02}))]
pub enum ShapeBody {
    /// A disc.
    Disc(DiscShape),
    /// A capsule.
    Capsule(CapsuleShape),
    /// A rectangle.
    Rectangle(RectangleShape),
    /// A polygon.
    Polygon(PolygonShape),
}

/// A disc round the origin of the object's frame.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct DiscShape {
    /// The kind of shape.
    pub kind: DiscWord,
    /// Radius, m.
    #[schema(minimum = 0.000001, maximum = 1000, example = 0.075)]
    pub radius: f64,
}

/// A bar with round ends, along x of the object's frame, its middle at the origin.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct CapsuleShape {
    /// The kind of shape.
    pub kind: CapsuleWord,
    /// From tip to tip, m; at least two radii.
    #[schema(minimum = 0.000002, maximum = 2000, example = 0.2)]
    pub length: f64,
    /// Half of its width, m.
    #[schema(minimum = 0.000001, maximum = 1000, example = 0.01)]
    pub radius: f64,
}

/// A rectangle with its middle at the origin of the object's frame.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct RectangleShape {
    /// The kind of shape.
    pub kind: RectangleWord,
    /// Along x of the object's frame, m.
    #[schema(minimum = 0.000001, maximum = 1000, example = 0.4)]
    pub length: f64,
    /// Along y of the object's frame, m.
    #[schema(minimum = 0.000001, maximum = 1000, example = 0.3)]
    pub width: f64,
    /// The radius of its corners, inside length and width, m; at most half of the shorter side. Default: 0.
    #[schema(minimum = 0, maximum = 500, example = 0.02)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corner_radius: Option<f64>,
}

/// A convex polygon. One that is not convex, or that crosses itself, is planned as its convex hull.
#[derive(Debug, Clone, PartialEq, Serialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct PolygonShape {
    /// The kind of shape.
    pub kind: PolygonWord,
    /// Its points in the object's frame, in order, either way round; not all on one line.
    #[schema(min_items = 3, max_items = 32,
        example = json!([{"x": -0.05, "y": -0.03}, {"x": 0.05, "y": -0.03}, {"x": 0.05, "y": 0.03}]))]
    pub points: Vec<ShapePoint>,
    /// How far it reaches beyond its points, on all sides, m. Default: 0.
    #[schema(minimum = 0, maximum = 1000, example = 0.0)]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub corner_radius: Option<f64>,
}

/// A point in the object's own frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
#[serde(deny_unknown_fields)]
pub struct ShapePoint {
    /// Along x of the object's frame, m.
    #[schema(minimum = -1000, maximum = 1000, example = 0.05)]
    pub x: f64,
    /// Along y of the object's frame, m.
    #[schema(minimum = -1000, maximum = 1000, example = 0.03)]
    pub y: f64,
}

/// The kind of a disc.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(example = "disc")]
pub enum DiscWord {
    /// A disc.
    Disc,
}

/// The kind of a capsule.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(example = "capsule")]
pub enum CapsuleWord {
    /// A bar with round ends.
    Capsule,
}

/// The kind of a rectangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(example = "rectangle")]
pub enum RectangleWord {
    /// A rectangle.
    Rectangle,
}

/// The kind of a polygon.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, ToSchema)]
#[serde(rename_all = "snake_case")]
#[schema(example = "polygon")]
pub enum PolygonWord {
    /// A polygon.
    Polygon,
}

impl ShapeBody {
    pub(super) fn new(shape: &Shape) -> Self {
        let radius = shape.radius();
        let corner_radius = (radius > 0.0).then_some(radius);
        match shape.kind() {
            Kind::Disc => Self::Disc(DiscShape { kind: DiscWord::Disc, radius }),
            Kind::Capsule { length } => Self::Capsule(CapsuleShape { kind: CapsuleWord::Capsule, length, radius }),
            Kind::Rectangle { length, width } => {
                let kind = RectangleWord::Rectangle;
                Self::Rectangle(RectangleShape { kind, length, width, corner_radius })
            }
            Kind::Polygon => {
                let vertices = shape.core().into_iter().flat_map(|core| core.vertices());
                let points = vertices.map(|v| ShapePoint { x: v.x, y: v.y }).collect();
                Self::Polygon(PolygonShape { kind: PolygonWord::Polygon, points, corner_radius })
            }
        }
    }
}
