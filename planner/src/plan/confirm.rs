//! Every statement is checked before it is served.

use super::stated::ids;
use crate::budget::Budget;
use crate::check::{Checker, FaultCode, Report, Terms};
use crate::knowledge::NoBase;
use crate::scene::{Goal, Scene};
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
/// goal.
///
/// # Errors
/// [`PlanError::Refused`] if any part does not hold.
pub(crate) fn confirm(
    checker: &mut Checker<'_>,
    scene: &Scene,
    stated: Statement,
    budget: &Budget<'_>,
) -> Result<Statement, PlanError> {
    let report = checker.check_for(scene, &stated, &Terms::default(), budget);
    if report.faults.iter().any(|fault| !fault.code.means_late()) {
        return Err(PlanError::Refused(report));
    }
    if *scene.goal() == Goal::Clear {
        return Ok(confirmed_clearing(scene, stated, &report));
    }
    let confirmed = confirmed_part(scene, stated, &report);
    if !report.has(FaultCode::LockUnconfirmed) && !report.has(FaultCode::ReplayUnconfirmed) {
        return Ok(confirmed);
    }
    let timed_out = Statement::timed_out();
    // A deadlock states no bound.
    Ok(if confirmed.lower_bound.is_none() {
        timed_out
    } else {
        Statement { lower_bound: confirmed.lower_bound, landmarks: confirmed.landmarks, ..timed_out }
    })
}

/// The steps of a clearing that were replayed, with the lock and the proof as far as they were confirmed.
fn confirmed_clearing(scene: &Scene, stated: Statement, report: &Report) -> Statement {
    let mut confirmed =
        if report.has(FaultCode::ReplayUnconfirmed) { stated.up_to_step(scene, report.replayed) } else { stated };
    if report.has(FaultCode::LockUnconfirmed) {
        confirmed.stuck = None;
    }
    confirmed.proven = Some(report.clearing_proven);
    confirmed
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
        // Without a plan it was the object that these would free.
        confirmed.target = None;
    }
    confirmed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::budget::clocks::Looks;
    use crate::cost::Cost;
    use crate::plan::{Settings, plan};
    use crate::scene::ObjectIndex;
    use crate::scene::scenes::TestScene;
    use crate::search::{Derivation, LeastSet, SILENT};
    use crate::statement::Verdict;

    /// Two fingers, and four plates round the target: two on opposite sides must be moved.
    fn crossed() -> TestScene {
        TestScene::new(2)
            .finger(0.04, 0.05)
            .disc("cup", 1.0, 1.0, 0.03)
            .disc("east", 1.13, 1.0, 0.08)
            .disc("north", 1.0, 1.13, 0.08)
            .disc("west", 0.87, 1.0, 0.08)
            .disc("south", 1.0, 0.87, 0.08)
    }

    fn stated(scene: &Scene) -> Statement {
        plan(scene, &Settings::default(), &Budget::unlimited(), SILENT).unwrap().statement
    }

    fn served(scene: &Scene, stated: Statement, budget: &Budget<'_>) -> Result<Statement, PlanError> {
        confirm(&mut Checker::new(scene), scene, stated, budget)
    }

    #[test]
    fn what_the_search_knows_but_cannot_show_is_not_served() {
        let scene = crossed().build("cup");
        let whole = stated(&scene);
        let (one, two) = (Some(Cost::new(1)), Some(Cost::new(2)));
        assert_eq!((whole.optimal, whole.cost, whole.lower_bound), (Some(true), two, two));
        // The search knows a bound of 2 without the landmark that would show it.
        let member = |id: &String| scene.find(id).unwrap();
        let landmark: Vec<ObjectIndex> = whole.landmarks.as_ref().unwrap()[0].iter().map(member).collect();
        let derivation = Derivation::default();
        let known = LeastSet { derivation, bound: Cost::new(2), proven: Cost::new(1), landmarks: vec![landmark] };
        let less = served(&scene, whole.clone().bounded(&scene, &known), &Budget::unlimited()).unwrap();
        assert_eq!((less.cost, less.lower_bound, less.optimal), (two, one, Some(false)));
        assert_eq!(less.landmarks.as_deref(), whole.landmarks.as_ref().map(|landmarks| &landmarks[..1]));
        let forged = Statement { landmarks: less.landmarks, ..whole };
        assert!(matches!(served(&scene, forged, &Budget::unlimited()), Err(PlanError::Refused(_))));
    }

    #[test]
    fn wherever_time_ends_only_what_was_confirmed_is_served() {
        let locked = crossed().disc("far", 0.3, 0.3, 0.05).fix("north").fix("south").fix("east").fix("west");
        let crossed = crossed().disc("far", 0.3, 0.3, 0.05);
        let mut seen = Vec::new();
        for (scene, places) in [
            (crossed.clone().build("far"), true),
            (crossed.clone().build("cup"), true),
            (crossed.build("cup"), false),
            (locked.build("cup"), true),
        ] {
            let mut whole = stated(&scene);
            if !places {
                let order: Vec<ObjectIndex> = ["east", "west"].map(|id| scene.find(id).unwrap()).into();
                let Statement { lower_bound, landmarks, .. } = whole;
                whole = Statement { lower_bound, landmarks, ..Statement::no_space(&scene, &order) };
            }
            let mut late = 0;
            for looks in 0..60 {
                let clock = Looks::ending_after(looks);
                let part = served(&scene, whole.clone(), &clock.budget()).unwrap();
                assert!([whole.verdict, Some(Verdict::TimedOut)].contains(&part.verdict), "{part:?}");
                let report = Checker::new(&scene).check(&part, &Budget::unlimited());
                assert_eq!(report.faults, [], "{part:?}");
                late += usize::from(part != whole);
            }
            assert_eq!(served(&scene, whole.clone(), &Budget::unlimited()).unwrap(), whole);
            seen.push((whole.verdict, late > 0));
        }
        // A target that is graspable has nothing to prove, and a replay may run over.
        let names = [Verdict::Graspable, Verdict::Relocate, Verdict::NoSpace, Verdict::Deadlock].map(Some);
        assert_eq!(seen.iter().map(|(verdict, _)| *verdict).collect::<Vec<_>>(), names);
        assert_eq!(seen.iter().map(|(_, late)| *late).collect::<Vec<_>>(), [false, true, true, true]);
    }
}
