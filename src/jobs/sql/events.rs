//! Events as text in a job's row, one line each, so that a new event is appended.

use core::str::FromStr;

use crate::jobs::{Event, EventKind, Timestamp};
use singulate_planner::search::Incumbent;

const KINDS: [EventKind; 4] = [EventKind::Queued, EventKind::Running, EventKind::Incumbent, EventKind::Finished];

/// The line of an event: kind, milliseconds, attempts, cost and bound, the place in the queue.
pub(super) fn line(event: &Event) -> String {
    match event.queue_position {
        Some(place) => format!("{}{place}\n", up_to_the_place(event)),
        None => words(event) + "\n",
    }
}

/// The line of an event without the queue position and the newline, which the database adds.
pub(super) fn up_to_the_place(event: &Event) -> String {
    words(event) + " @"
}

fn words(event: &Event) -> String {
    let (kind, at, attempts) = (event.kind.as_str(), event.at.as_millis(), event.attempts);
    match event.incumbent {
        Some(Incumbent { cost, lower_bound }) => format!("{kind} {at} {attempts} {cost} {lower_bound}"),
        None => format!("{kind} {at} {attempts}"),
    }
}

/// The events of these lines; `None` if a line is invalid.
pub(super) fn read(lines: &str) -> Option<Vec<Event>> {
    lines.lines().map(event).collect()
}

fn event(line: &str) -> Option<Event> {
    let (line, queue_position) = match line.split_once(" @") {
        Some((line, place)) => (line, Some(number(place)?)),
        None => (line, None),
    };
    let mut words = line.split(' ');
    let kind = words.next()?;
    let kind = KINDS.into_iter().find(|known| known.as_str() == kind)?;
    let at = Timestamp::from_millis(number(words.next()?)?);
    let attempts = number(words.next()?)?;
    let incumbent = match words.next() {
        Some(cost) => Some(Incumbent { cost: number(cost)?, lower_bound: number(words.next()?)? }),
        None => None,
    };
    words.next().is_none().then_some(Event { kind, at, attempts, incumbent, queue_position })
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
        let at = Timestamp::from_millis(-42);
        let events: Vec<Event> = KINDS
            .into_iter()
            .flat_map(|kind| incumbents.map(|incumbent| (kind, incumbent)))
            .flat_map(|(kind, incumbent)| [None, Some(12)].map(|place| (kind, incumbent, place)))
            .map(|(kind, incumbent, queue_position)| Event { kind, at, attempts: 3, incumbent, queue_position })
            .collect();
        let lines: String = events.iter().map(line).collect();
        assert_eq!(read(&lines).unwrap(), events);
        assert_eq!(read(""), Some(Vec::new()));
    }

    #[test]
    fn what_is_no_event_is_not_read() {
        for lines in [
            "waiting 1 0\n",
            "queued 1\n",
            "queued 1 0 3\n",
            "queued 1 0 3 2 1\n",
            "queued 1 -1\n",
            "queued 1 0 @\n",
            "\n",
        ] {
            assert_eq!(read(lines), None, "{lines:?}");
        }
    }
}
