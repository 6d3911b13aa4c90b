//! The scopes of keys.

use core::fmt;
use core::str::FromStr;

/// A scope.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scope {
    /// Plan now, check plans, survey, knowledge.
    Plan,
    /// All calls about jobs.
    Jobs,
    /// Read jobs.
    ReadOnly,
    /// Read metrics.
    Metrics,
}

impl Scope {
    /// Every scope.
    pub const ALL: [Self; 4] = [Self::Plan, Self::Jobs, Self::ReadOnly, Self::Metrics];

    /// Its name in files and logs.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Plan => "plan",
            Self::Jobs => "jobs",
            Self::ReadOnly => "read-only",
            Self::Metrics => "metrics",
        }
    }
}

/// The scopes of a key, at least one.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Scopes(Vec<Scope>);

impl Scopes {
    /// The scopes with these names.
    ///
    /// # Errors
    /// The fault, without the names: one may be a misplaced key.
    pub fn read<'a>(words: impl IntoIterator<Item = &'a str>) -> Result<Self, String> {
        let read = |word: &str| Scope::ALL.into_iter().find(|scope| scope.as_str() == word);
        match words.into_iter().map(read).collect::<Option<Vec<Scope>>>() {
            Some(scopes) if !scopes.is_empty() => Ok(Self(scopes)),
            _ => {
                let known = Scope::ALL.map(Scope::as_str).join(", ");
                Err(format!("scopes are one or more of {known}"))
            }
        }
    }

    /// True if it has one of these scopes.
    pub fn any_of(&self, wanted: &[Scope]) -> bool {
        self.0.iter().any(|scope| wanted.contains(scope))
    }
}

impl FromStr for Scopes {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::read(text.split(','))
    }
}

impl fmt::Display for Scopes {
    /// As in the keys file: quoted, in brackets.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words: Vec<String> = self.0.iter().map(|scope| format!("\"{}\"", scope.as_str())).collect();
        write!(f, "[{}]", words.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scopes_are_read_as_they_are_written() {
        for scope in Scope::ALL {
            assert_eq!(scope.as_str().parse(), Ok(Scopes(vec![scope])));
        }
        let scopes: Scopes = "plan,read-only".parse().unwrap();
        assert_eq!(scopes.to_string(), r#"["plan", "read-only"]"#);
        assert!(scopes.any_of(&[Scope::Jobs, Scope::ReadOnly]) && !scopes.any_of(&[Scope::Jobs]));
        for wrong in ["", "plan,", "plan, jobs", "Plan", "all"] {
            assert!(wrong.parse::<Scopes>().is_err(), "{wrong}");
        }
    }
}
