//! The JSON Schema of motions without a mechanism, for editors and other programs.
//!
//! It defines the keys and their shapes; only [`super::read`] checks their consistency.

/// Returns the schema, draft 2020-12.
pub fn schema() -> &'static str {
    include_str!("schema.json")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::particle::read::{KEYS, MOTION, PLATE};
    use crate::particle::templates;
    use hodograph_scene::front;
    use serde_json::Value;
    use std::collections::BTreeSet;

    #[test]
    fn schema_and_reader_know_the_same_keys() {
        let schema: Value = serde_json::from_str(schema()).unwrap();
        let keys = |at: &str| -> BTreeSet<String> {
            schema.pointer(at).unwrap().as_object().unwrap().keys().cloned().collect()
        };
        let owned =
            |all: Vec<&str>| -> BTreeSet<String> { all.into_iter().map(str::to_owned).collect() };
        assert_eq!(keys("/properties"), owned(front::KEYS.iter().chain(&KEYS).copied().collect()));
        assert_eq!(keys("/properties/motions/items/properties"), owned(MOTION.to_vec()));
        assert_eq!(keys("/properties/plates/items/properties"), owned(PLATE.to_vec()));
    }

    #[test]
    fn every_template_fits_the_schema() {
        let schema: Value = serde_json::from_str(schema()).unwrap();
        let validator = jsonschema::validator_for(&schema).expect("the schema is a schema");
        for name in templates::names() {
            let file: Value = serde_json::from_str(templates::get(name).unwrap()).unwrap();
            let faults: Vec<String> = validator
                .iter_errors(&file)
                .map(|e| format!("{}: {e}", e.instance_path()))
                .collect();
            assert!(faults.is_empty(), "{name}: {faults:#?}");
        }
    }
}
