//! How often the search looks at its budget.

use crate::budget::clocks::Looks;
use crate::budget::{Budget, Ticker};
use crate::scene::ObjectIndex;
use crate::search::forward_chaining::ForwardChaining;
use crate::search::landmark::extract;
use crate::search::problem::HornRules;
use crate::search::tests::base;
use crate::search::{Restriction, SearchOutcome, least};

#[test]
fn a_landmark_costs_as_much_as_the_rules_that_are_looked_at() {
    // 200 objects are free, and each is in the bodies of `width` others, together with the last one, which is never
    // derived.
    let extracted = |width: usize| {
        let last = 201 + width;
        let mut options = vec![vec![vec![last]]];
        options.extend((0..200).map(|_| vec![vec![]]));
        options.extend((0..width).map(|_| (1..=200).map(|free| vec![free, last]).collect()));
        options.push(vec![]);
        let objects = (1..options.len()).chain([0]).map(ObjectIndex::new).collect();
        let unlimited = Budget::unlimited();
        let problem = HornRules::over(&base(&options), objects, |_| true, &mut Ticker::new(&unlimited)).unwrap();
        Looks::of(|budget| {
            let mut chain = ForwardChaining::new(&problem);
            let landmark = extract(&problem, &mut chain, problem.target(), &mut Ticker::new(budget));
            assert_eq!(landmark, Ok(vec![]));
        })
    };
    let (narrow, wide) = (extracted(1), extracted(1000));
    assert!(narrow <= 6 && wide >= 20, "{narrow} {wide}");
}

#[test]
fn required_objects_count_towards_the_set() {
    let options: Vec<Vec<Vec<usize>>> =
        [vec![(1..=2000).collect()]].into_iter().chain((0..2000).map(|_| vec![vec![]])).collect();
    let base = base(&options);
    let solved = |required: usize| {
        let required = (1..=required).map(ObjectIndex::new).collect();
        let restriction = Restriction { required, ..Restriction::default() };
        Looks::of(|budget| {
            let outcome = least(&base, ObjectIndex::new(0), &restriction, budget);
            assert!(matches!(outcome, SearchOutcome::Least(_)), "{outcome:?}");
        })
    };
    let (nothing, everything) = (solved(0), solved(2000));
    assert!(everything > nothing + 100, "{nothing} {everything}");
}
