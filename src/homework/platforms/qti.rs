//! QTI 3.0 and QTI 2.1: a package of items, one for each question.
//!
//! The two versions name the same elements differently, `qti-base-value` and `baseValue`; the items
//! are written with the names of version 3. A response is compared by `gte` and `lte` after
//! `is-null` is excluded: players give credit to an empty or unreadable response when `equal` has a
//! tolerance.

use super::{Judgement, PlatformQuestion, PlatformSet, PlatformTask};
use crate::homework::keys::number;
use crate::paper::words::words;
use crate::render::escaped;
use crate::zip::{ArchiveFile, zip};

/// A version of QTI.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum QtiVersion {
    /// QTI 2.1.
    Two,
    /// QTI 3.0.
    Three,
}

/// Writes the questions as a package (ZIP).
pub fn qti(set: &PlatformSet, version: QtiVersion) -> Vec<u8> {
    zip(&files(set, version))
}

/// Returns the files of the package.
pub fn files(set: &PlatformSet, version: QtiVersion) -> Vec<ArchiveFile> {
    let mut all = vec![ArchiveFile {
        path: "imsmanifest.xml".into(),
        bytes: manifest(set, version).into_bytes(),
    }];
    for task in &set.tasks {
        all.push(ArchiveFile {
            path: format!("images/{}.png", task.name),
            bytes: task.picture.clone(),
        });
        all.extend(task.questions.iter().map(|q| ArchiveFile {
            path: format!("items/{}.xml", q.name),
            bytes: named(&item(set, task, q, version), version).into_bytes(),
        }));
    }
    all
}

fn manifest(set: &PlatformSet, version: QtiVersion) -> String {
    let (space, schema, number, kind) = match version {
        QtiVersion::Two => (
            "http://www.imsglobal.org/xsd/imscp_v1p1",
            "QTIv2.1 Package",
            "1.0.0",
            "imsqti_item_xmlv2p1",
        ),
        QtiVersion::Three => (
            "http://www.imsglobal.org/xsd/qti/qtiv3p0/imscp_v1p1",
            "QTI Package",
            "3.0.0",
            "imsqti_item_xmlv3p0",
        ),
    };
    let mut out = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<manifest xmlns=\"{space}\" identifier=\"hodograph-homework\">\n\
         <metadata><schema>{schema}</schema><schemaversion>{number}</schemaversion></metadata>\n<organizations/>\n<resources>\n"
    );
    for (task, q) in set.tasks.iter().flat_map(|t| t.questions.iter().map(move |q| (t, q))) {
        out += &format!(
            "<resource identifier=\"{0}\" type=\"{kind}\" href=\"items/{0}.xml\"><file href=\"items/{0}.xml\"/><file href=\"images/{1}.png\"/></resource>\n",
            q.name, task.name
        );
    }
    out + "</resources>\n</manifest>\n"
}

/// Returns an item with the names of version 3.
fn item(
    set: &PlatformSet,
    task: &PlatformTask,
    q: &PlatformQuestion,
    version: QtiVersion,
) -> String {
    let (space, schema) = match version {
        QtiVersion::Two => (
            "http://www.imsglobal.org/xsd/imsqti_v2p1",
            "http://www.imsglobal.org/xsd/qti/qtiv2p1/imsqti_v2p1.xsd",
        ),
        QtiVersion::Three => (
            "http://www.imsglobal.org/xsd/imsqtiasi_v3p0",
            "https://purl.imsglobal.org/spec/qti/v3p0/schema/xsd/imsqti_asiv3p0_v1p0.xsd",
        ),
    };
    let mut out = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<qti-assessment-item xmlns=\"{space}\" xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" \
         xsi:schemaLocation=\"{space} {schema}\" identifier=\"{}\" title=\"{} · {}\" xml:lang=\"{}\" adaptive=\"false\" time-dependent=\"false\">\n",
        q.name,
        escaped(&task.title),
        escaped(&q.plain),
        words(set.lang).tag,
    );
    out += &format!(
        "<qti-response-declaration identifier=\"RESPONSE\" cardinality=\"single\" base-type=\"float\">\
         <qti-correct-response><qti-value>{}</qti-value></qti-correct-response></qti-response-declaration>\n\
         <qti-outcome-declaration identifier=\"SCORE\" cardinality=\"single\" base-type=\"float\">\
         <qti-default-value><qti-value>0</qti-value></qti-default-value></qti-outcome-declaration>\n\
         <qti-outcome-declaration identifier=\"MAXSCORE\" cardinality=\"single\" base-type=\"float\">\
         <qti-default-value><qti-value>1</qti-value></qti-default-value></qti-outcome-declaration>\n\
         <qti-outcome-declaration identifier=\"FEEDBACK\" cardinality=\"single\" base-type=\"identifier\"/>\n",
        number(q.key.value)
    );
    out += &format!(
        "<qti-item-body>\n<div>\n{}<p><img src=\"../images/{}.png\" alt=\"{}\"/></p>\n</div>\n\
         <p>{} <qti-text-entry-interaction response-identifier=\"RESPONSE\" expected-length=\"12\"/></p>\n</qti-item-body>\n",
        task.problem,
        task.name,
        escaped(&task.alt),
        q.prompt
    );
    out += "<qti-response-processing>\n<qti-response-condition>\n";
    for (k, j) in q.judgements.iter().enumerate() {
        let tag = if k == 0 { "qti-response-if" } else { "qti-response-else-if" };
        out += &format!("<{tag}>\n{}</{tag}>\n", judged(k, j));
    }
    out += "</qti-response-condition>\n</qti-response-processing>\n";
    for (k, j) in q.judgements.iter().enumerate().filter(|(_, j)| !j.feedback.is_empty()) {
        let words = format!("<p>{}</p>", escaped(&j.feedback));
        let words = match version {
            QtiVersion::Two => words,
            QtiVersion::Three => format!("<qti-content-body>{words}</qti-content-body>"),
        };
        out += &format!(
            "<qti-modal-feedback outcome-identifier=\"FEEDBACK\" identifier=\"F{k}\" show-hide=\"show\">{words}</qti-modal-feedback>\n"
        );
    }
    out + "</qti-assessment-item>\n"
}

/// Returns the condition and the outcome of a judgement.
fn judged(k: usize, j: &Judgement) -> String {
    let [low, high] = j.ends().map(number);
    let response = "<qti-variable identifier=\"RESPONSE\"/>";
    let value = |kind: &str, text: &str| {
        format!("<qti-base-value base-type=\"{kind}\">{text}</qti-base-value>")
    };
    let mut out = format!(
        "<qti-and><qti-not><qti-is-null>{response}</qti-is-null></qti-not>\
         <qti-gte>{response}{}</qti-gte><qti-lte>{response}{}</qti-lte></qti-and>\n\
         <qti-set-outcome-value identifier=\"SCORE\">{}</qti-set-outcome-value>\n",
        value("float", &low),
        value("float", &high),
        value("float", &number(j.credit))
    );
    if !j.feedback.is_empty() {
        out += &format!(
            "<qti-set-outcome-value identifier=\"FEEDBACK\">{}</qti-set-outcome-value>\n",
            value("identifier", &format!("F{k}"))
        );
    }
    out
}

/// Attributes of version 3 whose name has a hyphen.
const ATTRIBUTES: [&str; 6] = [
    " time-dependent=\"",
    " base-type=\"",
    " response-identifier=\"",
    " expected-length=\"",
    " outcome-identifier=\"",
    " show-hide=\"",
];

/// Returns an item with the names of its version: of version 2 in camel case, without `qti-`.
fn named(item: &str, version: QtiVersion) -> String {
    if version == QtiVersion::Three {
        return item.to_owned();
    }
    // Inside a tag only: words of the problem stay as they are, and `<` in them is escaped.
    let mut out = String::with_capacity(item.len());
    for (k, part) in item.split('<').enumerate() {
        out += if k == 0 { "" } else { "<" };
        let slash = if part.starts_with('/') { "/" } else { "" };
        match part[slash.len()..].strip_prefix("qti-") {
            None => out += part,
            Some(rest) => {
                let end = rest.find([' ', '>', '/']).unwrap_or(rest.len());
                let close = rest.find('>').unwrap_or(rest.len());
                let attributes = ATTRIBUTES
                    .iter()
                    .fold(rest[end..close].to_owned(), |text, a| text.replace(a, &camel(a)));
                out += &format!("{slash}{}{attributes}{}", camel(&rest[..end]), &rest[close..]);
            }
        }
    }
    out
}

fn camel(name: &str) -> String {
    let mut raise = false;
    let letter = |c: char| {
        let own = std::mem::replace(&mut raise, c == '-');
        match (c, own) {
            ('-', _) => None,
            (c, true) => Some(c.to_ascii_uppercase()),
            (c, false) => Some(c),
        }
    };
    name.chars().filter_map(letter).collect()
}
