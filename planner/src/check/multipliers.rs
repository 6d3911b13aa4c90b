//! The Lagrangian bound on hitting sets, its multipliers improved by subgradient steps.

use super::family::{Family, Set};
use crate::budget::Ticker;

/// Subtracted before a bound is rounded up: rounding errors add up to far less, and must not lift a whole number to the
/// next.
const ROUNDING: f64 = 1e-6;

/// For multipliers s_S ≥ 0, every hitting set has at least Σ s_S − Σ_e max(0, load_e − 1) elements, where the load of
/// an element is load_e = Σ_{S∋e} s_S. Proof: each set is hit, so the loads of a hitting set H add up to at least Σ
/// s_S; hence |H| ≥ Σ s_S − Σ_{e∈H} (load_e − 1), and dropping the negative terms and adding positive ones only lowers
/// the bound.
pub(super) struct LagrangianBound {
    total: f64,
    loads: Vec<f64>,
}

impl LagrangianBound {
    fn of(family: &Family) -> Self {
        let mut loads = vec![0.0_f64; family.width];
        for set in &family.sets {
            set.members().iter().for_each(|member| loads[*member] += set.multiplier);
        }
        let multipliers: f64 = family.sets.iter().map(|set| set.multiplier).sum();
        let above: f64 = loads.iter().map(|load| (load - 1.0).max(0.0)).sum();
        Self { total: multipliers - above, loads }
    }

    /// No hitting set has fewer elements.
    pub(super) fn at_least(&self) -> usize {
        whole(self.total)
    }

    /// No hitting set with this element has fewer elements.
    pub(super) fn with(&self, element: usize) -> usize {
        whole(self.total + (1.0 - self.loads[element]).max(0.0))
    }

    /// No hitting set without this element has fewer elements.
    pub(super) fn without(&self, element: usize) -> usize {
        whole(self.total + (self.loads[element] - 1.0).max(0.0))
    }
}

fn whole(total: f64) -> usize {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to the count of elements")]
    let whole = (total - ROUNDING).ceil().max(0.0) as usize;
    whole
}

/// Sets the first multipliers: 1 over the number of sets that the set's most frequent member hits.
pub(super) fn initialise(family: &mut Family) {
    let columns = family.columns();
    for set in &mut family.sets {
        let most = set.members().iter().map(|member| columns[*member].len()).max().unwrap_or(1);
        #[expect(clippy::cast_precision_loss, reason = "counts sets")]
        let multiplier = 1.0 / most as f64;
        set.multiplier = multiplier;
    }
}

/// Improves the multipliers by subgradient steps. Ends after so many `rounds`, or once the bound reaches `limit`. The
/// best multipliers stay.
///
/// # Errors
/// When the budget ends, the bound by the best multipliers so far.
pub(super) fn improve(
    family: &mut Family,
    limit: usize,
    rounds: usize,
    ticker: &mut Ticker<'_>,
) -> Result<LagrangianBound, LagrangianBound> {
    let mut best = LagrangianBound::of(family);
    let mut kept: Vec<f64> = family.sets.iter().map(|set| set.multiplier).collect();
    let (mut stride, mut since) = (1.0_f64, 0);
    let mut now = LagrangianBound::of(family);
    let mut ended = false;
    for _ in 0..rounds {
        if best.at_least() >= limit {
            break;
        }
        ended = ticker.step(family.units()).is_err();
        if ended || !shift(family, &now, limit, stride) {
            break;
        }
        now = LagrangianBound::of(family);
        since = if now.total > best.total + 0.01 { 0 } else { since + 1 };
        if since > 4 {
            (stride, since) = (stride / 2.0, 0);
        }
        if now.total > best.total {
            kept.iter_mut().zip(&family.sets).for_each(|(kept, set)| *kept = set.multiplier);
            best = LagrangianBound { total: now.total, loads: now.loads.clone() };
        }
    }
    family.sets.iter_mut().zip(kept).for_each(|(set, multiplier)| set.multiplier = multiplier);
    if ended { Err(best) } else { Ok(best) }
}

/// One subgradient step with Polyak's length: it would close the gap to `limit` if the bound were linear. False if the
/// subgradient is 0.
fn shift(family: &mut Family, now: &LagrangianBound, limit: usize, stride: f64) -> bool {
    let slope = |set: &Set| {
        let hit = set.members().iter().filter(|member| now.loads[**member] > 1.0).count();
        #[expect(clippy::cast_precision_loss, reason = "counts elements")]
        let slope = 1.0 - hit as f64;
        if set.multiplier > 0.0 { slope } else { slope.max(0.0) }
    };
    let slopes: Vec<f64> = family.sets.iter().map(slope).collect();
    let length: f64 = slopes.iter().map(|slope| slope * slope).sum();
    if length <= 0.0 {
        return false;
    }
    #[expect(clippy::cast_precision_loss, reason = "counts elements")]
    let step = stride * (limit as f64 - now.total) / length;
    family
        .sets
        .iter_mut()
        .zip(slopes)
        .for_each(|(set, slope)| set.multiplier = (set.multiplier + step * slope).max(0.0));
    true
}
