//! Canvas: a package of QTI 1.2 with numerical questions, one quiz for each variant.
//!
//! Canvas imports an exact value or a range as the right answer, and shows one comment for all wrong
//! answers. It lists the typical mistakes without their values, which would bound the right one.

use super::{Judgement, PlatformQuestion, PlatformSet, PlatformTask};
use crate::homework::keys::number;
use crate::render::escaped;
use crate::zip::{ArchiveFile, zip};

/// Writes the questions as a package (ZIP).
pub fn canvas(set: &PlatformSet) -> Vec<u8> {
    let mut all =
        vec![ArchiveFile { path: "imsmanifest.xml".into(), bytes: manifest(set).into_bytes() }];
    for task in &set.tasks {
        let assessment = assessment(task).into_bytes();
        all.push(ArchiveFile { path: format!("{0}/{0}.xml", task.name), bytes: assessment });
        all.push(ArchiveFile {
            path: format!("images/{}.png", task.name),
            bytes: task.picture.clone(),
        });
    }
    zip(&all)
}

fn manifest(set: &PlatformSet) -> String {
    let mut out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
        <manifest identifier=\"hodograph-homework\" xmlns=\"http://www.imsglobal.org/xsd/imsccv1p1/imscp_v1p1\">\n\
        <metadata><schema>IMS Content</schema><schemaversion>1.1.3</schemaversion></metadata>\n<organizations/>\n<resources>\n"
        .to_owned();
    for task in &set.tasks {
        out += &format!(
            "<resource identifier=\"{0}\" type=\"imsqti_xmlv1p2\"><file href=\"{0}/{0}.xml\"/></resource>\n\
             <resource identifier=\"{0}-picture\" type=\"webcontent\" href=\"images/{0}.png\"><file href=\"images/{0}.png\"/></resource>\n",
            task.name
        );
    }
    out + "</resources>\n</manifest>\n"
}

fn assessment(task: &PlatformTask) -> String {
    let items: Vec<String> = task.questions.iter().map(|q| item(task, q)).collect();
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<questestinterop xmlns=\"http://www.imsglobal.org/xsd/ims_qtiasiv1p2\">\n\
         <assessment ident=\"{}\" title=\"{}\">\n<section ident=\"root_section\">\n{}</section>\n</assessment>\n</questestinterop>\n",
        task.name,
        escaped(&task.title),
        items.concat()
    )
}

fn item(task: &PlatformTask, q: &PlatformQuestion) -> String {
    let text = format!(
        "{}<p><img src=\"%24IMS-CC-FILEBASE%24/images/{}.png\" alt=\"{}\"/></p>\n<p>{}</p>",
        task.problem,
        task.name,
        escaped(&task.alt),
        q.prompt
    );
    let field = |name: &str, value: &str| {
        format!(
            "<qtimetadatafield><fieldlabel>{name}</fieldlabel><fieldentry>{value}</fieldentry></qtimetadatafield>"
        )
    };
    let mut out = format!(
        "<item ident=\"{}\" title=\"{}\">\n<itemmetadata><qtimetadata>{}{}</qtimetadata></itemmetadata>\n\
         <presentation><material><mattext texttype=\"text/html\">{}</mattext></material>\n\
         <response_str ident=\"response1\" rcardinality=\"Single\"><render_fib fibtype=\"Decimal\"><response_label ident=\"answer1\"/></render_fib></response_str></presentation>\n\
         <resprocessing>\n<outcomes><decvar maxvalue=\"100\" minvalue=\"0\" varname=\"SCORE\" vartype=\"Decimal\"/></outcomes>\n",
        q.name,
        escaped(&q.plain),
        field("question_type", "numerical_question"),
        field("points_possible", "1.0"),
        escaped(&text),
    );
    out += &q.judgements.iter().take(1).map(right).collect::<String>();
    out += "<respcondition continue=\"Yes\"><conditionvar><other/></conditionvar><displayfeedback feedbacktype=\"Response\" linkrefid=\"general_incorrect_fb\"/></respcondition>\n</resprocessing>\n";
    let mut likely: Vec<&str> = q
        .judgements
        .iter()
        .filter(|j| j.credit == 0.0 && !j.feedback.is_empty())
        .map(|j| j.feedback.as_str())
        .collect();
    likely.dedup();
    let likely: String = likely.iter().map(|f| format!("<li>{}</li>", escaped(f))).collect();
    let comment = escaped(&format!("<ul>{likely}</ul>"));
    out += &format!(
        "<itemfeedback ident=\"general_incorrect_fb\"><flow_mat><material><mattext texttype=\"text/html\">{comment}</mattext></material></flow_mat></itemfeedback>\n"
    );
    out + "</item>\n"
}

/// Returns the condition of the right answer: the value, or its interval.
fn right(j: &Judgement) -> String {
    let [low, high] = j.ends().map(number);
    format!(
        "<respcondition continue=\"No\"><conditionvar><or><varequal respident=\"response1\">{}</varequal>\
         <and><vargte respident=\"response1\">{low}</vargte><varlte respident=\"response1\">{high}</varlte></and></or></conditionvar>\
         <setvar action=\"Set\" varname=\"SCORE\">100</setvar></respcondition>\n",
        number(j.value)
    )
}
