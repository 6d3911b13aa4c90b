//! The Lagrangian bound on hitting sets, its multipliers raised by subgradient steps (Held & Karp 1971; Beasley 1990
//! for set covering).
//!
//! The covering programme is min Σ x_e with Σ_{e∈S} x_e ≥ 1 for each set S and 0 ≤ x ≤ 1. Give each set a multiplier
//! s_S ≥ 0, and let the load of an element be Σ_{S∋e} s_S. Then every solution has at least
//! Σ s_S − Σ_e max(0, load_e − 1) elements. With the best multipliers this is the bound of linear programming. The checker
//! computes the same bound with its own code.

use super::instance::Instance;
use crate::budget::Ticker;

/// Subtracted before a bound is rounded up: rounding errors add up to far less, and must not lift a whole number to the
/// next.
const ROUNDING: f64 = 1e-6;

/// The bound by the best multipliers found.
pub(super) struct LagrangianBound {
    /// No solution has fewer elements, but for [`ROUNDING`].
    pub(super) total: f64,
    /// Per element the multipliers of the sets that it hits, added up.
    loads: Vec<f64>,
}

impl LagrangianBound {
    /// No solution has fewer elements.
    pub(super) fn bound(&self) -> usize {
        whole(self.total)
    }

    /// No solution that has this element (`taken`), or that lacks it, has fewer elements.
    pub(super) fn bound_if(&self, element: usize, taken: bool) -> usize {
        let rest = 1.0 - self.loads[element];
        whole(self.total + if taken { rest } else { -rest }.max(0.0))
    }
}

fn whole(total: f64) -> usize {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to the count of elements")]
    let whole = (total - ROUNDING).ceil().max(0.0) as usize;
    whole
}

/// Raises the multipliers of an instance whose sets are all open. Ends after so many subgradient `rounds`, or once they
/// prove that `limit` elements are needed.
///
/// # Errors
/// When the budget ends, the bound by the multipliers reached so far: any multipliers give a bound.
pub(super) fn raise(
    instance: &mut Instance,
    limit: usize,
    rounds: usize,
    ticker: &mut Ticker<'_>,
) -> Result<LagrangianBound, LagrangianBound> {
    let (first, flat) = flat_members(instance);
    let sets = instance.sets();
    let members = |set: usize| &flat[first[set]..first[set + 1]];
    let mut multipliers = instance.multipliers.clone();
    let mut best = LagrangianBound { total: f64::NEG_INFINITY, loads: Vec::new() };
    let (mut loads, mut gradient) = (vec![0.0_f64; instance.elements()], vec![0.0_f64; sets]);
    let (mut stride, mut stale) = (1.0_f64, 0);
    for _ in 0..=rounds {
        loads.fill(0.0);
        (0..sets).for_each(|set| members(set).iter().for_each(|&element| loads[element] += multipliers[set]));
        let total = multipliers.iter().sum::<f64>() - loads.iter().map(|load| (load - 1.0).max(0.0)).sum::<f64>();
        stale += 1;
        if total > best.total {
            stale = if total > best.total + 0.01 { 0 } else { stale };
            best.total = total;
            best.loads.clone_from(&loads);
            instance.multipliers.clone_from(&multipliers);
        }
        if best.bound() >= limit {
            break;
        }
        if ticker.step(1 + flat.len() / 256).is_err() {
            return Err(best);
        }
        if stale > 4 {
            stride *= 0.5;
            stale = 0;
        }
        let mut norm = 0.0;
        for set in 0..sets {
            let over = members(set).iter().map(|&element| if loads[element] > 1.0 { 1.0 } else { 0.0 }).sum::<f64>();
            gradient[set] = if multipliers[set] <= 0.0 { (1.0 - over).max(0.0) } else { 1.0 - over };
            norm += gradient[set] * gradient[set];
        }
        if norm == 0.0 {
            break;
        }
        #[expect(clippy::cast_precision_loss, reason = "counts elements")]
        let step = stride * (limit as f64 - total) / norm;
        multipliers
            .iter_mut()
            .zip(&gradient)
            .for_each(|(multiplier, slope)| *multiplier = (*multiplier + step * slope).max(0.0));
    }
    Ok(best)
}

/// Sets the first multipliers: 1 over the number of sets that the set's most frequent element hits.
pub(super) fn initialise(instance: &mut Instance) {
    for set in 0..instance.sets() {
        let most = instance.members().ones(set).map(|element| instance.sets_of().count(element)).max().unwrap_or(1);
        #[expect(clippy::cast_precision_loss, reason = "counts sets")]
        let multiplier = 1.0 / most as f64;
        instance.multipliers[set] = multiplier;
    }
}

fn flat_members(instance: &Instance) -> (Vec<usize>, Vec<usize>) {
    let (mut first, mut flat) = (Vec::with_capacity(instance.sets() + 1), Vec::new());
    first.push(0);
    for set in 0..instance.sets() {
        flat.extend(instance.members().ones(set));
        first.push(flat.len());
    }
    (first, flat)
}
