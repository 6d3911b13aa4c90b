//! How the checker decides what rounding leaves open.

/// How a case is decided that rounding leaves open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Leaning {
    /// As blocked: for claims that an object can't be grasped (locks, landmarks).
    Blocked,
    /// As free: for claims that an object can be grasped (plans, needed objects).
    Free,
}

/// How far a length may be off that decides in favour of a claim, m. The checker and the planner compute the figures of a listed
/// grasp in different ways, and where a finger only just touches an edge the last digit decides how far it closes.
const LENGTH: f64 = 1e-9;
/// By how much an obstacle is called nearer than it is, m. The planner calls an obstacle free that is nearer by less than a
/// tenth of [`LENGTH`], so claims that it blocks need no more.
const NEAR: f64 = 1e-12;

impl Leaning {
    /// 1 where a length that is greater makes more blocked, −1 where it makes less blocked.
    pub(super) fn sign(self) -> f64 {
        match self {
            Self::Blocked => 1.0,
            Self::Free => -1.0,
        }
    }

    /// A length in favour of the claim, where a greater one blocks more.
    pub(super) fn out(self, length: f64) -> f64 {
        length + self.sign() * LENGTH
    }

    /// A length in favour of the claim, where a greater one blocks less.
    pub(super) fn back(self, length: f64) -> f64 {
        length - self.sign() * LENGTH
    }

    /// The distance that a core has to keep, in favour of the claim.
    pub(super) fn to_keep(self, rho: f64) -> f64 {
        match self {
            Self::Blocked => rho + NEAR * (1.0 + rho),
            Self::Free => rho - LENGTH,
        }
    }
}
