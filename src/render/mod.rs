//! The scene and its answer as one drawing: SVG to scale, the same bytes for the same answer.
//!
//! It loads nothing: no fonts, no style sheets, no scripts. Ids are escaped as text, never mark-up.

mod discs;
mod headline;
mod label;
mod legend;
mod moves;
mod paint;
mod roles;
mod view;

pub use headline::headline;

use svg::Document;
use svg::node::element::{ClipPath, Definitions, Description, Group, Line, Pattern, Rectangle, Title};

use paint::px;
use roles::Roles;
use singulate_planner::plan::{Answer, Verdict};
use singulate_planner::scene::Scene;
use view::View;

/// Draw the scene with its answer: the table, the objects, and the numbered moves or the objects that lock each other.
pub fn svg(scene: &Scene, answer: &Answer) -> String {
    let view = View::new(scene, answer);
    let roles = Roles::new(scene, answer);
    let table = Group::new()
        .set("clip-path", "url(#frame)")
        .add(discs::table(scene, &view))
        .add(discs::standing(scene, &roles, &view))
        .add(steps(scene, answer, &view));
    let legend = legend::legend(scene, answer, &view);
    let height = view.height() + legend.height;
    let description = label::clean(&headline::description(scene, answer));
    Document::new()
        .set("viewBox", format!("0 0 {} {}", px(view.width()), px(height)))
        .set("width", px(view.width()))
        .set("height", px(height))
        .set("role", "img")
        .set("aria-labelledby", "title description")
        .set("font-family", "sans-serif")
        .add(Title::new(label::clean(&headline(answer))).set("id", "title"))
        .add(Description::new().set("id", "description").add(svg::node::Text::new(description)))
        .add(definitions(&view))
        .add(Rectangle::new().set("width", px(view.width())).set("height", px(height)).set("fill", paint::PAPER))
        .add(headline::block(scene, answer, &view))
        .add(table)
        .add(legend.drawing)
        .to_string()
}

/// The moves of a plan, the grasp of a free target, or the order of the needed objects.
fn steps(scene: &Scene, answer: &Answer, view: &View) -> Group {
    match &answer.verdict {
        Verdict::Relocate(plan) => moves::plan(scene, plan, view),
        Verdict::Graspable(grasp) => moves::target_grasp(scene, grasp, view),
        Verdict::NoSpace(known) | Verdict::TimedOut(known) => moves::needed(scene, known, view),
        Verdict::Deadlock(_) => Group::new(),
    }
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
