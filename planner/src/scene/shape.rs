//! The shape of a footprint in the object's own frame: a convex core grown by a radius.

use std::sync::Arc;

use super::convex::Core;

/// A shape: all points no farther than `radius` from a convex core. A disc is a point grown by its radius, a capsule a segment,
/// a rectangle with sharp corners four points grown by 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Shape {
    kind: Kind,
    /// `None` for a point at the origin.
    core: Option<Arc<Core>>,
    radius: f64,
    inradius: f64,
    circumradius: f64,
}

/// What a shape was stated as. No test reads it: core and radius say all.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// A disc round the origin.
    Disc,
    /// A segment along x, grown.
    Capsule {
        /// From tip to tip, m.
        length: f64,
    },
    /// A rectangle round the origin.
    Rectangle {
        /// Along x, m.
        length: f64,
        /// Along y, m.
        width: f64,
    },
    /// A polygon.
    Polygon,
}

impl Shape {
    /// A disc round the origin; `radius` > 0, m.
    pub fn disc(radius: f64) -> Self {
        Self::grown(None, radius)
    }

    /// A core grown by a radius ≥ 0, m; a point grown by one > 0. By its kind a disc or a polygon.
    pub(crate) fn grown(core: Option<Core>, radius: f64) -> Self {
        let kind = if core.is_some() { Kind::Polygon } else { Kind::Disc };
        let circumradius = core.as_ref().map_or(radius, |core| core.circumradius() + radius);
        let inner = |core: &Core| core.axes().iter().map(|axis| axis.offset).fold(f64::INFINITY, f64::min);
        let inradius = core.as_ref().map_or(radius, |core| (inner(core) + radius).max(0.0));
        Self { kind, core: core.map(Arc::new), radius, inradius, circumradius }
    }

    /// The same shape, stated as another kind.
    #[must_use]
    pub(super) fn stated_as(self, kind: Kind) -> Self {
        Self { kind, ..self }
    }

    /// What it was stated as.
    pub fn kind(&self) -> Kind {
        self.kind
    }

    /// The core; `None` for a point at the origin.
    pub fn core(&self) -> Option<&Core> {
        self.core.as_deref()
    }

    /// How far the core is grown, m.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// The radius of the greatest circle round the origin inside the shape, m; 0 where the origin is outside.
    pub fn inradius(&self) -> f64 {
        self.inradius
    }

    /// The radius of the least circle round the origin that holds the shape, m.
    pub fn circumradius(&self) -> f64 {
        self.circumradius
    }
}
