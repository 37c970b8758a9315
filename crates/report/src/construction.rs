//! The construction, step by step, as sentences with the lengths measured on paper.

use crate::amount::scale_formula;
use hodograph_base::digits::{inked, shortest, significant};
use hodograph_board::construct::{Action, PlanDrawing, Polygon, PolygonMark};
use hodograph_board::plan::names::name_label;
use hodograph_board::plan::text::PlanWriter;
use hodograph_board::plan::{Method, PlanStep, Rate, Term, TurningBody, VertexId};
use hodograph_paper::paper::phrase::{Phrase, formula, sense, tr};
use hodograph_scene::{Book, DiagramKind, Kind, Lang};
use hodograph_worked::certified::CertifiedSteps;
use hodograph_worked::certified::ladder::CertifiedNumber;
use hodograph_worked::certified::steps::StepNumber;

/// Returns the sentences of one polygon, one for each action, the pole first.
///
/// The numbers are the certified ones of [`steps`](hodograph_worked::certified::steps()); if these
/// contain a pencil error, each intersection has its displacement.
pub fn sentences(
    w: &PlanWriter,
    paper: &PlanDrawing,
    polygon: &Polygon,
    steps: &CertifiedSteps,
) -> Vec<Phrase> {
    let on = polygon.on;
    let (pole, mu) = (w.pole(on), scale_formula(&w.scene.book, on, polygon.mu));
    let mut out = vec![Phrase::new(&match w.lang {
        Lang::En if paper.is_empty(on) => {
            format!("Take the pole ${pole}$; nothing is drawn, so that there is no scale.")
        }
        Lang::Zh if paper.is_empty(on) => format!("取极点 ${pole}$；无矢量可作，不需比例尺。"),
        Lang::En => format!("Take the pole ${pole}$; scale ${mu}$."),
        Lang::Zh => format!("取极点 ${pole}$，比例尺 ${mu}$。"),
    })];
    out.extend(
        (0..polygon.actions.len()).map(|i| Phrase::new(&sentence(w, paper, polygon, i, steps))),
    );
    out
}

/// Returns the whole construction as numbered text, with the reason where a number has fewer digits
/// than its kind.
pub fn text(w: &PlanWriter, paper: &PlanDrawing, steps: &CertifiedSteps) -> String {
    let mut out = String::new();
    out.push_str(&format!(
        "{}{}{}\n",
        DiagramKind::Plane.name(w.lang),
        tr(w.lang, ": ", "："),
        formula(&scale_formula(&w.scene.book, DiagramKind::Plane, paper.diagram.mu))
    ));
    for on in DiagramKind::POLYGONS {
        let Some(p) = paper.polygon(on) else { continue };
        out.push('\n');
        out.push_str(&on.name(w.lang));
        out.push('\n');
        for (i, s) in sentences(w, paper, p, steps).iter().enumerate() {
            out.push_str(&format!("{:>3}. {}\n", i + 1, s.plain()));
        }
    }
    if let Some(why) = &steps.why {
        out.push_str(&format!(
            "\n{}{}\n",
            tr(
                w.lang,
                "numbers with fewer digits have no more that are certain: ",
                "位数较少的数值无更多可靠位数："
            ),
            why.words(w.lang)
        ));
    }
    out
}

/// Returns a step's number as far as it is certain, else the approximate value from the drawing in
/// `f64`.
fn certain_text(
    steps: &CertifiedSteps,
    on: DiagramKind,
    action: usize,
    what: StepNumber,
    rough: f64,
) -> String {
    steps.text(on, action, what).unwrap_or_else(|| format!("≈ {}", significant(rough, 1)))
}

/// Returns a plain number between words; one with a power of ten becomes a formula.
fn amid_words(text: &str) -> String {
    if text.contains('e') { format!("${}$", inked(text)) } else { text.into() }
}

/// Returns the letters of a mark: the pole, the image of a point, the end of a component.
pub fn mark(w: &PlanWriter, on: DiagramKind, m: &PolygonMark) -> String {
    match m {
        PolygonMark::Pole => w.pole(on),
        PolygonMark::Image(v) => w.image(on, *v),
        PolygonMark::Part(t) => w.part(on, t),
        PolygonMark::Again(t) => w.part(on, t).replacen('_', "'_", 1),
    }
}

fn symbols(w: &PlanWriter, on: DiagramKind, terms: &[Term]) -> String {
    terms.iter().map(|t| w.symbol(on, t)).collect::<Vec<_>>().join(" + ")
}

fn sentence(
    w: &PlanWriter,
    paper: &PlanDrawing,
    p: &Polygon,
    action: usize,
    steps: &CertifiedSteps,
) -> String {
    let on = p.on;
    let tell = |what, rough| amid_words(&certain_text(steps, on, action, what, rough));
    let millimetres = |k, rough: f64| format!("{} mm", tell(StepNumber::Length(k), rough));
    let edge = |k, i: usize| millimetres(k, p.edges[i].from.1.distance(p.edges[i].to.1));
    let from_pole = |v: VertexId| millimetres(0, p.images[v.0].map_or(0.0, |q| q.to_vec2().norm()));
    match &p.actions[action] {
        Action::LayOff(i) => {
            let e = &p.edges[*i];
            let t = &e.terms[0];
            let (from, to) = (mark(w, on, &e.from.0), mark(w, on, &e.to.0));
            let (symbol, magnitude, direction) =
                (w.symbol(on, t), w.magnitude(on, t), w.direction(t));
            let given = if magnitude == w.notation.known {
                String::new()
            } else {
                format!(" = {magnitude}")
            };
            let begins = matches!(e.to.0, PolygonMark::Image(v) if v == t.of);
            let chosen = w.choice(on, t.of).filter(|_| begins);
            match w.lang {
                Lang::En => {
                    let chosen =
                        chosen.map_or_else(String::new, |rate| format!("Choose ${rate}$: "));
                    let from_here = if chosen.is_empty() { "From" } else { "from" };
                    format!(
                        "{chosen}{from_here} ${from}$ lay off ${symbol}{given}$, {}, ${direction}$, which gives ${to}$.",
                        edge(0, *i)
                    )
                }
                Lang::Zh => {
                    let chosen = chosen.map_or_else(String::new, |rate| format!("取 ${rate}$，"));
                    format!(
                        "{chosen}自 ${from}$ 作 ${symbol}{given}$，长 {}，${direction}$，得 ${to}$。",
                        edge(0, *i)
                    )
                }
            }
        }
        Action::Nothing { terms, target, .. } => {
            let symbols: Vec<String> = terms.iter().map(|t| w.symbol(on, t)).collect();
            let (symbols, image) = (symbols.join(" = "), target.map(|v| w.image(on, v)));
            match (w.lang, image) {
                (Lang::En, None) => {
                    format!("${symbols}$ = 0, for the driver is at rest: nothing is laid off.")
                }
                (Lang::Zh, None) => format!("${symbols}$ = 0（原动件该瞬时静止），不作图。"),
                (Lang::En, Some(image)) => {
                    format!(
                        "${symbols}$ = 0, for the driver is at rest: nothing is laid off, ${image}$ lies where the vector would begin."
                    )
                }
                (Lang::Zh, Some(image)) => {
                    format!("${symbols}$ = 0（原动件该瞬时静止），不作图，${image}$ 即在其起点。")
                }
            }
        }
        Action::Line { terms, mark: from, .. } => {
            let from = mark(w, on, from);
            let (symbol, direction) = (symbols(w, on, terms), w.direction(&terms[0]));
            match w.lang {
                Lang::En => {
                    format!("Through ${from}$ draw the direction of ${symbol}$, ${direction}$.")
                }
                Lang::Zh => format!("过 ${from}$ 作 ${symbol}$ 的方向线，${direction}$。"),
            }
        }
        Action::Cross { target, edges, sine } => {
            let angle = tell(StepNumber::Angle, libm::asin(sine.abs().min(1.0)).to_degrees());
            let moved = steps.pencil_mm.map_or_else(String::new, |e| {
                moved(w.lang, e, &tell(StepNumber::Moved, e / sine.abs()))
            });
            let image = w.image(on, *target);
            let lengths: Vec<String> = edges
                .iter()
                .enumerate()
                .map(|(k, i)| format!("${}$ = {}", symbols(w, on, &p.edges[*i].terms), edge(k, *i)))
                .collect();
            match w.lang {
                Lang::En => {
                    format!(
                        "The lines intersect at ${image}$ at {angle}°{moved}: {}.",
                        lengths.join(", ")
                    )
                }
                Lang::Zh => {
                    format!("两线交于 ${image}$，交角 {angle}°{moved}：{}。", lengths.join("，"))
                }
            }
        }
        Action::Trials { target, sine, .. } => {
            let angle = tell(StepNumber::Angle, libm::asin(sine.abs().min(1.0)).to_degrees());
            let moved = steps.pencil_mm.map_or_else(String::new, |e| {
                moved(w.lang, e, &tell(StepNumber::Moved, e / sine.abs()))
            });
            let (image, vector, length) =
                (w.image(on, *target), w.vector(on, *target), from_pole(*target));
            let [a, b] =
                w.plan.trials(on, *target).map(|pair| pair.map(|v| w.image(on, v)).concat());
            match w.lang {
                Lang::En => {
                    format!(
                        "The lines ${a}$ and ${b}$ of the two trials intersect at ${image}$ at {angle}°{moved}: ${vector}$ = {length}."
                    )
                }
                Lang::Zh => format!(
                    "两次试作的直线 ${a}$ 与 ${b}$ 交于 ${image}$，交角 {angle}°{moved}：${vector}$ = {length}。"
                ),
            }
        }
        Action::Reach(v) => {
            let (image, vector) = (w.image(on, *v), w.vector(on, *v));
            if let Some((from, connection)) = touched(w, on, *v) {
                let why = equal_velocities(w, *v, connection);
                let (other, length) = (w.image(on, from), from_pole(*v));
                return match w.lang {
                    Lang::En => {
                        format!("{why}: ${image}$ falls on ${other}$, ${vector}$ = {length}.")
                    }
                    Lang::Zh => {
                        format!("{why}：${image}$ 与 ${other}$ 重合，${vector}$ = {length}。")
                    }
                };
            }
            match (w.lang, w.choice(on, *v)) {
                (Lang::En, None) => format!(
                    "Nothing is added: ${image}$ lies where it starts, ${vector}$ = {}.",
                    from_pole(*v)
                ),
                (Lang::Zh, None) => {
                    format!("无附加分量，${image}$ 即在起点，${vector}$ = {}。", from_pole(*v))
                }
                (Lang::En, Some(rate)) => format!(
                    "Choose ${rate}$: ${image}$ lies where it starts, ${vector}$ = {}.",
                    from_pole(*v)
                ),
                (Lang::Zh, Some(rate)) => {
                    format!("取 ${rate}$，${image}$ 即在起点，${vector}$ = {}。", from_pole(*v))
                }
            }
        }
        Action::Copy { target, from } => {
            let (image, a, b) = (w.image(on, *target), w.image(on, from.0), w.image(on, from.1));
            let (spot_a, spot_b, spot_x) = (w.spot(from.0), w.spot(from.1), w.spot(*target));
            let vector = w.vector(on, *target);
            let in_line = paper.diagram.in_line([from.0, from.1, *target]);
            match w.lang {
                Lang::En if in_line => format!(
                    "On the line ${a}{b}$ mark ${image}$ so that ${a}{b}/{a}{image} = {spot_a}{spot_b}/{spot_a}{spot_x}$, in the same order: ${vector}$ = {}.",
                    from_pole(*target)
                ),
                Lang::Zh if in_line => format!(
                    "在 ${a}{b}$ 所在直线上取 ${image}$，使 ${a}{b}/{a}{image} = {spot_a}{spot_b}/{spot_a}{spot_x}$ 且字母顺序一致：${vector}$ = {}。",
                    from_pole(*target)
                ),
                Lang::En => format!(
                    "On ${a}{b}$ construct the triangle ${a}{b}{image}$ similar to ${spot_a}{spot_b}{spot_x}$, letters in the same order: ${vector}$ = {}.",
                    from_pole(*target)
                ),
                Lang::Zh => format!(
                    "以 ${a}{b}$ 为一边作三角形 ${a}{b}{image}$，使其与三角形 ${spot_a}{spot_b}{spot_x}$ 相似且字母顺序一致：${vector}$ = {}。",
                    from_pole(*target)
                ),
            }
        }
        Action::Join(i) => {
            let e = &p.edges[*i];
            let (from, to) = (mark(w, on, &e.from.0), mark(w, on, &e.to.0));
            let symbol = symbols(w, on, &e.terms);
            match w.lang {
                Lang::En => format!("Join ${from}$ and ${to}$: ${symbol}$ = {}.", edge(0, *i)),
                Lang::Zh => format!("连接 ${from}$、${to}$：${symbol}$ = {}。", edge(0, *i)),
            }
        }
        Action::Perpendicular { edges: [along, across], .. } => {
            let (n, t) = (&p.edges[*along], &p.edges[*across]);
            let [from, foot, to] = [&n.from.0, &n.to.0, &t.to.0].map(|m| mark(w, on, m));
            let line = w.line(n.terms[0].of, n.terms[0].to);
            let [normal, tangential] = [n, t].map(|e| symbols(w, on, &e.terms));
            let lengths = [edge(0, *along), edge(1, *across)];
            match w.lang {
                Lang::En => format!(
                    "From ${to}$ drop the perpendicular on the parallel to ${line}$ through ${from}$; its foot is ${foot}$: ${normal}$ = {}, ${tangential}$ = {}.",
                    lengths[0], lengths[1]
                ),
                Lang::Zh => format!(
                    "自 ${to}$ 向过 ${from}$ 且平行于 ${line}$ 的直线作垂线，垂足为 ${foot}$：${normal}$ = {}，${tangential}$ = {}。",
                    lengths[0], lengths[1]
                ),
            }
        }
        Action::Same { target, from } => {
            let (image, other) = (w.image(on, *target), w.image(on, *from));
            match w.lang {
                Lang::En => format!("The link does not turn: ${image}$ falls on ${other}$."),
                Lang::Zh => format!("构件作平动，${image}$ 与 ${other}$ 重合。"),
            }
        }
        Action::Rate(i) => {
            let r = &paper.rates[*i];
            let symbol = w.turning(on, r.body);
            let book = &w.scene.book;
            let value = certain_text(
                steps,
                on,
                action,
                StepNumber::Rate,
                book.value(on.turning(), r.value.abs()),
            );
            let value = book.label(on.turning(), &inked(value.trim_start_matches('-')));
            let sign =
                steps.number(on, action, StepNumber::Rate).map_or(r.value, CertifiedNumber::sign);
            let sense = if sign == 0.0 { String::new() } else { sense(w.lang, sign).to_string() };
            let sense = if sense.is_empty() {
                String::new()
            } else {
                format!("{}{sense}", tr(w.lang, ", ", "，"))
            };
            let [verb, given, is, stop] = match w.lang {
                Lang::En => ["Calculate ", "", "is given as", "."],
                Lang::Zh => ["计算 ", "已知 ", "=", "。"],
            };
            match r.measured {
                Some(m) => format!(
                    "{verb}${symbol}$ = {} · {} / {} = ${value}${sense}{stop}",
                    millimetres(0, m.length),
                    factor(book, on, p.mu),
                    book.text(
                        Kind::Length,
                        &tell(StepNumber::Arm, book.value(Kind::Length, m.arm))
                    ),
                ),
                None if w.plan.is_still(r.body) => match w.lang {
                    Lang::En => format!("The link does not turn: ${symbol}$ = 0."),
                    Lang::Zh => format!("构件作平动：${symbol}$ = 0。"),
                },
                None => match sum(w, on, r.body) {
                    Some(sum) => format!("{verb}${symbol} = {sum}$ = ${value}${sense}{stop}"),
                    None => format!("{given}${symbol}$ {is} ${value}${sense}{stop}"),
                },
            }
        }
    }
}

/// Returns the reason why the point of a vertex has the velocity of the point from which it is
/// found: a strand or a contact without slip, or a point that belongs to two links.
fn equal_velocities(w: &PlanWriter, v: VertexId, connection: Method) -> String {
    let common = w.plan.special(v).and_then(|s| Some([s.link, s.with?]));
    match (connection, common, w.lang) {
        (Method::Strand, _, Lang::En) => {
            "As the strand does not slip, its two ends have one velocity".into()
        }
        (Method::Strand, _, Lang::Zh) => "带（链）段不打滑，两端点速度相同".into(),
        (_, Some(links), lang) => {
            let (point, [a, b]) = (w.spot(v), links.map(|l| w.scene.link_name(l)));
            match lang {
                Lang::En => format!(
                    "As ${point}$ is a common point of links {a} and {b}, it has one velocity on both"
                ),
                Lang::Zh => format!("${point}$ 为构件 {a} 与 {b} 的公共点，在两构件上速度相同"),
            }
        }
        (_, None, Lang::En) => "At the contact the two points have one velocity".into(),
        (_, None, Lang::Zh) => "接触点处两点速度相同".into(),
    }
}

/// Returns the point of the other link from which a point has its velocity (at a contact, a strand
/// without slip or a common point of two links), and the kind of the connection.
fn touched(w: &PlanWriter, on: DiagramKind, v: VertexId) -> Option<(VertexId, Method)> {
    let moves = !w.plan.rest.is_all();
    let alike = |s: &PlanStep| match s {
        PlanStep::Equation {
            target,
            chains,
            method: method @ (Method::Coincident | Method::Strand),
        } if *target == v && moves => match &chains[..] {
            [chain] if chain.known.is_empty() && chain.unknown.is_empty() => {
                Some((chain.start, *method))
            }
            _ => None,
        },
        PlanStep::Equation { .. }
        | PlanStep::Image { .. }
        | PlanStep::Trials { .. }
        | PlanStep::Same { .. } => None,
    };
    let groups = w.plan.steps(on).iter();
    groups.flat_map(|g| g.alternatives.iter().flatten().chain(&g.further)).find_map(alike)
}

/// Returns the sum from which an angular rate follows that is neither measured nor given relative
/// to the ground.
fn sum(w: &PlanWriter, on: DiagramKind, body: TurningBody) -> Option<String> {
    let rates = w.plan.steps(on).iter().flat_map(|g| &g.rates);
    match rates.clone().find(|(b, _)| *b == body)?.1 {
        Rate::Same(other) => Some(w.turning(on, TurningBody::Link(other))),
        Rate::Given { driver, against } if against != w.scene.ground => {
            let (link, of) = w.scene.drivers[driver].kind.turned()?;
            let sign = if TurningBody::Link(link) == body { "+" } else { "-" };
            let pair = [link, of].map(|l| name_label(w.scene.link_name(l))).join("/");
            let letter = on.turning_letter();
            Some(format!(
                "{} {sign} {letter}_{{{pair}}}",
                w.turning(on, TurningBody::Link(against))
            ))
        }
        Rate::Given { .. } | Rate::Measured { .. } | Rate::Zero => None,
    }
}

/// Returns a scale as a factor of an angular velocity, with its unit, in a form suitable for a
/// product.
fn factor(book: &Book, on: DiagramKind, mu: f64) -> String {
    format!("${} {}$", inked(&shortest(book.value(on.kind(), mu))), book.scale_label(on.kind()))
}

/// Returns the effect of a pencil error (mm) on an intersection.
fn moved(lang: Lang, pencil_mm: f64, by: &str) -> String {
    let e = shortest(pencil_mm);
    match lang {
        Lang::En => format!(", where a pencil error of {e} mm moves it by {by} mm"),
        Lang::Zh => format!("（{e} mm 的作图误差使交点偏移 {by} mm）"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::forces::ForceWriter;
    use hodograph_base::notation::Notation;
    use hodograph_scene::{read, templates};
    use hodograph_worked::certified::steps;
    use hodograph_worked::worked::{Scope, work};

    /// The steps of a group of class IV: a common point of two links touches nothing, and no formula
    /// that is continued on a new line has its sign stuck to the next force.
    #[test]
    fn steps_of_a_class_iv_group_are_those_of_its_common_point() {
        let scene = read(templates::get("class-iv-six-bar").unwrap()).unwrap().value;
        let worked = work(&scene, Scope::Questions).unwrap().value;
        let reasons = [
            "As U is a common point of links 2 and 5, it has one velocity on both: u_2 falls on u_5",
            "U 为构件 2 与 5 的公共点，在两构件上速度相同：u_2 与 u_5 重合",
        ];
        for (lang, reason) in [Lang::En, Lang::Zh].into_iter().zip(reasons) {
            let notation = Notation::of_language(lang);
            let w = PlanWriter { scene: &scene, plan: &worked.plan, notation: &notation, lang };
            let said = text(&w, &worked.construction, &steps(&scene, &worked, None));
            assert!(said.contains(reason), "{said}");
            assert!(!said.contains("contact") && !said.contains("接触"), "{said}");
            let plan = crate::plan::text(&scene, &worked.mechanism, &w, None);
            let method = tr(
                lang,
                "a_U2(1) — special point method, α_2(1) = 0 chosen",
                "a_U2(1) — 特殊点法，取 α_2(1) = 0",
            );
            assert!(plan.contains(method) && !plan.contains(tr(lang, "trial", "试作")), "{plan}");
            let of = worked.equilibrium.as_ref().unwrap();
            let forces = ForceWriter { scene: &scene, notation: &notation, lang, of }.text();
            assert!(forces.contains("65^t + F_"), "{forces}");
        }
    }
}
