//! Anything in any order, on a store and on the model: they agree after every step.

use core::time::Duration;
use std::collections::HashMap;
use std::sync::Arc;

use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use singulate::jobs::{
    Cancellation, Claim, End, Job, JobId, JobSettings, JobState, NewJob, Owner, Page, Removal, Renewal, Store,
    SubmitError, Swept, Timestamp, open,
};
use singulate_planner::cost::Cost;
use singulate_planner::search::Incumbent;

use crate::home::{Home, ann, at, bob, job};
use crate::model::{Model, Refusal};

/// Few enough that the queue is full now and then.
const MAX_QUEUED: usize = 6;
const WORKERS: usize = 3;

#[derive(Debug, Clone)]
enum Step {
    Submit {
        owner: bool,
        priority: i64,
        key: Option<u8>,
        digest: bool,
        count: u32,
    },
    Claim {
        worker: usize,
    },
    Renew {
        worker: usize,
    },
    Note {
        worker: usize,
        incumbent: Incumbent,
    },
    Finish {
        worker: usize,
        well: bool,
    },
    HandBack {
        worker: usize,
    },
    /// The worker forgets what it had. Otherwise it never does: it may speak long after its lease.
    Crash {
        worker: usize,
    },
    Cancel {
        pick: usize,
    },
    Forget {
        pick: usize,
    },
    Sweep,
    Wait {
        millis: u64,
    },
}

fn step() -> impl Strategy<Value = Step> {
    let worker = 0..WORKERS;
    let incumbent = (3..6_u64, 0..3_u64);
    let incumbent =
        incumbent.prop_map(|(cost, bound)| Incumbent { cost: Cost::new(cost), lower_bound: Cost::new(bound) });
    let key = prop::option::weighted(0.4, 0..3_u8);
    prop_oneof![
        6 => (any::<bool>(), 0..2_i64, key, prop::bool::weighted(0.9), 1..4_u32).prop_map(
            |(owner, priority, key, digest, count)| Step::Submit { owner, priority, key, digest, count }
        ),
        8 => worker.clone().prop_map(|worker| Step::Claim { worker }),
        2 => worker.clone().prop_map(|worker| Step::Renew { worker }),
        3 => (worker.clone(), incumbent).prop_map(|(worker, incumbent)| Step::Note { worker, incumbent }),
        4 => (worker.clone(), any::<bool>()).prop_map(|(worker, well)| Step::Finish { worker, well }),
        2 => worker.clone().prop_map(|worker| Step::HandBack { worker }),
        2 => worker.prop_map(|worker| Step::Crash { worker }),
        2 => any::<usize>().prop_map(|pick| Step::Cancel { pick }),
        1 => any::<usize>().prop_map(|pick| Step::Forget { pick }),
        5 => Just(Step::Sweep),
        5 => prop_oneof![Just(1), Just(60), Just(100), Just(400)].prop_map(|millis| Step::Wait { millis }),
    ]
}

/// A store, what should be in it, and what was seen.
struct Trial {
    store: Arc<dyn Store>,
    model: Model,
    now: Timestamp,
    workers: [Option<Claim>; WORKERS],
    /// Every job that was seen and not forgotten.
    seen: HashMap<JobId, Job>,
    fences: HashMap<JobId, i64>,
}

impl Trial {
    fn new(store: Arc<dyn Store>) -> Self {
        let (seen, fences) = (HashMap::new(), HashMap::new());
        Self { store, model: Model::default(), now: at(0), workers: [None; WORKERS], seen, fences }
    }

    async fn step(&mut self, step: &Step) {
        match *step {
            Step::Submit { owner, priority, key, digest, count } => {
                self.submit(owner, priority, key, digest, count).await
            }
            Step::Claim { worker } => self.claim(worker).await,
            Step::Crash { worker } => self.workers[worker] = None,
            Step::Cancel { pick } => self.cancel(pick).await,
            Step::Forget { pick } => self.forget(pick).await,
            Step::Sweep => {
                let (mut swept, mut expected) = (self.store.sweep(self.now).await.unwrap(), self.model.sweep(self.now));
                for Swept { requeued, poisoned, cancelled, expired, .. } in [&mut swept, &mut expected] {
                    for jobs in [requeued, poisoned, cancelled, expired] {
                        jobs.sort_unstable();
                    }
                }
                assert_eq!(swept, expected);
            }
            Step::Wait { millis } => self.now = self.now.after(Duration::from_millis(millis)),
            Step::Renew { worker }
            | Step::Note { worker, .. }
            | Step::Finish { worker, .. }
            | Step::HandBack { worker } => {
                if let Some(claim) = self.workers[worker] {
                    self.work(step, claim).await;
                }
            }
        }
    }

    async fn submit(&mut self, owner: bool, priority: i64, key: Option<u8>, digest: bool, count: u32) {
        let new = |position| NewJob {
            owner: if owner { ann() } else { bob() },
            key: key.map(|key| (format!("key {key}"), position)),
            request_sha256: format!("digest {digest}"),
            priority,
            ..job()
        };
        let jobs: Vec<NewJob> = (0..count).map(new).collect();
        let answer = self.store.submit(&jobs, self.now).await;
        match self.model.submit(&jobs, MAX_QUEUED, self.now) {
            Ok(ids) => assert_eq!(answer.unwrap().iter().map(|job| job.id).collect::<Vec<_>>(), ids),
            Err(Refusal::Full) => assert_eq!(answer, Err(SubmitError::Full)),
            Err(Refusal::KeyReused) => assert_eq!(answer, Err(SubmitError::KeyReused)),
        }
    }

    async fn claim(&mut self, worker: usize) {
        let work = self.store.claim(&self.now.into()).await.unwrap();
        let claim = self.model.claim(self.now);
        assert_eq!(work.as_ref().map(|work| work.claim), claim);
        let Some(work) = work else { return };
        let last = self.fences.insert(work.claim.id, work.claim.fence);
        assert!(last.is_none_or(|last| last < work.claim.fence), "a fence that grows");
        assert_eq!(work.attempt, self.model.find(work.claim.id).unwrap().job.attempts);
        self.workers[worker] = claim;
    }

    async fn work(&mut self, step: &Step, claim: Claim) {
        let (store, model, now) = (&self.store, &mut self.model, self.now);
        match step {
            Step::Renew { .. } => {
                let expected = match model.renew(claim, now) {
                    None => Renewal::Lost,
                    Some(true) => Renewal::Cancelled,
                    Some(false) => Renewal::Held,
                };
                assert_eq!(store.renew(claim, &now.into()).await.unwrap(), expected);
            }
            Step::Note { incumbent, .. } => {
                assert_eq!(store.note(claim, *incumbent, now).await.unwrap(), model.note(claim, *incumbent, now));
            }
            Step::Finish { well, .. } => {
                let text = format!("{{\"fence\":{}}}", claim.fence);
                let (end, answer) = if *well {
                    (End::Succeeded(text.as_str().parse().unwrap()), Ok(&*text))
                } else {
                    (End::Failed(text.as_str().parse().unwrap()), Err(&*text))
                };
                assert_eq!(store.finish(claim, &end, now).await.unwrap(), model.finish(claim, answer, now));
            }
            _ => assert_eq!(store.hand_back(claim, now).await.unwrap(), model.hand_back(claim, now)),
        }
    }

    /// One of the jobs that are there.
    fn pick(&self, pick: usize) -> Option<(Owner, JobId, JobState)> {
        let entry = self.model.entries.get(pick.checked_rem(self.model.entries.len())?)?;
        Some((entry.owner.clone(), entry.job.id, entry.job.state))
    }

    async fn cancel(&mut self, pick: usize) {
        let Some((owner, id, state)) = self.pick(pick) else { return };
        let answer = self.store.cancel(&owner, id, self.now).await.unwrap();
        assert_eq!(answer == Cancellation::Finished, state.finished());
        self.model.cancel(id, self.now);
    }

    async fn forget(&mut self, pick: usize) {
        let Some((owner, id, state)) = self.pick(pick) else { return };
        let answer = self.store.forget(&owner, id).await.unwrap();
        assert_eq!(answer, if state.finished() { Removal::Forgotten } else { Removal::Unfinished });
        if state.finished() {
            self.model.entries.retain(|entry| entry.job.id != id);
        }
    }

    /// What is in the store is what the model says, and follows from what was in it before.
    async fn agree(&mut self) {
        let mut seen = HashMap::new();
        for owner in [ann(), bob()] {
            let page = Page { state: None, before: None, limit: 1000 };
            let mut listed = self.store.list(&owner, page).await.unwrap();
            for job in listed.iter_mut().filter(|job| job.state.finished()) {
                *job = self.store.get(&owner, job.id).await.unwrap().unwrap();
            }
            let mut expected = self.model.list(&owner);
            for (job, stored) in expected.iter_mut().zip(&listed).filter(|(job, _)| job.state == JobState::Failed) {
                // The wording of the problem is the store's.
                job.problem =
                    job.problem.take().or_else(|| stored.problem.clone().filter(|text| text.contains("poison")));
            }
            assert_eq!(listed, expected);
            seen.extend(listed.into_iter().map(|job| (job.id, job)));
        }
        let counts = self.store.counts().await.unwrap();
        let count = |state| u64::try_from(self.model.count(state)).unwrap();
        assert_eq!((counts.queued, counts.running), (count(JobState::Queued), count(JobState::Running)));
        for (id, before) in &self.seen {
            lawful(before, seen.get(id));
        }
        self.seen = seen;
    }
}

/// Held against the table of states alone, whatever the model says.
fn lawful(before: &Job, after: Option<&Job>) {
    use JobState::{Cancelled, Expired, Failed, Queued, Running, Succeeded};
    let Some(after) = after else {
        return assert!(before.state.finished(), "a job is lost: {before:?}");
    };
    if before.state.finished() {
        return assert_eq!(before, after, "what has ended changes no more");
    }
    let allowed: &[JobState] = match before.state {
        Queued => &[Queued, Running, Cancelled, Expired],
        // From running to expired within one sweep: back to the queue after its time.
        _ => &[Running, Queued, Succeeded, Failed, Cancelled, Expired],
    };
    assert!(allowed.contains(&after.state), "from {:?} to {:?}", before.state, after.state);
    assert!(after.events.starts_with(&before.events), "events stay");
    assert!(after.attempts <= 3 && after.incumbent.is_some() >= before.incumbent.is_some());
}

/// So many sequences of steps, each on a store of its own.
fn try_out(cases: u32, runtime: &tokio::runtime::Runtime, store: impl Fn() -> Arc<dyn Store>) {
    let config = Config { cases, failure_persistence: None, max_shrink_iters: 2000, ..Config::default() };
    let steps = prop::collection::vec(step(), 1..80);
    let tried = TestRunner::new(config).run(&steps, |steps| {
        let mut trial = Trial::new(store());
        runtime.block_on(async {
            for step in &steps {
                trial.step(step).await;
                trial.agree().await;
            }
        });
        Ok(())
    });
    if let Err(error) = tried {
        panic!("{error}");
    }
}

fn runtime() -> tokio::runtime::Runtime {
    tokio::runtime::Builder::new_current_thread().enable_all().build().unwrap()
}

async fn small(settings: &JobSettings) -> Arc<dyn Store> {
    open(&JobSettings { max_queued: MAX_QUEUED, ..settings.clone() }, Arc::default()).await.unwrap()
}

#[test]
fn in_memory_anything_in_any_order_is_as_the_model_says() {
    let runtime = runtime();
    let home = runtime.block_on(Home::in_memory());
    try_out(200, &runtime, || runtime.block_on(small(&home.settings)));
}

#[test]
fn in_postgres_anything_in_any_order_is_as_the_model_says() {
    let runtime = runtime();
    let homes = core::cell::RefCell::new(Vec::new());
    if runtime.block_on(Home::in_postgres()).map(|home| homes.borrow_mut().push(home)).is_none() {
        return;
    }
    try_out(20, &runtime, || {
        let home = runtime.block_on(Home::in_postgres()).unwrap();
        let store = runtime.block_on(small(&home.settings));
        homes.borrow_mut().push(home);
        store
    });
    for home in homes.take() {
        runtime.block_on(home.remove());
    }
}
