//! A job's events as they arrive.

use reqwest::{Error, Response};
use serde_json::Value;

/// One event.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Message {
    pub(crate) id: String,
    pub(crate) name: String,
    pub(crate) data: Value,
}

/// A stream of them.
pub(crate) struct Messages {
    response: Response,
    text: Vec<u8>,
}

impl Messages {
    pub(crate) fn of(response: Response) -> Self {
        Self { response, text: Vec::new() }
    }

    /// Nothing once the server has ended the stream; an error where it broke.
    pub(crate) async fn next(&mut self) -> Result<Option<Message>, Error> {
        loop {
            if let Some(end) = self.text.windows(2).position(|pair| pair == b"\n\n") {
                let block: Vec<u8> = self.text.drain(..end + 2).collect();
                // A comment only keeps the connection alive.
                if let Some(message) = read(&String::from_utf8(block).unwrap()) {
                    return Ok(Some(message));
                }
            } else {
                let Some(more) = self.response.chunk().await? else { return Ok(None) };
                self.text.extend_from_slice(&more);
            }
        }
    }

    /// Up to the first of this name, which the stream has.
    pub(crate) async fn until(&mut self, name: &str) -> Message {
        loop {
            let message = self.next().await.unwrap().unwrap_or_else(|| panic!("the stream ends without '{name}'"));
            if message.name == name {
                return message;
            }
        }
    }
}

fn read(block: &str) -> Option<Message> {
    let field = |name: &str| block.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(": "));
    let data = serde_json::from_str(field("data")?).unwrap();
    Some(Message { id: field("id").unwrap_or_default().to_owned(), name: field("event")?.to_owned(), data })
}
