//! Reductions: elements and sets that can be decided without branching.

use smallvec::SmallVec;

use super::instance::{Decided, Instance};
use crate::budget::{Interrupted, Ticker};

/// Applies four rules until none applies: the only member of a set is taken (unit rule); a superset of another set is
/// dropped; an element is left out if another one hits all its sets (domination, Weihe 1998); an element in two pairs
/// is folded with its partners (degree-two folding, Chen, Kanj & Jia 2001). `false` if some set has no member left.
pub(super) fn reduce(
    instance: &mut Instance,
    decided: &mut Decided,
    ticker: &mut Ticker<'_>,
) -> Result<bool, Interrupted> {
    loop {
        let words = if let Some(set) = instance.shrunk_sets.next(0, 0) {
            instance.shrunk_sets.clear(0, set);
            if !instance.is_open(set) {
                continue;
            }
            let Some(words) = settle_set(instance, set, decided) else { return Ok(false) };
            words
        } else if let Some(element) = instance.shrunk_elements.next(0, 0) {
            instance.shrunk_elements.clear(0, element);
            settle_element(instance, element, decided)
        } else {
            return Ok(true);
        };
        ticker.step(1 + words / WORDS_A_STEP)?;
    }
}

/// Words of rows read per step of the ticker.
const WORDS_A_STEP: usize = 512;

/// Applies the rules for one set. Returns the number of words read, or `None` where the set has no member left.
fn settle_set(instance: &mut Instance, set: usize, decided: &mut Decided) -> Option<usize> {
    let mut elements = instance.members().ones(set);
    let first = elements.next()?;
    let mut common: SmallVec<[u64; 8]> = SmallVec::from_slice(instance.sets_of().row(first));
    let mut rows = 1;
    for element in elements {
        rows += 1;
        common.iter_mut().zip(instance.sets_of().row(element)).for_each(|(word, other)| *word &= other);
    }
    let words = rows * common.len();
    if rows == 1 {
        instance.take(first, decided);
        return Some(words);
    }
    // An element that hits this set hits its supersets too.
    common[set / 64] &= !(1 << (set % 64));
    for_each_one(&common, |larger| instance.close(larger));
    Some(words)
}

/// Applies the rules for one element. Returns the number of words read.
fn settle_element(instance: &mut Instance, element: usize, decided: &mut Decided) -> usize {
    let mut sets = instance.sets_of().ones(element);
    let Some(first) = sets.next() else { return 0 };
    let mut common: SmallVec<[u64; 8]> = SmallVec::from_slice(instance.members().row(first));
    let mut count = 1;
    let mut second = first;
    for set in sets {
        common.iter_mut().zip(instance.members().row(set)).for_each(|(word, other)| *word &= other);
        second = set;
        count += 1;
    }
    common[element / 64] &= !(1 << (element % 64));
    if common.iter().any(|word| *word != 0) {
        instance.exclude(element);
    } else if count == 2 && instance.members().count(first) == 2 && instance.members().count(second) == 2 {
        let other = |set: usize| instance.members().ones(set).find(|&member| member != element);
        if let (Some(kept), Some(other)) = (other(first), other(second)) {
            instance.fold(element, kept, other, decided);
        }
    }
    count * common.len()
}

fn for_each_one(words: &[u64], mut act: impl FnMut(usize)) {
    for (at, &word) in words.iter().enumerate() {
        let mut rest = word;
        while rest != 0 {
            act(at * 64 + rest.trailing_zeros() as usize);
            rest &= rest - 1;
        }
    }
}
