//! Open questions of the branch and bound: those that wait for the answers of their components, or of both branches of
//! a choice.

use super::family::Family;

/// An open question.
pub(super) struct Fork {
    /// The limit with which it was asked.
    pub(super) limit: usize,
    /// The number of elements decided so far.
    counted: usize,
    /// The members in its families.
    pub(super) size: usize,
    kind: Kind,
}

enum Kind {
    Components(Components),
    Choice(Choice),
}

/// Components that share no element. They are solved one after the other.
struct Components {
    /// Each is moved out when it is asked for.
    families: Vec<Option<Family>>,
    /// Per component a lower bound.
    bounds: Vec<usize>,
    /// The lower bounds from `at` on, added up.
    rest: usize,
    at: usize,
}

/// Two branches: the element is taken, then refused.
struct Choice {
    /// Moved out for the second branch.
    component: Option<Family>,
    element: usize,
    /// A lower bound of the component.
    bound: usize,
    /// The size of its smallest hitting set so far, or what the limit leaves.
    best: usize,
    /// True in the second branch.
    refused: bool,
}

/// The next action for an open question.
pub(super) enum Next {
    /// Ask whether fewer than `limit` elements hit [`Fork::family`].
    Ask { limit: usize },
    /// The size of a least hitting set, or the limit if that is no larger.
    Answer(usize),
}

impl Fork {
    pub(super) fn components(components: Vec<Family>, counted: usize, limit: usize) -> Self {
        let bounds: Vec<usize> = components.iter().map(Family::packing).collect();
        let size = components.iter().map(Family::size).sum();
        let (families, rest) = (components.into_iter().map(Some).collect(), bounds.iter().sum());
        Self { limit, counted, size, kind: Kind::Components(Components { families, bounds, rest, at: 0 }) }
    }

    /// `bound` is a lower bound of the component.
    pub(super) fn choice(component: Family, element: usize, bound: usize, counted: usize, limit: usize) -> Self {
        let (best, size) = (limit - counted, component.size());
        let choice = Choice { component: Some(component), element, bound, best, refused: false };
        Self { limit, counted, size, kind: Kind::Choice(choice) }
    }

    /// The first action.
    pub(super) fn begin(&mut self) -> Next {
        match &mut self.kind {
            Kind::Components(components) => components.go_on(self.counted, self.limit),
            Kind::Choice(choice) => Next::Ask { limit: choice.best - 1 },
        }
    }

    /// The next action, given the answer to the last question.
    pub(super) fn next(&mut self, least: usize) -> Next {
        match &mut self.kind {
            Kind::Components(components) => {
                self.counted += least;
                components.at += 1;
                components.go_on(self.counted, self.limit)
            }
            Kind::Choice(choice) => choice.next(least, self.counted),
        }
    }

    /// The family to ask about; `None` if it was forgotten.
    pub(super) fn family(&mut self) -> Option<Family> {
        match &mut self.kind {
            Kind::Components(components) => {
                let family = components.families[components.at].take()?;
                self.size -= family.size();
                Some(family)
            }
            // Each set of a component has at least two members, so none becomes empty.
            Kind::Choice(choice) if choice.refused => {
                self.size = 0;
                choice.component.take()?.after(&[], &[choice.element])
            }
            Kind::Choice(choice) => choice.component.as_ref()?.after(&[choice.element], &[]),
        }
    }

    /// True if the families are fully reduced.
    pub(super) fn is_reduced(&self) -> bool {
        matches!(self.kind, Kind::Components(_))
    }

    /// Drops the families.
    pub(super) fn forget(&mut self) {
        self.size = 0;
        match &mut self.kind {
            Kind::Components(components) => components.families.fill_with(|| None),
            Kind::Choice(choice) => choice.component = None,
        }
    }

    /// Takes over the families of `again`, which is the same fork, computed again.
    pub(super) fn recall(&mut self, again: Self) {
        self.size = again.size;
        match (&mut self.kind, again.kind) {
            (Kind::Components(components), Kind::Components(again)) => {
                components.families = again.families;
                let done = components.families[..components.at].iter_mut().filter_map(Option::take);
                self.size -= done.map(|family| family.size()).sum::<usize>();
            }
            (Kind::Choice(choice), Kind::Choice(again)) => choice.component = again.component,
            _ => unreachable!("the same question forks the same way"),
        }
    }
}

impl Components {
    fn go_on(&mut self, counted: usize, limit: usize) -> Next {
        let Some(bound) = self.bounds.get(self.at) else { return Next::Answer(counted.min(limit)) };
        if counted + self.rest >= limit {
            return Next::Answer(limit);
        }
        self.rest -= bound;
        Next::Ask { limit: limit - counted - self.rest }
    }
}

impl Choice {
    fn next(&mut self, least: usize, counted: usize) -> Next {
        self.best = self.best.min(if self.refused { least } else { 1 + least });
        if core::mem::replace(&mut self.refused, true) || self.bound >= self.best {
            return Next::Answer(counted + self.best);
        }
        Next::Ask { limit: self.best }
    }
}
