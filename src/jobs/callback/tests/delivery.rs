//! Deliveries, repeats, and receivers that must not delay each other.

use core::time::Duration;
use std::sync::Arc;

use rustls::RootCertStore;
use serde_json::json;
use tokio::net::TcpListener;
use tokio::sync::oneshot;
use tokio::task::JoinHandle;

use super::receiver::{Manner, Receiver, status, until};
use super::store::Callbacks;
use crate::jobs::callback::client::system;
use crate::jobs::callback::deliver::{CallbackDelivery, MAX_IN_FLIGHT, MAX_TRIES, Pace, pause};
use crate::jobs::callback::{CallbackAllow, CallbackSecret};
use crate::jobs::{Delivery, JobId, JobSettings, Timestamp};

/// As in service, except for shorter pauses between tries.
pub(super) const QUICK: Duration = Duration::from_millis(1);

pub(super) fn secret() -> CallbackSecret {
    "0123456789abcdef".parse().unwrap()
}

/// No try is cut off unless a test wants it, however slow the machine.
pub(super) fn pace() -> Pace {
    let long = Duration::from_secs(60);
    Pace { connecting: long, a_try: long, first_pause: QUICK, lease: 2 * long, poll: QUICK, farewell: QUICK }
}

/// Delivers to this machine until the sender is dropped.
fn start(store: &Arc<Callbacks>, pace: Pace) -> (oneshot::Sender<()>, JoinHandle<()>) {
    let rules = (system as _, RootCertStore::empty(), pace);
    let delivery = CallbackDelivery::for_tests(Arc::clone(store) as _, "127.0.0.1", &secret(), rules);
    let (stop, stopped) = oneshot::channel::<()>();
    (stop, tokio::spawn(delivery.run(async move { drop(stopped.await) })))
}

async fn until_over(store: &Callbacks, id: JobId) -> Vec<(u32, Delivery)> {
    until("the callback's end", || store.over(id)).await;
    store.settled(id)
}

#[tokio::test]
async fn a_message_arrives_once_as_json_and_signed() {
    let (store, receiver) = (Arc::new(Callbacks::default()), Receiver::start(&[status(204)]).await);
    let id = store.add(&receiver.url());
    let _running = start(&store, pace());
    assert_eq!(until_over(&store, id).await, [(1, Delivery::Over)]);
    let [message] = receiver.received().try_into().unwrap();
    let body: serde_json::Value = serde_json::from_str(&message.body).unwrap();
    assert_eq!(
        (&body["id"], &body["state"], &body["result"]),
        (&json!(id.to_string()), &json!("succeeded"), &json!({}))
    );
    assert!(message.head.starts_with("POST /done?of=cell-4 HTTP/1.1\r\n"), "{}", message.head);
    assert_eq!(message.header("content-type"), "application/json");
    assert!(message.header("user-agent").starts_with("singulate/"));
    let timestamp = message.header("singulate-timestamp");
    let age = Timestamp::now().as_millis() / 1000 - timestamp.parse::<i64>().unwrap();
    assert!((0..120).contains(&age), "{timestamp}");
    assert_eq!(message.header("singulate-signature"), secret().sign(timestamp, message.body.as_bytes()));
}

#[tokio::test]
async fn an_answer_that_says_no_is_asked_again() {
    let (store, receiver) = (Arc::new(Callbacks::default()), Receiver::start(&[status(500), status(200)]).await);
    let id = store.add(&receiver.url());
    let _running = start(&store, pace());
    let settled = until_over(&store, id).await;
    assert!(matches!(settled[..], [(1, Delivery::Again(_)), (2, Delivery::Over)]), "{settled:?}");
    let [first, second] = receiver.received().try_into().unwrap();
    assert_eq!(first.body, second.body);
}

#[tokio::test]
async fn a_callback_that_never_arrives_is_given_up() {
    let closed = TcpListener::bind("127.0.0.1:0").await.unwrap().local_addr().unwrap();
    let elsewhere = Receiver::start(&[status(200)]).await;
    let moved = Manner::Answer(307, format!("location: {}\r\n", elsewhere.url()));
    let (refusing, moved) = (Receiver::start(&[status(400)]).await, Receiver::start(&[moved]).await);
    for url in [format!("http://{closed}/"), refusing.url(), moved.url()] {
        let store = Arc::new(Callbacks::default());
        let id = store.add(&url);
        let _running = start(&store, pace());
        let settled = until_over(&store, id).await;
        let (last, before) = settled.split_last().unwrap();
        assert_eq!((*last, before.len()), ((MAX_TRIES, Delivery::Over), 7), "{url}");
        assert!(before.iter().all(|(_, delivery)| *delivery != Delivery::Over), "{url}");
    }
    let counts = [&refusing, &moved, &elsewhere].map(|receiver| receiver.received().len());
    assert_eq!(counts, [8, 8, 0]);
}

#[tokio::test]
async fn a_receiver_that_is_gone_for_good_is_asked_once() {
    let (store, receiver) = (Arc::new(Callbacks::default()), Receiver::start(&[status(410)]).await);
    let id = store.add(&receiver.url());
    let _running = start(&store, pace());
    assert_eq!(until_over(&store, id).await, [(1, Delivery::Over)]);
    assert_eq!(receiver.received().len(), 1);
}

#[tokio::test]
async fn pauses_double_and_stay_below_five_minutes() {
    let first = Pace::default().first_pause;
    let seconds: Vec<u64> = (1..MAX_TRIES).map(|tries| pause(first, tries).as_secs()).collect();
    assert_eq!(seconds, [2, 4, 8, 16, 32, 64, 128]);
    let (store, receiver) = (Arc::new(Callbacks::default()), Receiver::start(&[status(500)]).await);
    let id = store.add(&receiver.url());
    let before = Timestamp::now();
    let _running = start(&store, Pace { first_pause: Duration::from_secs(600), ..pace() });
    until("the first try", || !store.settled(id).is_empty()).await;
    let [(1, Delivery::Again(then))] = store.settled(id)[..] else { panic!("{:?}", store.settled(id)) };
    assert!(then.since(before) >= Duration::from_secs(600));
}

#[tokio::test]
async fn an_answer_without_end_is_read_no_further_and_counts_by_its_status() {
    let (store, receiver) = (Arc::new(Callbacks::default()), Receiver::start(&[Manner::Babble]).await);
    let id = store.add(&receiver.url());
    let _running = start(&store, pace());
    assert_eq!(until_over(&store, id).await, [(1, Delivery::Over)]);
}

#[tokio::test]
async fn receivers_that_hang_hold_up_nobody_for_more_than_one_try() {
    let store = Arc::new(Callbacks::default());
    let (hanging, quick) = (Receiver::start(&[Manner::Hang]).await, Receiver::start(&[status(200)]).await);
    // Far more than may be in flight, all due before the other.
    let held: Vec<JobId> = (0..200).map(|_| store.add(&hanging.url())).collect();
    let id = store.add(&quick.url());
    let short = Duration::from_millis(500);
    let pace = Pace { a_try: short, first_pause: Duration::from_secs(600), ..pace() };
    let _running = start(&store, pace);
    until("the quick one's turn", || !store.settled(id).is_empty()).await;
    until("a look at each of the others", || held.iter().all(|id| !store.settled(*id).is_empty())).await;
    let tried = hanging.received().len();
    assert!((1..150).contains(&tried), "{tried} of 200 were sent to a receiver that does not answer");
}

#[tokio::test]
async fn no_more_than_so_many_are_under_way() {
    let (store, receiver) = (Arc::new(Callbacks::default()), Receiver::start(&[Manner::Hang]).await);
    for _ in 0..2 * MAX_IN_FLIGHT {
        store.add(&receiver.url());
    }
    let _running = start(&store, pace());
    until("as many as may be", || receiver.received().len() == MAX_IN_FLIGHT).await;
    // Time for a second, wrong delivery to arrive.
    tokio::time::sleep(Duration::from_millis(100)).await;
    assert_eq!(receiver.received().len(), MAX_IN_FLIGHT);
}

#[tokio::test]
async fn no_callback_is_made_without_a_list_and_a_secret() {
    let on = JobSettings {
        callback_allow: "erp.example.com".parse().unwrap(),
        callback_secret: Some(secret()),
        ..JobSettings::default()
    };
    let unlisted = JobSettings { callback_allow: CallbackAllow::default(), ..on.clone() };
    let unsigned = JobSettings { callback_secret: None, ..on.clone() };
    for (settings, told) in [(on, true), (unlisted, false), (unsigned, false)] {
        let store = Arc::new(Callbacks::default());
        let delivery = CallbackDelivery::new(store as _, &settings, Arc::default()).unwrap();
        assert_eq!(delivery.is_some(), told, "{settings:?}");
    }
}

#[tokio::test]
async fn a_callback_under_way_at_a_stop_goes_out_after_the_restart() {
    let (store, receiver) = (Arc::new(Callbacks::default()), Receiver::start(&[Manner::Hang, status(200)]).await);
    let id = store.add(&receiver.url());
    let pace = Pace { lease: Duration::from_millis(50), ..pace() };
    let (stop, running) = start(&store, Pace { poll: Duration::from_secs(600), ..pace });
    until("the first message", || receiver.received().len() == 1).await;
    drop(stop);
    // Far sooner than the time limit of the try.
    running.await.unwrap();
    assert!(store.settled(id).is_empty());
    let _running = start(&store, pace);
    assert_eq!(until_over(&store, id).await, [(2, Delivery::Over)]);
}

#[tokio::test]
async fn a_hint_wakes_it() {
    let (store, receiver) = (Arc::new(Callbacks::default()), Receiver::start(&[status(200)]).await);
    let _running = start(&store, Pace { poll: Duration::from_secs(600), ..pace() });
    for _ in 0..3 {
        let id = store.add(&receiver.url());
        until_over(&store, id).await;
    }
}
