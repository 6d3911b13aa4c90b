//! Certificates that may be replaced while the service runs.

use std::sync::Arc;

use tokio::sync::watch;

use super::server::Server;
use super::{Acceptor, TlsError, TlsSettings};
use crate::watched_files::WatchedFiles;

/// The service's certificate with its key, and the authorities of its clients, as they are in their files now.
pub struct Certificates {
    files: WatchedFiles,
    server: watch::Sender<Arc<Server>>,
}

impl Certificates {
    /// Read them. None where TLS is not spoken.
    ///
    /// # Errors
    /// If files are missing, or can't be read, or don't fit together.
    pub fn read(settings: &TlsSettings) -> Result<Option<Self>, TlsError> {
        let Some(paths) = settings.files()? else { return Ok(None) };
        let files = WatchedFiles::read(paths)?;
        let server = watch::Sender::new(Arc::new(Server::new(files.paths(), files.contents())?));
        Ok(Some(Self { files, server }))
    }

    /// Accepts connections, each with the certificate of its moment.
    pub fn acceptor(&self) -> Acceptor {
        Acceptor::new(self.server.subscribe())
    }

    /// Look after the files for ever. Connections that are open live on when a certificate is replaced, but not those of
    /// clients whose authority is listed no longer. Files that don't fit together, perhaps because only one of them is
    /// written yet, change nothing.
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
