//! Replaces hyper's own refusals of bad heads, which have a status and no body, by problems.

use crate::wire::{Problem, ProblemKind};

use super::browsers::OF_DATA;
use super::problem::PROBLEM_JSON;

/// The problem response that replaces these bytes, if they are a refusal without a body. All our own refusals have one.
pub(super) fn problem_for(bytes: &[u8]) -> Option<Vec<u8>> {
    let head = bytes.strip_suffix(b"\r\n\r\n").and_then(|head| core::str::from_utf8(head).ok())?;
    let (status_line, fields) = head.split_once("\r\n")?;
    let status = status_line.strip_prefix("HTTP/1.1 ").or_else(|| status_line.strip_prefix("HTTP/1.0 "))?.get(..3)?;
    let (kind, detail) = match status {
        "400" => (ProblemKind::MalformedHttp, "the request's head is not HTTP/1.1"),
        "414" => (ProblemKind::UriTooLong, "the path is longer than any path of this service"),
        "431" => (ProblemKind::HeadTooLarge, "a head has at most 100 fields and 400 kB"),
        _ => return None,
    };
    let kept: Vec<&str> = fields.split("\r\n").filter(|field| *field != "content-length: 0").collect();
    if kept.len() == fields.split("\r\n").count() {
        return None;
    }
    Some(response(status_line, &kept.join("\r\n"), &Problem::new(kind, detail)))
}

/// The answer to a client that starts with HTTP/2. Such clients recognise HTTP/1.1 and name it in their error.
pub(super) fn of_http_2() -> Vec<u8> {
    let detail = "this service speaks HTTP/1.1, not HTTP/2";
    response("HTTP/1.1 400 Bad Request", "connection: close", &Problem::new(ProblemKind::MalformedHttp, detail))
}

fn response(status_line: &str, fields: &str, problem: &Problem) -> Vec<u8> {
    // Only strings and numbers, so it can be written.
    let body = serde_json::to_string(problem).unwrap_or_default();
    let length = body.len();
    let policy: String = OF_DATA.iter().map(|(name, value)| format!("{name}: {value}\r\n")).collect();
    let own = format!("content-type: {PROBLEM_JSON}\r\ncontent-length: {length}\r\n{policy}");
    format!("{status_line}\r\n{own}{fields}\r\n\r\n{body}").into_bytes()
}

#[cfg(test)]
mod tests {
    use super::problem_for;

    #[test]
    fn an_empty_refusal_gets_a_body_and_keeps_its_other_fields() {
        let bytes = b"HTTP/1.1 414 URI Too Long\r\nconnection: close\r\ncontent-length: 0\r\ndate: x\r\n\r\n";
        let text = String::from_utf8(problem_for(bytes).unwrap()).unwrap();
        let (head, body) = text.split_once("\r\n\r\n").unwrap();
        let length = format!("content-length: {}", body.len());
        let mut lines: Vec<&str> = head.split("\r\n").collect();
        lines.retain(|line| !line.starts_with("x-") && !line.contains("-policy: "));
        let kept = ["content-type: application/problem+json", &length, "connection: close", "date: x"];
        assert_eq!(lines, [&["HTTP/1.1 414 URI Too Long"][..], &kept].concat());
        assert!(head.contains("\r\nx-content-type-options: nosniff\r\n"), "{head}");
        assert!(body.contains("\"type\":\"urn:singulate:problem:uri_too_long\""));
    }

    #[test]
    fn anything_else_goes_out_as_it_is() {
        for text in [
            "HTTP/1.1 200 OK\r\ncontent-length: 0\r\n\r\n",
            "HTTP/1.1 400 Bad Request\r\ncontent-length: 2\r\n\r\n{}",
            "HTTP/1.1 400 Bad Request\r\ncontent-length: 2\r\n\r\n",
            "HTTP/1.1 4",
            "{\"status\":\"HTTP/1.1 400\"}",
            "",
        ] {
            assert_eq!(problem_for(text.as_bytes()), None, "{text}");
        }
    }
}
