//! The numbered steps: the old place as a ghost, the open fingers there, and on the table the new place with an arrow.

use std::collections::HashMap;

use nalgebra::Point2;
use svg::node::element::{Group, Line, Polygon, Title};

use super::fill::{drop_off, drops};
use super::hand::fingers;
use super::label;
use super::names::named;
use super::objects::outline;
use super::outline::{Outline, body, filled, middle, reach, upper_left};
use super::paint::{self, Paint, Sign, px, ring};
use super::roles::{Mark, Roles};
use super::view::View;
use singulate_planner::scene::{Footprint, Object, Pose, Scene, distance};
use singulate_planner::statement::{StatedGrasp, Statement, Step};

/// The most steps off the table with fingers, number and arrow. Of further ones only the old place is drawn: nobody
/// could follow their arrows, and a table may hold thousands.
pub(super) const MOST_FOLLOWED: usize = 100;

/// Every relocation and the target's grasp. Arrows and numbers come last, so that no disc hides them.
pub(super) fn plan(scene: &Scene, stated: &Statement, roles: &Roles<'_>, view: &View) -> Group {
    let last: HashMap<&str, usize> =
        stated.steps().iter().enumerate().map(|(at, step)| (step.object(), at + 1)).collect();
    let moves = moves(stated, roles);
    let places = moves.iter().fold(Group::new().set("class", "relocations"), |group, step| {
        let again = last.get(step.object.id()) != Some(&step.number);
        group.add(places(scene, step, again, view))
    });
    let routes = moves.iter().filter_map(|step| route(step, view));
    let routes = routes.fold(Group::new().set("class", "routes"), Group::add);
    let target = stated.target_grasp.zip(roles.grasped());
    let target = target.map(|(grasp, object)| target_grasp(scene, object, grasp, view));
    Group::new().add(places).add(target.unwrap_or_default()).add(routes)
}

/// One step with its object.
pub(super) struct Move<'a> {
    pub(super) number: usize,
    pub(super) object: &'a Object,
    pub(super) from: Pose,
    pub(super) step: &'a Step,
    /// True for what the goal wants away.
    wanted: bool,
    /// False for a step of which only the old place is drawn.
    pub(super) followed: bool,
}

/// The steps of objects that are in the scene.
pub(super) fn moves<'a>(stated: &'a Statement, roles: &Roles<'a>) -> Vec<Move<'a>> {
    let mut dropped = 0;
    let steps = stated.steps().iter().enumerate().filter_map(|(at, step)| {
        dropped += usize::from(drop_off(step).is_some());
        let object = roles.object(step.object())?;
        let from = match step {
            Step::PickPlace(step) => step.from,
            Step::PickDrop(step) => step.from,
        };
        let followed = drop_off(step).is_none() || dropped <= MOST_FOLLOWED;
        let wanted = roles.marked(object.id()) == Mark::Wanted;
        Some(Move {
            number: at + 1,
            object,
            from: from.map_or(object.footprint().pose(), Pose::from),
            step,
            wanted,
            followed,
        })
    });
    steps.collect()
}

/// The signs of the steps in the legend.
pub(super) fn signs(stated: &Statement) -> Vec<(Sign, &'static str)> {
    let dropped = drops(stated).count();
    let placed = stated.steps().len() > dropped;
    let order = if dropped > MOST_FOLLOWED { "order, of the first 100 off the table" } else { "order" };
    let signs = [
        (true, Sign::Dashed, "old place"),
        (placed, Sign::Disc(paint::MOVED), "new place"),
        (true, Sign::Number(paint::MOVED), order),
        (true, Sign::Finger(paint::GRASP), "fingers picking"),
        (placed, Sign::Finger(paint::RELEASE), "fingers releasing"),
    ];
    let steps = !stated.steps().is_empty();
    signs.into_iter().filter(|(occurs, ..)| steps && *occurs).map(|(_, sign, text)| (sign, text)).collect()
}

/// The open fingers at the target.
pub(super) fn target_grasp(scene: &Scene, target: &Object, grasp: StatedGrasp, view: &View) -> Group {
    fingers(target, target.footprint(), grasp, (scene.gripper(), view), paint::TARGET_GRASP)
        .set("class", "fingers target-grasp")
}

/// The order of relocations in the best known derivation.
pub(super) fn needed(ids: &[String], roles: &Roles<'_>, view: &View) -> Group {
    let objects = ids.iter().enumerate().filter_map(|(at, id)| Some((at + 1, roles.object(id)?)));
    objects.fold(Group::new(), |group, (number, object)| {
        let footprint = object.footprint();
        let corner = upper_left(footprint, 0.7, view);
        group.add(badge(number, corner, paint::NEEDED, badge_radius(footprint, view)))
    })
}

/// One step: ghost and grasp at the old place; disc and release at the new one, if there is one.
fn places(scene: &Scene, step: &Move<'_>, again: bool, view: &View) -> Group {
    let old = step.object.footprint().moved_to(step.from);
    let title = match drop_off(step.step) {
        Some(drop_off) => format!("{}: {} to {drop_off}", step.number, step.object.id()),
        None => format!("{}: {}{}", step.number, step.object.id(), turned(step.step)),
    };
    let paint = if step.wanted { paint::GHOST_OF_WANTED } else { paint::GHOST };
    let stroke = outline(&old, view);
    let ghost = filled(&old, view, paint)
        .set("fill-opacity", "0.7")
        .set("stroke-width", px(stroke))
        .set("stroke-dasharray", "5 3");
    let mut group = Group::new().set("class", "relocation").add(Title::new(label::clean(&title))).add(ghost);
    if step.followed {
        let grasp = match step.step {
            Step::PickPlace(step) => step.grasp,
            Step::PickDrop(step) => step.grasp,
        };
        group = group.add(fingers(step.object, &old, grasp, (scene.gripper(), view), paint::GRASP));
    }
    match step.step {
        Step::PickDrop(_) => named(group, step.object.id(), &old, paint, view),
        Step::PickPlace(place) => {
            let new = old.moved_to(place.to.into());
            let group = group.add(set_down(&new, again, view)).add(fingers(
                step.object,
                &new,
                place.release,
                (scene.gripper(), view),
                paint::RELEASE,
            ));
            let group = named(group, step.object.id(), &old, paint, view);
            named(group, step.object.id(), &new, paint::MOVED, view)
        }
    }
}

/// By how much the step turns the object, as words for the title. Empty if the step does not turn it.
fn turned(step: &Step) -> String {
    let turn = step.pick_place().and_then(|step| step.turn).and_then(super::turn);
    turn.map(|turn| format!(", turned by {turn}")).unwrap_or_default()
}

/// The object at a new place, dashed if it leaves it again.
fn set_down(new: &Footprint, again: bool, view: &View) -> Outline {
    let place = filled(new, view, paint::MOVED).set("stroke-width", px(1.5 * outline(new, view)));
    if again { place.set("fill-opacity", "0.4").set("stroke-dasharray", "5 3") } else { place }
}

/// The arrow to the new place, and the step's number at both ends; `None` for a step off the table.
fn route(Move { number, object, from, step, .. }: &Move<'_>, view: &View) -> Option<Group> {
    let (number, footprint) = (*number, object.footprint());
    let (old, new) = (footprint.moved_to(*from), footprint.moved_to(step.pick_place()?.to.into()));
    let (from, to) = (view.point(middle(&old)), view.point(middle(&new)));
    let size = badge_radius(footprint, view);
    let badge = badge(number, upper_left(&new, 0.75, view), paint::MOVED, size);
    let group = Group::new().set("class", "route");
    let length = distance(from, to);
    if length < 1.0 {
        return Some(group.add(badge));
    }
    let along = (to - from) / length;
    // If the two places overlap, the arrow would have no length, so it runs from centre to centre.
    let insets = (reach(&old, along, view), reach(&new, -along, view));
    let insets = if length > 2.6 * ((insets.0 + insets.1) / 2.0) { insets } else { (0.0, 0.0) };
    let (start, tip) = (from + along * insets.0, to - along * insets.1);
    // The number at both ends: where many arrows cross, none can be followed.
    Some(group.add(arrow(start, tip, size)).add(self::badge(number, start, paint::GRASP, 0.8 * size)).add(badge))
}

/// A line with a head at `tip`.
pub(super) fn arrow(start: Point2<f64>, tip: Point2<f64>, size: f64) -> Group {
    let length = distance(start, tip);
    let along = (tip - start) / length;
    let head = size.min(length / 2.0);
    let across = nalgebra::Vector2::new(-along.y, along.x) * head * 0.45;
    let neck = tip - along * head;
    let shaft = Line::new()
        .set("x1", px(start.x))
        .set("y1", px(start.y))
        .set("x2", px(neck.x))
        .set("y2", px(neck.y))
        .set("stroke", paint::INK)
        .set("stroke-width", px((size / 5.0).min(2.0)));
    let corners = [tip, neck + across, neck - across];
    Group::new()
        .set("opacity", "0.8")
        .add(shaft)
        .add(Polygon::new().set("points", paint::points(corners)).set("fill", paint::INK))
}

/// A number in a filled circle.
pub(super) fn badge(number: usize, at: Point2<f64>, paint: Paint, radius: f64) -> Group {
    let text = number.to_string();
    let size = (1.5 * radius).min(1.7 * radius / label::width(&text, 1.0));
    Group::new()
        .set("class", "number")
        .add(ring(at, radius, paint::PAPER).set("fill", paint.line).set("stroke-width", px(radius / 8.0)))
        .add(label::centred(&text, size, at).set("fill", paint::PAPER).set("font-weight", "bold"))
}

/// Large enough to be read on small objects too.
pub(super) fn badge_radius(footprint: &Footprint, view: &View) -> f64 {
    (0.3 * body(footprint, view)).clamp(8.0, 14.0)
}
