//! What HTTP is spoken over: a socket, or TLS over a socket.

use core::time::Duration;
use std::io;
use std::sync::Arc;

use tokio::io::{AsyncRead, AsyncWrite};
use tokio::time::timeout;

use super::socket::Socket;
use crate::tls::{Accepted, Acceptor, ClientCertificate};

/// Where the bytes of a request come from, and those of its answer go.
pub(super) type Transport = Box<dyn Bytes>;

/// Bytes in both directions.
pub(super) trait Bytes: AsyncRead + AsyncWrite + Send + Unpin {}

impl<S: AsyncRead + AsyncWrite + Send + Unpin> Bytes for S {}

/// A mark on requests that came over TLS.
#[derive(Clone)]
pub(super) struct OverTls {
    /// What the client has shown.
    pub(super) client_certificate: Option<Arc<ClientCertificate>>,
}

/// Agree with a client on TLS, for no longer than this. One that speaks HTTP as if there were no TLS is let through without
/// the mark, to be told so in words that it understands.
///
/// # Errors
/// If the client speaks neither, or shows a certificate of a stranger, or takes too long.
pub(super) async fn secure(
    socket: Socket,
    acceptor: &Acceptor,
    patience: Duration,
) -> io::Result<(Transport, Option<OverTls>)> {
    let agreeing = async {
        // Every method of HTTP begins with a capital letter, no record of TLS does.
        if socket.first_byte().await?.is_some_and(|byte| byte.is_ascii_uppercase()) {
            return Ok((Box::new(socket) as Transport, None));
        }
        let Accepted { stream, client_certificate } = acceptor.accept(socket).await?;
        let mark = OverTls { client_certificate: client_certificate.map(Arc::new) };
        Ok((Box::new(stream) as Transport, Some(mark)))
    };
    timeout(patience, agreeing).await?
}
