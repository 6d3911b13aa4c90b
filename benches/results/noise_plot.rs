//! The picture of success against the margin.

use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

use singulate::experiments::ConfidenceInterval;

use crate::markdown::millimetres;
use crate::noise::{ENOUGH, Noise};
use crate::plots::{FONT, SearchOutcome, float, key};

const SIZE: (u32, u32) = (800, 420);
/// Told apart by people who see few colours too (Okabe & Ito): a sigma each, and again from the first.
const COLOURS: [RGBColor; 6] = [
    RGBColor(0, 114, 178),
    RGBColor(0, 158, 115),
    RGBColor(110, 110, 110),
    RGBColor(213, 94, 0),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
];
const THRESHOLD: RGBColor = RGBColor(170, 170, 170);
/// Between two lines at the same margin, in widths of the plot, so that intervals don't cover each other.
const BESIDE: f64 = 0.006;

type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// A point of a line: margin in m, rate, its interval.
struct Mark {
    margin: f64,
    rate: f64,
    interval: ConfidenceInterval,
}

/// Success with its interval against the margin, a line for each sigma, for the least yaw tolerance.
pub(crate) fn success(noise: &Noise) -> SearchOutcome<String> {
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        root.fill(&WHITE)?;
        let (sigmas, margins) = (noise.values(|cell| cell.sigma), noise.values(|cell| cell.margin));
        let lines: Vec<Vec<Mark>> = sigmas.iter().map(|sigma| marks(noise, *sigma, &margins)).collect();
        let (width, floor) = (margins[margins.len() - 1].max(1e-3), floor(&lines));
        let mut chart = ChartBuilder::on(&root)
            .margin(10)
            .margin_top(35)
            .x_label_area_size(50)
            .y_label_area_size(70)
            .build_cartesian_2d(-0.04 * width..1.04 * width, floor..1.0)?;
        chart
            .configure_mesh()
            .disable_x_mesh()
            .disable_x_axis()
            .light_line_style(WHITE)
            .y_labels(6)
            .y_desc("success, 95 % interval")
            .y_label_formatter(&|rate| format!("{:.0} %", rate * 100.0))
            .label_style((FONT, 14))
            .draw()?;
        let threshold = [(-0.04 * width, ENOUGH), (1.04 * width, ENOUGH)];
        chart.draw_series([PathElement::new(threshold, THRESHOLD.stroke_width(1))])?;
        for (at, (sigma, line)) in sigmas.iter().zip(&lines).enumerate() {
            let colour = COLOURS[at % COLOURS.len()];
            let beside = (float(at) - (float(lines.len()) - 1.0) / 2.0) * BESIDE * width;
            draw(&mut chart, line, beside, colour)?;
            key(&root, at, (5, 130), &format!("σ = {}", millimetres(*sigma)), (colour, true))?;
        }
        for margin in &margins {
            let below = chart.backend_coord(&(*margin, floor));
            let label = millimetres(*margin);
            root.draw(&Text::new(label, (below.0 - 15, below.1 + 8), (FONT, 15)))?;
        }
        let middle = chart.backend_coord(&(width / 2.0, floor));
        root.draw(&Text::new("margin", (middle.0 - 25, middle.1 + 28), (FONT, 15)))?;
        root.present()?;
    }
    Ok(text)
}

/// The margins at which some episode was judged.
fn marks(noise: &Noise, sigma: f64, margins: &[f64]) -> Vec<Mark> {
    let tolerance = noise.values(|cell| cell.yaw_tolerance)[0];
    let mark = |&margin: &f64| {
        let pool = noise.pool(|cell| cell.is(sigma, tolerance, margin));
        let (success, judged) = pool.success();
        let interval = ConfidenceInterval::wilson(success as usize, judged as usize);
        Some(Mark { margin, rate: pool.success_rate()?, interval })
    };
    margins.iter().filter_map(mark).collect()
}

/// Where the axis of rates begins: a multiple of a tenth below all intervals.
fn floor(lines: &[Vec<Mark>]) -> f64 {
    let least = lines.iter().flatten().map(|mark| mark.interval.low).fold(ENOUGH, f64::min);
    (least * 10.0).floor() / 10.0
}

fn draw(chart: &mut Chart<'_, '_>, line: &[Mark], beside: f64, colour: RGBColor) -> SearchOutcome<()> {
    let point = |mark: &Mark| (mark.margin + beside, mark.rate);
    chart.draw_series(LineSeries::new(line.iter().map(point), colour.stroke_width(1)))?;
    let interval = |mark: &Mark| [mark.interval.low, mark.interval.high].map(|rate| (mark.margin + beside, rate));
    chart.draw_series(line.iter().map(|mark| PathElement::new(interval(mark), colour.stroke_width(2))))?;
    chart.draw_series(line.iter().map(|mark| Circle::new(point(mark), 4, colour.filled())))?;
    Ok(())
}
