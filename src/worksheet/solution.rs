//! The solution side: degree of freedom and groups, scales, then for each polygon equations,
//! angular velocities or accelerations, polygon and steps.

use super::equation::equation_table;
use super::speak::Speak;
use super::{DocumentBlock, SheetMaker};
use crate::centres::CentreTask;
use crate::construct::Polygon;
use crate::figure::forces;
use crate::figure::sheet::drawing;
use crate::figure::tables::special_words;
use crate::mechanism::compound;
use crate::paper::label::Label;
use crate::paper::phrase::Phrase;
use crate::plan::names::name_label;
use crate::plan::text::EquationColumn;
use crate::plan::{GroupSteps, Method, PlanStep, Rate, TurningBody, VertexPlace};
use crate::render::math::Math;
use crate::report::amount::number;
use crate::report::amount::scale_formula;
use crate::report::composite::named;
use crate::report::construction::sentences;
use crate::report::equation::{WrittenStep, mate, written};
use crate::report::forces::ForceWriter;
use crate::report::mobility::lower_set;
use crate::report::plan::group_set;
use crate::report::replaced::replaced_words;
use crate::scene::{DiagramKind, Lang, Scene};
use hodograph_base::lang::{each, say, tr};

/// Digits of a length on paper in the choice of scales: a ruler gives no more.
const RULER_DIGITS: usize = 4;
/// Angular velocities or accelerations of a group in one line of formulas: more do not fit.
const RATES_IN_A_LINE: usize = 4;

/// Words for the files of groups' forces; further groups are described in words only.
const FORCES: [&str; 9] = [
    "forces-1", "forces-2", "forces-3", "forces-4", "forces-5", "forces-6", "forces-7", "forces-8",
    "forces-9",
];

impl SheetMaker<'_> {
    /// Writes the solution. `alone`: true if no problem side precedes it, so that the mechanism is
    /// shown here.
    pub(super) fn solution(&self, blocks: &mut Vec<DocumentBlock>, alone: bool) {
        blocks.push(self.heading(1, each!("Solution")));
        let task = CentreTask::of(self.scene);
        if let Some(task) = &task {
            self.laws(blocks);
            self.counted(blocks, tr!(self.lang(), "Degree of freedom"));
            self.centres(blocks, task);
            if task.alone {
                return self.results(blocks, Some(task));
            }
        }
        let special = self.worked.plan.vertices.iter().enumerate().any(|(v, vertex)| {
            matches!(vertex.spot, VertexPlace::Special(_))
                && self.worked.construction.diagram.spots[v].is_some()
        });
        if task.is_none() {
            self.laws(blocks);
            self.counted(blocks, tr!(self.lang(), "Degree of freedom and groups"));
        }
        self.motions(blocks);
        self.groups(blocks);
        let shown = alone || special;
        if shown {
            blocks.extend(self.figure("construction", DiagramKind::Plane));
        }
        self.scales(blocks, shown);
        for on in DiagramKind::POLYGONS {
            self.level(blocks, on);
        }
        self.composite(blocks);
        self.forces(blocks);
        self.results(blocks, task.as_ref());
    }

    fn figure(&self, name: &'static str, on: DiagramKind) -> Option<DocumentBlock> {
        drawing(self.scene, self.worked, self.options, on)
            .map(|f| DocumentBlock::Figure { name, figure: Box::new(f) })
    }

    /// Each group's moments, force polygon and reactions, the last group first; then the checks.
    fn forces(&self, blocks: &mut Vec<DocumentBlock>) {
        let Some(of) = self.worked.equilibrium.as_ref().filter(|of| !of.groups.is_empty()) else {
            return;
        };
        let w = ForceWriter {
            scene: self.scene,
            notation: &self.options.notation,
            lang: self.lang(),
            of,
        };
        blocks.push(self.heading(2, each!("Forces")));
        for (k, group) in of.groups.iter().enumerate() {
            blocks.push(DocumentBlock::Heading(3, w.heading(group)));
            if let (Some(name), Some(figure)) =
                (FORCES.get(k), forces::group(self.scene, self.worked, self.options, k))
            {
                blocks.push(DocumentBlock::Figure { name, figure: Box::new(figure) });
            }
            blocks.push(DocumentBlock::List { numbered: true, members: w.sentences(group) });
        }
        let (lever, pole) =
            (forces::zhukovsky(self.scene, self.worked), self.writer().pole(DiagramKind::Velocity));
        if let Some((heading, members)) =
            w.checks(&self.worked.configuration, lever.as_ref().map(|lever| (lever, pole.as_str())))
        {
            blocks.push(DocumentBlock::Heading(3, heading.into()));
            blocks.push(DocumentBlock::List { numbered: true, members });
        }
    }

    /// The angular velocities and accelerations that laws of time give at the instant.
    fn laws(&self, blocks: &mut Vec<DocumentBlock>) {
        let members = self.givens().laws();
        if !members.is_empty() {
            blocks.push(self.heading(2, each!("Laws of time at the instant")));
            blocks.push(DocumentBlock::List { numbered: false, members });
        }
    }

    /// Moving points and frames that the scene names, with absolute, relative and transport motion.
    fn motions(&self, blocks: &mut Vec<DocumentBlock>) {
        let members = named(self.scene, self.lang(), &self.options.notation);
        if !members.is_empty() {
            blocks.push(self.heading(2, each!("Moving point, frame and three motions")));
            blocks.push(DocumentBlock::List { numbered: false, members });
        }
    }

    /// The degree of freedom, under a heading.
    fn counted(&self, blocks: &mut Vec<DocumentBlock>, heading: &str) {
        let f = &self.worked.mechanism.mobility;
        blocks.push(DocumentBlock::Heading(2, heading.into()));
        let (n, low, high) = (f.moving, f.lower, f.higher);
        let known = say!(
            self.lang(),
            "Moving links $n = {n}$, lower pairs $p_l = {low}$, higher pairs $p_h = {high}$:"
        );
        blocks.push(DocumentBlock::Paragraph(Phrase::new(&known)));
        let why = lower_set(self.scene, &compound(self.scene), self.lang());
        if !why.is_empty() {
            blocks.push(DocumentBlock::List { numbered: false, members: why });
        }
        let formula = format!(
            "F = 3n - 2p_l - p_h = 3 \\times {n} - 2 \\times {low} - {high} = {}",
            f.freedom
        );
        blocks.push(DocumentBlock::Formula(vec![Math::Row(Label::math(formula))]));
    }

    /// The groups in the order of their polygons.
    fn groups(&self, blocks: &mut Vec<DocumentBlock>) {
        let m = &self.worked.mechanism;
        let drivers = self.scene.own_drivers();
        let verdict = match drivers {
            1 => say!(
                self.lang(),
                "With one driver its motion is determined. Groups in the order of solving:"
            ),
            _ => say!(
                self.lang(),
                "With {drivers} drivers its motion is determined. Groups in the order of solving:"
            ),
        };
        blocks.push(DocumentBlock::Paragraph(Phrase::new(&verdict)));
        let groups = m.assur(self.scene).into_iter().filter(|g| !g.is_carried());
        let members = groups.map(|g| group_set(self.scene, m, &g, self.lang())).collect();
        blocks.push(DocumentBlock::List { numbered: true, members });
        blocks.extend(replacing(self.scene, self.lang()));
    }

    /// The scales, and the first length on paper: on the solution's own drawing of the mechanism if
    /// that is `shown`, else on the problem's.
    fn scales(&self, blocks: &mut Vec<DocumentBlock>, shown: bool) {
        let paper = &self.worked.construction;
        let mu_of_figure = if shown { paper.diagram.mu } else { self.given_drawing().1 };
        let mut members = Vec::new();
        let mm = |v: f64| format!("{} mm", number(v, RULER_DIGITS));
        let book = &self.scene.book;
        let mut mu = format!("${}$", scale_formula(book, DiagramKind::Plane, mu_of_figure));
        if let Some(l) = self.scene.lengths.first() {
            let (a, b) = (l.a.min(l.b), l.a.max(l.b));
            let ends =
                name_label(&format!("{}{}", self.scene.point_name(a), self.scene.point_name(b)));
            let on_paper = mm(l.value.value / mu_of_figure);
            mu += &say!(self.lang(), ": $l_{{{ends}}}$ is drawn ${on_paper}$ long");
        }
        members.push(mu);
        for on in DiagramKind::POLYGONS {
            members.extend(
                paper
                    .polygon(on)
                    .filter(|_| !paper.is_empty(on))
                    .map(|p| format!("${}$", scale_formula(book, on, p.mu))),
            );
        }
        blocks.push(self.heading(2, each!("Scales")));
        blocks.push(self.paragraph(
            each!("The scales are chosen from the series 1, 2, 2.5, 5 times a power of ten, so that each drawing is as large as the paper \
             allows. A length measured on paper, multiplied by its scale, is the quantity."),
        ));
        blocks.push(DocumentBlock::List {
            numbered: false,
            members: members.iter().map(|s| Phrase::new(s)).collect(),
        });
    }

    fn level(&self, blocks: &mut Vec<DocumentBlock>, on: DiagramKind) {
        let Some(polygon) = self.worked.construction.polygon(on) else { return };
        blocks.push(DocumentBlock::Heading(2, self.words().equations(on).into()));
        for group in self.worked.plan.steps(on) {
            let chosen = group.drawn(self.worked.construction.acts.chosen[group.group]);
            for step in group.steps(chosen).take(group.alternatives.get(chosen).map_or(0, Vec::len))
            {
                self.step(blocks, on, step);
            }
            self.rates(blocks, on, group);
            for step in &group.further {
                self.step(blocks, on, step);
            }
        }
        self.polygon(blocks, on, polygon);
    }

    fn polygon(&self, blocks: &mut Vec<DocumentBlock>, on: DiagramKind, polygon: &Polygon) {
        let name = on.name(self.lang());
        blocks.push(DocumentBlock::Heading(3, say!(self.lang(), "Construction of the {name}")));
        blocks.extend(self.figure(on.word(), on));
        let members = sentences(&self.writer(), &self.worked.construction, polygon, self.told);
        blocks.push(DocumentBlock::List { numbered: true, members });
    }

    pub(super) fn step(&self, blocks: &mut Vec<DocumentBlock>, on: DiagramKind, step: &PlanStep) {
        let w = self.writer();
        if let PlanStep::Equation { target, .. } = step
            && let Some(special) = w.plan.introduced(step)
        {
            let text = special_words(&w, self.words(), *target, special);
            blocks.push(DocumentBlock::Paragraph(Phrase::new(&text)));
        }
        if let Some(text) = mate(&w, step) {
            blocks.push(DocumentBlock::Paragraph(Phrase::new(&text)));
        }
        match (written(&w, &self.worked.construction, on, step), step) {
            (Some(WrittenStep::Line(line)), _) => blocks.push(DocumentBlock::Paragraph(line)),
            (Some(WrittenStep::Table(columns)), PlanStep::Equation { target, method, .. }) => {
                self.table(blocks, &w.vector(on, *target), *method, columns);
            }
            _ => {}
        }
    }

    fn table(
        &self,
        blocks: &mut Vec<DocumentBlock>,
        vector: &str,
        method: Method,
        columns: Vec<EquationColumn>,
    ) {
        let why = match method {
            Method::SameLink => tr!(self.lang(), "two points of one link"),
            Method::Cylinder => tr!(self.lang(), "the ends of a cylinder, on barrel and rod"),
            Method::Coincident => tr!(self.lang(), "coincident points of two links"),
            Method::Strand => tr!(self.lang(), "the ends of a strand, which does not slip"),
            Method::Special => tr!(self.lang(), "special point method"),
            Method::Trial => tr!(self.lang(), "trial polygon"),
            Method::Driven => tr!(self.lang(), "everything is known"),
        };
        blocks.push(DocumentBlock::Paragraph(Phrase::new(&say!(
            self.lang(),
            "For ${vector}$ ({why}):"
        ))));
        blocks.push(DocumentBlock::Table(equation_table(columns, self.lang(), self.notation())));
    }

    /// Derives the angular velocity or acceleration of each link of the group from the vectors:
    /// `ω₃ = v_C / l_CD`.
    fn rates(&self, blocks: &mut Vec<DocumentBlock>, on: DiagramKind, group: &GroupSteps) {
        let w = self.writer();
        let formula = |(body, rate): &(TurningBody, Rate)| {
            let symbol = w.turning(on, *body);
            match rate {
                Rate::Measured { of, to } => Some((
                    format!("{symbol} ="),
                    Some((w.measured(on, *body, *of, *to), w.length(*of, *to))),
                )),
                Rate::Same(l) => {
                    Some((format!("{symbol} = {}", w.turning(on, TurningBody::Link(*l))), None))
                }
                Rate::Given { .. } | Rate::Zero => None,
            }
        };
        let all: Vec<_> = group.rates.iter().filter_map(formula).collect();
        for line in all.chunks(RATES_IN_A_LINE) {
            let mut parts = Vec::new();
            for (k, (row, fraction)) in line.iter().enumerate() {
                let apart = if k > 0 { "\\quad \\quad " } else { "" };
                parts.push(Math::Row(Label::math(format!("{apart}{row}"))));
                parts.extend(fraction.as_ref().map(|(over, under)| {
                    Math::Fraction(Label::math(over.as_str()), Label::math(under.as_str()))
                }));
            }
            blocks.push(DocumentBlock::Formula(parts));
        }
    }
}

/// The links in place of the contacts of cams, as a list; nothing without cams.
pub(super) fn replacing(scene: &Scene, lang: Lang) -> Option<DocumentBlock> {
    let members: Vec<Phrase> =
        replaced_words(scene).iter().map(|b| Phrase::of_words(lang.of(b))).collect();
    (!members.is_empty()).then_some(DocumentBlock::List { numbered: false, members })
}
