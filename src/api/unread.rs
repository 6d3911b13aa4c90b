//! Request bodies that are not read to their end: of refusals that need no body, and of requests that should have none.
//!
//! Hyper closes the connection of such a request without announcing it. The client's next request is lost. While
//! megabytes are still in transit the answer is lost too, because the system resets a connection that is closed with
//! unread bytes. So a layer below the handlers reads and drops the rest of every body. The answer waits briefly for
//! that. If the rest is late or too long, the answer says `Connection: close`, and the connection lingers: it reads
//! until the client closes.

use core::future::poll_fn;
use core::pin::{Pin, pin};
use core::task::{Context, Poll, ready};
use core::time::Duration;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use axum::body::{Body, Bytes};
use axum::http::{HeaderValue, Request, Response, header};
use hyper::body::{Body as _, Frame, Incoming, SizeHint};
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::sync::oneshot;
use tokio::time::timeout;

use super::transport::Transport;

/// How long an answer waits for the rest of a body: time for packets to be lost and sent again. A client that waits for
/// the answer before it sends the body gets it after this time.
const GRACE: Duration = Duration::from_millis(500);
/// The most bytes that a lingering connection reads. Many clients read only once they have sent everything, even far
/// more than a body may have.
const MAX_LINGER_BYTES: usize = 64_000_000;
/// Bytes per read.
const LINGER_PIECE: usize = 16 * 1024;

/// Whether a connection has announced its end with an unread body.
#[derive(Clone, Default)]
pub(super) struct Unread(Arc<AtomicBool>);

impl Unread {
    pub(super) fn get(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    fn set(&self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// A request's body as handlers get it. The unread rest goes back to its [`Loan`].
pub(super) struct LentBody {
    /// Until it ends, fails or goes back.
    body: Option<Incoming>,
    /// The client waits for `100 Continue`, which is sent at the first read.
    withheld: bool,
    back: Option<oneshot::Sender<Rest>>,
}

/// The unread rest of a body.
enum Rest {
    Nothing,
    Unread(Incoming),
    /// The client did not get `100 Continue`, but may send even so.
    Withheld,
    /// The connection broke, or the chunks are invalid: the start of a next request is unknown.
    Broken,
}

/// A body that was lent to a handler.
pub(super) struct Loan {
    back: oneshot::Receiver<Rest>,
    max: usize,
}

/// Lend a request's body to its handler. At most `max` bytes of the rest are waited for. `None` without a body.
pub(super) fn lend(request: Request<Incoming>, max: usize) -> (Request<LentBody>, Option<Loan>) {
    if request.body().is_end_stream() {
        return (request.map(|body| LentBody { body: Some(body), withheld: false, back: None }), None);
    }
    let withheld = request.headers().contains_key(header::EXPECT);
    let (lender, back) = oneshot::channel();
    let request = request.map(|body| LentBody { body: Some(body), withheld, back: Some(lender) });
    (request, Some(Loan { back, max }))
}

impl LentBody {
    fn give_back(&mut self, rest: Rest) {
        if let Some(back) = self.back.take() {
            // The receiver is gone if the client has hung up.
            let _ = back.send(rest);
        }
    }
}

impl Drop for LentBody {
    fn drop(&mut self) {
        let rest = match self.body.take() {
            Some(body) if !body.is_end_stream() && self.withheld => Rest::Withheld,
            Some(body) if !body.is_end_stream() => Rest::Unread(body),
            _ => Rest::Nothing,
        };
        self.give_back(rest);
    }
}

impl hyper::body::Body for LentBody {
    type Data = Bytes;
    type Error = hyper::Error;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, hyper::Error>>> {
        self.withheld = false;
        let Some(body) = &mut self.body else { return Poll::Ready(None) };
        let frame = ready!(Pin::new(body).poll_frame(context));
        let end = match &frame {
            Some(Ok(_)) => return Poll::Ready(frame),
            Some(Err(_)) => Rest::Broken,
            None => Rest::Nothing,
        };
        self.body = None;
        self.give_back(end);
        Poll::Ready(frame)
    }

    fn is_end_stream(&self) -> bool {
        self.body.as_ref().is_none_or(Incoming::is_end_stream)
    }

    fn size_hint(&self) -> SizeHint {
        self.body.as_ref().map_or_else(|| SizeHint::with_exact(0), Incoming::size_hint)
    }
}

impl Loan {
    /// The answer, once the rest of the body is read, or with `Connection: close`.
    pub(super) async fn settle<E>(
        self,
        answer: impl Future<Output = Result<Response<Body>, E>>,
        unread: &Unread,
    ) -> Result<Response<Body>, E> {
        let (mut answer, mut taken) = (pin!(answer), pin!(self.taken()));
        let mut complete = None;
        let mut response = loop {
            tokio::select! {
                biased;
                answer = &mut answer => break answer?,
                taken = &mut taken, if complete.is_none() => complete = Some(taken),
            }
        };
        if complete.is_none() {
            // If the end is announced anyway, no wait is needed.
            let grace = if response.headers().contains_key(header::CONNECTION) { Duration::ZERO } else { GRACE };
            complete = timeout(grace, taken).await.ok();
        }
        if complete != Some(true) {
            unread.set();
            response.headers_mut().insert(header::CONNECTION, HeaderValue::from_static("close"));
        }
        Ok(response)
    }

    /// Read the rest. True once the body has ended.
    async fn taken(self) -> bool {
        let mut body = match self.back.await {
            Ok(Rest::Nothing) => return true,
            Ok(Rest::Unread(body)) => body,
            Ok(Rest::Withheld | Rest::Broken) | Err(_) => return false,
        };
        let mut left = self.max as u64;
        while body.size_hint().lower() <= left {
            let frame = match poll_fn(|context| Pin::new(&mut body).poll_frame(context)).await {
                None => return true,
                Some(Err(_)) => return false,
                Some(Ok(frame)) => frame,
            };
            let length = frame.data_ref().map_or(0, Bytes::len) as u64;
            let Some(rest) = left.checked_sub(length) else { return false };
            left = rest;
        }
        false
    }
}

/// Close a connection so that its last answer can be read: end the writing side, then read what the client still sends,
/// for at most this time.
pub(super) async fn close(mut stream: Transport, patience: Duration) {
    if stream.shutdown().await.is_err() {
        return;
    }
    let mut piece = vec![0; LINGER_PIECE];
    let taking = async {
        let mut left = MAX_LINGER_BYTES;
        while left > 0 {
            match stream.read(&mut piece).await {
                Ok(0) | Err(_) => break,
                Ok(count) => left = left.saturating_sub(count),
            }
        }
    };
    // A client that neither closes nor stops is cut off.
    let _ = timeout(patience, taking).await;
}
