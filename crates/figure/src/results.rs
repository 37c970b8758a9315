//! The results: for each question the measured length, the scale, the value with unit and sense;
//! then the difference between drawing and loop equations.

use hodograph_base::digits::inked;
use hodograph_base::lang::say;
use hodograph_base::notation::Notation;
use hodograph_board::construct::ShownAs;
use hodograph_board::plan::text::PlanWriter;
use hodograph_board::plan::{Rate, TurningBody};
use hodograph_mechanism::answer::AnswerValue;
use hodograph_methods::centres::{Centre, CentrePlace, Centres, Origin, centres};
use hodograph_paper::paper::phrase::{Phrase, fill};
use hodograph_report::answers::{AnswerLine, at_infinity, lines as by_question, reason, verdict};
use hodograph_report::centres as report_of_centres;
use hodograph_report::drafting::{self, ToleranceAmount};
use hodograph_scene::{Asked, Book, DiagramKind, Find, Kind, Scene};
use hodograph_worked::certified::ladder::{
    Certified, CertifiedNumber, MissingDigits, READING_DIGITS,
};
use hodograph_worked::worked::{Outcome, Worked};

use hodograph_report::amount::{amount, number, sense, symbol};

use super::remarks::{agreement, pencil, remarks};
use hodograph_paper::paper::drawing;
use hodograph_paper::paper::grid::{self, Cell, Row};
use hodograph_paper::paper::item::Anchor;
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::lines::wrapped;
use hodograph_paper::paper::shown::question_id;
use hodograph_paper::paper::style::{Captioned, Style};
use hodograph_paper::paper::words::Words;

/// Distance of the rows' baselines: subscripts of one must not touch superscripts of the next.
const ROW_MM: f64 = 6.4;
/// Distance from the first row up to the heading.
const HEADING_MM: f64 = 2.2;
/// Distance of a value below the measured length, as a part of the row distance.
const BELOW: f64 = 0.9;
/// Distance of the lines of remarks below.
const REMARK_MM: f64 = 5.2;
/// Gap between columns.
const GAP_MM: f64 = 1.8;
/// Default number of digits: one more than a ruler gives, so that rounding is not mistaken for the
/// drawing's error.
pub const DIGITS: usize = 4;

/// The content of the block of results.
pub struct ResultsContent<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The answers.
    pub worked: &'a Worked,
    /// The number of certain digits of each answer.
    pub certified: &'a [Certified],
    /// The notation.
    pub notation: &'a Notation,
    /// The words of the language.
    pub words: &'static Words,
    /// The requested number of significant digits.
    pub digits: usize,
}

impl<'a> ResultsContent<'a> {
    fn writer(&self) -> PlanWriter<'a> {
        PlanWriter {
            scene: self.scene,
            plan: &self.worked.plan,
            notation: self.notation,
            lang: self.words.lang(),
        }
    }
}

/// Draws the block of results.
pub fn results(style: &Style, answers: &ResultsContent) -> drawing::DrawingPart {
    block(style, answers, None)
}

/// Draws the block of results in a column of this width; the `bool` is true if it is complete.
/// Remarks take more lines; if that is not enough, values are below the measured lengths, and at
/// last these are left out.
pub fn results_in(
    style: &Style,
    answers: &ResultsContent,
    width_mm: f64,
) -> (drawing::DrawingPart, bool) {
    let set = |measured| block(style, answers, Some(ResultColumn { width_mm, measured }));
    let tries = [LengthPlace::Before, LengthPlace::Above]
        .map(set)
        .into_iter()
        .find(|part| part.bounds.width_mm() <= width_mm);
    match tries {
        Some(whole) => (whole, true),
        None => (set(LengthPlace::Nowhere), false),
    }
}

/// A narrow column of results.
#[derive(Clone, Copy)]
struct ResultColumn {
    width_mm: f64,
    measured: LengthPlace,
}

/// The place of the measured lengths.
#[derive(Clone, Copy, PartialEq)]
enum LengthPlace {
    /// Before the value in the same row.
    Before,
    /// In a separate row, with the value below.
    Above,
    /// Left out.
    Nowhere,
}

/// The block; in a column, remarks are broken to its width.
fn block(
    style: &Style,
    answers: &ResultsContent,
    column: Option<ResultColumn>,
) -> drawing::DrawingPart {
    let ResultsContent { scene, worked, certified, notation, words, digits } = *answers;
    let row_mm = style.leading(ROW_MM);
    let placed = column.map_or(LengthPlace::Before, |c| c.measured);
    let heading = Cell {
        label: Phrase::new(style.captions.of(Captioned::Results, words.lang()))
            .label()
            .in_fonts(&style.fonts),
        size_mm: style.caption_mm,
        anchor: Anchor::Start,
        class: "result heading".into(),
        id: "heading-results".into(),
    };
    let mut rows = Vec::new();
    let mut lines = Vec::new();
    let centres = drawn_centres(scene);
    for line in by_question(worked, certified) {
        let (r, c) = match line {
            AnswerLine::Answer(r, c) => (r, c),
            AnswerLine::InfiniteCentre(far) => {
                rows.push(words_row(
                    style,
                    notation,
                    &scene.find[far.find],
                    &at_infinity(far, words.lang()),
                ));
                continue;
            }
            AnswerLine::None(u) => {
                let find = &scene.find[u.find];
                rows.push(words_row(style, notation, find, verdict(u, words.lang())));
                let why = reason(scene, u, words.lang());
                if !lines.iter().any(|(_, _, told): &(_, _, Phrase)| *told == Phrase::new(&why)) {
                    lines.push(("remark", format!("remark-{}", find.text), Phrase::new(&why)));
                }
                continue;
            }
        };
        let find = &scene.find[r.find];
        // A singular pose is stated once for all answers, below.
        if let Some(why) = c.why.as_ref().filter(|w| !matches!(w, MissingDigits::NextOrder(_))) {
            let symbol = format!("${}$", symbol(find, notation));
            let text = fill(words.uncertain, &[("", &symbol), ("why", &why.words(words.lang()))]);
            lines.push(("remark", format!("remark-{}", find.text), Phrase::new(&text)));
        }
        let id = format!("result-{}", question_id(&find.text));
        let cell = |text: Label, anchor, what: &str| {
            Some(cell(style, text, anchor, format!("{id}-{what}")))
        };
        let sign = |what: &str| cell(Label::math("="), Anchor::Middle, what);
        let value = r.value();
        // If nothing moves, there is no polygon to measure.
        let nothing = worked.construction.is_empty(find.what.diagram());
        let by_lines = || by_lines(centres.as_ref()?, find, words);
        let measured = if placed == LengthPlace::Nowhere {
            None
        } else if let Some(read) = by_lines() {
            Some(read)
        } else if nothing {
            None
        } else {
            measured(&scene.book, r, c, find, words).or_else(|| as_another(answers, find))
        };
        let name = || cell(Label::math(named(&answers.writer(), find, r)), Anchor::Start, "symbol");
        let found = Label::math(amount(&scene.book, find, value, c, digits));
        let towards = sense(find, value, c, words, digits);
        let sure = tolerance(&scene.book, worked, r, find);
        if placed == LengthPlace::Above {
            // Value, sense and tolerance run on, so that no column is wider than its content.
            let gap = || Label::math("\\quad");
            let whole = [Some(towards), sure]
                .into_iter()
                .flatten()
                .fold(found, |line, next| line.then(gap()).then(next));
            let mut row = |first, from, what: &str| {
                let (height_mm, what_is) =
                    if first { (row_mm, "is") } else { (BELOW * row_mm, "equals") };
                let cells = vec![
                    if first { name() } else { None },
                    sign(what_is),
                    cell(from, Anchor::Start, what),
                ];
                rows.push(Row { cells, height_mm });
            };
            let above = measured.is_some();
            if let Some(read) = measured {
                row(true, read, "measured");
            }
            row(!above, whole, "value");
            continue;
        }
        let [from, equals] = match measured {
            Some(m) => [cell(m, Anchor::Start, "measured"), sign("equals")],
            None => [None, None],
        };
        // Without a measurement the value follows the first sign, so that the column of values
        // stays aligned.
        let first = if from.is_some() { sign("is") } else { None };
        let second = equals.or_else(|| sign("is"));
        rows.push(Row {
            cells: vec![
                name(),
                first,
                from,
                second,
                cell(found, Anchor::Start, "value"),
                cell(towards, Anchor::Start, "sense"),
                sure.and_then(|t| cell(t, Anchor::Start, "tolerance")),
            ],
            height_mm: row_mm,
        });
    }
    let mut items = grid::set(&rows, GAP_MM);
    items.extend(grid::set(
        &[Row { cells: vec![Some(heading)], height_mm: -style.leading(HEADING_MM) }],
        0.0,
    ));
    // Tolerances take longer than the rest of a figure that moves.
    let tolerances = if style.memory.is_none() { pencil(answers) } else { Vec::new() };
    let others = tolerances.into_iter().chain(remarks(answers)).enumerate();
    lines.extend(others.map(|(k, remark)| ("remark", format!("remark-{}", k + 1), remark)));
    lines.extend(
        centres
            .as_ref()
            .and_then(|found| crossings_agree(found, scene, worked, words))
            .map(|text| ("agreement", "centres".into(), text)),
    );
    lines.extend(agreement(worked, words).map(|text| ("agreement", "agreement".into(), text)));
    let mut below = rows.iter().map(|r| r.height_mm).sum::<f64>() + 1.1 * row_mm;
    for (class, id, line) in lines {
        let labels = match column {
            Some(ResultColumn { width_mm, .. }) => {
                wrapped(&line, width_mm, style.small_mm, &style.fonts)
            }
            None => vec![line.label().in_fonts(&style.fonts)],
        };
        for (k, label) in labels.into_iter().enumerate() {
            let id = if k == 0 { id.clone() } else { format!("{id}-{}", k + 1) };
            let cell = Cell {
                label,
                size_mm: style.small_mm,
                anchor: Anchor::Start,
                class: class.into(),
                id,
            };
            items.extend(grid::set(&[Row { cells: vec![Some(cell)], height_mm: below }], 0.0));
            below += style.leading(REMARK_MM);
        }
    }
    drawing::DrawingPart::of(items)
}

/// Returns the drawing of the centres, if a question asks for one of them.
pub fn drawn_centres(scene: &Scene) -> Option<Centres> {
    let asks = scene.find.iter().any(|f| matches!(f.what, Asked::InstantCentre(_)));
    asks.then(|| centres(scene).ok()).flatten().map(|found| found.value)
}

/// The centre that a question asks for, if the ruler finds it: by its pair, or by two lines.
fn by_ruler<'a>(found: &'a Centres, find: &Find) -> Option<&'a Centre> {
    let Asked::InstantCentre(q) = find.what else { return None };
    let c = found.of(q.links[0].0, q.links[1].0)?;
    matches!(c.origin, Some(Origin::Pair | Origin::Crossing(_))).then_some(c)
}

/// Returns the lines by which the ruler finds a centre: `23·34 × 12·14`.
pub fn by_lines(found: &Centres, find: &Find, words: &Words) -> Option<Label> {
    let c = by_ruler(found, find)?;
    let told = report_of_centres::CentreWords::new(found, words.lang());
    Some(told.found_by(c).label())
}

/// Returns the agreement between the centres that the ruler finds and those from the velocities of
/// the loop equations, in digits relative to the mechanism's size.
pub fn crossings_agree(
    found: &Centres,
    scene: &Scene,
    worked: &Worked,
    words: &Words,
) -> Option<Phrase> {
    let size = worked.configuration.extent();
    let off = |r: &Outcome| {
        let (Some(CentrePlace::At(at)), AnswerValue::Point(p)) =
            (by_ruler(found, &scene.find[r.find])?.place, r.computed)
        else {
            return None;
        };
        Some(at.distance(p) / (size + p.to_vec2().norm()))
    };
    let worst = worked.results.iter().filter_map(off).reduce(f64::max)?;
    let digits =
        if worst < 1e-15 { 15 } else { (-libm::ceil(libm::log10(worst))).max(0.0) as usize };
    Some(Phrase::new(&say!(
        words.lang(),
        "Centres by lines and by the velocities of the loop equations agree to {digits} digits."
    )))
}

/// A cell of the list.
fn cell(style: &Style, label: Label, anchor: Anchor, id: String) -> Cell {
    Cell {
        label: label.in_fonts(&style.fonts),
        size_mm: style.caption_mm,
        anchor,
        class: "result".into(),
        id,
    }
}

/// Returns all results in one sentence, for readers who cannot see the figure.
pub fn sentence(answers: &ResultsContent) -> String {
    let ResultsContent { scene, worked, certified, notation, words, digits } = *answers;
    let each = by_question(worked, certified).into_iter().map(|line| {
        let (r, c) = match line {
            AnswerLine::Answer(r, c) => (r, c),
            AnswerLine::InfiniteCentre(far) => {
                return format!(
                    "{}: {}",
                    Label::math(symbol(&scene.find[far.find], notation)).plain(),
                    at_infinity(far, words.lang())
                );
            }
            AnswerLine::None(u) => {
                return format!(
                    "{}: {}",
                    Label::math(symbol(&scene.find[u.find], notation)).plain(),
                    verdict(u, words.lang())
                );
            }
        };
        let find = &scene.find[r.find];
        let value = r.value();
        let plain = format!(
            "{} = {} ",
            named(&answers.writer(), find, r),
            amount(&scene.book, find, value, c, digits)
        );
        let text = Label::math(plain)
            .then(Label::text(" "))
            .then(sense(find, value, c, words, digits))
            .plain();
        text.split_whitespace().collect::<Vec<_>>().join(" ")
    });
    each.collect::<Vec<_>>().join("; ")
}

/// A row for a question with an answer in words.
fn words_row(style: &Style, notation: &Notation, find: &Find, words: &str) -> Row {
    let (id, symbol) = (format!("result-{}", question_id(&find.text)), symbol(find, notation));
    let cell =
        |text: Label, anchor, what: &str| Some(cell(style, text, anchor, format!("{id}-{what}")));
    Row {
        cells: vec![
            cell(Label::math(symbol.as_str()), Anchor::Start, "symbol"),
            None,
            None,
            cell(Label::math(":"), Anchor::Middle, "is"),
            cell(Label::text(words), Anchor::Start, "value"),
        ],
        height_mm: style.leading(ROW_MM),
    }
}

/// Returns the symbol of an answer: the question's, followed by the symbol in the drawing if the
/// vector has another name there: `v_{CB} = v_C`, `v^{r}_{B2B3} = −v^{r}_{B3B2}`.
pub fn named(w: &PlanWriter, find: &Find, r: &Outcome) -> String {
    let asked = symbol(find, w.notation);
    let on = find.what.diagram();
    let Some(shown) =
        r.drawn.as_ref().and_then(|d| d.measured.as_ref()).and_then(|m| m.shown.as_ref())
    else {
        return asked;
    };
    let drawn = match &shown.vector {
        ShownAs::Image(v) => w.vector(on, *v),
        ShownAs::Edges(terms) => {
            terms.iter().map(|t| w.symbol(on, t)).collect::<Vec<_>>().join(" + ")
        }
    };
    match (drawn == asked, shown.reversed) {
        (true, false) => asked,
        (_, false) => format!("{asked} = {drawn}"),
        (_, true) if drawn.contains(" + ") => format!("{asked} = −({drawn})"),
        (_, true) => format!("{asked} = −{drawn}"),
    }
}

/// The tolerance of drawing by hand: `± 0.62 %`; `None` if it is not requested, and for given
/// values.
fn tolerance(book: &Book, worked: &Worked, r: &Outcome, find: &Find) -> Option<Label> {
    let t = worked.drafting.as_ref()?.tolerances[r.find].as_ref()?;
    let number = |value| number(value, drafting::DIGITS);
    Some(match drafting::amount(book, find, t)? {
        ToleranceAmount::Percent(value) => {
            Label::math(format!("\\pm\\,{}", number(value))).then(Label::text(" %"))
        }
        ToleranceAmount::Of(kind, value) => {
            Label::math(book.label(kind, &format!("\\pm\\,{}", number(value))))
        }
    })
}

/// `ω_2`, for a link that turns with the same angular velocity as another.
fn as_another(answers: &ResultsContent, find: &Find) -> Option<Label> {
    let link = find.what.meaning(answers.scene)?.turning_of()?;
    let on = find.what.diagram();
    let other = answers.worked.plan.steps(on).iter().flat_map(|g| &g.rates).find_map(
        |(body, rate)| match (body, rate) {
            (TurningBody::Link(l), Rate::Same(other)) if *l == link => Some(*other),
            (TurningBody::Link(_) | TurningBody::Cylinder(_), _) => None,
        },
    );
    Some(Label::math(answers.writer().turning(on, TurningBody::Link(other?))))
}

/// Returns the reading of the ruler: `48.32 mm · μ_v`; for angular velocities and accelerations
/// divided by the link's length.
pub fn measured(
    book: &Book,
    r: &Outcome,
    c: &Certified,
    find: &Find,
    words: &Words,
) -> Option<Label> {
    let on = find.what.diagram();
    if on == DiagramKind::Plane {
        return None;
    }
    let Some(drawn) = &r.drawn else {
        return Some(Label::text(if r.longer.is_some() { words.longer } else { words.computed }));
    };
    let measured = drawn.measured.as_ref()?;
    let mm = measured.length_mm;
    // A ruler cannot read less than a thousandth of a millimetre.
    let certain =
        |n: Option<&CertifiedNumber>| n.and_then(|n| n.text(READING_DIGITS)).map(|t| inked(&t.0));
    let mm_text = match certain(c.reading.as_ref().map(|r| &r.length_mm)) {
        Some(text) => text,
        None if mm < 1e-3 => "0".to_owned(),
        None => number(mm, DIGITS),
    };
    let read = format!("{mm_text} mm \\cdot \\mu_{}", on.letter());
    Some(Label::math(match measured.arm_m {
        Some(length) => {
            let arm = certain(c.reading.as_ref().and_then(|r| r.arm.as_ref()));
            let arm = arm.unwrap_or_else(|| number(book.value(Kind::Length, length), DIGITS));
            format!("{read} / {}", book.label(Kind::Length, &arm))
        }
        None => read,
    }))
}
