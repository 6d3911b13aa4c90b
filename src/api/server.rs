//! The service from start to shutdown.

use core::pin::{Pin, pin};
use core::time::Duration;
use std::io;
use std::sync::Arc;

use tokio::net::TcpListener;
use tokio::task::spawn_blocking;
use tokio::time::{Instant, timeout_at};
use tokio_util::sync::CancellationToken;
use tokio_util::task::{AbortOnDropHandle, TaskTracker};

use super::app::App;
use super::connections::Connections;
use super::running::Running;
use super::settings::ServerSettings;
use crate::computation::{Engine, Planning};
use crate::jobs::CallbackDelivery;
use crate::tls::Certificates;

/// The share of the drain time after which running computations are recalled. The rest is for their answers to be
/// written and read.
const RUNNING_SHARE: f64 = 0.9;

/// How long cancelled computations are waited for after draining. Cancelling frees a core within 20 ms.
const LAST_LOOK: Duration = Duration::from_secs(1);

/// A prepared service that does not listen yet: it has accepted no connection and claimed no job.
pub struct Server {
    app: Arc<App>,
    certificates: Option<Certificates>,
    callbacks: Option<CallbackDelivery>,
}

impl Server {
    /// Read the files, open the store of jobs, start the threads. `None` if `shutdown` was done before that, so that an
    /// unreachable store does not delay it.
    ///
    /// # Errors
    /// If a thread can't be started, key or certificate files are invalid, or the store of jobs can't be opened.
    pub async fn open(
        settings: ServerSettings,
        engine: Engine,
        shutdown: Pin<&mut impl Future<Output = ()>>,
    ) -> io::Result<Option<Self>> {
        let certificates = Certificates::read(&settings.tls).map_err(io::Error::other)?;
        let app = tokio::select! {
            app = App::start(settings, engine) => Arc::new(app?),
            () = shutdown => return Ok(None),
        };
        let (store, metrics) = (Arc::clone(&app.running.store), Arc::clone(&app.running.metrics));
        let callbacks = CallbackDelivery::new(store, &app.settings.jobs, metrics);
        Ok(Some(Self { app, certificates, callbacks: callbacks.map_err(io::Error::other)? }))
    }

    /// Serve on `listener` until `shutdown` is done; then drain and return.
    pub async fn serve(self, listener: TcpListener, shutdown: impl Future<Output = ()>) {
        let Self { app, certificates, callbacks } = self;
        let gate = Arc::clone(&app.gate);
        let _watching = AbortOnDropHandle::new(tokio::spawn(async move { gate.watch().await }));
        let background = Background::begin(&app.running, callbacks);
        let acceptor = certificates.as_ref().map(Certificates::acceptor);
        let _current = certificates.map(|own| AbortOnDropHandle::new(tokio::spawn(own.keep_current())));
        let mut connections = Connections::new(listener, Arc::clone(&app), acceptor);
        connections.serve_until(shutdown).await;
        drain(&app, connections, &background).await;
        close(&app).await;
    }

    /// End without having served: closes the store of jobs.
    pub async fn close(self) {
        close(&self.app).await;
    }
}

async fn close(app: &App) {
    if let Err(error) = app.running.store.close().await {
        tracing::warn!(%error, "the store of jobs was not closed in order; a copy of a SQLite file needs the -wal beside it");
    }
}

/// Serve on `listener` until `shutdown` is done; then drain and return.
///
/// # Errors
/// Those of [`Server::open`].
pub async fn run(
    listener: TcpListener,
    settings: ServerSettings,
    shutdown: impl Future<Output = ()>,
) -> io::Result<()> {
    run_with(listener, settings, Engine::default(), shutdown).await
}

/// [`run`] with a replaced engine.
///
/// # Errors
/// Those of [`Server::open`].
pub async fn run_with(
    listener: TcpListener,
    settings: ServerSettings,
    engine: Engine,
    shutdown: impl Future<Output = ()>,
) -> io::Result<()> {
    let mut shutdown = pin!(shutdown);
    if let Some(server) = Server::open(settings, engine, shutdown.as_mut()).await? {
        server.serve(listener, shutdown).await;
    }
    Ok(())
}

/// The background tasks: job workers and callbacks.
struct Background {
    jobs: TaskTracker,
    /// Workers then hand back their jobs.
    over: CancellationToken,
    callbacks: TaskTracker,
    /// Callbacks then stop.
    silence: CancellationToken,
}

impl Background {
    fn begin(running: &Running, delivery: Option<CallbackDelivery>) -> Self {
        let (jobs, over) = (TaskTracker::new(), CancellationToken::new());
        jobs.spawn(Arc::clone(&running.runner).run(running.draining.clone(), over.clone()));
        jobs.close();
        let (callbacks, silence) = (TaskTracker::new(), CancellationToken::new());
        if let Some(delivery) = delivery {
            callbacks.spawn(delivery.run(silence.clone().cancelled_owned()));
        }
        callbacks.close();
        Self { jobs, over, callbacks, silence }
    }
}

/// Answer open requests and end running work, within the drain time. Connections are still accepted, so that probes see
/// that the service is not ready; new work is refused.
async fn drain(app: &Arc<App>, mut connections: Connections, background: &Background) {
    let began = Instant::now();
    let (last_words, end) = (began + app.settings.drain.mul_f64(RUNNING_SHARE), began + app.settings.drain);
    app.drain();
    if !connections.answer_until(last_words, background.jobs.wait()).await {
        app.finish_soon();
        background.over.cancel();
        if !connections.answer_until(end, background.jobs.wait()).await {
            tracing::warn!("some clients did not take their answers, or some jobs could not be handed back");
        }
    }
    // The remaining connections have made no request, or don't read their answer.
    drop(connections);
    background.silence.cancel();
    background.callbacks.wait().await;
    end_computations(&app.running.planning, end.max(Instant::now() + LAST_LOOK)).await;
}

/// All callers are gone, so running computations are cancelled and end within milliseconds. If one does not, the
/// process ends it.
async fn end_computations(planning: &Arc<Planning>, end: Instant) {
    let own = Arc::clone(planning);
    if timeout_at(end, spawn_blocking(move || own.join())).await.is_err() {
        tracing::error!("a cancelled computation does not end");
    }
}
