//! The ids of objects, written into them.

use nalgebra::Vector2;
use svg::node::element::Group;

use super::label::{self, LARGEST_SIZE};
use super::outline::{body, middle, reach};
use super::paint::{self, Paint, px};
use super::view::View;
use singulate_planner::scene::Footprint;

/// The size of letters in an object that is thinner than they are, px.
const THIN: f64 = 9.0;
/// Rather than turned, letters are made smaller by this factor at the least.
const SMALLER: f64 = 0.75;
/// An edge is upright up to this tangent of its angle to the vertical.
const UPRIGHT: f64 = 0.1;

/// Write the id into the object if it is readable.
pub(super) fn named(group: Group, id: &str, footprint: &Footprint, paint: Paint, view: &View) -> Group {
    let radius = view.length(footprint.circumradius());
    let inside = 0.8 * body(footprint, view);
    let disc = footprint.core().is_none();
    // Across what is thin the letters stand out on both sides.
    let largest = if disc { inside } else { inside.max(THIN.min(0.8 * radius)) }.min(LARGEST_SIZE);
    let (turn, room) = if disc { (0.0, 1.6 * radius) } else { along(id, largest, footprint, view) };
    let Some((text, size)) = label::fit(id, largest, room) else { return group };
    let ink = if paint == paint::CORE { paint::PAPER } else { paint::INK };
    let at = view.point(middle(footprint));
    let text = label::centred(&text, size, at).set("fill", ink);
    let text = if turn == 0.0 {
        text
    } else {
        text.set("transform", format!("rotate({} {} {})", px(turn), px(at.x), px(at.y)))
    };
    // A halo separates the letters from the hatching, and from the edges that they cross.
    let hatched = [paint::FIXED, paint::TOO_WIDE, paint::NO_GRASP, paint::NOT_ACCEPTED].contains(&paint);
    group.add(if hatched || size > inside {
        text.set("stroke", paint::PAPER).set("stroke-width", px(size / 4.0)).set("paint-order", "stroke")
    } else {
        text
    })
}

/// How far the id is turned in the drawing, degrees, and the room there, px: level where it nearly fits, else along the longest edge if
/// that gives it more room.
fn along(id: &str, size: f64, footprint: &Footprint, view: &View) -> (f64, f64) {
    let room = |along: Vector2<f64>| 0.9 * (reach(footprint, along, view) + reach(footprint, -along, view));
    let level = room(Vector2::x());
    let edges = footprint.core().into_iter().flat_map(|core| core.edges());
    let longest = edges.map(|[start, end]| end - start).max_by(|a, b| a.norm_squared().total_cmp(&b.norm_squared()));
    let wide = label::width(&label::clean(id), SMALLER * size) > level;
    let Some(edge) = longest.filter(|_| wide) else { return (0.0, level) };
    // The drawing's y points down. Letters must not stand on their heads, and upright objects are all read upwards.
    let edge = Vector2::new(edge.x, -edge.y).normalize();
    let edge = if edge.x < UPRIGHT * edge.y { -edge } else { edge };
    match room(edge) {
        longer if longer > level => (libm::atan2(edge.y, edge.x).to_degrees(), longer),
        _ => (0.0, level),
    }
}
