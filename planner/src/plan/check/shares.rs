//! What sets and elements are worth: a bound that pays for each set by its elements.

use super::family::{Family, Set};
use super::meter::Meter;

/// Rounding adds up to far less than this, and a whole number must not become the next one.
const ROUNDING: f64 = 1e-6;

/// Every set has a share s ≥ 0; an element carries the shares of all sets that it hits. Whoever chooses elements pays 1
/// for each; give him back the share of every set once, and he still pays 1 less what the element carries, at the
/// least nothing or, where it carries more than 1, that much less than nothing. So he pays no less than all shares
/// together, less all that is carried above 1.
pub(super) struct Worth {
    total: f64,
    carried: Vec<f64>,
}

impl Worth {
    fn of(family: &Family) -> Self {
        let mut carried = vec![0.0_f64; family.width];
        for set in &family.sets {
            set.members().iter().for_each(|member| carried[*member] += set.share);
        }
        let shares: f64 = family.sets.iter().map(|set| set.share).sum();
        let above: f64 = carried.iter().map(|carried| (carried - 1.0).max(0.0)).sum();
        Self { total: shares - above, carried }
    }

    /// So many elements at the least.
    pub(super) fn at_least(&self) -> usize {
        whole(self.total)
    }

    /// The same where this element is chosen.
    pub(super) fn with(&self, element: usize) -> usize {
        whole(self.total + (1.0 - self.carried[element]).max(0.0))
    }

    /// The same where it is not.
    pub(super) fn without(&self, element: usize) -> usize {
        whole(self.total + (self.carried[element] - 1.0).max(0.0))
    }
}

fn whole(total: f64) -> usize {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to the count of elements")]
    let whole = (total - ROUNDING).ceil().max(0.0) as usize;
    whole
}

/// Begin: a set's share is 1 over the count of sets that its most frequent member hits.
pub(super) fn divide(family: &mut Family) {
    let columns = family.columns();
    for set in &mut family.sets {
        let most = set.members().iter().map(|member| columns[*member].len()).max().unwrap_or(1);
        #[expect(clippy::cast_precision_loss, reason = "counts sets")]
        let share = 1.0 / most as f64;
        set.share = share;
    }
}

/// Move the shares towards what is worth most: a set that would be hit by several elements in demand gets less, one that
/// would be hit by none gets more. Ends after so many `rounds`, or once `limit` elements are seen to be needed. The
/// shares that were worth most stay.
///
/// # Errors
/// What the shares were worth when the budget ended.
pub(super) fn improve(family: &mut Family, limit: usize, rounds: usize, meter: &mut Meter<'_>) -> Result<Worth, Worth> {
    let mut best = Worth::of(family);
    let mut kept: Vec<f64> = family.sets.iter().map(|set| set.share).collect();
    let (mut stride, mut since) = (1.0_f64, 0);
    let mut now = Worth::of(family);
    let mut ended = false;
    for _ in 0..rounds {
        if best.at_least() >= limit {
            break;
        }
        ended = meter.spend(family.units()).is_err();
        if ended || !shift(family, &now, limit, stride) {
            break;
        }
        now = Worth::of(family);
        since = if now.total > best.total + 0.01 { 0 } else { since + 1 };
        if since > 4 {
            (stride, since) = (stride / 2.0, 0);
        }
        if now.total > best.total {
            kept.iter_mut().zip(&family.sets).for_each(|(kept, set)| *kept = set.share);
            best = Worth { total: now.total, carried: now.carried.clone() };
        }
    }
    family.sets.iter_mut().zip(kept).for_each(|(set, share)| set.share = share);
    if ended { Err(best) } else { Ok(best) }
}

/// One round: a step along the slope, as long as would close the gap to `limit`. False if there is no slope.
fn shift(family: &mut Family, now: &Worth, limit: usize, stride: f64) -> bool {
    let slope = |set: &Set| {
        let hit = set.members().iter().filter(|member| now.carried[**member] > 1.0).count();
        #[expect(clippy::cast_precision_loss, reason = "counts elements")]
        let slope = 1.0 - hit as f64;
        if set.share > 0.0 { slope } else { slope.max(0.0) }
    };
    let slopes: Vec<f64> = family.sets.iter().map(slope).collect();
    let length: f64 = slopes.iter().map(|slope| slope * slope).sum();
    if length <= 0.0 {
        return false;
    }
    #[expect(clippy::cast_precision_loss, reason = "counts elements")]
    let step = stride * (limit as f64 - now.total) / length;
    family.sets.iter_mut().zip(slopes).for_each(|(set, slope)| set.share = (set.share + step * slope).max(0.0));
    true
}
