//! `singulate healthcheck`: for containers, which have no curl.

use core::time::Duration;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};
use std::path::PathBuf;

use clap::Args;
use reqwest::{ClientBuilder, StatusCode};
use serde_json::Value;

use super::Failure;
use super::text::plain;
use crate::config::{self, Config, SETTINGS, Stated};
use crate::jobs::{client_builder, client_builder_with, innermost, trusted_roots};
use crate::tls::unverified_client;
use crate::wire::ProblemKind;

/// Timeout of the check.
const PATIENCE: Duration = Duration::from_secs(2);

/// The most bytes read of an answer: a problem document has some hundred.
const MAX_ANSWER: usize = 4096;

/// A hint for when nothing listens at the address in the settings.
const ELSEWHERE: &str = "; a service that was started with --listen or --config is asked with the same flag";

/// The arguments of `healthcheck`.
#[derive(Debug, Args)]
pub(super) struct Healthcheck {
    /// The address to ask, such as http://127.0.0.1:8080/readyz; by default the service on this machine that has the
    /// settings of the environment, by HTTP or TLS
    #[arg(long, conflicts_with_all = ["listen", "config"])]
    url: Option<String>,
    /// The address that the service listens on, as given to `serve` [env: SINGULATE_LISTEN]
    #[arg(long, value_name = "ADDR:PORT")]
    listen: Option<String>,
    /// The file with the service's settings, as given to `serve` [env: SINGULATE_CONFIG]
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
}

impl Healthcheck {
    pub(super) fn run(self) -> Result<(), Failure> {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build();
        let runtime = runtime.map_err(|error| Failure::Broken(error.to_string()))?;
        match self.url {
            Some(url) => runtime.block_on(ask(client_builder(trusted_roots()), &url, ""))?.outcome(&url),
            None => {
                let listen = SETTINGS.iter().find(|setting| setting.name == "listen").zip(self.listen);
                let stated = Stated { config: self.config, flags: listen.into_iter().collect() };
                runtime.block_on(ask_this_machine(&config::load(&stated, std::env::vars_os())?))
            }
        }
    }
}

/// Ask the service with these settings. Its TLS flags are unknown here, but its answer tells.
async fn ask_this_machine(config: &Config) -> Result<(), Failure> {
    // Only this machine is asked, so the certificate does not matter.
    let client = || client_builder_with(unverified_client());
    let url = own_url(config);
    let answer = ask(client(), &url, ELSEWHERE).await?;
    match url.strip_prefix("http://") {
        Some(rest) if answer.wants_tls() => {
            let url = format!("https://{rest}");
            ask(client(), &url, ELSEWHERE).await?.outcome(&url)
        }
        _ => answer.outcome(&url),
    }
}

/// The service's reply.
struct Reply {
    status: StatusCode,
    /// The problem document, if it is one.
    problem: Value,
}

impl Reply {
    /// True if our service speaks TLS and was asked without.
    fn wants_tls(&self) -> bool {
        self.problem["type"] == ProblemKind::MalformedHttp.to_string()
    }

    fn outcome(&self, url: &str) -> Result<(), Failure> {
        if self.status.is_success() {
            return Ok(());
        }
        let detail = self.problem["detail"].as_str().map(|detail| format!(": {}", plain(detail))).unwrap_or_default();
        Err(Failure::Broken(format!("{url}: {}{detail}", self.status)))
    }
}

/// The URL of a service with these settings on this machine.
fn own_url(config: &Config) -> String {
    let scheme = if config.server.tls.cert.is_some() { "https" } else { "http" };
    let ip = match config.listen.ip() {
        ip if !ip.is_unspecified() => ip,
        IpAddr::V4(_) => IpAddr::V4(Ipv4Addr::LOCALHOST),
        IpAddr::V6(_) => IpAddr::V6(Ipv6Addr::LOCALHOST),
    };
    format!("{scheme}://{}/readyz", SocketAddr::new(ip, config.listen.port()))
}

/// The reply; if nothing listens, `elsewhere` is the hint in the error.
async fn ask(client: ClientBuilder, url: &str, elsewhere: &str) -> Result<Reply, Failure> {
    exchange(client, url).await.map_err(|error| {
        if error.is_builder() {
            return Failure::Refused(format!("{url}: not a URL"));
        }
        let cause = innermost(&error).to_string();
        let cure = if cause.contains("certificate") {
            "; SSL_CERT_FILE=FILE names its authority, and without --url a certificate is not looked at"
        } else if error.is_connect() {
            elsewhere
        } else {
            ""
        };
        Failure::Broken(format!("{url}: {cause}{cure}"))
    })
}

async fn exchange(client: ClientBuilder, url: &str) -> Result<Reply, reqwest::Error> {
    let mut response = client.timeout(PATIENCE).build()?.get(url).send().await?;
    let mut body = Vec::new();
    while body.len() < MAX_ANSWER
        && let Some(piece) = response.chunk().await?
    {
        body.extend_from_slice(&piece);
    }
    Ok(Reply { status: response.status(), problem: serde_json::from_slice(&body).unwrap_or_default() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_service_on_every_address_is_asked_on_this_machine() {
        let url = |listen: &str| own_url(&Config { listen: listen.parse().unwrap(), ..Config::default() });
        assert_eq!(url("0.0.0.0:8080"), "http://127.0.0.1:8080/readyz");
        assert_eq!(url("[::]:81"), "http://[::1]:81/readyz");
        assert_eq!(url("192.168.1.2:8080"), "http://192.168.1.2:8080/readyz");
    }
}
