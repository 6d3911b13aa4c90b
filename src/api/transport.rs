//! The stream below HTTP: a socket, or TLS over a socket.

use core::time::Duration;
use std::io;
use std::sync::Arc;

use tokio::io::{AsyncRead, AsyncWrite};
use tokio::time::timeout;

use super::socket::Socket;
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
