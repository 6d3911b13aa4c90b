//! Convex cores: polygons and segments, from which footprints are grown.

use nalgebra::Vector2;
use smallvec::SmallVec;

/// Points nearer to each other, or to a line, count as on it, m.
const FLAT: f64 = 1e-12;

/// A convex polygon with its vertices counter-clockwise, or a segment with its two ends, relative to the origin of a frame, m.
#[derive(Debug, Clone, PartialEq)]
pub struct Core {
    vertices: SmallVec<[Vector2<f64>; 8]>,
    /// Along these directions a point beyond all vertices is told: the edges' outward normals, of a segment also its direction.
    axes: SmallVec<[Axis; 8]>,
}

/// A direction, and how far the core reaches along it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis {
    /// Of length 1.
    pub normal: Vector2<f64>,
    /// m.
    pub offset: f64,
}

impl Core {
    /// The convex hull of some points; `None` if they are on one line.
    pub fn hull(points: &[Vector2<f64>]) -> Option<Self> {
        let mut sorted: Vec<Vector2<f64>> = points.to_vec();
        sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        let mut vertices: SmallVec<[Vector2<f64>; 8]> = chain(sorted.iter());
        let upper = chain(sorted.iter().rev());
        vertices.pop();
        vertices.extend(upper);
        vertices.pop();
        (vertices.len() > 2).then(|| Self::through(vertices))
    }

    /// A rectangle round the origin with positive sides, or a segment where one of them is 0; `None` where both are.
    pub(super) fn rectangle(length: f64, width: f64) -> Option<Self> {
        let (x, y) = (length / 2.0, width / 2.0);
        let corners = [[-x, -y], [x, -y], [x, y], [-x, y]].map(|[x, y]| Vector2::new(x, y));
        match (length > FLAT, width > FLAT) {
            (true, true) => Some(Self::through(SmallVec::from_slice(&corners))),
            (true, false) => Some(Self::segment(Vector2::new(x, 0.0))),
            (false, true) => Some(Self::segment(Vector2::new(0.0, y))),
            (false, false) => None,
        }
    }

    fn segment(end: Vector2<f64>) -> Self {
        Self::through(SmallVec::from_slice(&[-end, end]))
    }

    fn through(vertices: SmallVec<[Vector2<f64>; 8]>) -> Self {
        let mut axes = SmallVec::new();
        for (at, &start) in vertices.iter().enumerate() {
            let along = vertices[(at + 1) % vertices.len()] - start;
            let along = along / length(along);
            let mut add = |normal: Vector2<f64>| axes.push(Axis { normal, offset: normal.dot(&start) });
            add(Vector2::new(along.y, -along.x));
            if vertices.len() == 2 {
                add(-along);
            }
        }
        Self { vertices, axes }
    }

    /// Counter-clockwise.
    pub fn vertices(&self) -> &[Vector2<f64>] {
        &self.vertices
    }

    /// The directions along which the core is told from a point outside.
    pub fn axes(&self) -> &[Axis] {
        &self.axes
    }

    /// Each edge by its ends; both senses of a segment.
    pub fn edges(&self) -> impl Iterator<Item = [Vector2<f64>; 2]> + '_ {
        (0..self.vertices.len()).map(|at| [self.vertices[at], self.vertices[(at + 1) % self.vertices.len()]])
    }

    /// Its area, m².
    pub fn area(&self) -> f64 {
        shoelace(&self.vertices)
    }

    /// The centroid of its area; of a segment its middle.
    pub fn centroid(&self) -> Vector2<f64> {
        let origin = self.vertices[0];
        let (mut area, mut sum) = (0.0, Vector2::zeros());
        for [start, end] in self.edges() {
            let (a, b) = (start - origin, end - origin);
            area += a.perp(&b);
            sum += (a + b) * a.perp(&b);
        }
        if area > 0.0 { origin + sum / (3.0 * area) } else { self.vertices.iter().sum::<Vector2<f64>>() / 2.0 }
    }

    /// The same core turned about the origin by the angle of which `direction` holds cosine and sine.
    #[must_use]
    pub fn turned(&self, direction: Vector2<f64>) -> Self {
        let turn = |v: &Vector2<f64>| turned(*v, direction);
        let axis = |axis: &Axis| Axis { normal: turn(&axis.normal), offset: axis.offset };
        Self { vertices: self.vertices.iter().map(turn).collect(), axes: self.axes.iter().map(axis).collect() }
    }

    /// The same core moved.
    #[must_use]
    pub fn moved(&self, by: Vector2<f64>) -> Self {
        let axis = |axis: &Axis| Axis { normal: axis.normal, offset: axis.offset + axis.normal.dot(&by) };
        Self { vertices: self.vertices.iter().map(|v| v + by).collect(), axes: self.axes.iter().map(axis).collect() }
    }

    /// The Minkowski sum of two cores: what the first covers while its origin runs over the second.
    #[must_use]
    pub fn sum(&self, other: &Self) -> Self {
        let lowest = |core: &Self| {
            let below = |a: &Vector2<f64>, b: &Vector2<f64>| a.y.total_cmp(&b.y).then(a.x.total_cmp(&b.x));
            (0..core.vertices.len()).min_by(|a, b| below(&core.vertices[*a], &core.vertices[*b])).unwrap_or_default()
        };
        let (first, others) = (lowest(self), lowest(other));
        let vertex = |core: &Self, start: usize, at: usize| core.vertices[(start + at) % core.vertices.len()];
        let (mut at, mut theirs) = (0, 0);
        let mut points = Vec::with_capacity(self.vertices.len() + other.vertices.len());
        // Edges by direction, from the lowest vertex on.
        while at < self.vertices.len() || theirs < other.vertices.len() {
            let (here, there) = (vertex(self, first, at), vertex(other, others, theirs));
            points.push(here + there);
            let (edge, their_edge) = (vertex(self, first, at + 1) - here, vertex(other, others, theirs + 1) - there);
            let turn = edge.perp(&their_edge);
            let (own, other) = (at < self.vertices.len(), theirs < other.vertices.len());
            at += usize::from(own && (turn >= 0.0 || !other));
            theirs += usize::from(other && (turn <= 0.0 || !own));
        }
        // Of two parallel segments a longer one.
        let ends = [points[0], points[points.len() / 2]];
        Self::hull(&points).unwrap_or_else(|| Self::through(SmallVec::from_slice(&ends)))
    }

    /// The same core mirrored in the origin.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let axis = |axis: &Axis| Axis { normal: -axis.normal, offset: axis.offset };
        Self { vertices: self.vertices.iter().map(|v| -v).collect(), axes: self.axes.iter().map(axis).collect() }
    }

    /// The greatest distance of a vertex from the origin, m.
    pub fn circumradius(&self) -> f64 {
        self.vertices.iter().map(|v| length(*v)).fold(0.0, f64::max)
    }

    /// How far it reaches along a direction of length 1, m.
    pub fn reach_along(&self, direction: Vector2<f64>) -> f64 {
        self.vertices.iter().map(|v| v.dot(&direction)).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Distance of a point, m; inside minus the least way out.
    pub fn distance_to_point(&self, point: Vector2<f64>) -> f64 {
        let outside = self.beyond(point);
        if outside <= 0.0 { outside } else { self.nearest_edge(point) }
    }

    /// True if a point is nearer than `reach`, m.
    pub(super) fn comes_within(&self, point: Vector2<f64>, reach: f64) -> bool {
        let outside = self.beyond(point);
        // Along an axis it is no farther than it is.
        outside < reach && (outside <= 0.0 || self.nearest_edge(point) < reach)
    }

    /// How far a point is beyond the core along the axis where it is farthest, m.
    fn beyond(&self, point: Vector2<f64>) -> f64 {
        self.axes.iter().map(|axis| axis.normal.dot(&point) - axis.offset).fold(f64::NEG_INFINITY, f64::max)
    }

    fn nearest_edge(&self, point: Vector2<f64>) -> f64 {
        self.edges().map(|ends| to_segment(point, ends)).fold(f64::INFINITY, f64::min)
    }

    /// Distance of another core, m; where the two overlap minus the least translation that parts them (Minkowski penetration).
    pub fn distance_to(&self, other: &Self, other_at: Vector2<f64>) -> f64 {
        let apart = self.gap_along_axes(other, other_at).max(other.gap_along_axes(self, -other_at));
        if apart <= 0.0 {
            return apart;
        }
        let to_self = other.vertices.iter().map(|v| self.nearest_edge(v + other_at));
        let to_other = self.vertices.iter().map(|v| other.nearest_edge(v - other_at));
        to_self.chain(to_other).fold(f64::INFINITY, f64::min)
    }

    /// True if another core is at least `distance` away, m.
    pub(super) fn keeps_from(&self, other: &Self, other_at: Vector2<f64>, distance: f64) -> bool {
        let apart = self.gap_along_axes(other, other_at).max(other.gap_along_axes(self, -other_at));
        // Along an axis they are no farther apart than they are.
        apart >= distance || apart > 0.0 && self.distance_to(other, other_at) >= distance
    }

    /// The widest gap to another core along its own axes, m; negative where there is none.
    fn gap_along_axes(&self, other: &Self, other_at: Vector2<f64>) -> f64 {
        let gap = |axis: &Axis| {
            let nearest = other.vertices.iter().map(|v| axis.normal.dot(v)).fold(f64::INFINITY, f64::min);
            nearest + axis.normal.dot(&other_at) - axis.offset
        };
        self.axes.iter().map(gap).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Distance of the axis-parallel box from `min` to `max`, m; where the two overlap minus the least translation that parts
    /// them. The box has positive sides.
    pub fn distance_to_box(&self, min: Vector2<f64>, max: Vector2<f64>) -> f64 {
        let apart = self.gap_to_box(min, max);
        if apart <= 0.0 { apart } else { self.nearest_of_box(min, max) }
    }

    /// True if the box comes nearer than `reach`, m.
    pub fn box_comes_within(&self, min: Vector2<f64>, max: Vector2<f64>, reach: f64) -> bool {
        let apart = self.gap_to_box(min, max);
        // Along an axis they are no farther apart than they are.
        apart < reach && (apart <= 0.0 || self.nearest_of_box(min, max) < reach)
    }

    /// The widest gap to a box along the axes of either, m.
    fn gap_to_box(&self, min: Vector2<f64>, max: Vector2<f64>) -> f64 {
        let (mut low, mut high) = (Vector2::repeat(f64::INFINITY), Vector2::repeat(f64::NEG_INFINITY));
        for v in &self.vertices {
            (low, high) = (low.inf(v), high.sup(v));
        }
        let gaps = (low - max).sup(&(min - high));
        let (middle, half) = ((min + max) / 2.0, (max - min) / 2.0);
        let nearest = |n: &Vector2<f64>| n.dot(&middle) - n.x.abs() * half.x - n.y.abs() * half.y;
        let along = self.axes.iter().map(|axis| nearest(&axis.normal) - axis.offset);
        along.fold(gaps.x.max(gaps.y), f64::max)
    }

    /// The distance of a box that does not overlap, m.
    fn nearest_of_box(&self, min: Vector2<f64>, max: Vector2<f64>) -> f64 {
        let to_box = self.vertices.iter().map(|v| length((min - v).sup(&(v - max)).sup(&Vector2::zeros())));
        let corners = [min, Vector2::new(max.x, min.y), max, Vector2::new(min.x, max.y)];
        let to_self = corners.into_iter().map(|corner| self.nearest_edge(corner));
        to_box.chain(to_self).fold(f64::INFINITY, f64::min)
    }
}

/// The vector turned by the angle of which `direction` holds cosine and sine.
pub fn turned(v: Vector2<f64>, direction: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(v.x * direction.x - v.y * direction.y, v.x * direction.y + v.y * direction.x)
}

/// Cosine and sine of an angle. Exact for 0.
pub fn direction(yaw: f64) -> Vector2<f64> {
    let (sin, cos) = libm::sincos(yaw);
    Vector2::new(cos, sin)
}

/// The area within a closed line, m²; of one that crosses itself the difference of its parts.
pub(super) fn shoelace(points: &[Vector2<f64>]) -> f64 {
    let next = points.iter().cycle().skip(1);
    (points.iter().zip(next).map(|(a, b)| a.perp(b)).sum::<f64>() / 2.0).abs()
}

/// √(x²+y²), the same on every machine.
pub fn length(v: Vector2<f64>) -> f64 {
    (v.x * v.x + v.y * v.y).sqrt()
}

fn to_segment(point: Vector2<f64>, [start, end]: [Vector2<f64>; 2]) -> f64 {
    let along = end - start;
    let share = ((point - start).dot(&along) / along.dot(&along)).clamp(0.0, 1.0);
    length(point - (start + along * share))
}

/// The lower right half of a hull (Andrew's monotone chain), of points sorted from left to right.
fn chain<'a>(points: impl Iterator<Item = &'a Vector2<f64>>) -> SmallVec<[Vector2<f64>; 8]> {
    let mut kept: SmallVec<[Vector2<f64>; 8]> = SmallVec::new();
    for &point in points {
        while let [.., before, last] = kept.as_slice() {
            let edge = point - before;
            if (last - before).perp(&edge) > FLAT * length(edge) {
                break;
            }
            kept.pop();
        }
        if kept.last().is_none_or(|last| length(point - last) > FLAT) {
            kept.push(point);
        }
    }
    kept
}
