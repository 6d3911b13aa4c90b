//! `singulate serve`.

use core::pin::pin;
use std::io::{self, ErrorKind};
use std::net::SocketAddr;
use std::path::Path;

use clap::Args;
use tokio::net::TcpSocket;

use super::flags::Flags;
use super::{Failure, open_files, terminal, warn_of_variables};
use crate::api::{Engine, Server, ServerSettings};
use crate::config::{self, Config};
use crate::telemetry;

/// A plate between two others and a fixed vase: a one-line scene that needs a relocation.
const SCENE: &str = include_str!("example.json");

/// The listen backlog of the system.
const BACKLOG: u32 = 1024;

/// The arguments of `serve`.
#[derive(Debug, Default, Args)]
pub(super) struct Serve {
    #[command(flatten)]
    flags: Flags<true>,
}

impl Serve {
    pub(super) fn run(self) -> Result<(), Failure> {
        let config = config::load(&self.flags.0, std::env::vars_os())?;
        config.check_service()?;
        let traces = telemetry::init(&config.log, config.log_format, config.otlp_endpoint.as_ref());
        let traces = traces.map_err(Failure::Broken)?;
        warn_of_variables(&config);
        let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().build();
        let runtime = runtime.map_err(|error| Failure::Broken(error.to_string()))?;
        let served = runtime.block_on(serve(config));
        // Nothing that is left is worth waiting for.
        runtime.shutdown_background();
        if let Some(traces) = traces {
            traces.finish();
        }
        served
    }
}

/// The address is bound first, so that a conflict is reported at once. But listening, and its log line, wait until the
/// service is ready.
async fn serve(mut config: Config) -> Result<(), Failure> {
    let cannot_listen = |error| cannot_listen(config.listen, &error);
    let broken = |error: std::io::Error| Failure::Broken(error.to_string());
    let place = place(config.listen).map_err(cannot_listen)?;
    let listen = place.local_addr().map_err(cannot_listen)?;
    let mut shutdown = pin!(stop_signal().map_err(broken)?);
    config.server.connections = open_files::room_for(config.server.connections);
    opening(&config, listen);
    let (greeting, threads) = (greeting(listen, &config.server), config.server.threads);
    let server = Server::open(config.server, Engine::default(), shutdown.as_mut()).await.map_err(broken)?;
    let Some(server) = server else { return Ok(()) };
    let begun = place.listen(BACKLOG).map_err(cannot_listen).and_then(|listener| {
        tracing::info!(%listen, threads, "serving");
        terminal::print(&greeting).map(|()| listener)
    });
    match begun {
        Ok(listener) => server.serve(listener, shutdown).await,
        Err(failure) => {
            server.close().await;
            return Err(failure);
        }
    }
    Ok(())
}

/// Log lines before the service is ready.
fn opening(config: &Config, listen: SocketAddr) {
    if let Some(warning) = config.warning() {
        tracing::warn!(%listen, "{warning}");
    }
    tracing::info!("opening the store of jobs");
}

/// A bound socket that does not listen yet.
fn place(listen: SocketAddr) -> io::Result<TcpSocket> {
    let socket = if listen.is_ipv4() { TcpSocket::new_v4() } else { TcpSocket::new_v6() }?;
    // Connections of the previous process may still be closing.
    socket.set_reuseaddr(true)?;
    socket.bind(listen)?;
    Ok(socket)
}

/// Why the address can't be used, and a remedy.
fn cannot_listen(listen: SocketAddr, error: &io::Error) -> Failure {
    let cure = match error.kind() {
        ErrorKind::AddrInUse => "; another program listens there: choose another port, or 0 for any free one",
        ErrorKind::AddrNotAvailable => {
            "; this machine has no such address: 127.0.0.1 is for this machine alone, 0.0.0.0 for others too"
        }
        ErrorKind::PermissionDenied => "; a port below 1024 needs a right of its own: choose a greater one",
        _ => "",
    };
    Failure::Broken(format!("--listen {listen}: {error}{cure}"))
}

/// Done at the first signal to stop: Ctrl-C, or the one from a container manager. A second signal ends the process at
/// once, with the status that a shell gives a process killed by that signal.
fn stop_signal() -> std::io::Result<impl Future<Output = ()>> {
    use tokio::signal::unix::{SignalKind, signal};
    let (interrupt, terminate) = (SignalKind::interrupt(), SignalKind::terminate());
    let (mut interrupts, mut terminates) = (signal(interrupt)?, signal(terminate)?);
    let mut asked = async move || {
        tokio::select! {
            _ = interrupts.recv() => interrupt,
            _ = terminates.recv() => terminate,
        }
    };
    Ok(async move {
        asked().await;
        tokio::spawn(async move {
            let again = asked().await.as_raw_value();
            tracing::warn!("ended at once by a second signal");
            std::process::exit(KILLED + again);
        });
    })
}

/// The offset from a signal's number to a shell's exit status.
const KILLED: i32 = 128;

fn greeting(listen: SocketAddr, settings: &ServerSettings) -> String {
    let tls = &settings.tls;
    let host = if listen.ip().is_unspecified() { "localhost".to_owned() } else { listen.ip().to_string() };
    let host = if listen.is_ipv6() && host.contains(':') { format!("[{host}]") } else { host };
    let (scheme, trust) = match &tls.cert {
        Some(cert) => ("https", format!(" --cacert {}", quoted(cert))),
        None => ("http", String::new()),
    };
    let own = if tls.client_ca.is_some() { " --cert YOUR-CERTIFICATE --key YOUR-KEY" } else { "" };
    let url = format!("{scheme}://{host}:{}", listen.port());
    let scene = SCENE.trim();
    let key = if settings.api_keys_file.is_some() { " -H \"authorization: Bearer $KEY\"" } else { "" };
    format!(
        "singulate listens on {url} (interface: {url}/docs). Try:\n\n\
         curl -s{trust}{own} {url}/v1/plans{key} -H 'content-type: application/json' -d '{scene}'\n\n"
    )
}

/// Quoted as one word of a shell.
fn quoted(path: &Path) -> String {
    format!("'{}'", path.display().to_string().replace('\'', r"'\''"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tls::TlsSettings;
    use crate::wire::{RequestLimits, read_scene};

    #[test]
    fn the_scene_to_paste_is_a_valid_request_in_one_quoted_line() {
        let request = read_scene(SCENE.as_bytes(), &RequestLimits::default()).unwrap();
        assert!(request.warnings.is_empty());
        assert!(!SCENE.trim().contains(['\n', '\'']));
    }

    #[test]
    fn the_greeting_names_an_address_that_curl_can_reach() {
        let line = |listen: &str| greeting(listen.parse().unwrap(), &ServerSettings::default());
        assert!(line("0.0.0.0:80").contains("curl -s http://localhost:80/v1/plans"));
        assert!(line("[::1]:80").contains("curl -s http://[::1]:80/v1/plans"));
        let with_key = "/v1/plans -H \"authorization: Bearer $KEY\" -H";
        let keys = ServerSettings { api_keys_file: Some("keys.toml".into()), ..ServerSettings::default() };
        assert!(greeting("127.0.0.1:80".parse().unwrap(), &keys).contains(with_key));
        assert!(!line("[::1]:80").contains("$KEY"));
    }

    #[test]
    fn the_greeting_of_tls_names_the_certificate_in_words_that_a_shell_takes() {
        let mut tls = TlsSettings { cert: Some("it's here.pem".into()), ..TlsSettings::default() };
        let line = |tls: &TlsSettings| {
            let settings = ServerSettings { tls: tls.clone(), ..ServerSettings::default() };
            greeting("127.0.0.1:80".parse().unwrap(), &settings)
        };
        assert!(line(&tls).contains(r"curl -s --cacert 'it'\''s here.pem' https://127.0.0.1:80/v1/plans"));
        tls.client_ca = Some("clients.pem".into());
        assert!(line(&tls).contains(" --cert YOUR-CERTIFICATE --key YOUR-KEY https://127.0.0.1:80/v1/plans"));
    }
}
