//! Clients that mean harm. Whatever one of them does, the service lives and the others are served meanwhile.

mod bodies;
mod floods;
mod requests;
mod slow;

use core::pin::pin;
use core::time::Duration;
use std::io::Write;
use std::net::TcpStream;

use crate::host::{Host, raw_plan, scene};

/// How many plans somebody else gets while an attack is on.
const PLANS: usize = 3;

/// Somebody else gets a plan, on a connection of its own.
async fn others_are_served(host: &Host) {
    let plan = raw_plan(&scene(60_000)).replacen("host: x", "host: x\r\nconnection: close", 1);
    let text = host.ask(&plan).await;
    assert!(text.starts_with("HTTP/1.1 200 ") && text.contains("graspable"), "{text}");
}

/// Attack, again and again until somebody else has been served in the meantime; and once more when it is over.
async fn served_meanwhile(host: &Host, mut attack: impl AsyncFnMut()) {
    let mut others = pin!(async {
        for _ in 0..PLANS {
            others_are_served(host).await;
        }
    });
    loop {
        let mut attack = pin!(attack());
        // The attack is polled first: nobody asks before it has begun.
        let served = tokio::select! {
            biased;
            () = &mut attack => false,
            () = &mut others => true,
        };
        if served {
            attack.await;
            break;
        }
    }
    others_are_served(host).await;
}

/// Send, however little of it the server takes; it may close the connection meanwhile.
async fn send(mut stream: TcpStream, bytes: impl AsRef<[u8]> + Send + 'static) -> TcpStream {
    let sending = tokio::task::spawn_blocking(move || {
        stream.set_write_timeout(Some(Duration::from_millis(200))).unwrap();
        let _ = stream.write_all(bytes.as_ref());
        stream
    });
    sending.await.unwrap()
}
