//! Questions that wait for others: for their parts, or for what follows from a choice.

use super::Found;
use super::instance::{Decided, Instance};
use crate::search::problem::Node;

/// A question that waits, and what is known of its answer.
pub(super) enum Fork {
    Parts(Parts),
    Choice(Choice),
}

/// How it goes on.
pub(super) enum Next {
    /// With [`Fork::instance`]: a solution with fewer elements is wanted.
    Ask {
        limit: usize,
    },
    Answer(Found),
}

/// Parts that share no element are solved one after the other.
pub(super) struct Parts {
    decided: Decided,
    /// They have to have fewer elements together.
    limit: usize,
    /// Each goes when it is asked for.
    instances: Vec<Option<Instance>>,
    /// How many elements each needs at least, and those after the next one together.
    bounds: Vec<usize>,
    later: usize,
    at: usize,
    solved: Vec<Node>,
}

/// An element is taken, and then left out.
pub(super) struct Choice {
    decided: Decided,
    /// The part has to have fewer elements.
    limit: usize,
    /// Goes when it is asked for without the element.
    part: Option<Instance>,
    element: usize,
    label: Node,
    /// No solution of the part has fewer elements.
    bound: usize,
    /// True once the element is left out; then `with` is the solution that holds it.
    left_out: bool,
    with: Found,
}

impl Fork {
    /// What to do first.
    pub(super) fn begin(&mut self) -> Next {
        match self {
            Self::Parts(parts) => parts.go_on(),
            Self::Choice(choice) => Next::Ask { limit: choice.limit - 1 },
        }
    }

    /// What to do now that the question that was asked has its answer.
    pub(super) fn next(&mut self, found: Found) -> Next {
        match self {
            Self::Parts(parts) => parts.next(found),
            Self::Choice(choice) => choice.next(found),
        }
    }

    /// The instance of the question to ask; `None` if it was forgotten.
    pub(super) fn instance(&mut self) -> Option<Instance> {
        match self {
            Self::Parts(parts) => parts.instances[parts.at].take(),
            Self::Choice(choice) => choice.instance(),
        }
    }

    /// True if another question needs the instance that this one has.
    pub(super) fn asks_again(&self) -> bool {
        matches!(self, Self::Choice(Choice { left_out: false, .. }))
    }

    /// True if nothing can be decided in the instances but by prices.
    pub(super) fn is_reduced(&self) -> bool {
        matches!(self, Self::Parts(_))
    }

    /// How much memory the instances take, in words.
    pub(super) fn words(&self) -> usize {
        match self {
            Self::Parts(parts) => parts.instances.iter().flatten().map(Instance::words).sum(),
            Self::Choice(choice) => choice.part.as_ref().map_or(0, Instance::words),
        }
    }

    /// Give the memory back.
    pub(super) fn forget(&mut self) {
        match self {
            Self::Parts(parts) => parts.instances.fill_with(|| None),
            Self::Choice(choice) => choice.part = None,
        }
    }

    /// Take over the instances of `again`, the same fork as it was in the beginning.
    pub(super) fn recall(&mut self, again: Self) {
        match (self, again) {
            (Self::Parts(parts), Self::Parts(again)) => {
                parts.instances = again.instances;
                parts.instances[..parts.at].fill_with(|| None);
            }
            (Self::Choice(choice), Self::Choice(again)) => choice.part = again.part,
            _ => unreachable!("the same question falls into the same parts, or needs the same choice"),
        }
    }
}

impl Parts {
    /// `limit` counts what is decided; each part needs so many elements at least.
    pub(super) fn new(decided: Decided, instances: Vec<Instance>, bounds: Vec<usize>, limit: usize) -> Self {
        let (limit, later) = (limit - decided.count(), bounds.iter().sum());
        let instances = instances.into_iter().map(Some).collect();
        Self { decided, limit, instances, bounds, later, at: 0, solved: Vec::new() }
    }

    fn next(&mut self, found: Found) -> Next {
        let Some(found) = found else { return Next::Answer(None) };
        self.solved.extend(found);
        self.at += 1;
        self.go_on()
    }

    fn go_on(&mut self) -> Next {
        let Some(bound) = self.bounds.get(self.at) else {
            return Next::Answer(Some(self.decided.complete(core::mem::take(&mut self.solved))));
        };
        self.later -= bound;
        match self.limit.checked_sub(self.solved.len() + self.later).filter(|limit| limit > bound) {
            Some(limit) => Next::Ask { limit },
            None => Next::Answer(None),
        }
    }
}

impl Choice {
    /// `limit` counts what is decided.
    pub(super) fn new(decided: Decided, part: Instance, element: usize, bound: usize, limit: usize) -> Self {
        let (limit, label) = (limit - decided.count(), part.label(element));
        Self { decided, limit, part: Some(part), element, label, bound, left_out: false, with: None }
    }

    fn next(&mut self, found: Found) -> Next {
        if self.left_out {
            return self.answer(found);
        }
        self.left_out = true;
        self.with = found.map(|mut found| {
            found.push(self.label);
            found
        });
        let limit = self.with.as_ref().map_or(self.limit, Vec::len);
        if limit <= self.bound { self.answer(None) } else { Next::Ask { limit } }
    }

    /// A solution without the element is a smaller one, if there is any.
    fn answer(&mut self, without: Found) -> Next {
        let best = without.or_else(|| self.with.take());
        Next::Answer(best.map(|best| self.decided.complete(best)))
    }

    fn instance(&mut self) -> Option<Instance> {
        let mut instance = if self.left_out { self.part.take()? } else { self.part.clone()? };
        if self.left_out {
            instance.exclude(self.element);
        } else {
            instance.take(self.element, &mut Decided::default());
        }
        Some(instance)
    }
}
