//! The header `traceparent` (W3C Trace Context): the client's span.

use core::fmt;

use opentelemetry::trace::{SpanContext, SpanId, TraceFlags, TraceId, TraceState};

/// The client's span.
#[derive(Debug, Clone, PartialEq)]
pub struct Traceparent(SpanContext);

impl Traceparent {
    /// Read the header. `None` if it is invalid: the request then begins a new trace.
    pub fn parse(text: &str) -> Option<Self> {
        let mut parts = text.trim().split('-');
        let version = number(parts.next()?, 2)?;
        let trace = number(parts.next()?, 32)?;
        let parent = number(parts.next()?, 16)?;
        let flags = number(parts.next()?, 2)?;
        // Later versions may have more parts; version 255 is invalid.
        let more = parts.next().is_some();
        if trace == 0 || parent == 0 || version == 255 || (version == 0 && more) {
            return None;
        }
        let sampled = TraceFlags::new(u8::try_from(flags).ok()?) & TraceFlags::SAMPLED;
        let (trace, parent) = (TraceId::from(trace), SpanId::from(u64::try_from(parent).ok()?));
        Some(Self(SpanContext::new(trace, parent, sampled, true, TraceState::NONE)))
    }

    pub(super) fn span_context(&self) -> &SpanContext {
        &self.0
    }
}

/// The trace id for logs.
impl fmt::Display for Traceparent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.trace_id().fmt(f)
    }
}

/// This many lower-case hexadecimal digits.
fn number(text: &str, digits: usize) -> Option<u128> {
    let valid = text.len() == digits && text.bytes().all(|byte| matches!(byte, b'0'..=b'9' | b'a'..=b'f'));
    if valid { u128::from_str_radix(text, 16).ok() } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRACE: &str = "0af7651916cd43dd8448eb211c80319c";

    #[test]
    fn a_valid_header_names_trace_and_parent() {
        for (text, sampled) in [
            (format!("00-{TRACE}-b7ad6b7169203331-01"), true),
            (format!(" 00-{TRACE}-b7ad6b7169203331-00 "), false),
            (format!("00-{TRACE}-b7ad6b7169203331-ff"), true),
            (format!("01-{TRACE}-b7ad6b7169203331-01-more"), true),
        ] {
            let parent = Traceparent::parse(&text).unwrap();
            assert_eq!(parent.to_string(), TRACE);
            assert_eq!(parent.span_context().span_id().to_string(), "b7ad6b7169203331");
            assert_eq!(parent.span_context().is_sampled(), sampled, "{text}");
        }
    }

    #[test]
    fn anything_else_is_no_header() {
        for text in [
            String::new(),
            TRACE.to_owned(),
            format!("00-{TRACE}-b7ad6b7169203331"),
            format!("ff-{TRACE}-b7ad6b7169203331-01"),
            format!("+0-{TRACE}-b7ad6b7169203331-01"),
            format!("00-{TRACE}-b7ad6b7169203331-01-more"),
            format!("00-{}-b7ad6b7169203331-01", TRACE.to_uppercase()),
            format!("00-{TRACE}-0000000000000000-01"),
            format!("00-{}-b7ad6b7169203331-01", "0".repeat(32)),
            format!("00-{TRACE}-b7ad6b716920333-001"),
            "00-é-b7ad6b7169203331-01".to_owned(),
        ] {
            assert_eq!(Traceparent::parse(&text), None, "{text}");
        }
    }
}
