//! The JSON Schema of vector equations, for editors and other programs.
//!
//! It defines the keys and their shapes; only [`super::read`] checks their consistency.

/// Returns the schema, draft 2020-12.
pub fn schema() -> &'static str {
    include_str!("schema.json")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::equation::read::{KEYS, VECTOR};
    use crate::equation::templates;
    use hodograph_scene::front;
    use serde_json::Value;
    use std::collections::BTreeSet;

    #[test]
    fn schema_and_reader_know_the_same_keys() {
        let schema: Value = serde_json::from_str(schema()).unwrap();
        let keys = |at: &str| -> BTreeSet<&str> {
            schema.pointer(at).unwrap().as_object().unwrap().keys().map(String::as_str).collect()
        };
        assert_eq!(keys("/properties"), front::KEYS.iter().chain(&KEYS).copied().collect());
        let vector = "/properties/vectors/additionalProperties/properties";
        assert_eq!(keys(vector), VECTOR.into_iter().collect());
    }

    #[test]
    fn every_template_fits_the_schema() {
        let schema: Value = serde_json::from_str(schema()).unwrap();
        let validator = jsonschema::validator_for(&schema).expect("the schema is a schema");
        for name in templates::names() {
            let file: Value = serde_json::from_str(templates::get(name).unwrap()).unwrap();
            let faults: Vec<String> = validator.iter_errors(&file).map(|e| e.to_string()).collect();
            assert!(faults.is_empty(), "{name}: {faults:#?}");
        }
    }
}
