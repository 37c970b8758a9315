//! Moodle XML: numerical questions with the picture inside, a category for each variant.
//!
//! Moodle takes the first answer whose interval holds the response; a tolerance is absolute. Text
//! in the category has `/` doubled, because a single one begins a subcategory.

use super::{PlatformSet, PlatformTask};
use crate::homework::keys::number;
use crate::render::escaped;
use base64::prelude::{BASE64_STANDARD, Engine};

/// Writes the questions as Moodle XML.
pub fn moodle(set: &PlatformSet) -> String {
    let mut out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<quiz>\n".to_owned();
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
    out + "</quiz>\n"
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
