//! Requests that two readers could take for different ones.

use super::served_meanwhile;
use crate::host::Host;

/// What nobody who sends only the first request may get an answer to.
const SMUGGLED: &str = "GET /version HTTP/1.1\r\nhost: x\r\nconnection: close\r\n\r\n";

/// The statuses of all answers on a connection.
fn statuses(text: &str) -> Vec<&str> {
    text.split("HTTP/1.1 ").skip(1).map(|answer| &answer[..3]).collect()
}

#[tokio::test]
async fn a_request_within_a_request_is_never_answered() {
    let host = Host::start().await;
    let head = "POST /v1/plans HTTP/1.1\r\nhost: x\r\ncontent-type: application/json";
    let chunked = "transfer-encoding: chunked";
    let (body, sent) = ("2\r\n{}\r\n0\r\n\r\n", format!("2\r\n{{}}\r\n0\r\n\r\n{SMUGGLED}").len());
    // The fields, the body, the status. What follows the body is the smuggled request.
    let cases = [
        // Two lengths. With chunks the other length doesn't count, and nothing is read behind them.
        (format!("content-length: {sent}\r\n{chunked}"), body, "422"),
        (format!("{chunked}\r\ncontent-length: {sent}"), body, "422"),
        ("content-length: 2\r\ncontent-length: 3".to_owned(), "{}", "400"),
        ("content-length: 2, 2".to_owned(), "{}", "400"),
        // Lengths that are none.
        ("content-length: +2".to_owned(), "{}", "400"),
        ("content-length: 0x2".to_owned(), "{}", "400"),
        ("content-length: -1".to_owned(), "{}", "400"),
        ("content-length: 99999999999999999999".to_owned(), "{}", "400"),
        // Codings that hide from one reader or the other.
        ("transfer-encoding: xchunked".to_owned(), body, "400"),
        ("transfer-encoding: chunked, identity".to_owned(), body, "400"),
        ("transfer-encoding : chunked".to_owned(), body, "400"),
        ("transfer-encoding: \u{b}chunked".to_owned(), body, "400"),
        // A folded field, and a field behind half a line's end.
        (format!("x: y\r\n {chunked}"), body, "400"),
        (format!("x: y\r{chunked}"), body, "400"),
        // Chunks that end in another place for a server that reads them otherwise.
        (chunked.to_owned(), "2\n{}\n0\n\n", "400"),
        (chunked.to_owned(), "2;a\n{}\r\n0\r\n\r\n", "400"),
        (chunked.to_owned(), "2;\rx\r\n{}\r\n0\r\n\r\n", "400"),
        (chunked.to_owned(), "2x\r\n{}\r\n0\r\n\r\n", "400"),
        (chunked.to_owned(), "-2\r\n{}\r\n0\r\n\r\n", "400"),
        (chunked.to_owned(), "1\r\n{}\r\n0\r\n\r\n", "400"),
        (chunked.to_owned(), "fffffffffffffffff\r\n{}\r\n0\r\n\r\n", "400"),
    ];
    served_meanwhile(&host, async || {
        for (fields, body, status) in &cases {
            let text = host.ask(&format!("{head}\r\n{fields}\r\n\r\n{body}{SMUGGLED}")).await;
            assert_eq!(statuses(&text), [*status], "{fields:?} {body:?}: {text}");
        }
        // A body that nobody asked for is a body all the same.
        let length = SMUGGLED.len();
        let probe = format!("GET /livez HTTP/1.1\r\nhost: x\r\ncontent-length: {length}\r\n\r\n{SMUGGLED}");
        let text = host.ask(&format!("{probe}{SMUGGLED}")).await;
        assert_eq!(statuses(&text), ["200", "200"], "{text}");
    })
    .await;
}

#[tokio::test]
async fn an_extension_of_a_chunk_is_passed_over_and_does_not_go_on_for_ever() {
    let host = Host::start().await;
    let head = "POST /v1/plans HTTP/1.1\r\nhost: x\r\ncontent-type: application/json\r\ntransfer-encoding: chunked";
    served_meanwhile(&host, async || {
        for (extension, answers) in [("a=b".to_owned(), &["422", "200"][..]), ("a".repeat(100_000), &["400"])] {
            let text = host.ask(&format!("{head}\r\n\r\n2;{extension}\r\n{{}}\r\n0\r\n\r\n{SMUGGLED}")).await;
            assert_eq!(statuses(&text), answers, "{text}");
        }
    })
    .await;
}

#[tokio::test]
async fn no_path_leads_elsewhere_than_it_says() {
    let host = Host::start().await;
    let paths = [
        // Upwards, in every spelling.
        ("/docs/../livez", "404"),
        ("/docs/%2e%2e/livez", "404"),
        ("/docs/%2E%2E%2F%2E%2E%2Fetc/passwd", "404"),
        ("/docs/..%5c..%5cetc", "404"),
        ("/docs/\\..\\etc", "404"),
        ("/v1/jobs/..", "404"),
        ("/v1/jobs/%2e%2e%2fmetrics", "404"),
        ("/v1/jobs/%2e%2e/plans", "404"),
        ("/./livez", "404"),
        // Not at the root, or not there at all.
        ("//livez", "404"),
        ("/livez//", "404"),
        ("/v1//jobs", "404"),
        ("/docs//etc/passwd", "404"),
        ("livez", "404"),
        ("*", "404"),
        // Spelled otherwise, or with something behind it.
        ("/V1/plans", "404"),
        ("/%6civez", "404"),
        ("/livez%2f", "404"),
        ("/livez%00", "404"),
        ("/livez;x", "404"),
        ("/docs/index.html%00.js", "404"),
        ("/v1/jobs/%00/events", "404"),
        ("/livez\0", "400"),
        ("/v1/jobs/a%0d%0ax: y", "400"),
        ("file:///etc/passwd", "400"),
        // The whole URL, as to a proxy: the path in it counts, and nobody is asked elsewhere.
        ("http://elsewhere.example/livez", "200"),
        ("http://elsewhere.example/docs/../livez", "404"),
        ("http://elsewhere.example/", "307"),
    ];
    served_meanwhile(&host, async || {
        for (path, status) in paths {
            let text = host.ask(&format!("GET {path} HTTP/1.1\r\nhost: x\r\nconnection: close\r\n\r\n")).await;
            assert_eq!(statuses(&text), [status], "{path:?}: {text}");
        }
        for (request, status) in [("CONNECT elsewhere.example:80", "404"), ("TRACE /livez", "405")] {
            let text = host.ask(&format!("{request} HTTP/1.1\r\nhost: x\r\nconnection: close\r\n\r\n")).await;
            assert_eq!(statuses(&text), [status], "{request}: {text}");
        }
    })
    .await;
}
