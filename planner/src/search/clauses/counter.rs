//! How many of some literals hold: a totalizer (Bailleux & Boufkhad 2003) that grows as it is asked for more.

use batsat::Lit;

use super::solver::Asker;
use crate::budget::Interrupted;

/// Counts some literals, so far up to some number.
pub(super) struct Counter {
    /// What both halves count; `None` for a single literal.
    halves: Option<Box<[Counter; 2]>>,
    inputs: usize,
    /// At position n: true if more than n of them hold.
    more_than: Vec<Lit>,
}

impl Counter {
    /// Of at least one literal.
    pub(super) fn new(literals: &[Lit]) -> Self {
        if literals.len() <= 1 {
            return Self { halves: None, inputs: literals.len(), more_than: literals.to_vec() };
        }
        let (left, right) = literals.split_at(literals.len() / 2);
        let halves = Some(Box::new([Self::new(left), Self::new(right)]));
        Self { halves, inputs: literals.len(), more_than: Vec::new() }
    }

    /// A literal that holds if more than so many of the counted ones do; `None` if there are no more.
    ///
    /// # Errors
    /// [`Interrupted`] when the budget ends.
    pub(super) fn more_than(&mut self, count: usize, asker: &mut Asker<'_>) -> Result<Option<Lit>, Interrupted> {
        self.grow(count + 1, asker)?;
        Ok(self.more_than.get(count).copied())
    }

    fn grow(&mut self, wanted: usize, asker: &mut Asker<'_>) -> Result<(), Interrupted> {
        let wanted = wanted.min(self.inputs);
        let Some(halves) = &mut self.halves else { return Ok(()) };
        let known = self.more_than.len();
        if wanted <= known {
            return Ok(());
        }
        let [left, right] = &mut **halves;
        left.grow(wanted, asker)?;
        right.grow(wanted, asker)?;
        self.more_than.extend((known..wanted).map(|_| asker.literal(false)));
        // As many on the left and as many on the right are that many together.
        for from_left in 0..=left.more_than.len().min(wanted) {
            let to = right.more_than.len().min(wanted - from_left);
            for from_right in (known + 1).saturating_sub(from_left)..=to {
                let reached = |counter: &Self, count: usize| count.checked_sub(1).map(|last| !counter.more_than[last]);
                let sum = [self.more_than[from_left + from_right - 1]];
                asker.add(reached(left, from_left).into_iter().chain(reached(right, from_right)).chain(sum))?;
            }
        }
        for count in known.max(1)..wanted {
            asker.add([!self.more_than[count], self.more_than[count - 1]])?;
        }
        Ok(())
    }
}
