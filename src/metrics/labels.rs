//! Label values are closed enums, so the number of series is bounded.

/// Defines a closed list of label values.
macro_rules! words {
    ($(#[$about:meta])* $name:ident { $($(#[$each:meta])* $variant:ident = $word:literal,)+ }) => {
        $(#[$about])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum $name {
            $($(#[$each])* $variant,)+
        }

        impl $name {
            /// Every value.
            pub const ALL: &'static [Self] = &[$(Self::$variant,)+];

            /// The value as text.
            pub fn as_str(self) -> &'static str {
                match self {
                    $(Self::$variant => $word,)+
                }
            }
        }
    };
}

words! {
    /// The kind of work that waits for a thread.
    Queue {
        /// A request whose client waits for the answer.
        Plan = "plan",
        /// A job.
        Job = "job",
    }
}

words! {
    /// Why a request was refused.
    Refusal {
        /// Every thread is busy and the queue is full.
        Full = "full",
        /// It could not be answered within its time limit.
        TooLate = "too_late",
        /// The service shuts down, or has lost a thread.
        NotReady = "not_ready",
        /// The store of jobs does not answer.
        StoreUnavailable = "store_unavailable",
        /// The limit on concurrent requests of this kind is reached.
        Limit = "limit",
        /// No valid key or client certificate.
        Unauthorized = "unauthorized",
        /// The key lacks the scope.
        Forbidden = "forbidden",
        /// The key's rate is exceeded.
        RateExceeded = "rate_exceeded",
    }
}

words! {
    /// How a job ended.
    Ended {
        /// With an answer, whatever its verdict.
        Succeeded = "succeeded",
        /// With a problem.
        Failed = "failed",
        /// Cancelled by its caller.
        Cancelled = "cancelled",
        /// Not claimed before it expired.
        Expired = "expired",
    }
}

words! {
    /// The outcome of a store call.
    StoreOutcome {
        /// Done, or refused because of the request.
        Done = "done",
        /// The store failed.
        Failed = "failed",
    }
}

words! {
    /// The outcome of a delivery of a callback.
    CallbackOutcome {
        /// Delivered.
        Delivered = "delivered",
        /// Failed, and will be tried again.
        Again = "again",
        /// Failed, with no more tries.
        GivenUp = "given_up",
        /// The host may not be called.
        Forbidden = "forbidden",
    }
}

/// The method as a label. Clients may send any text as a method.
pub(super) fn method(method: &str) -> &'static str {
    const KNOWN: [&str; 7] = ["GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "OPTIONS"];
    KNOWN.into_iter().find(|known| *known == method).unwrap_or("other")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_snake_case_and_differ() {
        let all: Vec<&str> = [
            Queue::ALL.iter().map(|word| word.as_str()).collect::<Vec<_>>(),
            Refusal::ALL.iter().map(|word| word.as_str()).collect(),
            Ended::ALL.iter().map(|word| word.as_str()).collect(),
            StoreOutcome::ALL.iter().map(|word| word.as_str()).collect(),
            CallbackOutcome::ALL.iter().map(|word| word.as_str()).collect(),
        ]
        .concat();
        assert!(all.iter().all(|word| word.bytes().all(|byte| byte == b'_' || byte.is_ascii_lowercase())), "{all:?}");
        assert_eq!(Refusal::ALL.len(), 8);
    }

    #[test]
    fn a_made_up_method_has_no_name_of_its_own() {
        assert_eq!((method("GET"), method("get"), method("BREW")), ("GET", "other", "other"));
    }
}
