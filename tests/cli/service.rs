//! The service as a process.

use std::io::{BufRead, BufReader};
use std::net::TcpListener;
use std::process::{Child, ChildStdout, Command, Stdio};
use std::time::{Duration, Instant};

use crate::{answered, failed, run, singulate};

/// A service on a free port; it ends with the test.
struct Service {
    child: Child,
    out: BufReader<ChildStdout>,
    url: String,
}

impl Service {
    fn start() -> Self {
        Self::with(&[])
    }

    /// Without a command it serves: only variables say where.
    fn with(variables: &[(&str, &str)]) -> Self {
        let mut command = singulate(&[]);
        command.env("SINGULATE_LISTEN", "127.0.0.1:0").env("SINGULATE_LOG", "warn");
        command.envs(variables.iter().copied());
        let mut child = command.stdout(Stdio::piped()).spawn().unwrap();
        let mut out = BufReader::new(child.stdout.take().unwrap());
        let mut line = String::new();
        out.read_line(&mut line).unwrap();
        let url = line.split_whitespace().find(|word| word.starts_with("http://")).unwrap().to_owned();
        Self { child, out, url }
    }
}

impl Drop for Service {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[test]
fn the_service_says_where_it_is_and_what_to_paste_and_is_healthy() {
    let mut service = Service::start();
    let mut curl = String::new();
    while !curl.starts_with("curl ") {
        curl.clear();
        assert!(service.out.read_line(&mut curl).unwrap() > 0, "no line to paste");
    }
    assert!(curl.contains(&format!("{}/v1/plans -H 'content-type: application/json' -d '{{", service.url)), "{curl}");
    let url = format!("{}/readyz", service.url);
    assert_eq!(answered(run(&["healthcheck", "--url", &url])), "");
    let listen = service.url.trim_start_matches("http://");
    assert_eq!(answered(singulate(&["healthcheck"]).env("SINGULATE_LISTEN", listen).output().unwrap()), "");
    let missing = format!("{}/missing", service.url);
    assert!(failed(&run(&["healthcheck", "--url", &missing]), 1).contains("404"));
    let taken = run(&["serve", "--listen", listen, "--log", "off"]);
    assert!(failed(&taken, 1).starts_with(listen));
}

#[test]
fn the_health_check_needs_no_certificates() {
    let service = Service::start();
    let mut check = singulate(&["healthcheck", "--url", &format!("{}/readyz", service.url)]);
    check.env("SSL_CERT_FILE", "/nowhere.pem").env("SSL_CERT_DIR", "/nowhere");
    assert_eq!(answered(check.output().unwrap()), "");
}

#[test]
fn a_service_that_calls_back_needs_a_secret_and_does_not_show_it() {
    let args = ["serve", "--listen", "127.0.0.1:0", "--callback-allow", "erp.example.com"];
    assert!(failed(&run(&args), 2).starts_with("callback_allow needs callback_secret"));
    let errors = failed(&run(&[&args[..], &["--callback-secret", "too-short"]].concat()), 2);
    assert!(errors.starts_with("--callback-secret: ") && !errors.contains("too-short"), "{errors}");
}

#[test]
fn a_service_that_is_not_there_is_not_healthy() {
    // Port 9 discards; nobody listens there on this machine.
    failed(&run(&["healthcheck", "--url", "http://127.0.0.1:9/readyz"]), 1);
    failed(&run(&["healthcheck", "--url", "no url"]), 2);
}

#[test]
fn a_service_ends_though_its_collector_never_answers() {
    let collector = TcpListener::bind("127.0.0.1:0").unwrap();
    let url = format!("http://{}", collector.local_addr().unwrap());
    let mut service = Service::with(&[("SINGULATE_OTLP_ENDPOINT", &url)]);
    answered(run(&["healthcheck", "--url", &format!("{}/readyz", service.url)]));
    let id = service.child.id().to_string();
    assert!(Command::new("kill").arg(id).status().unwrap().success());
    let started = Instant::now();
    let status = loop {
        if let Some(status) = service.child.try_wait().unwrap() {
            break status;
        }
        assert!(started.elapsed() < Duration::from_secs(60), "it waits for its collector");
        std::thread::sleep(Duration::from_millis(5));
    };
    assert_eq!(status.code(), Some(0));
    // It did try.
    collector.set_nonblocking(true).unwrap();
    collector.accept().unwrap();
}
