//! Draws the construction as a series of figures: the mechanism (for forces, the separated links),
//! the polygon drawn so far with the vectors of the present step in full ink, the equation being
//! solved, and the sentence of the step. All figures have one size, so that slides do not jump.

use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::say;
use hodograph_board::construct::Polygon;
use hodograph_paper::paper::phrase::Phrase;
use hodograph_report::construction::sentences;
use hodograph_scene::{DiagramKind, Scene};
use hodograph_worked::certified;
use hodograph_worked::worked::Worked;

use super::fit::Within;
use super::forces::{self, GroupForceSteps};
use super::sheet::{MARGIN_MM, SheetDrafter, SheetOptions};
use hodograph_paper::paper::drawing::DrawingPart;
use hodograph_paper::paper::extent::Rect;
use hodograph_paper::paper::item::{Anchor, Colour, Figure, FigureItem, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::lines::wrapped;
use hodograph_paper::paper::style::Palette;

/// Gap between the drawings, and between them and the text below.
const GAP_MM: f64 = 12.0;
/// Distance from the sentence to the equation above it.
const LINE_MM: f64 = 5.0;
/// Line spacing of a sentence, in type sizes.
const LEADING: f64 = 1.5;
/// Colour of the ink of earlier steps.
const EARLIER: Colour = Colour::grey(135);

/// The figures of a construction, one for each step of the velocity and the acceleration polygon,
/// starting with the poles, then for each step of the forces of each group. Each repeats all that is
/// drawn before it and is drawn when it is asked for.
pub struct StepFigures<'a> {
    maker: SheetDrafter<'a>,
    levels: Vec<PolygonSteps>,
    diagram: DrawingPart,
    stacked: bool,
    /// Width and height of the larger diagram (mm), of the larger polygon, of both together.
    diagram_mm: [f64; 2],
    polygon_mm: [f64; 2],
    drawings_mm: [f64; 2],
    size: [f64; 2],
}

impl<'a> StepFigures<'a> {
    /// Prepares the figures of a scene; within a given space sentences and equations are broken
    /// into lines, and anything that is still wider sticks out.
    pub fn of(
        scene: &'a Scene,
        worked: &'a Worked,
        options: &'a SheetOptions,
        room: Option<Within>,
    ) -> StepFigures<'a> {
        let width_mm = room.map(|room| room.width_mm);
        // No results are shown: they need no digits.
        let maker = SheetDrafter { scene, worked, options, certified: Vec::new() };
        let told = certified::steps(scene, worked, None);
        let diagram = maker.captioned(maker.mechanism(), "", DiagramKind::Plane);
        let polygon_mm = room.map_or(f64::INFINITY, |room| match room.stacked {
            true => room.width_mm,
            false => room.width_mm - diagram.bounds.width_mm() - GAP_MM,
        });
        let levels: Vec<PolygonSteps> = DiagramKind::POLYGONS
            .into_iter()
            .zip(maker.equations(&told, width_mm))
            .filter_map(|(on, (_, written))| {
                Some(PolygonSteps::of(
                    &maker,
                    worked.construction.polygon(on)?,
                    (&told, &written),
                    (polygon_mm, width_mm),
                ))
            })
            .chain(
                forces::steps(&maker, width_mm)
                    .into_iter()
                    .map(|of| PolygonSteps::of_forces(&maker, of, width_mm)),
            )
            .collect();
        let most = |size: fn(&PolygonSteps) -> f64| levels.iter().map(size).fold(0.0, f64::max);
        let polygon_mm =
            [most(|s| s.polygon.bounds.width_mm()), most(|s| s.polygon.bounds.height_mm())];
        let text_mm = [most(|s| s.text_mm()[0]), most(|s| s.text_mm()[1])];
        let widest = |size: fn(&DrawingPart) -> f64| {
            levels
                .iter()
                .filter_map(|s| s.apart.as_ref())
                .chain([&diagram])
                .map(size)
                .fold(0.0, f64::max)
        };
        let diagram_mm = [widest(|p| p.bounds.width_mm()), widest(|p| p.bounds.height_mm())];
        let stacked = room.is_some_and(|room| room.stacked);
        let drawings_mm = match stacked {
            false => [diagram_mm[0] + GAP_MM + polygon_mm[0], diagram_mm[1].max(polygon_mm[1])],
            true => [diagram_mm[0].max(polygon_mm[0]), diagram_mm[1] + GAP_MM + polygon_mm[1]],
        };
        let inner = [drawings_mm[0].max(text_mm[0]), drawings_mm[1] + GAP_MM + text_mm[1]];
        let size = inner.map(|mm| mm + 2.0 * MARGIN_MM);
        StepFigures { maker, levels, diagram, stacked, diagram_mm, polygon_mm, drawings_mm, size }
    }

    /// Returns the size of the two drawings together (mm), without sentences and equations.
    pub fn drawings_mm(&self) -> [f64; 2] {
        self.drawings_mm
    }

    /// Returns the names of the figures, in order.
    pub fn words(&self) -> Vec<String> {
        let total: usize = self.levels.iter().map(|s| s.sentences.len()).sum();
        (1..=total).map(|k| format!("step-{k:02}")).collect()
    }

    /// Draws the figures, in order.
    pub fn figures(&self) -> impl Iterator<Item = Figure> {
        let total: usize = self.levels.iter().map(|s| s.sentences.len()).sum();
        let all = self.levels.iter().flat_map(|s| (0..s.sentences.len()).map(move |k| (s, k)));
        (1..).zip(all).map(move |(number, (steps, k))| self.figure(steps, k, [number, total]))
    }

    fn figure(&self, steps: &PolygonSteps, k: usize, [number, total]: [usize; 2]) -> Figure {
        let mut diagram =
            steps.apart.as_ref().map_or_else(|| self.diagram.clone(), |apart| at(apart, k));
        let top = self.size[1] - MARGIN_MM;
        let [diagram_width, diagram_height] = self.diagram_mm;
        let [polygon_width, polygon_height] = self.polygon_mm;
        // The centres of the two drawings.
        let [of_diagram, of_polygon] = match self.stacked {
            false => {
                let middle = top - self.drawings_mm[1] / 2.0;
                let left = MARGIN_MM + diagram_width + GAP_MM;
                [
                    Point::new(MARGIN_MM + diagram_width / 2.0, middle),
                    Point::new(left + polygon_width / 2.0, middle),
                ]
            }
            true => {
                let middle = MARGIN_MM + self.drawings_mm[0] / 2.0;
                [
                    Point::new(middle, top - diagram_height / 2.0),
                    Point::new(middle, top - self.drawings_mm[1] + polygon_height / 2.0),
                ]
            }
        };
        diagram.translate(of_diagram - diagram.bounds.centre());
        let mut polygon = at(&steps.polygon, k);
        polygon.translate(of_polygon - polygon.bounds.centre());
        let mut text = steps.text(k);
        text.stand_at(Point::new(MARGIN_MM, top - self.drawings_mm[1] - GAP_MM));
        diagram.items.append(&mut polygon.items);
        diagram.items.append(&mut text.items);
        let step = say!(self.maker.options.lang, "step {number} of {total}");
        let title = format!("{} · {step}", self.maker.heading_words());
        self.maker.described(diagram.items, self.size, title, steps.sentences[k].plain())
    }
}

/// The steps of one polygon.
struct PolygonSteps {
    /// The separated links, in place of the mechanism.
    apart: Option<DrawingPart>,
    polygon: DrawingPart,
    sentences: Vec<Phrase>,
    /// The lines of the sentences.
    lines: Vec<Vec<Label>>,
    /// For each sentence, the equation being solved.
    equations: Vec<Option<DrawingPart>>,
    caption_mm: f64,
}

impl PolygonSteps {
    fn of(
        maker: &SheetDrafter,
        p: &Polygon,
        (told, written): (&certified::CertifiedSteps, &[DrawingPart]),
        (polygon_mm, width_mm): (f64, Option<f64>),
    ) -> PolygonSteps {
        let polygon = maker.captioned(maker.polygon(p, polygon_mm), "", p.on);
        let sentences = sentences(&maker.writer(), &maker.worked.construction, p, told);
        let finds = |part: &DrawingPart| part.items.iter().flat_map(FigureItem::steps).max();
        // The pole has no equation; an action belongs to the first equation that is solved at it or
        // after it. An action that only reads a value belongs to none.
        let equation = |k: usize| {
            let action = k.checked_sub(1)?;
            if p.actions[action].reads() {
                return None;
            }
            written.iter().find(|part| finds(part).is_some_and(|step| step >= action)).cloned()
        };
        let equations = (0..sentences.len()).map(equation).collect();
        let lines = lines(maker, &sentences, width_mm);
        PolygonSteps {
            apart: None,
            polygon,
            sentences,
            lines,
            equations,
            caption_mm: maker.options.style.caption_mm,
        }
    }

    fn of_forces(maker: &SheetDrafter, of: GroupForceSteps, width_mm: Option<f64>) -> PolygonSteps {
        let GroupForceSteps { apart, polygon, sentences, equations } = of;
        let lines = lines(maker, &sentences, width_mm);
        PolygonSteps {
            apart: Some(apart),
            polygon,
            sentences,
            lines,
            equations,
            caption_mm: maker.options.style.caption_mm,
        }
    }

    /// The equation and the sentence below it.
    fn text(&self, k: usize) -> DrawingPart {
        let mut items = Vec::new();
        let mut y = 0.0;
        if let Some(equation) = &self.equations[k] {
            let mut equation = equation.clone();
            equation.stand_at(Point::ORIGIN);
            y -= equation.bounds.height_mm() + LINE_MM;
            items.append(&mut equation.items);
        }
        for (n, label) in self.lines[k].iter().enumerate() {
            let shape = Shape::Label {
                at: Point::new(0.0, y - self.caption_mm * (1.0 + LEADING * n as f64)),
                label: label.clone(),
                size_mm: self.caption_mm,
                anchor: Anchor::Start,
                colour: Colour::BLACK,
            };
            let id = if n == 0 { "sentence".to_owned() } else { format!("sentence-{}", n + 1) };
            items.push(FigureItem::new("sentence", shape).with_id(&id));
        }
        let mut part = DrawingPart::of(items);
        // From the upper left corner, independent of the shape of the first letter.
        part.bounds = Rect::new(part.bounds.min, Point::ORIGIN + Vec2::new(part.bounds.max.x, 0.0));
        part
    }

    fn text_mm(&self) -> [f64; 2] {
        let sizes = (0..self.sentences.len()).map(|k| self.text(k).bounds);
        sizes.fold([0.0, 0.0], |[w, h], b| [w.max(b.width_mm()), h.max(b.height_mm())])
    }
}

/// The lines of each sentence.
fn lines(maker: &SheetDrafter, sentences: &[Phrase], width_mm: Option<f64>) -> Vec<Vec<Label>> {
    let style = &maker.options.style;
    let broken = |phrase: &Phrase| match width_mm {
        None => vec![phrase.label().in_fonts(&style.fonts)],
        Some(width_mm) => wrapped(phrase, width_mm, style.caption_mm, &style.fonts),
    };
    sentences.iter().map(broken).collect()
}

/// A drawing after `k` actions: later ones are missing, earlier ones are in the background. Items
/// that belong to no action are present from the start.
fn at(part: &DrawingPart, k: usize) -> DrawingPart {
    let faded = Palette { ink: EARLIER, ..Palette::default() };
    let mut part = part.clone();
    part.items.retain(|item| item.steps().next().is_none_or(|_| item.steps().any(|step| step < k)));
    for item in &mut part.items {
        let earlier = item.steps().next().is_some() && !item.steps().any(|step| step + 1 == k);
        if earlier {
            faded.item(item);
        }
    }
    part
}
