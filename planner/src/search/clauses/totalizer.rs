//! A totalizer (Bailleux & Boufkhad 2003): a circuit that counts how many of its input literals hold. It is
//! incremental: it grows as larger counts are asked for.

use batsat::Lit;

use super::solver::Solver;
use crate::budget::Interrupted;

/// Counts its inputs, up to the number of outputs built so far.
pub(super) struct Totalizer {
    /// The totalizers of both halves of the inputs; `None` for a single input.
    halves: Option<Box<[Totalizer; 2]>>,
    inputs: usize,
    /// The outputs. The one at position n holds if more than n inputs do.
    more_than: Vec<Lit>,
}

impl Totalizer {
    /// A totalizer of at least one literal, without outputs.
    pub(super) fn new(literals: &[Lit]) -> Self {
        if literals.len() <= 1 {
            return Self { halves: None, inputs: literals.len(), more_than: literals.to_vec() };
        }
        let (left, right) = literals.split_at(literals.len() / 2);
        let halves = Some(Box::new([Self::new(left), Self::new(right)]));
        Self { halves, inputs: literals.len(), more_than: Vec::new() }
    }

    /// The output that holds if more than `count` inputs do; `None` if there are no more inputs than that.
    ///
    /// # Errors
    /// [`Interrupted`] when the budget ends.
    pub(super) fn more_than(&mut self, count: usize, solver: &mut Solver<'_>) -> Result<Option<Lit>, Interrupted> {
        self.grow(count + 1, solver)?;
        Ok(self.more_than.get(count).copied())
    }

    fn grow(&mut self, wanted: usize, solver: &mut Solver<'_>) -> Result<(), Interrupted> {
        let wanted = wanted.min(self.inputs);
        let Some(halves) = &mut self.halves else { return Ok(()) };
        let known = self.more_than.len();
        if wanted <= known {
            return Ok(());
        }
        let [left, right] = &mut **halves;
        left.grow(wanted, solver)?;
        right.grow(wanted, solver)?;
        self.more_than.extend((known..wanted).map(|_| solver.literal(false)));
        // If l inputs hold on the left and r on the right, l + r hold together.
        for from_left in 0..=left.more_than.len().min(wanted) {
            let to = right.more_than.len().min(wanted - from_left);
            for from_right in (known + 1).saturating_sub(from_left)..=to {
                let reached =
                    |totalizer: &Self, count: usize| count.checked_sub(1).map(|last| !totalizer.more_than[last]);
                let sum = [self.more_than[from_left + from_right - 1]];
                solver.add(reached(left, from_left).into_iter().chain(reached(right, from_right)).chain(sum))?;
            }
        }
        for count in known.max(1)..wanted {
            solver.add([!self.more_than[count], self.more_than[count - 1]])?;
        }
        Ok(())
    }
}
