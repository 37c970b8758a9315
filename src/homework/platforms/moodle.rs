//! Moodle XML: numerical questions with the picture inside, a category for each variant.
//!
//! Moodle takes the first answer whose interval holds the response; a tolerance is absolute. Text
//! in the category has `/` doubled, because a single one begins a subcategory.

use super::{PlatformSet, PlatformTask};
use crate::diag::{Diagnostic, both};
use crate::homework::keys::number;
use crate::render::escaped;
use base64::prelude::{BASE64_STANDARD, Engine};

/// Largest size of all pictures (bytes): each question contains its own, and platforms refuse larger
/// files.
const MOST_PICTURES: usize = 64 << 20;
/// Bytes of a question without its picture, roughly.
const QUESTION: usize = 8 << 10;

/// Writes the questions as Moodle XML.
///
/// # Errors
/// `too-many` for more pictures than a file may hold.
pub fn moodle(set: &PlatformSet) -> Result<String, Diagnostic> {
    let count: usize = set.tasks.iter().map(|t| t.questions.len()).sum();
    let pictures: usize = set.tasks.iter().map(|t| t.questions.len() * t.picture.len()).sum();
    if pictures > MOST_PICTURES {
        let most = MOST_PICTURES >> 20;
        let message = both!(
            "the pictures of {count} questions take more than {most} MiB in one file for Moodle"
        );
        return Err(Diagnostic::error("too-many", message)
            .help(both!("ask for fewer variants, or for less in \"find\"")));
    }
    let mut out = String::with_capacity(pictures.div_ceil(3) * 4 + count * QUESTION);
    out += "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<quiz>\n";
    for task in &set.tasks {
        out += &category(set, task);
        for q in &task.questions {
            let text = format!(
                "{}<p><img src=\"@@PLUGINFILE@@/{}.png\" alt=\"{}\"/></p>\n<p>{}</p>",
                task.problem,
                task.name,
                escaped(&task.alt),
                q.prompt
            );
            out += &format!(
                "<question type=\"numerical\">\n<name><text>{} · {}</text></name>\n<questiontext format=\"html\"><text>{}</text>\n\
                 <file name=\"{}.png\" path=\"/\" encoding=\"base64\">{}</file></questiontext>\n\
                 <generalfeedback format=\"html\"><text></text></generalfeedback>\n\
                 <defaultgrade>1.0</defaultgrade>\n<penalty>0.3333333</penalty>\n<hidden>0</hidden>\n<idnumber>{}</idnumber>\n",
                escaped(&task.title),
                escaped(&q.plain),
                escaped(&text),
                task.name,
                BASE64_STANDARD.encode(&task.picture),
                escaped(&q.name),
            );
            for j in &q.judgements {
                out += &format!(
                    "<answer fraction=\"{}\" format=\"moodle_auto_format\">\n<text>{}</text>\n\
                     <feedback format=\"html\"><text>{}</text></feedback>\n<tolerance>{}</tolerance>\n</answer>\n",
                    number(100.0 * j.credit),
                    number(j.value),
                    escaped(&escaped(&j.feedback)),
                    number(j.within),
                );
            }
            out += "<unitgradingtype>0</unitgradingtype>\n<unitpenalty>0.1</unitpenalty>\n<showunits>3</showunits>\n<unitsleft>0</unitsleft>\n</question>\n";
        }
    }
    out += "</quiz>\n";
    Ok(out)
}

fn category(set: &PlatformSet, task: &PlatformTask) -> String {
    let part = |text: &str| escaped(&text.replace('/', "//"));
    format!(
        "<question type=\"category\">\n<category><text>$course$/top/{}/{}</text></category>\n\
         <info format=\"html\"><text></text></info>\n<idnumber></idnumber>\n</question>\n",
        part(&set.title),
        part(&task.name),
    )
}
