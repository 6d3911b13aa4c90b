//! A client that costs little: prepared requests on a connection that stays open, and no more read of an answer than is
//! looked at.

use std::io::{self, Read, Write};
use std::net::{SocketAddr, TcpStream};

/// A request to look at something.
pub(crate) fn get(path: &str) -> Vec<u8> {
    format!("GET {path} HTTP/1.1\r\nhost: x\r\n\r\n").into_bytes()
}

/// A request with a body.
pub(crate) fn post(path: &str, body: &[u8]) -> Vec<u8> {
    let head = format!("POST {path} HTTP/1.1\r\nhost: x\r\ncontent-type: application/json\r\ncontent-length: ");
    [format!("{head}{}\r\n\r\n", body.len()).as_bytes(), body].concat()
}

/// A whole answer.
pub(crate) struct Reply {
    pub(crate) status: u16,
    head: String,
    pub(crate) body: Vec<u8>,
}

impl Reply {
    /// The answer, once all of it is here.
    pub(crate) fn complete(received: &[u8]) -> Option<Self> {
        let end = received.windows(4).position(|bytes| bytes == b"\r\n\r\n")? + 2;
        let head = core::str::from_utf8(&received[..end]).expect("heads are ASCII").to_owned();
        let status = head.get(9..12).and_then(|digits| digits.parse().ok()).expect("a status");
        let mut reply = Self { status, head, body: Vec::new() };
        let length: usize = reply.header("content-length").map_or(0, |length| length.parse().expect("a length"));
        reply.body = received.get(end + 2..end + 2 + length)?.to_vec();
        Some(reply)
    }

    /// A header by its name in small letters.
    pub(crate) fn header(&self, name: &str) -> Option<&str> {
        self.head.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(": "))
    }
}

/// A client that waits for each answer.
pub(crate) struct Client<S = TcpStream> {
    stream: S,
    received: Vec<u8>,
}

impl Client {
    pub(crate) fn connect(address: SocketAddr) -> Self {
        let stream = TcpStream::connect(address).expect("the server listens");
        stream.set_nodelay(true).expect("an open connection");
        Self::over(stream)
    }
}

impl<S: Read + Write> Client<S> {
    pub(crate) fn over(stream: S) -> Self {
        Self { stream, received: Vec::new() }
    }

    pub(crate) fn ask(&mut self, request: &[u8]) -> Reply {
        self.try_ask(request).expect("an answer")
    }

    pub(crate) fn try_ask(&mut self, request: &[u8]) -> io::Result<Reply> {
        self.send(request)?;
        self.receive()
    }

    pub(crate) fn send(&mut self, request: &[u8]) -> io::Result<()> {
        self.stream.write_all(request)
    }

    /// The answer to what was sent.
    pub(crate) fn receive(&mut self) -> io::Result<Reply> {
        self.received.clear();
        let mut piece = [0; 16 * 1024];
        loop {
            let length = self.stream.read(&mut piece)?;
            if length == 0 {
                return Err(io::ErrorKind::UnexpectedEof.into());
            }
            self.received.extend_from_slice(&piece[..length]);
            if let Some(reply) = Reply::complete(&self.received) {
                return Ok(reply);
            }
        }
    }
}
