//! Delivers callbacks at least once, or gives up after the last try.

use core::fmt;
use core::time::Duration;
use std::sync::Arc;

use reqwest::header::CONTENT_TYPE;
use reqwest::redirect::Policy;
use reqwest::{Client, StatusCode};
use tokio::task::JoinSet;
use tokio::time::{sleep, timeout};

use super::allow::CallbackAllow;
use super::client::{AllowedAddresses, Lookup, client_builder, innermost, system, trusted_roots};
use super::destination::{CallbackFault, CallbackUrl};
use super::sign::{CallbackSecret, SIGNATURE_HEADER, TIMESTAMP_HEADER};
use super::silent::SilentReceivers;
use crate::jobs::body::message;
use crate::jobs::job::JobId;
use crate::jobs::settings::JobSettings;
use crate::jobs::store::{Callback, Delivery, Store};
use crate::jobs::timestamp::{Timestamp, WallClock};
use crate::metrics::{CallbackOutcome, Metrics};

/// Tries at a time. Each holds a job with its answer, a few megabytes at most, and a connection.
pub(super) const MAX_IN_FLIGHT: usize = 32;
/// Tries per callback. With the pauses between them they last over four minutes, so a receiver may restart meanwhile.
pub(super) const MAX_TRIES: u32 = 8;
/// The most bytes read of a receiver's answer, so that it can send a short body without an error.
const MAX_ANSWER_BYTES: usize = 16_384;

/// Time limits and intervals.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pace {
    /// To connect. Enough for a receiver on a bad line.
    pub(super) connecting: Duration,
    /// A whole try, from resolving the host to the end of the answer.
    pub(super) a_try: Duration,
    /// Between the first try and the second. It doubles with each try; the last pause is 128 s.
    pub(super) first_pause: Duration,
    /// The lease on a callback: one try, and time for a slow store to note the outcome. No other server takes the
    /// callback meanwhile.
    pub(super) lease: Duration,
    /// Between two polls of the store. Hints come sooner; retries are exact to this interval.
    pub(super) poll: Duration,
    /// Grace period for tries under way at shutdown: enough for a receiver that is about to answer.
    pub(super) farewell: Duration,
}

impl Default for Pace {
    fn default() -> Self {
        Self {
            connecting: Duration::from_secs(5),
            a_try: Duration::from_secs(10),
            first_pause: Duration::from_secs(2),
            lease: Duration::from_secs(30),
            poll: Duration::from_secs(1),
            farewell: Duration::from_secs(1),
        }
    }
}

/// Delivers the callbacks of ended jobs.
pub struct CallbackDelivery {
    store: Arc<dyn Store>,
    allow: Arc<CallbackAllow>,
    secret: CallbackSecret,
    client: Client,
    silent: SilentReceivers,
    pace: Pace,
    metrics: Arc<Metrics>,
}

/// Why a try failed.
enum TryFault {
    /// The allow list has become shorter since the job was accepted.
    NotAllowed(CallbackFault),
    /// The receiver does not answer other callbacks either; nothing was sent before this time.
    Silent(Timestamp),
    /// No answer: not resolved, not reached, not trusted, or too slow.
    NoAnswer(reqwest::Error),
    /// An error status.
    Answer(StatusCode),
}

impl fmt::Display for TryFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotAllowed(fault) => fault.fmt(f),
            Self::Silent(_) => f.write_str("not sent: the receiver does not answer"),
            Self::NoAnswer(error) => write!(f, "{}", innermost(error)),
            Self::Answer(status) => write!(f, "the receiver answered {status}"),
        }
    }
}

impl CallbackDelivery {
    /// Ready to run; `None` if callbacks are off.
    ///
    /// # Errors
    /// If the HTTP client can't be built.
    pub fn new(
        store: Arc<dyn Store>,
        settings: &JobSettings,
        metrics: Arc<Metrics>,
    ) -> Result<Option<Self>, reqwest::Error> {
        let Some(secret) = settings.callback_secret.clone() else { return Ok(None) };
        if settings.callback_allow.is_empty() {
            return Ok(None);
        }
        let roots = trusted_roots();
        if roots.is_empty() {
            tracing::warn!("no certificates of authorities on this machine: callbacks by https will fail");
        }
        let allow = Arc::new(settings.callback_allow.clone());
        let pace = Pace::default();
        let client = client(Arc::clone(&allow), system, roots, pace)?;
        let silent = SilentReceivers::new(pace.a_try);
        Ok(Some(Self { store, allow, secret, client, silent, pace, metrics }))
    }

    #[cfg(test)]
    pub(super) fn for_tests(
        store: Arc<dyn Store>,
        allow: &str,
        secret: &CallbackSecret,
        (lookup, roots, pace): (Lookup, rustls::RootCertStore, Pace),
    ) -> Self {
        let allow: Arc<CallbackAllow> = Arc::new(allow.parse().unwrap());
        let client = client(Arc::clone(&allow), lookup, roots, pace).unwrap();
        let silent = SilentReceivers::new(pace.a_try);
        Self { store, allow, secret: secret.clone(), client, silent, pace, metrics: Arc::default() }
    }

    /// Delivers due callbacks until `shutdown` is done. Callbacks not delivered by then stay in the store.
    pub async fn run(self, shutdown: impl Future<Output = ()>) {
        let this = Arc::new(self);
        let mut tries = JoinSet::new();
        tokio::select! {
            () = shutdown => {}
            () = this.keep_on(&mut tries) => {}
        }
        let settled = async { while tries.join_next().await.is_some() {} };
        if timeout(this.pace.farewell, settled).await.is_err() {
            tracing::info!(tries = tries.len(), "callbacks under way will be tried again");
        }
        tries.shutdown().await;
    }

    async fn keep_on(self: &Arc<Self>, tries: &mut JoinSet<()>) {
        loop {
            let mut hint = core::pin::pin!(self.store.hints().callbacks.notified());
            hint.as_mut().enable();
            self.begin_due(tries).await;
            tokio::select! {
                Some(ended) = tries.join_next() => {
                    if let Err(error) = ended {
                        tracing::error!(%error, "a try to deliver a callback panicked");
                    }
                }
                () = hint => {}
                () = sleep(self.pace.poll) => {}
            }
        }
    }

    /// Starts tries for due callbacks, as far as there is room.
    async fn begin_due(self: &Arc<Self>, tries: &mut JoinSet<()>) {
        while tries.len() < MAX_IN_FLIGHT {
            match self.store.take_callback(self.pace.lease, &WallClock::system()).await {
                Ok(Some(callback)) => {
                    let this = Arc::clone(self);
                    tries.spawn(async move { this.deal_with(callback).await });
                }
                Ok(None) => return,
                Err(error) => {
                    // Other users of the store log this too, and less often than every second.
                    tracing::debug!(%error, "callbacks wait");
                    return;
                }
            }
        }
    }

    async fn deal_with(&self, callback: Callback) {
        let (id, attempt) = (callback.job.id, callback.attempt);
        let delivery = match self.try_once(&callback).await {
            Ok(()) => {
                self.metrics.callback(CallbackOutcome::Delivered);
                Delivery::Over
            }
            Err(fault) => self.after(&fault, id, attempt),
        };
        if let Err(error) = self.store.settle_callback(id, attempt, delivery).await {
            tracing::warn!(job = %id, %error, "a callback may be repeated");
        }
    }

    /// The outcome of a failed try: another try, or none.
    fn after(&self, fault: &TryFault, id: JobId, attempt: u32) -> Delivery {
        let unwanted = matches!(fault, TryFault::Answer(StatusCode::GONE));
        if unwanted || attempt >= MAX_TRIES {
            tracing::warn!(job = %id, attempt, %fault, "a callback is given up");
            self.metrics.callback(CallbackOutcome::GivenUp);
            return Delivery::Over;
        }
        tracing::info!(job = %id, attempt, %fault, "a callback was not delivered yet");
        self.metrics.callback(match fault {
            TryFault::NotAllowed(_) => CallbackOutcome::Forbidden,
            _ => CallbackOutcome::Again,
        });
        let next = Timestamp::now().after(pause(self.pace.first_pause, attempt));
        match fault {
            TryFault::Silent(until) => Delivery::Again(next.max(*until)),
            _ => Delivery::Again(next),
        }
    }

    async fn try_once(&self, callback: &Callback) -> Result<(), TryFault> {
        let url = self.allow.check(&callback.url).map_err(TryFault::NotAllowed)?;
        let receiver = url.receiver();
        self.silent.admit(&receiver, Timestamp::now()).map_err(TryFault::Silent)?;
        let answer = self.post(&url, message(&callback.job)).await;
        let answered = !answer.as_ref().is_err_and(reqwest::Error::is_timeout);
        self.silent.note(&receiver, answered, Timestamp::now());
        let status = answer.map_err(TryFault::NoAnswer)?;
        if status.is_success() { Ok(()) } else { Err(TryFault::Answer(status)) }
    }

    async fn post(&self, url: &CallbackUrl, body: Vec<u8>) -> Result<StatusCode, reqwest::Error> {
        let timestamp = (Timestamp::now().as_millis() / 1000).to_string();
        let signature = self.secret.sign(&timestamp, &body);
        let request = self.client.post(url.url().clone()).header(CONTENT_TYPE, "application/json");
        let request = request.header(TIMESTAMP_HEADER, timestamp).header(SIGNATURE_HEADER, signature);
        let mut response = request.body(body).send().await?;
        let mut read = 0;
        // Only the status counts; errors in the body don't.
        while let Ok(Some(part)) = response.chunk().await {
            read += part.len();
            if read > MAX_ANSWER_BYTES {
                break;
            }
        }
        Ok(response.status())
    }
}

/// The pause after this many tries.
pub(super) fn pause(first: Duration, tries: u32) -> Duration {
    first * 2_u32.pow(tries.clamp(1, MAX_TRIES) - 1)
}

/// A client restricted to allowed addresses: no proxy, no redirect, no reused connection.
fn client(
    allow: Arc<CallbackAllow>,
    lookup: Lookup,
    roots: rustls::RootCertStore,
    pace: Pace,
) -> Result<Client, reqwest::Error> {
    client_builder(roots)
        .dns_resolver(AllowedAddresses::new(allow, lookup))
        .redirect(Policy::none())
        .retry(reqwest::retry::never())
        .referer(false)
        .pool_max_idle_per_host(0)
        .connect_timeout(pace.connecting)
        .timeout(pace.a_try)
        .user_agent(concat!("singulate/", env!("CARGO_PKG_VERSION")))
        .build()
}
