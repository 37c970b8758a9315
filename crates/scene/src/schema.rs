//! The JSON Schema of the scene file, for editors and other programs.
//!
//! The schema defines the shape; only [`super::read`] checks relations between sections (such as a
//! point that no link has).

/// Returns the schema, draft 2020-12.
pub fn schema() -> &'static str {
    include_str!("schema.json")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Kind, keys, templates, units::RequiredQuantity};
    use serde_json::Value;
    use std::collections::BTreeSet;

    fn validator() -> jsonschema::Validator {
        let schema: Value = serde_json::from_str(schema()).expect("the schema is JSON");
        jsonschema::validator_for(&schema).expect("the schema is a schema")
    }

    #[test]
    fn every_template_fits_the_schema() {
        let validator = validator();
        for template in templates::list() {
            let scene: Value =
                serde_json::from_str(templates::get(template.name).unwrap()).unwrap();
            let faults: Vec<String> = validator
                .iter_errors(&scene)
                .map(|e| format!("{}: {e}", e.instance_path()))
                .collect();
            assert!(faults.is_empty(), "{}: {faults:#?}", template.name);
        }
    }

    /// The schema accepts every quantity that a question can name.
    #[test]
    fn every_quantity_fits_the_schema() {
        let validator = validator();
        let mut scene: Value =
            serde_json::from_str(templates::get("crank-rocker").unwrap()).unwrap();
        for entry in crate::quantity::symbols() {
            scene["find"] = serde_json::json!([entry.example]);
            let faults: Vec<String> = validator
                .iter_errors(&scene)
                .map(|e| format!("{}: {e}", e.instance_path()))
                .collect();
            assert!(faults.is_empty(), "{}: {faults:#?}", entry.example);
        }
    }

    #[test]
    fn the_schema_refuses_what_the_reader_refuses_by_shape() {
        let validator = validator();
        let scene: Value = serde_json::from_str(templates::get("crank-rocker").unwrap()).unwrap();
        for (pointer, value) in [
            ("/driver", serde_json::json!({"link": "1"})),
            ("/driver", serde_json::json!({"link": "1", "omega": "1 rad/s", "rate": "1 m/s"})),
            ("/links", serde_json::json!({"1": "AB"})),
            ("/title", serde_json::json!(3)),
            ("/ground", serde_json::json!(4)),
        ] {
            let mut bad = scene.clone();
            *bad.pointer_mut(pointer).unwrap() = value;
            assert!(!validator.is_valid(&bad), "{pointer} {}", bad.pointer(pointer).unwrap());
            assert!(super::super::read(bad.to_string()).is_err(), "{pointer}");
        }
    }

    #[test]
    fn schema_and_decoder_know_the_same_keys() {
        let schema: Value = serde_json::from_str(schema()).unwrap();
        let units = RequiredQuantity::TABLE.map(|(key, _)| key);
        let printed: Vec<&str> =
            Kind::ALL.into_iter().filter_map(|kind| RequiredQuantity::of(kind).key()).collect();
        for (place, known) in [
            ("", keys::SCENE),
            ("/$defs/text/oneOf/1", &["en", "zh"]),
            ("/$defs/place_xy", keys::PLACE_XY),
            ("/$defs/place_polar", keys::PLACE_POLAR),
            ("/$defs/guide", keys::GUIDE),
            ("/$defs/composite", keys::COMPOSITE),
            ("/$defs/attempt", keys::ATTEMPT),
            ("/$defs/motion", keys::MOTION),
            ("/$defs/gear", keys::GEAR),
            ("/$defs/rolling", keys::ROLLING),
            ("/$defs/belt", keys::BELT),
            ("/$defs/chain", keys::CHAIN),
            ("/$defs/turn", keys::TURN),
            ("/$defs/slide", keys::SLIDE),
            ("/$defs/cylinder", keys::CYLINDER),
            ("/$defs/cam", keys::CAM),
            ("/$defs/cam_roller", keys::ROLLER),
            ("/$defs/cam_arc", keys::ARC),
            ("/$defs/cam_face", keys::FACE),
            ("/$defs/cam_part", keys::CAM_PART),
            ("/$defs/cam_law", keys::CAM_LAW),
            ("/$defs/cam_stage", keys::CAM_STAGE),
            ("/$defs/paper", keys::PAPER),
            ("/properties/units", &units),
            ("/properties/answers", &printed),
        ] {
            let object =
                schema.pointer(place).unwrap_or_else(|| panic!("no {place} in the schema"));
            let written: BTreeSet<&str> =
                object["properties"].as_object().unwrap().keys().map(String::as_str).collect();
            assert_eq!(written, known.iter().copied().collect(), "{place}");
            assert_eq!(object["additionalProperties"], Value::Bool(false), "{place}");
            for (key, property) in object["properties"].as_object().unwrap() {
                assert!(property["description"].is_string(), "{place}: {key} has no description");
            }
        }
    }
}
