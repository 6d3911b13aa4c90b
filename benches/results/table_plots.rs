//! The pictures of Table I.

use plotters::prelude::*;

use crate::plots::{FONT, Outcome, duration, float, key};
use crate::tables::{Column1, Table1};

const SIZE: (u32, u32) = (800, 420);
const BLUE: RGBColor = RGBColor(0, 114, 178);
const GREEN: RGBColor = RGBColor(0, 158, 115);
const ORANGE: RGBColor = RGBColor(213, 94, 0);
const GREY: RGBColor = RGBColor(110, 110, 110);
/// The axis of times, s.
const TIMES: core::ops::Range<f64> = 3e-7..120.0;

/// A name, a colour, filled or a ring, and the figure of a column.
type Line = (&'static str, RGBColor, bool, fn(&Column1) -> Option<f64>);

const LINES: [Line; 6] = [
    ("the paper's Base", GREY, false, |column| Some(column.printed("forward_astar").search_s_mean)),
    ("the paper's LOBS", BLUE, false, |column| Some(column.printed("lobs").search_s_mean)),
    ("our Base", GREY, true, |column| column.method("sector", "forward_astar").search_s_mean),
    ("our LOBS", BLUE, true, |column| column.method("sector", "lobs").search_s_mean),
    ("ours", ORANGE, true, |column| column.method("sector", "landmarks").search_s_mean),
    ("whole plan", GREEN, true, |column| column.plans.plan_s_mean),
];

/// Mean search time against N, and that of a whole plan by the swept finger.
pub(crate) fn times(table: &Table1) -> Outcome<String> {
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        root.fill(&WHITE)?;
        let mut chart = ChartBuilder::on(&root)
            .margin(10)
            .margin_top(55)
            .x_label_area_size(30)
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
            let figures = table.columns.iter().enumerate().filter_map(|(at, column)| Some((at, figure(column)?)));
            let points: Vec<(f64, f64)> = figures.map(|(at, seconds)| (float(at) + 0.5, seconds)).collect();
            chart.draw_series(LineSeries::new(points.iter().copied(), colour.stroke_width(1)))?;
            let style = if filled { colour.filled() } else { colour.stroke_width(2) };
            chart.draw_series(points.iter().map(|point| Circle::new(*point, 4, style)))?;
        }
        for (at, column) in table.columns.iter().enumerate() {
            let below = chart.backend_coord(&(float(at) + 0.5, TIMES.start));
            root.draw(&Text::new(format!("N={}", column.objects), (below.0 - 15, below.1 + 8), (FONT, 15)))?;
        }
        for (at, (name, colour, filled, _)) in LINES.into_iter().enumerate() {
            key(&root, at, (3, 200), name, (colour, filled))?;
        }
        root.present()?;
    }
    Ok(text)
}

/// Rates with their intervals: the paper's, ours by the sector model, ours by the swept finger.
pub(crate) fn deadlocks(table: &Table1) -> Outcome<String> {
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
            .y_desc("deadlocks")
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
    [("the paper (20 scenes)", BLUE), ("ours, sector model", GREY), ("ours, swept finger", ORANGE)];

fn rates(column: &Column1) -> [(Option<f64>, [f64; 2]); 3] {
    let printed = column.printed("lobs");
    let [sector, swept] = [column.method("sector", "lobs"), column.method("swept_finger", "landmarks")];
    [
        (Some(printed.deadlock_rate), printed.deadlock_interval),
        (sector.deadlock_rate, sector.deadlock_interval),
        (swept.deadlock_rate, swept.deadlock_interval),
    ]
}
