//! Judges an answer of the paper's methods by our own.
//!
//! The exact search runs at most twice: on the base of the paper's search, to judge the search, and on the swept
//! finger's base, to prove the bound or the deadlock. If time runs out, fewer warnings result.

use super::answer::{Deadlock, LowerBound, Verdict};
use super::settings::{GraspModel, SearchMethod, Settings};
use super::sought::{Sought, seek};
use super::verdicts::prove_deadlock;
use super::warning::Warning;
use crate::budget::{Budget, Interrupted};
use crate::knowledge::{KnowledgeBase, NoBase, relevant, swept_finger_options};
use crate::paper::tangent_angles;
use crate::scene::Scene;
use crate::search::{Derivation, SILENT};

/// The share of the remaining time for this; the rest is the checker's.
const SHARE: f64 = 0.7;

/// The verdict with its proof for the swept finger, and warnings about its faults.
pub(super) fn judge(
    scene: &Scene,
    settings: &Settings,
    mut verdict: Verdict,
    sought: Option<(KnowledgeBase, Sought)>,
    warnings: &mut Vec<Warning>,
    budget: &Budget<'_>,
) -> Verdict {
    let budget = budget.share(SHARE);
    let sectors = settings.grasp_model == GraspModel::Sector;
    if sectors {
        let base = sought.as_ref().map(|(base, _)| base);
        // An incomplete count is not reported.
        if let Ok(pairs @ 1..) = count_tangent_angles(scene, base, &budget) {
            warnings.push(Warning::TangentAngle { pairs });
        }
    }
    let Some((base, sought)) = sought else { return verdict };
    let exact = (settings.search != SearchMethod::Landmarks)
        .then(|| seek(SearchMethod::Landmarks, &base, scene.target(), &budget, SILENT));
    warnings.extend(exact.as_ref().and_then(|exact| disagreement(&sought, exact)));
    let opinion = if sectors {
        let base = relevant(scene, scene.target(), swept_finger_options, &budget);
        base.map_or_else(Opinion::from, |base| {
            let sought = seek(SearchMethod::Landmarks, &base, scene.target(), &budget, SILENT);
            opinion(scene, &base, sought, &budget)
        })
    } else {
        opinion(scene, &base, exact.unwrap_or(sought), &budget)
    };
    if let (Verdict::Relocate(plan), Opinion::Bound { known, .. }) = (&verdict, &opinion)
        && sectors
        && known.order.len() < plan.cost()
    {
        warnings.push(Warning::FewerSuffice { enough: known.order.len() });
    }
    apply(&mut verdict, opinion, unproven_by(settings), warnings);
    verdict
}

/// The setting that explains an unproven deadlock.
pub(super) fn unproven_by(settings: &Settings) -> &'static str {
    if settings.grasp_model == GraspModel::Sector { "grasp_model" } else { "search" }
}

/// Counts only among the grasps that the search needed.
fn count_tangent_angles(
    scene: &Scene,
    base: Option<&KnowledgeBase>,
    budget: &Budget<'_>,
) -> Result<usize, Interrupted> {
    let asked = |object| object == scene.target() || base.is_some_and(|base| base.options(object).next().is_some());
    let pairs = |object| budget.check().map(|()| tangent_angles(scene, object));
    scene.indices().filter(|object| asked(*object)).map(pairs).sum()
}

/// The exact search's objection to the paper's search on the same base. A derivation is enough; it need not have ended.
fn disagreement(sought: &Sought, exact: &Sought) -> Option<Warning> {
    let (Sought::Least(known) | Sought::Best(known)) = exact else { return None };
    let enough = known.derivation.order.len();
    match sought {
        Sought::Nothing => Some(Warning::FalseDeadlock { enough }),
        Sought::Sequence(sequence) if sequence.order.len() > enough => {
            Some(Warning::NotOptimal { found: sequence.order.len(), enough })
        }
        _ => None,
    }
}

/// The swept finger's result for the target.
enum Opinion {
    /// No plan has fewer relocations than the bound, and the derivation frees the target, places ignored.
    Bound { bound: LowerBound, known: Derivation },
    /// A deadlock.
    Deadlock(Deadlock),
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
        Sought::Least(known) | Sought::Best(known) => {
            Opinion::Bound { bound: (&known).into(), known: known.derivation }
        }
        Sought::Nothing => prove_deadlock(scene, base, budget).map_or_else(Opinion::from, Opinion::Deadlock),
        Sought::Sequence(_) | Sought::TooLate | Sought::TooLarge => Opinion::None,
    }
}

fn apply(verdict: &mut Verdict, opinion: Opinion, setting: &'static str, warnings: &mut Vec<Warning>) {
    match (verdict, opinion) {
        (Verdict::Deadlock(proof), Opinion::Deadlock(deadlock)) => *proof = Some(deadlock),
        (Verdict::Deadlock(_), Opinion::Bound { known, .. }) => {
            warnings.push(Warning::UnprovenDeadlock { enough: Some(known.order.len()), setting });
        }
        (Verdict::Deadlock(_), Opinion::TooDense) => warnings.push(Warning::DeadlockTooDense { setting }),
        (Verdict::Deadlock(_), Opinion::None) => warnings.push(Warning::UnprovenDeadlock { enough: None, setting }),
        (Verdict::Relocate(plan), Opinion::Bound { bound, .. }) => plan.bound = Some(bound),
        (Verdict::NoSpace(rest) | Verdict::TimedOut(rest), Opinion::Bound { bound, known }) => {
            rest.bound = Some(bound);
            rest.needed.get_or_insert(known.order);
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_base_that_is_too_large_is_not_called_late() {
        let warning = |why: NoBase| {
            let (mut verdict, mut warnings) = (Verdict::Deadlock(None), Vec::new());
            apply(&mut verdict, why.into(), "search", &mut warnings);
            assert_eq!(verdict, Verdict::Deadlock(None));
            assert_eq!(warnings.iter().map(Warning::code).collect::<Vec<_>>(), ["unproven_deadlock"]);
            warnings[0].to_string()
        };
        assert!(warning(NoBase::Interrupted).contains("in time"));
        let too_large = warning(NoBase::TooLarge);
        assert!(!too_large.contains("time") && too_large.contains("more than 1000000 members"), "{too_large}");
    }
}
