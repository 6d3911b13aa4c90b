//! Jobs in a SQLite file: what is in it after a stop, and what is said of others who have it open.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Arc, Mutex};

use sqlx::{Connection, Row, SqliteConnection};
use tokio::task::JoinSet;
use tokio::time::{Instant, sleep};

use crate::client::{Client, id};
use crate::database::Database;
use crate::scenes::short;
use crate::server::Server;
use crate::{LEASE, LOOK_AGAIN, PATIENCE};

/// Each of them at another moment of what is being written.
const STOPS: u64 = 5;
const CLIENTS: u64 = 8;
/// Accepted before each stop.
const ACCEPTED: usize = 40;

fn file(database: &Database) -> PathBuf {
    PathBuf::from(database.url.strip_prefix("sqlite:").unwrap())
}

#[tokio::test(flavor = "multi_thread")]
async fn after_a_stop_under_load_one_file_holds_every_job() {
    for stop in 0..STOPS {
        let database = Database::in_a_file();
        let mut server = Server::start(&database.url, &LEASE);
        let accepted = Arc::<Mutex<Vec<String>>>::default();
        let mut clients = JoinSet::new();
        for number in 0..CLIENTS {
            let (client, accepted) = (Client::of(&[&server.url]), Arc::clone(&accepted));
            clients.spawn(async move {
                for job in 0.. {
                    let reply = client.try_submit(&short(format!("{number}-{job}"), number)).await;
                    // 503, and then nothing: it drains, and is gone.
                    let Ok(reply) = reply else { return };
                    if reply.status == 202 {
                        accepted.lock().unwrap().push(id(&reply.json()));
                    }
                }
            });
        }
        let begin = Instant::now();
        while accepted.lock().unwrap().len() < ACCEPTED {
            assert!(begin.elapsed() < PATIENCE);
            sleep(LOOK_AGAIN).await;
        }
        server.terminate();
        assert_eq!(server.ended(PATIENCE).expect("it ends").code(), Some(0));
        clients.join_all().await;
        let file = file(&database);
        assert_eq!(names(file.parent().unwrap()), ["jobs.db"], "stop {stop}");
        let kept = ids(&file).await;
        assert!(accepted.lock().unwrap().iter().all(|id| kept.contains(id)), "stop {stop}");
    }
}

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
}

/// Of the jobs in a copy of this file alone.
async fn ids(file: &Path) -> Vec<String> {
    let copy = file.with_file_name("copy.db");
    std::fs::copy(file, &copy).unwrap();
    let mut connection = SqliteConnection::connect(&format!("sqlite:{}", copy.display())).await.unwrap();
    let rows = sqlx::query("SELECT id FROM jobs").fetch_all(&mut connection).await.unwrap();
    connection.close().await.unwrap();
    rows.iter().map(|row| row.get("id")).collect()
}

#[tokio::test(flavor = "multi_thread")]
async fn a_second_server_on_one_file_says_so_but_not_after_a_crash() {
    let database = Database::in_a_file();
    let mut first = started(&database).await;
    let mut second = started(&database).await;
    assert!(shares(&second) && !shares(&first), "{}{}", first.log(), second.log());
    let third = started(&database).await;
    assert!(shares(&third));
    // They do share: what one accepts the other knows.
    let job = Client::of(&[&first.url]).submit(&short("shared".to_owned(), 0)).await;
    Client::of(&[&second.url]).job(&id(&job)).await;
    drop(third);
    first.kill();
    second.kill();
    let after = started(&database).await;
    assert!(!shares(&after), "{}", after.log());
    Client::of(&[&after.url]).job(&id(&job)).await;
}

/// As docs/deploy.md says, where the program is installed.
#[tokio::test(flavor = "multi_thread")]
async fn a_backup_of_a_running_server_holds_every_job() {
    let docs = include_str!("../../docs/deploy.md");
    let command = docs.lines().find(|line| line.starts_with("sqlite3 ")).unwrap();
    if Command::new("sqlite3").arg("--version").output().is_err() {
        // Past the test runner, which keeps to itself what is printed in tests that pass.
        writeln!(std::io::stderr(), "not run: a backup by sqlite3, which is not installed").unwrap();
        return;
    }
    let database = Database::in_a_file();
    let server = started(&database).await;
    let job = Client::of(&[&server.url]).submit(&short("kept".to_owned(), 0)).await;
    let file = file(&database);
    let backup = file.with_file_name("backup.db");
    let command = command.replace("/var/lib/singulate/singulate.db", file.to_str().unwrap());
    let command = command.replace("/backup/singulate.db", backup.to_str().unwrap());
    assert!(Command::new("bash").args(["-c", &command]).status().unwrap().success(), "{command}");
    assert_eq!(ids(&backup).await, [id(&job)]);
}

/// Its store is open.
async fn started(database: &Database) -> Server {
    let server = Server::start(&database.url, &LEASE);
    Client::of(&[&server.url]).get("/v1/jobs").await;
    server
}

fn shares(server: &Server) -> bool {
    server.log().contains("another process has this file")
}
