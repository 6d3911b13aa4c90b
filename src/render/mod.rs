//! The scene and its answer as one drawing: SVG to scale, the same bytes for the same answer.
//!
//! It loads nothing: no fonts, no style sheets, no scripts. Ids are escaped as text, never mark-up.

mod headline;
mod label;
mod legend;
mod moves;
mod objects;
mod paint;
mod roles;
mod view;

pub use headline::headline;

use svg::Document;
use svg::node::element::{ClipPath, Definitions, Description, Group, Line, Pattern, Rectangle, Title};

use paint::px;
use roles::Roles;
use singulate_planner::paper::Judged;
use singulate_planner::scene::Scene;
use singulate_planner::statement::Statement;
use view::View;

/// Draw the scene with its answer: the table, the objects, and the numbered moves or the objects that lock each other.
pub fn svg(scene: &Scene, judged: &Judged) -> String {
    let stated = judged.statement();
    let roles = Roles::new(scene, stated);
    let view = View::new(scene, stated, &roles);
    let table = Group::new()
        .set("clip-path", "url(#frame)")
        .add(objects::table(scene, &view))
        .add(objects::standing(scene, &roles, &view))
        .add(steps(scene, stated, &roles, &view));
    let legend = legend::legend(scene, stated, &view);
    let height = view.height() + legend.height;
    let description = label::clean(&headline::description(scene, judged));
    Document::new()
        .set("viewBox", format!("0 0 {} {}", px(view.width()), px(height)))
        .set("width", px(view.width()))
        .set("height", px(height))
        .set("role", "img")
        .set("aria-labelledby", "title description")
        .set("font-family", "sans-serif")
        .add(Title::new(label::clean(&headline(judged))).set("id", "title"))
        .add(Description::new().set("id", "description").add(svg::node::Text::new(description)))
        .add(definitions(&view))
        .add(Rectangle::new().set("width", px(view.width())).set("height", px(height)).set("fill", paint::PAPER))
        .add(headline::block(scene, judged, &view))
        .add(table)
        .add(legend.drawing)
        .to_string()
}

/// The moves of a plan, the grasp of a free target, or the order of the needed objects.
fn steps(scene: &Scene, stated: &Statement, roles: &Roles<'_>, view: &View) -> Group {
    let group = Group::new();
    if !stated.steps().is_empty() {
        return moves::plan(scene, stated, roles, view);
    }
    if let Some(grasp) = stated.target_grasp {
        let grasped = roles.grasped(stated);
        return grasped.map(|object| moves::target_grasp(scene, object, grasp, view)).unwrap_or_default();
    }
    stated.needed.iter().fold(group, |_, needed| moves::needed(needed, roles, view))
}

fn definitions(view: &View) -> Definitions {
    let (x, y, width, height) = view.frame();
    let frame = Rectangle::new().set("x", px(x)).set("y", px(y)).set("width", px(width)).set("height", px(height));
    Definitions::new()
        .add(ClipPath::new().set("id", "frame").add(frame))
        .add(hatch("keep-out", paint::KEEP_OUT, 8.0))
        .add(hatch("fixed", paint::FIXED_HATCH, 5.0))
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
