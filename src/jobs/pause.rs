//! How long to leave a store alone that failed.

use core::time::Duration;

use tokio::time::sleep;

/// The first pause and the longest: soon enough after a hiccup, seldom enough for a store that is starting.
const LEAST: Duration = Duration::from_millis(50);
const GREATEST: Duration = Duration::from_secs(2);

/// A pause that doubles each time.
#[derive(Debug)]
pub(super) struct Pause(Duration);

impl Default for Pause {
    fn default() -> Self {
        Self(LEAST)
    }
}

impl Pause {
    /// Wait; longer the next time.
    pub(super) async fn pass(&mut self) {
        let length = self.0;
        self.0 = (2 * length).min(GREATEST);
        sleep(length).await;
    }
}
