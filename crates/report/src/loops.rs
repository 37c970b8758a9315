//! The analytic method written out: the loops of each group, their equations and unknowns, as text
//! and JSON.

use super::amount::length_unit;
use super::columns::columns;
use hodograph_base::digits::legible;
use hodograph_methods::loops::{
    Equation, Formula, GroupLoops, LoopMatrix, LoopVariable, LoopVector, Loops, PositionForm,
    VectorSize,
};
use hodograph_paper::paper::label::Label;
use hodograph_paper::paper::phrase::tr;
use hodograph_scene::{Kind, Lang, Scene};
use serde_json::{Value as Json, json};

/// Significant digits of numbers.
const DIGITS: usize = 6;

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
        let title = self.scene.title.get(self.lang);
        if !title.is_empty() {
            lines.extend([title.to_owned(), String::new()]);
        }
        let given = self.all.variables.iter().filter(|v| v.driver.is_some());
        let known: Vec<String> = given.map(|v| self.given(v)).collect();
        lines.push(
            tr(self.lang, "given: ", "已知：").to_owned() + &known.join(tr(self.lang, "; ", "；")),
        );
        for g in &self.all.groups {
            lines.push(String::new());
            lines.extend(self.group(g));
        }
        lines.push(String::new());
        lines.push(tr(self.lang, "results:", "结果：").to_owned());
        lines.extend(columns(&self.results(), 1).into_iter().map(|l| format!("  {l}")));
        lines.iter().map(|l| format!("{}\n", l.trim_end())).collect()
    }

    fn given(&self, v: &LoopVariable) -> String {
        let of = |order: usize| {
            let symbol = v.symbol(order);
            let number = self.number(Some(v.kind(order)), symbol.value());
            format!("{} = {number}", plain(&symbol.text()))
        };
        [0, 1, 2].map(of).join(", ")
    }

    /// Returns the heading of a group: its links and kind.
    pub fn heading(&self, g: &GroupLoops) -> String {
        let names: Vec<&str> = g.links.iter().map(|l| self.scene.link_name(*l)).collect();
        match self.lang {
            Lang::En => format!("links {} ({})", names.join(", "), g.kind),
            Lang::Zh => format!("构件 {}（{}）", names.join("、"), g.kind),
        }
    }

    fn group(&self, g: &GroupLoops) -> Vec<String> {
        let mut lines = vec![self.heading(g)];
        for of in &g.loops {
            lines.push(format!("  {}", plain(&closed(self.all, of))));
            let rows: Vec<Vec<String>> = of.iter().map(|v| self.vector(v)).collect();
            lines.extend(columns(&rows, 4).into_iter().map(|l| format!("    {l}")));
        }
        lines.push(tr(self.lang, "  real and imaginary parts:", "  实部与虚部：").into());
        lines.extend(g.closures.iter().map(|e| format!("    {}", self.equation(e, false))));
        let unknowns: Vec<String> =
            g.unknowns.iter().map(|k| plain(&self.all.variables[*k].symbol(0).text())).collect();
        lines.push(match self.lang {
            Lang::En => {
                format!("  position, unknown {}: {}", unknowns.join(", "), self.form(g.form))
            }
            Lang::Zh => format!("  位置，未知量 {}：{}", unknowns.join("、"), self.form(g.form)),
        });
        lines.extend(g.position.iter().map(|e| format!("    {}", self.equation(e, true))));
        if g.position.is_empty() {
            lines.extend(g.unknowns.iter().map(|k| format!("    {}", self.value(*k, 0))));
        }
        let levels = [
            (tr(self.lang, "velocity", "速度"), &g.velocity, &g.velocities, 1),
            (tr(self.lang, "acceleration", "加速度"), &g.acceleration, &g.accelerations, 2),
        ];
        for (name, matrix, equations, order) in levels {
            let how = match (equations.is_empty(), self.lang) {
                (true, Lang::En) => "the derivative of the real and imaginary parts, A x = b",
                (true, Lang::Zh) => "对实部与虚部求导，A x = b",
                (false, Lang::En) => "the derivative, projected so that the other unknown vanishes",
                (false, Lang::Zh) => "求导后投影，消去另一未知量",
            };
            lines.push(format!("  {name}{}{how}", tr(self.lang, ": ", "：")));
            lines.extend(equations.iter().map(|e| format!("    {}", self.equation(e, true))));
            lines.extend(self.matrix(matrix, &g.unknowns, order));
            if equations.is_empty() {
                lines.extend(g.unknowns.iter().map(|k| format!("    {}", self.value(*k, order))));
            }
        }
        lines
    }

    fn form(&self, form: PositionForm) -> &'static str {
        match (form, self.lang) {
            (PositionForm::TwoAngles, Lang::En) => {
                "the terms of one angle alone on one side, squared and added; t = tan(φ/2) gives a \
                 quadratic equation, and the sign of its root is the assembly"
            }
            (PositionForm::TwoAngles, Lang::Zh) => {
                "将含一个未知角的项移至等号一侧，两式平方相加消去该角；令 t = tan(φ/2) 得二次方程，根号前的正负号由装配形式确定"
            }
            (PositionForm::AngleAndLength, Lang::En) => {
                "the component across the guide contains the angle alone"
            }
            (PositionForm::AngleAndLength, Lang::Zh) => "垂直于导路方向的投影只含未知角",
            (PositionForm::SlottedLever, Lang::En) => {
                "squared and added, the angle vanishes; the components give the angle in its quadrant"
            }
            (PositionForm::SlottedLever, Lang::Zh) => {
                "两式平方相加消去未知角；再由两分量求角，按其所在象限取值"
            }
            (PositionForm::TwoLengths, Lang::En) => {
                "the component across each guide contains the other distance alone"
            }
            (PositionForm::TwoLengths, Lang::Zh) => "垂直于一导路方向的投影只含另一未知长度",
            (PositionForm::Newton, Lang::En) => {
                "Newton's method; the matrix is that of the velocities"
            }
            (PositionForm::Newton, Lang::Zh) => "用牛顿法求解，雅可比矩阵与速度方程的系数矩阵相同",
        }
    }

    fn vector(&self, v: &LoopVector) -> Vec<String> {
        let (symbol, size) = size(self.all, v);
        let angle = angle(self.all, v);
        let [from, to] = v.ends.each_ref().map(|e| if e.is_empty() { "F" } else { e });
        vec![
            if v.forward { format!("{from} → {to}") } else { format!("{to} → {from}") },
            v.link.map_or_else(String::new, |l| self.scene.link_name(l).to_owned()),
            plain(&symbol),
            plain(&angle.text()),
            self.number(Some(Kind::Length), size),
            self.number(Some(Kind::Angle), angle.value()),
        ]
    }

    /// Returns an equation in plain characters, with the value that it gives.
    fn equation(&self, e: &Equation, with_value: bool) -> String {
        let text = plain(&format!("{} = {}", e.left.text(), e.right.text()));
        let gives =
            matches!(e.left, Formula::Symbol(..)) && !matches!(e.right, Formula::Number(..));
        match with_value && gives {
            true => format!("{text} = {}", self.number(e.kind, e.left.value())),
            false => text,
        }
    }

    fn value(&self, k: usize, order: usize) -> String {
        let v = &self.all.variables[k];
        let symbol = v.symbol(order);
        format!("{} = {}", plain(&symbol.text()), self.number(Some(v.kind(order)), symbol.value()))
    }

    fn matrix(&self, m: &LoopMatrix, unknowns: &[usize], order: usize) -> Vec<String> {
        let head = unknowns.iter().map(|k| plain(&self.all.variables[*k].symbol(order).text()));
        let mut rows = vec![head.chain(["b".to_owned()]).collect::<Vec<_>>()];
        for (row, right) in m.rows.iter().zip(&m.right) {
            rows.push(row.iter().chain([right]).map(|x| legible(*x, DIGITS)).collect());
        }
        columns(&rows, 0).into_iter().map(|l| format!("    | {l}")).collect()
    }

    fn results(&self) -> Vec<Vec<String>> {
        let row = |v: &LoopVariable| {
            let cell = |order: usize| {
                let symbol = v.symbol(order);
                let number = self.number(Some(v.kind(order)), symbol.value());
                format!("{} = {number}", plain(&symbol.text()))
            };
            [0, 1, 2].map(cell).to_vec()
        };
        self.all.variables.iter().map(row).collect()
    }

    /// Returns a number with its unit; a product of two lengths (`None`) in the square of the unit
    /// of lengths.
    fn number(&self, kind: Option<Kind>, si: f64) -> String {
        let book = &self.scene.book;
        let tidy = |x: f64| if x.abs() < ROUNDING { 0.0 } else { x };
        let (name, per_metre) = length_unit(self.scene);
        match kind {
            Some(Kind::Length) => format!("{} {name}", legible(tidy(si) * per_metre, DIGITS)),
            None => format!("{} {name}²", legible(tidy(si) * per_metre * per_metre, DIGITS)),
            Some(Kind::Angle) => format!("{}°", legible(tidy(si).to_degrees(), DIGITS)),
            Some(kind) => book.text(kind, &legible(book.value(kind, tidy(si)), DIGITS)),
        }
    }
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

/// Returns the angle of a vector.
fn angle(all: &Loops, v: &LoopVector) -> Formula {
    v.angle.formula(&all.variables)
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
            let angle = angle(all, v);
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
    let equation = |e: &Equation| {
        json!({
            "left": e.left.text(), "right": e.right.text(), "value": e.right.value(),
            "unit": e.kind.map_or("m²", Kind::si),
        })
    };
    let matrix = |m: &LoopMatrix| json!({"rows": m.rows, "right": m.right});
    let vector = |v: &LoopVector| {
        let [start, end] = v.places;
        json!({
            "from": v.ends[0], "to": v.ends[1],
            "link": v.link.map(|l| scene.link_name(l)),
            "side": if v.left { "left" } else { "right" },
            "sign": if v.forward { 1 } else { -1 },
            "length": {"symbol": size(all, v).0, "value": size(all, v).1},
            "angle": {"symbol": angle(all, v).text(), "value": angle(all, v).value()},
            "places": [[start.x, start.y], [end.x, end.y]],
        })
    };
    let groups: Vec<Json> = all
        .groups
        .iter()
        .map(|g| {
            let list = |equations: &[Equation]| equations.iter().map(equation).collect::<Vec<_>>();
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
                "velocity": {"matrix": matrix(&g.velocity), "equations": list(&g.velocities)},
                "acceleration": {
                    "matrix": matrix(&g.acceleration), "equations": list(&g.accelerations),
                },
            })
        })
        .collect();
    json!({"variables": variables, "groups": groups})
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
