//! The PDF compared with two independent results: an independent PDF reader draws its pages with
//! resvg's rasteriser, and they look like the SVG; the characters that it finds are those of the
//! labels, in order.

use hayro_interpret::font::Glyph;
use hayro_interpret::hayro_cmap::BfString;
use hayro_interpret::hayro_syntax::Pdf;
use hayro_interpret::{
    BlendMode, ClipPath, Context, Device, GlyphDrawMode, Image, InterpreterCache,
    InterpreterSettings, Paint, PathDrawMode, SoftMask, StrokeProps, TransformExt, interpret_page,
};
use hodograph::paper::item::{Figure, FigureItem, Shape};
use hodograph::paper::text;
use hodograph::paper::words::words;
use hodograph::render::{pdf, png as raster, svg};
use hodograph::scene::{self, Lang, templates};
use hodograph::worked::{Scope, work};
use hodograph::worksheet::{self, DocumentBlock, DocumentTable, TableKind};
use kurbo::{Affine, BezPath, Cap, Join, PathEl, Rect};
use resvg::tiny_skia;

/// A page as it was read.
pub struct Read {
    /// Its pixels.
    pub pixels: tiny_skia::Pixmap,
    /// Its characters, in the order of drawing.
    pub text: String,
}

/// Reads all pages and draws them at `dpi`.
pub fn read(file: &[u8], dpi: f64) -> Vec<Read> {
    let document = Pdf::new(file.to_vec()).expect("the file is a PDF");
    let mut all = Vec::new();
    for page in document.pages().iter() {
        let (wide, high) = page.render_dimensions();
        let [w, h] = [wide, high].map(|v| (f64::from(v) * dpi / 72.0).round());
        let mut pixels = tiny_skia::Pixmap::new(w as u32, h as u32).unwrap();
        pixels.fill(tiny_skia::Color::WHITE);
        // Whole pixels, as in the PNG writer.
        let stretch = Affine::scale_non_uniform(w / f64::from(wide), h / f64::from(high));
        let transform = stretch * page.initial_transform(true).to_kurbo();
        let (cache, settings) = (InterpreterCache::new(), InterpreterSettings::default());
        let mut context =
            Context::new(transform, Rect::new(0.0, 0.0, w, h), &cache, page.xref(), settings);
        let mut reader = Reader { read: Read { pixels, text: String::new() } };
        interpret_page(page, &mut context, &mut reader);
        all.push(reader.read);
    }
    all
}

struct Reader {
    read: Read,
}

fn path_of(path: &BezPath) -> Option<tiny_skia::Path> {
    let mut b = tiny_skia::PathBuilder::new();
    for e in path.elements() {
        match *e {
            PathEl::MoveTo(p) => b.move_to(p.x as f32, p.y as f32),
            PathEl::LineTo(p) => b.line_to(p.x as f32, p.y as f32),
            PathEl::QuadTo(p, q) => b.quad_to(p.x as f32, p.y as f32, q.x as f32, q.y as f32),
            PathEl::CurveTo(p, q, r) => {
                b.cubic_to(p.x as f32, p.y as f32, q.x as f32, q.y as f32, r.x as f32, r.y as f32)
            }
            PathEl::ClosePath => b.close(),
        }
    }
    b.finish()
}

impl Reader {
    fn draw(
        &mut self,
        path: &BezPath,
        transform: Affine,
        paint: &Paint,
        stroke: Option<&StrokeProps>,
    ) {
        let Paint::Color(colour) = paint else { panic!("figures have plain colours") };
        let [r, g, b, a] = colour.to_rgba().to_rgba8();
        let mut ink = tiny_skia::Paint::default();
        ink.set_color_rgba8(r, g, b, a);
        let Some(path) = path_of(path) else { return };
        let [a, b, c, d, e, f] = transform.as_coeffs().map(|v| v as f32);
        let place = tiny_skia::Transform::from_row(a, b, c, d, e, f);
        match stroke {
            None => {
                self.read.pixels.fill_path(&path, &ink, tiny_skia::FillRule::Winding, place, None)
            }
            Some(s) => {
                let pen = tiny_skia::Stroke {
                    width: s.line_width,
                    miter_limit: s.miter_limit,
                    line_cap: if s.line_cap == Cap::Round {
                        tiny_skia::LineCap::Round
                    } else {
                        tiny_skia::LineCap::Butt
                    },
                    line_join: if s.line_join == Join::Round {
                        tiny_skia::LineJoin::Round
                    } else {
                        tiny_skia::LineJoin::Miter
                    },
                    dash: tiny_skia::StrokeDash::new(s.dash_array.to_vec(), s.dash_offset),
                };
                self.read.pixels.stroke_path(&path, &ink, &pen, place, None);
            }
        }
    }
}

impl<'a> Device<'a> for Reader {
    fn draw_path(
        &mut self,
        path: &BezPath,
        transform: Affine,
        paint: &Paint<'a>,
        mode: &PathDrawMode,
    ) {
        match mode {
            PathDrawMode::Fill(_) => self.draw(path, transform, paint, None),
            PathDrawMode::Stroke(s) => self.draw(path, transform, paint, Some(s)),
        }
    }

    fn draw_glyph(
        &mut self,
        glyph: &Glyph<'a>,
        transform: Affine,
        own: Affine,
        paint: &Paint<'a>,
        _: &GlyphDrawMode,
    ) {
        match glyph.as_unicode() {
            Some(BfString::Char(c)) => self.read.text.push(c),
            Some(BfString::String(s)) => self.read.text.push_str(&s),
            None => panic!("a glyph without its character"),
        }
        if let Glyph::Outline(outline) = glyph {
            self.draw(&outline.outline(), transform * own, paint, None);
        }
    }

    fn set_soft_mask(&mut self, _: Option<SoftMask<'a>>) {}
    fn set_blend_mode(&mut self, _: BlendMode) {}
    fn push_clip_path(&mut self, _: &ClipPath) {}
    fn push_transparency_group(&mut self, _: f32, _: Option<SoftMask<'a>>, _: BlendMode) {}
    fn draw_image(&mut self, _: Image<'a, '_>, _: Affine) {
        panic!("figures have no images");
    }
    fn pop_clip_path(&mut self) {}
    fn pop_transparency_group(&mut self) {}
}

/// The characters of all labels, in the order of drawing.
pub fn letters<'i>(items: impl IntoIterator<Item = &'i FigureItem>) -> String {
    let mut out = String::new();
    for item in items {
        if let Shape::Label { label, .. } | Shape::Turned { label, .. } = &item.shape {
            text::set(label).runs.iter().for_each(|r| out.push_str(&r.text));
        }
    }
    out
}

/// An item drawn twice in one colour, such as `fill` and `stroke` of a circle, comes in two parts:
/// compares the grey values of both pictures.
fn greys(pixels: &tiny_skia::Pixmap) -> Vec<u8> {
    pixels
        .pixels()
        .iter()
        .map(|p| ((u32::from(p.red()) + u32::from(p.green()) + u32::from(p.blue())) / 3) as u8)
        .collect()
}

fn greys_of_png(bytes: &[u8]) -> (u32, u32, Vec<u8>) {
    let (w, h, kind, samples) = super::files::pixels(bytes).unwrap();
    let channels = if kind == png::ColorType::Grayscale { 1 } else { 3 };
    let grey = |p: &[u8]| (p.iter().map(|v| u32::from(*v)).sum::<u32>() / channels as u32) as u8;
    (w, h, samples.chunks_exact(channels).map(grey).collect())
}

fn sheet(name: &str, lang: Lang) -> Figure {
    let scene = scene::read(templates::get(name).unwrap()).unwrap().value;
    let worked = work(&scene, Scope::Figure).unwrap().value;
    hodograph::figure::sheet::sheet(
        &scene,
        &worked,
        &hodograph::figure::sheet::SheetOptions::of_language(lang),
    )
    .unwrap()
}

/// Resolution at which pages and pictures are compared.
const DPI: f64 = 110.0;

#[test]
fn a_pdf_looks_as_the_svg_does_and_says_the_same() {
    for (name, lang) in [
        ("shaper", Lang::Zh),
        ("class-iii-six-bar", Lang::En),
        ("excavator", Lang::Zh),
        ("curved-slot", Lang::En),
    ] {
        let mut figure = sheet(name, lang);
        // Whole pixels: the two programs round half of one differently.
        let whole = |mm: f64| (mm * DPI / 25.4).ceil() * 25.4 / DPI;
        (figure.width_mm, figure.height_mm) = (whole(figure.width_mm), whole(figure.height_mm));
        let file = pdf::pdf(std::slice::from_ref(&figure)).unwrap().value;
        assert_eq!(
            file,
            pdf::pdf(std::slice::from_ref(&figure)).unwrap().value,
            "the same bytes twice"
        );
        let [page] = &read(&file, DPI)[..] else { panic!("one page") };
        assert_eq!(page.text, letters(&figure.items), "{name}");
        let picture = raster::render(&svg::write(&figure).unwrap().value, DPI).unwrap();
        let (w, h, expected) = greys_of_png(&picture);
        assert_eq!((page.pixels.width(), page.pixels.height()), (w, h), "{name}");
        let actual = greys(&page.pixels);
        let off: Vec<u8> = expected.iter().zip(&actual).map(|(a, b)| a.abs_diff(*b)).collect();
        let (mean, worst) = (
            off.iter().map(|d| f64::from(*d)).sum::<f64>() / off.len() as f64,
            off.iter().max().unwrap(),
        );
        let far = off.iter().filter(|d| **d > 64).count();
        println!("{name}: mean {mean:.3} of 255, worst {worst}, {far} pixels off by more than 64");
        // Letters are outlines of 1/1000 em in one and of the font's own units in the other; a
        // missing arrowhead is 56 pixels.
        assert!(
            mean < 0.05 && far < 10,
            "{name}: mean {mean:.3}, {far} pixels off by more than 64, worst {worst}"
        );
    }
}

#[test]
fn each_figure_has_its_page() {
    let figures = [sheet("crank-rocker", Lang::En), sheet("shaper", Lang::En)];
    let file = pdf::pdf(&figures).unwrap().value;
    let pages = read(&file, 25.4);
    let size = |f: &Figure| (f.width_mm.round() as u32, f.height_mm.round() as u32);
    let sizes: Vec<_> = pages.iter().map(|p| (p.pixels.width(), p.pixels.height())).collect();
    assert_eq!(sizes, figures.iter().map(size).collect::<Vec<_>>());
}

#[test]
fn faults_are_said_before_anything_is_written() {
    let mut figure = sheet("crank-rocker", Lang::En);
    figure.width_mm = 0.0;
    assert_eq!(pdf::pdf(&[figure.clone()]).unwrap_err().list[0].code, "page-size");
    figure.width_mm = 6000.0;
    assert_eq!(pdf::pdf(&[figure.clone()]).unwrap_err().list[0].code, "page-size");
    figure.width_mm = f64::NAN;
    assert_eq!(pdf::pdf(&[figure]).unwrap_err().list[0].code, "page-size");
}

/// Number of occurrences of a key in a file, outside of streams or in uncompressed ones.
fn count(file: &[u8], key: &str) -> usize {
    file.windows(key.len()).filter(|w| *w == key.as_bytes()).count()
}

/// Cells of a table of values, including empty ones.
fn places(table: &DocumentTable) -> usize {
    if table.kind == TableKind::Values { table.rows.len() * table.rows[0].len() } else { 0 }
}

/// The conditions of the Matterhorn Protocol that show in the bytes; the writer itself refuses
/// figures without description, documents without title and glyphs without character.
#[test]
fn documents_meet_pdf_ua() {
    for (name, lang) in [("shaper", Lang::Zh), ("planetary-gear", Lang::En)] {
        let scene = scene::read(templates::get(name).unwrap()).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        let document =
            worksheet::worksheet(&scene, &worked, &worksheet::WorksheetOptions::of_language(lang));
        let file =
            pdf::document(&worksheet::pages::pages(&document), &document.title, words(lang).tag)
                .unwrap();
        assert!(file.notes.is_empty(), "{name}: {:?}", file.notes);
        let file = file.value;
        for (key, least) in [
            ("<pdfuaid:part>1<", 1),
            ("/DisplayDocTitle true", 1),
            ("/Marked true", 1),
            ("/S/Table/", 2),
            ("/S/L/", 4),
        ] {
            assert!(
                count(&file, key) >= least,
                "{name}: {key} is there {} times, not {least}",
                count(&file, key)
            );
        }
        assert_eq!(count(&file, "/Suspects"), 0, "{name}: Poppler warns of it");
        assert_eq!(count(&file, "/S/TH/"), count(&file, "/Scope/"), "{name}: heads without scope");
        assert_eq!(count(&file, "/S/LI/"), count(&file, "/S/LBody/"), "{name}");
        let cells: usize = document
            .blocks
            .iter()
            .map(|b| if let DocumentBlock::Table(t) = b { places(t) } else { 0 })
            .sum();
        let found = count(&file, "/S/TH/") + count(&file, "/S/TD/");
        assert!(cells > 0 && found >= cells, "{name}: {found} cells of {cells}");
    }
    let mut figure = sheet("crank-rocker", Lang::En);
    assert!(pdf::pdf(std::slice::from_ref(&figure)).unwrap().notes.is_empty());
    (figure.title, figure.desc) = (String::new(), String::new());
    let notes = pdf::pdf(&[figure]).unwrap().notes;
    assert_eq!(notes.iter().map(|n| n.code).collect::<Vec<_>>(), ["pdf-ua"]);
}
