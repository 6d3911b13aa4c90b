//! A verification as JSON.

use serde::Serialize;
use utoipa::ToSchema;

use super::code::ERRORS_PAGE;
use singulate_planner::check::{Fault, FaultCode, Report};

/// The result of the independent check.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, ToSchema)]
pub struct VerificationBody {
    /// True if everything that the answer states holds and all of it could be checked.
    #[schema(example = false)]
    pub valid: bool,
    /// Every fault that was found.
    #[schema(example = json!([{
        "code": "unknown_object", "step": 0, "object": "plate-2", "detail": "there is no object 'plate-2'",
        "see": "docs/errors.md#plan-unknown_object"
    }]))]
    pub faults: Vec<FaultBody>,
    /// The first step with a fault, counted from 0. The number of steps if it is the final grasp of the target, or an object that
    /// should have been taken away. Null if no step has a fault.
    #[schema(required = true, example = 0)]
    pub first_failing_step: Option<usize>,
    /// True if a step has a fault, the final grasp included, or if time ran out before all of them were replayed. False if all
    /// can be carried out, even if a bound or another statement does not hold.
    #[schema(example = true)]
    pub replan: bool,
}

/// One fault of an answer.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, ToSchema)]
pub struct FaultBody {
    /// The kind of fault, a word for programs. `interrupted` means that time ran out before everything was checked.
    #[schema(example = "unknown_object")]
    pub code: &'static str,
    /// The position of the step, counted from 0. Null for the answer as a whole.
    #[schema(required = true, example = 0)]
    pub step: Option<usize>,
    /// The id of the object concerned. Null if the fault concerns no single object.
    #[schema(required = true, example = "plate-2")]
    pub object: Option<String>,
    /// One sentence for people.
    #[schema(example = "there is no object 'plate-2'")]
    pub detail: String,
    /// The place in the project's documentation that explains cause and cure.
    #[schema(example = "docs/errors.md#plan-unknown_object")]
    see: String,
}

impl VerificationBody {
    /// The checker's report.
    pub fn new(report: &Report) -> Self {
        let mut faults: Vec<FaultBody> = report.faults.iter().map(FaultBody::new).collect();
        if report.interrupted {
            faults.push(FaultBody::interrupted());
        }
        let first_failing_step = report.first_failing_step;
        let replan = first_failing_step.is_some() || report.has(FaultCode::ReplayUnconfirmed);
        Self { valid: faults.is_empty(), faults, first_failing_step, replan }
    }

    /// The report if the time limit came before anything was checked.
    pub fn timed_out() -> Self {
        Self { valid: false, faults: vec![FaultBody::interrupted()], first_failing_step: None, replan: true }
    }
}

impl FaultBody {
    fn new(fault: &Fault) -> Self {
        let Fault { code, step, object, detail } = fault;
        Self { step: *step, object: object.clone(), ..Self::of_answer(code.name(), detail) }
    }

    fn of_answer(code: &'static str, detail: &str) -> Self {
        let see = format!("{ERRORS_PAGE}#plan-{code}");
        Self { code, step: None, object: None, detail: detail.to_owned(), see }
    }

    fn interrupted() -> Self {
        Self::of_answer("interrupted", "time ran out before everything was checked")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_report_without_faults_that_was_cut_short_is_not_valid() {
        assert!(VerificationBody::new(&Report::default()).valid);
        assert!(!VerificationBody::new(&Report { interrupted: true, ..Report::default() }).valid);
    }

    #[test]
    fn a_plan_is_needed_anew_where_a_step_fails_or_was_not_replayed() {
        let late = |code| vec![Fault { code, step: None, object: None, detail: String::new() }];
        let replan = |first_failing_step, faults| {
            VerificationBody::new(&Report { first_failing_step, faults, interrupted: true, ..Report::default() }).replan
        };
        assert!(replan(Some(0), Vec::new()));
        assert!(replan(None, late(FaultCode::ReplayUnconfirmed)));
        assert!(!replan(None, late(FaultCode::BoundUnconfirmed)));
        assert!(VerificationBody::timed_out().replan);
    }
}
