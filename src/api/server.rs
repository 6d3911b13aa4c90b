//! Accepts connections and serves them, until it is told to stop.

use core::pin::pin;
use core::time::Duration;
use std::io;
use std::sync::Arc;

use axum::Router;
use hyper::server::conn::http1;
use hyper::service::{Service, service_fn};
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::server::graceful::{GracefulShutdown, Watcher};
use hyper_util::service::TowerToHyperService;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};
use tokio::task::{JoinSet, spawn_blocking};
use tokio::time::{sleep, timeout};

use super::app::App;
use super::patience::PatientStream;
use super::router::router;
use super::settings::ServerSettings;
use crate::workers::Engine;

/// How long to wait after the system refused a connection, mostly for want of file descriptors.
const ACCEPT_PAUSE: Duration = Duration::from_millis(100);

/// How long a connection may rest between two requests. Longer than the usual client's, so that the client closes first
/// and no request meets a closed door.
const IDLE_TIMEOUT: Duration = Duration::from_secs(75);

/// How long the clients have, once the last answer is due, to take it.
const FAREWELL: Duration = Duration::from_secs(5);

/// Serve on `listener` until `shutdown` is done; then finish what runs, and return.
///
/// # Errors
/// If the system gives no threads.
pub async fn run(
    listener: TcpListener,
    settings: ServerSettings,
    shutdown: impl Future<Output = ()>,
) -> io::Result<()> {
    run_with(listener, settings, Engine::default(), shutdown).await
}

/// [`run`] with other computations than the planner's.
///
/// # Errors
/// If the system gives no threads.
pub async fn run_with(
    listener: TcpListener,
    settings: ServerSettings,
    engine: Engine,
    shutdown: impl Future<Output = ()>,
) -> io::Result<()> {
    let app = Arc::new(App::new(settings, engine)?);
    let mut connections = JoinSet::new();
    let graceful = GracefulShutdown::new();
    {
        let mut shutdown = pin!(shutdown);
        let slots = Arc::new(Semaphore::new(app.settings.connections.max(1)));
        let service = router(Arc::clone(&app));
        loop {
            let (stream, slot) = tokio::select! {
                () = &mut shutdown => break,
                accepted = accept(&listener, &slots) => accepted,
            };
            connections.spawn(serve(stream, slot, service.clone(), Arc::clone(&app), graceful.watcher()));
            while connections.try_join_next().is_some() {}
        }
    }
    app.drain();
    drop(listener);
    let last_answer = app.settings.body_timeout + app.settings.limits.max_time_limit;
    if timeout(last_answer + FAREWELL, graceful.shutdown()).await.is_err() {
        tracing::warn!("some clients did not take their answers");
    }
    connections.shutdown().await;
    // Every caller has gone, so whatever still runs is cancelled and ends soon.
    spawn_blocking(move || app.pool.join()).await.map_err(io::Error::other)
}

/// The next connection, once there is a slot for it.
async fn accept(listener: &TcpListener, slots: &Arc<Semaphore>) -> (TcpStream, OwnedSemaphorePermit) {
    loop {
        let Ok(slot) = Arc::clone(slots).acquire_owned().await else { continue };
        match listener.accept().await {
            Ok((stream, _)) => return (stream, slot),
            Err(error) => {
                tracing::warn!(%error, "a connection was not accepted");
                sleep(ACCEPT_PAUSE).await;
            }
        }
    }
}

async fn serve(stream: TcpStream, slot: OwnedSemaphorePermit, service: Router, app: Arc<App>, watcher: Watcher) {
    // Answers are small and waited for.
    if let Err(error) = stream.set_nodelay(true) {
        tracing::debug!(%error, "the connection keeps its delay");
    }
    let open = app.metrics.connection();
    let (stream, quiet) = PatientStream::new(stream, &app.settings);
    let service = TowerToHyperService::new(service);
    let service = service_fn(move |request| {
        quiet.set(false);
        let (answer, quiet) = (service.call(request), quiet.clone());
        async move {
            let answer = answer.await;
            quiet.set(true);
            answer
        }
    });
    let connection = http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(IDLE_TIMEOUT)
        .serve_connection(TokioIo::new(stream), service);
    if let Err(error) = watcher.watch(connection).await {
        tracing::debug!(%error, "a connection ended early");
    }
    drop((slot, open));
}
