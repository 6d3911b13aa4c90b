//! `singulate healthcheck`: for containers, which have no curl.

use core::time::Duration;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};

use clap::Args;

use super::Failure;
use crate::config::{self, Config, Stated};
use crate::jobs::{client_builder, client_builder_with, innermost, trusted_roots};
use crate::tls::unverified_client;

/// How long the service may take to say that it is ready.
const PATIENCE: Duration = Duration::from_secs(2);

/// The arguments of `healthcheck`.
#[derive(Debug, Args)]
pub(super) struct Healthcheck {
    /// What to ask, a whole address such as http://127.0.0.1:8080/readyz; that of the place where `serve` would listen where nothing is said
    #[arg(long)]
    url: Option<String>,
}

impl Healthcheck {
    pub(super) fn run(self) -> Result<(), Failure> {
        let (url, client) = match self.url {
            Some(url) => (url, client_builder(trusted_roots())),
            // Nobody but this machine is asked, so it does not matter what the certificate says.
            None => (
                own_url(&config::load(&Stated::default(), std::env::vars_os())?),
                client_builder_with(unverified_client()),
            ),
        };
        let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build();
        let runtime = runtime.map_err(|error| Failure::Broken(error.to_string()))?;
        match runtime.block_on(ask(client, &url)) {
            Ok(status) if status.is_success() => Ok(()),
            Ok(status) => Err(Failure::Broken(format!("{url}: {status}"))),
            Err(error) if error.is_builder() => Err(Failure::Refused(format!("{url}: not a URL"))),
            Err(error) => Err(Failure::Broken(format!("{url}: {}", innermost(&error)))),
        }
    }
}

/// Where a service with these settings can be asked from this machine.
fn own_url(config: &Config) -> String {
    let scheme = if config.server.tls.cert.is_some() { "https" } else { "http" };
    let ip = match config.listen.ip() {
        ip if !ip.is_unspecified() => ip,
        IpAddr::V4(_) => IpAddr::V4(Ipv4Addr::LOCALHOST),
        IpAddr::V6(_) => IpAddr::V6(Ipv6Addr::LOCALHOST),
    };
    format!("{scheme}://{}/readyz", SocketAddr::new(ip, config.listen.port()))
}

async fn ask(client: reqwest::ClientBuilder, url: &str) -> Result<reqwest::StatusCode, reqwest::Error> {
    let client = client.timeout(PATIENCE).build()?;
    Ok(client.get(url).send().await?.status())
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
