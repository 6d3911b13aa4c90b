//! Runs computations on dedicated threads, so that they don't block the rest of the service. All of it hears of the
//! shutdown by [`Draining`].

use tokio_util::sync::CancellationToken;

mod forecast;
mod pending;
mod pool;
mod queue;
#[cfg(test)]
mod tests;

pub use pending::{Pending, PoolOutcome, Recall};
pub use pool::{Pool, Refused};

/// The shutdown signal: once it is given, running work ends and nothing new begins. Clones share it, and each can wait
/// for it.
#[derive(Debug, Clone, Default)]
pub struct Draining(CancellationToken);

impl Draining {
    /// Give the signal.
    pub fn begin(&self) {
        self.0.cancel();
    }

    /// True once it is given.
    pub fn begun(&self) -> bool {
        self.0.is_cancelled()
    }

    /// Done once it is given.
    pub async fn wait(&self) {
        self.0.cancelled().await;
    }

    /// The result of `work`, or `None` if the signal comes first.
    pub async fn unless_begun<T>(&self, work: impl Future<Output = T>) -> Option<T> {
        self.0.run_until_cancelled(work).await
    }
}
