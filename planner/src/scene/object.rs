//! Discs on the table.

use nalgebra::Point2;

/// The position of an object in its scene's list. The planner names objects only by it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ObjectIndex(u32);

impl ObjectIndex {
    /// The object at `position` of a list that has fewer than 2³² entries.
    pub fn new(position: usize) -> Self {
        Self(u32::try_from(position).expect("a scene holds fewer than 2^32 objects"))
    }

    /// The position in the list.
    pub fn get(self) -> usize {
        self.0 as usize
    }
}

/// A disc: centre and radius in metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disc {
    /// Centre, m.
    pub centre: Point2<f64>,
    /// Radius, m, positive.
    pub radius: f64,
}

impl Disc {
    /// The same disc somewhere else.
    #[must_use]
    pub fn at(self, centre: Point2<f64>) -> Self {
        Self { centre, ..self }
    }

    /// Distance between the edges of two discs, m; negative where they overlap.
    pub fn gap(&self, other: &Self) -> f64 {
        distance(self.centre, other.centre) - self.radius - other.radius
    }
}

/// Distance of two points, m. Written as √(x²+y²), which is the same on every machine; `hypot` is not.
pub fn distance(a: Point2<f64>, b: Point2<f64>) -> f64 {
    let (x, y) = (b.x - a.x, b.y - a.y);
    (x * x + y * y).sqrt()
}

/// An object of a checked scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Object {
    pub(super) id: String,
    pub(super) disc: Disc,
    pub(super) fixed: bool,
}

impl Object {
    /// The caller's name for it, unique in the scene.
    pub fn id(&self) -> &str {
        &self.id
    }

    /// Where it stands at the start.
    pub fn disc(&self) -> Disc {
        self.disc
    }

    /// True if it can't be moved.
    pub fn fixed(&self) -> bool {
        self.fixed
    }
}
