//! The pictures of Table I.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::plots::{FONT, SearchOutcome, duration, float, key};
use crate::tables::{Column1, Table1};

const SIZE: (u32, u32) = (800, 420);
const BLUE: RGBColor = RGBColor(0, 114, 178);
const GREEN: RGBColor = RGBColor(0, 158, 115);
const ORANGE: RGBColor = RGBColor(213, 94, 0);
const GREY: RGBColor = RGBColor(110, 110, 110);
const CAPPED: RGBColor = RGBColor(0, 0, 0);
/// The axis of times, s.
const TIMES: core::ops::Range<f64> = 3e-7..120.0;

/// A name, a colour, filled or a ring, and of a column the figure and whether it holds searches that did not end.
type Line = (&'static str, RGBColor, bool, fn(&Column1) -> (Option<f64>, bool));

const LINES: [Line; 6] = [
    ("the paper's Base", GREY, false, |column| printed(column, "forward_astar")),
    ("the paper's LOBS", BLUE, false, |column| printed(column, "lobs")),
    ("our Base", GREY, true, |column| measured(column, "forward_astar")),
    ("our LOBS", BLUE, true, |column| measured(column, "lobs")),
    ("ours, sector", ORANGE, true, |column| measured(column, "landmarks")),
    ("whole plan, swept finger", GREEN, true, |column| (column.plans.plan_s_mean, column.plans.timed_out > 0)),
];

/// Of the paper's searches, those that are no success did not end.
fn printed(column: &Column1, method: &str) -> (Option<f64>, bool) {
    let printed = column.printed(method);
    (Some(printed.search_s_mean), printed.success_rate < 1.0)
}

fn measured(column: &Column1, method: &str) -> (Option<f64>, bool) {
    let method = column.method("sector", method);
    (method.search_s_mean, method.capped() > 0)
}

/// The columns of the paper's Case I, on one table; those after it are Case II, of one density.
const CASE_1: usize = 3;

/// Mean search time against N, and that of a whole plan by the swept finger.
pub(crate) fn times(table: &Table1) -> SearchOutcome<String> {
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        root.fill(&WHITE)?;
        let mut chart = ChartBuilder::on(&root)
            .margin(10)
            .margin_top(80)
            .x_label_area_size(50)
            .y_label_area_size(70)
            .build_cartesian_2d(0.0..float(table.columns.len()), TIMES.log_scale())?;
        chart
            .configure_mesh()
            .disable_x_mesh()
            .disable_x_axis()
            .light_line_style(WHITE)
            .y_desc("mean time")
            .y_label_formatter(&|seconds| duration(*seconds))
            .label_style((FONT, 14))
            .draw()?;
        for (_, colour, filled, figure) in LINES {
            let mark = |(at, column)| {
                let (seconds, capped) = figure(column);
                Some((at, (float(at) + 0.5, seconds?), capped))
            };
            let marks: Vec<_> = table.columns.iter().enumerate().filter_map(mark).collect();
            for case in [0..CASE_1, CASE_1..table.columns.len()] {
                let points = marks.iter().filter(|(at, ..)| case.contains(at)).map(|(_, point, _)| *point);
                chart.draw_series(LineSeries::new(points, colour.stroke_width(1)))?;
            }
            let style = if filled { colour.filled() } else { colour.stroke_width(2) };
            chart.draw_series(marks.iter().map(|(_, point, _)| Circle::new(*point, 4, style)))?;
            let capped = marks.iter().filter(|(.., capped)| *capped);
            chart.draw_series(capped.map(|(_, point, _)| Cross::new(*point, 7, CAPPED.stroke_width(1))))?;
        }
        caption(&root, &chart.backend_coord(&(float(table.columns.len()) / 2.0, TIMES.start)))?;
        for (at, column) in table.columns.iter().enumerate() {
            let below = chart.backend_coord(&(float(at) + 0.5, TIMES.start));
            root.draw(&Text::new(format!("N={}", column.objects), (below.0 - 15, below.1 + 8), (FONT, 15)))?;
        }
        for (at, (name, colour, filled, _)) in LINES.into_iter().enumerate() {
            key(&root, at, (3, 200), name, (colour, filled))?;
        }
        root.draw(&Cross::new((90, 61), 5, CAPPED.stroke_width(1)))?;
        root.draw(&Text::new("holds searches that did not end, counted as the limit", (100, 54), (FONT, 15)))?;
        root.present()?;
    }
    Ok(text)
}

/// What the columns are, below their names.
fn caption(root: &DrawingArea<SVGBackend<'_>, Shift>, middle: &(i32, i32)) -> SearchOutcome<()> {
    let text = "objects N: Case I on one table (16 to 20), Case II at one density (25 to 50)";
    root.draw(&Text::new(text, (middle.0 - 240, middle.1 + 28), (FONT, 15)))?;
    Ok(())
}

/// Rates with their intervals: the paper's, ours by the sector model, ours by the swept finger.
pub(crate) fn deadlocks(table: &Table1) -> SearchOutcome<String> {
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        root.fill(&WHITE)?;
        let mut chart = ChartBuilder::on(&root)
            .margin(10)
            .margin_top(35)
            .x_label_area_size(30)
            .y_label_area_size(70)
            .build_cartesian_2d(0.0..float(table.columns.len()), 0.0..1.0)?;
        chart
            .configure_mesh()
            .disable_x_mesh()
            .disable_x_axis()
            .light_line_style(WHITE)
            .y_labels(6)
            .y_desc("scenes called a deadlock, 95 % interval")
            .y_label_formatter(&|rate| format!("{:.0} %", rate * 100.0))
            .label_style((FONT, 14))
            .draw()?;
        for (at, column) in table.columns.iter().enumerate() {
            for (number, (rate, [low, high])) in rates(column).into_iter().enumerate() {
                let x = float(at) + 0.25 + 0.25 * float(number);
                let colour = SERIES[number].1;
                chart.draw_series([PathElement::new([(x, low), (x, high)], colour.stroke_width(2))])?;
                chart.draw_series(rate.map(|rate| Circle::new((x, rate), 4, colour.filled())))?;
            }
            let below = chart.backend_coord(&(float(at) + 0.5, 0.0));
            root.draw(&Text::new(format!("N={}", column.objects), (below.0 - 15, below.1 + 8), (FONT, 15)))?;
        }
        for (at, (name, colour)) in SERIES.into_iter().enumerate() {
            key(&root, at, (3, 220), name, (colour, true))?;
        }
        root.present()?;
    }
    Ok(text)
}

const SERIES: [(&str, RGBColor); 3] =
    [("the paper (20 scenes)", BLUE), ("our LOBS, sector model", GREY), ("ours, swept finger", ORANGE)];

fn rates(column: &Column1) -> [(Option<f64>, [f64; 2]); 3] {
    let printed = column.printed("lobs");
    let [sector, swept] = [column.method("sector", "lobs"), column.method("swept_finger", "landmarks")];
    [
        (Some(printed.deadlock_rate), printed.deadlock_interval),
        (sector.deadlock_rate, sector.deadlock_interval),
        (swept.deadlock_rate, swept.deadlock_interval),
    ]
}
