//! The steps of a construction as slides for PowerPoint: one for each step, 16:9, the drawing as SVG
//! with a PNG for programs that do not show SVG, and the sentence beside it as text that can be
//! edited.
//!
//! # Source
//! ECMA-376, *Office Open XML File Formats*: presentations (part 1, 19) and packages (part 2); the
//! extension of pictures by SVG is that of [MS-ODRAWXML].

use crate::diag::{Diagnostic, Faults, Warned, both};
use crate::figure::fit;
use crate::figure::list::FigureInput;
use crate::geom::Vec2;
use crate::paper::extent::{Rect, bounds, translate};
use crate::paper::font::Slant;
use crate::paper::item::{Figure, FigureItem, Shape};
use crate::paper::label::{LabelNode, Role};
use crate::render::{escaped, png, svg};
use crate::scene::PageFormat;
use crate::zip::{ArchiveFile, zip};

mod parts;

/// Units of the format in a millimetre.
const EMU_PER_MM: f64 = 36000.0;
/// Place of the pictures on a slide (mm, from the upper left corner): left, top, width, height.
const PICTURE_MM: [f64; 4] = [12.0, 30.0, 222.0, 152.0];
/// Resolution of the pictures for programs that do not show SVG (dots per inch).
const DPI: f64 = 150.0;
/// Space around the ink of a picture (mm).
const AIR_MM: f64 = 2.0;
/// The space for drawings and sentence, and their type.
const FORMAT: PageFormat = PageFormat {
    width_mm: PICTURE_MM[2],
    height_mm: 170.0,
    whole: true,
    type_pt: Some(14.0),
    border_mm: 2.0,
};
/// Greatest factor by which small drawings are enlarged.
const LARGEST: f64 = 1.6;

/// Returns the presentation.
///
/// # Errors
/// `no-figure` if the scene's questions call for no step; `paper-too-small` if the drawings are too
/// large for a slide; the errors of the pictures.
pub fn pptx(w: &FigureInput) -> Result<Warned<Vec<u8>>, Faults> {
    let mut steps: Vec<SlideStep> = Vec::new();
    for (_, figure) in fit::steps(w, Some(&FORMAT))? {
        steps.push(SlideStep::of(figure));
    }
    let ink = steps.iter().filter_map(|s| bounds(&s.figure.items)).reduce(Rect::union);
    let Some(ink) = ink else {
        let message = both!("there is nothing to draw");
        let help = both!("ask for velocities or accelerations in \"find\"");
        return Err(Diagnostic::error("no-figure", message).help(help).into());
    };
    // All pictures have one size, so that slides do not jump.
    let ink = ink.grown(AIR_MM);
    let [left, top, width, height] = PICTURE_MM;
    let scale = (width / ink.width_mm()).min(height / ink.height_mm()).min(LARGEST);
    let size = [ink.width_mm() * scale, ink.height_mm() * scale];
    let place = [left + (width - size[0]) / 2.0, top + (height - size[1]) / 2.0, size[0], size[1]];
    let (mut files, mut notes) = (parts::frame(steps.len(), &w.options.style), Vec::new());
    for (k, step) in (1..).zip(&mut steps) {
        translate(&mut step.figure.items, Vec2::new(-ink.min.x, -ink.min.y));
        (step.figure.width_mm, step.figure.height_mm) = (ink.width_mm(), ink.height_mm());
        let Warned { value: markup, notes: more } = svg::write(&step.figure)?;
        notes.extend(more.into_iter().filter(|n| !notes.contains(n)).collect::<Vec<_>>());
        let picture = png::render(&markup, DPI)?;
        files.push(file(&format!("ppt/media/step{k}.png"), picture));
        files.push(file(&format!("ppt/media/step{k}.svg"), markup.into_bytes()));
        files.push(file(&format!("ppt/slides/slide{k}.xml"), step.slide(place).into_bytes()));
        files.push(file(
            &format!("ppt/slides/_rels/slide{k}.xml.rels"),
            parts::slide_relations(k).into_bytes(),
        ));
    }
    Ok(Warned { value: zip(&files), notes })
}

fn file(path: &str, bytes: Vec<u8>) -> ArchiveFile {
    ArchiveFile { path: path.to_owned(), bytes }
}

/// A step: its drawing without its sentence, and the sentence.
struct SlideStep {
    figure: Figure,
    title: String,
    sentence: Vec<LabelNode>,
    said: String,
    lang: &'static str,
}

impl SlideStep {
    fn of(mut figure: Figure) -> SlideStep {
        let mut sentence: Vec<LabelNode> = Vec::new();
        let is_sentence = |item: &FigureItem| item.class == "sentence";
        for item in figure.items.iter().filter(|item| is_sentence(item)) {
            if let Shape::Label { label, .. } = &item.shape {
                // Chinese lines join without a space.
                let chinese = figure.lang.starts_with("zh");
                if let Some(last) = sentence.last().filter(|_| !chinese) {
                    let space = LabelNode {
                        text: " ".into(),
                        sub: Vec::new(),
                        sup: Vec::new(),
                        primes: 0,
                        slant: Slant::Upright,
                        ..last.clone()
                    };
                    sentence.push(space);
                }
                sentence.extend(label.row().iter().cloned());
            }
        }
        figure.items.retain(|item| !is_sentence(item));
        let (title, said) = (figure.title.clone(), figure.desc.clone());
        let lang = if figure.lang.starts_with("zh") { "zh-CN" } else { "en-GB" };
        SlideStep { figure, title, sentence, said, lang }
    }

    /// The slide; `place` is that of the picture (mm).
    fn slide(&self, place: [f64; 4]) -> String {
        let mut runs = String::new();
        row(&self.sentence, None, self.lang, &mut runs);
        let [x, y, width, height] = place.map(emu);
        let (title, said) = (escaped(&self.title), escaped(&self.said));
        format!(
            "{}<p:sld {}><p:cSld><p:spTree>{}\
             <p:sp><p:nvSpPr><p:cNvPr id=\"2\" name=\"Title\"/><p:cNvSpPr><a:spLocks noGrp=\"1\"/></p:cNvSpPr><p:nvPr><p:ph type=\"title\"/></p:nvPr></p:nvSpPr><p:spPr/>\
             <p:txBody><a:bodyPr/><a:lstStyle/><a:p><a:r><a:rPr lang=\"{lang}\"/><a:t>{title}</a:t></a:r></a:p></p:txBody></p:sp>\
             <p:sp><p:nvSpPr><p:cNvPr id=\"3\" name=\"Sentence\"/><p:cNvSpPr><a:spLocks noGrp=\"1\"/></p:cNvSpPr><p:nvPr><p:ph type=\"body\" idx=\"1\"/></p:nvPr></p:nvSpPr><p:spPr/>\
             <p:txBody><a:bodyPr/><a:lstStyle/><a:p>{runs}</a:p></p:txBody></p:sp>\
             <p:pic><p:nvPicPr><p:cNvPr id=\"4\" name=\"Drawing\" descr=\"{said}\"/><p:cNvPicPr><a:picLocks noChangeAspect=\"1\"/></p:cNvPicPr><p:nvPr/></p:nvPicPr>\
             <p:blipFill><a:blip r:embed=\"rId2\"><a:extLst><a:ext uri=\"{{96DAC541-7B7A-43D3-8B79-37D633B846F1}}\"><asvg:svgBlip xmlns:asvg=\"http://schemas.microsoft.com/office/drawing/2016/SVG/main\" r:embed=\"rId3\"/></a:ext></a:extLst></a:blip><a:stretch><a:fillRect/></a:stretch></p:blipFill>\
             <p:spPr><a:xfrm><a:off x=\"{x}\" y=\"{y}\"/><a:ext cx=\"{width}\" cy=\"{height}\"/></a:xfrm><a:prstGeom prst=\"rect\"><a:avLst/></a:prstGeom></p:spPr></p:pic>\
             </p:spTree></p:cSld><p:clrMapOvr><a:masterClrMapping/></p:clrMapOvr></p:sld>",
            parts::HEAD,
            parts::SPACES,
            parts::GROUP,
            lang = self.lang,
        )
    }
}

/// Millimetres in units of the format.
fn emu(mm: f64) -> String {
    format!("{:.0}", mm * EMU_PER_MM)
}

/// Writes the atoms of a formula as runs of text: letters of quantities in italics, scripts raised
/// and lowered by percents of the type.
fn row(nodes: &[LabelNode], raised: Option<i32>, lang: &str, out: &mut String) {
    for node in nodes {
        let spaced = matches!(node.role, Role::Relation | Role::Binary);
        let mut text = node.text.clone() + &"′".repeat(node.primes);
        if spaced {
            text = format!("\u{2009}{text}\u{2009}");
        }
        if node.space_em > 0.0 {
            text.push('\u{2009}');
        }
        if !text.is_empty() {
            let italic = if node.slant == Slant::Italic { " i=\"1\"" } else { "" };
            let raised = raised.map(|p| format!(" baseline=\"{p}\"")).unwrap_or_default();
            *out += &format!(
                "<a:r><a:rPr lang=\"{lang}\"{italic}{raised}/><a:t>{}</a:t></a:r>",
                escaped(&text)
            );
        }
        for (script, percent) in [(&node.sub, -25000), (&node.sup, 30000)] {
            row(script, Some(percent), lang, out);
        }
    }
}
