//! Progress of a long command, on stderr.

use core::time::Duration;
use std::io::Write;
use std::time::Instant;

use indicatif::{ProgressBar, ProgressStyle};

/// The least time between two lines if stderr is no terminal.
const LINE_EVERY: Duration = Duration::from_secs(5);

/// A bar on a terminal, otherwise a line at intervals.
#[derive(Debug)]
pub(super) struct Progress {
    bar: ProgressBar,
    told: Instant,
}

impl Progress {
    pub(super) fn start() -> Self {
        let style = ProgressStyle::with_template("{elapsed_precise} [{wide_bar}] {pos} of {len} done")
            .expect("the template is sound");
        let bar = ProgressBar::new(0).with_style(style.progress_chars("=> "));
        if !bar.is_hidden() {
            // The elapsed time advances while an episode takes long.
            bar.enable_steady_tick(Duration::from_secs(1));
        }
        Self { bar, told: Instant::now() }
    }

    /// Reports the number done.
    pub(super) fn tell(&mut self, done: usize, total: usize) {
        if self.bar.is_hidden() && self.told.elapsed() >= LINE_EVERY {
            self.told = Instant::now();
            // If stderr is gone, nothing can be reported.
            let _ = writeln!(std::io::stderr(), "{done} of {total} done");
        }
        self.bar.set_length(total as u64);
        self.bar.set_position(done as u64);
    }

    /// Removes the bar, since results take its place.
    pub(super) fn end(self) {
        self.bar.finish_and_clear();
    }
}
