//! The walk and the JSON library: what is JSON for one is for the other, with the same value.

use proptest::prelude::*;
use proptest::sample::{select, subsequence};
use serde_json::Value;

use super::edits::{EDITS, SOUND};
use super::{has_faults, read, scene};
use crate::wire::json::Json;
use crate::wire::malformed::Sound;
use crate::wire::reader::{JsonNode, RequestFaults};
use crate::wire::walk::walk;

/// Whether the walk takes this text for JSON; the library must be of the same opinion.
#[track_caller]
fn is_json(text: &[u8]) -> bool {
    let walked = walk(text).value.is_some();
    let shown = String::from_utf8_lossy(text);
    assert_eq!(walked, serde_json::from_slice::<Sound>(text).is_ok(), "{shown}");
    walked
}

/// Any value, some with equal names in one object.
fn anything() -> impl Strategy<Value = Value> {
    let leaf = prop_oneof![
        Just(Value::Null),
        any::<bool>().prop_map(Value::from),
        any::<f64>().prop_map(Value::from),
        any::<i64>().prop_map(Value::from),
        ".{0,6}".prop_map(Value::from),
    ];
    leaf.prop_recursive(4, 40, 6, |inner| {
        prop_oneof![
            proptest::collection::vec(inner.clone(), 0..6).prop_map(Value::from),
            proptest::collection::vec(("[a-c\\\\\"ü]{0,2}", inner), 0..6)
                .prop_map(|fields| fields.into_iter().collect()),
        ]
    })
}

fn as_the_library_has_it(value: &Json<'_>) -> Value {
    match value {
        Json::Null => Value::Null,
        Json::Bool(value) => (*value).into(),
        Json::Number(literal) => serde_json::from_str(literal).unwrap(),
        Json::String(text) => text.as_ref().into(),
        Json::Array(items) => items.iter().map(as_the_library_has_it).collect(),
        Json::Object(object) => {
            object.fields.iter().map(|(name, value)| (name.as_ref(), as_the_library_has_it(value))).collect()
        }
    }
}

proptest! {
    #[test]
    fn the_walk_reads_what_the_library_reads(value in anything(), pretty: bool) {
        let text = if pretty { serde_json::to_string_pretty(&value) } else { serde_json::to_string(&value) }.unwrap();
        let walked = walk(text.as_bytes());
        prop_assert!(walked.slip.is_none() && walked.no_numbers.is_empty() && walked.repeated.is_empty());
        prop_assert_eq!(walked.value.as_ref().map(as_the_library_has_it), Some(value));
    }

    #[test]
    fn with_bytes_lost_and_changed_they_agree_on_what_is_json(
        edits in subsequence(&EDITS[..], 0..=2),
        bytes in proptest::collection::vec((any::<prop::sample::Index>(), select(&b"{}[]\":,.eE-+019 \\und\x00\xc3\xbf"[..]), any::<bool>()), 0..4),
    ) {
        let mut body = SOUND.to_owned();
        for (old, new) in edits {
            body = body.replacen(old, new, 1);
        }
        let mut body = body.into_bytes();
        for (at, byte, lose) in bytes {
            let at = at.index(body.len());
            if lose { body.remove(at); } else { body[at] = byte; }
        }
        is_json(&body);
    }

    #[test]
    fn of_any_row_of_a_numbers_bytes_they_agree_on_whether_it_is_one(literal in "[-+]?[-+.eE019]{0,8}") {
        is_json(literal.as_bytes());
        is_json(format!("[{literal}]").as_bytes());
    }

    #[test]
    fn a_number_is_the_same_double_either_way(literal in "-?(0|[1-9][0-9]{0,24})(\\.[0-9]{1,25})?([eE][+-]?[0-9]{1,3})?") {
        let straight = serde_json::from_str::<f64>(&literal).ok();
        let walked = walk(literal.as_bytes()).value.expect("a number");
        let number = JsonNode::root(&walked).number(&mut RequestFaults::default());
        assert_eq!(straight.map(f64::to_bits), number.map(f64::to_bits), "{literal}");
    }
}

#[test]
fn a_number_is_written_as_json_has_it() {
    let digits = "9".repeat(400);
    for literal in ["0", "-0", "10", "-1.50", "0.0e-0", "1E400", "1e-400", "1e+05", &digits, &format!("0.{digits}")] {
        assert!(is_json(literal.as_bytes()), "{literal}");
    }
    let none = [
        "0123", "-01", "00", "1.", "1.e3", ".5", "-.5", "+1", "--1", "-", "1e", "1e+", "1-2", "1.2.3", "1e5.0", "0x1",
        "1f", "1_0", "1 0",
    ];
    for literal in none {
        assert!(!is_json(literal.as_bytes()), "{literal}");
        let body = scene().to_string().replacen("0.3", literal, 1);
        assert_eq!(read(&body).expect_err("no number").status(), 400, "{literal}");
    }
}

#[test]
fn a_number_that_no_double_can_hold_is_json_and_out_of_range() {
    for literal in ["1E400", "-1e999", &"9".repeat(400)] {
        let problem = read(&scene().to_string().replacen("0.3", literal, 1)).expect_err("out of range");
        has_faults(&problem, &[("out_of_range", "/objects/0/x")]);
        let shown = &literal[..literal.len().min(40)];
        let told = format!("{shown} is out of the range of every field");
        assert_eq!(problem.errors()[0].detail, told);
    }
}
