//! Certificates that may be replaced while the service runs.

use std::sync::Arc;

use tokio::sync::watch;

use super::server::Server;
use super::{Acceptor, TlsError, TlsSettings};
use crate::watched_files::WatchedFiles;

/// The service's certificate with its key, and the client authorities, from the current files.
pub struct Certificates {
    files: WatchedFiles,
    server: watch::Sender<Arc<Server>>,
}

impl Certificates {
    /// Read the files. `None` without TLS.
    ///
    /// # Errors
    /// If files are missing, unreadable, or don't match.
    pub fn read(settings: &TlsSettings) -> Result<Option<Self>, TlsError> {
        let Some(paths) = settings.files()? else { return Ok(None) };
        let files = WatchedFiles::read(paths)?;
        let server = watch::Sender::new(Arc::new(Server::new(files.paths(), files.contents())?));
        Ok(Some(Self { files, server }))
    }

    /// An acceptor that always uses the current certificate.
    pub fn acceptor(&self) -> Acceptor {
        Acceptor::new(self.server.subscribe())
    }

    /// Reload the files for ever. Open connections survive a new certificate, except those of clients whose authority
    /// is no longer listed. Files that don't match change nothing: perhaps only one of them is written yet.
    pub async fn keep_current(mut self) {
        tracing::info!(sha256 = %self.server.borrow().fingerprint, "certificate");
        loop {
            self.files.changed().await;
            if let Err(error) = self.replace() {
                tracing::error!(%error, "the certificate was not replaced");
            }
        }
    }

    fn replace(&mut self) -> Result<(), TlsError> {
        let server = Server::new(self.files.paths(), self.files.contents())?;
        tracing::info!(sha256 = %server.fingerprint, "certificate replaced");
        self.server.send_replace(Arc::new(server));
        Ok(())
    }
}
