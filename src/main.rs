//! The `singulate` binary.

use singulate::api::{ServerSettings, run};
use tokio::net::TcpListener;

#[tokio::main]
async fn main() -> std::io::Result<()> {
    let listener = TcpListener::bind("127.0.0.1:8080").await?;
    run(listener, ServerSettings::default(), async {
        // Without a handler for the signal only killing ends the process.
        let _ = tokio::signal::ctrl_c().await;
    })
    .await
}
