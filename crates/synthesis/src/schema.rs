//! The JSON Schema of the synthesis file, for editors and other programs.
//!
//! It describes the keys and their shapes for all kinds together; only [`super::read`] decides
//! which of them a kind accepts.

/// The schema, draft 2020-12.
pub fn schema() -> &'static str {
    include_str!("schema.json")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{COMMON, KINDS, templates};
    use hodograph_scene::front;
    use serde_json::Value;
    use std::collections::BTreeSet;

    #[test]
    fn schema_and_reader_know_the_same_keys() {
        let schema: Value = serde_json::from_str(schema()).unwrap();
        let written: BTreeSet<&str> =
            schema["properties"].as_object().unwrap().keys().map(String::as_str).collect();
        let known = front::KEYS
            .iter()
            .chain(&COMMON)
            .chain(KINDS.iter().flat_map(|k| k.keys))
            .copied()
            .collect();
        assert_eq!(written, known);
        let kinds: BTreeSet<&str> = schema["properties"]["synthesis"]["enum"]
            .as_array()
            .unwrap()
            .iter()
            .filter_map(Value::as_str)
            .collect();
        assert_eq!(kinds, KINDS.iter().map(|k| k.name).collect());
    }

    #[test]
    fn every_template_fits_the_schema() {
        let schema: Value = serde_json::from_str(schema()).unwrap();
        let validator = jsonschema::validator_for(&schema).expect("the schema is a schema");
        for name in templates::names() {
            let task: Value = serde_json::from_str(templates::get(name).unwrap()).unwrap();
            let faults: Vec<String> = validator
                .iter_errors(&task)
                .map(|e| format!("{}: {e}", e.instance_path()))
                .collect();
            assert!(faults.is_empty(), "{name}: {faults:#?}");
        }
    }
}
