//! The parts of a presentation that all have alike: types, relations, master, layout, theme.

use super::{emu, file};
use crate::paper::style::Style;
use crate::zip::ArchiveFile;
use std::fmt::Write as _;

/// The first line of every part.
pub(super) const HEAD: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\"?>\n";
/// The namespaces of slides, layouts and masters.
pub(super) const SPACES: &str = "xmlns:a=\"http://schemas.openxmlformats.org/drawingml/2006/main\" xmlns:r=\"http://schemas.openxmlformats.org/officeDocument/2006/relationships\" xmlns:p=\"http://schemas.openxmlformats.org/presentationml/2006/main\"";
/// The group of all shapes of a slide.
pub(super) const GROUP: &str = "<p:nvGrpSpPr><p:cNvPr id=\"1\" name=\"\"/><p:cNvGrpSpPr/><p:nvPr/></p:nvGrpSpPr><p:grpSpPr><a:xfrm><a:off x=\"0\" y=\"0\"/><a:ext cx=\"0\" cy=\"0\"/><a:chOff x=\"0\" y=\"0\"/><a:chExt cx=\"0\" cy=\"0\"/></a:xfrm></p:grpSpPr>";

const RELATION: &str = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
/// Width and height of a slide (mm): 13 1/3 in by 7 1/2 in.
const SLIDE_MM: [f64; 2] = [338.0 + 2.0 / 3.0, 190.5];
/// Places of title and text (mm): left, top, width, height.
const TITLE_MM: [f64; 4] = [12.0, 8.0, 314.0, 18.0];
const TEXT_MM: [f64; 4] = [240.0, 30.0, 88.0, 152.0];

/// Returns the parts around a number of slides.
pub(super) fn frame(slides: usize, style: &Style) -> Vec<ArchiveFile> {
    let text = |path: &str, text: String| file(path, text.into_bytes());
    // PowerPoint wants the types first.
    vec![
        text("[Content_Types].xml", types(slides)),
        text("_rels/.rels", relations(&[("officeDocument", "ppt/presentation.xml".to_owned())])),
        text("ppt/presentation.xml", presentation(slides)),
        text("ppt/_rels/presentation.xml.rels", presentation_relations(slides)),
        text("ppt/slideMasters/slideMaster1.xml", master()),
        text(
            "ppt/slideMasters/_rels/slideMaster1.xml.rels",
            relations(&[
                ("slideLayout", "../slideLayouts/slideLayout1.xml".to_owned()),
                ("theme", "../theme/theme1.xml".to_owned()),
            ]),
        ),
        text("ppt/slideLayouts/slideLayout1.xml", layout()),
        text(
            "ppt/slideLayouts/_rels/slideLayout1.xml.rels",
            relations(&[("slideMaster", "../slideMasters/slideMaster1.xml".to_owned())]),
        ),
        text("ppt/theme/theme1.xml", theme(style)),
    ]
}

/// Returns the relations of the k-th slide.
pub(super) fn slide_relations(k: usize) -> String {
    relations(&[
        ("slideLayout", "../slideLayouts/slideLayout1.xml".to_owned()),
        ("image", format!("../media/step{k}.png")),
        ("image", format!("../media/step{k}.svg")),
    ])
}

fn relations(all: &[(&str, String)]) -> String {
    let mut out = format!(
        "{HEAD}<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">"
    );
    for (k, (kind, target)) in (1..).zip(all) {
        let _ = write!(
            out,
            "<Relationship Id=\"rId{k}\" Type=\"{RELATION}/{kind}\" Target=\"{target}\"/>"
        );
    }
    out + "</Relationships>"
}

fn types(slides: usize) -> String {
    let mut out = format!(
        "{HEAD}<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\
         <Default Extension=\"rels\" ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\
         <Default Extension=\"xml\" ContentType=\"application/xml\"/>\
         <Default Extension=\"png\" ContentType=\"image/png\"/>\
         <Default Extension=\"svg\" ContentType=\"image/svg+xml\"/>"
    );
    let of = "application/vnd.openxmlformats-officedocument";
    let mut part = |path: String, kind: &str| {
        let _ = write!(out, "<Override PartName=\"/ppt/{path}\" ContentType=\"{of}.{kind}+xml\"/>");
    };
    part("presentation.xml".into(), "presentationml.presentation.main");
    part("slideMasters/slideMaster1.xml".into(), "presentationml.slideMaster");
    part("slideLayouts/slideLayout1.xml".into(), "presentationml.slideLayout");
    part("theme/theme1.xml".into(), "theme");
    (1..=slides).for_each(|k| part(format!("slides/slide{k}.xml"), "presentationml.slide"));
    out + "</Types>"
}

fn presentation(slides: usize) -> String {
    let list: String = (1..=slides)
        .map(|k| format!("<p:sldId id=\"{}\" r:id=\"rId{}\"/>", 255 + k, k + 2))
        .collect();
    let [wide, high] = SLIDE_MM.map(emu);
    format!(
        "{HEAD}<p:presentation {SPACES}><p:sldMasterIdLst><p:sldMasterId id=\"2147483648\" r:id=\"rId1\"/></p:sldMasterIdLst>\
         <p:sldIdLst>{list}</p:sldIdLst><p:sldSz cx=\"{wide}\" cy=\"{high}\"/><p:notesSz cx=\"{high}\" cy=\"{wide}\"/></p:presentation>"
    )
}

fn presentation_relations(slides: usize) -> String {
    let mut all = vec![
        ("slideMaster", "slideMasters/slideMaster1.xml".to_owned()),
        ("theme", "theme/theme1.xml".to_owned()),
    ];
    all.extend((1..=slides).map(|k| ("slide", format!("slides/slide{k}.xml"))));
    relations(&all)
}

/// Title and text with their places.
fn holders() -> String {
    let holder = |id: usize, name: &str, kind: &str, place: [f64; 4], anchor: &str| {
        let [x, y, width, height] = place.map(emu);
        format!(
            "<p:sp><p:nvSpPr><p:cNvPr id=\"{id}\" name=\"{name}\"/><p:cNvSpPr><a:spLocks noGrp=\"1\"/></p:cNvSpPr><p:nvPr><p:ph {kind}/></p:nvPr></p:nvSpPr>\
             <p:spPr><a:xfrm><a:off x=\"{x}\" y=\"{y}\"/><a:ext cx=\"{width}\" cy=\"{height}\"/></a:xfrm><a:prstGeom prst=\"rect\"><a:avLst/></a:prstGeom></p:spPr>\
             <p:txBody><a:bodyPr anchor=\"{anchor}\"><a:normAutofit/></a:bodyPr><a:lstStyle/><a:p><a:r><a:rPr lang=\"en-GB\"/><a:t>{name}</a:t></a:r></a:p></p:txBody></p:sp>"
        )
    };
    holder(2, "Title", "type=\"title\"", TITLE_MM, "ctr")
        + &holder(3, "Sentence", "type=\"body\" idx=\"1\"", TEXT_MM, "ctr")
}

fn master() -> String {
    let colour = "<a:solidFill><a:schemeClr val=\"tx1\"/></a:solidFill>";
    let level = |size: usize, font: &str| {
        format!(
            "<a:lvl1pPr marL=\"0\" indent=\"0\" algn=\"l\"><a:lnSpc><a:spcPct val=\"110000\"/></a:lnSpc><a:buNone/><a:defRPr sz=\"{size}\" kern=\"1200\">{colour}<a:latin typeface=\"+{font}-lt\"/><a:ea typeface=\"+{font}-ea\"/><a:cs typeface=\"+{font}-cs\"/></a:defRPr></a:lvl1pPr>"
        )
    };
    format!(
        "{HEAD}<p:sldMaster {SPACES}><p:cSld><p:bg><p:bgRef idx=\"1001\"><a:schemeClr val=\"bg1\"/></p:bgRef></p:bg><p:spTree>{GROUP}{}</p:spTree></p:cSld>\
         <p:clrMap bg1=\"lt1\" tx1=\"dk1\" bg2=\"lt2\" tx2=\"dk2\" accent1=\"accent1\" accent2=\"accent2\" accent3=\"accent3\" accent4=\"accent4\" accent5=\"accent5\" accent6=\"accent6\" hlink=\"hlink\" folHlink=\"folHlink\"/>\
         <p:sldLayoutIdLst><p:sldLayoutId id=\"2147483649\" r:id=\"rId1\"/></p:sldLayoutIdLst>\
         <p:txStyles><p:titleStyle>{}</p:titleStyle><p:bodyStyle>{}</p:bodyStyle><p:otherStyle>{}</p:otherStyle></p:txStyles></p:sldMaster>",
        holders(),
        level(2400, "mj"),
        level(2000, "mn"),
        level(1800, "mn"),
    )
}

fn layout() -> String {
    format!(
        "{HEAD}<p:sldLayout {SPACES} preserve=\"1\" userDrawn=\"1\"><p:cSld name=\"Step\"><p:spTree>{GROUP}{}</p:spTree></p:cSld><p:clrMapOvr><a:masterClrMapping/></p:clrMapOvr></p:sldLayout>",
        holders()
    )
}

/// The theme: black on the paper of the style, Times as in the figures.
fn theme(style: &Style) -> String {
    let ground = style.palette.paper;
    let paper = format!("{:02X}{:02X}{:02X}", ground.r, ground.g, ground.b);
    let dark = u32::from(ground.r) + u32::from(ground.g) + u32::from(ground.b) < 384;
    let ink = if dark { "FFFFFF" } else { "000000" };
    let colours: String = [
        ("dk1", ink),
        ("lt1", &paper),
        ("dk2", ink),
        ("lt2", &paper),
        ("accent1", "1F4E79"),
        ("accent2", "C00000"),
        ("accent3", "548235"),
        ("accent4", "7F6000"),
        ("accent5", "7030A0"),
        ("accent6", "7F7F7F"),
        ("hlink", "0563C1"),
        ("folHlink", "954F72"),
    ]
    .iter()
    .map(|(name, rgb)| format!("<a:{name}><a:srgbClr val=\"{rgb}\"/></a:{name}>"))
    .collect();
    let font = |kind: &str| {
        format!(
            "<a:{kind}Font><a:latin typeface=\"Times New Roman\"/><a:ea typeface=\"SimSun\"/><a:cs typeface=\"\"/></a:{kind}Font>"
        )
    };
    let fill = "<a:solidFill><a:schemeClr val=\"phClr\"/></a:solidFill>";
    let line = |width: usize| format!("<a:ln w=\"{width}\">{fill}</a:ln>");
    let effect = "<a:effectStyle><a:effectLst/></a:effectStyle>";
    format!(
        "{HEAD}<a:theme xmlns:a=\"http://schemas.openxmlformats.org/drawingml/2006/main\" name=\"hodograph\"><a:themeElements>\
         <a:clrScheme name=\"hodograph\">{colours}</a:clrScheme>\
         <a:fontScheme name=\"hodograph\">{}{}</a:fontScheme>\
         <a:fmtScheme name=\"hodograph\"><a:fillStyleLst>{}</a:fillStyleLst><a:lnStyleLst>{}{}{}</a:lnStyleLst>\
         <a:effectStyleLst>{}</a:effectStyleLst><a:bgFillStyleLst>{}</a:bgFillStyleLst></a:fmtScheme></a:themeElements></a:theme>",
        font("major"),
        font("minor"),
        fill.repeat(3),
        line(6350),
        line(12700),
        line(19050),
        effect.repeat(3),
        fill.repeat(3),
    )
}
