//! Forces as textbooks draw them: each group's links apart with what acts on them and the arms of its moments, the force polygon, the equations.
//!
//! Decided here: what stands in a row, and how loads differ from reactions: weights thin, inertia dashed, applied loads and reactions full. The places are those
//! of [`Equilibrium`].

mod apart;
mod polygon;

use crate::arrange::{Tree, put_together};
use crate::sheet::{Maker, Options};
use hodograph_board::equilibrium::{Equilibrium, GroupForces, Side, Term};
use hodograph_mechanism::force::Cause;
use hodograph_paper::paper::drawing::Part;
use hodograph_paper::paper::grid::{self, Cell, Row};
use hodograph_paper::paper::item::{Anchor, Dash, Figure, Item, Stroke};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::lines::wrapped;
use hodograph_paper::paper::phrase::Phrase;
use hodograph_paper::paper::style::Style;
use hodograph_report::amount::scale_formula;
use hodograph_report::forces::ForceWriter;
use hodograph_scene::{DiagramKind, Scene};
use hodograph_worked::certified::certify;
use hodograph_worked::worked::Worked;

/// Width of the sentences below a group.
const TEXT_MM: f64 = 190.0;

/// The forces of all groups on one page; `None` where none are drawn.
pub fn forces(scene: &Scene, worked: &Worked, options: &Options) -> Option<Figure> {
    let of = worked.equilibrium.as_ref().filter(|of| !of.groups.is_empty())?;
    let maker = Maker { scene, worked, options, certified: certify(scene, worked, options.digits) };
    let page = Page { maker: &maker, w: ForceWriter { scene, notation: &options.notation, lang: options.lang, of }, of };
    Some(maker.alone(page.all()))
}

/// The free bodies of a group beside its force polygon, without words below; `None` where there is no such group.
pub fn group(scene: &Scene, worked: &Worked, options: &Options, k: usize) -> Option<Figure> {
    let of = worked.equilibrium.as_ref()?;
    let maker = Maker { scene, worked, options, certified: Vec::new() };
    let page = Page { maker: &maker, w: ForceWriter { scene, notation: &options.notation, lang: options.lang, of }, of };
    let part = page.drawings(of.groups.get(k)?);
    Some(maker.alone(named(part, k)))
}

/// For each group its drawings and what is written of it, as parts of a sheet.
pub(crate) fn pieces(maker: &Maker, width_mm: f64) -> Vec<[Part; 2]> {
    let Some(of) = &maker.worked.equilibrium else { return Vec::new() };
    let Maker { scene, options, .. } = *maker;
    let page = Page { maker, w: ForceWriter { scene, notation: &options.notation, lang: options.lang, of }, of };
    let of_group = |(k, group)| [named(page.drawings(group), k), named(page.words(group, width_mm), k)];
    of.groups.iter().enumerate().map(of_group).collect()
}

struct Page<'a> {
    maker: &'a Maker<'a>,
    w: ForceWriter<'a>,
    of: &'a Equilibrium,
}

impl Page<'_> {
    fn style(&self) -> &Style {
        &self.maker.options.style
    }

    fn all(&self) -> Part {
        let parts: Vec<Part> = self.of.groups.iter().enumerate().map(|(k, group)| self.row(k, group)).collect();
        put_together(Tree::text_column((0..parts.len()).map(Tree::Leaf).collect()), parts)
    }

    /// A group: its links apart beside its polygon, what is said of it below.
    fn row(&self, k: usize, group: &GroupForces) -> Part {
        let parts = vec![self.drawings(group), self.words(group, TEXT_MM)];
        named(put_together(Tree::text_column((0..parts.len()).map(Tree::Leaf).collect()), parts), k)
    }

    /// Moments, equations and results of a group.
    fn words(&self, group: &GroupForces, width_mm: f64) -> Part {
        let tables: Vec<Part> = self.w.equations(group).iter().enumerate().map(|(k, sides)| self.table(sides, k)).collect();
        let text = |sentences: &[Phrase], name| self.text(sentences, name, width_mm);
        let (before, after) = (text(&self.w.before(group), "moments"), text(&self.w.after(group), "results"));
        let parts: Vec<Part> = std::iter::once(before).chain(tables).chain([after]).filter(|p| !p.items.is_empty()).collect();
        put_together(Tree::text_column((0..parts.len()).map(Tree::Leaf).collect()), parts)
    }

    /// The links apart beside the polygon, with their captions.
    fn drawings(&self, group: &GroupForces) -> Part {
        let options = self.maker.options;
        let words = self.w.heading(group);
        let scale = scale_formula(&self.maker.scene.book, DiagramKind::Force, self.of.mu());
        let plane = scale_formula(&self.maker.scene.book, DiagramKind::Plane, self.maker.worked.construction.diagram.mu);
        let links = self.maker.titled(self.apart(group), Phrase::new(&words).label(), &plane, "apart");
        let caption = DiagramKind::Force.caption(options.lang);
        let polygon = self.maker.titled(self.polygon(group), Phrase::new(caption).label(), &scale, "polygon");
        put_together(Tree::row(vec![Tree::Leaf(0), Tree::Leaf(1)]), vec![links, polygon])
    }

    /// An equation of forces over its table of magnitudes and directions.
    fn table(&self, sides: &[Side], k: usize) -> Part {
        let options = self.maker.options;
        let (style, words) = (self.style(), self.maker.words());
        let columns = self.w.columns(sides);
        let cell = |label: Label, id: String| {
            Some(Cell {
                label: label.in_fonts(&style.fonts),
                size_mm: style.small_mm,
                anchor: Anchor::Middle,
                class: "equation".into(),
                id,
            })
        };
        let line = |first: Label, of: &dyn Fn(usize) -> String, name: &str| Row {
            cells: std::iter::once(cell(first, format!("{name}-{}", k + 1)))
                .chain((0..columns.len()).map(|c| cell(Label::math(of(c)), format!("{name}-{}-{}", k + 1, c + 1))))
                .collect(),
            height_mm: style.small_mm * 1.9,
        };
        let symbols = |c: usize| match c {
            c if c + 1 == columns.len() => format!("{} = 0", columns[c].symbol),
            c => format!("{} +", columns[c].symbol),
        };
        let (known, unknown) = (&options.notation.known, &options.notation.unknown);
        let magnitude = |c: usize| if columns[c].magnitude { known.clone() } else { unknown.clone() };
        let rows = [
            line(Label::text(""), &symbols, "equation"),
            line(Label::text(words.magnitude), &magnitude, "magnitude"),
            line(Label::text(words.direction), &|_| known.clone(), "direction"),
        ];
        Part::of(grid::set(&rows, 3.0))
    }

    /// Sentences, one below the other.
    fn text(&self, sentences: &[Phrase], name: &str, width_mm: f64) -> Part {
        let style = self.style();
        let lines = sentences.iter().flat_map(|s| wrapped(s, width_mm, style.small_mm, &style.fonts));
        let row = |(k, label): (usize, Label)| Row {
            cells: vec![Some(Cell {
                label: label.in_fonts(&style.fonts),
                size_mm: style.small_mm,
                anchor: Anchor::Start,
                class: "note".into(),
                id: format!("{name}-{}", k + 1),
            })],
            height_mm: style.small_mm * 1.9,
        };
        Part::of(grid::set(&lines.enumerate().map(row).collect::<Vec<_>>(), 0.0))
    }

    /// The stroke of a force by what it is.
    fn stroke(&self, term: Term) -> Stroke {
        let vector = self.style().vector;
        let thin = Stroke { width_mm: vector.width_mm * 0.7, ..vector };
        match term {
            Term::Load(k) => match self.of.loads[k].cause {
                Cause::Weight => thin,
                Cause::Inertia => thin.dashed(Dash::Dashed),
                Cause::Applied(_) | Cause::Spring(_) | Cause::Balance | Cause::Teeth(_) | Cause::Friction(_) => vector,
            },
            Term::Reaction { .. } => vector,
        }
    }

    /// The name of a force in ids, alike in all languages and notations.
    fn key(&self, term: Term) -> String {
        self.w.plain(term).replace('_', "-")
    }
}

/// A part whose items have names of their own.
fn named(mut part: Part, k: usize) -> Part {
    let name = |item: &mut Item| {
        if !item.id.is_empty() {
            item.id = format!("group-{}-{}", k + 1, item.id);
        }
    };
    part.items.iter_mut().for_each(name);
    part
}
