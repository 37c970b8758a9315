//! The construction, step by step, as sentences with the lengths measured on paper.

use crate::amount::of_level;
use hodograph_base::digits::{inked, shortest, significant};
use hodograph_board::construct::{Action, Construction, Mark, Polygon};
use hodograph_board::plan::names::name_label;
use hodograph_board::plan::text::Writer;
use hodograph_board::plan::{Body, Method, Rate, Step, Term, VertexId};
use hodograph_mechanism::mechanism::Level;
use hodograph_paper::paper::phrase::{Phrase, formula, sense, tr};
use hodograph_scene::{Book, Kind, Lang};
use hodograph_worked::certified::Steps;
use hodograph_worked::certified::ladder::Number;
use hodograph_worked::certified::steps::What;

/// The sentences of one polygon, one for each action, the pole first. Their numbers are the certified ones of
/// [`steps`](hodograph_worked::certified::steps()); where those know of a pencil error, how far it moves each crossing.
pub fn sentences(w: &Writer, paper: &Construction, polygon: &Polygon, steps: &Steps) -> Vec<Phrase> {
    let level = polygon.level;
    let (pole, mu) = (w.pole(level), of_level(&w.scene.book, level, polygon.mu));
    let mut out = vec![Phrase::new(&match w.lang {
        Lang::En if paper.is_empty(level) => format!("Take the pole ${pole}$; nothing is drawn, so that there is no scale."),
        Lang::Zh if paper.is_empty(level) => format!("取极点 ${pole}$；无矢量可作，不需比例尺。"),
        Lang::En => format!("Take the pole ${pole}$; scale ${mu}$."),
        Lang::Zh => format!("取极点 ${pole}$，比例尺 ${mu}$。"),
    })];
    out.extend((0..polygon.actions.len()).map(|i| Phrase::new(&sentence(w, paper, polygon, i, steps))));
    out
}

/// The whole construction as numbered text; why, where a number has fewer digits than its kind.
pub fn text(w: &Writer, paper: &Construction, steps: &Steps) -> String {
    let mut out = String::new();
    out.push_str(&format!(
        "{}{}\n",
        tr(w.lang, "kinematic diagram: ", "机构运动简图："),
        formula(&of_level(&w.scene.book, Level::Position, paper.diagram.mu))
    ));
    for level in Level::RATES {
        let Some(p) = paper.polygon(level) else { continue };
        out.push('\n');
        out.push_str(match level {
            Level::Acceleration => tr(w.lang, "acceleration polygon", "加速度多边形"),
            Level::Position | Level::Velocity => tr(w.lang, "velocity polygon", "速度多边形"),
        });
        out.push('\n');
        for (i, s) in sentences(w, paper, p, steps).iter().enumerate() {
            out.push_str(&format!("{:>3}. {}\n", i + 1, s.plain()));
        }
    }
    if let Some(why) = &steps.why {
        out.push_str(&format!(
            "\n{}{}\n",
            tr(w.lang, "numbers with fewer digits have no more that are certain: ", "位数较少的数值无更多可靠位数："),
            why.words(w.lang)
        ));
    }
    out
}

/// A step's number as far as it is certain, else about what the drawing in `f64` says.
fn told(steps: &Steps, level: Level, action: usize, what: What, rough: f64) -> String {
    steps.text(level, action, what).unwrap_or_else(|| format!("≈ {}", significant(rough, 1)))
}

/// A plain number between words: with a power of ten it is a formula.
fn amid_words(text: &str) -> String {
    if text.contains('e') { format!("${}$", inked(text)) } else { text.into() }
}

/// The letters of a mark: the pole, the image of a point, the end of a part.
pub fn mark(w: &Writer, level: Level, m: &Mark) -> String {
    match m {
        Mark::Pole => w.pole(level),
        Mark::Image(v) => w.image(level, *v),
        Mark::Part(t) => w.part(level, t),
        Mark::Again(t) => w.part(level, t).replacen('_', "'_", 1),
    }
}

fn symbols(w: &Writer, level: Level, terms: &[Term]) -> String {
    terms.iter().map(|t| w.symbol(level, t)).collect::<Vec<_>>().join(" + ")
}

fn sentence(w: &Writer, paper: &Construction, p: &Polygon, action: usize, steps: &Steps) -> String {
    let level = p.level;
    let tell = |what, rough| amid_words(&told(steps, level, action, what, rough));
    let millimetres = |k, rough: f64| format!("{} mm", tell(What::Length(k), rough));
    let edge = |k, i: usize| millimetres(k, p.edges[i].from.1.distance(p.edges[i].to.1));
    let from_pole = |v: VertexId| millimetres(0, p.images[v.0].map_or(0.0, |q| q.to_vec2().norm()));
    match &p.actions[action] {
        Action::LayOff(i) => {
            let e = &p.edges[*i];
            let t = &e.terms[0];
            let (from, to) = (mark(w, level, &e.from.0), mark(w, level, &e.to.0));
            let (symbol, magnitude, direction) = (w.symbol(level, t), w.magnitude(level, t), w.direction(t));
            let given = if magnitude == w.notation.known { String::new() } else { format!(" = {magnitude}") };
            match w.lang {
                Lang::En => format!("From ${from}$ lay off ${symbol}{given}$, {}, ${direction}$, which gives ${to}$.", edge(0, *i)),
                Lang::Zh => format!("自 ${from}$ 作 ${symbol}{given}$，长 {}，${direction}$，得 ${to}$。", edge(0, *i)),
            }
        }
        Action::Nothing { terms, target, .. } => {
            let symbols: Vec<String> = terms.iter().map(|t| w.symbol(level, t)).collect();
            let (symbols, image) = (symbols.join(" = "), target.map(|v| w.image(level, v)));
            match (w.lang, image) {
                (Lang::En, None) => format!("${symbols}$ = 0, for the driver is at rest: nothing is laid off."),
                (Lang::Zh, None) => format!("${symbols}$ = 0（原动件该瞬时静止），不作图。"),
                (Lang::En, Some(image)) => {
                    format!("${symbols}$ = 0, for the driver is at rest: nothing is laid off, ${image}$ lies where the vector would begin.")
                }
                (Lang::Zh, Some(image)) => format!("${symbols}$ = 0（原动件该瞬时静止），不作图，${image}$ 即在其起点。"),
            }
        }
        Action::Line { terms, mark: from, .. } => {
            let from = mark(w, level, from);
            let (symbol, direction) = (symbols(w, level, terms), w.direction(&terms[0]));
            match w.lang {
                Lang::En => format!("Through ${from}$ draw the direction of ${symbol}$, ${direction}$."),
                Lang::Zh => format!("过 ${from}$ 作 ${symbol}$ 的方向线，${direction}$。"),
            }
        }
        Action::Cross { target, edges, sine } => {
            let angle = tell(What::Angle, libm::asin(sine.abs().min(1.0)).to_degrees());
            let moved = steps.pencil_mm.map_or_else(String::new, |e| moved(w.lang, e, &tell(What::Moved, e / sine.abs())));
            let image = w.image(level, *target);
            let lengths: Vec<String> =
                edges.iter().enumerate().map(|(k, i)| format!("${}$ = {}", symbols(w, level, &p.edges[*i].terms), edge(k, *i))).collect();
            match w.lang {
                Lang::En => {
                    format!("The lines intersect at ${image}$ at {angle}°{moved}: {}.", lengths.join(", "))
                }
                Lang::Zh => format!("两线交于 ${image}$，交角 {angle}°{moved}：{}。", lengths.join("，")),
            }
        }
        Action::Reach(v) => {
            let (image, vector) = (w.image(level, *v), w.vector(level, *v));
            if let Some((from, method)) = touched(w, level, *v) {
                let why = match method {
                    Method::Strand => {
                        tr(w.lang, "As the strand does not slip, its two ends have one velocity", "带（链）段不打滑，两端点速度相同")
                    }
                    Method::Coincident | Method::Driven | Method::SameLink | Method::Cylinder | Method::Special => {
                        tr(w.lang, "At the contact the two points have one velocity", "接触点处两点速度相同")
                    }
                };
                let (other, length) = (w.image(level, from), from_pole(*v));
                return match w.lang {
                    Lang::En => format!("{why}: ${image}$ falls on ${other}$, ${vector}$ = {length}."),
                    Lang::Zh => format!("{why}：${image}$ 与 ${other}$ 重合，${vector}$ = {length}。"),
                };
            }
            match w.lang {
                Lang::En => format!("Nothing is added: ${image}$ lies where it starts, ${vector}$ = {}.", from_pole(*v)),
                Lang::Zh => format!("无附加分量，${image}$ 即在起点，${vector}$ = {}。", from_pole(*v)),
            }
        }
        Action::Copy { target, from } => {
            let (image, a, b) = (w.image(level, *target), w.image(level, from.0), w.image(level, from.1));
            let (spot_a, spot_b, spot_x) = (w.spot(from.0), w.spot(from.1), w.spot(*target));
            let vector = w.vector(level, *target);
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
            let (from, to) = (mark(w, level, &e.from.0), mark(w, level, &e.to.0));
            let symbol = symbols(w, level, &e.terms);
            match w.lang {
                Lang::En => format!("Join ${from}$ and ${to}$: ${symbol}$ = {}.", edge(0, *i)),
                Lang::Zh => format!("连接 ${from}$、${to}$：${symbol}$ = {}。", edge(0, *i)),
            }
        }
        Action::Perpendicular { edges: [along, across], .. } => {
            let (n, t) = (&p.edges[*along], &p.edges[*across]);
            let [from, foot, to] = [&n.from.0, &n.to.0, &t.to.0].map(|m| mark(w, level, m));
            let line = w.line(n.terms[0].of, n.terms[0].to);
            let [normal, tangential] = [n, t].map(|e| symbols(w, level, &e.terms));
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
            let (image, other) = (w.image(level, *target), w.image(level, *from));
            match w.lang {
                Lang::En => format!("The link does not turn: ${image}$ falls on ${other}$."),
                Lang::Zh => format!("构件作平动，${image}$ 与 ${other}$ 重合。"),
            }
        }
        Action::Rate(i) => {
            let r = &paper.rates[*i];
            let symbol = w.turning(level, r.body);
            let book = &w.scene.book;
            let value = told(steps, level, action, What::Rate, book.value(level.turning(), r.value.abs()));
            let value = book.label(level.turning(), &inked(value.trim_start_matches('-')));
            let sign = steps.number(level, action, What::Rate).map_or(r.value, Number::sign);
            let sense = if sign == 0.0 { String::new() } else { sense(w.lang, sign).to_string() };
            let sense = if sense.is_empty() { String::new() } else { format!("{}{sense}", tr(w.lang, ", ", "，")) };
            let [verb, given, is, stop] = match w.lang {
                Lang::En => ["Calculate ", "", "is given as", "."],
                Lang::Zh => ["计算 ", "已知 ", "=", "。"],
            };
            match r.measured {
                Some(m) => format!(
                    "{verb}${symbol}$ = {} · {} / {} = ${value}${sense}{stop}",
                    millimetres(0, m.length),
                    factor(book, level, p.mu),
                    book.text(Kind::Length, &tell(What::Arm, book.value(Kind::Length, m.arm))),
                ),
                None if w.plan.is_still(r.body) => match w.lang {
                    Lang::En => format!("The link does not turn: ${symbol}$ = 0."),
                    Lang::Zh => format!("构件作平动：${symbol}$ = 0。"),
                },
                None => match sum(w, level, r.body) {
                    Some(sum) => format!("{verb}${symbol} = {sum}$ = ${value}${sense}{stop}"),
                    None => format!("{given}${symbol}$ {is} ${value}${sense}{stop}"),
                },
            }
        }
    }
}

/// The point of the other link at a contact, or a strand, without slip from which a point has its velocity; and which of the two it is.
fn touched(w: &Writer, level: Level, v: VertexId) -> Option<(VertexId, Method)> {
    let moves = !w.plan.rest.is_all();
    let alike = |s: &Step| match s {
        Step::Equation { target, chains, method: method @ (Method::Coincident | Method::Strand) } if *target == v && moves => {
            match &chains[..] {
                [chain] if chain.known.is_empty() && chain.unknown.is_empty() => Some((chain.start, *method)),
                _ => None,
            }
        }
        Step::Equation { .. } | Step::Image { .. } | Step::Same { .. } => None,
    };
    let groups = w.plan.steps(level).iter();
    groups.flat_map(|g| g.alternatives.iter().flatten().chain(&g.further)).find_map(alike)
}

/// Of a rate that is neither measured nor given against the ground: the others of which it is the sum.
fn sum(w: &Writer, level: Level, body: Body) -> Option<String> {
    let rates = w.plan.steps(level).iter().flat_map(|g| &g.rates);
    match rates.clone().find(|(b, _)| *b == body)?.1 {
        Rate::Same(other) => Some(w.turning(level, Body::Link(other))),
        Rate::Given { driver, against } if against != w.scene.ground => {
            let (link, of) = w.scene.drivers[driver].kind.turned()?;
            let sign = if Body::Link(link) == body { "+" } else { "-" };
            let pair = [link, of].map(|l| name_label(w.scene.link_name(l))).join("/");
            let letter = if level == Level::Acceleration { "\\alpha" } else { "\\omega" };
            Some(format!("{} {sign} {letter}_{{{pair}}}", w.turning(level, Body::Link(against))))
        }
        Rate::Given { .. } | Rate::Measured { .. } | Rate::Zero => None,
    }
}

/// A scale as a factor of an angular velocity, with its unit, so that the product is right as it stands.
fn factor(book: &Book, level: Level, mu: f64) -> String {
    format!("${} {}$", inked(&shortest(book.value(level.kind(), mu))), book.scale_label(level.kind()))
}

/// What a pencil error (mm) makes of a crossing.
fn moved(lang: Lang, pencil_mm: f64, by: &str) -> String {
    let e = shortest(pencil_mm);
    match lang {
        Lang::En => format!(", where a pencil error of {e} mm moves it by {by} mm"),
        Lang::Zh => format!("（{e} mm 的作图误差使交点偏移 {by} mm）"),
    }
}
