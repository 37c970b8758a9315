//! PrairieLearn: one question of all variants, from which each student gets one by the seed of
//! PrairieLearn.
//!
//! The folder holds `info.json`, `question.html`, `server.py` and the variants as `variants.json`;
//! pictures are in `clientFilesQuestion`. Numbers are checked by `server.py` with the absolute
//! tolerance of the key, in the order of the judgements.

use super::{PlatformQuestion, PlatformSet};
use crate::render::escaped;
use crate::zip::ArchiveFile;
use serde_json::{Value as Json, json};

/// The folder of the question.
const FOLDER: &str = "prairielearn/questions/homework";

/// Draws a variant, and marks the numbers.
const SERVER: &str = r#"import json
import os
import random


def generate(data):
    path = os.path.join(data["options"]["question_path"], "variants.json")
    with open(path, encoding="utf-8") as file:
        variant = random.choice(json.load(file))
    data["params"].update(variant)
    for question in variant["questions"]:
        data["correct_answers"][question["name"]] = question["value"]
        data["params"]["within_" + question["name"]] = question["judgements"][0]["within"]


def grade(data):
    """Give the credit and the feedback of the first judgement that holds."""
    scores = []
    for question in data["params"]["questions"]:
        name, score, said = question["name"], 0.0, ""
        submitted = data["submitted_answers"].get(name)
        if isinstance(submitted, (int, float)):
            for judgement in question["judgements"]:
                if abs(submitted - judgement["value"]) <= judgement["within"]:
                    score, said = judgement["credit"], judgement["feedback"]
                    break
        scores.append(score)
        data["partial_scores"][name] = {"score": score, "weight": 1}
        data["feedback"][name] = said
    data["score"] = sum(scores) / max(len(scores), 1)
"#;

/// Returns the files of the question.
pub fn prairielearn(set: &PlatformSet) -> Vec<ArchiveFile> {
    let file = |name: &str, bytes: Vec<u8>| ArchiveFile { path: format!("{FOLDER}/{name}"), bytes };
    let variants: Vec<Json> = set
        .tasks
        .iter()
        .map(|task| {
            json!({
                "variant": task.name,
                "title": task.title,
                "problem": task.problem,
                "picture": format!("{}.png", task.name),
                "questions": task.questions.iter().map(|q| asked(q, &task.name)).collect::<Vec<_>>(),
            })
        })
        .collect();
    let variants = format!("{:#}\n", Json::from(variants));
    let info = json!({
        "uuid": uuid(variants.as_bytes()),
        "title": set.title,
        "topic": "Kinematics",
        "tags": ["hodograph"],
        "type": "v3",
    });
    let mut all = vec![
        file("info.json", format!("{info:#}\n").into_bytes()),
        file("question.html", page(set).into_bytes()),
        file("server.py", SERVER.as_bytes().to_vec()),
        file("variants.json", variants.into_bytes()),
    ];
    let pictures = set
        .tasks
        .iter()
        .map(|task| file(&format!("clientFilesQuestion/{}.png", task.name), task.picture.clone()));
    all.extend(pictures);
    all
}

/// Returns the name of a question in all variants: without that of the variant.
fn common<'a>(q: &'a PlatformQuestion, task: &str) -> &'a str {
    q.name.strip_prefix(task).and_then(|n| n.strip_prefix('-')).unwrap_or(&q.name)
}

fn asked(q: &PlatformQuestion, task: &str) -> Json {
    let judgement = |j: &super::Judgement| {
        json!({
            "value": j.value,
            "within": j.within,
            "credit": j.credit,
            "feedback": j.feedback,
        })
    };
    json!({
        "name": common(q, task),
        "prompt": q.prompt,
        "value": q.key.value,
        "judgements": q.judgements.iter().map(judgement).collect::<Vec<_>>(),
    })
}

/// Returns the page of the question; its parts for each number have the same names in all variants.
fn page(set: &PlatformSet) -> String {
    let mut out = "<pl-question-panel>\n{{{params.problem}}}\n\
        <p><pl-figure file-name=\"{{params.picture}}\"></pl-figure></p>\n</pl-question-panel>\n"
        .to_owned();
    let Some(task) = set.tasks.first() else { return out };
    for q in &task.questions {
        let name = escaped(common(q, &task.name));
        out += &format!(
            "<pl-question-panel>\n<p>{}</p>\n</pl-question-panel>\n\
             <pl-number-input answers-name=\"{name}\" comparison=\"relabs\" rtol=\"0\" atol=\"{{{{params.within_{name}}}}}\"></pl-number-input>\n\
             <pl-submission-panel>\n<p>{{{{feedback.{name}}}}}</p>\n</pl-submission-panel>\n",
            q.prompt
        );
    }
    out
}

/// Returns an identifier of version 8 (RFC 9562) made from the contents.
fn uuid(bytes: &[u8]) -> String {
    let part = |k: u8| {
        let mut hash = crc32fast::Hasher::new();
        hash.update(&[k]);
        hash.update(bytes);
        hash.finalize()
    };
    let [a, b, c, d] = [0, 1, 2, 3].map(part);
    let (b, c) = (b & 0xffff_0fff | 0x8000, c & 0x3fff_ffff | 0x8000_0000);
    format!("{a:08x}-{:04x}-{:04x}-{:04x}-{:04x}{d:08x}", b >> 16, b & 0xffff, c >> 16, c & 0xffff)
}
