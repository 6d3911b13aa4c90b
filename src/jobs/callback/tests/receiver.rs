//! A receiver of callbacks on a real socket, and helpers to wait for it.

use core::time::Duration;
use std::net::SocketAddr;
use std::sync::{Arc, Mutex};

use tokio::io::{AsyncRead, AsyncReadExt, AsyncWrite, AsyncWriteExt};
use tokio::net::TcpListener;
use tokio::time::sleep;
use tokio_rustls::TlsAcceptor;

/// How long a condition may take on a busy machine.
const PATIENCE: Duration = Duration::from_secs(60);

/// How a receiver answers.
#[derive(Clone)]
pub(super) enum Manner {
    /// Answers with this status and these header lines.
    Answer(u16, String),
    /// Never answers.
    Hang,
    /// Answers 200 and a body that never ends.
    Babble,
}

pub(super) fn status(status: u16) -> Manner {
    Manner::Answer(status, String::new())
}

#[derive(Clone)]
pub(super) struct Receiver {
    pub(super) address: SocketAddr,
    received: Arc<Mutex<Vec<Message>>>,
}

#[derive(Debug, Clone)]
pub(super) struct Message {
    pub(super) head: String,
    pub(super) body: String,
}

impl Message {
    pub(super) fn header(&self, name: &str) -> &str {
        let line = self.head.lines().find_map(|line| line.strip_prefix(&format!("{name}: ")));
        line.unwrap_or_else(|| panic!("no {name} in {}", self.head))
    }
}

impl Receiver {
    /// A receiver that answers its messages in these manners; the last one repeats.
    pub(super) async fn start(manners: &[Manner]) -> Self {
        Self::start_with(manners, None).await
    }

    pub(super) async fn start_with(manners: &[Manner], tls: Option<TlsAcceptor>) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let this = Self { address: listener.local_addr().unwrap(), received: Arc::default() };
        let (receiver, manners) = (this.clone(), manners.to_vec());
        tokio::spawn(async move {
            while let Ok((stream, _)) = listener.accept().await {
                let (receiver, manners, tls) = (receiver.clone(), manners.clone(), tls.clone());
                tokio::spawn(async move {
                    match tls {
                        Some(tls) => {
                            // A client that does not trust the certificate goes away.
                            if let Ok(stream) = tls.accept(stream).await {
                                receiver.serve(stream, &manners).await;
                            }
                        }
                        None => receiver.serve(stream, &manners).await,
                    }
                });
            }
        });
        this
    }

    pub(super) fn url(&self) -> String {
        format!("http://{}/done?of=cell-4", self.address)
    }

    pub(super) fn received(&self) -> Vec<Message> {
        self.received.lock().unwrap().clone()
    }

    async fn serve(&self, mut stream: impl AsyncRead + AsyncWrite + Unpin, manners: &[Manner]) {
        let Some(message) = read(&mut stream).await else { return };
        let nth = {
            let mut received = self.received.lock().unwrap();
            received.push(message);
            received.len()
        };
        match &manners[nth.min(manners.len()) - 1] {
            Manner::Answer(status, headers) => {
                let answer = format!("HTTP/1.1 {status} So\r\n{headers}content-length: 2\r\n\r\nok");
                // The client may have gone.
                let _ = stream.write_all(answer.as_bytes()).await;
                let _ = stream.shutdown().await;
            }
            Manner::Hang => std::future::pending().await,
            Manner::Babble => {
                let _ = stream.write_all(b"HTTP/1.1 200 OK\r\n\r\n").await;
                while stream.write_all(&[b'x'; 4096]).await.is_ok() {}
            }
        }
    }
}

async fn read(stream: &mut (impl AsyncRead + Unpin)) -> Option<Message> {
    let mut text = Vec::new();
    loop {
        let mut part = [0; 4096];
        let count = stream.read(&mut part).await.ok().filter(|count| *count > 0)?;
        text.extend_from_slice(&part[..count]);
        let Some((head, body)) = std::str::from_utf8(&text).unwrap().split_once("\r\n\r\n") else { continue };
        let message = Message { head: head.to_owned(), body: body.to_owned() };
        if message.header("content-length").parse() == Ok(body.len()) {
            return Some(message);
        }
    }
}

/// Waits until the condition holds.
pub(super) async fn until(what: &str, mut so: impl FnMut() -> bool) {
    let waiting = async {
        while !so() {
            sleep(Duration::from_millis(5)).await;
        }
    };
    assert!(tokio::time::timeout(PATIENCE, waiting).await.is_ok(), "waited in vain: {what}");
}
