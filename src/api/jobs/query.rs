//! Query parameters.

use core::fmt::Display;
use core::ops::RangeInclusive;

use axum::extract::{FromRequestParts, Query};
use axum::http::request::Parts;

use crate::wire::{ErrorCode, ErrorItem, Problem, ProblemKind};

/// The parameters of a request, in order.
pub(in crate::api) struct Parameters(Vec<(String, String)>);

impl<S: Send + Sync> FromRequestParts<S> for Parameters {
    type Rejection = Problem;

    async fn from_request_parts(parts: &mut Parts, state: &S) -> Result<Self, Problem> {
        let Query(list) = Query::from_request_parts(parts, state)
            .await
            .map_err(|error| Problem::new(ProblemKind::InvalidRequest, error.to_string()))?;
        Ok(Self(list))
    }
}

impl Parameters {
    /// # Errors
    /// A problem if one is unknown or repeated.
    pub(super) fn only(self, names: &[&str]) -> Result<Self, Problem> {
        for (at, (name, _)) in self.0.iter().enumerate() {
            if !names.contains(&name.as_str()) {
                return Err(invalid(
                    ErrorCode::UnknownParameter,
                    format_args!("'{name}'; known here: {}", names.join(", ")),
                ));
            }
            if self.0[..at].iter().any(|(other, _)| other == name) {
                return Err(invalid(ErrorCode::RepeatedParameter, format_args!("'{name}' is repeated")));
            }
        }
        Ok(self)
    }

    /// A parameter, parsed by `read`.
    ///
    /// # Errors
    /// A problem that names the expected form.
    pub(super) fn read<T>(
        &self,
        name: &str,
        expected: impl Display,
        read: impl FnOnce(&str) -> Option<T>,
    ) -> Result<Option<T>, Problem> {
        let Some((_, text)) = self.0.iter().find(|(other, _)| other == name) else { return Ok(None) };
        read(text)
            .map(Some)
            .ok_or_else(|| invalid(ErrorCode::OutOfRange, format_args!("the parameter '{name}' must be {expected}")))
    }

    /// An integer.
    ///
    /// # Errors
    /// A problem if it is no integer, or out of range.
    pub(super) fn number(&self, name: &str, range: RangeInclusive<u64>) -> Result<Option<u64>, Problem> {
        let expected = format!("a whole number from {} to {}", range.start(), range.end());
        self.read(name, expected, |text| text.parse().ok().filter(|number| range.contains(number)))
    }
}

fn invalid(code: ErrorCode, detail: core::fmt::Arguments<'_>) -> Problem {
    Problem::invalid(vec![ErrorItem::new(code, "", detail.to_string())])
}
