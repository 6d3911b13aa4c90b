//! Jobs as rows: reads them, and writes their events as text, one line each, so that a new event is appended.

use core::str::FromStr;

use sqlx::any::AnyRow;
use sqlx::{AnyConnection, AssertSqlSafe, Error, Row};

use crate::jobs::{Event, EventKind, Job, JobId, JobState, Owner, Page, Timestamp};
use crate::wire::RawJson;
use singulate_planner::cost::Cost;
use singulate_planner::search::Incumbent;

/// The columns of a job without its result and its place in the queue.
const COLUMNS: &str = "jobs.id, jobs.state, jobs.scene_id, jobs.scene_sha256, jobs.created_at, jobs.started_at, \
    jobs.finished_at, jobs.expires_at, jobs.attempts, jobs.cost, jobs.lower_bound, jobs.problem, jobs.version, jobs.events";
/// The places of all jobs: the whole queue is counted once.
const PLACES: &str = "LEFT JOIN (SELECT id AS queued_id, ROW_NUMBER() OVER (ORDER BY priority DESC, turn, id) \
    AS queue_position FROM jobs WHERE state = 'queued') AS places ON places.queued_id = jobs.id";

/// The place in the queue for this priority and turn: counts the jobs that are claimed before.
pub(super) fn place(priority: &str, turn: &str, id: &str) -> String {
    format!(
        "(SELECT COUNT(*) + 1 FROM jobs AS other WHERE other.state = 'queued' AND (other.priority > {priority} \
         OR (other.priority = {priority} AND (other.turn < {turn} OR (other.turn = {turn} AND other.id < {id})))))"
    )
}

/// A job by its id, of this owner or of any.
pub(super) async fn find(
    connection: &mut AnyConnection,
    owner: Option<&Owner>,
    id: JobId,
) -> Result<Option<Job>, Error> {
    let owned = if owner.is_some() { " AND owner = $2" } else { "" };
    let place = place("jobs.priority", "jobs.turn", "jobs.id");
    let text = format!(
        "SELECT {COLUMNS}, jobs.result, CASE WHEN jobs.state = 'queued' THEN {place} END AS queue_position \
         FROM jobs WHERE id = $1{owned}"
    );
    let mut query = sqlx::query(AssertSqlSafe(text)).bind(id.to_string());
    if let Some(owner) = owner {
        query = query.bind(owner.as_str());
    }
    query.fetch_optional(connection).await?.as_ref().map(job).transpose()
}

/// These jobs in this order, without those that are gone.
pub(super) async fn find_all(connection: &mut AnyConnection, ids: &[JobId]) -> Result<Vec<Job>, Error> {
    let (first, last) = match (ids.iter().min(), ids.iter().max()) {
        (Some(first), Some(last)) if first != last => (first, last),
        (Some(only), _) => return Ok(find(connection, None, *only).await?.into_iter().collect()),
        _ => return Ok(Vec::new()),
    };
    // Ids of one request are close together, so hardly any other rows are read.
    let text = format!("SELECT {COLUMNS}, jobs.result, queue_position FROM jobs {PLACES} WHERE id BETWEEN $1 AND $2");
    let query = sqlx::query(AssertSqlSafe(text)).bind(first.to_string()).bind(last.to_string());
    let mut found = query.fetch_all(connection).await?.iter().map(job).collect::<Result<Vec<Job>, Error>>()?;
    let mut jobs = Vec::with_capacity(ids.len());
    for id in ids {
        if let Some(at) = found.iter().position(|job| job.id == *id) {
            jobs.push(found.swap_remove(at));
        }
    }
    Ok(jobs)
}

/// The owner's jobs without their results, the latest first.
pub(super) async fn list(connection: &mut AnyConnection, owner: &Owner, page: Page) -> Result<Vec<Job>, Error> {
    let mut text = format!("SELECT {COLUMNS}, NULL AS result, queue_position FROM jobs {PLACES} WHERE owner = $1");
    let mut values = vec![owner.as_str().to_owned()];
    if let Some(state) = page.state {
        values.push(state.as_str().to_owned());
        text.push_str(&format!(" AND state = ${}", values.len()));
    }
    if let Some(before) = page.before {
        values.push(before.to_string());
        text.push_str(&format!(" AND id < ${}", values.len()));
    }
    text.push_str(&format!(" ORDER BY id DESC LIMIT ${}", values.len() + 1));
    let query = values.into_iter().fold(sqlx::query(AssertSqlSafe(text)), |query, value| query.bind(value));
    let query = query.bind(i64::try_from(page.limit).unwrap_or(i64::MAX));
    query.fetch_all(connection).await?.iter().map(job).collect()
}

fn job(row: &AnyRow) -> Result<Job, Error> {
    let scene_id: Option<Vec<u8>> = row.try_get("scene_id")?;
    Ok(Job {
        id: id(row)?,
        state: state(row)?,
        scene_id: scene_id.map(String::from_utf8).transpose().map_err(|error| Error::Decode(error.into()))?,
        scene_sha256: row.try_get("scene_sha256")?,
        created_at: time(row, "created_at")?,
        started_at: optional_time(row, "started_at")?,
        finished_at: optional_time(row, "finished_at")?,
        expires_at: time(row, "expires_at")?,
        attempts: whole(row, "attempts")?,
        queue_position: row.try_get::<Option<i64>, _>("queue_position")?.map(narrow).transpose()?,
        incumbent: incumbent(row)?,
        result: raw_json(row, "result")?,
        problem: raw_json(row, "problem")?,
        version: row.try_get("version")?,
        events: events(row)?,
    })
}

fn raw_json(row: &AnyRow, column: &str) -> Result<Option<RawJson>, Error> {
    // A row edited by hand to invalid JSON reads as absent, so that lists are still served.
    Ok(row.try_get::<Option<&str>, _>(column)?.and_then(|text| text.parse().ok()))
}

pub(super) fn events(row: &AnyRow) -> Result<Vec<Event>, Error> {
    let lines: String = row.try_get("events")?;
    read_events(&lines).ok_or_else(|| Error::Decode(format!("no events: {lines:?}").into()))
}

pub(super) fn id(row: &AnyRow) -> Result<JobId, Error> {
    row.try_get::<&str, _>("id")?.parse().map_err(|error| Error::Decode(Box::new(error)))
}

pub(super) fn state(row: &AnyRow) -> Result<JobState, Error> {
    let word: &str = row.try_get("state")?;
    word.parse().map_err(|()| Error::Decode(format!("no state: {word:?}").into()))
}

pub(super) fn incumbent(row: &AnyRow) -> Result<Option<Incumbent>, Error> {
    let cost: Option<i64> = row.try_get("cost")?;
    let Some(cost) = cost else { return Ok(None) };
    let lower_bound = Cost::new(whole(row, "lower_bound")?);
    Ok(Some(Incumbent { cost: Cost::new(narrow(cost)?), lower_bound }))
}

pub(super) fn time(row: &AnyRow, column: &str) -> Result<Timestamp, Error> {
    row.try_get(column).map(Timestamp::from_millis)
}

fn optional_time(row: &AnyRow, column: &str) -> Result<Option<Timestamp>, Error> {
    Ok(row.try_get::<Option<i64>, _>(column)?.map(Timestamp::from_millis))
}

/// A number that is never negative.
pub(super) fn whole<T: TryFrom<i64>>(row: &AnyRow, column: &str) -> Result<T, Error> {
    narrow(row.try_get(column)?)
}

fn narrow<T: TryFrom<i64>>(number: i64) -> Result<T, Error> {
    T::try_from(number).map_err(|_| Error::Decode(format!("{number} can't be").into()))
}

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
pub(super) fn read_events(lines: &str) -> Option<Vec<Event>> {
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
        Some(cost) => {
            Some(Incumbent { cost: Cost::new(number(cost)?), lower_bound: Cost::new(number(words.next()?)?) })
        }
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
    fn an_event_line_reads_as_it_was_written() {
        let incumbents = [None, Some(Incumbent { cost: Cost::new(7), lower_bound: Cost::new(2) })];
        let at = Timestamp::from_millis(-42);
        let events: Vec<Event> = KINDS
            .into_iter()
            .flat_map(|kind| incumbents.map(|incumbent| (kind, incumbent)))
            .flat_map(|(kind, incumbent)| [None, Some(12)].map(|place| (kind, incumbent, place)))
            .map(|(kind, incumbent, queue_position)| Event { kind, at, attempts: 3, incumbent, queue_position })
            .collect();
        let lines: String = events.iter().map(line).collect();
        assert_eq!(read_events(&lines).unwrap(), events);
        assert_eq!(read_events(""), Some(Vec::new()));
    }

    #[test]
    fn a_malformed_event_line_is_refused() {
        for lines in [
            "waiting 1 0\n",
            "queued 1\n",
            "queued 1 0 3\n",
            "queued 1 0 3 2 1\n",
            "queued 1 -1\n",
            "queued 1 0 @\n",
            "\n",
        ] {
            assert_eq!(read_events(lines), None, "{lines:?}");
        }
    }
}
