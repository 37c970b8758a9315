//! Draws forces as textbooks do: for each group the separated links with the forces on them and the
//! arms of their moments, the force polygon, and the equations.
//!
//! This module arranges the rows and distinguishes loads from reactions: weights are thin, inertia
//! forces dashed, applied loads and reactions full. The positions are those of [`Equilibrium`].

mod apart;
mod given;
mod lever;
mod polygon;

pub use lever::{lever, zhukovsky};

use crate::arrange::{Tree, put_together};
use crate::scales::DrawingScales;
use crate::sheet::{SheetDrafter, SheetOptions};
use hodograph_board::equilibrium::{Act, Equilibrium, ForceEdge, ForceTerm, GroupForces};
use hodograph_mechanism::force::Cause;
use hodograph_paper::paper::drawing::{Drawing, DrawingPart};
use hodograph_paper::paper::grid::{self, Cell, Row};
use hodograph_paper::paper::item::{Anchor, Dash, Figure, FigureItem, LineStroke};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::lines::wrapped;
use hodograph_paper::paper::phrase::Phrase;
use hodograph_paper::paper::style::Style;
use hodograph_report::forces::{ForceColumn, ForceWriter};
use hodograph_scene::{DiagramKind, LinkId, Scene};
use hodograph_worked::certified::certify;
use hodograph_worked::worked::Worked;
use std::ops::Range;

/// Width of the sentences below a group.
const TEXT_MM: f64 = 190.0;
/// Width of the sentences beside the drawings of a sheet.
const BESIDE_MM: f64 = 110.0;
/// Gap between a table and the next lines, in addition to their own gaps.
const TABLE_AIR_MM: f64 = 0.1;

/// Draws the forces of all groups on one page; `None` if no forces are drawn.
pub fn forces(scene: &Scene, worked: &Worked, options: &SheetOptions) -> Option<Figure> {
    let of = worked.equilibrium.as_ref().filter(|of| !of.groups.is_empty())?;
    let maker =
        SheetDrafter { scene, worked, options, certified: certify(scene, worked, options.digits) };
    let page = ForcePage::of(&maker, of);
    Some(maker.alone(page.all()))
}

/// Draws the free bodies of a group beside its force polygon, without text below; `None` if there
/// is no such group.
pub fn group(scene: &Scene, worked: &Worked, options: &SheetOptions, k: usize) -> Option<Figure> {
    on_page(scene, worked, options, |page| {
        let group = page.of.groups.get(k)?;
        let part = beside(page.links_apart(group), page.force_polygon(group));
        Some(page.maker.alone(named(part, k)))
    })
}

/// Returns for each group its separated links, its polygon and its text as parts of a sheet; tables
/// are broken to a given width.
pub(crate) fn pieces(maker: &SheetDrafter, width_mm: Option<f64>) -> Vec<[DrawingPart; 3]> {
    let Some(of) = &maker.worked.equilibrium else { return Vec::new() };
    let page = ForcePage::of(maker, of);
    let parts = |group| {
        [page.links_apart(group), page.force_polygon(group), page.words(group, BESIDE_MM, width_mm)]
    };
    of.groups.iter().enumerate().map(|(k, group)| parts(group).map(|part| named(part, k))).collect()
}

/// The steps of a group's equilibrium as drawings.
pub(crate) struct GroupForceSteps {
    /// The separated links, with their caption.
    pub apart: DrawingPart,
    /// The force polygon, with its caption.
    pub polygon: DrawingPart,
    /// The sentence of each step.
    pub sentences: Vec<Phrase>,
    /// For each sentence, the equation to which its step adds a term.
    pub equations: Vec<Option<DrawingPart>>,
}

/// Returns the steps of all groups, with equations broken to a given width.
pub(crate) fn steps(maker: &SheetDrafter, width_mm: Option<f64>) -> Vec<GroupForceSteps> {
    let Some(of) = &maker.worked.equilibrium else { return Vec::new() };
    let page = ForcePage::of(maker, of);
    let of_group = |group| GroupForceSteps {
        apart: page.links_apart(group),
        polygon: page.force_polygon(group),
        sentences: page.w.steps(group),
        equations: page.equations_of_steps(group, width_mm.unwrap_or(f64::INFINITY)),
    };
    of.groups.iter().map(of_group).collect()
}

/// Adds the given loads to the drawing of the mechanism.
pub fn given_loads(scene: &Scene, worked: &Worked, options: &SheetOptions, d: &mut Drawing) {
    on_page(scene, worked, options, |page| {
        page.given_loads(d);
        Some(())
    });
}

/// Draws a group's links in position with the forces on them, before labels are placed; `None` if
/// the pose does not draw the group.
pub fn free_bodies(
    scene: &Scene,
    worked: &Worked,
    options: &SheetOptions,
    links: &[LinkId],
) -> Option<Drawing> {
    on_page(scene, worked, options, |page| Some(page.apart(page.of.group_of(links)?)))
}

/// Draws the force polygon of a group, before labels are placed; `None` if the pose does not draw
/// the group.
pub fn polygon(
    scene: &Scene,
    worked: &Worked,
    options: &SheetOptions,
    links: &[LinkId],
) -> Option<Drawing> {
    on_page(scene, worked, options, |page| Some(page.polygon(page.of.group_of(links)?)))
}

fn on_page<T>(
    scene: &Scene,
    worked: &Worked,
    options: &SheetOptions,
    made: impl FnOnce(&ForcePage) -> Option<T>,
) -> Option<T> {
    let of = worked.equilibrium.as_ref()?;
    made(&ForcePage::of(&SheetDrafter { scene, worked, options, certified: Vec::new() }, of))
}

/// Returns the width (mm) of the widest drawing of a group's separated links.
pub(crate) fn widest_mm(scene: &Scene, worked: &Worked, options: &SheetOptions) -> f64 {
    let widths = |page: &ForcePage| {
        page.of
            .groups
            .iter()
            .map(|group| page.links_apart(group).bounds.width_mm())
            .fold(0.0, f64::max)
    };
    on_page(scene, worked, options, |page| Some(widths(page))).unwrap_or(0.0)
}

/// Places two parts side by side.
fn beside(left: DrawingPart, right: DrawingPart) -> DrawingPart {
    put_together(Tree::row(vec![Tree::Leaf(0), Tree::Leaf(1)]), vec![left, right])
}

struct ForcePage<'a> {
    maker: &'a SheetDrafter<'a>,
    w: ForceWriter<'a>,
    of: &'a Equilibrium,
}

impl<'a> ForcePage<'a> {
    fn of(maker: &'a SheetDrafter<'a>, of: &'a Equilibrium) -> ForcePage<'a> {
        let SheetOptions { notation, lang, .. } = maker.options;
        ForcePage { maker, w: ForceWriter { scene: maker.scene, notation, lang: *lang, of }, of }
    }

    fn style(&self) -> &Style {
        &self.maker.options.style
    }

    fn all(&self) -> DrawingPart {
        let parts: Vec<DrawingPart> =
            self.of.groups.iter().enumerate().map(|(k, group)| self.row(k, group)).collect();
        put_together(Tree::text_column((0..parts.len()).map(Tree::Leaf).collect()), parts)
    }

    /// A group: its separated links beside its polygon, the text below.
    fn row(&self, k: usize, group: &GroupForces) -> DrawingPart {
        let parts = vec![
            beside(self.links_apart(group), self.force_polygon(group)),
            self.words(group, TEXT_MM, None),
        ];
        named(put_together(Tree::text_column((0..parts.len()).map(Tree::Leaf).collect()), parts), k)
    }

    /// Moments, equations and results of a group: sentences in the given width; tables in their
    /// natural width or broken to the available width.
    fn words(&self, group: &GroupForces, width_mm: f64, room_mm: Option<f64>) -> DrawingPart {
        let room_mm = room_mm.unwrap_or(f64::INFINITY);
        let tables = self
            .w
            .equations(group)
            .iter()
            .enumerate()
            .flat_map(|(k, sides)| self.table(sides, k, room_mm))
            .collect::<Vec<_>>();
        let text = |sentences: &[Phrase], name| self.text(sentences, name, width_mm.min(room_mm));
        let (before, after) =
            (text(&self.w.before(group), "moments"), text(&self.w.after(group), "results"));
        let parts: Vec<DrawingPart> = std::iter::once(before)
            .chain(tables)
            .chain([after])
            .filter(|p| !p.items.is_empty())
            .collect();
        let lines = (0..parts.len()).flat_map(|k| [Tree::Leaf(k), Tree::Air(TABLE_AIR_MM)]);
        put_together(
            Tree::text_column(lines.take((2 * parts.len()).saturating_sub(1)).collect()),
            parts,
        )
    }

    /// The separated links of a group, with their caption.
    fn links_apart(&self, group: &GroupForces) -> DrawingPart {
        let words = self.w.heading(group);
        let scale = DrawingScales::of(
            &self.maker.scene.book,
            DiagramKind::Plane,
            self.maker.worked.construction.diagram.mu,
        );
        self.maker.titled(self.apart(group).finish(), Phrase::new(&words).label(), &scale, "apart")
    }

    /// The force polygon of a group, with its caption.
    fn force_polygon(&self, group: &GroupForces) -> DrawingPart {
        let scale = DrawingScales::of(&self.maker.scene.book, DiagramKind::Force, self.of.mu());
        let caption = DiagramKind::Force.caption(self.maker.options.lang);
        self.maker.titled(
            self.polygon(group).finish(),
            Phrase::new(caption).label(),
            &scale,
            "polygon",
        )
    }

    /// An equation of forces over its table of magnitudes and directions, in as few tables as fit
    /// the width.
    fn table(&self, sides: &[ForceEdge], k: usize, width_mm: f64) -> Vec<DrawingPart> {
        let columns = self.w.columns(sides);
        let tables = |pieces: usize| -> Vec<DrawingPart> {
            let length = columns.len().div_ceil(pieces);
            let ranges = (0..columns.len())
                .step_by(length.max(1))
                .map(|start| start..columns.len().min(start + length));
            ranges.map(|range| self.table_of(&columns, range, k)).collect()
        };
        let fits =
            |parts: &[DrawingPart]| parts.iter().all(|part| part.bounds.width_mm() <= width_mm);
        (1..=columns.len()).map(tables).find(|parts| fits(parts)).unwrap_or_else(|| tables(1))
    }

    /// For each step of a group, the table of the equation to which it adds a term.
    fn equations_of_steps(&self, group: &GroupForces, width_mm: f64) -> Vec<Option<DrawingPart>> {
        let equations = self.w.equations(group);
        let part = |k: usize| {
            let tables = self.table(&equations[k], k, width_mm);
            put_together(Tree::text_column((0..tables.len()).map(Tree::Leaf).collect()), tables)
        };
        let parts: Vec<DrawingPart> = (0..equations.len()).map(part).collect();
        let with = |found: &dyn Fn(&ForceEdge) -> bool| {
            equations.iter().position(|sides| sides.iter().any(found)).map(|k| parts[k].clone())
        };
        let ends_in = |side: &ForceEdge, mark| {
            let v = &self.of.construction.vectors[side.vector.index()];
            !side.known && [v.from, v.to].contains(&mark)
        };
        let of_act = |act: &Act| match act {
            Act::Lay(own) | Act::Read(own) => with(&|s| s.vector == own.vector),
            Act::Cross(to) => with(&|s| ends_in(s, *to)),
            Act::Free | Act::Friction | Act::Moments(_) => None,
        };
        self.of.acts(group).iter().map(of_act).collect()
    }

    fn table_of(&self, columns: &[ForceColumn], range: Range<usize>, k: usize) -> DrawingPart {
        let options = self.maker.options;
        let (style, words) = (self.style(), self.maker.words());
        let first = range.start == 0;
        let cell = |label: Label, id: String| {
            Some(Cell {
                label: label.in_fonts(&style.fonts),
                size_mm: style.small_mm,
                anchor: Anchor::Middle,
                class: "equation".into(),
                id,
            })
        };
        let line = |head: &str, of: &dyn Fn(usize) -> String, name: &str| Row {
            cells: std::iter::once(if first {
                cell(Label::text(head), format!("{name}-{}", k + 1))
            } else {
                None
            })
            .chain(
                range
                    .clone()
                    .map(|c| cell(Label::math(of(c)), format!("{name}-{}-{}", k + 1, c + 1))),
            )
            .collect(),
            height_mm: style.small_mm * 1.9,
        };
        let symbols = |c: usize| match c {
            c if c + 1 == columns.len() => format!("{} = 0", columns[c].symbol),
            c => format!("{} +", columns[c].symbol),
        };
        let (known, unknown) = (&options.notation.known, &options.notation.unknown);
        let magnitude =
            |c: usize| if columns[c].magnitude { known.clone() } else { unknown.clone() };
        let rows = [
            line("", &symbols, "equation"),
            line(words.magnitude, &magnitude, "magnitude"),
            line(words.direction, &|_| known.clone(), "direction"),
        ];
        DrawingPart::of(grid::set(&rows, 3.0))
    }

    /// Sets sentences one below the other.
    fn text(&self, sentences: &[Phrase], name: &str, width_mm: f64) -> DrawingPart {
        let style = self.style();
        let lines =
            sentences.iter().flat_map(|s| wrapped(s, width_mm, style.small_mm, &style.fonts));
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
        DrawingPart::of(grid::set(&lines.enumerate().map(row).collect::<Vec<_>>(), 0.0))
    }

    /// The stroke of a force by its kind.
    fn stroke(&self, term: ForceTerm) -> LineStroke {
        let vector = self.style().vector;
        let thin = LineStroke { width_mm: vector.width_mm * 0.7, ..vector };
        match term {
            ForceTerm::Load(k) => match self.of.loads[k].cause {
                Cause::Weight => thin,
                Cause::Inertia => thin.dashed(Dash::Dashed),
                Cause::Applied(_)
                | Cause::Spring(_)
                | Cause::Balance
                | Cause::Teeth(_)
                | Cause::Friction(_) => vector,
            },
            ForceTerm::Reaction { .. } => vector,
        }
    }

    /// The class of the step of a group that a condition finds, with a space before it: ` step-3`.
    /// Empty for the first step, or if the condition finds none.
    fn step(&self, group: &GroupForces, found: impl Fn(&Act) -> bool) -> String {
        let step = self.of.acts(group).iter().position(found).and_then(|k| k.checked_sub(1));
        step.map_or_else(String::new, |k| format!(" step-{k}"))
    }

    /// The name of a force in ids, independent of language and notation.
    fn key(&self, term: ForceTerm) -> String {
        self.w.plain(term).replace('_', "-")
    }
}

/// Prefixes the ids of a part with the number of its group.
fn named(mut part: DrawingPart, k: usize) -> DrawingPart {
    let name = |item: &mut FigureItem| {
        if !item.id.is_empty() {
            item.id = format!("group-{}-{}", k + 1, item.id);
        }
    };
    part.items.iter_mut().for_each(name);
    part
}
