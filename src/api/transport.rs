//! The stream below HTTP: a socket with a write timeout, or TLS over one.
//!
//! The timeout is below TLS, because TLS hides what the client reads: it buffers writes, and must still bring them to the
//! client when nothing more is written.

use core::pin::Pin;
use core::task::{Context, Poll};
use core::time::Duration;
use std::io::{self, ErrorKind, IoSlice};
use std::sync::Arc;

use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::net::TcpStream;
use tokio::time::{Sleep, sleep, timeout};

use crate::tls::{Accepted, Acceptor, ClientCertificate};

/// The stream of a request and its answer.
pub(super) type Transport = Box<dyn Bytes>;

/// A stream of bytes in both directions.
pub(super) trait Bytes: AsyncRead + AsyncWrite + Send + Unpin {}

impl<S: AsyncRead + AsyncWrite + Send + Unpin> Bytes for S {}

/// Marks requests that came over TLS.
#[derive(Clone)]
pub(super) struct OverTls {
    /// The client's certificate.
    pub(super) client_certificate: Option<Arc<ClientCertificate>>,
}

/// Do the TLS handshake, within this time. A client that speaks plain HTTP is let through without the mark, so that it
/// gets a readable refusal.
///
/// # Errors
/// If the client speaks neither, shows a certificate of an unknown authority, or takes too long.
pub(super) async fn secure(
    socket: Socket,
    acceptor: &Acceptor,
    patience: Duration,
) -> io::Result<(Transport, Option<OverTls>)> {
    let agreeing = async {
        // Every HTTP method begins with a capital letter, no TLS record does.
        if socket.first_byte().await?.is_some_and(|byte| byte.is_ascii_uppercase()) {
            return Ok((Box::new(socket) as Transport, None));
        }
        let Accepted { stream, client_certificate } = acceptor.accept(socket).await?;
        let mark = OverTls { client_certificate: client_certificate.map(Arc::new) };
        Ok((Box::new(stream) as Transport, Some(mark)))
    };
    timeout(patience, agreeing).await?
}

/// The socket of one connection.
pub(super) struct Socket {
    stream: TcpStream,
    patience: Duration,
    /// Runs while the client reads nothing.
    stuck: Option<Pin<Box<Sleep>>>,
}

impl Socket {
    /// `patience` is how long a client may read nothing.
    pub(super) fn new(stream: TcpStream, patience: Duration) -> Self {
        Self { stream, patience, stuck: None }
    }

    /// Peeks at the client's first byte; `None` at the end of the stream.
    pub(super) async fn first_byte(&self) -> io::Result<Option<u8>> {
        let mut byte = [0];
        Ok((self.stream.peek(&mut byte).await? == 1).then_some(byte[0]))
    }

    /// The outcome of a write, or an error if the client has read nothing for too long.
    fn check<T>(&mut self, written: Poll<io::Result<T>>, context: &mut Context<'_>) -> Poll<io::Result<T>> {
        if written.is_ready() {
            self.stuck = None;
            return written;
        }
        let timer = self.stuck.get_or_insert_with(|| Box::pin(sleep(self.patience)));
        timer.as_mut().poll(context).map(|()| Err(ErrorKind::TimedOut.into()))
    }
}

impl AsyncRead for Socket {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_read(context, buffer)
    }
}

impl AsyncWrite for Socket {
    fn poll_write(mut self: Pin<&mut Self>, context: &mut Context<'_>, bytes: &[u8]) -> Poll<io::Result<usize>> {
        let written = Pin::new(&mut self.stream).poll_write(context, bytes);
        self.check(written, context)
    }

    fn poll_write_vectored(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        slices: &[IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        let written = Pin::new(&mut self.stream).poll_write_vectored(context, slices);
        self.check(written, context)
    }

    fn is_write_vectored(&self) -> bool {
        self.stream.is_write_vectored()
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_flush(context)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_shutdown(context)
    }
}

#[cfg(test)]
mod tests {
    use tokio::io::{AsyncWriteExt, BufWriter};
    use tokio::net::TcpListener;

    use super::*;

    #[tokio::test]
    async fn a_client_that_takes_none_of_buffered_bytes_is_cut_off_too() {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let silent = TcpStream::connect(listener.local_addr().unwrap()).await.unwrap();
        let socket = Socket::new(listener.accept().await.unwrap().0, Duration::from_millis(50));
        // Buffers writes until they are flushed, as TLS does.
        let mut above = BufWriter::with_capacity(100_000, socket);
        let stuck = loop {
            above.write_all(&[0; 50_000]).await.unwrap();
            if let Err(error) = above.flush().await {
                break error;
            }
        };
        assert_eq!(stuck.kind(), ErrorKind::TimedOut);
        drop(silent);
    }
}
