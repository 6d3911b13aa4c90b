//! Reads addresses, and suggests corrections.

use std::net::{IpAddr, Ipv4Addr, SocketAddr};

/// The default port.
pub(super) const DEFAULT_PORT: u16 = 8080;

/// The listen address.
///
/// # Errors
/// The suggested correction.
pub(super) fn listen(text: &str) -> Result<SocketAddr, String> {
    text.parse().map_err(|_| format!("'{text}' is not an address and port like 0.0.0.0:8080{}", meant(text)))
}

fn meant(text: &str) -> String {
    let bare = text.trim().trim_start_matches("http://").trim_start_matches("https://").trim_end_matches('/');
    let suggest = |address: SocketAddr| format!("; did you mean {address}?");
    if let Ok(address) = bare.parse() {
        return suggest(address);
    }
    if let Some(ip) = ip(bare) {
        return suggest(SocketAddr::new(ip, DEFAULT_PORT));
    }
    let (host, port) = bare.rsplit_once(':').unwrap_or(("", bare));
    if port.is_empty() || !port.bytes().all(|byte| byte.is_ascii_digit()) {
        return String::new();
    }
    let Ok(port) = port.parse() else { return "; a port is a number up to 65535".to_owned() };
    match (host, ip(host)) {
        ("", _) => format!("; did you mean 127.0.0.1:{port}, or 0.0.0.0:{port} for other machines too?"),
        (_, Some(ip)) => suggest(SocketAddr::new(ip, port)),
        (_, None) => "; names are not resolved: give the address".to_owned(),
    }
}

/// The IP address of a host, with or without brackets.
fn ip(host: &str) -> Option<IpAddr> {
    match host {
        "localhost" => Some(Ipv4Addr::LOCALHOST.into()),
        "*" => Some(Ipv4Addr::UNSPECIFIED.into()),
        _ => host.trim_start_matches('[').trim_end_matches(']').parse().ok(),
    }
}

/// The address of the store of jobs. Only its scheme is checked.
///
/// # Errors
/// The suggested correction. The text is shown only up to where a password could begin.
pub(super) fn jobs_url(text: &str) -> Result<String, String> {
    let place = text.strip_prefix("sqlite:");
    let server = ["postgres://", "postgresql://"].iter().find_map(|scheme| text.strip_prefix(scheme));
    if place.or(server).is_some_and(|rest| !rest.is_empty()) {
        return Ok(text.to_owned());
    }
    Err(match text.split_once(':') {
        Some((scheme, _)) => {
            let scheme_says = |word| scheme.to_ascii_lowercase().contains(word);
            let meant = match () {
                () if scheme_says("sqlite") || scheme_says("file") => "; did you mean sqlite:PATH?",
                () if scheme_says("postgres") => "; did you mean postgres://USER@HOST/DATABASE?",
                () => "",
            };
            format!(
                "an address that begins with '{scheme}:' is neither sqlite:PATH nor postgres://HOST/DATABASE{meant}"
            )
        }
        None if is_path(text) => format!("'{text}' names no kind of store; did you mean sqlite:{text}?"),
        None => "an address begins with sqlite: or postgres://".to_owned(),
    })
}

/// True if a text looks like a file path and can't hold a password.
fn is_path(text: &str) -> bool {
    let letter = |c: char| c.is_alphanumeric() || "/._- ~".contains(c);
    text.starts_with(|c: char| c.is_alphanumeric() || "/.~".contains(c)) && text.chars().all(letter)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_address_that_is_nearly_one_is_answered_with_what_was_meant() {
        for (text, meant) in [
            ("9000", "did you mean 127.0.0.1:9000, or 0.0.0.0:9000 for other machines too?"),
            (":9000", "did you mean 127.0.0.1:9000, or 0.0.0.0:9000 for other machines too?"),
            ("localhost:9000", "did you mean 127.0.0.1:9000?"),
            ("localhost", "did you mean 127.0.0.1:8080?"),
            ("*:9000", "did you mean 0.0.0.0:9000?"),
            ("192.0.2.1", "did you mean 192.0.2.1:8080?"),
            ("::1", "did you mean [::1]:8080?"),
            ("[::1]", "did you mean [::1]:8080?"),
            ("http://127.0.0.1:9000/", "did you mean 127.0.0.1:9000?"),
            (" 127.0.0.1:9000 ", "did you mean 127.0.0.1:9000?"),
            ("127.0.0.1:99999", "a port is a number up to 65535"),
            ("cell-4:9000", "names are not resolved: give the address"),
        ] {
            let fault = listen(text).unwrap_err();
            assert_eq!(fault, format!("'{text}' is not an address and port like 0.0.0.0:8080; {meant}"));
        }
        for text in ["", "here", ":", "-1"] {
            assert!(listen(text).unwrap_err().ends_with(" like 0.0.0.0:8080"), "{text}");
        }
        assert_eq!(listen("[::]:80").unwrap().port(), 80);
    }

    #[test]
    fn a_place_for_jobs_that_is_nearly_one_is_answered_with_what_was_meant() {
        for (text, meant) in [
            ("x.db", "did you mean sqlite:x.db?"),
            ("/var/lib/x.db", "did you mean sqlite:/var/lib/x.db?"),
            ("file:x.db", "did you mean sqlite:PATH?"),
            ("sqlite3:x.db", "did you mean sqlite:PATH?"),
            ("SQLITE:x.db", "did you mean sqlite:PATH?"),
            ("sqlite:", "did you mean sqlite:PATH?"),
            ("jdbc:postgresql://host/jobs", "neither sqlite:PATH nor postgres://HOST/DATABASE"),
            ("postgres:host/jobs", "did you mean postgres://USER@HOST/DATABASE?"),
            ("postgresql+psycopg://host/jobs", "did you mean postgres://USER@HOST/DATABASE?"),
            ("mysql://host/jobs", "'mysql:' is neither sqlite:PATH nor postgres://HOST/DATABASE"),
            ("host=a dbname=b", "an address begins with sqlite: or postgres://"),
            ("", "an address begins with sqlite: or postgres://"),
        ] {
            let fault = jobs_url(text).unwrap_err();
            assert!(fault.ends_with(meant), "{text}: {fault}");
        }
        for text in ["sqlite:x.db", "sqlite::memory:", "postgres://a", "postgresql://a"] {
            assert_eq!(jobs_url(text).as_deref(), Ok(text));
        }
    }

    #[test]
    fn no_advice_shows_a_password() {
        for text in
            ["user:quiet@host/jobs", "user@host/jobs?password=quiet", "password=quiet host=a", "mysql://user:quiet@a"]
        {
            assert!(!jobs_url(text).unwrap_err().contains("quiet"), "{text}");
        }
    }
}
