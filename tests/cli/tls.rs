//! The service as a process that speaks TLS.

use std::fs;
use std::io::{BufRead, Read};
use std::path::PathBuf;

use rcgen::generate_simple_self_signed;

use crate::service::Service;
use crate::{answered, failed, file, run, singulate};

/// The paths of a certificate for this name and of its key.
fn pair(name: &str, test: &str) -> (String, String) {
    let own = generate_simple_self_signed([name.to_owned()]).unwrap();
    let path = |path: PathBuf| path.to_str().unwrap().to_owned();
    let (cert, key) = (format!("{test}-cert.pem"), format!("{test}-key.pem"));
    (path(file(&cert, &own.cert.pem())), path(file(&key, &own.signing_key.serialize_pem())))
}

fn started(cert: &str, key: &str, more: &[(&str, &str)]) -> Service {
    Service::with(&[&[("SINGULATE_TLS_CERT", cert), ("SINGULATE_TLS_KEY", key)], more].concat())
}

#[test]
fn files_that_do_not_fit_together_are_told_at_the_start_without_showing_a_key() {
    let (cert, key) = pair("localhost", "fit");
    let (_, other) = pair("localhost", "fit-other");
    let missing = cert.replace("fit-cert", "fit-nowhere");
    for (args, start) in [
        (&["--tls-cert", &cert][..], "tls_cert needs tls_key".to_owned()),
        (&["--tls-key", &key], "tls_key needs tls_cert".to_owned()),
        (&["--tls-client-ca", &cert], "tls_client_ca needs tls_cert and tls_key".to_owned()),
        (&["--tls-cert", &missing, "--tls-key", &key], format!("{missing}: ")),
        (&["--tls-cert", &cert, "--tls-key", &other], format!("{other}: with {cert}: ")),
        (&["--tls-cert", &cert, "--tls-key", &cert], format!("{cert}: no private key")),
        (&["--tls-cert", &key, "--tls-key", &key], format!("{key}: no certificate")),
        (&["--tls-cert", &cert, "--tls-key", &key, "--tls-client-ca", &key], format!("{key}: no certificate")),
    ] {
        let all = [&["serve", "--listen", "127.0.0.1:0", "--jobs-url", "sqlite::memory:"], args].concat();
        let errors = failed(&run(&all), 2);
        assert!(errors.starts_with(&start), "{start}: {errors}");
        let secret = fs::read_to_string(&key).unwrap();
        assert!(!secret.lines().any(|line| errors.contains(line)), "{errors}");
    }
}

#[test]
fn a_service_by_tls_says_so_and_is_healthy_whatever_name_its_certificate_has() {
    let (cert, key) = pair("robots.example", "healthy");
    for authority in ["none", &cert] {
        let mut service = started(&cert, &key, &[("SINGULATE_TLS_CLIENT_CA", authority)]);
        let mut curl = String::new();
        while !curl.starts_with("curl ") {
            curl.clear();
            assert!(service.out.read_line(&mut curl).unwrap() > 0, "no line to paste");
        }
        assert!(curl.contains(&format!(" --cacert '{cert}'")) && curl.contains(&service.url), "{curl}");
        assert_eq!(curl.contains(" --cert "), authority != "none");
        let listen = service.url.strip_prefix("https://").unwrap();
        let mut check = singulate(&["healthcheck"]);
        check.env("SINGULATE_LISTEN", listen).env("SINGULATE_TLS_CERT", &cert);
        assert_eq!(answered(check.output().unwrap()), "");
        // Where flags said that there is TLS, no setting does; but the service itself does.
        assert_eq!(answered(singulate(&["healthcheck"]).env("SINGULATE_LISTEN", listen).output().unwrap()), "");
        assert_eq!(answered(run(&["healthcheck", "--listen", listen])), "");
        let config = file("healthy.toml", &format!("listen = '{listen}'\n"));
        assert_eq!(answered(run(&["healthcheck", "--config", config.to_str().unwrap()])), "");
        // A URL is asked as it stands.
        let plain = failed(&run(&["healthcheck", "--url", &format!("http://{listen}/readyz")]), 1);
        assert!(plain.contains("400") && plain.contains("this port speaks TLS; use https"), "{plain}");
    }
}

#[test]
fn a_health_check_of_a_url_trusts_whom_the_machine_trusts() {
    let (cert, key) = pair("localhost", "trust");
    let service = started(&cert, &key, &[]);
    let port = service.url.rsplit_once(':').unwrap().1;
    let check = |host: &str, trusted: &str| {
        let url = format!("https://{host}:{port}/readyz");
        let mut check = singulate(&["healthcheck", "--url", &url]);
        check.env("SSL_CERT_FILE", trusted).env("SSL_CERT_DIR", "/nowhere").output().unwrap()
    };
    assert_eq!(answered(check("localhost", &cert)), "");
    let untrusted = failed(&check("localhost", "/nowhere.pem"), 1);
    assert!(untrusted.contains("SSL_CERT_FILE=FILE names its authority"), "{untrusted}");
    failed(&check("127.0.0.1", &cert), 1);
}

#[test]
fn the_log_names_each_certificate_and_what_keeps_one_from_being_replaced() {
    let (cert, key) = pair("localhost", "log");
    let (other_cert, other_key) = pair("localhost", "log-other");
    let log = file("tls.log", "");
    let mut command = singulate(&["serve", "--listen", "127.0.0.1:0", "--jobs-url", "sqlite::memory:"]);
    command.args(["--tls-cert", &cert, "--tls-key", &key]).stderr(fs::File::create(&log).unwrap());
    let mut service = Service::of(&mut command);
    let wait_for = |what: &str| {
        let started = std::time::Instant::now();
        loop {
            let mut text = String::new();
            fs::File::open(&log).unwrap().read_to_string(&mut text).unwrap();
            if let Some(line) = text.lines().find(|line| line.contains(what)) {
                return line.to_owned();
            }
            assert!(started.elapsed().as_secs() < 60, "no '{what}' in {text}");
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
    };
    let fingerprint = |line: String| line.split_once("sha256=").unwrap().1.to_owned();
    let first = fingerprint(wait_for(" certificate sha256="));
    assert_eq!((first.len(), first.matches(':').count()), (95, 31), "{first}");
    fs::copy(&other_cert, &cert).unwrap();
    let refused = wait_for("the certificate was not replaced");
    assert!(refused.contains("ERROR") && refused.contains(&key), "{refused}");
    fs::copy(&other_key, &key).unwrap();
    assert_ne!(fingerprint(wait_for(" certificate replaced sha256=")), first);
    service.signal(rustix::process::Signal::TERM);
    assert_eq!(service.ended().code(), Some(0));
}
