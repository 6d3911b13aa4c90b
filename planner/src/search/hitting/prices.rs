//! A bound by prices: Lagrange multipliers of the covering programme, raised by subgradients.
//!
//! Give each set a price p ≥ 0, and let an element's load be what the sets that it meets cost together. Then any solution
//! has at least Σ p − Σ max(0, load − 1) elements (take the programme min Σ x, Σ x ≥ 1 for each set, 0 ≤ x ≤ 1, and pay
//! p for each set that is missed). With the best prices that is the bound of linear programming.

use super::instance::Instance;
use crate::search::pace::Pace;

/// Rounding adds up to far less, and a whole number must not become the next one.
const SAFE: f64 = 1e-6;

/// The best prices found say this.
pub(super) struct Valuation {
    /// No solution has fewer elements, but for [`SAFE`].
    pub(super) total: f64,
    /// Per element what the sets that it meets cost together.
    loads: Vec<f64>,
}

impl Valuation {
    /// The least number of elements.
    pub(super) fn bound(&self) -> usize {
        whole(self.total)
    }

    /// The least number of elements of a solution with this element, or of one without it.
    pub(super) fn bound_if(&self, element: usize, taken: bool) -> usize {
        let rest = 1.0 - self.loads[element];
        whole(self.total + if taken { rest } else { -rest }.max(0.0))
    }
}

fn whole(total: f64) -> usize {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to the count of elements")]
    let whole = (total - SAFE).ceil().max(0.0) as usize;
    whole
}

/// Raise the prices of an instance whose sets are all open, in so many rounds, or until they show that `limit` elements
/// are needed.
///
/// # Errors
/// What the prices show that were reached when the budget ended: any prices are good for a bound.
pub(super) fn raise(
    instance: &mut Instance,
    limit: usize,
    rounds: usize,
    pace: &mut Pace<'_>,
) -> Result<Valuation, Valuation> {
    let (first, flat) = flat_members(instance);
    let sets = instance.sets();
    let members = |set: usize| &flat[first[set]..first[set + 1]];
    let mut prices = instance.prices.clone();
    let mut best = Valuation { total: f64::NEG_INFINITY, loads: Vec::new() };
    let (mut loads, mut gradient) = (vec![0.0_f64; instance.elements()], vec![0.0_f64; sets]);
    let (mut stride, mut stale) = (1.0_f64, 0);
    for _ in 0..=rounds {
        loads.fill(0.0);
        (0..sets).for_each(|set| members(set).iter().for_each(|&element| loads[element] += prices[set]));
        let total = prices.iter().sum::<f64>() - loads.iter().map(|load| (load - 1.0).max(0.0)).sum::<f64>();
        stale += 1;
        if total > best.total {
            stale = if total > best.total + 0.01 { 0 } else { stale };
            best.total = total;
            best.loads.clone_from(&loads);
            instance.prices.clone_from(&prices);
        }
        if best.bound() >= limit {
            break;
        }
        if pace.step(1 + flat.len() / 256).is_err() {
            return Err(best);
        }
        if stale > 4 {
            stride *= 0.5;
            stale = 0;
        }
        let mut norm = 0.0;
        for set in 0..sets {
            let over = members(set).iter().map(|&element| if loads[element] > 1.0 { 1.0 } else { 0.0 }).sum::<f64>();
            gradient[set] = if prices[set] <= 0.0 { (1.0 - over).max(0.0) } else { 1.0 - over };
            norm += gradient[set] * gradient[set];
        }
        if norm == 0.0 {
            break;
        }
        #[expect(clippy::cast_precision_loss, reason = "counts elements")]
        let step = stride * (limit as f64 - total) / norm;
        prices.iter_mut().zip(&gradient).for_each(|(price, slope)| *price = (*price + step * slope).max(0.0));
    }
    Ok(best)
}

/// Prices to begin with: each set pays its share of its most frequent element.
pub(super) fn share(instance: &mut Instance) {
    for set in 0..instance.sets() {
        let most = instance.members().ones(set).map(|element| instance.met().count(element)).max().unwrap_or(1);
        #[expect(clippy::cast_precision_loss, reason = "counts sets")]
        let price = 1.0 / most as f64;
        instance.prices[set] = price;
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
