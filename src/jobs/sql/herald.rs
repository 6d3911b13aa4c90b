//! Announces changes: to this server, and through PostgreSQL to the others.
//!
//! Announcements are hints. They are sent outside of all transactions: PostgreSQL commits transactions that notify one
//! at a time.

use core::time::Duration;
use std::sync::Arc;

use sqlx::postgres::PgListener;
use sqlx::{AnyPool, Error};
use tokio::sync::mpsc::{Receiver, Sender, channel};
use tokio::task::AbortHandle;
use uuid::Uuid;

use crate::jobs::{Hints, JobId};

/// The notification channel of all servers.
const CHANNEL: &str = "singulate_jobs";
/// Changes per notification, which has at most 8,000 bytes; a change takes less than 60.
const TOLD_AT_A_TIME: usize = 100;
/// Changes that wait to be sent. More are dropped: receivers poll as well.
const MAX_WAITING: usize = 10_000;
/// Between two tries to reach the database.
const PAUSE: Duration = Duration::from_secs(1);

/// A job has changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct News {
    /// The job.
    pub(super) id: JobId,
    /// It is queued now.
    pub(super) queued: bool,
    /// A callback is due now.
    pub(super) callback: bool,
    /// Its worker must check it: it was cancelled, or its lease ended.
    pub(super) recall: bool,
}

impl News {
    /// A change that only watchers need to see.
    pub(super) fn of(id: JobId) -> Self {
        Self { id, queued: false, callback: false, recall: false }
    }
}

#[derive(Debug)]
pub(super) struct Herald {
    hints: Arc<Hints>,
    /// The channel to the task that notifies other servers.
    others: Option<Sender<News>>,
    tasks: Vec<AbortHandle>,
}

impl Herald {
    /// For a database without notifications.
    pub(super) fn alone() -> Self {
        Self { hints: Arc::default(), others: None, tasks: Vec::new() }
    }

    /// Listens and notifies, through the database at this address.
    pub(super) async fn among_others(url: &str, pool: &AnyPool) -> Result<Self, Error> {
        let hints = Arc::<Hints>::default();
        // A server ignores its own notifications.
        let name = Uuid::now_v7().to_string();
        let first = listener(url).await?;
        let hearing = tokio::spawn(hear(url.to_owned(), Arc::clone(&hints), name.clone(), first));
        let (others, waiting) = channel(MAX_WAITING);
        let telling = tokio::spawn(tell(pool.clone(), name, waiting));
        Ok(Self { hints, others: Some(others), tasks: vec![hearing.abort_handle(), telling.abort_handle()] })
    }

    pub(super) fn hints(&self) -> &Hints {
        &self.hints
    }

    pub(super) fn announce(&self, news: &[News]) {
        for one in news {
            wake(&self.hints, one);
            if let Some(others) = &self.others {
                // Full: see MAX_WAITING.
                others.try_send(*one).ok();
            }
        }
    }
}

impl Drop for Herald {
    fn drop(&mut self) {
        self.tasks.iter().for_each(AbortHandle::abort);
    }
}

fn wake(hints: &Hints, news: &News) {
    hints.changed(news.id);
    if news.queued {
        hints.work.notify_one();
    }
    if news.callback {
        hints.callbacks.notify_one();
    }
    if news.recall {
        hints.recalled(news.id);
    }
}

/// A change as a word of a notification: the job, then its flags.
fn word(news: &News) -> String {
    let parts = [(news.queued, "+work"), (news.callback, "+callback"), (news.recall, "+recall")];
    let told: String = parts.into_iter().filter(|(so, _)| *so).map(|(_, part)| part).collect();
    format!(" {}{told}", news.id)
}

fn read(word: &str) -> Option<News> {
    let mut parts = word.split('+');
    let id = parts.next()?.parse().ok()?;
    let parts: Vec<&str> = parts.collect();
    let told = |part| parts.contains(&part);
    Some(News { id, queued: told("work"), callback: told("callback"), recall: told("recall") })
}

async fn tell(pool: AnyPool, name: String, mut waiting: Receiver<News>) {
    let mut news = Vec::new();
    while waiting.recv_many(&mut news, TOLD_AT_A_TIME).await > 0 {
        let mut payload = name.clone();
        news.drain(..).for_each(|one| payload.push_str(&word(&one)));
        let told = sqlx::query("SELECT pg_notify($1, $2)").bind(CHANNEL).bind(payload).execute(&pool).await;
        if let Err(error) = told {
            tracing::debug!(%error, "other servers were not told of changes");
        }
    }
}

async fn listener(url: &str) -> Result<PgListener, Error> {
    let mut listener = PgListener::connect(url).await?;
    listener.listen(CHANNEL).await?;
    Ok(listener)
}

async fn hear(url: String, hints: Arc<Hints>, name: String, first: PgListener) {
    let mut current = Some(first);
    loop {
        if let Some(listener) = &mut current {
            match listener.try_recv().await {
                Ok(Some(notification)) => {
                    let mut words = notification.payload().split(' ');
                    if words.next() != Some(&name) {
                        words.filter_map(read).for_each(|news| wake(&hints, &news));
                    }
                }
                // The connection was lost and is back.
                Ok(None) => hints.all_changed(),
                Err(error) => {
                    tracing::debug!(%error, "changes on other servers are not heard");
                    current = None;
                }
            }
        } else {
            tokio::time::sleep(PAUSE).await;
            current = listener(&url).await.ok();
            if current.is_some() {
                hints.all_changed();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_notification_reads_as_it_was_written() {
        for bits in 0..8 {
            let [queued, callback, recall] = [1, 2, 4].map(|bit| bits & bit != 0);
            let told = News { id: JobId::new(), queued, callback, recall };
            assert_eq!(read(word(&told).trim_start()), Some(told));
            assert!(word(&told).len() < 60, "a hundred of them fit into a notification");
        }
        assert!(read("nonsense").is_none());
    }
}
