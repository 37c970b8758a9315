//! The analytic method written out: the loops of each group, their equations and unknowns, as text
//! and JSON.

mod motion;

pub use motion::WrittenMotion;

use super::amount::length_unit;
use super::columns::columns;
use hodograph_base::digits::legible;
use hodograph_base::lang::{say, tr};
use hodograph_board::plan::names::point_label;
use hodograph_methods::loops::{
    Equation, Formula, GroupLoops, LoopSystem, LoopVariable, LoopVector, Loops, PositionForm,
    UnaryFunction, VectorSize,
};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::phrase::Phrase;
use hodograph_paper::render::math::Math;
use hodograph_scene::{Kind, Lang, Scene};
use serde_json::{Value as Json, json};

/// Significant digits of numbers.
const DIGITS: usize = 6;

/// Formula on a line of its own.
pub type DisplayedFormula = Vec<Math>;

/// A writer for one scene and language.
pub struct LoopWords<'a> {
    scene: &'a Scene,
    all: &'a Loops,
    lang: Lang,
}

impl<'a> LoopWords<'a> {
    /// Returns a writer.
    pub fn new(scene: &'a Scene, all: &'a Loops, lang: Lang) -> LoopWords<'a> {
        LoopWords { scene, all, lang }
    }

    /// Returns the report as text.
    pub fn text(&self) -> String {
        let mut lines = Vec::new();
        let title = self.lang.of(&self.scene.title);
        if !title.is_empty() {
            lines.extend([title.to_owned(), String::new()]);
        }
        let of = |v: &LoopVariable| [0, 1, 2].map(|order| plain(&self.variable(v, order)));
        if self.all.groups.is_empty() {
            lines.extend(self.motion_lines().into_iter().skip(1));
            return lines.iter().map(|l| format!("{}\n", l.trim_end())).collect();
        }
        let given = self.all.variables.iter().filter(|v| v.driver.is_some());
        let known: Vec<String> =
            given.map(|v| of(v).join(tr!(self.lang, "clause" => ", "))).collect();
        let known = known.join(self.lang.semicolon());
        lines.push(format!("{}{known}", tr!(self.lang, "given: ")));
        for g in &self.all.groups {
            lines.push(String::new());
            lines.extend(self.group(g));
        }
        lines.push(String::new());
        lines.push(tr!(self.lang, "results:").to_owned());
        let results: Vec<Vec<String>> = self.all.variables.iter().map(|v| of(v).to_vec()).collect();
        lines.extend(columns(&results, 1).into_iter().map(|l| format!("  {l}")));
        lines.extend(self.motion_lines());
        lines.iter().map(|l| format!("{}\n", l.trim_end())).collect()
    }

    fn group(&self, g: &GroupLoops) -> Vec<String> {
        let mut lines = vec![self.heading(g)];
        for of in &g.loops {
            lines.push(format!("  {}", plain(&closed(self.all, of))));
            let row = |v: &LoopVector| {
                let [way, link, length, angle] = self.row(v);
                vec![plain(&way), link, plain(&length), plain(&angle)]
            };
            let rows: Vec<Vec<String>> = of.iter().map(row).collect();
            lines.extend(columns(&rows, 4).into_iter().map(|l| format!("    {l}")));
        }
        let equation = |e: &Equation| format!("{} = {}", e.left.text(), e.right.text());
        let with_value = |e: &Equation| match gives(e) {
            true => format!("    {} = {}", plain(&equation(e)), plain(&self.value_of(e))),
            false => format!("    {}", plain(&equation(e))),
        };
        lines.push(tr!(self.lang, "  real and imaginary parts:").into());
        lines.extend(g.closures.iter().map(|e| format!("    {}", plain(&equation(e)))));
        lines.push(format!("  {}", Phrase::new(&self.method(g)).plain()));
        lines.extend(g.position.iter().map(with_value));
        if g.position.is_empty() {
            lines.extend(g.unknowns.iter().map(|k| format!("    {}", plain(&self.result(*k, 0)))));
        }
        let levels = [
            (tr!(self.lang, "velocity"), &g.velocities, 1),
            (tr!(self.lang, "acceleration"), &g.accelerations, 2),
        ];
        for (name, equations, order) in levels {
            lines.push(format!(
                "  {name}{}{}",
                tr!(self.lang, ": "),
                Phrase::new(self.derived(order)).plain()
            ));
            let rows: Vec<Vec<String>> = self
                .system(g, order)
                .iter()
                .map(|row| row.iter().map(|cell| plain(cell)).collect())
                .collect();
            lines.extend(columns(&rows, 0).into_iter().map(|l| format!("    | {l}")));
            if equations.is_empty() {
                let found = g.unknowns.iter().map(|k| plain(&self.result(*k, order)));
                lines.extend(found.map(|l| format!("    {l}")));
            } else {
                lines.push(format!("  {}", Phrase::new(self.projected()).plain()));
                lines.extend(equations.iter().map(with_value));
            }
        }
        lines
    }

    /// Returns a vector of a loop as a sentence.
    pub fn vector(&self, v: &LoopVector) -> String {
        let [way, link, length, angle] = self.row(v);
        let turned = match v.angle.variable {
            Some(_) => format!("${angle}$"),
            None => format!("{}${angle}$", tr!(self.lang, "its angle is ")),
        };
        match link.is_empty() {
            false => say!(self.lang, "The vector ${way}$ on link {link}: ${length}$, {turned}."),
            true => say!(self.lang, "The vector ${way}$: ${length}$, {turned}."),
        }
    }

    /// Returns the solution of a group in steps, each a sentence with the formulas below it: the
    /// closed loops, their two parts, and how each unknown follows, in positions, velocities and
    /// accelerations.
    pub fn steps(&self, g: &GroupLoops) -> Vec<(String, Vec<DisplayedFormula>)> {
        let lang = self.lang;
        let row = |text: String| vec![Math::Row(Label::math(text))];
        let display = |equations: &[Equation]| equations.iter().map(|e| self.display(e)).collect();
        let loops = g.loops.iter().map(|of| row(closed(self.all, of))).collect();
        let sum = tr!(lang, "The vectors along both ways have the same sum:");
        let parts = tr!(lang, "Real and imaginary parts:");
        let mut out = vec![
            (sum.to_owned(), loops),
            (parts.to_owned(), display(&g.closures)),
            (self.method(g), Vec::new()),
        ];
        let gives = |e: &Equation| say!(lang, "This gives ${}$:", e.left.text());
        // First what the formulas of the unknowns need, then each unknown.
        let first = g.position.len().saturating_sub(g.unknowns.len());
        let (needed, found) = g.position.split_at(first);
        if !needed.is_empty() {
            let words = tr!(lang, "The formulas use:");
            out.push((words.to_owned(), display(needed)));
        }
        out.extend(found.iter().map(|e| (gives(e), display(std::slice::from_ref(e)))));
        let results =
            |order: usize| g.unknowns.iter().map(|k| row(self.result(*k, order))).collect();
        if g.position.is_empty() {
            out.push((tr!(lang, "The unknowns are:").to_owned(), results(0)));
        }
        for (equations, order) in [(&g.velocities, 1), (&g.accelerations, 2)] {
            // The system is not written out.
            let derived = self.derived(order).split([':', '：', '（']).next().unwrap_or_default();
            let derived = derived.split(" ($b$").next().unwrap_or_default();
            if equations.is_empty() {
                out.push((format!("{derived}{}", tr!(lang, ":")), results(order)));
                continue;
            }
            let projected = self.projected().trim_end_matches([':', '：']);
            out.push((
                format!("{derived}{}{projected}{}", tr!(lang, ". "), tr!(lang, ".")),
                Vec::new(),
            ));
            out.extend(equations.iter().map(|e| (gives(e), display(std::slice::from_ref(e)))));
        }
        out
    }

    /// Returns the heading of a group: its links and kind.
    pub fn heading(&self, g: &GroupLoops) -> String {
        let names: Vec<&str> = g.links.iter().map(|l| self.scene.link_name(*l)).collect();
        let links = names.join(self.lang.comma());
        match names.len() {
            1 => say!(self.lang, "link {links} ({})", g.kind),
            _ => say!(self.lang, "links {links} ({})", g.kind),
        }
    }

    /// Returns the unknowns of a group's positions and how they are found, with formulas between
    /// dollar signs.
    pub fn method(&self, g: &GroupLoops) -> String {
        let unknowns: Vec<String> =
            g.unknowns.iter().map(|k| format!("${}$", self.symbol(*k, 0))).collect();
        let (list, how) = (unknowns.join(self.lang.comma()), self.form(g.form));
        say!(self.lang, "Unknowns: {list}. {how}")
    }

    fn form(&self, form: PositionForm) -> &'static str {
        match form {
            PositionForm::TwoAngles => tr!(
                self.lang,
                "Isolate the terms with one unknown angle on one side; squaring and adding both equations eliminates it. With \
                 $t = \\tan(\\varphi/2)$ a quadratic equation remains; the assembly determines the sign of the root."
            ),
            PositionForm::AngleAndLength => tr!(
                self.lang,
                "The component perpendicular to the guide contains only the unknown angle."
            ),
            PositionForm::SlottedLever => tr!(
                self.lang,
                "Squaring and adding both equations eliminates the angle; the two components then give the angle in its quadrant."
            ),
            PositionForm::TwoLengths => tr!(
                self.lang,
                "The component perpendicular to each guide contains only the other unknown distance."
            ),
            PositionForm::Newton => tr!(
                self.lang,
                "Newton's method finds them; its Jacobian is the coefficient matrix of the velocity equations."
            ),
        }
    }

    /// Returns the sentence before the linear system of a derivative.
    pub fn derived(&self, order: usize) -> &'static str {
        match order {
            1 => tr!(
                self.lang,
                "Differentiating the real and imaginary parts with respect to time gives linear equations for the unknown velocities ($b$ is the right side):"
            ),
            _ => tr!(
                self.lang,
                "Differentiating once more gives linear equations for the unknown accelerations, with the same coefficients:"
            ),
        }
    }

    /// Returns the sentence before the formulas by projection.
    pub fn projected(&self) -> &'static str {
        tr!(
            self.lang,
            "To eliminate the other unknown, multiply both sides by $e^{−i\\varphi}$ and take the real or the imaginary part:"
        )
    }

    /// Returns the symbol of an unknown (order 0) or of a derivative.
    fn symbol(&self, k: usize, order: usize) -> String {
        self.all.variables[k].symbol(order).text()
    }

    /// Returns a linear system as rows of formulas: the unknowns and b, then the coefficients.
    pub fn system(&self, g: &GroupLoops, order: usize) -> Vec<Vec<String>> {
        let LoopSystem { rows: coefficients, right: [velocity, acceleration] } = &g.system;
        let right = if order == 1 { velocity } else { acceleration };
        let head = g.unknowns.iter().map(|k| self.symbol(*k, order));
        let mut rows = vec![head.chain(["b".to_owned()]).collect::<Vec<_>>()];
        for (row, right) in coefficients.iter().zip(right) {
            rows.push(row.iter().chain([right]).map(|x| legible(tidy(*x), DIGITS)).collect());
        }
        rows
    }

    /// Returns a vector as formulas: way, link (as text), length, angle, each with its value.
    pub fn row(&self, v: &LoopVector) -> [String; 4] {
        let (symbol, size) = size(self.all, v);
        let angle = v.angle.formula(&self.all.variables);
        let name = |e: &String| if e.is_empty() { "F".to_owned() } else { point_label(e) };
        let [from, to] = v.ends.each_ref().map(name);
        let turned = match v.angle.variable {
            None => self.number(Some(Kind::Angle), angle.value()),
            Some(_) => {
                format!("{} = {}", angle.text(), self.number(Some(Kind::Angle), angle.value()))
            }
        };
        [
            if v.forward { format!("{from} \\to {to}") } else { format!("{to} \\to {from}") },
            v.link.map_or_else(String::new, |l| self.scene.link_name(l).to_owned()),
            format!("{symbol} = {}", self.number(Some(Kind::Length), size)),
            turned,
        ]
    }

    /// Returns an unknown or its derivative with its value.
    pub fn result(&self, k: usize, order: usize) -> String {
        self.variable(&self.all.variables[k], order)
    }

    fn variable(&self, v: &LoopVariable, order: usize) -> String {
        let symbol = v.symbol(order);
        format!("{} = {}", symbol.text(), self.number(Some(v.kind(order)), symbol.value()))
    }

    /// Returns the value of an equation that gives one.
    pub fn value_of(&self, e: &Equation) -> String {
        self.number(e.kind, e.left.value())
    }

    /// Returns an equation for a line of its own, with the value that it gives.
    pub fn display(&self, e: &Equation) -> Vec<Math> {
        let mut out = vec![Math::Row(Label::math(format!("{} =", e.left.text())))];
        out.extend(math(&e.right));
        if gives(e) {
            out.push(Math::Row(Label::math(format!("= {}", self.value_of(e)))));
        }
        out
    }

    /// Returns a number with its unit; a product of two lengths (`None`) in the square of the unit
    /// of lengths.
    fn number(&self, kind: Option<Kind>, si: f64) -> String {
        let book = &self.scene.book;
        let (name, per_metre) = length_unit(self.scene);
        match kind {
            Some(Kind::Length) => format!("{} {name}", legible(tidy(si) * per_metre, DIGITS)),
            None => format!("{} {name}^2", legible(tidy(si) * per_metre * per_metre, DIGITS)),
            Some(Kind::Angle) => format!("{}°", legible(tidy(si).to_degrees(), DIGITS)),
            Some(kind) => book.label(kind, &legible(book.value(kind, tidy(si)), DIGITS)),
        }
    }
}

/// Returns true if the left side is a symbol that the right side gives.
fn gives(e: &Equation) -> bool {
    matches!(e.left, Formula::Symbol(..)) && !matches!(e.right, Formula::Number(..))
}

/// Returns a formula with its fractions and roots set as such.
fn math(f: &Formula) -> Vec<Math> {
    let label = |f: &Formula| Label::math(f.text());
    match f {
        Formula::Quotient(a, b) => vec![Math::Fraction(label(a), label(b))],
        Formula::Root(a) => vec![Math::Root(label(a))],
        Formula::Direction { x, y } => {
            vec![Math::Row(Label::math("\\arctan")), Math::Fraction(label(y), label(x))]
        }
        Formula::Call(UnaryFunction::Arctan, of) if matches!(**of, Formula::Quotient(..)) => {
            std::iter::once(Math::Row(Label::math("\\arctan"))).chain(math(of)).collect()
        }
        Formula::Product(factors) if factors.iter().any(set_apart) => {
            let space = || Math::Row(Label::math("\\,"));
            factors.iter().flat_map(|f| math(f).into_iter().chain([space()])).collect()
        }
        Formula::Sum(terms) if terms.iter().any(|(_, t)| set_apart(t)) => {
            let sign = |(k, (minus, term)): (usize, &(bool, Formula))| {
                let sign = match (k, minus) {
                    (0, false) => None,
                    (_, true) => Some("−"),
                    (_, false) => Some("+"),
                };
                let sign = sign.map(|s| Math::Row(Label::math(s)));
                sign.into_iter().chain(math(term)).collect::<Vec<_>>()
            };
            terms.iter().enumerate().flat_map(sign).collect()
        }
        _ => vec![Math::Row(label(f))],
    }
}

/// Returns true for a fraction, a root, and the arctangent of a fraction.
fn set_apart(f: &Formula) -> bool {
    match f {
        Formula::Quotient(..) | Formula::Root(_) | Formula::Direction { .. } => true,
        Formula::Call(UnaryFunction::Arctan, of) => set_apart(of),
        Formula::Symbol(..)
        | Formula::Number(..)
        | Formula::Sum(_)
        | Formula::Product(_)
        | Formula::Square(_)
        | Formula::Call(..) => false,
    }
}

/// Returns a number without rounding errors that should be zero.
fn tidy(x: f64) -> f64 {
    if x.abs() < ROUNDING { 0.0 } else { x }
}

/// Numbers below this (SI) are rounding errors.
const ROUNDING: f64 = 1e-13;

fn plain(label: &str) -> String {
    Label::math(label).plain()
}

/// Returns symbol and value of a vector's length.
fn size(all: &Loops, v: &LoopVector) -> (String, f64) {
    match &v.size {
        VectorSize::Fixed(text, value) => (text.clone(), *value),
        VectorSize::Variable(k) => (all.variables[*k].symbol(0).text(), all.variables[*k].value),
    }
}

/// Returns the vector equation of a loop in the label language:
/// `l_{AB} e^{i\varphi_{2}} + ... = ...`.
pub fn closed(all: &Loops, of: &[LoopVector]) -> String {
    let side = |left: bool| {
        let mut out = String::new();
        for v in of.iter().filter(|v| v.left == left) {
            out += match (out.is_empty(), v.forward) {
                (true, true) => "",
                (true, false) => "−",
                (false, true) => " + ",
                (false, false) => " − ",
            };
            out += &size(all, v).0;
            let angle = v.angle.formula(&all.variables);
            match angle {
                Formula::Number(_, 0.0) => {}
                Formula::Symbol(text, _) => out += &format!("\\,e^{{i{text}}}"),
                other => out += &format!("\\,e^{{i({})}}", other.text()),
            }
        }
        if out.is_empty() { "0".to_owned() } else { out }
    };
    format!("{} = {}", side(true), side(false))
}

/// Returns the loops as JSON, in SI and radians. Formulas are in the label language.
pub fn json(scene: &Scene, all: &Loops) -> Json {
    let symbol = |k: usize, order: usize| all.variables[k].symbol(order).text();
    let variables: Vec<Json> = all
        .variables
        .iter()
        .map(|v| {
            json!({
                "symbol": v.symbol(0).text(), "given": v.driver.is_some(),
                "value": v.value, "rate": v.rate, "second": v.second,
                "unit": if v.angular { "rad" } else { "m" },
            })
        })
        .collect();
    let vector = |v: &LoopVector| {
        let [start, end] = v.places;
        json!({
            "from": v.ends[0], "to": v.ends[1],
            "link": v.link.map(|l| scene.link_name(l)),
            "side": if v.left { "left" } else { "right" },
            "sign": if v.forward { 1 } else { -1 },
            "length": {"symbol": size(all, v).0, "value": size(all, v).1},
            "angle": {"symbol": v.angle.formula(&all.variables).text(), "value": v.angle.formula(&all.variables).value()},
            "places": [[start.x, start.y], [end.x, end.y]],
        })
    };
    let groups: Vec<Json> = all
        .groups
        .iter()
        .map(|g| {
            let list =
                |equations: &[Equation]| equations.iter().map(equation_json).collect::<Vec<_>>();
            json!({
                "links": g.links.iter().map(|l| scene.link_name(*l)).collect::<Vec<_>>(),
                "kind": g.kind,
                "form": form_name(g.form),
                "loops": g.loops.iter().map(|of| json!({
                    "equation": closed(all, of),
                    "vectors": of.iter().map(vector).collect::<Vec<_>>(),
                })).collect::<Vec<_>>(),
                "unknowns": g.unknowns.iter().map(|k| symbol(*k, 0)).collect::<Vec<_>>(),
                "parts": list(&g.closures),
                "position": list(&g.position),
                "matrix": g.system.rows,
                "velocity": {"right": g.system.right[0], "equations": list(&g.velocities)},
                "acceleration": {"right": g.system.right[1], "equations": list(&g.accelerations)},
            })
        })
        .collect();
    let motion = LoopWords::new(scene, all, Lang::En).motion_json();
    json!({"variables": variables, "groups": groups, "motion": motion})
}

fn equation_json(e: &Equation) -> Json {
    json!({
        "left": e.left.text(), "right": e.right.text(), "value": e.right.value(),
        "unit": e.kind.map_or("m²", Kind::si),
    })
}

fn form_name(form: PositionForm) -> &'static str {
    match form {
        PositionForm::TwoAngles => "two-angles",
        PositionForm::AngleAndLength => "angle-and-length",
        PositionForm::SlottedLever => "slotted-lever",
        PositionForm::TwoLengths => "two-lengths",
        PositionForm::Newton => "newton",
    }
}
