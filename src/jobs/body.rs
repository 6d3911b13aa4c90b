//! A job in its wire form.

use super::job::{Event, EventKind, Job, JobState};
use super::timestamp::Timestamp;
use crate::wire::{IncumbentBody, JobBody, JobStateWord};

impl Job {
    /// The job as it is served.
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
            incumbent: self.incumbent.map(IncumbentBody::from),
            result: self.result.clone(),
            problem: self.problem.clone(),
        }
    }

    /// The job as it was right after the event.
    #[must_use]
    pub fn as_of(&self, event: &Event) -> Self {
        let Event { attempts, incumbent, queue_position, .. } = *event;
        let then = Self { attempts, incumbent, queue_position, ..self.clone() };
        match event.kind {
            EventKind::Finished => then,
            EventKind::Queued => Self { state: JobState::Queued, started_at: None, ..then.unfinished() },
            EventKind::Running | EventKind::Incumbent => {
                Self { state: JobState::Running, started_at: self.begun_before(event), ..then.unfinished() }
            }
        }
    }

    /// The job without its end.
    fn unfinished(self) -> Self {
        // Before its end a job expires as long after `created_at` as it is kept after its end.
        let kept = |end| self.created_at.after(self.expires_at.since(end));
        let expires_at = self.finished_at.map_or(self.expires_at, kept);
        Self { finished_at: None, expires_at, result: None, problem: None, version: None, ..self }
    }

    /// The beginning of this event's attempt.
    fn begun_before(&self, event: &Event) -> Option<Timestamp> {
        let begins = |other: &&Event| {
            other.kind == EventKind::Running && other.attempts == event.attempts && other.at <= event.at
        };
        self.events.iter().rev().find(begins).map(|event| event.at)
    }
}

/// The body of a callback. It is the same for the same job and holds the job's id, since a receiver may get it twice.
pub(super) fn message(job: &Job) -> Vec<u8> {
    // It holds only strings and numbers.
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
