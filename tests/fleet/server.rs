//! A server in a process of its own.

use core::time::Duration;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, ChildStdout, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::sleep;
use std::time::Instant;

use rustix::process::{Pid, Signal, kill_process};

use crate::LOOK_AGAIN;

static SERVERS: AtomicUsize = AtomicUsize::new(0);

/// Killed with its test, if not before.
pub(crate) struct Server {
    child: Child,
    /// Open as long as the server: it may still have something to say.
    _out: BufReader<ChildStdout>,
    log: PathBuf,
    pub(crate) url: String,
}

impl Server {
    /// Two threads for jobs, on a free port, with these flags besides; it answers when this returns.
    pub(crate) fn start(jobs_url: &str, flags: &[&str]) -> Self {
        let number = SERVERS.fetch_add(1, Ordering::Relaxed);
        let log = std::env::temp_dir().join(format!("singulate_{}_{number}.log", std::process::id()));
        let mut command = Command::new(env!("CARGO_BIN_EXE_singulate"));
        for (name, _) in std::env::vars_os().filter(|(name, _)| name.to_string_lossy().starts_with("SINGULATE_")) {
            command.env_remove(name);
        }
        command.args(["serve", "--listen", "127.0.0.1:0", "--log", "warn", "--jobs-url", jobs_url]);
        command.args(["--job-threads", "2"]).args(flags);
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(File::create(&log).unwrap());
        let mut child = command.spawn().unwrap();
        let mut out = BufReader::new(child.stdout.take().unwrap());
        let mut line = String::new();
        out.read_line(&mut line).unwrap();
        let url = line.split_whitespace().find(|word| word.starts_with("http://")).unwrap_or_default().to_owned();
        let server = Self { child, _out: out, log, url };
        assert!(!server.url.is_empty(), "it says where it is: '{line}'");
        server
    }

    /// What it has logged, warnings and worse.
    pub(crate) fn log(&self) -> String {
        std::fs::read_to_string(&self.log).unwrap()
    }

    /// From one moment to the next.
    pub(crate) fn kill(&mut self) {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
    }

    /// Ask it to end.
    pub(crate) fn terminate(&self) {
        kill_process(Pid::from_child(&self.child), Signal::TERM).unwrap();
    }

    /// How it ended, if it did within the time.
    pub(crate) fn ended(&mut self, within: Duration) -> Option<ExitStatus> {
        let begin = Instant::now();
        loop {
            match self.child.try_wait().unwrap() {
                None if begin.elapsed() < within => sleep(LOOK_AGAIN),
                status => return status,
            }
        }
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        // It may have ended.
        let _ = self.child.kill();
        let _ = self.child.wait();
        if std::thread::panicking() {
            let log = std::fs::read_to_string(&self.log).unwrap_or_default();
            let last: Vec<&str> = log.lines().rev().take(20).collect();
            eprintln!("the last lines of {}, the latest first:\n{}", self.url, last.join("\n"));
        }
        let _ = std::fs::remove_file(&self.log);
    }
}
