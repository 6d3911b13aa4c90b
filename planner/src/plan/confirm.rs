//! Every statement is checked before it is served.

use super::stated::ids;
use crate::budget::Budget;
use crate::check::{Checker, FaultCode, Report};
use crate::knowledge::NoBase;
use crate::scene::Scene;
use crate::statement::Statement;

/// Why there is no answer.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// The checker refused the planner's own answer: a bug. The answer is not served.
    #[error("the answer did not pass its check")]
    Refused(Report),
    /// The objects are too dense: their knowledge base would exceed the limit
    /// ([`MAX_BASE_SIZE`](crate::knowledge::MAX_BASE_SIZE)).
    #[error("{}", NoBase::TooLarge)]
    TooDense,
}

/// The part of the statement that the checker confirms in time, with the bound that it computed. Its scene may have any
/// target.
///
/// # Errors
/// [`PlanError::Refused`] if any part does not hold.
pub(crate) fn confirm(
    checker: &mut Checker<'_>,
    scene: &Scene,
    stated: Statement,
    budget: &Budget<'_>,
) -> Result<Statement, PlanError> {
    let report = checker.check_for(scene, &stated, budget);
    if report.faults.iter().any(|fault| !fault.code.means_late()) {
        return Err(PlanError::Refused(report));
    }
    let confirmed = confirmed_part(scene, stated, &report);
    Ok(if report.has(FaultCode::LockUnconfirmed) || report.has(FaultCode::ReplayUnconfirmed) {
        // A deadlock states no bound.
        let trivial = Statement::timed_out();
        let (lower_bound, landmarks) = (confirmed.lower_bound, confirmed.landmarks);
        Statement {
            lower_bound: lower_bound.or(trivial.lower_bound),
            landmarks: landmarks.or(trivial.landmarks.clone()),
            ..trivial
        }
    } else {
        confirmed
    })
}

/// The statement with the confirmed part of the bound, and the needed objects only if confirmed.
pub(crate) fn confirmed_part(scene: &Scene, stated: Statement, report: &Report) -> Statement {
    let mut confirmed = stated;
    if confirmed.lower_bound.is_some() {
        // Landmarks that were not checked in time are dropped, even if the rest proves the bound.
        if report.interrupted {
            confirmed.landmarks = Some(report.sound_landmarks.iter().map(|landmark| ids(scene, landmark)).collect());
        }
        confirmed.lower_bound = Some(report.proven_bound);
        confirmed.optimal = confirmed.cost.map(|cost| cost == report.proven_bound);
    }
    if report.has(FaultCode::NeededUnconfirmed) {
        confirmed.needed = None;
    }
    confirmed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cost::Cost;
    use crate::plan::{Settings, plan};
    use crate::scene::scenes::TestScene;
    use crate::search::SILENT;

    #[test]
    fn what_the_search_knows_but_cannot_show_is_not_served() {
        // Two fingers, and four plates round the target: two on opposite sides must be moved.
        let scene = TestScene::new(2)
            .finger(0.04, 0.05)
            .disc("cup", 1.0, 1.0, 0.03)
            .disc("east", 1.13, 1.0, 0.08)
            .disc("north", 1.0, 1.13, 0.08)
            .disc("west", 0.87, 1.0, 0.08)
            .disc("south", 1.0, 0.87, 0.08)
            .build("cup");
        let answer = plan(&scene, &Settings::default(), &Budget::unlimited(), SILENT).unwrap();
        let two = Some(Cost::new(2));
        let stated = answer.statement;
        assert_eq!((stated.optimal, stated.cost, stated.lower_bound), (Some(true), two, two));
        // Without one landmark that the bound needs.
        let landmarks = stated.landmarks.clone().map(|mut landmarks| landmarks.drain(..1).collect::<Vec<_>>());
        let served = |lower_bound, optimal| {
            let less = Statement { lower_bound, optimal, landmarks: landmarks.clone(), ..stated.clone() };
            confirm(&mut Checker::new(&scene), &scene, less, &Budget::unlimited())
        };
        let one = Some(Cost::new(1));
        let honest = served(one, None).unwrap();
        assert_eq!((honest.cost, honest.lower_bound, honest.optimal), (two, one, Some(false)));
        assert!(matches!(served(two, Some(true)), Err(PlanError::Refused(_))));
    }
}
