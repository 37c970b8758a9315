//! Reads single names and texts of a file that may have faults elsewhere.

use hodograph_base::json::{Node, NodeKind, Word};

/// Returns the text of a member of an object, even if other members have faults.
pub(super) fn named(node: &Node, wanted: &str) -> Option<Word> {
    let NodeKind::Object(members) = &node.kind else { return None };
    members.iter().find_map(|(key, value)| match &value.kind {
        NodeKind::Text(name) if key.text == wanted => {
            Some(Word { text: name.clone(), span: value.span })
        }
        _ => None,
    })
}

/// Returns the key of a member of an object.
pub(super) fn member(node: &Node, wanted: &str) -> Option<Word> {
    let NodeKind::Object(members) = &node.kind else { return None };
    members.iter().map(|(key, _)| key).find(|key| key.text == wanted).cloned()
}

/// Returns the texts in a list.
pub(super) fn texts(node: &Node) -> Vec<&str> {
    let NodeKind::Array(items) = &node.kind else { return Vec::new() };
    items
        .iter()
        .filter_map(|n| if let NodeKind::Text(text) = &n.kind { Some(text.as_str()) } else { None })
        .collect()
}
