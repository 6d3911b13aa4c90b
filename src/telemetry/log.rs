//! Log lines on stderr, since stdout is for answers.

use std::borrow::Cow;
use std::io::{self, Write};

use tracing_subscriber::filter::{LevelFilter, Targets};
use tracing_subscriber::fmt::layer;
use tracing_subscriber::layer::SubscriberExt;
use tracing_subscriber::registry;
use tracing_subscriber::util::SubscriberInitExt;

/// The levels of a filter, from least to most verbose.
const LEVELS: [(&str, LevelFilter); 6] = [
    ("off", LevelFilter::OFF),
    ("error", LevelFilter::ERROR),
    ("warn", LevelFilter::WARN),
    ("info", LevelFilter::INFO),
    ("debug", LevelFilter::DEBUG),
    ("trace", LevelFilter::TRACE),
];

/// The default level. A mistyped part must not silence the service; only `off` does.
const DEFAULT: LevelFilter = LevelFilter::INFO;

/// The format of log lines.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum LogFormat {
    /// For humans.
    #[default]
    Text,
    /// One JSON object per line.
    Json,
}

/// The log filter: a level for all, and levels for parts of the program, `PART=LEVEL`, separated by commas.
///
/// # Errors
/// The fault of the filter, and the valid levels.
pub fn filter(text: &str) -> Result<Targets, String> {
    let (mut all, mut parts) = (DEFAULT, Targets::new());
    for entry in text.split(',').map(str::trim) {
        match entry.rsplit_once('=') {
            None => all = level(entry)?,
            Some((part, word)) => parts = parts.with_target(path(part.trim())?, level(word.trim())?),
        }
    }
    Ok(parts.with_default(all))
}

fn level(word: &str) -> Result<LevelFilter, String> {
    let found = LEVELS.iter().find(|(name, _)| name.eq_ignore_ascii_case(word));
    found.map(|(_, level)| *level).ok_or_else(|| {
        let [first @ .., last] = LEVELS.map(|(name, _)| name);
        let first = first.join(", ");
        format!(
            "'{word}' is no level: {first} or {last}; for a part of the program PART=LEVEL, such as singulate=debug"
        )
    })
}

/// The path of a module.
fn path(part: &str) -> Result<&str, String> {
    let letter = |c: char| c.is_ascii_alphanumeric() || "_-:".contains(c);
    if part.is_empty() || !part.chars().all(letter) {
        return Err(format!("'{part}' is no part of the program such as singulate or singulate::jobs"));
    }
    Ok(part)
}

/// Begin to log.
pub(super) fn init(log: &str, format: LogFormat) -> Result<(), String> {
    let filter = filter(log)?;
    let begun = match format {
        LogFormat::Text => registry().with(layer().with_ansi(false).with_writer(io::stderr)).with(filter).try_init(),
        LogFormat::Json => registry()
            .with(layer().json().flatten_event(true).with_span_list(false).with_writer(|| JsonLines))
            .with(filter)
            .try_init(),
    };
    begun.map_err(|error| error.to_string())
}

/// Stderr for JSON lines.
struct JsonLines;

impl Write for JsonLines {
    /// Takes a whole line at a time, as the logger writes it.
    fn write(&mut self, line: &[u8]) -> io::Result<usize> {
        io::stderr().write_all(&escaped(line))?;
        Ok(line.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        io::stderr().flush()
    }
}

/// The same JSON with DEL and the control characters U+0080 to U+009F escaped. JSON allows them unescaped, but
/// terminals obey them. They occur only in strings, where an escape is valid.
fn escaped(line: &[u8]) -> Cow<'_, [u8]> {
    let control = |at: usize| match (line[at], line.get(at + 1)) {
        (0x7f, _) => Some((1, 0x7f)),
        // U+0080 to U+009F in UTF-8.
        (0xc2, Some(&code @ 0x80..=0x9f)) => Some((2, code)),
        _ => None,
    };
    if (0..line.len()).all(|at| control(at).is_none()) {
        return Cow::Borrowed(line);
    }
    let (mut text, mut at) = (Vec::with_capacity(line.len() + 16), 0);
    while at < line.len() {
        let length = match control(at) {
            Some((length, code)) => {
                text.extend(format!("\\u{code:04x}").bytes());
                length
            }
            None => {
                text.push(line[at]);
                1
            }
        };
        at += length;
    }
    Cow::Owned(text)
}

#[cfg(test)]
mod tests {
    use tracing::Level;

    use super::*;

    #[test]
    fn a_filter_is_a_level_for_all_and_levels_for_parts() {
        let shown = |text: &str| {
            let filter = filter(text).unwrap();
            let ours =
                [Level::WARN, Level::INFO, Level::DEBUG].map(|level| filter.would_enable("singulate::jobs", &level));
            let others = [Level::WARN, Level::INFO, Level::DEBUG].map(|level| filter.would_enable("sqlx", &level));
            (ours, others)
        };
        let (none, warn, info, debug) = ([false; 3], [true, false, false], [true, true, false], [true; 3]);
        assert_eq!(shown("off"), (none, none));
        assert_eq!(shown("WARN"), (warn, warn));
        assert_eq!(shown("info,singulate=debug"), (debug, info));
        assert_eq!(shown(" singulate = debug , warn "), (debug, warn));
        assert_eq!(shown("singulate::jobs=off,warn"), (none, warn));
        // Unknown parts have the default level, so that a mistyped part silences nothing.
        assert_eq!(shown("singulate=debug"), (debug, info));
        assert_eq!(shown("singluate=debug"), (info, info));
    }

    #[test]
    fn an_invalid_log_filter_is_refused_with_the_known_levels() {
        for text in
            ["loud", "", "info,", "verbose,singulate=debug", "singulate", "singulate=loud", "singulate=", "3", "a b=c"]
        {
            let fault = filter(text).unwrap_err();
            assert!(text == "a b=c" || fault.contains("off, error, warn, info, debug or trace"), "{text}: {fault}");
        }
        for text in ["=debug", "a b=debug", "[request]=debug", "a=b=debug"] {
            assert!(filter(text).unwrap_err().contains("no part of the program"), "{text}");
        }
    }

    #[test]
    fn a_line_of_json_holds_no_control_character_and_says_the_same() {
        let text = "plain é\u{7f}\u{80}\u{9b}31m\u{9f}\u{a0}€";
        let line = serde_json::to_string(text).unwrap();
        let written = String::from_utf8(escaped(line.as_bytes()).into_owned()).unwrap();
        assert!(!written.chars().any(char::is_control), "{written:?}");
        assert_eq!(serde_json::from_str::<String>(&written).unwrap(), text);
        assert!(matches!(escaped("\"é€\"".as_bytes()), Cow::Borrowed(_)));
    }
}
