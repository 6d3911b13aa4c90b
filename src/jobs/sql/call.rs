//! One write call: how long its caller waits, and how an abandoned transaction is undone.

use core::sync::atomic::{AtomicBool, Ordering};
use core::time::Duration;
use std::io::ErrorKind;
use std::sync::Arc;

use sqlx::Error;
use tokio::sync::oneshot::channel;
use tokio::time::error::Elapsed;
use tokio::time::{Instant, timeout};
use tokio_util::task::TaskTracker;

use crate::jobs::upkeep::Pause;

/// Extra waiting time for a commit that has begun, since it can't be taken back.
const COMMIT_PATIENCE: Duration = Duration::from_secs(2);

/// Whether a transaction commits. Task and caller compete for the decision: the first one wins.
#[derive(Debug, Clone, Default)]
pub(super) struct Decision(Arc<AtomicBool>);

impl Decision {
    /// The task decides to commit.
    ///
    /// # Errors
    /// The caller has given up.
    pub(super) fn commit(&self) -> Result<(), Error> {
        if self.decide() { Ok(()) } else { Err(given_up()) }
    }

    /// The decision is still open.
    ///
    /// # Errors
    /// The caller has given up.
    pub(super) fn open(&self) -> Result<(), Error> {
        if self.0.load(Ordering::Acquire) { Err(given_up()) } else { Ok(()) }
    }

    /// The caller gives up. True if nothing will be committed.
    fn give_up(&self) -> bool {
        self.decide()
    }

    /// True for the first to decide.
    fn decide(&self) -> bool {
        !self.0.swap(true, Ordering::AcqRel)
    }
}

/// The error of an abandoned call; nobody receives it.
fn given_up() -> Error {
    Error::Io(ErrorKind::TimedOut.into())
}

/// The result of `task`, which makes one transaction and commits it if `decision` allows. It runs as a spawned task,
/// which is never dropped: a transaction dropped while it begins would return its connection to the pool still open.
///
/// A caller gives up after `patience`, and the transaction is rolled back. If it is being committed, the caller waits a
/// little longer. If the caller gives up even so, `undo` takes the commit back. Once `tasks` is closed, nothing new
/// begins.
pub(super) async fn answer<T: Send + 'static, U: Future<Output = ()> + Send>(
    tasks: &TaskTracker,
    (patience, decision): (Duration, &Decision),
    task: impl Future<Output = Result<T, Error>> + Send + 'static,
    undo: impl FnOnce(T) -> U + Send + 'static,
) -> Result<Result<T, Error>, Elapsed> {
    if tasks.is_closed() {
        return Ok(Err(Error::PoolClosed));
    }
    let (sender, mut receiver) = channel();
    tasks.spawn(async move {
        if let Err(Ok(unheard)) = sender.send(task.await) {
            undo(unheard).await;
        }
    });
    let mut answer = timeout(patience, &mut receiver).await;
    if answer.is_err() && !decision.give_up() {
        answer = timeout(COMMIT_PATIENCE, &mut receiver).await;
    }
    match answer {
        Ok(answer) => Ok(answer.unwrap_or(Err(Error::WorkerCrashed))),
        Err(late) => {
            // From here on the answer counts as unheard; it may have come just before.
            receiver.close();
            receiver.try_recv().map_err(|_| late)
        }
    }
}

/// Retries until success or until the time is over.
pub(super) async fn insist<F: Future<Output = Result<(), Error>>>(time: Duration, work: impl Fn() -> F) {
    let (begin, mut pause) = (Instant::now(), Pause::default());
    while let Err(error) = work().await {
        tracing::debug!(%error, "what nobody has heard of could not be taken back yet");
        if begin.elapsed() >= time {
            return;
        }
        pause.pass().await;
    }
}

#[cfg(test)]
mod tests {
    use core::future::ready;

    use tokio::task::yield_now;

    use super::*;

    const NO_TIME: Duration = Duration::ZERO;

    #[tokio::test]
    async fn a_caller_who_gives_up_prevents_the_commit() {
        let (tasks, decision) = (TaskTracker::new(), Decision::default());
        let own = decision.clone();
        let task = async move {
            while own.open().is_ok() {
                yield_now().await;
            }
            own.commit()
        };
        let undo = |()| async { panic!("nothing was committed") };
        assert!(answer(&tasks, (NO_TIME, &decision), task, undo).await.is_err());
        assert!(decision.commit().is_err());
        tasks.close();
        tasks.wait().await;
    }

    #[tokio::test]
    async fn a_commit_that_has_begun_is_waited_for() {
        let (tasks, decision) = (TaskTracker::new(), Decision::default());
        decision.commit().unwrap();
        let task = async {
            yield_now().await;
            Ok(7)
        };
        let undo = |_| async { panic!("it was heard of") };
        assert_eq!(answer(&tasks, (NO_TIME, &decision), task, undo).await.unwrap().unwrap(), 7);
    }

    #[tokio::test]
    async fn nothing_begins_once_the_store_is_closed() {
        let tasks = TaskTracker::new();
        tasks.close();
        let answer = answer(&tasks, (NO_TIME, &Decision::default()), ready(Ok(())), |()| ready(())).await;
        assert!(matches!(answer, Ok(Err(Error::PoolClosed))));
    }
}
