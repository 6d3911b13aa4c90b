//! The legend: symbols and the scale bar.

use nalgebra::Point2;
use svg::node::element::{Group, Line, Rectangle};

use super::label;
use super::moves::{self, badge};
use super::paint::{self, Paint, Sign, px, ring};
use super::view::{PADDING, View};
use singulate_planner::scene::Scene;
use singulate_planner::statement::Statement;

/// Size of the letters, px.
const SIZE: f64 = 12.0;
/// Distance of lines, px.
const LINE: f64 = 26.0;
/// Half the height of a sign, px.
const SIGN: f64 = 8.0;

/// The strip below the table.
#[derive(Debug)]
pub(super) struct Legend {
    pub(super) drawing: Group,
    /// px.
    pub(super) height: f64,
}

/// The scale bar, then the symbols that occur, line by line.
pub(super) fn legend(scene: &Scene, stated: &Statement, view: &View) -> Legend {
    let mut drawing = Group::new().set("class", "legend").add(scale_bar(view));
    let (mut x, mut y) = (PADDING, view.height() + LINE);
    for (sign, text) in signs(scene, stated) {
        let room = 3.0 * SIGN + label::width(text, SIZE) + PADDING;
        if x > PADDING && x + room > view.width() {
            (x, y) = (PADDING, y + LINE);
        }
        let middle = Point2::new(x + SIGN, y);
        let at = Point2::new(x + 2.5 * SIGN, y + 0.35 * SIZE);
        drawing = drawing.add(drawn(sign, middle)).add(label::line(text, SIZE, at).set("fill", paint::INK));
        x += room;
    }
    Legend { drawing, height: y - view.height() + LINE }
}

fn signs(scene: &Scene, stated: &Statement) -> Vec<(Sign, &'static str)> {
    let mut signs = vec![(Sign::DoubleRing(paint::TARGET), "target")];
    if scene.objects().iter().any(singulate_planner::scene::Object::fixed) {
        signs.push((Sign::DoubleRing(paint::FIXED), "fixed object"));
    }
    if !scene.table().keep_out().is_empty() {
        signs.push((Sign::Hatch, "nothing may be placed here"));
    }
    signs.extend(stated.steps().first().map(moves::signs).unwrap_or_default());
    if stated.target_grasp.is_some() {
        signs.push((Sign::Finger(paint::TARGET_GRASP), "fingers at the target"));
    }
    if let Some(deadlock) = &stated.deadlock {
        signs.push((Sign::Disc(paint::CORE), "hold each other (a minimal set)"));
        if deadlock.blocked.len() > deadlock.core.len() {
            signs.push((Sign::Disc(paint::BLOCKED), "can never be moved either"));
        }
    }
    if stated.needed.is_some() {
        signs.push((Sign::Disc(paint::NEEDED), "would have to move"));
        signs.push((Sign::Number(paint::NEEDED), "order"));
    }
    signs
}

fn drawn(sign: Sign, at: Point2<f64>) -> Group {
    let disc = |paint: Paint| ring(at, SIGN, paint.line).set("fill", paint.fill).set("stroke-width", "1.5");
    let block = |half: f64| {
        let (x, y) = (at.x - SIGN, at.y - half);
        Rectangle::new().set("x", px(x)).set("y", px(y)).set("width", px(2.0 * SIGN)).set("height", px(2.0 * half))
    };
    let group = Group::new();
    match sign {
        Sign::Disc(paint) => group.add(disc(paint)),
        Sign::DoubleRing(paint) => group.add(disc(paint)).add(ring(at, SIGN - 3.0, paint.line)),
        Sign::Dashed => {
            let paint = Paint { fill: paint::PAPER, line: paint::FAINT_INK };
            group.add(disc(paint).set("stroke-dasharray", "4 2.5"))
        }
        Sign::Number(paint) => group.add(badge(1, at, paint, SIGN)),
        Sign::Finger(paint) => {
            group.add(block(3.5).set("fill", paint.fill).set("fill-opacity", "0.55").set("stroke", paint.line))
        }
        Sign::Hatch => group.add(block(SIGN).set("fill", "url(#keep-out)").set("stroke", paint::KEEP_OUT)),
    }
}

/// A bar of a round length, about a fifth of the table's width.
fn scale_bar(view: &View) -> Group {
    let (x, _, width, _) = view.frame();
    let y = view.height() - 6.0;
    let metres = round_length(width / 5.0 / view.scale());
    let end = x + 3.0 + view.length(metres);
    let stroke = |x1: f64, y1: f64, x2: f64, y2: f64| {
        let line = Line::new().set("x1", px(x1)).set("y1", px(y1)).set("x2", px(x2)).set("y2", px(y2));
        line.set("stroke", paint::INK).set("stroke-width", "1.5")
    };
    let text = if metres < 1.0 { format!("{} mm", px(metres * 1e3)) } else { format!("{} m", px(metres)) };
    Group::new()
        .set("class", "scale")
        .add(stroke(x + 3.0, y, end, y))
        .add(stroke(x + 3.0, y - 4.0, x + 3.0, y + 4.0))
        .add(stroke(end, y - 4.0, end, y + 4.0))
        .add(label::line(&text, SIZE, Point2::new(end + 8.0, y + 0.35 * SIZE)).set("fill", paint::INK))
}

/// The greatest of 1, 2, 5 × 10ⁿ that is not above `length`.
fn round_length(length: f64) -> f64 {
    let power = libm::pow(10.0, libm::floor(libm::log10(length)));
    match length / power {
        lead if lead >= 5.0 => 5.0 * power,
        lead if lead >= 2.0 => 2.0 * power,
        _ => power,
    }
}
