//! Scene and plan as SVG.

use crate::plan::Answer;
use crate::scene::Scene;

/// The drawing of a scene and its answer.
pub fn svg(scene: &Scene, _answer: &Answer) -> String {
    let (min, max) = (scene.table().top().min(), scene.table().top().max());
    let (width, height) = (max.x - min.x, max.y - min.y);
    format!(r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="{} {} {width} {height}"/>"#, min.x, min.y)
}
