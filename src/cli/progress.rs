//! How far a long command has come, on stderr.

use core::time::Duration;
use std::io::Write;
use std::time::Instant;

use indicatif::{ProgressBar, ProgressStyle};

/// Where stderr is no terminal, a line follows another no sooner than this.
const LINE_EVERY: Duration = Duration::from_secs(5);

/// A bar on a terminal, else a line now and then.
#[derive(Debug)]
pub(super) struct Progress {
    bar: ProgressBar,
    told: Instant,
}

impl Progress {
    pub(super) fn start() -> Self {
        let style = ProgressStyle::with_template("{elapsed_precise} [{wide_bar}] {pos} of {len} episodes")
            .expect("the template is sound");
        let bar = ProgressBar::new(0).with_style(style.progress_chars("=> "));
        if !bar.is_hidden() {
            // Time goes on while an episode takes long.
            bar.enable_steady_tick(Duration::from_secs(1));
        }
        Self { bar, told: Instant::now() }
    }

    /// So many episodes are done.
    pub(super) fn tell(&mut self, done: usize, total: usize) {
        if self.bar.is_hidden() && self.told.elapsed() >= LINE_EVERY {
            self.told = Instant::now();
            // Nobody can be told where stderr is gone.
            let _ = writeln!(std::io::stderr(), "{done} of {total} episodes");
        }
        self.bar.set_length(total as u64);
        self.bar.set_position(done as u64);
    }

    /// Take the bar away: what follows stands in its place.
    pub(super) fn end(self) {
        self.bar.finish_and_clear();
    }
}
