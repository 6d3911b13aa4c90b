//! The numbered moves: the old place as a ghost, an arrow, the new place, and the open fingers at both.

use std::collections::HashMap;

use nalgebra::Point2;
use svg::node::element::{Group, Line, Polygon, Title};

use super::label;
use super::objects::{named, outline};
use super::paint::{self, Paint, Sign, filled, fingers, px, ring};
use super::roles::Roles;
use super::view::View;
use singulate_planner::scene::{Footprint, Object, Pose, Scene, distance};
use singulate_planner::statement::{PickPlace, StatedGrasp, Statement, Step};

/// Every relocation and the target's grasp. Arrows and numbers come last, so that no disc hides them.
pub(super) fn plan(scene: &Scene, stated: &Statement, roles: &Roles<'_>, view: &View) -> Group {
    let last: HashMap<&str, usize> =
        stated.steps().iter().enumerate().map(|(at, step)| (step.object(), at + 1)).collect();
    let steps = || stated.steps().iter().enumerate().filter_map(|(at, step)| Move::new(at + 1, step, roles));
    let places = steps().fold(Group::new().set("class", "relocations"), |group, step| {
        let again = last.get(step.object.id()) != Some(&step.number);
        group.add(places(scene, &step, again, view))
    });
    let routes = steps().fold(Group::new().set("class", "routes"), |group, step| group.add(route(&step, view)));
    let target = stated.target_grasp.zip(roles.grasped(stated));
    let target = target.map(|(grasp, object)| target_grasp(scene, object, grasp, view));
    Group::new().add(places).add(target.unwrap_or_default()).add(routes)
}

/// One pick-and-place with its object.
struct Move<'a> {
    number: usize,
    object: &'a Object,
    from: Pose,
    step: &'a PickPlace,
}

impl<'a> Move<'a> {
    /// `None` for an object that is not in the scene.
    fn new(number: usize, step: &'a Step, roles: &Roles<'a>) -> Option<Self> {
        let step = step.pick_place()?;
        let object = roles.object(&step.object)?;
        Some(Self { number, object, from: step.from.unwrap_or(object.footprint().pose), step })
    }
}

/// The signs of a step in the legend.
pub(super) fn signs(step: &Step) -> Vec<(Sign, &'static str)> {
    match step {
        Step::PickPlace(_) => vec![
            (Sign::Dashed, "old place"),
            (Sign::Disc(paint::MOVED), "new place"),
            (Sign::Number(paint::MOVED), "order"),
            (Sign::Finger(paint::GRASP), "fingers picking"),
            (Sign::Finger(paint::RELEASE), "fingers releasing"),
        ],
        Step::PickDrop(_) => {
            vec![(Sign::Number(paint::MOVED), "order"), (Sign::Finger(paint::GRASP), "fingers picking")]
        }
    }
}

/// The open fingers at the target.
pub(super) fn target_grasp(scene: &Scene, target: &Object, grasp: StatedGrasp, view: &View) -> Group {
    fingers(&target.footprint(), grasp.yaw, scene.gripper(), view, paint::TARGET_GRASP)
        .set("class", "fingers target-grasp")
}

/// The order of relocations in the best known derivation.
pub(super) fn needed(ids: &[String], roles: &Roles<'_>, view: &View) -> Group {
    let objects = ids.iter().enumerate().filter_map(|(at, id)| Some((at + 1, roles.object(id)?)));
    objects.fold(Group::new(), |group, (number, object)| {
        let footprint = object.footprint();
        let radius = view.length(footprint.circumradius());
        let corner = view.point(footprint.at()) + nalgebra::Vector2::new(-0.7 * radius, -0.7 * radius);
        group.add(badge(number, corner, paint::NEEDED, badge_radius(&footprint, view)))
    })
}

/// One relocation: ghost and grasp at the old place, disc and release at the new one. A new place is dashed too if the
/// object leaves it again.
fn places(scene: &Scene, Move { number, object, from, step }: &Move<'_>, again: bool, view: &View) -> Group {
    let (old, new) = (object.footprint().moved_to(*from), object.footprint().moved_to(step.to));
    let stroke = outline(&old, view);
    let ghost = filled(&old, view, Paint { fill: paint::PAPER, line: paint::FAINT_INK })
        .set("fill-opacity", "0.7")
        .set("stroke-width", px(stroke))
        .set("stroke-dasharray", "5 3");
    let mut place = filled(&new, view, paint::MOVED).set("stroke-width", px(1.5 * stroke));
    if again {
        place = place.set("fill-opacity", "0.4").set("stroke-dasharray", "5 3");
    }
    let group = Group::new()
        .set("class", "relocation")
        .add(Title::new(label::clean(&format!("{number}: {}", object.id()))))
        .add(ghost)
        .add(fingers(&old, step.grasp.yaw, scene.gripper(), view, paint::GRASP))
        .add(place)
        .add(fingers(&new, step.release.yaw, scene.gripper(), view, paint::RELEASE));
    let group = named(group, object.id(), &old, Paint { fill: paint::PAPER, line: paint::FAINT_INK }, view);
    named(group, object.id(), &new, paint::MOVED, view)
}

/// The arrow, and the step's number at both ends.
fn route(Move { number, object, from, step }: &Move<'_>, view: &View) -> Group {
    let (number, footprint) = (*number, object.footprint());
    let radius = view.length(footprint.circumradius());
    let (from, to) = (view.point(from.at), view.point(step.to.at));
    let size = badge_radius(&footprint, view);
    let badge = badge(number, to + nalgebra::Vector2::new(-0.75 * radius, -0.75 * radius), paint::MOVED, size);
    let group = Group::new().set("class", "route");
    let length = distance(from, to);
    if length < 1.0 {
        return group.add(badge);
    }
    let along = (to - from) / length;
    // If the two places overlap, the arrow would have no length, so it runs from centre to centre.
    let inset = if length > 2.6 * radius { radius } else { 0.0 };
    let (start, tip) = (from + along * inset, to - along * inset);
    // The number at both ends: where many arrows cross, none can be followed.
    group.add(arrow(start, tip, size)).add(self::badge(number, start, paint::GRASP, 0.8 * size)).add(badge)
}

fn arrow(start: Point2<f64>, tip: Point2<f64>, size: f64) -> Group {
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
fn badge_radius(footprint: &Footprint, view: &View) -> f64 {
    (0.3 * view.length(footprint.circumradius())).clamp(8.0, 14.0)
}
