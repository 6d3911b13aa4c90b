//! Accepts connections and serves them.

use core::pin::{Pin, pin};
use core::time::Duration;
use std::sync::{Arc, OnceLock};

use axum::Router;
use hyper::Request;
use hyper::body::Incoming;
use hyper::server::conn::http1::{self, Parts};
use hyper::service::{Service, service_fn};
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::service::TowerToHyperService;
use tokio::io::AsyncWriteExt;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{OwnedSemaphorePermit, Semaphore, watch};
use tokio::task::JoinSet;
use tokio::time::{Instant, sleep, timeout_at};

use super::app::App;
use super::patience::PatientStream;
use super::refusal;
use super::router::router;
use super::transport::{self, OverTls, Socket, Transport};
use super::unread::{self, Unread};
use crate::tls::Acceptor;

/// The pause after a failed accept, mostly for want of file descriptors.
const ACCEPT_PAUSE: Duration = Duration::from_millis(100);

/// How long a connection may be idle between two requests. Longer than in common clients, so that the client closes
/// first and no request meets a closed connection.
const IDLE_TIMEOUT: Duration = Duration::from_secs(75);

/// The listener and all its connections. Dropping it ends them.
pub(super) struct Connections {
    listener: TcpListener,
    app: Arc<App>,
    /// If TLS is on.
    tls: Option<Acceptor>,
    service: Router,
    slots: Arc<Semaphore>,
    open: JoinSet<()>,
    /// The number of connections that have made a request. While the service drains, each ends by itself: at once if it
    /// is idle, otherwise with its answer.
    asking: watch::Sender<usize>,
}

impl Connections {
    pub(super) fn new(listener: TcpListener, app: Arc<App>, tls: Option<Acceptor>) -> Self {
        let slots = Arc::new(Semaphore::new(app.settings.connections.max(1)));
        let service = router(&app);
        Self { listener, app, tls, service, slots, open: JoinSet::new(), asking: watch::Sender::default() }
    }

    /// Accept and serve until `end` is done.
    pub(super) async fn serve_until(&mut self, end: impl Future<Output = ()>) {
        let mut end = pin!(end);
        loop {
            let (stream, slot) = tokio::select! {
                biased;
                () = &mut end => return,
                accepted = accept(&self.listener, &self.slots) => accepted,
            };
            self.open.spawn(self.connection(stream, slot));
            while self.open.try_join_next().is_some() {}
        }
    }

    /// Serves one connection.
    fn connection(&self, stream: TcpStream, slot: OwnedSemaphorePermit) -> impl Future<Output = ()> + use<> {
        let (app, service, asking) = (Arc::clone(&self.app), self.service.clone(), self.asking.clone());
        let tls = self.tls.clone();
        async move {
            // Answers are small and awaited. If this fails, the connection works even so.
            let _ = stream.set_nodelay(true);
            let open = app.running.metrics.connection();
            let socket = Socket::new(stream, app.settings.write_timeout);
            let begun = match tls {
                // Boxed: otherwise every connection would keep the memory of the handshake.
                Some(acceptor) => Box::pin(transport::secure(socket, &acceptor, app.settings.header_timeout)).await,
                None => Ok((Box::new(socket) as Transport, None)),
            };
            match begun {
                Ok((stream, mark)) => serve(stream, mark, service, &app, asking).await,
                Err(error) => tracing::debug!(%error, "the TLS handshake failed"),
            }
            drop((slot, open));
        }
    }

    /// While the service drains: accept and serve until no answer is due and `also` is done. False if the deadline
    /// comes first.
    pub(super) async fn answer_until(&mut self, deadline: Instant, also: impl Future<Output = ()>) -> bool {
        let mut asking = self.asking.subscribe();
        // An error would mean that the counter is gone.
        let answered = async move { drop(asking.wait_for(|count| *count == 0).await) };
        let answered = async {
            tokio::join!(also, answered);
        };
        timeout_at(deadline, self.serve_until(answered)).await.is_ok()
    }
}

/// The next connection, once a slot is free.
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

/// Serve the requests on `stream`; each gets the mark.
async fn serve(stream: Transport, mark: Option<OverTls>, service: Router, app: &App, asking: watch::Sender<usize>) {
    let (stream, quiet) = PatientStream::new(stream, app.settings.header_timeout);
    let (unread, max_body_bytes) = (Unread::default(), app.settings.max_body_bytes);
    let service = TowerToHyperService::new(service);
    let (asked, own) = (OnceLock::new(), unread.clone());
    let service = service_fn(move |mut request: Request<Incoming>| {
        if let Some(mark) = mark.clone() {
            request.extensions_mut().insert(mark);
        }
        asked.get_or_init(|| Asking::new(asking.clone()));
        let (busy, unread) = (quiet.busy(), own.clone());
        let (request, loan) = unread::lend(request, max_body_bytes);
        let answer = service.call(request);
        async move {
            let answer = match loan {
                // Boxed: otherwise every connection would keep memory for a body that few of its requests have.
                Some(loan) => Box::pin(loan.settle(answer, &unread)).await,
                None => answer.await,
            };
            drop(busy);
            answer
        }
    });
    // A new connection during draining gets one answer: most are probes.
    let lasting = !app.running.draining.begun();
    let mut builder = http1::Builder::new();
    builder.timer(TokioTimer::new()).header_read_timeout(IDLE_TIMEOUT).keep_alive(lasting);
    let mut connection = builder.serve_connection(TokioIo::new(stream), service);
    let mut serving = Pin::new(&mut connection);
    let ended = tokio::select! {
        ended = serving.as_mut() => ended,
        () = app.running.draining.wait(), if lasting => {
            serving.as_mut().graceful_shutdown();
            serving.await
        }
    };
    // The service is dropped last: the connection counts until the client has read its last answer.
    let Parts { io, service: _counted, .. } = connection.into_parts();
    end(io.into_inner().into_transport(), ended, unread.get(), app.settings.body_timeout).await;
}

/// Close a connection so that its last answer can be read.
async fn end(mut stream: Transport, ended: hyper::Result<()>, unread: bool, patience: Duration) {
    if let Err(error) = ended {
        tracing::debug!(%error, "a connection ended early");
        // Hyper itself refuses a head that is not HTTP/1.1, but closes on HTTP/2 without an answer. After any other
        // error the client takes no answer.
        let told =
            error.is_parse() && (!error.is_parse_version_h2() || stream.write_all(&refusal::of_http_2()).await.is_ok());
        if !told {
            return;
        }
    } else if !unread {
        return;
    }
    // Boxed for the same reason.
    Box::pin(unread::close(stream, patience)).await;
}

/// Counts a connection from its first request to its end.
struct Asking(watch::Sender<usize>);

impl Asking {
    fn new(count: watch::Sender<usize>) -> Self {
        count.send_modify(|count| *count += 1);
        Self(count)
    }
}

impl Drop for Asking {
    fn drop(&mut self) {
        self.0.send_modify(|count| *count -= 1);
    }
}
