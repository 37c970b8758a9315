//! The construction, step by step, as sentences with the lengths measured on paper.

use super::phrase::{Phrase, formula, sense, tr};
use crate::construct::{Action, Construction, Edge, Mark, Polygon};
use crate::mechanism::Level;
use crate::plan::text::Writer;
use crate::plan::{Term, VertexId};
use crate::quantity::{shortest, significant};
use crate::scene::Lang;

/// The sentences of one polygon, one for each action, the pole first; with a pencil error (mm), how far it moves each crossing.
pub fn sentences(w: &Writer, paper: &Construction, polygon: &Polygon, pencil_mm: Option<f64>) -> Vec<Phrase> {
    let level = polygon.level;
    let unit = level_unit(level);
    let pole = w.pole(level);
    let mu = format!("\\mu_{} = {} ({unit})/mm", if level == Level::Acceleration { "a" } else { "v" }, shortest(polygon.mu));
    let mut out = vec![Phrase::new(&match w.lang {
        Lang::En => format!("Take the pole ${pole}$; scale ${mu}$."),
        Lang::Zh => format!("取极点 ${pole}$，比例尺 ${mu}$。"),
    })];
    out.extend(polygon.actions.iter().map(|a| Phrase::new(&sentence(w, paper, polygon, a, pencil_mm))));
    out
}

/// The whole construction as numbered text.
pub fn text(w: &Writer, paper: &Construction, pencil_mm: Option<f64>) -> String {
    let mut out = String::new();
    out.push_str(&format!(
        "{}: {}\n",
        tr(w.lang, "mechanism diagram", "机构运动简图"),
        formula(&format!("\\mu_l = {} m/mm", shortest(paper.diagram.mu_l)))
    ));
    for level in [Level::Velocity, Level::Acceleration] {
        let Some(p) = paper.polygon(level) else { continue };
        out.push('\n');
        out.push_str(match level {
            Level::Acceleration => tr(w.lang, "acceleration polygon", "加速度多边形"),
            _ => tr(w.lang, "velocity polygon", "速度多边形"),
        });
        out.push('\n');
        for (i, s) in sentences(w, paper, p, pencil_mm).iter().enumerate() {
            out.push_str(&format!("{:>3}. {}\n", i + 1, s.plain()));
        }
    }
    out
}

fn level_unit(level: Level) -> &'static str {
    if level == Level::Acceleration { "m/s^2" } else { "m/s" }
}

fn millimetres(v: f64) -> String {
    format!("{} mm", if v < 1e-9 { "0".to_string() } else { significant(v, 4) })
}

fn mark(w: &Writer, level: Level, m: &Mark) -> String {
    match m {
        Mark::Pole => w.pole(level),
        Mark::Image(v) => w.image(level, *v),
        Mark::Part(t) => w.part(level, t),
    }
}

fn symbols(w: &Writer, level: Level, terms: &[Term]) -> String {
    terms.iter().map(|t| w.symbol(level, t)).collect::<Vec<_>>().join(" + ")
}

fn length(e: &Edge) -> String {
    millimetres(e.from.1.distance(e.to.1))
}

fn sentence(w: &Writer, paper: &Construction, p: &Polygon, a: &Action, pencil_mm: Option<f64>) -> String {
    let level = p.level;
    match a {
        Action::LayOff(i) => {
            let e = &p.edges[*i];
            let t = &e.terms[0];
            let (from, to) = (mark(w, level, &e.from.0), mark(w, level, &e.to.0));
            let (symbol, magnitude, direction) = (w.symbol(level, t), w.magnitude(level, t), w.direction(t));
            let given = if magnitude == w.notation.known { String::new() } else { format!(" = {magnitude}") };
            match w.lang {
                Lang::En => format!("From ${from}$ lay off ${symbol}{given}$, {}, ${direction}$; it ends in ${to}$.", length(e)),
                Lang::Zh => format!("自 ${from}$ 作 ${symbol}{given}$，长 {}，${direction}$，得 ${to}$。", length(e)),
            }
        }
        Action::Nothing { term, .. } => {
            let symbol = w.symbol(level, term);
            match w.lang {
                Lang::En => format!("${symbol}$ = 0, for the driver is at rest: nothing is laid off."),
                Lang::Zh => format!("${symbol}$ = 0（原动件该瞬时静止），不作图。"),
            }
        }
        Action::Line { terms, through, .. } => {
            let from = p
                .edges
                .iter()
                .flat_map(|e| [&e.from, &e.to])
                .find(|m| m.1 == *through)
                .map_or_else(|| place(w, p, *through), |m| mark(w, level, &m.0));
            let (symbol, direction) = (symbols(w, level, terms), w.direction(&terms[0]));
            match w.lang {
                Lang::En => format!("Through ${from}$ draw the direction of ${symbol}$, ${direction}$."),
                Lang::Zh => format!("过 ${from}$ 作 ${symbol}$ 的方向线，${direction}$。"),
            }
        }
        Action::Cross { target, edges, sine } => {
            let angle = significant(libm::asin(sine.abs().min(1.0)).to_degrees(), 3);
            let image = w.image(level, *target);
            let lengths: Vec<String> =
                edges.iter().map(|i| format!("${}$ = {}", symbols(w, level, &p.edges[*i].terms), length(&p.edges[*i]))).collect();
            match w.lang {
                Lang::En => {
                    format!("The two lines cross in ${image}$ under {angle}°{}: {}.", moved(w.lang, *sine, pencil_mm), lengths.join(", "))
                }
                Lang::Zh => format!("两线交于 ${image}$，交角 {angle}°{}：{}。", moved(w.lang, *sine, pencil_mm), lengths.join("，")),
            }
        }
        Action::Reach(v) => {
            let (image, vector) = (w.image(level, *v), w.vector(level, *v));
            let l = p.images[v.0].map_or(0.0, |q| q.to_vec2().norm());
            match w.lang {
                Lang::En => format!("Nothing is added: ${image}$ lies where it starts, ${vector}$ = {}.", millimetres(l)),
                Lang::Zh => format!("无附加分量，${image}$ 即在起点，${vector}$ = {}。", millimetres(l)),
            }
        }
        Action::Copy { target, from } => {
            let (image, a, b) = (w.image(level, *target), w.image(level, from.0), w.image(level, from.1));
            let (spot_a, spot_b, spot_x) = (w.spot(from.0), w.spot(from.1), w.spot(*target));
            let l = p.images[target.0].map_or(0.0, |q| q.to_vec2().norm());
            let vector = w.vector(level, *target);
            match w.lang {
                Lang::En => format!(
                    "On ${a}{b}$ make the triangle ${a}{b}{image}$ similar to ${spot_a}{spot_b}{spot_x}$, letters in the same order: ${vector}$ = {}.",
                    millimetres(l)
                ),
                Lang::Zh => format!(
                    "在 ${a}{b}$ 上作 ${a}{b}{image}$ 与 ${spot_a}{spot_b}{spot_x}$ 相似且字母顺序一致：${vector}$ = {}。",
                    millimetres(l)
                ),
            }
        }
        Action::Same { target, from } => {
            let (image, other) = (w.image(level, *target), w.image(level, *from));
            match w.lang {
                Lang::En => format!("The link does not turn: ${image}$ falls on ${other}$."),
                Lang::Zh => format!("构件作平动，${image}$ 与 ${other}$ 重合。"),
            }
        }
        Action::Rate(i) => {
            let r = &paper.rates[*i];
            let symbol = w.turning(level, r.body);
            let unit = if level == Level::Acceleration { "rad/s^2" } else { "rad/s" };
            let value = format!("{} {unit}", significant(r.value.abs(), 4));
            match (r.measured, w.lang) {
                (Some((mm, l)), _) => format!(
                    "${symbol}$ = {} · {} / {} m = ${value}${}{}",
                    millimetres(mm),
                    shortest(p.mu),
                    significant(l, 4),
                    tr(w.lang, ", ", "，"),
                    sense(w.lang, r.value)
                ),
                (None, _) => format!("${symbol}$ = ${value}${}{}", tr(w.lang, ", ", "，"), sense(w.lang, r.value)),
            }
        }
    }
}

/// What a pencil error (mm) makes of a crossing.
fn moved(lang: Lang, sine: f64, pencil_mm: Option<f64>) -> String {
    let Some(e) = pencil_mm else { return String::new() };
    let (e, by) = (shortest(e), format!("{} mm", significant(e / sine.abs(), 2)));
    match lang {
        Lang::En => format!(", where a pencil error of {e} mm moves it by {by}"),
        Lang::Zh => format!("（{e} mm 的作图误差使交点偏移 {by}）"),
    }
}

/// The mark at a place of the polygon.
fn place(w: &Writer, p: &Polygon, at: crate::geom::Point) -> String {
    let v = p.images.iter().enumerate().position(|(i, q)| *q == Some(at) && !w.plan.vertex(VertexId(i)).fixed);
    v.map_or_else(|| w.pole(p.level), |i| w.image(p.level, VertexId(i)))
}
