//! The main loop: ask for everything, and wish for less where that can't be.

use batsat::Lit;

use super::counter::Counter;
use super::founded::Founded;
use super::model::{Known, state};
use super::solver::{Asker, Reply};
use crate::budget::Interrupted;
use crate::search::pace::Pace;
use crate::search::problem::Node;

/// How often a clash is asked for again, since it may come back smaller.
const AGAIN: usize = 5;
/// Conflicts that may be spent to do without one wish of a clash, and to show that yet more of them can't be granted.
const FOR_ONE: u64 = 1000;
const FOR_MORE: u64 = 2000;

/// That an object is not moved, or that no more of a clash are than must be.
struct Wish {
    literal: Lit,
    /// Which counter it is a literal of, and how many that allows.
    counted: Option<(usize, usize)>,
}

/// The search by clauses. It goes on where it was.
pub(in crate::search) struct Wishes<'p, 'b> {
    asker: Asker<'b>,
    founded: Founded<'p>,
    /// Per node: it is moved.
    nodes: Vec<Lit>,
    wishes: Vec<Wish>,
    counters: Vec<Counter>,
    bound: usize,
}

/// Takes a set from which the target follows; gives the size of the best one known.
pub(in crate::search) type Adopt<'f> = &'f mut dyn FnMut(&[Node]) -> usize;

impl<'p, 'b> Wishes<'p, 'b> {
    /// Everything is wished for. The clauses hold that many literals together at the most.
    ///
    /// # Errors
    /// [`Interrupted`] when the budget ends.
    pub(in crate::search) fn new(
        known: &Known<'p, '_>,
        max_literals: usize,
        pace: &mut Pace<'b>,
    ) -> Result<Self, Interrupted> {
        let mut asker = Asker::new(max_literals, pace.another());
        let (nodes, founded) = state(known, &mut asker, pace)?;
        let mut is_forced = vec![false; nodes.len()];
        known.forced.iter().for_each(|&node| is_forced[node as usize] = true);
        let wishes = (0..known.problem.target())
            .filter(|&node| !is_forced[node as usize])
            .map(|node| Wish { literal: !nodes[node as usize], counted: None })
            .collect();
        Ok(Self { asker, founded, nodes, wishes, counters: Vec::new(), bound: known.forced.len() })
    }

    /// No set is smaller.
    pub(in crate::search) fn bound(&self) -> usize {
        self.bound
    }

    /// Raise the bound until it meets the best set, or that many conflicts are spent.
    ///
    /// # Errors
    /// [`Interrupted`] when the budget ends.
    pub(in crate::search) fn raise(
        &mut self,
        conflicts: u64,
        best: usize,
        adopt: Adopt<'_>,
    ) -> Result<(), Interrupted> {
        let last = self.asker.conflicts().saturating_add(conflicts);
        let mut best = best;
        while self.bound < best {
            let wishes: Vec<Lit> = self.wishes.iter().map(|wish| wish.literal).collect();
            let left = last.saturating_sub(self.asker.conflicts());
            match self.asker.ask(&mut self.founded, &wishes, left) {
                Reply::Granted => {
                    adopt(&self.granted());
                    return Ok(());
                }
                Reply::Spent => return self.asker.check(),
                // Without wishes something can always be granted.
                Reply::Clash(clash) if clash.is_empty() => return Ok(()),
                Reply::Clash(clash) => {
                    let clash = self.smaller(clash, &mut best, adopt);
                    self.weaken(&clash, &mut best, adopt)?;
                }
            }
        }
        Ok(())
    }

    /// The set that was granted last.
    fn granted(&self) -> Vec<Node> {
        let nodes = self.nodes.iter().zip(0..).take(self.nodes.len() - 1);
        nodes.filter(|(literal, _)| self.asker.is_true(**literal)).map(|(_, node)| node).collect()
    }

    /// A clash within this one, with not many wishes to spare.
    fn smaller(&mut self, mut clash: Vec<Lit>, best: &mut usize, adopt: Adopt<'_>) -> Vec<Lit> {
        for _ in 0..AGAIN {
            let Reply::Clash(again) = self.asker.ask(&mut self.founded, &clash, FOR_MORE) else { break };
            if again.len() >= clash.len() || again.is_empty() {
                break;
            }
            clash = again;
        }
        let mut at = 0;
        while at < clash.len() && clash.len() > 1 {
            let mut without = clash.clone();
            without.remove(at);
            match self.asker.ask(&mut self.founded, &without, FOR_ONE) {
                Reply::Clash(clashing) if !clashing.is_empty() => {
                    without.retain(|wish| clashing.contains(wish));
                    clash = without;
                }
                Reply::Granted => {
                    *best = adopt(&self.granted());
                    at += 1;
                }
                Reply::Clash(_) | Reply::Spent => at += 1,
            }
        }
        clash
    }

    /// Not all of these: wish that no more of them fail than must.
    fn weaken(&mut self, clash: &[Lit], best: &mut usize, adopt: Adopt<'_>) -> Result<(), Interrupted> {
        let (failing, kept) = core::mem::take(&mut self.wishes)
            .into_iter()
            .partition::<Vec<Wish>, _>(|wish| clash.contains(&wish.literal));
        self.wishes = kept;
        self.bound += 1;
        for (counter, allowed) in failing.iter().filter_map(|wish| wish.counted) {
            self.wish_for_at_most(counter, allowed + 1)?;
        }
        let failed: Vec<Lit> = failing.iter().map(|wish| !wish.literal).collect();
        self.asker.add(failed.iter().copied())?;
        if failed.len() == 1 {
            return Ok(());
        }
        self.counters.push(Counter::new(&failed));
        let (counter, mut must) = (self.counters.len() - 1, 1);
        while self.bound < *best {
            let Some(more) = self.counters[counter].more_than(must, &mut self.asker)? else { return Ok(()) };
            match self.asker.ask(&mut self.founded, &[!more], FOR_MORE) {
                Reply::Clash(_) => {
                    self.asker.add([more])?;
                    (self.bound, must) = (self.bound + 1, must + 1);
                }
                Reply::Granted => {
                    *best = adopt(&self.granted());
                    break;
                }
                Reply::Spent => break,
            }
        }
        self.wish_for_at_most(counter, must)
    }

    fn wish_for_at_most(&mut self, counter: usize, allowed: usize) -> Result<(), Interrupted> {
        let more = self.counters[counter].more_than(allowed, &mut self.asker)?;
        self.wishes.extend(more.map(|more| Wish { literal: !more, counted: Some((counter, allowed)) }));
        Ok(())
    }
}
