//! The picture of the peers, and what all pictures share.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::peers::{Instance, PEERS, Peers};

/// Drawing into a string fails only where a figure is no number.
pub(crate) type SearchOutcome<T> = Result<T, Box<dyn core::error::Error>>;

const SIZE: (u32, u32) = (1000, 520);
/// Named, not loaded: who looks at the picture has one.
pub(crate) const FONT: &str = "sans-serif";
/// Told apart by people who see few colours too (Okabe & Ito): ours, then the peers in order.
const COLOURS: [RGBColor; 4] =
    [RGBColor(213, 94, 0), RGBColor(0, 114, 178), RGBColor(0, 158, 115), RGBColor(110, 110, 110)];
/// A ring in the legend stands for every colour.
const UNFINISHED: RGBColor = RGBColor(110, 110, 110);
const SEPARATOR: RGBColor = RGBColor(225, 225, 225);
/// The axis of times, s.
const FASTEST: f64 = 5e-7;
const SLOWEST: f64 = 60.0;

/// Every instance's time: a column a class, in it a strip a solver, in it the instances from left to right. A solver that
/// did not finish has a ring at its limit.
pub(crate) fn peers(peers: &Peers) -> SearchOutcome<String> {
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        root.fill(&WHITE)?;
        let classes = peers.classes();
        let mut chart = ChartBuilder::on(&root)
            .margin(10)
            .margin_top(30)
            .x_label_area_size(30)
            .y_label_area_size(70)
            .build_cartesian_2d(0.0..float(classes.len()), (FASTEST..SLOWEST).log_scale())?;
        chart
            .configure_mesh()
            .disable_x_mesh()
            .disable_x_axis()
            .light_line_style(WHITE)
            .y_desc("time from base to proven optimum")
            .y_label_formatter(&|seconds| duration(*seconds))
            .label_style((FONT, 14))
            .draw()?;
        let between =
            (1..classes.len()).map(|at| PathElement::new([(float(at), FASTEST), (float(at), SLOWEST)], SEPARATOR));
        chart.draw_series(between)?;
        for (at, (name, instances)) in classes.iter().enumerate() {
            let ours = |instance: &Instance| instance.ours();
            chart.draw_series(strip(at, 0, instances, peers.time_limit_seconds, ours))?;
            for (number, (key, _)) in PEERS.iter().enumerate() {
                let theirs = |instance: &Instance| instance.peer(key);
                chart.draw_series(strip(at, number + 1, instances, peers.limit(key), theirs))?;
            }
            let below = chart.backend_coord(&(float(at) + 0.5, FASTEST));
            root.draw(&Text::new(*name, (below.0 - 5 * half(name), below.1 + 8), (FONT, 15)))?;
        }
        let names = ["ours"].into_iter().chain(PEERS.map(|(_, name)| name));
        for (at, (name, colour)) in names.zip(COLOURS).enumerate() {
            key(&root, at, (5, 120), name, (colour, true))?;
        }
        key(&root, 4, (5, 120), "not finished within the limit", (UNFINISHED, false))?;
        root.present()?;
    }
    Ok(text)
}

/// One solver's instances of one class.
fn strip(
    class: usize,
    solver: usize,
    instances: &[&Instance],
    limit: f64,
    time: impl Fn(&Instance) -> f64,
) -> Vec<Circle<(f64, f64), i32>> {
    let place = |at: usize| {
        let within = (float(at) + 0.5) / float(instances.len());
        float(class) + 0.06 + (float(solver) + 0.08 + 0.84 * within) * 0.22
    };
    let mark = |(at, instance): (usize, &&Instance)| {
        let seconds = time(instance);
        let colour = COLOURS[solver];
        let style = if seconds.is_finite() { colour.mix(0.7).filled() } else { colour.stroke_width(1) };
        Circle::new((place(at), seconds.min(limit).max(FASTEST)), 3, style)
    };
    instances.iter().enumerate().map(mark).collect()
}

/// An entry of the legend above a plot: number `at` of rows of `columns`, each `width` pixels wide.
pub(crate) fn key(
    root: &DrawingArea<SVGBackend<'_>, Shift>,
    at: usize,
    (columns, width): (usize, i32),
    name: &str,
    (colour, filled): (RGBColor, bool),
) -> SearchOutcome<()> {
    let (row, column) = (i32::try_from(at / columns)?, i32::try_from(at % columns)?);
    let (x, y) = (90 + column * width, 17 + row * 22);
    let style = if filled { colour.filled() } else { colour.stroke_width(2) };
    root.draw(&Circle::new((x, y), 4, style))?;
    root.draw(&Text::new(name.to_owned(), (x + 10, y - 7), (FONT, 15)))?;
    Ok(())
}

/// A label of an axis of seconds.
pub(crate) fn duration(seconds: f64) -> String {
    match seconds {
        s if s >= 0.999 => format!("{s:.0} s"),
        s if s >= 0.999e-3 => format!("{:.0} ms", s * 1e3),
        s => format!("{:.0} µs", s * 1e6),
    }
}

/// Half a word's length in letters.
fn half(word: &str) -> i32 {
    i32::try_from(word.len() / 2).expect("a short word")
}

/// As a float.
pub(crate) fn float(count: usize) -> f64 {
    f64::from(u32::try_from(count).expect("a small count"))
}
