//! Bodies that would cost more than they look.

use serde_json::json;

use super::served_meanwhile;
use crate::host::{Host, scene};

const JSON: (&str, &str) = ("content-type", "application/json");

/// Bits, the first as the least of its byte.
#[derive(Default)]
struct Bits {
    bytes: Vec<u8>,
    count: usize,
}

impl Bits {
    fn push(&mut self, bits: &str) {
        for bit in bits.bytes() {
            if self.count.is_multiple_of(8) {
                self.bytes.push(0);
            }
            *self.bytes.last_mut().unwrap() |= u8::from(bit == b'1') << (self.count % 8);
            self.count += 1;
        }
    }
}

/// So many times 258 spaces and one more, compressed by gzip: thirteen bits for each 258 bytes. The sum of what is inside
/// is wrong, which nobody finds out before having unpacked it.
fn bomb(repeats: usize) -> Vec<u8> {
    let mut bits = Bits::default();
    // The last block, with the fixed codes; a space; again and again 258 bytes like the one before; the end.
    bits.push("110");
    bits.push("01010000");
    for _ in 0..repeats {
        bits.push("1100010100000");
    }
    bits.push("0000000");
    [&[0x1f, 0x8b, 8, 0, 0, 0, 0, 0, 0, 0xff][..], &bits.bytes, &[0; 8]].concat()
}

#[tokio::test]
async fn a_gzip_bomb_is_never_unpacked() {
    let host = Host::start().await;
    // 3.9 MB, and 600 MB within.
    let bomb = bomb(2_400_000);
    assert!(bomb.len() < 4_000_000, "{}", bomb.len());
    served_meanwhile(&host, async || {
        for path in ["/v1/plans", "/v1/plans/verify", "/v1/survey", "/v1/knowledge", "/v1/jobs", "/v1/jobs/batch"] {
            let ask = async |coding: &[(&str, &str)], status, kind| {
                let headers = [&[JSON], coding].concat();
                host.post_with(path, &headers, bomb.clone()).await.is_problem(status, kind);
            };
            for coding in ["gzip", "x-gzip", "deflate", "gzip, gzip"] {
                ask(&[("content-encoding", coding)], 415, "unsupported_media_type").await;
            }
            // Undeclared it is what it looks like: no JSON.
            ask(&[], 400, "malformed_json").await;
        }
    })
    .await;
}

#[tokio::test]
async fn nested_and_endless_json_is_refused() {
    let host = Host::start().await;
    let no_json = [
        "[".repeat(1_000_000),
        "{\"a\":".repeat(500_000),
        format!("{}{}", "[".repeat(100_000), "]".repeat(100_000)),
        format!("\"{}", "a".repeat(3_900_000)),
    ];
    // JSON, but no scene; or not read within the time limit of a scene that names none.
    let no_scene = [format!("[{}0]", "0,".repeat(1_900_000)), format!("{}1", "9".repeat(3_000_000))];
    let bodies: Vec<_> = no_json
        .iter()
        .map(|body| (body, &[400][..]))
        .chain(no_scene.iter().map(|body| (body, &[422, 503][..])))
        .collect();
    served_meanwhile(&host, async || {
        for (body, statuses) in &bodies {
            let reply = host.post_with("/v1/plans", &[JSON], (*body).clone()).await;
            let text: String = reply.text.chars().take(300).collect();
            assert!(statuses.contains(&reply.status), "{}: {text}", reply.status);
        }
    })
    .await;
}

#[tokio::test]
async fn huge_ids_are_refused_and_do_not_come_back() {
    let host = Host::start().await;
    let mut named = scene(60_000);
    named["objects"][0]["id"] = json!("x".repeat(1_500_000));
    named["target"] = named["objects"][0]["id"].clone();
    let mut described = scene(60_000);
    described["scene_id"] = json!("y".repeat(3_000_000));
    served_meanwhile(&host, async || {
        for (body, pointer) in [(&named, "/objects/0/id"), (&described, "/scene_id")] {
            for path in ["/v1/plans", "/v1/jobs"] {
                let reply = host.post(path, body).await;
                reply.is_problem(422, "invalid_request");
                let fault = &reply.json()["errors"][0];
                assert_eq!((&fault["code"], &fault["pointer"]), (&json!("id_length"), &json!(pointer)));
                assert!(reply.text.len() < 10_000, "a huge name comes back whole");
            }
        }
    })
    .await;
}
