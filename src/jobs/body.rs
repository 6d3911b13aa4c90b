//! A job in the words of the wire.

use serde_json::value::RawValue;

use super::job::{Event, EventKind, Job, JobState};
use crate::wire::{IncumbentBody, JobBody, JobStateWord};
use singulate_planner::budget::Incumbent;

impl Job {
    /// As it is served.
    pub fn body(&self) -> JobBody {
        JobBody {
            id: self.id.to_string(),
            state: word(self.state),
            scene_id: self.scene_id.clone(),
            created_at: self.created_at.to_string(),
            started_at: self.started_at.map(|at| at.to_string()),
            finished_at: self.finished_at.map(|at| at.to_string()),
            expires_at: self.expires_at.to_string(),
            attempts: self.attempts,
            queue_position: self.queue_position,
            scene_sha256: self.scene_sha256.clone(),
            version: self.version.clone().unwrap_or_else(|| env!("CARGO_PKG_VERSION").to_owned()),
            incumbent: self.incumbent.map(|Incumbent { cost, lower_bound }| IncumbentBody { cost, lower_bound }),
            result: self.result.clone().and_then(raw),
            problem: self.problem.clone().and_then(raw),
        }
    }

    /// As it was served, or would have been, right after the event.
    #[must_use]
    pub fn as_of(&self, event: &Event) -> Self {
        let Event { attempts, incumbent, queue_position, .. } = *event;
        let then = Self { attempts, incumbent, queue_position, ..self.clone() };
        // As long after its beginning as it is kept after its end.
        let expires_at =
            then.finished_at.map_or(then.expires_at, |end| then.created_at.after(then.expires_at.since(end)));
        let unfinished =
            Self { finished_at: None, expires_at, result: None, problem: None, version: None, ..then.clone() };
        let begun =
            self.events.iter().rev().find(|other| {
                other.kind == EventKind::Running && other.attempts == event.attempts && other.at <= event.at
            });
        match event.kind {
            EventKind::Finished => then,
            EventKind::Queued => Self { state: JobState::Queued, started_at: None, ..unfinished },
            EventKind::Running | EventKind::Incumbent => {
                Self { state: JobState::Running, started_at: begun.map(|event| event.at), ..unfinished }
            }
        }
    }
}

/// The body of a callback.
pub fn message(job: &Job) -> Vec<u8> {
    // It is made of strings and numbers.
    serde_json::to_vec(&job.body()).unwrap_or_default()
}

fn word(state: JobState) -> JobStateWord {
    match state {
        JobState::Queued => JobStateWord::Queued,
        JobState::Running => JobStateWord::Running,
        JobState::Succeeded => JobStateWord::Succeeded,
        JobState::Failed => JobStateWord::Failed,
        JobState::Cancelled => JobStateWord::Cancelled,
        JobState::Expired => JobStateWord::Expired,
    }
}

/// What was kept was written as JSON by us.
fn raw(json: String) -> Option<Box<RawValue>> {
    RawValue::from_string(json).ok()
}
