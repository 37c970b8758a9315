//! The construction, step by step, as sentences with the lengths measured on paper.

use crate::amount::scale_formula;
use hodograph_base::digits::{inked, shortest, significant};
use hodograph_base::lang::{say, tr};
use hodograph_board::construct::{Action, PlanDrawing, Polygon, PolygonMark};
use hodograph_board::plan::names::name_label;
use hodograph_board::plan::text::PlanWriter;
use hodograph_board::plan::{Method, PlanStep, Rate, Term, TurningBody, VertexId};
use hodograph_paper::paper::phrase::{Phrase, formula, sense};
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
    let mut out = vec![Phrase::new(&match paper.is_empty(on) {
        true => {
            say!(w.lang, "Take the pole ${pole}$; nothing is drawn, so that there is no scale.")
        }
        false => say!(w.lang, "Take the pole ${pole}$; scale ${mu}$."),
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
        tr!(w.lang, ": "),
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
            tr!(w.lang, "numbers with fewer digits have no more that are certain: "),
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
            match chosen {
                Some(rate) => say!(
                    w.lang,
                    "Choose ${rate}$: from ${from}$ lay off ${symbol}{given}$, {}, ${direction}$, which gives ${to}$.",
                    edge(0, *i)
                ),
                None => say!(
                    w.lang,
                    "From ${from}$ lay off ${symbol}{given}$, {}, ${direction}$, which gives ${to}$.",
                    edge(0, *i)
                ),
            }
        }
        Action::Nothing { terms, target, .. } => {
            let symbols: Vec<String> = terms.iter().map(|t| w.symbol(on, t)).collect();
            let (symbols, image) = (symbols.join(" = "), target.map(|v| w.image(on, v)));
            match image {
                None => {
                    say!(w.lang, "${symbols}$ = 0, for the driver is at rest: nothing is laid off.")
                }
                Some(image) => say!(
                    w.lang,
                    "${symbols}$ = 0, for the driver is at rest: nothing is laid off, ${image}$ lies where the vector would begin."
                ),
            }
        }
        Action::Line { terms, mark: from, .. } => {
            let from = mark(w, on, from);
            let (symbol, direction) = (symbols(w, on, terms), w.direction(&terms[0]));
            say!(w.lang, "Through ${from}$ draw the direction of ${symbol}$, ${direction}$.")
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
            say!(
                w.lang,
                "The lines intersect at ${image}$ at {angle}°{moved}: {}.",
                lengths.join(w.lang.pick([", ", "，"]))
            )
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
            say!(
                w.lang,
                "The lines ${a}$ and ${b}$ of the two trials intersect at ${image}$ at {angle}°{moved}: ${vector}$ = {length}."
            )
        }
        Action::Reach(v) => {
            let (image, vector) = (w.image(on, *v), w.vector(on, *v));
            if let Some((from, connection)) = touched(w, on, *v) {
                let why = equal_velocities(w, *v, connection);
                let (other, length) = (w.image(on, from), from_pole(*v));
                return say!(w.lang, "{why}: ${image}$ falls on ${other}$, ${vector}$ = {length}.");
            }
            match w.choice(on, *v) {
                None => say!(
                    w.lang,
                    "Nothing is added: ${image}$ lies where it starts, ${vector}$ = {}.",
                    from_pole(*v)
                ),
                Some(rate) => say!(
                    w.lang,
                    "Choose ${rate}$: ${image}$ lies where it starts, ${vector}$ = {}.",
                    from_pole(*v)
                ),
            }
        }
        Action::Copy { target, from } => {
            let (image, a, b) = (w.image(on, *target), w.image(on, from.0), w.image(on, from.1));
            let (spot_a, spot_b, spot_x) = (w.spot(from.0), w.spot(from.1), w.spot(*target));
            let vector = w.vector(on, *target);
            let in_line = paper.diagram.in_line([from.0, from.1, *target]);
            match in_line {
                true => say!(
                    w.lang,
                    "On the line ${a}{b}$ mark ${image}$ so that ${a}{b}/{a}{image} = {spot_a}{spot_b}/{spot_a}{spot_x}$, in the same order: ${vector}$ = {}.",
                    from_pole(*target)
                ),
                false => say!(
                    w.lang,
                    "On ${a}{b}$ construct the triangle ${a}{b}{image}$ similar to ${spot_a}{spot_b}{spot_x}$, letters in the same order: ${vector}$ = {}.",
                    from_pole(*target)
                ),
            }
        }
        Action::Join(i) => {
            let e = &p.edges[*i];
            let (from, to) = (mark(w, on, &e.from.0), mark(w, on, &e.to.0));
            let symbol = symbols(w, on, &e.terms);
            say!(w.lang, "Join ${from}$ and ${to}$: ${symbol}$ = {}.", edge(0, *i))
        }
        Action::Perpendicular { edges: [along, across], .. } => {
            let (n, t) = (&p.edges[*along], &p.edges[*across]);
            let [from, foot, to] = [&n.from.0, &n.to.0, &t.to.0].map(|m| mark(w, on, m));
            let line = w.line(n.terms[0].of, n.terms[0].to);
            let [normal, tangential] = [n, t].map(|e| symbols(w, on, &e.terms));
            let lengths = [edge(0, *along), edge(1, *across)];
            say!(
                w.lang,
                "From ${to}$ drop the perpendicular on the parallel to ${line}$ through ${from}$; its foot is ${foot}$: ${normal}$ = {}, ${tangential}$ = {}.",
                lengths[0],
                lengths[1]
            )
        }
        Action::Same { target, from } => {
            let (image, other) = (w.image(on, *target), w.image(on, *from));
            say!(w.lang, "The link does not turn: ${image}$ falls on ${other}$.")
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
                format!("{}{sense}", tr!(w.lang, "clause" => ", "))
            };
            match r.measured {
                Some(m) => say!(
                    w.lang,
                    "Calculate ${symbol}$ = {} · {} / {} = ${value}${sense}.",
                    millimetres(0, m.length),
                    factor(book, on, p.mu),
                    book.text(
                        Kind::Length,
                        &tell(StepNumber::Arm, book.value(Kind::Length, m.arm))
                    ),
                ),
                None if w.plan.is_still(r.body) => {
                    say!(w.lang, "The link does not turn: ${symbol}$ = 0.")
                }
                None => match sum(w, on, r.body) {
                    Some(sum) => say!(w.lang, "Calculate ${symbol} = {sum}$ = ${value}${sense}."),
                    None => say!(w.lang, "${symbol}$ is given as ${value}${sense}."),
                },
            }
        }
    }
}

/// Returns the reason why the point of a vertex has the velocity of the point from which it is
/// found: a strand or a contact without slip, or a point that belongs to two links.
fn equal_velocities(w: &PlanWriter, v: VertexId, connection: Method) -> String {
    let common = w.plan.special(v).and_then(|s| Some([s.link, s.with?]));
    match (connection, common) {
        (Method::Strand, _) => {
            tr!(w.lang, "As the strand does not slip, its two ends have one velocity").into()
        }
        (_, Some(links)) => {
            let (point, [a, b]) = (w.spot(v), links.map(|l| w.scene.link_name(l)));
            say!(
                w.lang,
                "As ${point}$ is a common point of links {a} and {b}, it has one velocity on both"
            )
        }
        (_, None) => tr!(w.lang, "At the contact the two points have one velocity").into(),
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
    say!(lang, ", where a pencil error of {e} mm moves it by {by} mm")
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
            let method = tr!(lang, "a_U2(1) — special point method, α_2(1) = 0 chosen");
            assert!(plan.contains(method) && !plan.contains(tr!(lang, "trial")), "{plan}");
            let of = worked.equilibrium.as_ref().unwrap();
            let forces = ForceWriter { scene: &scene, notation: &notation, lang, of }.text();
            assert!(forces.contains("65^t + F_"), "{forces}");
        }
    }
}
