//! What is written in a part of a file, whatever else is wrong with it.

use hodograph_base::json::{Kind as NodeKind, Node, Word};

/// A name in a motion, whatever else is wrong with that.
pub(super) fn named(node: &Node, wanted: &str) -> Option<Word> {
    let NodeKind::Object(members) = &node.kind else { return None };
    members.iter().find_map(|(key, value)| match &value.kind {
        NodeKind::Text(name) if key.text == wanted => Some(Word { text: name.clone(), span: value.span }),
        _ => None,
    })
}

/// The key of a member of an object.
pub(super) fn member(node: &Node, wanted: &str) -> Option<Word> {
    let NodeKind::Object(members) = &node.kind else { return None };
    members.iter().map(|(key, _)| key).find(|key| key.text == wanted).cloned()
}

/// The texts in a list.
pub(super) fn texts(node: &Node) -> Vec<&str> {
    let NodeKind::Array(items) = &node.kind else { return Vec::new() };
    items.iter().filter_map(|n| if let NodeKind::Text(text) = &n.kind { Some(text.as_str()) } else { None }).collect()
}
