//! What a key is for.

use core::fmt;
use core::str::FromStr;

/// Something that a key may be for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scope {
    /// To plan now, to check plans, to survey.
    Plan,
    /// Everything about jobs.
    Jobs,
    /// To look at jobs.
    ReadOnly,
    /// What is measured.
    Metrics,
}

impl Scope {
    /// Every one.
    pub const ALL: [Self; 4] = [Self::Plan, Self::Jobs, Self::ReadOnly, Self::Metrics];

    /// As it is written everywhere.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Plan => "plan",
            Self::Jobs => "jobs",
            Self::ReadOnly => "read-only",
            Self::Metrics => "metrics",
        }
    }
}

/// All that a key is for: one scope at least.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Scopes(Vec<Scope>);

impl Scopes {
    /// What these words name.
    ///
    /// # Errors
    /// What is wrong with them; their own text is not repeated, for it may be a key in the wrong place.
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

    /// True if one of these is among them.
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
    /// As the keys file has it: quoted, in brackets.
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
