//! The service as a process.

use std::io::{BufRead, BufReader, ErrorKind, Write};
use std::net::{TcpListener, TcpStream};
use std::process::{Child, ChildStdout, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use rustix::process::{Pid, Signal, kill_process};

use crate::hard::hard;
use crate::scenes::ALONE;
use crate::{answered, failed, file, run, singulate};

/// A service on a free port; it ends with the test.
pub(crate) struct Service {
    child: Child,
    pub(crate) out: BufReader<ChildStdout>,
    pub(crate) url: String,
}

impl Service {
    fn start() -> Self {
        Self::with(&[])
    }

    /// Without a command it serves: only variables say where.
    pub(crate) fn with(variables: &[(&str, &str)]) -> Self {
        let mut command = singulate(&[]);
        command.env("SINGULATE_LISTEN", "127.0.0.1:0").env("SINGULATE_LOG", "warn");
        command.env("SINGULATE_JOBS_URL", "sqlite::memory:").envs(variables.iter().copied());
        Self::of(&mut command)
    }

    /// What the command starts.
    pub(crate) fn of(command: &mut Command) -> Self {
        let mut child = command.stdout(Stdio::piped()).spawn().unwrap();
        let mut out = BufReader::new(child.stdout.take().unwrap());
        let mut line = String::new();
        out.read_line(&mut line).unwrap();
        let url = line.split_whitespace().find(|word| word.starts_with("http")).unwrap().to_owned();
        Self { child, out, url }
    }

    /// A connection on which the text has been sent.
    fn raw(&self, text: &str) -> TcpStream {
        let mut stream = TcpStream::connect(self.url.trim_start_matches("http://")).unwrap();
        stream.write_all(text.as_bytes()).unwrap();
        stream
    }

    /// The status line of the answer to a request without a body.
    fn status(&self, request: &str) -> String {
        let mut line = String::new();
        let stream = self.raw(&format!("{request} HTTP/1.1\r\nhost: x\r\nconnection: close\r\n\r\n"));
        BufReader::new(stream).read_line(&mut line).unwrap();
        line
    }

    pub(crate) fn signal(&self, signal: Signal) {
        kill_process(Pid::from_child(&self.child), signal).unwrap();
    }

    /// The status with which the process ends, long before any time limit would end it.
    pub(crate) fn ended(&mut self) -> ExitStatus {
        let started = Instant::now();
        loop {
            if let Some(status) = self.child.try_wait().unwrap() {
                return status;
            }
            assert!(started.elapsed() < Duration::from_secs(60), "it does not end");
            std::thread::sleep(Duration::from_millis(1));
        }
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
}

#[test]
fn a_place_that_can_not_be_had_names_the_flag_and_the_address() {
    let service = Service::start();
    let taken = service.url.trim_start_matches("http://");
    for (listen, cure) in [
        (taken, "another program listens there: choose another port, or 0 for any free one"),
        // For documents: no machine has it.
        ("192.0.2.1:8080", "this machine has no such address"),
    ] {
        let jobs = file("taken.db", "");
        std::fs::remove_file(&jobs).unwrap();
        let url = format!("sqlite:{}", jobs.display());
        let refused = run(&["serve", "--listen", listen, "--jobs-url", &url, "--log", "off", "--insecure"]);
        let errors = failed(&refused, 1);
        assert!(errors.starts_with(&format!("--listen {listen}: ")) && errors.contains(cure), "{errors}");
        // No store was made for a service that there is not.
        assert!(!jobs.exists());
    }
}

#[test]
fn a_service_that_can_not_say_where_it_listens_leaves_one_file() {
    let jobs = file("unheard.db", "");
    let url = format!("sqlite:{}", jobs.display());
    let mut command =
        singulate(&["serve", "--listen", "127.0.0.1:0", "--jobs-url", &url, "--log", "warn", "--insecure"]);
    let full = std::fs::File::create("/dev/full").unwrap();
    let output = command.stdout(full).stderr(Stdio::piped()).spawn().unwrap().wait_with_output().unwrap();
    assert!(failed(&output, 1).starts_with("stdout: "));
    assert!(!jobs.with_extension("db-wal").exists() && jobs.metadata().unwrap().len() > 0);
}

#[test]
fn a_service_says_where_it_listens_only_once_it_does() {
    // Without a store: nothing was promised.
    let refused = run(&["serve", "--listen", "127.0.0.1:0", "--jobs-url", "sqlite:/nowhere/jobs.db"]);
    let errors = failed(&refused, 1);
    assert!(errors.contains("--jobs-url: ") && !errors.contains("serving"), "{errors}");
}

#[test]
fn the_flags_of_serve_are_taken_without_the_word() {
    let mut command = singulate(&["--listen", "127.0.0.1:0", "--jobs-url", "sqlite::memory:"]);
    command.args(["--log", "warn", "--insecure"]);
    let service = Service::of(&mut command);
    assert!(service.status("GET /readyz").contains(" 200 "));
    // But not before another command.
    let errors = failed(&run(&["--log", "warn", "plan", "-"]), 2);
    assert!(errors.contains("cannot be used with"), "{errors}");
    // Neither they nor their hundred lines are in the short help.
    let help = answered(run(&["--help"]));
    assert!(help.contains("takes the flags of `serve`") && !help.contains("--listen"), "{help}");
}

#[test]
fn a_variable_that_is_no_setting_is_a_warning_and_the_service_starts() {
    let log = file("unknown-variables.log", "");
    let mut command =
        singulate(&["serve", "--listen", "127.0.0.1:0", "--jobs-url", "sqlite::memory:", "--log", "warn"]);
    // As Kubernetes does it beside a service called singulate.
    for (name, value) in [
        ("SINGULATE_SERVICE_HOST", "10.0.0.1"),
        ("SINGULATE_PORT", "tcp://10.0.0.1:8080"),
        ("SINGULATE_PORT_8080_TCP_ADDR", "10.0.0.1"),
        ("SINGULATE_TREADS", "2"),
    ] {
        command.env(name, value);
    }
    let service = Service::of(command.stderr(std::fs::File::create(&log).unwrap()));
    assert!(service.status("GET /readyz").contains(" 200 "));
    let text = std::fs::read_to_string(&log).unwrap();
    let warnings: Vec<&str> = text.lines().filter(|line| line.contains("there is no such setting")).collect();
    assert_eq!(warnings.len(), 4, "{text}");
    assert!(warnings.iter().all(|line| line.contains(" WARN ") && !line.contains("10.0.0.1")), "{text}");
    assert!(text.contains("SINGULATE_TREADS: ") && text.contains("did you mean SINGULATE_THREADS?"), "{text}");
    assert!(text.contains("SINGULATE_PORT: "), "{text}");
}

#[test]
fn addresses_that_are_nearly_right_get_advice() {
    for (flag, value, advice) in [
        (
            "--listen",
            "9000",
            "--listen: '9000' is not an address and port like 0.0.0.0:8080; did you mean 127.0.0.1:9000",
        ),
        ("--jobs-url", "x.db", "--jobs-url: 'x.db' names no kind of store; did you mean sqlite:x.db?"),
    ] {
        let errors = failed(&run(&["serve", flag, value]), 2);
        assert!(errors.starts_with(advice), "{errors}");
    }
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
    let errors = failed(&run(&["healthcheck", "--listen", "127.0.0.1:9"]), 1);
    assert!(errors.contains("a service that was started with --listen"), "{errors}");
    failed(&run(&["healthcheck", "--url", "no url"]), 2);
}

#[test]
fn a_service_ends_though_its_collector_never_answers() {
    let collector = TcpListener::bind("127.0.0.1:0").unwrap();
    let url = format!("http://{}", collector.local_addr().unwrap());
    let mut service = Service::with(&[("SINGULATE_OTLP_ENDPOINT", &url)]);
    answered(run(&["healthcheck", "--url", &format!("{}/readyz", service.url)]));
    service.signal(Signal::TERM);
    assert_eq!(service.ended().code(), Some(0));
    // It did try.
    collector.set_nonblocking(true).unwrap();
    collector.accept().unwrap();
}

#[test]
fn a_service_that_rests_ends_at_once_when_it_is_asked_to() {
    for signal in [Signal::TERM, Signal::INT] {
        // Ten minutes to drain, which nothing needs.
        let mut service = Service::with(&[("SINGULATE_DRAIN_MS", "600000")]);
        assert!(service.status("GET /livez").contains(" 200 "));
        let silent = service.raw("");
        service.signal(signal);
        assert_eq!(service.ended().code(), Some(0));
        drop(silent);
    }
}

#[test]
fn a_service_that_drains_ends_at_once_when_it_is_asked_again() {
    let variables = [("SINGULATE_DRAIN_MS", "600000"), ("SINGULATE_THREADS", "1"), ("SINGULATE_QUEUE", "0")];
    for (signal, status) in [(Signal::TERM, 143), (Signal::INT, 130)] {
        let mut service = Service::with(&variables);
        let body = hard(60_000).to_string();
        let head = "POST /v1/survey HTTP/1.1\r\nhost: x\r\ncontent-type: application/json\r\ncontent-length";
        let surveyed = service.raw(&format!("{head}: {}\r\n\r\n{body}", body.len()));
        let started = Instant::now();
        let patient = |started: Instant| assert!(started.elapsed() < Duration::from_secs(60), "waited in vain");
        // The only thread is busy once another plan is refused. One that comes first would have the survey refused.
        std::thread::sleep(Duration::from_millis(300));
        while !plan_status(&service).contains(" 503 ") {
            patient(started);
        }
        service.signal(signal);
        while !service.status("GET /readyz").contains(" 503 ") {
            patient(started);
        }
        assert!(service.status("GET /livez").contains(" 200 "));
        service.signal(signal);
        assert_eq!(service.ended().code(), Some(status));
        drop(surveyed);
    }
}

/// The status line of the answer to a small plan.
fn plan_status(service: &Service) -> String {
    let body = ALONE;
    let head = "POST /v1/plans HTTP/1.1\r\nhost: x\r\nconnection: close\r\ncontent-type: application/json";
    let mut line = String::new();
    let stream = service.raw(&format!("{head}\r\ncontent-length: {}\r\n\r\n{body}", body.len()));
    BufReader::new(stream).read_line(&mut line).unwrap();
    line
}

#[test]
fn a_service_that_waits_for_its_store_can_be_ended() {
    // It takes connections and never says a word.
    let store = TcpListener::bind("127.0.0.1:0").unwrap();
    let url = format!("postgres://somebody@{}/jobs", store.local_addr().unwrap());
    // Free a moment ago, and on an address that nobody else uses.
    let listen = TcpListener::bind("127.83.71.1:0").unwrap().local_addr().unwrap();
    let mut command = singulate(&["serve", "--listen", &listen.to_string(), "--jobs-url", &url]);
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let _silent = store.accept().unwrap();
    // A probe finds the door closed rather than wait behind it.
    assert_eq!(TcpStream::connect(listen).unwrap_err().kind(), ErrorKind::ConnectionRefused);
    kill_process(Pid::from_child(&child), Signal::TERM).unwrap();
    let output = child.wait_with_output().unwrap();
    let log = String::from_utf8(output.stderr).unwrap();
    assert_eq!((output.status.code(), output.stdout), (Some(0), Vec::new()), "{log}");
    assert!(log.contains("opening the store of jobs") && !log.contains("serving"), "{log}");
}
