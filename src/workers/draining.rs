//! The word that the service comes to its end.

use tokio_util::sync::CancellationToken;

/// Whether the service drains: what runs comes to an end, nothing new begins. All clones know the same, and whoever has
/// one may wait for the word.
#[derive(Debug, Clone, Default)]
pub struct Draining(CancellationToken);

impl Draining {
    /// From now on.
    pub fn begin(&self) {
        self.0.cancel();
    }

    /// True once it has begun.
    pub fn begun(&self) -> bool {
        self.0.is_cancelled()
    }

    /// Done once it has begun.
    pub async fn wait(&self) {
        self.0.cancelled().await;
    }

    /// What comes of it, unless draining begins before.
    pub async fn unless_begun<T>(&self, work: impl Future<Output = T>) -> Option<T> {
        self.0.run_until_cancelled(work).await
    }
}
