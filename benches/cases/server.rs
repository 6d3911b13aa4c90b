//! A real server: the program of this build, in a process of its own.

use std::fs;
use std::io::{BufRead, BufReader};
use std::net::SocketAddr;
use std::process::{Child, ChildStdout, Command, Stdio};

/// A server on a free port. Dropping it kills it.
pub(crate) struct Server {
    child: Child,
    /// Kept open: a program that writes where nobody reads is ended.
    _out: BufReader<ChildStdout>,
    address: SocketAddr,
}

impl Server {
    pub(crate) fn start(jobs_url: &str, arguments: &[&str]) -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_singulate"));
        command.args(["serve", "--listen", "127.0.0.1:0", "--log", "error", "--jobs-url", jobs_url]).args(arguments);
        let mut child = command.stdout(Stdio::piped()).spawn().expect("the program of this build");
        let mut out = BufReader::new(child.stdout.take().expect("a pipe"));
        let mut line = String::new();
        out.read_line(&mut line).expect("a line");
        let address = line.split_whitespace().find_map(|word| word.split_once("://")?.1.parse().ok());
        Self { child, _out: out, address: address.unwrap_or_else(|| panic!("no address: '{line}'")) }
    }

    pub(crate) fn address(&self) -> SocketAddr {
        self.address
    }

    pub(crate) fn process(&self) -> u32 {
        self.child.id()
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The resident memory of a process, kB.
pub(crate) fn resident(process: u32) -> u64 {
    let status = fs::read_to_string(format!("/proc/{process}/status")).expect("the process lives");
    let size = status.lines().find_map(|line| line.strip_prefix("VmRSS:")?.split_whitespace().next()?.parse().ok());
    size.expect("its size")
}
