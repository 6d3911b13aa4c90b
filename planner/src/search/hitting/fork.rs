//! Open questions: those that wait for the answers of their parts, or of both branches of a choice.

use super::Solution;
use super::instance::{Decided, Instance};
use crate::search::problem::Node;

/// An open question, with the part of its answer that is known.
pub(super) enum Fork {
    Parts(Parts),
    Choice(Choice),
}

/// The next action for an open question.
pub(super) enum Next {
    /// Ask about [`Fork::instance`] with this limit.
    Ask {
        limit: usize,
    },
    Answer(Solution),
}

/// Parts that share no element. They are solved one after the other.
pub(super) struct Parts {
    decided: Decided,
    /// All parts together must have fewer elements.
    limit: usize,
    /// Each is moved out when its turn comes.
    instances: Vec<Option<Instance>>,
    /// Per part a lower bound.
    bounds: Vec<usize>,
    /// The lower bounds of the parts after the next one, added up.
    later: usize,
    at: usize,
    solved: Vec<Node>,
}

/// Two branches: the element is taken, then left out.
pub(super) struct Choice {
    decided: Decided,
    /// The solution of the part must have fewer elements.
    limit: usize,
    /// Moved out for the second branch.
    part: Option<Instance>,
    element: usize,
    label: Node,
    /// No solution of the part has fewer elements.
    bound: usize,
    /// True in the second branch.
    left_out: bool,
    /// The solution of the first branch.
    with: Solution,
}

impl Fork {
    /// The first action.
    pub(super) fn begin(&mut self) -> Next {
        match self {
            Self::Parts(parts) => parts.go_on(),
            Self::Choice(choice) => Next::Ask { limit: choice.limit - 1 },
        }
    }

    /// The next action, given the answer to the last question.
    pub(super) fn next(&mut self, found: Solution) -> Next {
        match self {
            Self::Parts(parts) => parts.next(found),
            Self::Choice(choice) => choice.next(found),
        }
    }

    /// The instance to ask about; `None` if it was forgotten.
    pub(super) fn instance(&mut self) -> Option<Instance> {
        match self {
            Self::Parts(parts) => parts.instances[parts.at].take(),
            Self::Choice(choice) => choice.instance(),
        }
    }

    /// True if the instance is needed again after the next question.
    pub(super) fn asks_again(&self) -> bool {
        matches!(self, Self::Choice(Choice { left_out: false, .. }))
    }

    /// True if the instances are fully reduced: only the bound can decide more.
    pub(super) fn is_reduced(&self) -> bool {
        matches!(self, Self::Parts(_))
    }

    /// Memory of the instances, in 64-bit words.
    pub(super) fn words(&self) -> usize {
        match self {
            Self::Parts(parts) => parts.instances.iter().flatten().map(Instance::words).sum(),
            Self::Choice(choice) => choice.part.as_ref().map_or(0, Instance::words),
        }
    }

    /// Drops the instances.
    pub(super) fn forget(&mut self) {
        match self {
            Self::Parts(parts) => parts.instances.fill_with(|| None),
            Self::Choice(choice) => choice.part = None,
        }
    }

    /// Takes over the instances of `again`, which is this fork made anew.
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
    /// `limit` includes the decided elements; `bounds` are lower bounds, one for each part.
    pub(super) fn new(decided: Decided, instances: Vec<Instance>, bounds: Vec<usize>, limit: usize) -> Self {
        let (limit, later) = (limit - decided.count(), bounds.iter().sum());
        let instances = instances.into_iter().map(Some).collect();
        Self { decided, limit, instances, bounds, later, at: 0, solved: Vec::new() }
    }

    fn next(&mut self, found: Solution) -> Next {
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
    /// `limit` includes the decided elements.
    pub(super) fn new(decided: Decided, part: Instance, element: usize, bound: usize, limit: usize) -> Self {
        let (limit, label) = (limit - decided.count(), part.label(element));
        Self { decided, limit, part: Some(part), element, label, bound, left_out: false, with: None }
    }

    fn next(&mut self, found: Solution) -> Next {
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

    /// The second branch was asked for fewer elements than the first one has, so its solution is the better one.
    fn answer(&mut self, without: Solution) -> Next {
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
