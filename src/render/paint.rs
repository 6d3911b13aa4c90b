//! The colours and basic shapes.

use nalgebra::Point2;
use svg::node::element::Circle;

pub(super) const PAPER: &str = "#ffffff";
pub(super) const INK: &str = "#202124";
pub(super) const FAINT_INK: &str = "#5f6368";
pub(super) const TABLE: &str = "#fbf7ef";
pub(super) const TABLE_EDGE: &str = "#8d6e4a";
pub(super) const KEEP_OUT: &str = "#d7b9a0";
pub(super) const FIXED_HATCH: &str = "#b4b9be";
pub(super) const TOO_WIDE_HATCH: &str = "#e6b98a";
pub(super) const NO_GRASP_HATCH: &str = "#c3cf8f";
pub(super) const NOT_ACCEPTED_HATCH: &str = "#c3b1e1";

/// Fill and outline.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Paint {
    pub(super) fill: &'static str,
    pub(super) line: &'static str,
}

pub(super) const OBSTACLE: Paint = Paint { fill: "#e3e7ea", line: "#6b7177" };
pub(super) const FIXED: Paint = Paint { fill: "url(#fixed)", line: "#3c4043" };
/// As if fixed, since no hand spans it.
pub(super) const TOO_WIDE: Paint = Paint { fill: "url(#too-wide)", line: "#8a4b08" };
/// As if fixed, since it has no grasp.
pub(super) const NO_GRASP: Paint = Paint { fill: "url(#no-grasp)", line: "#55631a" };
/// As if fixed, since no drop-off accepts it.
pub(super) const NOT_ACCEPTED: Paint = Paint { fill: "url(#not-accepted)", line: "#5b3f94" };
pub(super) const TARGET: Paint = Paint { fill: "#ffd54f", line: "#8a5a00" };
/// A candidate, where another one is chosen.
pub(super) const CANDIDATE: Paint = Paint { fill: "#fff3c4", line: "#8a5a00" };
/// The old place of an object.
pub(super) const GHOST: Paint = Paint { fill: PAPER, line: FAINT_INK };
/// The old place of an object that is wanted away.
pub(super) const GHOST_OF_WANTED: Paint = Paint { fill: "#ffe082", line: "#8a5a00" };
/// Stays for want of room in a drop-off.
pub(super) const NO_ROOM: Paint = Paint { fill: "#e4d7f5", line: "#5b3f94" };
/// Stays behind others that stay, or for want of time.
pub(super) const NOT_REACHED: Paint = Paint { fill: "#cfe8ea", line: "#1f6f78" };
pub(super) const TRAY: Paint = Paint { fill: "#f1f3f4", line: "#5f6368" };
pub(super) const MOVED: Paint = Paint { fill: "#b7e1cd", line: "#137a43" };
pub(super) const NEEDED: Paint = Paint { fill: "#d7e3fc", line: "#1a56c4" };
pub(super) const CORE: Paint = Paint { fill: "#d32f2f", line: "#7f0000" };
pub(super) const BLOCKED: Paint = Paint { fill: "#f8caca", line: "#b3544f" };
/// The fingers at the grasp of an object.
pub(super) const GRASP: Paint = Paint { fill: "#1a73e8", line: "#0b4aa2" };
/// The fingers at its release.
pub(super) const RELEASE: Paint = Paint { fill: "#34a853", line: "#137a43" };
/// The fingers at the grasp of the target.
pub(super) const TARGET_GRASP: Paint = Paint { fill: "#f29900", line: "#8a5a00" };

/// The shape of a sign in the legend.
#[derive(Debug, Clone, Copy)]
pub(super) enum Sign {
    Disc(Paint),
    DoubleRing(Paint),
    Dashed,
    Number(Paint),
    Finger(Paint),
    Hatch,
    Palm,
    Tray,
}

/// A number of pixels, with two decimals: finer than any screen.
pub(super) fn px(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// An outline without a fill, px.
pub(super) fn ring(centre: Point2<f64>, radius: f64, line: &str) -> Circle {
    Circle::new()
        .set("cx", px(centre.x))
        .set("cy", px(centre.y))
        .set("r", px(radius))
        .set("fill", "none")
        .set("stroke", line)
}

/// Corner points as the `points` of a polygon.
pub(super) fn points(corners: impl IntoIterator<Item = Point2<f64>>) -> String {
    corners.into_iter().map(|p| format!("{},{}", px(p.x), px(p.y))).collect::<Vec<_>>().join(" ")
}
