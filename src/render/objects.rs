//! The table and the objects at their old places.

use svg::node::element::{Group, Rectangle as Rect, Title};

use super::label;
use super::names::named;
use super::outline::{Outline, contour, filled};
use super::paint::{self, Paint, px};
use super::roles::{Mark, Role, Roles};
use super::stays::Stays;
use super::view::View;
use singulate_planner::scene::{Footprint, ObjectIndex, Rectangle, Scene};

/// The table top with its keep-out rectangles.
pub(super) fn table(scene: &Scene, view: &View) -> Group {
    let top = rectangle(&scene.table().top(), view);
    let top = top.set("fill", paint::TABLE).set("stroke", paint::TABLE_EDGE).set("stroke-width", "2");
    scene.table().keep_out().iter().fold(Group::new().set("class", "table").add(top), |group, area| {
        let area = rectangle(area, view).set("class", "keep-out").set("fill", "url(#keep-out)");
        group.add(area.set("stroke", paint::KEEP_OUT))
    })
}

fn rectangle(area: &Rectangle, view: &View) -> Rect {
    let (left_below, right_above) = (view.point(area.min()), view.point(area.max()));
    Rect::new()
        .set("x", px(left_below.x))
        .set("y", px(right_above.y))
        .set("width", px(right_above.x - left_below.x))
        .set("height", px(left_below.y - right_above.y))
}

/// Every object that is not moved.
pub(super) fn standing(scene: &Scene, roles: &Roles<'_>, view: &View) -> Group {
    let staying = scene.indices().filter(|&object| roles.of(object) != Role::Moved);
    staying.fold(Group::new().set("class", "objects"), |group, object| group.add(one(scene, object, roles, view)))
}

fn one(scene: &Scene, index: ObjectIndex, roles: &Roles<'_>, view: &View) -> Group {
    let (object, mark) = (scene.object(index), roles.mark(index));
    let (name, paint) = look(roles.of(index), mark);
    let (footprint, stroke) = (object.footprint(), outline(object.footprint(), view));
    let class = match mark {
        Mark::Wanted => format!("{name} target"),
        Mark::Candidate => format!("{name} candidate"),
        Mark::Unnamed => name.to_owned(),
    };
    let mut group =
        Group::new().set("class", class).add(Title::new(label::clean(&title(object.id(), roles.of(index))))).add(
            filled(footprint, view, paint)
                .set("stroke-width", px(if mark == Mark::Wanted { 2.5 * stroke } else { stroke })),
        );
    if mark == Mark::Wanted {
        // Gold on red, so that the target stands out within a lock too.
        let line = if paint == paint::TARGET { paint.line } else { paint::TARGET.fill };
        group = group.add(inner_ring(footprint, 0.88, view, line));
    }
    if let Some(why) = roles.immovable(index) {
        group = group.add(inner_ring(footprint, 0.84, view, ring_colour(why, paint)));
    }
    named(group, object.id(), footprint, paint, view)
}

/// The class and the colours of an object that is not moved.
fn look(role: Role, mark: Mark) -> (&'static str, Paint) {
    match (role, mark) {
        (Role::Core, _) => ("core", paint::CORE),
        (Role::Blocked, _) => ("blocked", paint::BLOCKED),
        (Role::Needed, _) => ("needed", paint::NEEDED),
        (_, Mark::Wanted) => ("object", paint::TARGET),
        (_, Mark::Candidate) => ("object", paint::CANDIDATE),
        (Role::Stays(Stays::Fixed), _) => ("object", paint::FIXED),
        (Role::Stays(Stays::TooWide), _) => ("object", paint::TOO_WIDE),
        (Role::Stays(Stays::NoGrasp), _) => ("object", paint::NO_GRASP),
        (Role::Stays(Stays::NotAccepted), _) => ("object", paint::NOT_ACCEPTED),
        (Role::Stays(Stays::Locked), _) => ("blocked", paint::BLOCKED),
        (Role::Stays(Stays::NoRoom), _) => ("object", paint::NO_ROOM),
        (Role::Stays(Stays::NotReached), _) => ("object", paint::NOT_REACHED),
        (Role::Moved | Role::Bystander, _) => ("object", paint::OBSTACLE),
    }
}

/// Within a lock the second ring still shows that an object is too wide, without a grasp, or accepted by no drop-off.
fn ring_colour(why: Stays, paint: Paint) -> &'static str {
    match why {
        Stays::TooWide if paint != paint::TOO_WIDE => paint::TOO_WIDE_HATCH,
        Stays::NoGrasp if paint != paint::NO_GRASP => paint::NO_GRASP_HATCH,
        Stays::NotAccepted if paint != paint::NOT_ACCEPTED => paint::NOT_ACCEPTED_HATCH,
        _ => paint.line,
    }
}

fn title(id: &str, role: Role) -> String {
    match role {
        Role::Stays(why) if why != Stays::Fixed => format!("{id}: {}", why.words()),
        _ => id.to_owned(),
    }
}

/// The second ring of a fixed object and of the target.
fn inner_ring(footprint: &Footprint, share: f64, view: &View, line: &str) -> Outline {
    contour(footprint, share, view, line).set("stroke-width", px(outline(footprint, view)))
}

/// A stroke thin enough for the smallest of ten thousand discs, px.
pub(super) fn outline(footprint: &Footprint, view: &View) -> f64 {
    (view.length(footprint.circumradius()) * 0.06).min(1.5)
}
