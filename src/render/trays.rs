//! The drop-offs as trays below the table, and the arrows that lead to them.

use std::collections::HashMap;

use nalgebra::Point2;
use svg::node::element::{Group, Rectangle, Title};

use super::fill::{Fill, drop_off, fills};
use super::label;
use super::moves::{Move, arrow, badge, badge_radius};
use super::outline::{middle, reach};
use super::paint::{self, TRAY, px};
use super::view::{PADDING, View};
use singulate_planner::scene::{Scene, distance};
use singulate_planner::statement::Statement;

/// So many drop-offs are all drawn; of more only those that are used.
const FEW: usize = 8;
/// The most trays.
const MOST: usize = 24;
/// More arrows than this are faint, so that the objects below them can be seen.
const CLEAR: usize = 30;
/// Space round a tray, px.
const GAP: f64 = 10.0;
/// The least width of a tray, px.
const LEAST_WIDTH: f64 = 150.0;
/// Radius of a number in a tray, px.
const NUMBER: f64 = 9.0;
/// Distance of the numbers in a tray, px.
const PITCH: f64 = 20.0;
/// Height of a tray's name, px.
const NAME: f64 = 24.0;
/// Size of its letters, px.
const LETTERS: f64 = 13.0;

/// The strip between the table and the legend.
pub(super) struct Trays {
    /// The trays, the arrows and the numbers.
    pub(super) drawing: Group,
    /// px; 0 without drop-offs.
    pub(super) height: f64,
}

/// A tray before it has a place.
struct Tray<'a> {
    name: String,
    amount: String,
    /// The steps that end here and whose arrows are drawn, from left to right.
    arrivals: Vec<&'a Move<'a>>,
}

/// The trays and the arrows of the steps that end there.
pub(super) fn trays(scene: &Scene, stated: &Statement, moves: &[Move<'_>], view: &View) -> Trays {
    let mut drawing = Group::new().set("class", "drop-offs");
    let mut height = 0.0;
    if scene.drop_offs().is_empty() {
        return Trays { drawing, height };
    }
    let room = view.width() - 2.0 * PADDING + GAP;
    let trays = chosen(scene, stated, moves);
    let (columns, width) = columns(trays.len(), room);
    let faint = trays.iter().map(|tray| tray.arrivals.len()).sum::<usize>() > CLEAR;
    let (mut boxes, mut routes) = (Group::new(), Group::new());
    for row in trays.chunks(columns) {
        let numbers = row.iter().map(|tray| tray.rows(width)).max().unwrap_or_default();
        let size = (width, NAME + PITCH * numbers as f64 + if numbers > 0 { 6.0 } else { 0.0 });
        let mut corner = Point2::new(PADDING, view.height() - PADDING + GAP + height);
        for tray in row {
            boxes = boxes.add(tray.drawn(corner, size));
            for (step, at) in tray.places(corner, width, view) {
                routes = routes.add(route(step, at, faint, view));
            }
            corner.x += width + GAP;
        }
        height += size.1 + GAP;
    }
    drawing = drawing.add(boxes).add(routes.set("class", "routes"));
    Trays { drawing, height }
}

/// How many trays stand side by side, and how wide each is, px.
fn columns(trays: usize, room: f64) -> (usize, f64) {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a drawing is some 1,000 px wide")]
    let most = (room / (LEAST_WIDTH + GAP)) as usize;
    let columns = trays.clamp(1, most.max(1));
    (columns, room / columns as f64 - GAP)
}

/// All drop-offs where they are few, else those that are used, with one tray more for the rest.
fn chosen<'a>(scene: &Scene, stated: &Statement, moves: &'a [Move<'a>]) -> Vec<Tray<'a>> {
    let fills = fills(scene, stated);
    let few = fills.len() <= FEW;
    let drawn: Vec<&Fill<'_>> = fills.iter().filter(|fill| few || fill.held > 0).take(MOST).collect();
    let at: HashMap<&str, usize> = drawn.iter().enumerate().map(|(at, fill)| (fill.id, at)).collect();
    let name = |fill: &&Fill<'_>| Tray { name: fill.id.to_owned(), amount: fill.amount(), arrivals: Vec::new() };
    let mut trays: Vec<Tray<'_>> = drawn.iter().map(name).collect();
    if drawn.len() < fills.len() {
        let held = |fills: &mut dyn Iterator<Item = &Fill<'_>>| fills.map(|fill| fill.held).sum::<usize>();
        let rest = Fill { id: "", held: held(&mut fills.iter()) - held(&mut drawn.iter().copied()), capacity: None };
        let more = fills.len() - drawn.len();
        let name = if drawn.is_empty() { format!("{more} drop-offs") } else { format!("and {more} more") };
        trays.push(Tray { name, amount: rest.amount(), arrivals: Vec::new() });
    }
    for step in moves.iter().filter(|step| step.followed) {
        let Some(drop_off) = drop_off(step.step) else { continue };
        let last = trays.len() - 1;
        trays[at.get(drop_off).copied().unwrap_or(last)].arrivals.push(step);
    }
    // From left to right as on the table, so that few arrows cross.
    trays.iter_mut().for_each(|tray| tray.arrivals.sort_by(|one, other| one.from.at.x.total_cmp(&other.from.at.x)));
    trays
}

impl<'a> Tray<'a> {
    /// The rows of numbers in a tray of this width.
    fn rows(&self, width: f64) -> usize {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a drawing is some 1,000 px wide")]
        let in_a_row = ((width - GAP) / PITCH) as usize;
        self.arrivals.len().div_ceil(in_a_row.max(1))
    }

    /// Where the arrow of each step ends, px: column by column, each as far below its object as there is room.
    fn places(&self, corner: Point2<f64>, width: f64, view: &View) -> Vec<(&'a Move<'a>, Point2<f64>)> {
        let rows = self.rows(width).max(1);
        let below = self.arrivals.chunks(rows).map(|column| view.point(column[0].from.at).x).collect();
        let columns = spread(below, (corner.x + (GAP + PITCH) / 2.0, corner.x + width - (GAP + PITCH) / 2.0));
        let y = |at: usize| corner.y + 3.0 + PITCH * ((at % rows) as f64 + 0.5);
        let place = |(at, step): (usize, &&'a Move<'a>)| (*step, Point2::new(columns[at / rows], y(at)));
        self.arrivals.iter().enumerate().map(place).collect()
    }

    fn drawn(&self, corner: Point2<f64>, (width, height): (f64, f64)) -> Group {
        let outline = Rectangle::new()
            .set("x", px(corner.x))
            .set("y", px(corner.y))
            .set("width", px(width))
            .set("height", px(height))
            .set("rx", "5")
            .set("fill", TRAY.fill)
            .set("stroke", TRAY.line)
            .set("stroke-width", "1.5");
        let title = Title::new(label::clean(&format!("{}: {}", self.name, self.amount)));
        let group = Group::new().set("class", "tray").add(title).add(outline);
        let amount = format!(": {}", self.amount);
        let room = width - 2.0 * GAP - label::width(&amount, LETTERS);
        let Some((name, size)) = label::fit(&self.name, LETTERS, room) else { return group };
        let at = Point2::new(corner.x + width / 2.0, corner.y + height - NAME / 2.0);
        group.add(label::centred(&(name + &amount), size, at).set("fill", paint::INK))
    }
}

/// Moves ascending numbers apart, to an easy distance where there is room between the bounds.
fn spread(mut wished: Vec<f64>, (least, greatest): (f64, f64)) -> Vec<f64> {
    let gaps = wished.len().saturating_sub(1).max(1);
    let pitch = ((greatest - least) / gaps as f64).min(2.0 * PITCH);
    let mut next = least;
    for at in &mut wished {
        *at = at.max(next);
        next = *at + pitch;
    }
    let mut next = greatest;
    for at in wished.iter_mut().rev() {
        *at = at.min(next);
        next = *at - pitch;
    }
    wished
}

/// The arrow from the old place to the tray, and the step's number at both ends.
fn route(step: &Move<'_>, to: Point2<f64>, faint: bool, view: &View) -> Group {
    let footprint = step.object.footprint().moved_to(step.from);
    let from = view.point(middle(&footprint));
    let badge_at = |at, paint, radius| badge(step.number, at, paint, radius);
    let group = Group::new().set("class", "route");
    let length = distance(from, to);
    let along = (to - from) / length.max(1.0);
    let radius = reach(&footprint, along, view).min(length / 2.0);
    let (start, tip) = (from + along * radius, to - along * NUMBER);
    let arrow = if distance(start, tip) < 1.0 { Group::new() } else { arrow(start, tip, NUMBER) };
    let group = group.add(if faint { Group::new().set("opacity", "0.35").add(arrow) } else { arrow });
    let size = 0.8 * badge_radius(&footprint, view);
    group.add(badge_at(start, paint::GRASP, size)).add(badge_at(to, paint::MOVED, NUMBER))
}
