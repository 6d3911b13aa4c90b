//! The words that labels may hold. All are known beforehand, so that the number of series is.

/// Names a closed list of words.
macro_rules! words {
    ($(#[$about:meta])* $name:ident { $($(#[$each:meta])* $variant:ident = $word:literal,)+ }) => {
        $(#[$about])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum $name {
            $($(#[$each])* $variant,)+
        }

        impl $name {
            /// Every one.
            pub const ALL: &'static [Self] = &[$(Self::$variant,)+];

            /// As it is written.
            pub fn as_str(self) -> &'static str {
                match self {
                    $(Self::$variant => $word,)+
                }
            }
        }
    };
}

words! {
    /// What waits for a thread.
    Queue {
        /// A request whose client waits for the answer.
        Plan = "plan",
        /// A job.
        Job = "job",
    }
}

words! {
    /// Why a request was turned away, whatever it asked for.
    Refusal {
        /// Every thread is busy and the queue is full.
        Full = "full",
        /// It could not be answered within its time limit.
        TooLate = "too_late",
        /// The service shuts down, or has lost a thread.
        NotReady = "not_ready",
        /// The store of jobs does not answer.
        StoreUnavailable = "store_unavailable",
        /// As many wait, or watch, as may.
        Limit = "limit",
        /// No key or client certificate, or one that does not hold.
        Unauthorized = "unauthorized",
        /// A key for something else.
        Forbidden = "forbidden",
        /// A key that was used too often.
        RateExceeded = "rate_exceeded",
    }
}

words! {
    /// How a job ended.
    Ended {
        /// There is an answer, whatever its verdict.
        Succeeded = "succeeded",
        /// There is none.
        Failed = "failed",
        /// Its caller wanted no more of it.
        Cancelled = "cancelled",
        /// No worker had it before its time was over.
        Expired = "expired",
    }
}

words! {
    /// What became of a call of the store.
    StoreOutcome {
        /// It was done, or refused for a reason of the caller's.
        Done = "done",
        /// The store failed.
        Failed = "failed",
    }
}

words! {
    /// What became of a try to deliver a callback.
    CallbackOutcome {
        /// It arrived.
        Delivered = "delivered",
        /// It did not, and will be tried again.
        Again = "again",
        /// It did not, and there are no more tries.
        GivenUp = "given_up",
        /// Its host is none that may be called.
        Forbidden = "forbidden",
    }
}

/// The method as a label. Clients may make up any.
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
