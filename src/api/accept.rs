//! Content negotiation by `Accept` (RFC 9110, section 12.5.1).

use axum::http::{HeaderMap, header};

use crate::computation::Form;
use crate::wire::{Problem, ProblemKind};

/// One entry of the header: a range of media types and its weight.
struct Range<'a> {
    name: &'a str,
    weight: f64,
}

impl<'a> Range<'a> {
    fn parse(entry: &'a str) -> Option<Self> {
        let mut parts = entry.split(';').map(str::trim);
        let name = parts.next().filter(|name| !name.is_empty())?;
        let weight =
            parts.filter_map(|part| part.split_once('=')).find(|(name, _)| name.trim().eq_ignore_ascii_case("q"));
        // An unreadable weight is ignored.
        let weight = weight.and_then(|(_, value)| value.trim().parse().ok()).unwrap_or(1.0);
        Some(Self { name, weight })
    }

    /// How specific the match is: 3 for the form's own name, 1 for `*/*`, 0 for none.
    fn specificity(&self, form: Form) -> u8 {
        let media_type = form.media_type();
        if self.name.eq_ignore_ascii_case(media_type) {
            3
        } else if self.name.strip_suffix('*').is_some_and(|prefix| prefix != "*/" && media_type.starts_with(prefix)) {
            2
        } else {
            u8::from(self.name == "*/*")
        }
    }
}

/// The client's preferred form. Ties go to the more specific match, then to the first.
///
/// # Errors
/// A problem if the client accepts none.
pub(super) fn choose(headers: &HeaderMap, offered: &[Form]) -> Result<Form, Problem> {
    let values: Vec<&str> = headers.get_all(header::ACCEPT).iter().filter_map(|value| value.to_str().ok()).collect();
    let ranges: Vec<Range<'_>> = values.iter().flat_map(|value| value.split(',')).filter_map(Range::parse).collect();
    if ranges.is_empty() {
        return Ok(offered[0]);
    }
    let liking = |form: Form| {
        let closest = ranges.iter().max_by_key(|range| range.specificity(form))?;
        let specificity = closest.specificity(form);
        (specificity > 0 && closest.weight > 0.0).then_some((closest.weight, specificity))
    };
    let mut best: Option<((f64, u8), Form)> = None;
    for &form in offered {
        let Some(liking) = liking(form) else { continue };
        if best.is_none_or(|(best, _)| liking > best) {
            best = Some((liking, form));
        }
    }
    best.map(|(_, form)| form).ok_or_else(|| {
        let names: Vec<&str> = offered.iter().map(|form| form.media_type()).collect();
        Problem::new(ProblemKind::NotAcceptable, format!("served here: {}", names.join(", ")))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(accept: &[&'static str], expected: Option<Form>) {
        let mut headers = HeaderMap::new();
        for value in accept {
            headers.append(header::ACCEPT, value.parse().unwrap());
        }
        assert_eq!(choose(&headers, &[Form::Json, Form::Svg]).ok(), expected, "{accept:?}");
    }

    #[test]
    fn the_client_gets_what_it_likes_best() {
        check(&[], Some(Form::Json));
        check(&[""], Some(Form::Json));
        check(&["*/*"], Some(Form::Json));
        check(&["application/*"], Some(Form::Json));
        check(&["image/*"], Some(Form::Svg));
        check(&["image/svg+xml"], Some(Form::Svg));
        check(&["Image/SVG+xml, */*"], Some(Form::Svg));
        check(&["image/svg+xml;q=0.5, application/json;q=0.4"], Some(Form::Svg));
        check(&["image/svg+xml;q=0.4", "application/json;q=0.5"], Some(Form::Json));
        check(&["text/html, application/xhtml+xml, */*;q=0.8"], Some(Form::Json));
        check(&["application/json;q=0, */*"], Some(Form::Svg));
        check(&["application/json;charset=utf-8"], Some(Form::Json));
    }

    #[test]
    fn an_accept_without_any_available_format_is_refused() {
        check(&["text/html"], None);
        check(&["application/json;q=0"], None);
        check(&["*/*;q=0"], None);
    }
}
