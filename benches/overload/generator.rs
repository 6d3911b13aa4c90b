//! Sends what is due whether or not earlier requests have been answered: clients that know nothing of each other.
//!
//! One thread does it all, without looking at more of an answer than its head. What is due while every connection waits
//! for an answer is not sent, and counts as not offered.

use std::cell::RefCell;
use std::io;
use std::net::SocketAddr;
use std::rc::Rc;
use std::time::{Duration, Instant};

use tokio::net::TcpStream;
use tokio::runtime;
use tokio::task::LocalSet;
use tokio::time::{MissedTickBehavior, interval, sleep};

use super::capacity::Capacity;
use super::client::Reply;
use super::mix::Mix;
use super::tally::{Order, Tally};

/// Of each kind, so that neither takes those of the other: more than the plans that the server lets wait, all of which
/// hold a connection, and enough for refusals on their way.
const CONNECTIONS: usize = 300;
const TICK: Duration = Duration::from_millis(2);
/// For the last answers; no plan has so much time, and no write to the store.
const PATIENCE: Duration = Duration::from_secs(60);

/// Where orders go.
struct Lines {
    address: SocketAddr,
    idle: RefCell<Vec<TcpStream>>,
    tally: RefCell<Tally>,
}

/// Offer so much per second for so long, and wait for the last answers.
pub(super) fn offer(address: SocketAddr, mix: &Rc<Mix>, rate: &Capacity, length: Duration) -> Tally {
    let runtime = runtime::Builder::new_current_thread().enable_all().build().expect("a thread");
    let lines = Rc::new(Lines { address, idle: RefCell::default(), tally: RefCell::default() });
    LocalSet::new().block_on(&runtime, send(&lines, mix, rate, length));
    drop(runtime);
    lines.tally.take()
}

async fn send(lines: &Rc<Lines>, mix: &Rc<Mix>, rate: &Capacity, length: Duration) {
    let mut tick = interval(TICK);
    tick.set_missed_tick_behavior(MissedTickBehavior::Delay);
    let (started, mut plans, mut jobs) = (Instant::now(), 0, 0);
    while started.elapsed() < length {
        tick.tick().await;
        let seconds = started.elapsed().as_secs_f64();
        while f64::from(plans) < rate.plans * seconds {
            lines.dispatch(mix, Order::Plan(plans as usize % mix.plans.len()));
            plans += 1;
        }
        while f64::from(jobs) < rate.jobs * seconds {
            lines.dispatch(mix, Order::Job(jobs as usize % mix.jobs.len()));
            jobs += 1;
        }
    }
    lines.tally.borrow_mut().sending = started.elapsed();
    let last = Instant::now();
    while lines.tally.borrow().unanswered() > 0 && last.elapsed() < PATIENCE {
        sleep(TICK).await;
    }
}

impl Lines {
    fn dispatch(self: &Rc<Self>, mix: &Rc<Mix>, order: Order) {
        let mut tally = self.tally.borrow_mut();
        if tally.kind(order).unanswered() >= CONNECTIONS {
            return tally.unsent += 1;
        }
        tally.sent(order);
        let (own, mix) = (Rc::clone(self), Rc::clone(mix));
        tokio::task::spawn_local(async move {
            let (request, limit) = match order {
                Order::Plan(at) => (&mix.plans[at].request, mix.plans[at].time_limit),
                Order::Job(at) => (&mix.jobs[at], Duration::ZERO),
            };
            let (sent, reply) = own.ask(request).await;
            own.tally.borrow_mut().answered(order, sent.elapsed().saturating_sub(limit), reply);
        });
    }

    /// When the request went out, and what came back.
    async fn ask(&self, request: &[u8]) -> (Instant, io::Result<Reply>) {
        let idle = self.idle.borrow_mut().pop();
        let stream = match idle {
            Some(stream) => Ok(stream),
            None => TcpStream::connect(self.address).await,
        };
        let sent = Instant::now();
        let reply = match stream {
            Ok(stream) => self.exchange(stream, request).await,
            Err(error) => Err(error),
        };
        (sent, reply)
    }

    async fn exchange(&self, stream: TcpStream, request: &[u8]) -> io::Result<Reply> {
        let mut left = request;
        while !left.is_empty() {
            stream.writable().await?;
            left = &left[done(stream.try_write(left))?..];
        }
        let (mut received, mut piece) = (Vec::new(), [0; 4096]);
        loop {
            stream.readable().await?;
            match stream.try_read(&mut piece) {
                Ok(0) => return Err(io::ErrorKind::UnexpectedEof.into()),
                read => received.extend_from_slice(&piece[..done(read)?]),
            }
            if let Some(reply) = Reply::complete(&received) {
                if reply.header("connection") != Some("close") {
                    self.idle.borrow_mut().push(stream);
                }
                return Ok(reply);
            }
        }
    }
}

/// How many bytes went; none where the system only thought that some would.
fn done(moved: io::Result<usize>) -> io::Result<usize> {
    match moved {
        Err(error) if error.kind() == io::ErrorKind::WouldBlock => Ok(0),
        moved => moved,
    }
}
