//! What a store does, in the plainest words: a list of jobs and one rule a question. Slow, in memory, obvious.

use core::cmp::Reverse;

use singulate::jobs::{Claim, Event, EventKind, Job, JobId, JobState, MAX_ATTEMPTS, NewJob, Owner, Swept, Timestamp};
use singulate::wire::RawJson;
use singulate_planner::search::Incumbent;

use crate::home::{LEASE, TTL};

/// A job, and what its owner doesn't see of it.
#[derive(Debug, Clone)]
pub(crate) struct Entry {
    pub(crate) job: Job,
    pub(crate) owner: Owner,
    pub(crate) key: Option<(String, u32)>,
    digest: String,
    priority: i64,
    turn: i64,
    fence: i64,
    lease_ends: Timestamp,
    cancel_requested: bool,
    /// The fence of the claim that ended it.
    ended_by: Option<i64>,
}

impl Entry {
    fn tell(&mut self, kind: EventKind, now: Timestamp) {
        let Job { attempts, incumbent, .. } = self.job;
        self.job.events.push(Event { kind, at: now, attempts, incumbent, queue_position: None });
    }

    fn end(&mut self, state: JobState, now: Timestamp) {
        self.job.state = state;
        self.job.finished_at = Some(now);
        self.job.expires_at = now.after(TTL);
        self.job.version = Some(env!("CARGO_PKG_VERSION").to_owned());
        self.tell(EventKind::Finished, now);
    }
}

#[derive(Debug, Default)]
pub(crate) struct Model {
    pub(crate) entries: Vec<Entry>,
}

/// Why nothing was accepted.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Refusal {
    Full,
    KeyReused,
}

impl Model {
    pub(crate) fn submit(&mut self, jobs: &[NewJob], max: usize, now: Timestamp) -> Result<Vec<JobId>, Refusal> {
        if let Some((key, _)) = &jobs[0].key {
            let named = |entry: &&Entry| {
                entry.owner == jobs[0].owner && entry.key.as_ref().is_some_and(|(known, _)| known == key)
            };
            let mut known: Vec<&Entry> = self.entries.iter().filter(named).collect();
            known.sort_by_key(|entry| entry.key.as_ref().map(|(_, position)| *position));
            if let Some(first) = known.first() {
                let same = first.digest == jobs[0].request_sha256;
                return if same {
                    Ok(known.iter().map(|entry| entry.job.id).collect())
                } else {
                    Err(Refusal::KeyReused)
                };
            }
        }
        if self.count(JobState::Queued) + jobs.len() > max {
            return Err(Refusal::Full);
        }
        for new in jobs {
            let turn = self.turn(new);
            self.entries.push(entry(new, turn, now));
        }
        self.tell_places();
        Ok(jobs.iter().map(|job| job.id).collect())
    }

    fn turn(&self, new: &NewJob) -> i64 {
        let peers = || {
            self.entries.iter().filter(|entry| entry.job.state == JobState::Queued && entry.priority == new.priority)
        };
        let own = peers().filter(|entry| entry.owner == new.owner).map(|entry| entry.turn + 1).max();
        own.max(peers().map(|entry| entry.turn).min()).unwrap_or(0)
    }

    pub(crate) fn count(&self, state: JobState) -> usize {
        self.entries.iter().filter(|entry| entry.job.state == state).count()
    }

    /// Jobs that have just been queued are told their places.
    fn tell_places(&mut self) {
        let queue: Vec<JobId> = self.queue().iter().map(|entry| entry.job.id).collect();
        for (id, place) in queue.into_iter().zip(1..) {
            let told = self.find(id).and_then(|entry| entry.job.events.last_mut());
            told.unwrap().queue_position.get_or_insert(place);
        }
    }

    /// The waiting jobs, first the one that is claimed next.
    fn queue(&self) -> Vec<&Entry> {
        let mut queue: Vec<&Entry> = self.entries.iter().filter(|entry| entry.job.state == JobState::Queued).collect();
        queue.sort_by_key(|entry| (Reverse(entry.priority), entry.turn, entry.job.id));
        queue
    }

    pub(crate) fn find(&mut self, id: JobId) -> Option<&mut Entry> {
        self.entries.iter_mut().find(|entry| entry.job.id == id)
    }

    pub(crate) fn claim(&mut self, now: Timestamp) -> Option<Claim> {
        let next = self.queue().into_iter().find(|entry| entry.job.expires_at > now)?.job.id;
        let entry = self.find(next)?;
        entry.fence += 1;
        entry.lease_ends = now.after(LEASE);
        entry.job.state = JobState::Running;
        entry.job.attempts += 1;
        entry.job.started_at = Some(now);
        entry.tell(EventKind::Running, now);
        Some(Claim { id: next, fence: entry.fence })
    }

    /// The job, if this claim is the one that counts.
    fn held(&mut self, claim: Claim) -> Option<&mut Entry> {
        self.find(claim.id).filter(|entry| entry.job.state == JobState::Running && entry.fence == claim.fence)
    }

    /// Whether the claim held, and whether the job was cancelled.
    pub(crate) fn renew(&mut self, claim: Claim, now: Timestamp) -> Option<bool> {
        let entry = self.held(claim)?;
        entry.lease_ends = now.after(LEASE);
        Some(entry.cancel_requested)
    }

    pub(crate) fn note(&mut self, claim: Claim, incumbent: Incumbent, now: Timestamp) -> bool {
        let Some(entry) = self.held(claim) else { return false };
        let known = entry.job.incumbent.unwrap_or(incumbent);
        let cost = known.cost.min(incumbent.cost);
        let best = Some(Incumbent { cost, lower_bound: known.lower_bound.max(incumbent.lower_bound) });
        if entry.job.incumbent != best {
            entry.job.incumbent = best;
            entry.tell(EventKind::Incumbent, now);
        }
        true
    }

    pub(crate) fn finish(&mut self, claim: Claim, answer: Result<&str, &str>, now: Timestamp) -> bool {
        let Some(entry) = self.held(claim) else {
            return self.find(claim.id).is_some_and(|entry| entry.ended_by == Some(claim.fence));
        };
        entry.ended_by = Some(claim.fence);
        let kept = |text: &str| text.parse::<RawJson>().expect("JSON");
        entry.job.result = answer.ok().map(kept);
        entry.job.problem = answer.err().filter(|_| !entry.cancel_requested).map(kept);
        let state = match answer {
            _ if entry.cancel_requested => JobState::Cancelled,
            Ok(_) => JobState::Succeeded,
            Err(_) => JobState::Failed,
        };
        entry.end(state, now);
        true
    }

    pub(crate) fn hand_back(&mut self, claim: Claim, now: Timestamp) -> bool {
        let Some(entry) = self.held(claim) else { return false };
        if entry.cancel_requested {
            entry.end(JobState::Cancelled, now);
            return true;
        }
        entry.job.state = JobState::Queued;
        entry.job.attempts -= 1;
        if entry.job.attempts == 0 {
            entry.job.started_at = None;
        }
        entry.tell(EventKind::Queued, now);
        self.tell_places();
        true
    }

    pub(crate) fn cancel(&mut self, id: JobId, now: Timestamp) {
        let entry = self.find(id).unwrap();
        match entry.job.state {
            JobState::Queued => entry.end(JobState::Cancelled, now),
            JobState::Running => entry.cancel_requested = true,
            _ => {}
        }
    }

    pub(crate) fn sweep(&mut self, now: Timestamp) -> Swept {
        let mut swept = Swept::default();
        let overdue = |entry: &&mut Entry| entry.job.state == JobState::Running && entry.lease_ends <= now;
        for entry in self.entries.iter_mut().filter(overdue) {
            if entry.cancel_requested {
                swept.cancelled.push(entry.job.id);
                entry.end(JobState::Cancelled, now);
            } else if entry.job.attempts == MAX_ATTEMPTS {
                swept.poisoned.push(entry.job.id);
                entry.end(JobState::Failed, now);
            } else {
                swept.requeued.push(entry.job.id);
                entry.job.state = JobState::Queued;
                entry.tell(EventKind::Queued, now);
            }
        }
        self.tell_places();
        let late = |entry: &&mut Entry| entry.job.state == JobState::Queued && entry.job.expires_at <= now;
        for entry in self.entries.iter_mut().filter(late) {
            swept.expired.push(entry.job.id);
            entry.end(JobState::Expired, now);
        }
        let before = self.entries.len();
        self.entries.retain(|entry| !(entry.job.state.finished() && entry.job.expires_at <= now));
        swept.forgotten = u64::try_from(before - self.entries.len()).unwrap();
        swept
    }

    /// The owner's jobs as a list shows them, but with their results.
    pub(crate) fn list(&self, owner: &Owner) -> Vec<Job> {
        let queue = self.queue();
        let place =
            |id: JobId| queue.iter().position(|entry| entry.job.id == id).map(|at| u64::try_from(at + 1).unwrap());
        let own = self.entries.iter().filter(|entry| entry.owner == *owner);
        let mut jobs: Vec<Job> =
            own.map(|entry| Job { queue_position: place(entry.job.id), ..entry.job.clone() }).collect();
        jobs.sort_by_key(|job| Reverse(job.id));
        jobs
    }
}

fn entry(new: &NewJob, turn: i64, now: Timestamp) -> Entry {
    let job = Job {
        id: new.id,
        state: JobState::Queued,
        scene_id: new.scene_id.clone(),
        scene_sha256: new.scene_sha256.clone(),
        created_at: now,
        started_at: None,
        finished_at: None,
        expires_at: now.after(TTL),
        attempts: 0,
        queue_position: None,
        incumbent: None,
        result: None,
        problem: None,
        version: None,
        events: Vec::new(),
    };
    let mut entry = Entry {
        job,
        owner: new.owner.clone(),
        key: new.key.clone(),
        digest: new.request_sha256.clone(),
        priority: new.priority,
        turn,
        fence: 0,
        lease_ends: now,
        cancel_requested: false,
        ended_by: None,
    };
    entry.tell(EventKind::Queued, now);
    entry
}
