//! Fair queuing: owners take turns, and each owner's items keep their order.
//!
//! Each item gets a turn, a number; the least goes first. An owner's next turn is one after its last queued turn; an
//! owner with nothing queued starts at the least queued turn. So an owner that submits a hundred items takes a hundred
//! turns, and a single item of another goes second. Owners with nothing queued are forgotten.

use std::collections::BTreeMap;

/// The queue. Items of one turn go in order of arrival.
#[derive(Debug)]
pub(super) struct Queue<T> {
    entries: BTreeMap<(u64, u64), QueuedItem<T>>,
    arrivals: u64,
}

#[derive(Debug)]
struct QueuedItem<T> {
    owner: Box<str>,
    item: T,
}

impl<T> Queue<T> {
    pub(super) fn new() -> Self {
        Self { entries: BTreeMap::new(), arrivals: 0 }
    }

    pub(super) fn len(&self) -> usize {
        self.entries.len()
    }

    pub(super) fn push(&mut self, owner: &str, item: T) {
        let place = (self.turn(owner), self.arrivals);
        self.arrivals += 1;
        self.entries.insert(place, QueuedItem { owner: owner.into(), item });
    }

    pub(super) fn pop(&mut self) -> Option<T> {
        self.entries.pop_first().map(|(_, entry)| entry.item)
    }

    /// The queued items that go before the owner's next one.
    pub(super) fn ahead_of(&self, owner: &str) -> impl Iterator<Item = &T> {
        self.entries.range(..=(self.turn(owner), u64::MAX)).map(|(_, entry)| &entry.item)
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &T> {
        self.entries.values().map(|entry| &entry.item)
    }

    pub(super) fn retain(&mut self, mut keep: impl FnMut(&T) -> bool) {
        self.entries.retain(|_, entry| keep(&entry.item));
    }

    /// The owner's next turn.
    fn turn(&self, owner: &str) -> u64 {
        let own = self.entries.iter().rev().find(|(_, entry)| &*entry.owner == owner);
        let least = self.entries.keys().next();
        match (own, least) {
            (Some((&(turn, _), _)), _) => turn + 1,
            (None, Some(&(turn, _))) => turn,
            (None, None) => 0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The order in which the pushed items go: an owner's letter and a number each.
    fn drained(queue: &mut Queue<&'static str>) -> String {
        core::iter::from_fn(|| queue.pop()).collect::<Vec<_>>().join(" ")
    }

    fn pushed(names: &[&'static str]) -> Queue<&'static str> {
        let mut queue = Queue::new();
        for &name in names {
            queue.push(&name[..1], name);
        }
        queue
    }

    #[test]
    fn owners_go_in_turn_and_each_owners_own_in_order() {
        let mut queue = pushed(&["a1", "a2", "a3", "b1", "c1", "b2", "a4"]);
        assert_eq!(drained(&mut queue), "a1 b1 c1 a2 b2 a3 a4");
    }

    #[test]
    fn a_new_owner_joins_after_the_next_in_line() {
        let mut queue = pushed(&["a1", "a2", "a3"]);
        assert_eq!(queue.pop(), Some("a1"));
        queue.push("b", "b1");
        queue.push("b", "b2");
        assert_eq!(drained(&mut queue), "a2 b1 a3 b2");
    }

    #[test]
    fn one_owner_alone_is_served_in_order() {
        assert_eq!(drained(&mut pushed(&["a1", "a2", "a3"])), "a1 a2 a3");
    }

    #[test]
    fn the_work_ahead_depends_on_the_owner() {
        let mut queue = pushed(&["a1", "a2", "b1"]);
        let ahead = |queue: &Queue<&'static str>, owner| queue.ahead_of(owner).copied().collect::<Vec<_>>().join(" ");
        assert_eq!(ahead(&queue, "a"), "a1 b1 a2");
        assert_eq!(ahead(&queue, "b"), "a1 b1 a2");
        assert_eq!(ahead(&queue, "c"), "a1 b1");
        queue.retain(|name| *name != "a2");
        assert_eq!((ahead(&queue, "b"), queue.len()), ("a1 b1".to_owned(), 2));
    }
}
