//! Where jobs can be kept: what is made at the first start, what outlives it, and what is said where it can't be.

use std::sync::Arc;

use singulate::jobs::{JobSettings, open};
use sqlx::{Connection, Row, SqliteConnection};
use tokio::task::JoinSet;

use crate::home::{Home, ann, at, job, submitted};

async fn refusal(url: &str) -> String {
    match open(&JobSettings { url: url.to_owned(), ..JobSettings::default() }, Arc::default()).await {
        Ok(_) => panic!("{url} opens"),
        Err(error) => error.to_string(),
    }
}

#[tokio::test]
async fn jobs_in_a_file_outlive_their_server() {
    let home = Home::in_a_file();
    let kept = submitted(&home.store().await, job()).await;
    let store = home.store().await;
    assert_eq!(store.get(&ann(), kept.id).await.unwrap(), Some(kept.clone()));
    assert_eq!(store.claim(&at(1).into()).await.unwrap().unwrap().claim.id, kept.id);
}

#[tokio::test]
async fn a_file_is_made_once_however_many_start_at_the_same_time() {
    let home = Home::in_a_file();
    let mut starts = JoinSet::new();
    for _ in 0..8 {
        let settings = home.settings.clone();
        starts.spawn(async move {
            let store = open(&settings, Arc::default()).await.unwrap();
            submitted(&store, job()).await;
        });
    }
    starts.join_all().await;
    assert_eq!(home.store().await.counts().await.unwrap().queued, 8);
}

#[tokio::test]
async fn a_file_has_a_log_that_is_written_ahead() {
    let home = Home::in_a_file();
    let store = home.store().await;
    let mut connection = SqliteConnection::connect(&home.settings.url).await.unwrap();
    let row = sqlx::query("PRAGMA journal_mode").fetch_one(&mut connection).await.unwrap();
    assert_eq!(row.get::<String, _>(0), "wal");
    store.ping().await.unwrap();
}

#[tokio::test]
async fn a_closed_store_is_one_file_with_all_of_it() {
    let home = Home::in_a_file();
    let file = home.settings.url.strip_prefix("sqlite:").unwrap().to_owned();
    let store = home.store().await;
    let kept = submitted(&store, job()).await;
    let beside = |ending| std::fs::metadata(format!("{file}{ending}"));
    assert!(beside("-wal").unwrap().len() > 0, "else there would be nothing to be seen");
    store.close().await.unwrap();
    assert!(beside("-wal").is_err() && beside("-shm").is_err());
    let copy = JobSettings { url: format!("sqlite:{file}.copy"), ..home.settings.clone() };
    std::fs::copy(&file, format!("{file}.copy")).unwrap();
    let copied = open(&copy, Arc::default()).await.unwrap();
    assert_eq!(copied.get(&ann(), kept.id).await.unwrap(), Some(kept));
}

#[tokio::test]
async fn a_file_that_others_have_open_is_complete_when_one_of_them_closes_it() {
    let home = Home::in_a_file();
    let (here, there) = (home.store().await, home.store().await);
    submitted(&here, job()).await;
    here.close().await.unwrap();
    let log = format!("{}-wal", home.settings.url.strip_prefix("sqlite:").unwrap());
    assert_eq!(std::fs::metadata(&log).unwrap().len(), 0);
    submitted(&there, job()).await;
    there.close().await.unwrap();
    assert!(std::fs::metadata(&log).is_err());
}

#[tokio::test]
async fn a_log_left_beside_the_file_is_reported() {
    let home = Home::in_a_file();
    let store = home.store().await;
    submitted(&store, job()).await;
    // Somebody reads what was there before.
    let mut reader = SqliteConnection::connect(&home.settings.url).await.unwrap();
    sqlx::raw_sql("BEGIN; SELECT COUNT(*) FROM jobs").execute(&mut reader).await.unwrap();
    submitted(&store, job()).await;
    let error = store.close().await.unwrap_err();
    assert!(error.to_string().contains("-wal"), "{error}");
}

#[tokio::test]
async fn a_closed_store_says_so() {
    for home in [Home::in_a_file(), Home::in_memory().await] {
        let store = home.store().await;
        store.close().await.unwrap();
        assert!(store.submit(&[job()], at(0)).await.is_err());
        assert!(store.get(&ann(), job().id).await.is_err());
        store.close().await.unwrap();
    }
}

#[tokio::test]
async fn an_address_may_hold_any_name_and_parameters() {
    let home = Home::in_a_file();
    for name in ["?mode=rwc", "?cache=private", " and ünïcode.db"] {
        let settings = JobSettings { url: format!("{}{name}", home.settings.url), ..home.settings.clone() };
        let store = open(&settings, Arc::default()).await.unwrap();
        submitted(&store, job()).await;
    }
    // Relative to where the server runs.
    let up = "../".repeat(std::env::current_dir().unwrap().components().count());
    let relative = home.settings.url.replacen('/', &up, 1);
    let store = open(&JobSettings { url: relative, ..home.settings.clone() }, Arc::default()).await.unwrap();
    assert_eq!(store.counts().await.unwrap().queued, 2);
    // Read-only, there is nothing to be kept.
    let error = refusal(&format!("{}?mode=ro", home.settings.url)).await;
    assert!(error.contains("readonly"), "{error}");
}

#[tokio::test]
async fn an_unusable_jobs_url_names_the_setting() {
    let home = Home::in_a_file();
    let missing = format!("{}/missing/jobs.db", home.settings.url);
    let folder = home.settings.url.trim_end_matches("/jobs.db").to_owned();
    for url in [
        missing.as_str(),
        &folder,
        "sqlite:jobs.db?mode=odd",
        "postgres://u:secret@127.0.0.1:1/jobs",
        "mysql://h/d",
        "",
    ] {
        let error = refusal(url).await;
        assert!(error.starts_with("--jobs-url: "), "{error}");
        assert!(!error.contains("secret"), "{error}");
    }
    assert!(refusal(&missing).await.contains("folder"));
}

#[tokio::test]
async fn an_address_that_names_no_file_is_refused() {
    // SQLite would open each of them, keep what it is given for one connection alone, and forget it.
    for url in ["sqlite:", "sqlite://", "sqlite:?mode=rwc", "sqlite:jobs.db?mode=memory"] {
        let text = refusal(url).await;
        assert!(text.contains("names no file"), "{url}: {text}");
    }
}

#[tokio::test]
async fn a_writer_whose_transaction_was_ended_behind_its_back_is_replaced() {
    let home = Home::in_a_file();
    let store = home.store().await;
    // A statement that fails so ends the whole transaction, as a full disk does.
    let mut other = SqliteConnection::connect(&home.settings.url).await.unwrap();
    sqlx::query("CREATE TRIGGER full BEFORE INSERT ON jobs WHEN length(NEW.body) > 1000 BEGIN SELECT RAISE(ROLLBACK, 'full'); END")
        .execute(&mut other)
        .await
        .unwrap();
    let large = singulate::jobs::NewJob { body: vec![b' '; 2000], ..job() };
    assert!(store.submit(&[large], at(0)).await.is_err());
    // SQLite has rolled back by itself, which the driver does not know.
    submitted(&store, job()).await;
}
