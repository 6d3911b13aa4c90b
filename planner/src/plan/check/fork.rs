//! Questions of a branch and bound that wait for others: how many elements hit this family?

use super::family::Family;

/// A question that waits.
pub(super) struct Fork {
    /// The limit with which it was asked.
    pub(super) limit: usize,
    /// Elements that are counted already.
    counted: usize,
    /// Members that its families hold.
    pub(super) size: usize,
    way: Way,
}

enum Way {
    Components(Components),
    Choice(Choice),
}

/// Components that share no element are counted one after the other.
struct Components {
    /// Each goes when it is asked for.
    families: Vec<Option<Family>>,
    /// How many elements each needs at least, and those from `at` on together.
    bounds: Vec<usize>,
    rest: usize,
    at: usize,
}

/// An element is taken, and then refused.
struct Choice {
    /// Goes when it is asked for without the element.
    component: Option<Family>,
    element: usize,
    /// The component needs so many elements at least, and with no more than the limit it needs no more than `best`.
    bound: usize,
    best: usize,
    refused: bool,
}

/// How it goes on.
pub(super) enum Next {
    /// With [`Fork::family`]: are fewer elements enough?
    Ask { limit: usize },
    /// The least number of elements, or the limit if it is no less.
    Answer(usize),
}

impl Fork {
    pub(super) fn components(components: Vec<Family>, counted: usize, limit: usize) -> Self {
        let bounds: Vec<usize> = components.iter().map(Family::packing).collect();
        let size = components.iter().map(Family::size).sum();
        let (families, rest) = (components.into_iter().map(Some).collect(), bounds.iter().sum());
        Self { limit, counted, size, way: Way::Components(Components { families, bounds, rest, at: 0 }) }
    }

    /// `component` needs `bound` elements at least.
    pub(super) fn choice(component: Family, element: usize, bound: usize, counted: usize, limit: usize) -> Self {
        let (best, size) = (limit - counted, component.size());
        let choice = Choice { component: Some(component), element, bound, best, refused: false };
        Self { limit, counted, size, way: Way::Choice(choice) }
    }

    /// What to do first.
    pub(super) fn begin(&mut self) -> Next {
        match &mut self.way {
            Way::Components(components) => components.go_on(self.counted, self.limit),
            Way::Choice(choice) => Next::Ask { limit: choice.best - 1 },
        }
    }

    /// What to do now that the question that was asked has its answer.
    pub(super) fn next(&mut self, least: usize) -> Next {
        match &mut self.way {
            Way::Components(components) => {
                self.counted += least;
                components.at += 1;
                components.go_on(self.counted, self.limit)
            }
            Way::Choice(choice) => choice.next(least, self.counted),
        }
    }

    /// The family of the question to ask; `None` if it was forgotten.
    pub(super) fn family(&mut self) -> Option<Family> {
        match &mut self.way {
            Way::Components(components) => {
                let family = components.families[components.at].take()?;
                self.size -= family.size();
                Some(family)
            }
            // Sets of one component have two members at least: something is left of each.
            Way::Choice(choice) if choice.refused => {
                self.size = 0;
                choice.component.take()?.after(&[], &[choice.element])
            }
            Way::Choice(choice) => choice.component.as_ref()?.after(&[choice.element], &[]),
        }
    }

    /// True if nothing can be dropped from the families.
    pub(super) fn is_reduced(&self) -> bool {
        matches!(self.way, Way::Components(_))
    }

    /// Give the families' memory back.
    pub(super) fn forget(&mut self) {
        self.size = 0;
        match &mut self.way {
            Way::Components(components) => components.families.fill_with(|| None),
            Way::Choice(choice) => choice.component = None,
        }
    }

    /// Take over the families of `again`, the same fork as it was in the beginning.
    pub(super) fn recall(&mut self, again: Self) {
        self.size = again.size;
        match (&mut self.way, again.way) {
            (Way::Components(components), Way::Components(again)) => {
                components.families = again.families;
                let done = components.families[..components.at].iter_mut().filter_map(Option::take);
                self.size -= done.map(|family| family.size()).sum::<usize>();
            }
            (Way::Choice(choice), Way::Choice(again)) => choice.component = again.component,
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
