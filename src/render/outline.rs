//! Footprints as outlines: circles, and paths of straight edges and arcs.

use svg::Node;
use svg::node::Value;
use svg::node::element::Element;

use super::paint::{Paint, px};
use super::view::View;
use nalgebra::{Point2, Vector2};
use singulate_planner::scene::{Core, Footprint};

/// An outline, to be painted.
pub(super) struct Outline(Element);

impl Outline {
    /// Sets an attribute.
    pub(super) fn set(mut self, name: &str, value: impl Into<Value>) -> Self {
        self.0.assign(name, value);
        self
    }
}

impl From<Outline> for Box<dyn Node> {
    fn from(outline: Outline) -> Self {
        Box::new(outline.0)
    }
}

/// A filled footprint.
pub(super) fn filled(footprint: &Footprint, view: &View, paint: Paint) -> Outline {
    contour(footprint, 1.0, view, paint.line).set("fill", paint.fill)
}

/// The outline of a footprint at `share` of its size.
pub(super) fn contour(footprint: &Footprint, share: f64, view: &View, line: &str) -> Outline {
    let outline = match footprint.core() {
        None => {
            let centre = view.point(footprint.at());
            let radius = view.length(footprint.radius()) * share;
            Outline(Element::new("circle")).set("cx", px(centre.x)).set("cy", px(centre.y)).set("r", px(radius))
        }
        Some(core) => Outline(Element::new("path")).set("d", path(core, footprint, share, view)),
    };
    outline.set("fill", "none").set("stroke", line)
}

/// The grown core, shrunk towards its centroid: straight edges joined by arcs.
fn path(core: &Core, footprint: &Footprint, share: f64, view: &View) -> String {
    let (middle, radius) = (core.centroid(), footprint.radius() * share);
    let shrunk = |v: Vector2<f64>| footprint.at() + middle + (v - middle) * share;
    let arc = px(view.length(radius));
    let mut text = String::new();
    for [start, end] in core.edges() {
        let (start, end) = (shrunk(start), shrunk(end));
        let along = (end - start).normalize();
        let out = Vector2::new(along.y, -along.x) * radius;
        let (start, end) = (view.point(start + out), view.point(end + out));
        let (from, to) = (position(start), position(end));
        // The picture's y points down, so that counter-clockwise on the table is counter-clockwise here too: flag 0.
        text += &match text.is_empty() {
            true => format!("M{from}L{to}"),
            false if radius > 0.0 => format!("A{arc} {arc} 0 0 0 {from}L{to}"),
            false => format!("L{to}"),
        };
    }
    let first = core.edges().next().map(|[start, end]| {
        let along = (end - start).normalize();
        view.point(shrunk(start) + Vector2::new(along.y, -along.x) * radius)
    });
    match first.filter(|_| radius > 0.0) {
        Some(first) => format!("{text}A{arc} {arc} 0 0 0 {}Z", position(first)),
        None => text + "Z",
    }
}

fn position(at: Point2<f64>) -> String {
    format!("{} {}", px(at.x), px(at.y))
}

/// Where the footprint's name is written: its centroid, which may be far from its frame's origin.
pub(super) fn middle(footprint: &Footprint) -> Point2<f64> {
    footprint.core().map_or(footprint.at(), |core| footprint.at() + core.centroid())
}

/// How far the footprint reaches from its middle at the least, px.
pub(super) fn body(footprint: &Footprint, view: &View) -> f64 {
    let Some(core) = footprint.core() else { return view.length(footprint.circumradius()) };
    let middle = core.centroid();
    let sides = core.axes().iter().map(|axis| axis.offset - axis.normal.dot(&middle));
    view.length(sides.fold(f64::INFINITY, f64::min) + footprint.radius())
}

/// How far the footprint reaches from its middle in a direction of the drawing, px. Arrows begin and end there.
pub(super) fn reach(footprint: &Footprint, towards: Vector2<f64>, view: &View) -> f64 {
    if footprint.core().is_none() {
        return body(footprint, view);
    }
    let (middle, along) = (middle(footprint), Vector2::new(towards.x, -towards.y));
    let (mut inside, mut outside) = (0.0, 2.0 * footprint.circumradius());
    // Far finer than a pixel.
    for _ in 0..24 {
        let half = (inside + outside) / 2.0;
        if footprint.comes_within(middle + along * half, 0.0) { inside = half } else { outside = half }
    }
    view.length(outside)
}

/// Where a number stands on the upper left of the footprint, px: of a disc at `share` of its radius to the left and up, else near
/// its uppermost left corner, so that the name can be read.
pub(super) fn upper_left(footprint: &Footprint, share: f64, view: &View) -> Point2<f64> {
    let at = view.point(middle(footprint));
    let Some(core) = footprint.core() else { return at - Vector2::repeat(share * body(footprint, view)) };
    let corners = core.vertices().iter().map(|v| view.point(footprint.at() + v));
    let corner = corners.min_by(|a, b| (a.x + a.y).total_cmp(&(b.x + b.y))).unwrap_or(at);
    at + (corner - at) * 0.85
}
