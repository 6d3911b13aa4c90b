//! How soon a core is free again once a computation is to end: its caller hangs up, or calls for the best so far.

use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use singulate::computation::Engine;
use singulate::wire::PlanRequest;
use singulate::workers::{Pool, PoolOutcome};
use tokio::runtime::Runtime;

/// How long the computation has run by then: in its knowledge, in its search, in its places.
const MOMENTS: [Duration; 5] = [
    Duration::from_millis(1),
    Duration::from_millis(5),
    Duration::from_millis(25),
    Duration::from_millis(100),
    Duration::from_millis(400),
];
const ROUNDS: usize = 5;

/// One way to end a computation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum End {
    HangUp,
    BestSoFar,
}

/// From when to when the ends took, the longest last; those that came by themselves first are left out.
pub(crate) fn ends(runtime: &Runtime, request: &Arc<PlanRequest>, end: End) -> Vec<(Instant, Instant)> {
    // One may still be on its way out when the next comes.
    let pool = Pool::new(1, 1).expect("a thread");
    let moments = MOMENTS.iter().flat_map(|moment| [moment; ROUNDS]);
    let mut taken: Vec<_> = moments.filter_map(|&moment| once(runtime, &pool, request, end, moment)).collect();
    taken.sort_unstable_by_key(|&(from, to)| to - from);
    taken
}

fn once(
    runtime: &Runtime,
    pool: &Pool,
    request: &Arc<PlanRequest>,
    end: End,
    moment: Duration,
) -> Option<(Instant, Instant)> {
    let own = Arc::clone(request);
    let plan = move |budget: &singulate_planner::budget::Budget<'_>| {
        (Engine::default().plan)(&own, budget, singulate_planner::search::SILENT).is_ok()
    };
    let pending = pool.submit("anonymous", Instant::now(), Duration::from_secs(60), plan).expect("room");
    thread::sleep(moment);
    if pool.idle() == 1 {
        return None;
    }
    let called = Instant::now();
    match end {
        End::HangUp => drop(pending),
        End::BestSoFar => {
            pending.recall().finish_soon();
            let outcome = runtime.block_on(pending.outcome());
            assert_eq!(outcome, PoolOutcome::Done(true), "the best so far is delivered");
        }
    }
    while pool.idle() == 0 {
        thread::sleep(Duration::from_micros(100));
    }
    Some((called, Instant::now()))
}
