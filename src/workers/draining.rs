//! The word that the service comes to its end.

use tokio::sync::watch;

/// Whether the service drains: what runs comes to an end, nothing new begins. All clones know the same, and whoever has
/// one may wait for the word.
#[derive(Debug, Clone, Default)]
pub struct Draining(watch::Sender<bool>);

impl Draining {
    /// From now on.
    pub fn begin(&self) {
        self.0.send_replace(true);
    }

    /// True once it has begun.
    pub fn begun(&self) -> bool {
        *self.0.borrow()
    }

    /// Done once it has begun.
    pub async fn wait(&self) {
        // The sender is here, so the channel is open.
        let _ = self.0.subscribe().wait_for(|begun| *begun).await;
    }
}
