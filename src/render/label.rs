//! Text: the characters that XML allows, cut to size.

use nalgebra::Point2;
use svg::node::element::Text;

use super::paint::px;

/// The least readable size, px.
pub(super) const LEAST_SIZE: f64 = 7.0;
/// The largest size, px.
pub(super) const LARGEST_SIZE: f64 = 20.0;
/// A generous average of a character's width, as a share of the font size, since sans-serif fonts differ.
const CHARACTER_WIDTH: f64 = 0.6;

/// The text without the characters that XML 1.0 forbids even when escaped, and on one line.
pub(super) fn clean(text: &str) -> String {
    let admitted =
        |c: &char| matches!(c, '\t' | '\n' | '\r' | ' '..='\u{d7ff}' | '\u{e000}'..='\u{fffd}' | '\u{10000}'..);
    let one_line = |c: char| if c.is_whitespace() || c.is_control() { ' ' } else { c };
    text.chars().filter(admitted).map(one_line).collect()
}

/// The approximate width of the text, px. Non-Latin scripts count as square.
pub(super) fn width(text: &str, size: f64) -> f64 {
    text.chars().map(|c| if u32::from(c) < 0x250 { CHARACTER_WIDTH } else { 1.0 }).sum::<f64>() * size
}

/// The text and its size for a width of `room`, px: made smaller first, then cut short. `None` if nothing readable
/// fits.
pub(super) fn fit(text: &str, largest: f64, room: f64) -> Option<(String, f64)> {
    let text = clean(text);
    let size = (room / width(&text, 1.0).max(CHARACTER_WIDTH)).min(largest);
    if size >= LEAST_SIZE {
        return Some((text, size));
    }
    if largest < LEAST_SIZE {
        return None;
    }
    let mut short = String::new();
    for c in text.chars() {
        if width(&short, LEAST_SIZE) + width("m", LEAST_SIZE) + width("…", LEAST_SIZE) > room {
            break;
        }
        short.push(c);
    }
    // One letter and an ellipsis say nothing.
    (short.chars().count() >= 3).then(|| (short + "…", LEAST_SIZE))
}

/// Text centred at `at`.
pub(super) fn centred(text: &str, size: f64, at: Point2<f64>) -> Text {
    // A baseline a third of the size below the middle centres digits and lower case alike; not every viewer supports
    // `dominant-baseline`.
    line(text, size, Point2::new(at.x, at.y + 0.35 * size)).set("text-anchor", "middle")
}

/// Text that starts at `at`, the left end of its baseline.
pub(super) fn line(text: &str, size: f64, at: Point2<f64>) -> Text {
    Text::new(clean(text)).set("x", px(at.x)).set("y", px(at.y)).set("font-size", px(size))
}
