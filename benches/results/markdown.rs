//! Tables, text and numbers as the page shows them.

use singulate::experiments::ConfidenceInterval;

/// How wide a line may be. Headings, tables and pictures are as wide as they are.
const WIDTH: usize = 120;

/// The text with its paragraphs and bullets broken into lines.
pub(crate) fn wrapped(text: &str) -> String {
    let line = |line: &str| if line.starts_with(['#', '|', '!']) { line.to_owned() } else { broken(line) };
    text.lines().map(line).collect::<Vec<_>>().join("\n") + "\n"
}

fn broken(paragraph: &str) -> String {
    let indent = if paragraph.starts_with("* ") { "\n  " } else { "\n" };
    let mut text = String::new();
    let mut width = 0;
    for word in paragraph.split(' ') {
        let length = word.chars().count();
        if width > 0 && width + 1 + length > WIDTH {
            text += indent;
            width = indent.len() - 1;
        } else if width > 0 {
            text.push(' ');
            width += 1;
        }
        text += word;
        width += length;
    }
    text
}

/// A table of contents: a link to each heading of the text.
pub(crate) fn contents(text: &str) -> String {
    let headings = text.lines().filter(|line| line.starts_with("##")).map(|line| line.trim_start_matches(['#', ' ']));
    let anchor = |heading: &str| {
        heading.to_lowercase().replace(|c: char| !c.is_alphanumeric() && !" -_".contains(c), "").replace(' ', "-")
    };
    let links: Vec<String> = headings.map(|heading| format!("[{heading}](#{})", anchor(heading))).collect();
    format!("Contents: {}", links.join(" · "))
}

/// A table: rows of cells, of which the first is the head.
pub(crate) fn table(rows: &[Vec<String>]) -> String {
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let rule = line(&vec!["---".to_owned(); rows[0].len()]);
    rows.iter().enumerate().map(|(at, row)| if at == 0 { line(row) + &rule } else { line(row) }).collect()
}

/// Cells of one row.
pub(crate) fn row<const N: usize>(cells: [&str; N]) -> Vec<String> {
    cells.map(str::to_owned).to_vec()
}

/// Three digits, or as many as stand before the point; from 1,000 on with commas. No more than four behind the point.
pub(crate) fn digits(value: f64) -> String {
    let places = match value {
        v if v >= 99.95 => 0,
        v if v >= 9.995 => 1,
        v if v >= 0.9995 => 2,
        v if v >= 0.09995 => 3,
        _ => 4,
    };
    let text = format!("{value:.places$}");
    if places > 0 { text } else { with_commas(&text) }
}

/// A count; from 1,000 on with commas.
pub(crate) fn count(count: u32) -> String {
    with_commas(&count.to_string())
}

fn with_commas(text: &str) -> String {
    let digit = |(at, digit): (usize, char)| {
        let comma = at > 0 && (text.len() - at).is_multiple_of(3);
        comma.then_some(',').into_iter().chain([digit])
    };
    text.chars().enumerate().flat_map(digit).collect()
}

/// Seconds in the unit that suits them.
pub(crate) fn time(seconds: f64) -> String {
    match seconds {
        s if s >= 0.09995 => format!("{} s", digits(s)),
        s if s >= 0.9995e-3 => format!("{} ms", digits(s * 1e3)),
        s => format!("{} µs", digits(s * 1e6)),
    }
}

/// A length in the unit that suits it.
pub(crate) fn length(metres: f64) -> String {
    match metres {
        m if m >= 0.9995e-3 => format!("{} mm", digits(m * 1e3)),
        m if m > 0.0 => format!("{} µm", digits(m * 1e6)),
        _ => "0".to_owned(),
    }
}

/// A length that somebody chose, in millimetres with no more digits than it has.
pub(crate) fn millimetres(metres: f64) -> String {
    format!("{} mm", (metres * 1e6).round() / 1e3)
}

/// A rate from 0 to 1.
pub(crate) fn percent(rate: f64) -> String {
    let percent = rate * 100.0;
    if (percent - percent.round()).abs() < 1e-9 { format!("{percent:.0} %") } else { format!("{percent:.1} %") }
}

/// Or a dash where there is nothing.
pub(crate) fn or_dash<T>(value: Option<T>, show: impl Fn(T) -> String) -> String {
    value.map_or_else(|| "–".to_owned(), show)
}

/// A rate with the ends of its interval in whole percent.
pub(crate) fn interval(rate: Option<f64>, [low, high]: [f64; 2]) -> String {
    let whole = |rate: f64| format!("{:.0}", rate * 100.0);
    or_dash(rate, |rate| format!("{} ({} to {})", percent(rate), whole(low), whole(high)))
}

/// A rate with its 95 % interval, of counts.
pub(crate) fn share(part: u32, whole: u32) -> String {
    let ConfidenceInterval { low, high } = ConfidenceInterval::wilson(part as usize, whole as usize);
    interval(ratio(part, whole), [low, high])
}

/// A part of a whole; `None` of nothing.
pub(crate) fn ratio(part: u32, whole: u32) -> Option<f64> {
    (whole > 0).then(|| f64::from(part) / f64::from(whole))
}

/// Words with commas, and an "and" before the last.
pub(crate) fn listed(words: &[String]) -> String {
    words.split_last().map_or_else(String::new, |(last, others)| {
        if others.is_empty() { last.clone() } else { format!("{} and {last}", others.join(", ")) }
    })
}
