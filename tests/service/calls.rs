//! The lines of curl that the pages show, sent to a server.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use reqwest::Method;

use crate::host::{Host, Reply};

const README: &str = include_str!("../../README.md");
const JOBS: &str = include_str!("../../docs/jobs.md");
const CONTROLLERS: &str = include_str!("../../docs/robot-controllers.md");
/// Where the pages find the service.
const SERVICE: &str = "localhost:8080";

/// The calls of the README, each with its example.
fn calls() -> Vec<(&'static str, &'static str)> {
    let rows = README.lines().filter_map(|line| line.strip_prefix("| `")).filter(|row| row.contains(" | `curl "));
    rows.map(|row| (row.split('`').next().unwrap(), row.rsplit(" | `").next().unwrap().trim_end_matches("` |")))
        .collect()
}

/// What a line of curl asks for.
struct Asked {
    method: Method,
    path: String,
    headers: Vec<(String, String)>,
    body: Option<String>,
}

impl Asked {
    /// Read as a shell in the folder reads it.
    fn of(line: &str, folder: &Path) -> Self {
        let script = format!("curl() {{ printf '%s\\n' \"$@\"; }}\n{line}\n");
        let output = Command::new("sh").args(["-ec", &script]).current_dir(folder).output().unwrap();
        assert!(output.status.success(), "{line}: {}", String::from_utf8_lossy(&output.stderr));
        let text = String::from_utf8(output.stdout).unwrap();
        let mut arguments = text.lines();
        let mut asked = Self { method: Method::GET, path: String::new(), headers: Vec::new(), body: None };
        while let Some(argument) = arguments.next() {
            let mut value = || arguments.next().unwrap();
            match argument {
                "-s" | "-N" => {}
                "--max-time" => drop(value()),
                "-X" => asked.method = value().parse().unwrap(),
                "-H" => asked.add(value()),
                "--json" | "--data-binary" => {
                    let body = value();
                    let file = body.strip_prefix('@').map(|file| fs::read_to_string(folder.join(file)).unwrap());
                    (asked.method, asked.body) = (Method::POST, Some(file.unwrap_or_else(|| body.to_owned())));
                    if argument == "--json" {
                        asked.add("content-type: application/json");
                        asked.add("accept: application/json");
                    }
                }
                url => {
                    let rest = url.trim_start_matches("http://").replace("127.0.0.1", "localhost");
                    asked.path = rest.strip_prefix(SERVICE).unwrap_or_else(|| panic!("{line}: {url}")).to_owned();
                }
            }
        }
        asked
    }

    fn add(&mut self, header: &str) {
        let (name, value) = header.split_once(": ").unwrap();
        self.headers.push((name.to_owned(), value.to_owned()));
    }

    async fn send(self, host: &Host) -> Reply {
        let mut request = host.client.request(self.method, host.url(&self.path));
        for (name, value) in self.headers {
            request = request.header(name, value);
        }
        if let Some(body) = self.body {
            request = request.body(body);
        }
        Reply::of(request.send().await.unwrap()).await
    }
}

/// A folder with the files that the lines name.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(folder.join("src/cli")).unwrap();
    for file in ["src/cli/example.json", "scene.json"] {
        fs::write(folder.join(file), include_str!("../../src/cli/example.json")).unwrap();
    }
    folder
}

#[tokio::test]
async fn every_call_of_the_readme_is_answered() {
    let (host, folder) = (Host::start().await, folder("calls"));
    let calls = calls();
    assert_eq!(calls.len(), README.matches("\n| `GET /").count() + README.matches("\n| `POST /").count() + 1);
    let mut id = String::new();
    for (call, line) in calls {
        let asked = Asked::of(&line.replace("ID", &id), &folder);
        let path = asked.path.split('?').next().unwrap();
        let path = if id.is_empty() { path.to_owned() } else { path.replace(&id, "{id}") };
        assert_eq!(format!("{} {path}", asked.method), call, "{line}");
        let reply = asked.send(&host).await;
        match call {
            // Its job has ended by then.
            "POST /v1/jobs/{id}/cancel" => reply.is_problem(409, "job_finished"),
            _ => assert!((200..300).contains(&reply.status), "{line}: {reply:?}"),
        }
        match call {
            "POST /v1/plans" => fs::write(folder.join("plan.json"), &reply.text).unwrap(),
            "POST /v1/plans/verify" => assert_eq!(reply.json()["valid"], true, "{reply:?}"),
            "POST /v1/jobs" => reply.json()["id"].as_str().unwrap().clone_into(&mut id),
            "GET /v1/jobs/{id}" => assert_eq!(reply.json()["state"], "succeeded", "{reply:?}"),
            _ => {}
        }
    }
}

#[tokio::test]
async fn every_line_of_curl_in_a_block_is_answered() {
    let (host, folder) = (Host::start().await, folder("lines"));
    let mut id = String::new();
    let lines = [README, JOBS, CONTROLLERS].into_iter().flat_map(str::lines).filter(|line| line.starts_with("curl "));
    let lines: Vec<&str> = lines.collect();
    assert_eq!(lines.len(), 5, "{lines:?}");
    for line in lines {
        let reply = Asked::of(&line.replace("ID", &id), &folder).send(&host).await;
        assert!((200..300).contains(&reply.status), "{line}: {reply:?}");
        if reply.status == 202 {
            reply.json()["id"].as_str().unwrap().clone_into(&mut id);
        }
    }
}
