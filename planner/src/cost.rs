//! What a plan costs.

use core::fmt;
use core::iter::Sum;
use core::ops::Add;

/// A number of relocations: what every plan is measured by, and what is proven to be the least.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Cost(u64);

impl Cost {
    /// Nothing has to move.
    pub const ZERO: Self = Self(0);

    /// So many relocations.
    pub const fn new(relocations: u64) -> Self {
        Self(relocations)
    }

    /// The cost of moving each of `objects` objects once.
    pub fn of_each(objects: usize) -> Self {
        Self(objects as u64)
    }

    /// How many relocations it is beyond `other`; none where it is no more.
    pub fn beyond(self, other: Self) -> usize {
        usize::try_from(self.0.saturating_sub(other.0)).unwrap_or(usize::MAX)
    }

    /// The number of relocations.
    pub const fn get(self) -> u64 {
        self.0
    }
}

impl Add for Cost {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(self.0.saturating_add(other.0))
    }
}

impl Sum for Cost {
    fn sum<I: Iterator<Item = Self>>(costs: I) -> Self {
        costs.fold(Self::ZERO, Add::add)
    }
}

impl fmt::Display for Cost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}
