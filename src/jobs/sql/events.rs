//! Events as they stand in a job's row: one line each, so that one more is text at the end.

use core::str::FromStr;

use crate::budget::Incumbent;
use crate::jobs::{Event, EventKind, Timestamp};

const KINDS: [EventKind; 4] = [EventKind::Queued, EventKind::Running, EventKind::Incumbent, EventKind::Finished];

/// The line of an event: kind, milliseconds, attempts, cost, bound.
pub(super) fn line(event: &Event) -> String {
    let Event { kind, at, attempts, incumbent } = event;
    let (kind, at) = (kind.as_str(), at.as_millis());
    match incumbent {
        Some(Incumbent { cost, lower_bound }) => format!("{kind} {at} {attempts} {cost} {lower_bound}\n"),
        None => format!("{kind} {at} {attempts}\n"),
    }
}

/// The events of these lines; nothing where one is none.
pub(super) fn read(lines: &str) -> Option<Vec<Event>> {
    lines.lines().map(event).collect()
}

fn event(line: &str) -> Option<Event> {
    let mut words = line.split(' ');
    let kind = words.next()?;
    let kind = KINDS.into_iter().find(|known| known.as_str() == kind)?;
    let at = Timestamp::from_millis(number(words.next()?)?);
    let attempts = number(words.next()?)?;
    let incumbent = match words.next() {
        Some(cost) => Some(Incumbent { cost: number(cost)?, lower_bound: number(words.next()?)? }),
        None => None,
    };
    words.next().is_none().then_some(Event { kind, at, attempts, incumbent })
}

fn number<T: FromStr>(word: &str) -> Option<T> {
    word.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_what_is_read() {
        let incumbents = [None, Some(Incumbent { cost: 7, lower_bound: 2 })];
        let events: Vec<Event> = KINDS
            .into_iter()
            .flat_map(|kind| incumbents.map(|incumbent| (kind, incumbent)))
            .map(|(kind, incumbent)| Event { kind, at: Timestamp::from_millis(-42), attempts: 3, incumbent })
            .collect();
        let lines: String = events.iter().map(line).collect();
        assert_eq!(read(&lines).unwrap(), events);
        assert_eq!(read(""), Some(Vec::new()));
    }

    #[test]
    fn what_is_no_event_is_not_read() {
        for lines in ["waiting 1 0\n", "queued 1\n", "queued 1 0 3\n", "queued 1 0 3 2 1\n", "queued 1 -1\n", "\n"] {
            assert_eq!(read(lines), None, "{lines:?}");
        }
    }
}
