//! Judges an answer of the paper's methods by our own.
//!
//! The exact search runs at most twice: on the base of the paper's search, to judge the search, and on the swept
//! finger's base, to prove the bound or the deadlock. If time runs out, fewer warnings result.

use super::angles::tangent_angles;
use super::dispatch::{SearchLimits, Sought, seek};
use super::methods::{GraspModelName, Methods, SearchMethod};
use super::warning::Warning;
use crate::budget::{Budget, Interrupted};
use crate::knowledge::{KnowledgeBase, Locks, NoBase, SweptFinger, relevant};
use crate::plan::{ids, prove_deadlock};
use crate::scene::{ObjectIndex, Scene};
use crate::search::{LeastSet, SILENT};
use crate::statement::{Statement, Verdict};

/// The share of the remaining time for this; the rest is the checker's.
const SHARE: f64 = 0.7;

/// What the methods found, not yet judged.
pub(super) struct Found {
    /// With a bound only where our own search found it for the swept finger.
    pub(super) stated: Statement,
    /// The search's result and its base, if it ran.
    pub(super) sought: Option<(KnowledgeBase, Sought)>,
}

impl From<Statement> for Found {
    fn from(stated: Statement) -> Self {
        Self { stated, sought: None }
    }
}

/// The statement with its proof for the swept finger, and warnings about its faults.
pub(super) fn judge(
    (scene, target): (&Scene, ObjectIndex),
    methods: &Methods,
    Found { stated, sought }: Found,
    warnings: &mut Vec<Warning>,
    budget: &Budget<'_>,
) -> Statement {
    let budget = budget.share(SHARE);
    let sectors = methods.grasp_model == GraspModelName::Sector;
    if sectors {
        let base = sought.as_ref().map(|(base, _)| base);
        // An incomplete count is not reported.
        if let Ok(pairs @ 1..) = count_tangent_angles(scene, target, base, &budget) {
            warnings.push(Warning::TangentAngle { pairs });
        }
    }
    let Some((base, sought)) = sought else { return stated };
    let exactly =
        |base: &KnowledgeBase| seek(SearchMethod::Landmarks, base, target, &SearchLimits::default(), &budget, SILENT);
    let exact = (methods.search != SearchMethod::Landmarks).then(|| exactly(&base));
    warnings.extend(exact.as_ref().and_then(|exact| disagreement(&sought, exact)));
    let opinion = if sectors {
        let base = relevant(scene, target, &SweptFinger, &budget);
        base.map_or_else(Opinion::from, |base| opinion(scene, &base, exactly(&base), &budget))
    } else {
        opinion(scene, &base, exact.unwrap_or(sought), &budget)
    };
    if let (Some(cost), Opinion::Bound(set)) = (stated.cost, &opinion)
        && sectors
        && set.derivation.cost() < cost
    {
        warnings.push(Warning::FewerSuffice { enough: set.derivation.cost() });
    }
    applied(scene, stated, opinion, methods.unproven_by(), warnings)
}

/// Counts only among the grasps that the search needed.
fn count_tangent_angles(
    scene: &Scene,
    target: ObjectIndex,
    base: Option<&KnowledgeBase>,
    budget: &Budget<'_>,
) -> Result<usize, Interrupted> {
    let asked = |object| object == target || base.is_some_and(|base| base.options(object).next().is_some());
    let pairs = |object| budget.check().map(|()| tangent_angles(scene, object));
    scene.indices().filter(|object| asked(*object)).map(pairs).sum()
}

/// The exact search's objection to the paper's search on the same base. A derivation is enough; it need not have ended.
fn disagreement(sought: &Sought, exact: &Sought) -> Option<Warning> {
    let (Sought::Least(known) | Sought::Best(known)) = exact else { return None };
    let enough = known.derivation.cost();
    match sought {
        Sought::Nothing => Some(Warning::FalseDeadlock { enough }),
        Sought::Sequence(sequence) if sequence.cost() > enough => {
            Some(Warning::NotOptimal { found: sequence.cost(), enough })
        }
        _ => None,
    }
}

/// The swept finger's result for the target.
enum Opinion {
    /// The landmarks prove the bound, and the derivation frees the target, places ignored.
    Bound(LeastSet),
    /// A deadlock.
    Deadlock(Locks),
    /// Its base would be too large.
    TooDense,
    /// Time ran out.
    None,
}

impl From<NoBase> for Opinion {
    fn from(why: NoBase) -> Self {
        match why {
            NoBase::Interrupted => Self::None,
            NoBase::TooLarge => Self::TooDense,
        }
    }
}

fn opinion(scene: &Scene, base: &KnowledgeBase, sought: Sought, budget: &Budget<'_>) -> Opinion {
    match sought {
        Sought::Least(set) | Sought::Best(set) => Opinion::Bound(set),
        Sought::Nothing => prove_deadlock(scene, base, budget).map_or_else(Opinion::from, Opinion::Deadlock),
        Sought::Sequence(_) | Sought::TooLate | Sought::TooLarge => Opinion::None,
    }
}

fn applied(
    scene: &Scene,
    stated: Statement,
    opinion: Opinion,
    setting: &'static str,
    warnings: &mut Vec<Warning>,
) -> Statement {
    match (stated.verdict, opinion) {
        (Some(Verdict::Deadlock), opinion) => {
            warnings.push(match opinion {
                Opinion::Deadlock(locks) => return Statement::deadlock(scene, &locks),
                Opinion::Bound(set) => Warning::UnprovenDeadlock { enough: Some(set.derivation.cost()), setting },
                Opinion::TooDense => Warning::DeadlockTooDense { setting },
                Opinion::None => Warning::UnprovenDeadlock { enough: None, setting },
            });
            stated
        }
        (Some(Verdict::Relocate), Opinion::Bound(set)) => stated.bounded(scene, &set),
        (Some(Verdict::NoSpace | Verdict::TimedOut), Opinion::Bound(set)) => {
            let needed = stated.needed.or_else(|| Some(ids(scene, &set.derivation.order)));
            Statement { needed, ..stated }.bounded(scene, &set)
        }
        _ => stated,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::scenes::TestScene;

    #[test]
    fn a_base_that_is_too_large_is_not_called_late() {
        let warning = |why: NoBase| {
            let scene = TestScene::new(3).disc("cup", 1.0, 1.0, 0.05).build("cup");
            let mut warnings = Vec::new();
            let stated = applied(&scene, Statement::unproven_deadlock(), why.into(), "search", &mut warnings);
            assert_eq!(stated, Statement::unproven_deadlock());
            assert_eq!(warnings.iter().map(Warning::code).collect::<Vec<_>>(), ["unproven_deadlock"]);
            warnings[0].to_string()
        };
        assert!(warning(NoBase::Interrupted).starts_with("time ran out"));
        let too_large = warning(NoBase::TooLarge);
        assert!(!too_large.contains("time") && too_large.contains("more than 1000000 members"), "{too_large}");
    }
}
