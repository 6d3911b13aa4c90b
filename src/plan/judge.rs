//! What our own methods have to say of an answer by the paper's.
//!
//! The exact search runs twice at the most: on the base that the paper's search had, to judge the search, and on the swept
//! finger's, to prove the bound or the deadlock. Where time runs out, less is said.

use super::answer::{LowerBound, Verdict};
use super::confirm::PlanError;
use super::planner::prove_deadlock;
use super::settings::{GraspModel, SearchMethod, Settings};
use super::sought::{Sought, seek};
use super::warning::Warning;
use crate::budget::Budget;
use crate::knowledge::{KnowledgeBase, NoBase, relevant, swept_finger_options};
use crate::paper::tangent_angles;
use crate::scene::Scene;

/// The share of the time that is left for this; the rest is the checker's.
const SHARE: f64 = 0.7;

/// The verdict with what is proven for the swept finger, and warnings for what is wrong with it.
///
/// # Errors
/// [`PlanError::TooDense`] if the swept finger's base would be too large.
pub(super) fn judge(
    scene: &Scene,
    settings: &Settings,
    mut verdict: Verdict,
    sought: Option<(KnowledgeBase, Sought)>,
    warnings: &mut Vec<Warning>,
    budget: &Budget<'_>,
) -> Result<Verdict, PlanError> {
    let budget = budget.share(SHARE);
    if settings.grasp_model == GraspModel::Sector {
        count_tangent_angles(scene, sought.as_ref().map(|(base, _)| base), warnings);
    }
    let Some((base, sought)) = sought else { return Ok(verdict) };
    let exact = (settings.search != SearchMethod::Landmarks)
        .then(|| seek(SearchMethod::Landmarks, &base, scene.target(), &budget));
    warnings.extend(exact.as_ref().and_then(|exact| disagreement(&sought, exact)));
    let opinion = match settings.grasp_model {
        GraspModel::SweptFinger => opinion(scene, &base, exact.unwrap_or(sought), &budget)?,
        GraspModel::Sector => match relevant(scene, scene.target(), swept_finger_options, &budget) {
            Ok(base) => {
                let sought = seek(SearchMethod::Landmarks, &base, scene.target(), &budget);
                opinion(scene, &base, sought, &budget)?
            }
            Err(NoBase::Interrupted) => Opinion::None,
            Err(NoBase::TooLarge) => return Err(PlanError::TooDense),
        },
    };
    if let (Verdict::Relocate(plan), Opinion::Bound { least: Some(least), .. }) = (&verdict, &opinion)
        && settings.grasp_model == GraspModel::Sector
        && *least < plan.cost()
    {
        warnings.push(Warning::FewerSuffice { least: *least });
    }
    apply(&mut verdict, opinion, warnings);
    Ok(verdict)
}

/// Of the grasps that knowledge was asked for.
fn count_tangent_angles(scene: &Scene, base: Option<&KnowledgeBase>, warnings: &mut Vec<Warning>) {
    let asked = |object| object == scene.target() || base.is_some_and(|base| base.options(object).next().is_some());
    let pairs = scene.indices().filter(|object| asked(*object)).map(|object| tangent_angles(scene, object)).sum();
    if pairs > 0 {
        warnings.push(Warning::TangentAngle { pairs });
    }
}

/// What the exact search has against the paper's, on one base.
fn disagreement(sought: &Sought, exact: &Sought) -> Option<Warning> {
    match (sought, exact) {
        (Sought::Nothing, Sought::Least(known)) => Some(Warning::FalseDeadlock { least: known.derivation.order.len() }),
        (Sought::Sequence(sequence), Sought::Least(known)) => {
            let (found, least) = (sequence.order.len(), known.derivation.order.len());
            (found > least).then_some(Warning::NotOptimal { found, least })
        }
        _ => None,
    }
}

/// What is known of the target by the swept finger.
enum Opinion {
    /// No plan has fewer relocations than the bound; `least` if so many are enough.
    Bound { bound: LowerBound, least: Option<usize> },
    /// Nothing frees it.
    Deadlock(super::answer::Deadlock),
    /// Time ran out.
    None,
}

fn opinion(scene: &Scene, base: &KnowledgeBase, sought: Sought, budget: &Budget<'_>) -> Result<Opinion, PlanError> {
    Ok(match sought {
        Sought::Least(known) => Opinion::Bound { bound: (&known).into(), least: Some(known.derivation.order.len()) },
        Sought::Best(known) => Opinion::Bound { bound: (&known).into(), least: None },
        Sought::Nothing => match prove_deadlock(scene, base, budget) {
            Ok(deadlock) => Opinion::Deadlock(deadlock),
            Err(NoBase::Interrupted) => Opinion::None,
            Err(NoBase::TooLarge) => return Err(PlanError::TooDense),
        },
        Sought::Sequence(_) | Sought::TooLate | Sought::TooLarge => Opinion::None,
    })
}

fn apply(verdict: &mut Verdict, opinion: Opinion, warnings: &mut Vec<Warning>) {
    match (verdict, opinion) {
        (Verdict::Deadlock(proof), Opinion::Deadlock(deadlock)) => *proof = Some(deadlock),
        (Verdict::Deadlock(_), Opinion::Bound { least, .. }) => warnings.push(Warning::UnprovenDeadlock { least }),
        (Verdict::Deadlock(_), Opinion::None) => warnings.push(Warning::UnprovenDeadlock { least: None }),
        (Verdict::Relocate(plan), Opinion::Bound { bound, .. }) => plan.bound = Some(bound),
        (Verdict::NoSpace(rest) | Verdict::TimedOut(rest), Opinion::Bound { bound, .. }) => rest.bound = Some(bound),
        _ => {}
    }
}
