//! The interface document's schemas, read as the strictest of generators reads them.

use serde_json::Value;

/// What is wrong with a value by a schema of the document.
///
/// In JSON Schema an object of which nothing is said admits every field; openapi-typescript makes a type of it that admits
/// none, and so does this.
pub(crate) fn faults(document: &Value, schema: &Value, value: &Value, at: &str) -> Vec<String> {
    if let Some(reference) = schema["$ref"].as_str() {
        let pointer = reference.strip_prefix('#').unwrap();
        return faults(document, document.pointer(pointer).expect(reference), value, at);
    }
    if let Some(choices) = schema["oneOf"].as_array() {
        let fits = |choice: &&Value| faults(document, choice, value, at).is_empty();
        let fitting = choices.iter().filter(fits).count();
        return if fitting == 1 { Vec::new() } else { vec![format!("{at}: {value} fits {fitting} of {choices:?}")] };
    }
    let types = match &schema["type"] {
        Value::Array(types) => types.clone(),
        one => vec![one.clone()],
    };
    if !types.iter().any(|name| is(value, name.as_str().unwrap())) {
        return vec![format!("{at}: {value} is none of {types:?}")];
    }
    let mut wrong = Vec::new();
    let words = schema["enum"].as_array();
    if words.is_some_and(|words| !words.contains(value)) {
        wrong.push(format!("{at}: {value} is none of {words:?}"));
    }
    let bounds = (schema["minimum"].as_f64(), schema["maximum"].as_f64());
    if let Some(number) = value.as_f64() {
        let inside = bounds.0.is_none_or(|min| min <= number) && bounds.1.is_none_or(|max| number <= max);
        wrong.extend((!inside).then(|| format!("{at}: {number} is outside {bounds:?}")));
    }
    for (index, item) in value.as_array().into_iter().flatten().enumerate() {
        wrong.extend(faults(document, &schema["items"], item, &format!("{at}/{index}")));
    }
    let items = (schema["minItems"].as_u64(), schema["maxItems"].as_u64());
    wrong.extend(value.as_array().and_then(|list| outside(at, "items", list.len(), items)));
    if let Some(object) = value.as_object() {
        let fields = (schema["minProperties"].as_u64(), schema["maxProperties"].as_u64());
        wrong.extend(outside(at, "fields", object.len(), fields));
        let required = schema["required"].as_array().into_iter().flatten().map(|name| name.as_str().unwrap());
        wrong.extend(required.filter(|name| !object.contains_key(*name)).map(|name| format!("{at}/{name} is missing")));
        let closed = schema["properties"].is_null() && schema["additionalProperties"].is_null();
        let closed = closed || schema["additionalProperties"] == Value::Bool(false);
        for (name, field) in object {
            let inner = format!("{at}/{name}");
            match &schema["properties"][name] {
                Value::Null if closed => wrong.push(format!("{inner} is one too many")),
                Value::Null => {}
                property => wrong.extend(faults(document, property, field, &inner)),
            }
        }
    }
    wrong
}

fn outside(at: &str, of: &str, count: usize, (min, max): (Option<u64>, Option<u64>)) -> Option<String> {
    let inside = min.is_none_or(|min| min <= count as u64) && max.is_none_or(|max| count as u64 <= max);
    (!inside).then(|| format!("{at} has {count} {of}, not {min:?} to {max:?}"))
}

fn is(value: &Value, name: &str) -> bool {
    match name {
        "null" => value.is_null(),
        "boolean" => value.is_boolean(),
        "integer" => value.is_i64() || value.is_u64(),
        "number" => value.is_number(),
        "string" => value.is_string(),
        "array" => value.is_array(),
        "object" => value.is_object(),
        other => panic!("'{other}' is no type"),
    }
}
