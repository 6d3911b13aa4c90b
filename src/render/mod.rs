//! The scene and its answer as one drawing: SVG to scale, the same bytes for the same answer.
//!
//! It loads nothing: no fonts, no style sheets, no scripts. Ids are escaped as text, never mark-up.

mod fill;
mod hand;
mod headline;
mod held;
mod label;
mod legend;
mod lines;
mod moves;
mod names;
mod objects;
mod outline;
mod paint;
mod phrases;
mod roles;
mod scene_line;
mod stays;
mod trays;
mod view;

pub use fill::{Fill, fills};
pub use headline::headline;
pub use phrases::turn;
pub use scene_line::goal;
pub use stays::{immovable, left};

use svg::Document;
use svg::node::element::{ClipPath, Definitions, Description, Group, Line, Pattern, Rectangle, Title};

use lines::Lines;
use paint::px;
use roles::Roles;
use singulate_planner::paper::Judged;
use singulate_planner::scene::Scene;
use singulate_planner::statement::Statement;
use stays::Stays;
use view::View;

/// Draw the scene with its answer: the table, the objects, and the numbered moves or the objects that lock each other;
/// the drop-offs below.
pub fn svg(scene: &Scene, judged: &Judged) -> String {
    let stated = judged.statement();
    let roles = Roles::new(scene, stated);
    let lines = Lines::new(scene, judged);
    let view = View::new(scene, stated, &roles, lines.added);
    let table = Group::new()
        .set("clip-path", "url(#frame)")
        .add(objects::table(scene, &view))
        .add(objects::standing(scene, &roles, &view))
        .add(steps(scene, stated, &roles, &view));
    let trays = trays::trays(scene, stated, &moves::moves(stated, &roles), &view);
    let legend = legend::legend(scene, stated, &roles, &view, trays.height);
    let height = view.height() + trays.height + legend.height;
    let description = label::clean(&lines::description(scene, judged));
    let drawing = Document::new()
        .set("viewBox", format!("0 0 {} {}", px(view.width()), px(height)))
        .set("width", px(view.width()))
        .set("height", px(height))
        .set("role", "img")
        .set("aria-labelledby", "title description")
        .set("font-family", "sans-serif")
        .add(Title::new(label::clean(&headline(scene, judged))).set("id", "title"))
        .add(Description::new().set("id", "description").add(svg::node::Text::new(description)))
        .add(definitions(&view, &roles))
        .add(Rectangle::new().set("width", px(view.width())).set("height", px(height)).set("fill", paint::PAPER))
        .add(lines.drawn(&view))
        .add(table);
    let drawing = if scene.drop_offs().is_empty() { drawing } else { drawing.add(trays.drawing) };
    drawing.add(legend.drawing).to_string()
}

/// The moves of a plan, the grasp of a free target, or the order of the needed objects.
fn steps(scene: &Scene, stated: &Statement, roles: &Roles<'_>, view: &View) -> Group {
    let group = Group::new();
    if !stated.steps().is_empty() {
        return moves::plan(scene, stated, roles, view);
    }
    if let Some(grasp) = stated.target_grasp {
        return roles.grasped().map(|object| moves::target_grasp(scene, object, grasp, view)).unwrap_or_default();
    }
    stated.needed.iter().fold(group, |_, needed| moves::needed(needed, roles, view))
}

fn definitions(view: &View, roles: &Roles<'_>) -> Definitions {
    let (x, y, width, height) = view.frame();
    let frame = Rectangle::new().set("x", px(x)).set("y", px(y)).set("width", px(width)).set("height", px(height));
    let definitions = Definitions::new()
        .add(ClipPath::new().set("id", "frame").add(frame))
        .add(hatch("keep-out", paint::KEEP_OUT, 8.0))
        .add(hatch("fixed", paint::FIXED_HATCH, 5.0));
    let as_if_fixed = [
        (Stays::TooWide, "too-wide", paint::TOO_WIDE_HATCH),
        (Stays::NoGrasp, "no-grasp", paint::NO_GRASP_HATCH),
        (Stays::NotAccepted, "not-accepted", paint::NOT_ACCEPTED_HATCH),
    ];
    let occurring = as_if_fixed.into_iter().filter(|(reason, ..)| roles.any_immovable(*reason));
    occurring.fold(definitions, |definitions, (_, id, colour)| definitions.add(hatch(id, colour, 5.0)))
}

/// Stripes at 45 degrees.
fn hatch(id: &str, colour: &str, spacing: f64) -> Pattern {
    let stripe = Line::new().set("y2", px(spacing)).set("stroke", colour).set("stroke-width", px(spacing / 2.0));
    Pattern::new()
        .set("id", id)
        .set("width", px(spacing))
        .set("height", px(spacing))
        .set("patternUnits", "userSpaceOnUse")
        .set("patternTransform", "rotate(45)")
        .add(stripe)
}

#[cfg(test)]
mod tests;
