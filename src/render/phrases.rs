//! Counts with their nouns, turns, and lists that are cut short.

/// The count and its noun, with a plural s unless the count is 1: `1 object`, `3 objects`.
pub(super) fn counted(count: u64, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}

/// The `first` of `count` names, and how many are left out: `a, b and 3 more`.
pub(super) fn listed(first: &[String], count: usize) -> String {
    let more = match count.saturating_sub(first.len()) {
        0 => String::new(),
        more => format!(" and {more} more"),
    };
    first.join(", ") + &more
}

/// How far an object turns, counter-clockwise: `+90.0°`. `None` where it does not.
pub fn turn(turn: f64) -> Option<String> {
    let text = format!("{:+.1}°", turn.to_degrees());
    (!["+0.0°", "-0.0°"].contains(&&text[..])).then_some(text)
}
