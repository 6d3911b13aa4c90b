//! Eight clients that hand jobs in.

use core::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tokio::task::JoinSet;
use tokio::time::{Instant, sleep};

use crate::client::{Client, id};
use crate::scenes::{Request, long};
use crate::{LOOK_AGAIN, PATIENCE};

const CLIENTS: usize = 8;

/// A request and the job that was accepted for it.
pub(crate) type Accepted = (Request, String);

/// What is being handed in.
pub(crate) struct Load {
    shared: Arc<Shared>,
    clients: JoinSet<()>,
}

struct Shared {
    client: Arc<Client>,
    requests: Vec<Request>,
    next: AtomicUsize,
    accepted: Mutex<Vec<Accepted>>,
}

impl Load {
    pub(crate) fn begin(client: &Arc<Client>, requests: Vec<Request>) -> Self {
        let (client, accepted) = (Arc::clone(client), Mutex::default());
        let shared = Arc::new(Shared { client, requests, next: AtomicUsize::new(0), accepted });
        let mut clients = JoinSet::new();
        for _ in 0..CLIENTS {
            clients.spawn(Arc::clone(&shared).submit());
        }
        Self { shared, clients }
    }

    /// Done once so many jobs have been accepted.
    pub(crate) async fn reaches(&self, count: usize) {
        let begin = Instant::now();
        loop {
            let accepted = self.shared.accepted().len();
            if accepted >= count {
                return;
            }
            assert!(begin.elapsed() < 2 * PATIENCE, "only {accepted} jobs of {count} are accepted");
            sleep(LOOK_AGAIN).await;
        }
    }

    /// All of them, once all are accepted.
    pub(crate) async fn accepted(self) -> Vec<Accepted> {
        // A client that failed fails the test.
        self.clients.join_all().await;
        self.shared.accepted().clone()
    }
}

impl Shared {
    async fn submit(self: Arc<Self>) {
        while let Some(request) = self.requests.get(self.next.fetch_add(1, Ordering::Relaxed)) {
            let job = self.client.submit(request).await;
            self.accepted().push((request.clone(), id(&job)));
        }
    }

    fn accepted(&self) -> MutexGuard<'_, Vec<Accepted>> {
        self.accepted.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Jobs that run so long, before all others, once all of them run at once.
pub(crate) async fn running(client: &Client, keys: &[&str], time_limit_ms: u64) -> Vec<Accepted> {
    let mut jobs = Vec::new();
    for key in keys {
        let request = long((*key).to_owned(), time_limit_ms);
        let job = id(&client.submit(&request).await);
        jobs.push((request, job));
    }
    let begin = Instant::now();
    loop {
        let running = client.list(Some("running")).await;
        if jobs.iter().all(|(_, id)| running.contains(id)) {
            return jobs;
        }
        assert!(begin.elapsed() < PATIENCE, "{keys:?} do not run");
        sleep(LOOK_AGAIN).await;
    }
}
