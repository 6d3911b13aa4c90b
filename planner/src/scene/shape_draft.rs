//! The draft of a shape, and its check.

use nalgebra::Vector2;

use super::convex::{Core, shoelace};
use super::fault::{Findings, Place};
use super::flaw::Flaw;
use super::limits::{LENGTH_RANGE, MAX_POINTS, POINT_RANGE};
use super::shape::{Kind, Shape};

/// An unchecked shape. A `None` within means that the part was absent or unreadable.
#[derive(Debug, Clone, Default, PartialEq)]
pub enum ShapeDraft {
    /// Absent or unreadable.
    #[default]
    Unread,
    /// The short form of a disc: its radius as a field of the object, m.
    Radius(Option<f64>),
    /// A disc round the origin.
    Disc {
        /// m.
        radius: Option<f64>,
    },
    /// A segment along x, grown.
    Capsule {
        /// From tip to tip, m.
        length: Option<f64>,
        /// m.
        radius: Option<f64>,
    },
    /// A rectangle round the origin.
    Rectangle {
        /// Along x, m.
        length: Option<f64>,
        /// Along y, m.
        width: Option<f64>,
        /// Of the corners, inside length and width, m. Default: 0.
        corner_radius: Option<f64>,
    },
    /// The convex hull of some points, grown.
    Polygon {
        /// m.
        points: Vec<[Option<f64>; 2]>,
        /// By how much the hull is grown, m. Default: 0.
        corner_radius: Option<f64>,
    },
}

impl ShapeDraft {
    /// A disc.
    pub fn disc(radius: f64) -> Self {
        Self::Radius(Some(radius))
    }

    /// The radius of a disc in either form, m.
    pub fn disc_radius(&self) -> Option<f64> {
        match self {
            Self::Radius(radius) | Self::Disc { radius } => *radius,
            _ => None,
        }
    }

    /// The shape, if it is sound.
    pub fn shape(&self) -> Option<Shape> {
        self.checked(0, &mut Findings::default(), &mut Findings::default())
    }

    /// True for either form of a disc.
    pub(super) fn is_disc(&self) -> bool {
        matches!(self, Self::Radius(_) | Self::Disc { .. })
    }

    /// The shape of the object at a position, if it is sound. Warns of a hull that is larger than its polygon.
    pub(super) fn checked(&self, at: usize, faults: &mut Findings, warnings: &mut Findings) -> Option<Shape> {
        let mut check = |value: Option<f64>, range, name| ranged(value, range, Place::Shape(at, name), faults);
        match self {
            Self::Unread => None,
            Self::Radius(radius) => ranged(*radius, LENGTH_RANGE, Place::Object(at, "radius"), faults).map(Shape::disc),
            Self::Disc { radius } => check(*radius, LENGTH_RANGE, "radius").map(Shape::disc),
            Self::Capsule { length, radius } => {
                let radius = check(*radius, LENGTH_RANGE, "radius");
                let length = check(*length, (2.0 * radius.unwrap_or(0.0), 2.0 * LENGTH_RANGE.1), "length");
                let (length, radius) = (length?, radius?);
                let shape = Shape::grown(Core::rectangle(length - 2.0 * radius, 0.0), radius);
                Some(shape.stated_as(Kind::Capsule { length }))
            }
            Self::Rectangle { length, width, corner_radius } => {
                let (length, width) = (check(*length, LENGTH_RANGE, "length"), check(*width, LENGTH_RANGE, "width"));
                let most = length.unwrap_or(LENGTH_RANGE.1).min(width.unwrap_or(LENGTH_RANGE.1)) / 2.0;
                let radius = check(corner_radius.or(Some(0.0)), (0.0, most), "corner_radius");
                let (length, width, radius) = (length?, width?, radius?);
                let shape = Shape::grown(Core::rectangle(length - 2.0 * radius, width - 2.0 * radius), radius);
                Some(shape.stated_as(Kind::Rectangle { length, width }))
            }
            Self::Polygon { points, corner_radius } => {
                let radius = check(corner_radius.or(Some(0.0)), (0.0, LENGTH_RANGE.1), "corner_radius");
                let hull = hull(at, points, faults, warnings);
                Some(Shape::grown(Some(hull?), radius?))
            }
        }
    }
}

/// The value, if it is present and in its range.
pub(super) fn ranged(value: Option<f64>, (min, max): (f64, f64), place: Place, faults: &mut Findings) -> Option<f64> {
    let value = value?;
    if (min..=max).contains(&value) {
        return Some(value);
    }
    faults.add(place, Flaw::OutOfRange { value, min, max });
    None
}

/// The hull of a polygon's points.
fn hull(at: usize, points: &[[Option<f64>; 2]], faults: &mut Findings, warnings: &mut Findings) -> Option<Core> {
    if points.len() > MAX_POINTS {
        faults.add(Place::Shape(at, "points"), Flaw::TooManyPoints { count: points.len(), max: MAX_POINTS });
        return None;
    }
    let mut checked = Vec::with_capacity(points.len());
    for (n, [x, y]) in points.iter().enumerate() {
        let mut coordinate = |value: &Option<f64>, name| ranged(*value, POINT_RANGE, Place::Point(at, n, name), faults);
        let (x, y) = (coordinate(x, "x"), coordinate(y, "y"));
        checked.push(x.zip(y).map(|(x, y)| Vector2::new(x, y)));
    }
    let points = checked.into_iter().collect::<Option<Vec<_>>>()?;
    let Some(hull) = Core::hull(&points) else {
        faults.add(Place::Shape(at, "points"), Flaw::NoArea);
        return None;
    };
    let (stated, area) = (shoelace(&points), hull.area());
    // Points that go round twice have more than the area of their hull.
    if (area - stated).abs() > area * GROWTH {
        warnings.add(Place::Shape(at, "points"), Flaw::ConvexHull { stated, area });
    }
    Some(hull)
}

/// A hull that is larger by no more than this share of the area is the polygon itself: rounding.
const GROWTH: f64 = 1e-9;
