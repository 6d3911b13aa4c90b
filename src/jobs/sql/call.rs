//! One call that writes: how long its caller waits, and what becomes of the transaction once nobody does.

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

/// How long a caller waits besides for a commit that has begun, which can't be taken back.
const COMMIT_PATIENCE: Duration = Duration::from_secs(2);

/// Whether a transaction is committed. Its task and its caller decide it together: the first one does.
#[derive(Debug, Clone, Default)]
pub(super) struct Decision(Arc<AtomicBool>);

impl Decision {
    /// The task may commit.
    ///
    /// # Errors
    /// The caller has given up.
    pub(super) fn commit(&self) -> Result<(), Error> {
        if self.decide() { Ok(()) } else { Err(given_up()) }
    }

    /// Nothing is decided yet.
    ///
    /// # Errors
    /// The caller has given up.
    pub(super) fn open(&self) -> Result<(), Error> {
        if self.0.load(Ordering::Acquire) { Err(given_up()) } else { Ok(()) }
    }

    /// True if nothing will be committed.
    fn give_up(&self) -> bool {
        self.decide()
    }

    /// True for whoever decides.
    fn decide(&self) -> bool {
        !self.0.swap(true, Ordering::AcqRel)
    }
}

/// Nobody hears of it.
fn given_up() -> Error {
    Error::Io(ErrorKind::TimedOut.into())
}

/// What `task` answers, which makes one transaction and commits it if `decision` allows. A task of its own does it, which
/// nobody drops: a transaction that is dropped while it begins would go back to the pool with its connection, still open.
///
/// A caller who has waited for `patience` gives up, and the transaction is rolled back. If it is just being committed, he
/// waits a little longer. What was committed and nobody has heard of, because he went all the same, `undo` takes back.
/// Once `tasks` is closed, nothing new begins.
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
            // From here on it counts as unheard; until now it may have come.
            receiver.close();
            receiver.try_recv().map_err(|_| late)
        }
    }
}

/// Tries this until it succeeds or the time is over.
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
    async fn a_caller_who_gives_up_decides() {
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
