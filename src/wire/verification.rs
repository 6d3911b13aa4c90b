//! A verification as JSON.

use serde::Serialize;
use utoipa::ToSchema;

use crate::plan::check::{Fault, Report};

/// What the independent checker says of a stated answer.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, ToSchema)]
pub struct VerificationBody {
    /// True if everything that is stated holds and all of it could be checked.
    #[schema(example = false)]
    pub valid: bool,
    /// Everything that does not hold.
    pub faults: Vec<FaultBody>,
}

/// One thing that does not hold.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, ToSchema)]
pub struct FaultBody {
    /// The kind of fault, a word for programs; `interrupted` where the time limit came before all was checked.
    #[schema(example = "unknown_object")]
    pub code: String,
    /// The position of the relocation, counted from 0; null for the answer as a whole.
    #[schema(required = true, example = 0)]
    pub step: Option<usize>,
    /// The id of the object concerned; null where there is none.
    #[schema(required = true, example = "plate-2")]
    pub object: Option<String>,
    /// One sentence for people.
    #[schema(example = "there is no object 'plate-2'")]
    pub detail: String,
}

impl VerificationBody {
    /// The checker's report.
    pub fn new(report: &Report) -> Self {
        let mut faults: Vec<FaultBody> = report.faults.iter().map(FaultBody::new).collect();
        if report.interrupted {
            faults.push(FaultBody::interrupted());
        }
        Self { valid: faults.is_empty(), faults }
    }

    /// Nothing could be checked in time.
    pub fn timed_out() -> Self {
        Self { valid: false, faults: vec![FaultBody::interrupted()] }
    }
}

impl FaultBody {
    fn new(fault: &Fault) -> Self {
        let Fault { code, step, object, detail } = fault;
        Self { code: snake_case(&format!("{code:?}")), step: *step, object: object.clone(), detail: detail.clone() }
    }

    fn interrupted() -> Self {
        let detail = "the time limit came before everything was checked".to_owned();
        Self { code: "interrupted".to_owned(), step: None, object: None, detail }
    }
}

/// `UnknownObject` as `unknown_object`: the checker's own names are the words of the interface.
fn snake_case(name: &str) -> String {
    let mut word = String::with_capacity(name.len() + 4);
    for letter in name.chars() {
        if letter.is_ascii_uppercase() && !word.is_empty() {
            word.push('_');
        }
        word.push(letter.to_ascii_lowercase());
    }
    word
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::check::FaultCode;

    #[test]
    fn a_report_without_faults_that_was_cut_short_is_not_valid() {
        assert!(VerificationBody::new(&Report::default()).valid);
        assert!(!VerificationBody::new(&Report { interrupted: true, ..Report::default() }).valid);
    }

    #[test]
    fn a_fault_is_named_in_snake_case() {
        let fault = Fault { code: FaultCode::UnknownObject, step: None, object: None, detail: String::new() };
        assert_eq!(FaultBody::new(&fault).code, "unknown_object");
    }
}
