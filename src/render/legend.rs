//! The legend: symbols and the scale bar.

use nalgebra::Point2;
use svg::node::element::{Group, Line, Rectangle};

use super::hand;
use super::label;
use super::moves::{self, badge};
use super::paint::{self, Paint, Sign, TRAY, px, ring};
use super::roles::{Role, Roles};
use super::stays::Stays;
use super::view::{PADDING, View};
use singulate_planner::scene::{Goal, Scene};
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

/// The scale bar, then the symbols that occur, line by line, `below` px below the table.
pub(super) fn legend(scene: &Scene, stated: &Statement, roles: &Roles<'_>, view: &View, below: f64) -> Legend {
    let top = view.height() + below;
    let mut drawing = Group::new().set("class", "legend").add(scale_bar(view, top));
    let (mut x, mut y) = (PADDING, top + LINE);
    for (sign, text) in signs(scene, stated, roles) {
        let room = 3.0 * SIGN + label::width(text, SIZE) + PADDING;
        if x > PADDING && x + room > view.width() {
            (x, y) = (PADDING, y + LINE);
        }
        let middle = Point2::new(x + SIGN, y);
        let at = Point2::new(x + 2.5 * SIGN, y + 0.35 * SIZE);
        drawing = drawing.add(drawn(sign, middle)).add(label::line(text, SIZE, at).set("fill", paint::INK));
        x += room;
    }
    Legend { drawing, height: y - top + LINE }
}

fn signs(scene: &Scene, stated: &Statement, roles: &Roles<'_>) -> Vec<(Sign, &'static str)> {
    let mut signs = wanted(scene, roles);
    if roles.any_immovable(Stays::Fixed) {
        signs.push((Sign::DoubleRing(paint::FIXED), "fixed object"));
    }
    if roles.any_immovable(Stays::TooWide) {
        signs.push((Sign::DoubleRing(paint::TOO_WIDE), "too wide for the hand, as if fixed"));
    }
    if roles.any_immovable(Stays::NoGrasp) {
        signs.push((Sign::DoubleRing(paint::NO_GRASP), "without a grasp, as if fixed"));
    }
    if roles.any_immovable(Stays::NotAccepted) {
        signs.push((Sign::DoubleRing(paint::NOT_ACCEPTED), "no drop-off accepts it, as if fixed"));
    }
    if !scene.table().keep_out().is_empty() {
        signs.push((Sign::Hatch, "nothing may be placed here"));
    }
    if !scene.drop_offs().is_empty() {
        signs.push((Sign::Tray, "drop-off"));
    }
    signs.extend(moves::signs(stated));
    if stated.target_grasp.is_some() {
        signs.push((Sign::Finger(paint::TARGET_GRASP), "fingers at the target"));
    }
    if scene.gripper().palm().is_some() && (stated.target_grasp.is_some() || !stated.steps().is_empty()) {
        signs.push((Sign::Palm, "palm"));
    }
    signs.extend(staying(stated, roles));
    if stated.needed.is_some() {
        signs.push((Sign::Disc(paint::NEEDED), "would have to move"));
        signs.push((Sign::Number(paint::NEEDED), "order"));
    }
    signs
}

/// What the goal names.
fn wanted(scene: &Scene, roles: &Roles<'_>) -> Vec<(Sign, &'static str)> {
    let ring = Sign::DoubleRing(paint::TARGET);
    match scene.goal() {
        Goal::Target(_) => vec![(ring, "target")],
        Goal::AnyOf(_) if roles.grasped().is_some() => {
            vec![(ring, "target, the candidate that is chosen"), (Sign::Disc(paint::CANDIDATE), "other candidate")]
        }
        Goal::AnyOf(_) => vec![(ring, "candidate: one of these is wanted")],
        Goal::AllOf(_) => vec![(ring, "wanted away")],
        Goal::Clear => Vec::new(),
    }
}

/// The lock, and what else a clearing leaves.
fn staying(stated: &Statement, roles: &Roles<'_>) -> Vec<(Sign, &'static str)> {
    let mut signs = Vec::new();
    if let Some(lock) = stated.deadlock.as_ref().or(stated.stuck.as_ref()) {
        signs.push((Sign::Disc(paint::CORE), "hold each other (a minimal set)"));
        if lock.blocked.len() > lock.core.len() {
            signs.push((Sign::Disc(paint::BLOCKED), "can never be moved either"));
        }
    }
    if roles.any(Role::Stays(Stays::NoRoom)) {
        signs.push((Sign::Disc(paint::NO_ROOM), "no room in a drop-off"));
    }
    if roles.any(Role::Stays(Stays::NotReached)) {
        signs.push((Sign::Disc(paint::NOT_REACHED), "not reached: others in its way, or no time"));
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
        Sign::Palm => group.add(hand::palm(at, SIGN, paint::FAINT_INK)),
        Sign::Number(paint) => group.add(badge(1, at, paint, SIGN)),
        Sign::Finger(paint) => {
            group.add(block(3.5).set("fill", paint.fill).set("fill-opacity", "0.55").set("stroke", paint.line))
        }
        Sign::Tray => group.add(block(SIGN - 2.0).set("rx", "2").set("fill", TRAY.fill).set("stroke", TRAY.line)),
        Sign::Hatch => group.add(block(SIGN).set("fill", "url(#keep-out)").set("stroke", paint::KEEP_OUT)),
    }
}

/// A bar of a round length, about a fifth of the table's width.
fn scale_bar(view: &View, top: f64) -> Group {
    let (x, _, width, _) = view.frame();
    let y = top - 6.0;
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
