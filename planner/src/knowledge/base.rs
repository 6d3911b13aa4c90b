//! The knowledge base: per object its options, the bodies of its Horn rules.

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
    let mut kept: Vec<Vec<ObjectIndex>> = Vec::with_capacity(options.len());
    for option in options {
        if !kept.iter().any(|smaller| is_subset(smaller, &option)) {
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
