//! Requests whose body nobody reads: the answer can be read, and the connection goes on or says that it does not.

use core::fmt;
use core::time::Duration;
use std::path::Path;
use std::sync::Arc;

use rustls::ClientConfig;
use singulate::api::{Engine, ServerSettings};
use singulate::keys::{FreshKey, append};
use tokio::io::{AsyncRead, AsyncReadExt, AsyncWrite, AsyncWriteExt};
use tokio::net::TcpStream;
use tokio::time::{sleep, timeout};

use crate::host::{Host, PATIENCE, raw_plan, scene};
use crate::tls::authority::Authority;
use crate::tls::{connect, secure_host};

const SIZES: [usize; 3] = [300, 60_000, 3_500_000];
const LAST_LIVEZ: &str = "GET /livez HTTP/1.1\r\nhost: x\r\nconnection: close\r\n\r\n";

trait Stream: AsyncRead + AsyncWrite + Unpin {}
impl<S: AsyncRead + AsyncWrite + Unpin> Stream for S {}

/// How a client speaks with the service.
#[derive(Debug, Clone, Copy)]
enum Over {
    Plain,
    Tls,
    /// In the clear where TLS is spoken.
    WrongPort,
}

/// How a body is delimited.
#[derive(Debug, Clone, Copy)]
enum Framing {
    Length,
    Chunks,
}

/// A request and the status that it gets, whatever its body is.
struct Case {
    status: u16,
    line: &'static str,
    fields: String,
}

fn case(status: u16, line: &'static str, fields: &str) -> Case {
    Case { status, line, fields: fields.to_owned() }
}

/// What a request is followed by.
struct Sent {
    framing: Framing,
    length: usize,
}

impl Sent {
    fn field(&self) -> String {
        match self.framing {
            Framing::Length => format!("content-length: {}", self.length),
            Framing::Chunks => "transfer-encoding: chunked".to_owned(),
        }
    }

    fn bytes(&self) -> Vec<u8> {
        let body = " ".repeat(self.length);
        match self.framing {
            Framing::Length => body.into_bytes(),
            Framing::Chunks => format!("{:x}\r\n{body}\r\n0\r\n\r\n", self.length).into_bytes(),
        }
    }
}

impl Case {
    fn head(&self, sent: &Sent) -> String {
        format!("{} HTTP/1.1\r\nhost: x\r\n{}{}\r\n\r\n", self.line, self.fields, sent.field())
    }
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.status, self.line)
    }
}

/// One service that is asked in the clear and one by TLS.
struct Services {
    plain: Host,
    secure: Host,
    client: Arc<ClientConfig>,
    _authority: Authority,
}

impl Services {
    async fn start(name: &str, settings: ServerSettings) -> Self {
        // No machine is so slow that a body is cut off.
        let settings = ServerSettings { body_timeout: PATIENCE, ..settings };
        let authority = Authority::new(name);
        let secure = secure_host(&authority, settings.clone(), Engine::default()).await;
        let plain = Host::with(settings, Engine::default()).await;
        Self { plain, secure, client: authority.client(None), _authority: authority }
    }

    async fn connect(&self, over: Over) -> Box<dyn Stream> {
        match over {
            Over::Plain => Box::new(TcpStream::connect(self.plain.address).await.unwrap()),
            Over::WrongPort => Box::new(TcpStream::connect(self.secure.address).await.unwrap()),
            Over::Tls => Box::new(connect(&self.secure, &self.client).await.unwrap()),
        }
    }

    /// Every case, with bodies of these lengths: head and body come in two packets, and the client reads only once it has
    /// sent everything.
    async fn all_are_answered(&self, overs: &[Over], cases: &[Case], lengths: &[usize]) {
        let mut wrong = Vec::new();
        for &over in overs {
            for case in cases {
                for &length in lengths {
                    for framing in [Framing::Length, Framing::Chunks] {
                        let mut stream = self.connect(over).await;
                        if let Err(why) = in_two_packets(&mut stream, case, &Sent { framing, length }).await {
                            wrong.push(format!("{over:?} {case} {framing:?} {length}: {why}"));
                        }
                    }
                }
            }
        }
        assert!(wrong.is_empty(), "{} cut:\n{}", wrong.len(), wrong.join("\n"));
    }
}

async fn in_two_packets(stream: &mut Box<dyn Stream>, case: &Case, sent: &Sent) -> Result<(), String> {
    let send = async |stream: &mut Box<dyn Stream>, bytes: &[u8]| {
        stream.write_all(bytes).await.map_err(|error| format!("not sent: {error}"))?;
        stream.flush().await.map_err(|error| format!("not sent: {error}"))
    };
    send(stream, case.head(sent).as_bytes()).await?;
    sleep(Duration::from_millis(10)).await;
    send(stream, &sent.bytes()).await?;
    let head = answer(stream, case.status).await?;
    goes_on_as_it_says(stream, &head).await
}

/// The head of the next answer, which has this status and is whole.
async fn answer(stream: &mut Box<dyn Stream>, status: u16) -> Result<String, String> {
    let mut bytes = Vec::new();
    let (head, length) = loop {
        let text = String::from_utf8_lossy(&bytes).into_owned();
        if let Some((head, body)) = text.split_once("\r\n\r\n") {
            let field = head.lines().find_map(|line| line.strip_prefix("content-length: "));
            break (head.to_owned(), field.unwrap().parse::<usize>().unwrap() - body.len());
        }
        let read = timeout(PATIENCE, stream.read_buf(&mut bytes)).await.expect("an answer or an end");
        if read.map_err(|error| format!("no answer: {error}"))? == 0 {
            return Err("no answer".to_owned());
        }
    };
    let mut rest = vec![0; length];
    let read = timeout(PATIENCE, stream.read_exact(&mut rest)).await.expect("an answer or an end");
    read.map_err(|error| format!("half an answer: {error}"))?;
    if head.starts_with(&format!("HTTP/1.1 {status} ")) { Ok(head) } else { Err(head) }
}

/// The next request is answered, unless the end was announced: then it comes, and in order.
async fn goes_on_as_it_says(stream: &mut Box<dyn Stream>, head: &str) -> Result<(), String> {
    if head.contains("\r\nconnection: close") {
        let mut rest = Vec::new();
        let end = timeout(PATIENCE, stream.read_to_end(&mut rest)).await.expect("it ends");
        return match end {
            Ok(0) => Ok(()),
            end => Err(format!("not an end in order: {end:?}")),
        };
    }
    let next = async {
        stream.write_all(LAST_LIVEZ.as_bytes()).await.map_err(|error| format!("cut unannounced: {error}"))?;
        answer(stream, 200).await.map_err(|error| format!("cut unannounced: {error}"))
    };
    next.await.map(drop)
}

const JSON: &str = "content-type: application/json\r\n";

#[tokio::test]
async fn a_request_that_is_answered_without_its_body_is_answered_and_so_is_the_next() {
    let services = Services::start("unread", ServerSettings::default()).await;
    let long_key = format!("{JSON}idempotency-key: {}\r\n", "k".repeat(256));
    let cases = [
        case(404, "POST /v1/nothing", JSON),
        case(404, "DELETE /v1/jobs/none", ""),
        case(405, "POST /livez", JSON),
        case(406, "POST /v1/plans", &format!("{JSON}accept: text/html\r\n")),
        case(415, "POST /v1/plans", "content-type: text/plain\r\n"),
        case(422, "POST /v1/jobs", &format!("{JSON}idempotency-key: \r\n")),
        case(422, "POST /v1/jobs", &long_key),
        case(200, "GET /livez", ""),
        case(200, "GET /v1/jobs", ""),
    ];
    services.all_are_answered(&[Over::Plain, Over::Tls], &cases, &SIZES).await;
    services.all_are_answered(&[Over::WrongPort], &[case(400, "POST /v1/plans", JSON)], &SIZES).await;
}

#[tokio::test]
async fn a_caller_who_is_not_let_in_is_told_so_whatever_is_sent() {
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("unread-{}.toml", std::process::id()));
    let key = |name, rate: &str| FreshKey::new(name, "jobs".parse().unwrap(), rate.parse().unwrap()).unwrap();
    let (often, once) = (key("often", "1000000"), key("once", "0.001"));
    append(&often, &file).unwrap();
    append(&once, &file).unwrap();
    let settings = ServerSettings { api_keys_file: Some(file.clone()), ..ServerSettings::default() };
    let services = Services::start("unread-keys", settings).await;
    let with = |key: &FreshKey| format!("{JSON}authorization: Bearer {}\r\n", key.text());
    for host in [&services.plain, &services.secure] {
        let request = host.client.get(host.url("/v1/jobs")).header("authorization", format!("Bearer {}", once.text()));
        assert_eq!(request.send().await.unwrap().status(), 200);
    }
    let cases = [
        case(401, "POST /v1/plans", JSON),
        case(403, "POST /v1/plans", &with(&often)),
        case(429, "POST /v1/jobs", &with(&once)),
    ];
    services.all_are_answered(&[Over::Plain, Over::Tls], &cases, &SIZES).await;
    std::fs::remove_file(file).unwrap();
}

#[tokio::test]
async fn a_body_that_is_far_too_large_is_taken_until_the_refusal_is_read() {
    let settings = ServerSettings { max_body_bytes: 1000, ..ServerSettings::default() };
    let services = Services::start("unread-large", settings).await;
    let cases = [case(413, "POST /v1/plans", JSON), case(404, "POST /v1/nothing", JSON), case(200, "GET /livez", "")];
    services.all_are_answered(&[Over::Plain, Over::Tls], &cases, &[60_000, 30_000_000]).await;
}

#[tokio::test]
async fn a_client_that_waits_for_its_refusal_before_it_sends_the_body_gets_it() {
    let services = Services::start("unread-waits", ServerSettings::default()).await;
    for over in [Over::Plain, Over::Tls] {
        for length in SIZES {
            let (case, sent) = (case(404, "POST /v1/nothing", JSON), Sent { framing: Framing::Length, length });
            let mut stream = services.connect(over).await;
            stream.write_all(case.head(&sent).as_bytes()).await.unwrap();
            let head = answer(&mut stream, 404).await.unwrap();
            assert!(head.contains("\r\nconnection: close"), "{head}");
            stream.write_all(&sent.bytes()).await.unwrap();
            goes_on_as_it_says(&mut stream, &head).await.unwrap();
        }
    }
}

#[tokio::test]
async fn a_client_that_asks_before_it_sends_is_told_to_send_only_what_is_read() {
    let services = Services::start("unread-expects", ServerSettings::default()).await;
    let expect = format!("{JSON}expect: 100-continue\r\n");
    for over in [Over::Plain, Over::Tls] {
        for refused in [case(404, "POST /v1/nothing", &expect), case(200, "GET /livez", &expect)] {
            for sends in [false, true] {
                let sent = Sent { framing: Framing::Length, length: 60_000 };
                let mut stream = services.connect(over).await;
                stream.write_all(refused.head(&sent).as_bytes()).await.unwrap();
                let head = answer(&mut stream, refused.status).await.unwrap();
                assert!(head.contains("\r\nconnection: close"), "{head}");
                if sends {
                    // It may, and nobody can tell a body from a next request.
                    stream.write_all(&sent.bytes()).await.unwrap();
                }
                goes_on_as_it_says(&mut stream, &head).await.unwrap();
            }
        }
        let mut stream = services.connect(over).await;
        let plan = raw_plan(&scene(60_000)).replacen("host: x", "host: x\r\nexpect: 100-continue", 1);
        let (head, body) = plan.split_once("\r\n\r\n").unwrap();
        stream.write_all(format!("{head}\r\n\r\n").as_bytes()).await.unwrap();
        let mut told = [0; "HTTP/1.1 100 Continue\r\n\r\n".len()];
        stream.read_exact(&mut told).await.unwrap();
        assert_eq!(&told, b"HTTP/1.1 100 Continue\r\n\r\n");
        stream.write_all(body.as_bytes()).await.unwrap();
        let head = answer(&mut stream, 200).await.unwrap();
        assert!(!head.contains("\r\nconnection: close"), "{head}");
        goes_on_as_it_says(&mut stream, &head).await.unwrap();
    }
}

#[tokio::test]
async fn garbled_chunks_end_the_connection_with_an_announcement() {
    let services = Services::start("unread-garbled", ServerSettings::default()).await;
    for over in [Over::Plain, Over::Tls] {
        for refused in [case(400, "POST /v1/plans", JSON), case(404, "POST /v1/nothing", JSON)] {
            let mut stream = services.connect(over).await;
            let head = refused.head(&Sent { framing: Framing::Chunks, length: 0 });
            stream.write_all(format!("{head}5\r\n{}", "x".repeat(1_000_000)).as_bytes()).await.unwrap();
            let head = answer(&mut stream, refused.status).await.unwrap();
            assert!(head.contains("\r\nconnection: close"), "{head}");
            goes_on_as_it_says(&mut stream, &head).await.unwrap();
        }
    }
}

#[tokio::test]
async fn a_client_that_never_stops_sending_is_not_taken_from_for_ever() {
    let body_timeout = Duration::from_millis(100);
    let settings = ServerSettings { connections: 1, body_timeout, ..ServerSettings::default() };
    let host = Host::with(settings, Engine::default()).await;
    for line in ["POST /v1/nothing", "POST /v1/plans"] {
        let endless = Sent { framing: Framing::Length, length: 1_000_000_000_000 };
        let mut stream = TcpStream::connect(host.address).await.unwrap();
        stream.write_all(case(0, line, JSON).head(&endless).as_bytes()).await.unwrap();
        let sending = async { while stream.write_all(&[b' '; 10_000]).await.is_ok() {} };
        timeout(PATIENCE, sending).await.expect("it is cut off");
        // The only connection is free again.
        assert!(host.ask(LAST_LIVEZ).await.starts_with("HTTP/1.1 200 "));
    }
}
