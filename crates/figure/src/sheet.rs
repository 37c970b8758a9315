//! Draws the whole sheet: title, mechanism, polygons, equations and results, arranged by their
//! measured sizes.
//!
//! This module selects the parts and writes their captions. [`super::arrange`] arranges them.

use hodograph_base::diag::{Both, Faults, both};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::say;
use hodograph_base::notation::Notation;
use hodograph_board::construct::Polygon;
use hodograph_board::plan::names::name_label;
use hodograph_board::plan::text::PlanWriter;
use hodograph_paper::paper::phrase::Phrase;
use hodograph_report::given::GivenSentences;
use hodograph_scene::{DiagramKind, Kind, Lang, SHEET_BORDER_MM, Scene, Swept};
use hodograph_worked::worked::Worked;

use super::arrange::{SheetPieces, Tree, arrange, arrange_in, arrange_on, column, put_together};
use super::course::remembered;
use super::described::described;
use super::mechanism::{Overlay, SeriesFeatures, dimensions};
use super::results::ResultsContent;
use super::scales::DrawingScales;
use super::tables::Tables;
use super::{forces, mechanism, polygon, results};
use hodograph_paper::paper::drawing::DrawingPart;
use hodograph_paper::paper::grid::{self, Cell, Row};
use hodograph_paper::paper::item::{Anchor, Colour, Figure, FigureItem, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::lines::wrapped;
use hodograph_paper::paper::style::{Captioned, Style};
use hodograph_paper::paper::words::{Words, words};
use hodograph_worked::certified::{Certified, CertifiedSteps, certify, steps};

/// The options of a sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct SheetOptions {
    /// The language of all words.
    pub lang: Lang,
    /// The notation.
    pub notation: Notation,
    /// Significant digits of the results, as far as they are certain.
    pub digits: usize,
    /// Line widths, sizes and colours. The marks of the style are already in `notation`.
    pub style: Style,
}

impl SheetOptions {
    /// Returns the usual style of a language's textbooks.
    pub fn of_language(lang: Lang) -> SheetOptions {
        SheetOptions {
            lang,
            notation: Notation::of_language(lang),
            digits: results::DIGITS,
            style: Style::default(),
        }
    }
}

/// Border of a sheet: the strip that a printer cannot reach on most paper.
pub(super) const MARGIN_MM: f64 = SHEET_BORDER_MM;
/// Minimum width of the list of given values.
const GIVEN_MM: f64 = 90.0;
/// Distance from a drawing to its caption's baseline.
const CAPTION_MM: f64 = 8.0;
/// Distance from the caption's baseline to the scale's.
const SCALE_MM: f64 = 5.6;

/// Distance from the scale's baseline to the graphic scale below it.
const BAR_MM: f64 = 2.2;
/// Gap between the scale and the graphic scale beside it.
const BESIDE_MM: f64 = 5.0;

/// Draws the whole sheet.
///
/// # Errors
/// `paper-too-small` if the scene fixes a size of paper on which the parts do not fit.
pub fn sheet(scene: &Scene, worked: &Worked, options: &SheetOptions) -> Result<Figure, Faults> {
    let certified = certify(scene, worked, options.digits);
    let maker = SheetDrafter { scene, worked, options, certified };
    let title = maker.title();
    let drawings = maker.drawings(f64::INFINITY);
    let equations = maker.equations(&steps(scene, worked, None), None);
    let results = results::results(&options.style, &maker.answers());
    let pieces =
        SheetPieces { title, drawings, equations, results, forces: forces::pieces(&maker, None) };
    let (items, size) = arrange(pieces.held(&options.style), scene.paper.size_mm, MARGIN_MM)?;
    Ok(maker.figure(items, size))
}

/// The content that may be left out of a sheet that is too wide.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Fewer {
    /// Nothing.
    No,
    /// Equations and results that are too wide even when they are broken into lines.
    Broken,
    /// Also forces.
    Words,
    /// Also polygons.
    Drawings,
}

/// Pages of a sheet, and the names of the content left out.
pub type PagedSheet = (Vec<Figure>, Vec<Both>);

/// Draws the whole sheet on pages of at most this width and height (mm), without a border. If the
/// height is infinite, there is one page, which may be wider.
///
/// # Errors
/// The size (mm) of a part that is larger than a page.
pub fn sheet_in(
    scene: &Scene,
    worked: &Worked,
    options: &SheetOptions,
    [width_mm, height_mm]: [f64; 2],
    fewer: Fewer,
) -> Result<PagedSheet, [f64; 2]> {
    let certified = certify(scene, worked, options.digits);
    let maker = SheetDrafter { scene, worked, options, certified };
    let (pieces, out) = maker.pieces_in(width_mm, fewer);
    let pieces = pieces.held(&options.style);
    let figure = |(items, size)| maker.figure(items, size);
    if height_mm.is_infinite() {
        return Ok((vec![figure(arrange_in(pieces, width_mm))], out));
    }
    let pages =
        arrange_on(pieces, [width_mm, height_mm], |k, of| maker.page_title(width_mm, k, of))?;
    Ok((pages.into_iter().map(figure).collect(), out))
}

/// Draws a diagram alone, with its caption and scale; `None` if the scene does not need it.
pub fn drawing(
    scene: &Scene,
    worked: &Worked,
    options: &SheetOptions,
    on: DiagramKind,
) -> Option<Figure> {
    let maker =
        SheetDrafter { scene, worked, options, certified: certify(scene, worked, options.digits) };
    let part = match on {
        DiagramKind::Plane => maker.mechanism(),
        DiagramKind::Velocity | DiagramKind::Acceleration | DiagramKind::Force => {
            maker.polygon(worked.construction.polygon(on)?, f64::INFINITY)
        }
    };
    Some(maker.alone(maker.captioned(part, "", on)))
}

/// Draws all equations alone; `None` if the scene needs none.
pub fn equations(scene: &Scene, worked: &Worked, options: &SheetOptions) -> Option<Figure> {
    let maker =
        SheetDrafter { scene, worked, options, certified: certify(scene, worked, options.digits) };
    Some(maker.alone(column(maker.equations(&steps(scene, worked, None), None))?))
}

/// Draws the results alone.
pub fn results(scene: &Scene, worked: &Worked, options: &SheetOptions) -> Figure {
    let maker =
        SheetDrafter { scene, worked, options, certified: certify(scene, worked, options.digits) };
    maker.alone(results::results(&options.style, &maker.answers()))
}

/// Draws the mechanism with vectors at its points, other positions behind it, or paths of points.
pub fn diagram(
    scene: &Scene,
    worked: &Worked,
    options: &SheetOptions,
    overlay: &Overlay,
) -> Figure {
    let maker =
        SheetDrafter { scene, worked, options, certified: certify(scene, worked, options.digits) };
    let part = mechanism::overlaid(&options.style, scene, worked, &maker.writer(), overlay);
    let (words, mut scales) = maker.caption(DiagramKind::Plane);
    if let (Some(on), Some(of_vectors)) = (overlay.vectors, overlay.mu(scene, worked)) {
        scales = scales.and(DrawingScales::of(&scene.book, on, of_vectors));
    }
    let titled = maker.titled(part, Phrase::new(words).label(), &scales, "mechanism");
    maker.alone(if overlay.dimensions { maker.with_givens(titled) } else { titled })
}

/// Draws the mechanism with its overlay, without a list below: the surrounding document has one.
pub fn problem_diagram(
    scene: &Scene,
    worked: &Worked,
    options: &SheetOptions,
    overlay: &Overlay,
) -> Figure {
    let maker =
        SheetDrafter { scene, worked, options, certified: certify(scene, worked, options.digits) };
    let part = mechanism::overlaid(&options.style, scene, worked, &maker.writer(), overlay);
    maker.alone(maker.captioned(part, "", DiagramKind::Plane))
}

/// Draws the parts of a sheet.
pub(super) struct SheetDrafter<'a> {
    pub scene: &'a Scene,
    pub worked: &'a Worked,
    pub options: &'a SheetOptions,
    pub certified: Vec<Certified>,
}

impl SheetDrafter<'_> {
    fn answers(&self) -> ResultsContent<'_> {
        let SheetOptions { notation, digits, .. } = self.options;
        ResultsContent {
            scene: self.scene,
            worked: self.worked,
            certified: &self.certified,
            notation,
            words: self.words(),
            digits: *digits,
        }
    }

    pub fn words(&self) -> &'static Words {
        words(self.options.lang)
    }

    pub fn writer(&self) -> PlanWriter<'_> {
        PlanWriter {
            scene: self.scene,
            plan: &self.worked.plan,
            notation: &self.options.notation,
            lang: self.options.lang,
        }
    }

    /// The equations of each polygon with their heading; empty if there are none. `steps` are the
    /// certified numbers of the construction; long equations are broken to a given width.
    pub fn equations(
        &self,
        steps: &CertifiedSteps,
        width_mm: Option<f64>,
    ) -> Vec<(DrawingPart, Vec<DrawingPart>)> {
        let writer = self.writer();
        let tables = Tables { width_mm, ..self.tables(&writer, steps) };
        DiagramKind::POLYGONS.map(|l| (self.heading(l), tables.parts(l))).into()
    }

    /// The input of the tables.
    pub fn tables<'t>(
        &'t self,
        writer: &'t PlanWriter<'t>,
        steps: &'t CertifiedSteps,
    ) -> Tables<'t> {
        let worked = self.worked;
        Tables {
            style: &self.options.style,
            writer,
            construction: &worked.construction,
            steps,
            width_mm: None,
        }
    }

    pub fn mechanism(&self) -> DrawingPart {
        let SheetOptions { style, notation, .. } = self.options;
        let course = match &style.memory {
            Some(memory) => remembered(memory, style, self.scene, self.worked, notation),
            None => SeriesFeatures::default(),
        };
        let mut d = mechanism::drawing(style, self.scene, self.worked, notation, &course);
        forces::given_loads(self.scene, self.worked, self.options, &mut d);
        d.finish()
    }

    /// A polygon for a page of this width.
    pub fn polygon(&self, p: &Polygon, width_mm: f64) -> DrawingPart {
        polygon::polygon(&self.options.style, &self.writer(), p, width_mm)
    }

    /// The drawings with their captions, for a sheet or a page of this width.
    fn drawings(&self, width_mm: f64) -> Vec<DrawingPart> {
        let mut all = vec![(DiagramKind::Plane, self.mechanism())];
        for on in DiagramKind::POLYGONS {
            if let Some(p) = self.worked.construction.polygon(on) {
                all.push((on, self.polygon(p, width_mm)));
            }
        }
        let mut letters = ["(a) ", "(b) ", "(c) "].into_iter();
        all.into_iter()
            .map(|(on, part)| {
                let letter = letters.next().unwrap_or_default();
                self.captioned(part, letter, on)
            })
            .collect()
    }

    /// The caption of a drawing or a list.
    pub fn name(&self, what: Captioned) -> &str {
        self.options.style.captions.of(what, self.options.lang)
    }

    /// The name of a diagram, and its scale.
    pub fn caption(&self, on: DiagramKind) -> (&str, DrawingScales) {
        let paper = &self.worked.construction;
        let book = &self.scene.book;
        let mu = |on| paper.polygon(on).map_or(0.0, |p| p.mu);
        let scales = match on {
            DiagramKind::Plane => DrawingScales::of(book, on, paper.diagram.mu),
            _ if paper.is_empty(on) => {
                DrawingScales::words(format!("\\text{{{}}}", self.words().no_vectors))
            }
            DiagramKind::Velocity | DiagramKind::Acceleration | DiagramKind::Force => {
                DrawingScales::of(book, on, mu(on))
            }
        };
        (self.name(Captioned::Drawing(on)), scales)
    }

    /// A part alone on its paper.
    pub fn alone(&self, mut part: DrawingPart) -> Figure {
        if let Some(memory) = &self.options.style.memory {
            memory.hold("alone", &mut part);
        }
        let size =
            [part.bounds.width_mm() + 2.0 * MARGIN_MM, part.bounds.height_mm() + 2.0 * MARGIN_MM];
        part.stand_at(Point::new(MARGIN_MM, size[1] - MARGIN_MM));
        self.figure(part.items, size)
    }

    pub fn captioned(&self, part: DrawingPart, letter: &str, on: DiagramKind) -> DrawingPart {
        let (words, scales) = self.caption(on);
        let id = on.prefix();
        self.titled(part, Phrase::new(&format!("{letter}{words}")).label(), &scales, id)
    }

    /// A part with its name and its scales below; `id` distinguishes these labels from those of
    /// other parts.
    pub fn titled(
        &self,
        part: DrawingPart,
        words: Label,
        scales: &DrawingScales,
        id: &str,
    ) -> DrawingPart {
        titled(&self.options.style, part, words, scales, id)
    }

    /// Adds, below a dimensioned drawing, all given values that are not drawn as dimensions.
    fn with_givens(&self, part: DrawingPart) -> DrawingPart {
        let scene = self.scene;
        let drawn = |a, b| part.items.iter().any(|i| i.id == dimensions::id_of(scene, a, b));
        let lines = GivenSentences { scene, lang: self.options.lang }.beside(drawn);
        let size_mm = self.options.style.small_mm;
        let width_mm = part.bounds.width_mm().max(GIVEN_MM);
        let labels =
            lines.iter().flat_map(|l| wrapped(l, width_mm, size_mm, &self.options.style.fonts));
        let row = |label: Label| Row {
            cells: vec![Some(Cell {
                label,
                size_mm,
                anchor: Anchor::Start,
                class: "given".into(),
                id: String::new(),
            })],
            height_mm: size_mm * 1.55,
        };
        let mut items = grid::set(&labels.map(row).collect::<Vec<_>>(), 0.0);
        for (k, item) in items.iter_mut().enumerate() {
            item.id = format!("given-{}", k + 1);
        }
        put_together(
            Tree::column(vec![Tree::Leaf(0), Tree::Leaf(1)]),
            vec![part, DrawingPart::of(items)],
        )
    }

    fn line(&self, id: &str, label: Label, size_mm: f64) -> DrawingPart {
        let label = label.in_fonts(&self.options.style.fonts);
        let shape = Shape::Label {
            at: Point::ORIGIN,
            label,
            size_mm,
            anchor: Anchor::Start,
            colour: Colour::BLACK,
        };
        DrawingPart::of(vec![FigureItem::new(id, shape).with_id(id)])
    }

    pub fn title(&self) -> Option<DrawingPart> {
        let title = self.options.lang.of(&self.scene.title);
        // A third larger than the captions: a heading without a bold face.
        (!title.is_empty()).then(|| {
            self.line("title", Label::text(title), self.options.style.caption_mm * 4.0 / 3.0)
        })
    }

    /// A title, broken to as many lines as needed.
    fn title_in(&self, title: &str, width_mm: f64) -> DrawingPart {
        let size_mm = self.options.style.caption_mm * 4.0 / 3.0;
        let lines = wrapped(&Phrase::new(title), width_mm, size_mm, &self.options.style.fonts);
        let item = |(k, label): (usize, Label)| {
            let shape = Shape::Label {
                at: Point::new(0.0, -1.3 * size_mm * k as f64),
                label,
                size_mm,
                anchor: Anchor::Middle,
                colour: Colour::BLACK,
            };
            FigureItem::new("title", shape).with_id(if k == 0 {
                "title".into()
            } else {
                format!("title-{}", k + 1)
            })
        };
        DrawingPart::of(lines.into_iter().enumerate().map(item).collect())
    }

    /// The parts of a sheet of this width, and the names of the content left out.
    fn pieces_in(&self, width_mm: f64, fewer: Fewer) -> (SheetPieces, Vec<Both>) {
        let mut out = Vec::new();
        let fits = |part: &DrawingPart| part.bounds.width_mm() <= width_mm;
        let title = self.title().map(|whole| {
            if fits(&whole) { whole } else { self.page_title(width_mm, 1, 1).unwrap_or(whole) }
        });
        let broken = fewer >= Fewer::Broken;
        let steps = steps(self.scene, self.worked, None);
        let mut equations = self.equations(&steps, broken.then_some(width_mm));
        let mut results = results::results(&self.options.style, &self.answers());
        if broken {
            let count = |e: &[(DrawingPart, Vec<DrawingPart>)]| {
                e.iter().map(|(_, lines)| lines.len()).sum::<usize>()
            };
            let all = count(&equations);
            equations.iter_mut().for_each(|(_, lines)| lines.retain(fits));
            match (all - count(&equations), all) {
                (0, _) => {}
                (gone, all) if gone == all => out.push(both!("the equations")),
                (gone, all) => out.push(both!("{gone} of {all} equations")),
            }
            let (part, whole) = results::results_in(&self.options.style, &self.answers(), width_mm);
            match (fits(&part), whole) {
                (true, true) => results = part,
                (true, false) => {
                    results = part;
                    out.push(both!("the lengths measured"));
                }
                (false, _) => {
                    results = DrawingPart::of(Vec::new());
                    out.push(both!("the results"));
                }
            }
        }
        let mut drawings = self.drawings(width_mm);
        if fewer == Fewer::Drawings {
            let polygons = DiagramKind::POLYGONS
                .into_iter()
                .filter(|l| self.worked.construction.polygon(*l).is_some());
            let levels: Vec<DiagramKind> =
                std::iter::once(DiagramKind::Plane).chain(polygons).collect();
            let gone = drawings
                .iter()
                .zip(&levels)
                .filter(|(part, on)| **on != DiagramKind::Plane && !fits(part));
            out.extend(gone.map(|(_, on)| match on {
                DiagramKind::Plane => both!("the mechanism"),
                DiagramKind::Velocity => both!("the velocity polygon"),
                DiagramKind::Acceleration => both!("the acceleration polygon"),
                DiagramKind::Force => both!("the force polygons"),
            }));
            let mut on = levels.iter();
            drawings.retain(|part| on.next() == Some(&DiagramKind::Plane) || fits(part));
        }
        let mut forces = forces::pieces(self, Some(width_mm));
        let wide = |group: &[DrawingPart; 3]| !group.iter().all(fits);
        if fewer >= Fewer::Words && forces.iter().any(wide) {
            forces.clear();
            out.push(both!("the forces"));
        }
        (SheetPieces { title, drawings, equations, results, forces }, out)
    }

    /// The title of a page of several.
    pub fn page_title(&self, width_mm: f64, page: usize, pages: usize) -> Option<DrawingPart> {
        let title = self.options.lang.of(&self.scene.title);
        let text = match page {
            1 => title.to_owned(),
            _ => say!(self.options.lang, "{title} ({page} of {pages})"),
        };
        (!title.is_empty()).then(|| self.title_in(&text, width_mm))
    }

    fn heading(&self, on: DiagramKind) -> DrawingPart {
        self.line(
            &format!("heading-{}", on.word()),
            Phrase::new(self.name(Captioned::Equations(on))).label(),
            self.options.style.caption_mm,
        )
    }

    /// The title of a figure.
    pub fn heading_words(&self) -> &str {
        let title = self.options.lang.of(&self.scene.title);
        if title.is_empty() { DiagramKind::Plane.caption(self.options.lang) } else { title }
    }

    pub fn figure(&self, items: Vec<FigureItem>, size: [f64; 2]) -> Figure {
        let title = self.heading_words();
        let found = results::sentence(&self.answers());
        let desc = format!("{}{found}", described(self.scene, self.options.lang, title, &items));
        self.described(items, size, title.into(), desc.trim_end().to_owned())
    }

    /// A figure with these words for readers who cannot see it.
    pub fn described(
        &self,
        items: Vec<FigureItem>,
        size: [f64; 2],
        title: String,
        desc: String,
    ) -> Figure {
        painted(&self.options.style, self.options.lang, size, [title, desc], items)
    }
}

/// A figure of a style, with a title and a description for readers who cannot see it.
pub(super) fn painted(
    style: &Style,
    lang: Lang,
    [width_mm, height_mm]: [f64; 2],
    [title, desc]: [String; 2],
    items: Vec<FigureItem>,
) -> Figure {
    let (lang, paper) = (words(lang).tag.into(), Colour::WHITE);
    let mut figure = Figure { width_mm, height_mm, title, desc, lang, paper, items };
    style.palette.paint(&mut figure);
    figure
}

/// A part with its name and its scales below; `id` distinguishes these labels from those of other
/// parts.
pub(super) fn titled(
    style: &Style,
    mut part: DrawingPart,
    words: Label,
    scales: &DrawingScales,
    id: &str,
) -> DrawingPart {
    let x = part.bounds.centre().x;
    let y = part.bounds.min.y - style.leading(CAPTION_MM);
    let text = |at: Point, label: Label, size_mm: f64, what: &str| {
        let label = label.in_fonts(&style.fonts);
        let shape =
            Shape::Label { at, label, size_mm, anchor: Anchor::Middle, colour: Colour::BLACK };
        FigureItem::new(what, shape).with_id(format!("{what}-{id}"))
    };
    part.items.push(text(Point::new(x, y), words, style.caption_mm, "caption"));
    let below = Point::new(x, y - style.leading(SCALE_MM));
    let mut formula =
        DrawingPart::of(vec![text(below, Label::math(&scales.text), style.small_mm, "scale")]);
    let mut bars = DrawingPart::of(scales.bars(style, id));
    // Beside the formula if that makes the drawing no wider, else below it.
    let beside_mm = formula.bounds.width_mm() + BESIDE_MM + bars.bounds.width_mm();
    if !bars.items.is_empty() && beside_mm <= part.bounds.width_mm() {
        let left = x - beside_mm / 2.0;
        formula.translate(Vec2::new(left - formula.bounds.min.x, 0.0));
        let middle = formula.bounds.centre().y - bars.bounds.centre().y;
        let right = left + beside_mm - bars.bounds.max.x;
        bars.translate(Vec2::new(right, middle));
    } else {
        let top = below.y - style.leading(BAR_MM);
        bars.translate(Vec2::new(x - bars.bounds.centre().x, top - bars.bounds.max.y));
    }
    part.items.extend(formula.items.into_iter().chain(bars.items));
    let DrawingPart { items, bounds, placements, left_out } = part;
    let all = DrawingPart::of(items);
    DrawingPart { bounds: all.bounds.union(bounds), placements, left_out, ..all }
}

/// Returns the symbol of the quantity that changes from pose to pose, in the label language, and
/// its kind: `\varphi_{1}` an angle, `s_{B}` or `l_{BC}` a length, `t` a time.
pub fn swept_symbol(scene: &Scene, swept: impl Into<Swept>) -> (String, Kind) {
    let (name, kind) = swept.into().name(scene);
    let symbol = match name.split_once('_') {
        Some(("phi", link)) => format!("\\varphi_{{{}}}", name_label(link)),
        Some((letter, of)) => format!("{letter}_{{{}}}", name_label(of)),
        None => name,
    };
    (symbol, kind)
}
