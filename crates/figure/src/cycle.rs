//! The diagram of a motion cycle (运动循环图) in its three forms: bars, one row for each output; a
//! straight rise or fall for each stroke over the position of the driver; rings about the axis of
//! the driver.
//!
//! Forward strokes are grey, strokes back are white, and a dwell is only a line.

use super::plot::PlotAxis;
use super::sheet::{painted, swept_symbol};
use hodograph_base::digits::{legible, shortest};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::{each, tr};
use hodograph_board::plan::names::name_label;
use hodograph_paper::paper::item::{
    Anchor, Colour, Figure, FigureItem, LineStroke, PathPiece, Shape,
};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::style::Style;
use hodograph_paper::paper::text::set;
use hodograph_report::cycle::{MotionCycle, MotionPhase, OutputCycle, PhaseKind};
use hodograph_scene::{Kind, Lang, Scene, Swept};
use std::f64::consts::TAU;

/// A form of the diagram.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CycleForm {
    /// Bars over the position of the driver (直线式).
    Bars,
    /// Displacements as straight lines over the position of the driver (直角坐标式).
    Straight,
    /// Rings about the axis of the driver (圆周式).
    Polar,
}

impl CycleForm {
    /// All forms, the usual one first.
    pub const ALL: [CycleForm; 3] = [CycleForm::Bars, CycleForm::Straight, CycleForm::Polar];

    /// Returns the name in commands.
    pub fn name(self) -> &'static str {
        match self {
            CycleForm::Bars => "bars",
            CycleForm::Straight => "straight",
            CycleForm::Polar => "polar",
        }
    }

    /// Returns a line on the form, English and Chinese.
    pub fn about(self) -> [&'static str; 2] {
        match self {
            CycleForm::Bars => each!("A row of bars for each output"),
            CycleForm::Straight => {
                each!("Each stroke as a straight line over the position of the driver")
            }
            CycleForm::Polar => each!("A ring for each output"),
        }
    }

    /// Returns the form of a name.
    pub fn named(name: &str) -> Option<CycleForm> {
        CycleForm::ALL.into_iter().find(|form| form.name() == name)
    }
}

/// Space on the left for names, width of the cycle, and space on the right (mm).
const LEFT_MM: f64 = 50.0;
const WIDTH_MM: f64 = 170.0;
const RIGHT_MM: f64 = 10.0;
/// Space above the first row and below the last (mm).
const ABOVE_MM: f64 = 24.0;
const BELOW_MM: f64 = 34.0;
/// Height of a bar, of a displacement, and of the space below either (mm).
const BAR_MM: f64 = 11.0;
const RISE_MM: f64 = 26.0;
const SPACE_MM: f64 = 13.0;
/// Radius of the inner ring, width of a ring, and length of a tick beyond the outer one (mm).
const INNER_MM: f64 = 22.0;
const RING_MM: f64 = 12.0;
const TICK_MM: f64 = 2.5;
/// Least distance between two numbers, and between words and the ends of their bar (mm).
const GAP_MM: f64 = 1.6;
/// Height of the words of a displacement above its lower end (mm).
const WORDS_MM: f64 = 1.5;
/// Significant digits of numbers in the diagram.
const DIGITS: usize = 4;
/// Stroke of the grid.
const GRID: LineStroke = LineStroke::new(0.12).coloured(Colour::grey(190));
const WORKING: Colour = Colour::grey(205);

/// A diagram under construction.
struct CycleDiagram<'a> {
    scene: &'a Scene,
    cycle: &'a MotionCycle,
    style: &'a Style,
    lang: Lang,
    items: Vec<FigureItem>,
}

/// Draws the cycle of a driver in a form. Rings need a driver that turns fully: others have bars.
pub fn figure(
    scene: &Scene,
    driver: usize,
    cycle: &MotionCycle,
    form: CycleForm,
    style: &Style,
    lang: Lang,
) -> Figure {
    let mut d = CycleDiagram { scene, cycle, style, lang, items: Vec::new() };
    let (symbol, _) = swept_symbol(scene, Swept::Driver(driver));
    let [width_mm, height_mm] = match form {
        CycleForm::Polar if cycle.repeats => d.rings(&symbol),
        CycleForm::Bars | CycleForm::Polar => {
            d.legend(7.0);
            d.rows(&symbol, BAR_MM, CycleDiagram::bars)
        }
        CycleForm::Straight => d.rows(&symbol, RISE_MM, CycleDiagram::rises),
    };
    let title = match lang.of(&scene.title) {
        "" => tr!(lang, "Motion cycle").to_owned(),
        title => {
            format!("{title}{}{}", tr!(lang, ": "), tr!(lang, "motion cycle"))
        }
    };
    let at = Point::new(width_mm / 2.0, height_mm - 10.0);
    d.words("title", at, Label::text(title.as_str()), style.caption_mm * 4.0 / 3.0, Anchor::Middle);
    painted(style, lang, [width_mm, height_mm], [title, cycle.text(scene, lang)], d.items)
}

/// Returns the symbol of an output, in the label language.
fn symbol(output: &OutputCycle) -> String {
    match output.name.split_once('_') {
        Some(("phi", link)) => format!("\\varphi_{{{}}}", name_label(link)),
        Some((letter, of)) => format!("{letter}_{{{}}}", name_label(of)),
        None => output.name.clone(),
    }
}

/// Returns the horizontal extent of the part of a line that is at a height or above it.
fn above(a: Point, b: Point, height: f64) -> [f64; 2] {
    let (low, high) = if a.y < b.y { (a, b) } else { (b, a) };
    if high.y <= height {
        return [high.x, high.x];
    }
    let part = ((height - low.y) / (high.y - low.y)).max(0.0);
    let cut = low.x + part * (high.x - low.x);
    [cut.min(high.x), cut.max(high.x)]
}

impl CycleDiagram<'_> {
    fn draw(&mut self, class: &str, shape: Shape) {
        let id = format!("{class}-{}", self.items.len());
        let item = FigureItem::new(class, shape).with_id(id);
        self.items.push(item.in_fonts(&self.style.fonts));
    }

    fn line(&mut self, class: &str, from: Point, to: Point, stroke: LineStroke) {
        self.draw(class, Shape::Line { from, to, stroke });
    }

    fn words(&mut self, class: &str, at: Point, label: Label, size_mm: f64, anchor: Anchor) {
        self.draw(class, Shape::Label { at, label, size_mm, anchor, colour: Colour::BLACK });
    }

    fn width_mm(&self, label: &Label, size_mm: f64) -> f64 {
        set(&label.clone().in_fonts(&self.style.fonts)).width_em * size_mm
    }

    /// Returns a position of the driver as a label, with the degree sign.
    fn place(&self, way: f64) -> Label {
        let (kind, at) = (self.cycle.driver.1, self.cycle.position(way));
        Label::math(self.number(kind, at))
    }

    /// Returns a number in the unit for small quantities; angles have a degree sign.
    fn number(&self, kind: Kind, si: f64) -> String {
        let (unit, per_si) = self.scene.book.fine(kind);
        let number = legible(si * per_si, DIGITS);
        if unit == "\\degree" { format!("{number}\\degree") } else { number }
    }

    /// Returns a number with its unit, in the label language.
    fn size(&self, kind: Kind, si: f64) -> String {
        let number = self.number(kind, si);
        match self.scene.book.fine(kind).0.as_str() {
            "\\degree" => number,
            unit => format!("{number}\\,{unit}"),
        }
    }

    /// Draws a row for each output by `fill`, above the axis of the driver; returns the size.
    fn rows(
        &mut self,
        driver: &str,
        row_mm: f64,
        fill: fn(&mut Self, &OutputCycle, [f64; 2]),
    ) -> [f64; 2] {
        let count = self.cycle.outputs.len() as f64;
        let height_mm = ABOVE_MM + count * (row_mm + SPACE_MM) + BELOW_MM;
        let (top, bottom) = (height_mm - ABOVE_MM + 3.0, BELOW_MM - 1.0);
        let (unit, per_si) = self.scene.book.fine(self.cycle.driver.1);
        let ends = self.cycle.ends.map(|x| x * per_si);
        let axis = PlotAxis::of(&ends, unit == "\\degree", 12);
        let small = self.style.small_mm;
        let (low, high) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
        let ticks: Vec<f64> =
            axis.ticks().filter(|t| (low - 1e-9..=high + 1e-9).contains(t)).collect();
        for tick in ticks {
            let x = LEFT_MM + WIDTH_MM * (tick - ends[0]) / (ends[1] - ends[0]);
            self.line("grid", Point::new(x, bottom), Point::new(x, top), GRID);
            let at = Point::new(x, bottom - small - 1.6);
            self.words("number", at, Label::math(axis.name(tick)), small, Anchor::Middle);
        }
        let thin = self.style.thin;
        self.line(
            "axis",
            Point::new(LEFT_MM, bottom),
            Point::new(LEFT_MM + WIDTH_MM, bottom),
            thin,
        );
        let at = Point::new(LEFT_MM + WIDTH_MM / 2.0, bottom - 2.0 * small - 5.5);
        let title = Label::math(super::plot::over(driver, &unit));
        self.words("axis-name", at, title, self.style.caption_mm, Anchor::Middle);
        let outputs = &self.cycle.outputs;
        for (k, output) in outputs.iter().enumerate() {
            let y = height_mm - ABOVE_MM - k as f64 * (row_mm + SPACE_MM) - row_mm;
            self.name(output, y + 0.5 * row_mm);
            fill(self, output, [y, y + row_mm]);
            self.changes(output, y);
        }
        [LEFT_MM + WIDTH_MM + RIGHT_MM, height_mm]
    }

    /// Writes the name of an output at the left of its row, with stroke and time ratio.
    fn name(&mut self, output: &OutputCycle, y: f64) {
        let (caption, small) = (self.style.caption_mm, self.style.small_mm);
        let x = LEFT_MM - 5.0;
        let name = Label::math(symbol(output));
        self.words("name", Point::new(x, y + 0.6), name, caption, Anchor::End);
        let stroke = output.stroke.map(|stroke| self.size(output.kind, stroke));
        let ratio = output.time_ratio.map(|k| format!("K = {}", legible(k, DIGITS)));
        let more: Vec<String> = stroke.into_iter().chain(ratio).collect();
        let label = Label::math(more.join(" ,\\, "));
        self.words("stroke", Point::new(x, y - small - 0.8), label, small, Anchor::End);
    }

    /// Returns the horizontal place of a way.
    fn x(&self, way: f64) -> f64 {
        LEFT_MM + WIDTH_MM * way / self.cycle.length()
    }

    /// Returns the parts of a phase within one cycle, each with the part of the phase it begins and
    /// ends with.
    fn parts(&self, phase: &MotionPhase) -> Vec<([f64; 2], [f64; 2])> {
        let (length, [from, to]) = (self.cycle.length(), phase.span);
        if to <= length * (1.0 + 1e-12) || !self.cycle.repeats {
            return vec![([from, to.min(length)], [0.0, 1.0])];
        }
        let cut = (length - from) / (to - from);
        vec![([from, length], [0.0, cut]), ([0.0, to - length], [cut, 1.0])]
    }

    /// Draws the phases of an output as bars.
    fn bars(&mut self, output: &OutputCycle, [low, high]: [f64; 2]) {
        for phase in &output.phases {
            for ([from, to], part) in self.parts(phase) {
                let [a, b] = [from, to].map(|way| self.x(way));
                self.bar(phase.kind, [a, b], [low, high]);
                let y = 0.5 * (low + high) - 0.35 * self.style.small_mm;
                self.phase_words(phase, part, [a, b], y);
            }
        }
    }

    /// Draws a bar: a box for a stroke, a line for a dwell.
    fn bar(&mut self, kind: PhaseKind, [a, b]: [f64; 2], [low, high]: [f64; 2]) {
        let outline = self.style.outline;
        let fill = match kind {
            PhaseKind::Dwell => {
                return self.line("dwell", Point::new(a, low), Point::new(b, low), outline);
            }
            PhaseKind::Forward => WORKING,
            PhaseKind::Return | PhaseKind::Steady => Colour::WHITE,
        };
        let points = [(a, low), (b, low), (b, high), (a, high)].map(|(x, y)| Point::new(x, y));
        let shape = Shape::Polyline {
            points: points.to_vec(),
            closed: true,
            stroke: Some(outline),
            fill: Some(fill),
        };
        self.draw("phase", shape);
    }

    /// Writes a part of a phase between two places: its word and, in its longer part, its share of
    /// the cycle, as far as both fit.
    fn phase_words(
        &mut self,
        phase: &MotionPhase,
        [start, end]: [f64; 2],
        [a, b]: [f64; 2],
        y: f64,
    ) {
        let (word, size_mm) = (phase.kind.words(self.lang), self.style.small_mm);
        let size = self.number(self.cycle.driver.1, phase.span[1] - phase.span[0]);
        let full = Label::text(format!("{word} ")).then(Label::math(size.as_str()));
        let labels = match phase.kind {
            PhaseKind::Steady => vec![Label::text(word)],
            _ if end - start < 0.5 => vec![Label::text(word)],
            PhaseKind::Forward | PhaseKind::Return | PhaseKind::Dwell => {
                vec![full, Label::text(word), Label::math(size)]
            }
        };
        let free = b - a - 2.0 * GAP_MM;
        let Some(label) = labels.into_iter().find(|l| self.width_mm(l, size_mm) <= free) else {
            return;
        };
        self.words("phase-name", Point::new(0.5 * (a + b), y), label, size_mm, Anchor::Middle);
    }

    /// Draws the phases of an output as straight lines between its extreme positions.
    fn rises(&mut self, output: &OutputCycle, [low, high]: [f64; 2]) {
        let values = || output.phases.iter().flat_map(|p| p.output);
        let (least, most) =
            values().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
        let y = |v: f64| match most > least {
            true => low + (high - low) * (v - least) / (most - least),
            false => low,
        };
        let (thin, vector) = (self.style.thin, self.style.vector);
        for level in [low, high] {
            let [a, b] = [0.0, self.cycle.length()].map(|way| Point::new(self.x(way), level));
            self.line("level", a, b, GRID);
        }
        for phase in &output.phases {
            for ([from, to], [start, end]) in self.parts(phase) {
                let [p, q] = phase.output;
                let at = |way: f64, part: f64| {
                    let steady = phase.kind == PhaseKind::Steady;
                    let height =
                        if steady { low + part * (high - low) } else { y(p + part * (q - p)) };
                    Point::new(self.x(way), height)
                };
                let (a, b) = (at(from, start), at(to, end));
                self.line("phase", a, b, vector);
                for end in [a, b] {
                    self.line("change", Point::new(end.x, low), end, thin);
                }
                // Words are below the line, where it is high enough; a rest at the bottom has them
                // above it.
                let clear = low + WORDS_MM + 1.4 * self.style.small_mm;
                let free = match phase.kind {
                    PhaseKind::Dwell => [a.x, b.x],
                    PhaseKind::Forward | PhaseKind::Return | PhaseKind::Steady => {
                        above(a, b, clear)
                    }
                };
                self.phase_words(phase, [start, end], free, low + WORDS_MM);
            }
        }
    }

    /// Writes the positions of the driver at which the phases of an output change, below its row;
    /// a number that would touch the one before it is a line lower.
    fn changes(&mut self, output: &OutputCycle, low: f64) {
        let size_mm = self.style.small_mm;
        let mut places: Vec<f64> = output
            .phases
            .iter()
            .filter(|p| p.kind != PhaseKind::Steady)
            .flat_map(|p| p.span)
            .map(|way| if self.cycle.repeats { way.rem_euclid(self.cycle.length()) } else { way })
            .collect();
        places.sort_by(f64::total_cmp);
        places.dedup_by(|a, b| *a - *b < 1e-9 * self.cycle.length());
        let mut ends = [f64::NEG_INFINITY; 2];
        for way in places {
            let (label, x) = (self.place(way), self.x(way));
            let half = 0.5 * self.width_mm(&label, size_mm);
            let line = usize::from(x - half < ends[0] + GAP_MM && ends[1] < ends[0]);
            ends[line] = x + half;
            let y = low - (1.25 * line as f64 + 1.0) * size_mm - 1.4;
            self.words("change-place", Point::new(x, y), label, size_mm, Anchor::Middle);
        }
    }

    /// Draws a sample of each kind of phase with its word, centred at a height.
    fn legend(&mut self, y: f64) {
        let all = [PhaseKind::Forward, PhaseKind::Return, PhaseKind::Dwell];
        let has = |kind: &PhaseKind| {
            self.cycle.outputs.iter().flat_map(|o| &o.phases).any(|p| p.kind == *kind)
        };
        let kinds: Vec<PhaseKind> = all.into_iter().filter(has).collect();
        let mut x = LEFT_MM;
        for kind in kinds {
            let (size_mm, height) = (self.style.small_mm, self.style.small_mm);
            self.bar(kind, [x, x + 8.0], [y, y + height]);
            let label = Label::text(kind.words(self.lang));
            let width = self.width_mm(&label, size_mm);
            self.words("legend", Point::new(x + 10.0, y + 0.3), label, size_mm, Anchor::Start);
            x += 10.0 + width + 8.0;
        }
    }

    /// Draws a ring for each output, the first one outside, and the phases in words below; returns
    /// the size.
    fn rings(&mut self, driver: &str) -> [f64; 2] {
        let lines: Vec<String> =
            self.cycle.text(self.scene, self.lang).lines().map(str::to_owned).collect();
        // Title and heading are above.
        let skipped = 1 + usize::from(!self.lang.of(&self.scene.title).is_empty());
        let lines = lines.get(skipped..).unwrap_or_default().to_vec();
        let (small, count) = (self.style.small_mm, self.cycle.outputs.len() as f64);
        let outer = INNER_MM + count * RING_MM;
        let below = 12.0 + lines.len() as f64 * 1.5 * small + 14.0;
        let size = [LEFT_MM + WIDTH_MM + RIGHT_MM, ABOVE_MM + 2.0 * (outer + 9.0) + below];
        let centre = Point::new(size[0] / 2.0, below + outer + 9.0);
        let on = |radius: f64, angle: f64| {
            centre + Vec2::new(libm::cos(angle), libm::sin(angle)) * radius
        };
        // A cycle of several turns is drawn as one.
        let angle = |way: f64| self.cycle.position(way) / self.cycle.length() * TAU;
        let back = self.cycle.ends[1] < self.cycle.ends[0];
        let outline = Shape::Circle { centre, radius_mm: outer, stroke: Some(GRID), fill: None };
        self.draw("outline", outline);
        let outputs = &self.cycle.outputs;
        for (k, output) in outputs.iter().enumerate() {
            let high = outer - k as f64 * RING_MM;
            let low = high - RING_MM;
            for phase in &output.phases {
                let from = angle(phase.span[0]);
                let way = (phase.span[1] - phase.span[0]) / self.cycle.length() * TAU;
                let to = if back { from - way } else { from + way };
                self.sector(phase.kind, centre, [low, high], [from, to]);
            }
            let longest = output
                .phases
                .iter()
                .max_by(|a, b| (a.span[1] - a.span[0]).total_cmp(&(b.span[1] - b.span[0])));
            if let Some(phase) = longest {
                let way = 0.5 * (phase.span[1] - phase.span[0]) / self.cycle.length() * TAU;
                let at =
                    on(0.5 * (low + high), angle(phase.span[0]) + if back { -way } else { way });
                let at = at - Vec2::new(0.0, 0.33 * self.style.label_mm);
                let name = Label::math(symbol(output));
                self.words("name", at, name, self.style.label_mm, Anchor::Middle);
            }
        }
        let (unit, per_si) = self.scene.book.fine(self.cycle.driver.1);
        for k in 0..12 {
            let part = f64::from(k) / 12.0;
            let at = part * TAU;
            self.line("tick", on(outer, at), on(outer + TICK_MM, at), self.style.thin);
            let value = part * self.cycle.length() * per_si;
            let number = shortest(libm::round(value * 1e3) / 1e3);
            let text = if unit == "\\degree" { format!("{number}\\degree") } else { number };
            let place = on(outer + TICK_MM + 5.0, at) - Vec2::new(0.0, 0.35 * small);
            self.words("number", place, Label::math(text), small, Anchor::Middle);
        }
        let head = self.style.thin_head;
        let [from_rad, to_rad] = if back { [1.9, 1.2] } else { [1.2, 1.9] };
        let radius_mm = INNER_MM - 7.0;
        self.draw(
            "sense",
            Shape::ArcArrow { centre, radius_mm, from_rad, to_rad, stroke: self.style.thin, head },
        );
        let at = centre - Vec2::new(0.0, 0.33 * self.style.label_mm);
        self.words("driver", at, Label::math(driver), self.style.label_mm, Anchor::Middle);
        for (k, line) in lines.iter().enumerate() {
            let indent = if line.starts_with(' ') { 6.0 } else { 0.0 };
            let at = Point::new(LEFT_MM + indent, below - 12.0 - (k as f64 + 0.5) * 1.5 * small);
            // A heading begins with the name of its output.
            let heading = outputs.iter().find_map(|o| {
                let written = [o.name.clone(), o.name.replacen("phi", "φ", 1)];
                let rest = written.iter().find_map(|name| line.strip_prefix(name.as_str()))?;
                Some(Label::math(symbol(o)).then(Label::text(rest)))
            });
            let label = heading.unwrap_or_else(|| Label::text(line.trim()));
            self.words("phase-line", at, label, small, Anchor::Start);
        }
        self.legend(5.0);
        size
    }

    /// Draws a part of a ring: filled for a stroke, an arc for a dwell.
    fn sector(
        &mut self,
        kind: PhaseKind,
        centre: Point,
        [low, high]: [f64; 2],
        [from, to]: [f64; 2],
    ) {
        let outline = self.style.outline;
        let fill = match kind {
            PhaseKind::Dwell => {
                let (radius_mm, from_rad, to_rad) = (low, from, to);
                let arc = Shape::Arc { centre, radius_mm, from_rad, to_rad, stroke: outline };
                return self.draw("dwell", arc);
            }
            PhaseKind::Forward => WORKING,
            PhaseKind::Return | PhaseKind::Steady => Colour::WHITE,
        };
        let on = |radius: f64, angle: f64| {
            centre + Vec2::new(libm::cos(angle), libm::sin(angle)) * radius
        };
        let arc =
            |radius_mm, from_rad, to_rad| PathPiece::Arc { centre, radius_mm, from_rad, to_rad };
        let pieces = vec![arc(high, from, to), PathPiece::Line(on(low, to)), arc(low, to, from)];
        let shape = Shape::Path {
            start: on(high, from),
            pieces,
            closed: true,
            stroke: Some(outline),
            fill: Some(fill),
        };
        self.draw("phase", shape);
    }
}
