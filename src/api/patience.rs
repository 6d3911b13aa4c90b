//! The stream of a connection, with timeouts and problems that hyper lacks.
//!
//! A request's head gets a short timeout, an idle connection a long one. Hyper has one timeout for both: short enough
//! for slow heads, it would close a robot's idle connection just as it calls again. And where hyper refuses a head
//! itself, without a body, a problem is sent instead.

use core::pin::Pin;
use core::task::{Context, Poll, ready};
use core::time::Duration;
use std::io::{self, ErrorKind, IoSlice};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::time::{Sleep, sleep};

use super::refusal;
use super::transport::Transport;

/// Whether no request is in progress. Shared by the stream and the service above it.
#[derive(Clone)]
pub(super) struct Quiet(Arc<AtomicBool>);

impl Quiet {
    /// A head is complete.
    pub(super) fn busy(&self) -> Busy {
        self.0.store(false, Ordering::Relaxed);
        Busy(self.clone())
    }

    fn get(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// A request in progress, until its body has come and it is answered.
pub(super) struct Busy(Quiet);

impl Drop for Busy {
    fn drop(&mut self) {
        self.0.0.store(true, Ordering::Relaxed);
    }
}

/// The stream of one connection.
pub(super) struct PatientStream {
    stream: Transport,
    quiet: Quiet,
    head_patience: Duration,
    /// Runs while a head is incomplete.
    head: Option<Pin<Box<Sleep>>>,
    /// The rest of a problem that replaces a refusal by hyper.
    owed: Vec<u8>,
}

impl PatientStream {
    /// The first head is due within this time from now, each later one within this time of its first byte.
    pub(super) fn new(stream: Transport, head_patience: Duration) -> (Self, Quiet) {
        let quiet = Quiet(Arc::new(AtomicBool::new(true)));
        let head = Some(Box::pin(sleep(head_patience)));
        (Self { stream, quiet: quiet.clone(), head_patience, head, owed: Vec::new() }, quiet)
    }

    /// The stream below, without timeouts.
    pub(super) fn into_transport(self) -> Transport {
        self.stream
    }

    /// An error once the current head is overdue.
    fn check_head(&mut self, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        match &mut self.head {
            Some(timer) => timer.as_mut().poll(context).map(|()| Err(ErrorKind::TimedOut.into())),
            None => Poll::Pending,
        }
    }

    fn poll_owed(&mut self, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        while !self.owed.is_empty() {
            let count = ready!(Pin::new(&mut self.stream).poll_write(context, &self.owed))?;
            self.owed.drain(..count);
        }
        Poll::Ready(Ok(()))
    }
}

impl AsyncRead for PatientStream {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        if !self.quiet.get() {
            self.head = None;
        }
        let result = Pin::new(&mut self.stream).poll_read(context, buffer);
        if result.is_pending() {
            return self.check_head(context);
        }
        if self.quiet.get() && self.head.is_none() {
            self.head = Some(Box::pin(sleep(self.head_patience)));
        }
        result
    }
}

impl AsyncWrite for PatientStream {
    fn poll_write(mut self: Pin<&mut Self>, context: &mut Context<'_>, bytes: &[u8]) -> Poll<io::Result<usize>> {
        ready!(self.poll_owed(context))?;
        if let Some(problem) = refusal::problem_for(bytes) {
            self.owed = problem;
            return Poll::Ready(Ok(bytes.len()));
        }
        Pin::new(&mut self.stream).poll_write(context, bytes)
    }

    fn poll_write_vectored(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        slices: &[IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        // A refusal has no body, so it is one slice.
        if let [bytes] = slices {
            return self.poll_write(context, bytes);
        }
        ready!(self.poll_owed(context))?;
        Pin::new(&mut self.stream).poll_write_vectored(context, slices)
    }

    fn is_write_vectored(&self) -> bool {
        self.stream.is_write_vectored()
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        ready!(self.poll_owed(context))?;
        Pin::new(&mut self.stream).poll_flush(context)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        ready!(self.poll_owed(context))?;
        Pin::new(&mut self.stream).poll_shutdown(context)
    }
}
