//! The knowledge base: per object its options, the bodies of its Horn rules.

use std::collections::HashMap;

use super::rows::Rows;
use crate::scene::ObjectIndex;

/// Per object its options, in one canonical form: bodies sorted, none a superset of another of the same object, shorter
/// ones first. An object with the empty option is graspable now; one with no option can never be moved.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct KnowledgeBase {
    /// Per object the number of its first rule; at the end the number of all rules.
    first_rule: Vec<u32>,
    /// Per rule its body.
    bodies: Rows<ObjectIndex>,
}

impl KnowledgeBase {
    /// An empty base, to which objects are added in index order.
    pub fn new() -> Self {
        Self { first_rule: vec![0], bodies: Rows::default() }
    }

    /// Adds the next object with its options.
    pub fn push(&mut self, options: Vec<Vec<ObjectIndex>>) {
        subset_minimal(options).iter().for_each(|option| self.bodies.push(option));
        self.first_rule.push(offset(self.rules()));
    }

    /// A base of `count` objects. Object `order[n]` gets the options that object n has here, all others get none.
    pub(super) fn renumbered(&self, order: &[ObjectIndex], count: usize) -> Self {
        let mut position = vec![None; count];
        order.iter().zip(self.objects()).for_each(|(object, here)| position[object.get()] = Some(here));
        let mut base = Self::new();
        base.bodies.reserve(self.rules(), self.size());
        for here in position {
            base.push_same(self, here);
        }
        base
    }

    /// Adds the next object with the options that `object` has in another base, or with none.
    pub(super) fn push_same(&mut self, other: &Self, object: Option<ObjectIndex>) {
        for rule in object.into_iter().flat_map(|object| other.rules_of(object)) {
            self.bodies.push(other.body(rule));
        }
        self.first_rule.push(offset(self.rules()));
    }

    /// The number of objects.
    pub fn len(&self) -> usize {
        self.first_rule.len() - 1
    }

    /// True if it holds no object.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The number of rules.
    pub fn rules(&self) -> usize {
        self.bodies.lists()
    }

    /// The members of all options together: the size of the base.
    pub fn size(&self) -> usize {
        self.bodies.entries()
    }

    /// The options of an object.
    pub fn options(&self, object: ObjectIndex) -> impl Iterator<Item = &[ObjectIndex]> {
        self.rules_of(object).map(|rule| self.body(rule))
    }

    /// True if the object can be picked as the table stands.
    pub fn free_now(&self, object: ObjectIndex) -> bool {
        self.options(object).any(<[_]>::is_empty)
    }

    /// The numbers of an object's rules.
    pub(super) fn rules_of(&self, object: ObjectIndex) -> core::ops::Range<usize> {
        self.first_rule[object.get()] as usize..self.first_rule[object.get() + 1] as usize
    }

    /// The body of a rule: the objects that must all be relocated.
    pub(super) fn body(&self, rule: usize) -> &[ObjectIndex] {
        self.bodies.get(rule)
    }

    /// Every object's index.
    pub fn objects(&self) -> impl Iterator<Item = ObjectIndex> + Clone + use<> {
        (0..self.len()).map(ObjectIndex::new)
    }
}

impl Default for KnowledgeBase {
    fn default() -> Self {
        Self::new()
    }
}

impl FromIterator<Vec<Vec<ObjectIndex>>> for KnowledgeBase {
    fn from_iter<I: IntoIterator<Item = Vec<Vec<ObjectIndex>>>>(options: I) -> Self {
        let mut base = Self::new();
        options.into_iter().for_each(|options| base.push(options));
        base
    }
}

fn offset(length: usize) -> u32 {
    u32::try_from(length).expect("the limits of a scene keep a base below 2^32 entries")
}

/// The options that are no supersets of another, in canonical order.
fn subset_minimal(mut options: Vec<Vec<ObjectIndex>>) -> Vec<Vec<ObjectIndex>> {
    for option in &mut options {
        option.sort_unstable();
        option.dedup();
    }
    options.sort_unstable_by(|a, b| a.len().cmp(&b.len()).then_with(|| a.cmp(b)));
    if options.len() > FEW {
        return subset_minimal_of_many(options);
    }
    let mut kept: Vec<Vec<ObjectIndex>> = Vec::with_capacity(options.len());
    for option in options {
        if !kept.iter().any(|smaller| is_subset(smaller, &option)) {
            kept.push(option);
        }
    }
    kept
}

/// So many options are compared each with each.
const FEW: usize = 64;

/// The same for the many options of a goal, shorter ones first: a subset is looked for only among those that begin with one of
/// the members.
fn subset_minimal_of_many(options: Vec<Vec<ObjectIndex>>) -> Vec<Vec<ObjectIndex>> {
    let (mut kept, mut by_first): (Vec<Vec<ObjectIndex>>, HashMap<ObjectIndex, Vec<usize>>) = Default::default();
    for option in options {
        if kept.first().is_some_and(Vec::is_empty) {
            return kept;
        }
        let rivals = || option.iter().filter_map(|member| by_first.get(member)).flatten();
        if !rivals().any(|&at| is_subset(&kept[at], &option)) {
            if let Some(&first) = option.first() {
                by_first.entry(first).or_default().push(kept.len());
            }
            kept.push(option);
        }
    }
    kept
}

/// True if `small` is a subset of `large`; both are sorted.
fn is_subset(small: &[ObjectIndex], large: &[ObjectIndex]) -> bool {
    let mut rest = large.iter();
    small.iter().all(|wanted| rest.by_ref().find(|member| *member >= wanted) == Some(wanted))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(members: &[usize]) -> Vec<ObjectIndex> {
        members.iter().copied().map(ObjectIndex::new).collect()
    }

    #[test]
    fn many_options_are_judged_like_few() {
        // 300 options of 1 to 3 of 12 objects; none is empty.
        let options = |n: usize| -> Vec<ObjectIndex> {
            set(&[n * 7 % 12, n * n % 11, if n.is_multiple_of(3) { n % 12 } else { n * 5 % 12 }])
        };
        let all: Vec<Vec<ObjectIndex>> = (0..300).map(options).collect();
        let few = subset_minimal(all.iter().take(FEW).cloned().collect());
        let naive = |mut options: Vec<Vec<ObjectIndex>>| {
            options.iter_mut().for_each(|option| {
                option.sort_unstable();
                option.dedup();
            });
            options.sort_unstable_by(|a, b| a.len().cmp(&b.len()).then_with(|| a.cmp(b)));
            options.dedup();
            let smaller = |a: &Vec<ObjectIndex>, b: &Vec<ObjectIndex>| a != b && a.iter().all(|o| b.contains(o));
            options.iter().filter(|b| !options.iter().any(|a| smaller(a, b))).cloned().collect::<Vec<_>>()
        };
        assert_eq!(few, naive(all.iter().take(FEW).cloned().collect()));
        assert_eq!(subset_minimal(all.clone()), naive(all.clone()));
        let with_empty: Vec<_> = all.into_iter().chain([Vec::new()]).collect();
        assert_eq!(subset_minimal(with_empty), [Vec::new()]);
    }

    #[test]
    fn an_option_that_holds_another_is_dropped() {
        let base: KnowledgeBase =
            [vec![set(&[2, 1, 3]), set(&[3, 1]), set(&[1, 3]), set(&[2])], vec![], vec![set(&[0]), set(&[])], vec![]]
                .into_iter()
                .collect();
        let options = |n| base.options(ObjectIndex::new(n)).map(<[_]>::to_vec).collect::<Vec<_>>();
        assert_eq!(options(0), [set(&[2]), set(&[1, 3])]);
        assert!(options(1).is_empty());
        assert_eq!(options(2), [set(&[])]);
    }
}
