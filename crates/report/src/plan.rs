//! The plan as text: groups, effects, equations in solving order.

use crate::equation::mate;
use crate::forces::ForceWriter;
use crate::replaced::replaced_words;
use hodograph_base::digits::minus;
use hodograph_board::plan::names::name_label;
use hodograph_board::plan::text::{EquationColumn, PlanWriter};
use hodograph_board::plan::{
    Between, Effect, GroupSteps, Method, PlanStep, Rate, Reason, Special, SpecialLine, Term,
    TurningBody,
};
use hodograph_mechanism::mechanism::{Assur, ConstraintLine, Mechanism, PairItem, moved_words};
use hodograph_paper::paper::phrase::{Phrase, formula, tr};
use hodograph_scene::{DiagramKind, GuideId, Lang, PointId, Scene};
use unicode_width::UnicodeWidthStr;

/// Returns the complete plan, followed by the plan of forces if forces are requested and the pose
/// can be solved.
pub fn text(scene: &Scene, m: &Mechanism, w: &PlanWriter, forces: Option<&ForceWriter>) -> String {
    let mut out = String::new();
    let mut line = |s: String| {
        out.push_str(s.trim_end());
        out.push('\n');
    };
    let lang = w.lang;
    let title = scene.title.get(lang);
    if !title.is_empty() {
        line(title.to_string());
    }
    let f = &m.mobility;
    line(format!(
        "{}F = 3·{} − 2·{} − {} = {}{}{}",
        tr(lang, "mobility: ", "自由度："),
        f.moving,
        f.lower,
        f.higher,
        minus(&f.freedom.to_string()),
        tr(lang, "; ", "；"),
        match (lang, scene.own_drivers()) {
            (Lang::En, 1) => "1 driver".to_string(),
            (Lang::En, n) => format!("{n} drivers"),
            (Lang::Zh, n) => format!("原动件 {n} 个"),
        }
    ));
    line(String::new());
    line(tr(lang, "groups in solving order", "杆组（按求解顺序）").into());
    let mut number = 0;
    for g in m.assur(scene).iter().filter(|g| !g.is_carried()) {
        number += 1;
        line(format!("  {number}. {}", group_words(scene, m, g, lang)));
    }
    for words in replaced_words(scene) {
        line(format!("  {}", lang.of(&words)));
    }
    line(String::new());
    line(tr(lang, "effects", "考虑的因素").into());
    for (effect, included, reason) in &w.plan.effects {
        line(format!(
            "  {} {}{}{}",
            if *included { tr(lang, "in ", "计入") } else { tr(lang, "out", "不计") },
            effect_words(scene, m, *effect, lang),
            tr(lang, ": ", "："),
            reason_words(*reason, lang)
        ));
    }
    let mut equation = 0;
    for on in DiagramKind::POLYGONS {
        let steps = w.plan.steps(on);
        if steps.is_empty() {
            continue;
        }
        line(String::new());
        line(lang.of(&on.vectors()).to_owned());
        for group in steps {
            for text in group_lines(w, on, group, &mut equation) {
                line(format!("  {text}"));
            }
        }
    }
    if let Some(forces) = forces {
        line(String::new());
        line(forces.plan(equation));
    }
    for g in &w.plan.undrawable {
        let names: Vec<_> = m.groups[*g].links.iter().map(|l| scene.link_name(*l)).collect();
        line(format!(
            "{} {}{}{}",
            tr(lang, "links", "构件"),
            names.join(tr(lang, ", ", "、")),
            tr(lang, ": ", "："),
            tr(
                lang,
                "in or behind a group higher than class III, not drawn; `solve` answers from the loop equations",
                "属于Ⅳ级及以上杆组或在其后，不能作图；solve 由解析法给出结果"
            )
        ));
    }
    out
}

/// Returns the class of a group or of a mechanism in Chinese notation.
pub fn grade(class: &str) -> &'static str {
    match class {
        "I" => "Ⅰ级",
        "II" => "Ⅱ级",
        "III" => "Ⅲ级",
        _ => "Ⅳ级及以上",
    }
}

/// Returns the kind of a dyad; higher classes have no kinds.
pub fn dyad<'a>(g: &'a Assur<'_>) -> Option<&'a str> {
    Some(g.kind()).filter(|kind| !matches!(*kind, "triad" | "higher group"))
}

/// Returns a group in words: its class, its kind, its links.
pub fn group_words(scene: &Scene, m: &Mechanism, g: &Assur, lang: Lang) -> String {
    group(scene, m, g, lang, str::to_owned)
}

/// Returns a group in words, with its points as formulas.
pub fn group_set(scene: &Scene, m: &Mechanism, g: &Assur, lang: Lang) -> Phrase {
    Phrase::new(&group(scene, m, g, lang, |name| format!("${}$", name_label(name))))
}

fn group(
    scene: &Scene,
    m: &Mechanism,
    g: &Assur,
    lang: Lang,
    point: impl Fn(&str) -> String,
) -> String {
    let of = scene.replaced(|_| None);
    let mut links: Vec<&str> = g.links.iter().map(|l| scene.link_name(*l)).collect();
    links.extend(of.iter().flat_map(|of| {
        let own = of.links.iter().filter(|l| holds_contact(m, g, scene.cams[l.cam].contact));
        own.map(|l| of.scene.link_name(l.link))
    }));
    let at: Vec<String> = g.inner().into_iter().map(|p| point(scene.point_name(p))).collect();
    let led = g.drivers(m).any(|d| scene.is_led(d));
    let what = match (g.class(), lang) {
        (None, lang) if led => tr(lang, "follower of the cam", "凸轮从动件").into(),
        // The "driven link" of English books is the follower.
        (None, Lang::En) => match g.kind() {
            "driven slider" => "driving slider".into(),
            _ => "driving link".into(),
        },
        (None, Lang::Zh) => match g.kind() {
            "driven slider" => "原动滑块".into(),
            _ => "原动件".into(),
        },
        (Some(class), Lang::En) => match g.kind() {
            "higher group" => format!("class {class}"),
            kind => format!("class {class}, {kind}"),
        },
        (Some(class), Lang::Zh) => format!(
            "{}杆组{}",
            grade(class),
            dyad(g).map_or(String::new(), |kind| format!(" {kind}"))
        ),
    };
    let comma = tr(lang, ", ", "、");
    let links = match links.len() {
        0 => String::new(),
        // A dyad has two links: the other one replaces a contact, a belt or a rope.
        1 if g.class() == Some("II") && g.drivers(m).next().is_none() => match lang {
            Lang::En => format!("link {} and an equivalent link: ", links[0]),
            Lang::Zh => format!("构件 {} 和替代构件：", links[0]),
        },
        1 => format!("{} {}{}", tr(lang, "link", "构件"), links[0], tr(lang, ": ", "：")),
        _ => format!("{} {}{}", tr(lang, "links", "构件"), links.join(comma), tr(lang, ": ", "：")),
    };
    let at = if at.is_empty() || g.class().is_none() {
        String::new()
    } else {
        format!("{} {}", tr(lang, ", at", "，内接副"), at.join(comma))
    };
    format!("{links}{what}{at}")
}

/// Returns true if a guide that represents the contact of a cam is a pair of a group.
fn holds_contact(m: &Mechanism, g: &Assur, contact: Option<GuideId>) -> bool {
    let mut items = g.steps.iter().flat_map(|s| &s.constraints).map(|c| m.constraints[*c].item());
    items.any(|item| matches!(item, PairItem::Guide(guide) if Some(guide) == contact))
}

pub(super) fn effect_words(scene: &Scene, m: &Mechanism, e: Effect, lang: Lang) -> String {
    match e {
        Effect::Velocities => tr(lang, "velocities", "速度").into(),
        Effect::Accelerations => tr(lang, "accelerations", "加速度").into(),
        Effect::DriverRate(d) | Effect::DriverAcceleration(d) => {
            let words = moved_words(scene, d);
            let name = match lang {
                Lang::En => words.en,
                Lang::Zh => words.zh,
            };
            match (e, lang) {
                (Effect::DriverRate(_), Lang::En) => format!("velocity of the driver ({name})"),
                (Effect::DriverRate(_), Lang::Zh) => format!("原动件的（角）速度（{name}）"),
                (_, Lang::En) => format!("acceleration of the driver ({name})"),
                (_, Lang::Zh) => format!("原动件的（角）加速度（{name}）"),
            }
        }
        Effect::Coriolis(g) => {
            let guide = &scene.guides[g.0];
            let on = scene.link_name(guide.on);
            let at = guide
                .pin
                .map(|p| scene.point_name(p))
                .or(guide.slider.map(|s| scene.link_name(s)))
                .unwrap_or_default();
            match lang {
                Lang::En => format!("Coriolis acceleration at {at} in the guide on link {on}"),
                Lang::Zh => format!("{at} 相对构件 {on} 上导路的科氏加速度"),
            }
        }
        Effect::Group(g) => {
            let names: Vec<_> = m.groups[g].links.iter().map(|l| scene.link_name(*l)).collect();
            if names.is_empty() {
                let pins: Vec<_> = m.groups[g].pins.iter().map(|p| scene.point_name(*p)).collect();
                return format!(
                    "{} {}",
                    tr(lang, "joint", "运动副"),
                    pins.join(tr(lang, ", ", "、"))
                );
            }
            format!(
                "{} {}",
                tr(lang, if names.len() == 1 { "link" } else { "links" }, "构件"),
                names.join(tr(lang, ", ", "、"))
            )
        }
    }
}

pub(super) fn reason_words(r: Reason, lang: Lang) -> &'static str {
    match r {
        Reason::Asked => tr(lang, "asked for", "题目要求"),
        Reason::NotAsked => tr(lang, "no question calls for it", "题目未涉及"),
        Reason::Accelerated => tr(lang, "it is given", "题目给出"),
        Reason::AtRest => tr(lang, "the driver is at rest at this instant", "原动件该瞬时静止"),
        Reason::ConstantRate => tr(lang, "its rate is constant", "原动件匀速"),
        Reason::GuideTurns => tr(lang, "the guide turns", "导路转动"),
        Reason::GuideDoesNotTurn => tr(lang, "the guide does not turn", "导路不转动"),
        Reason::GuideNotReached => tr(lang, "no question calls for this guide", "题目未涉及该导路"),
    }
}

fn group_lines(
    w: &PlanWriter,
    on: DiagramKind,
    group: &GroupSteps,
    equation: &mut usize,
) -> Vec<String> {
    let lang = w.lang;
    let mut out = Vec::new();
    if group.alternatives.len() > 1 {
        out.push(
            tr(
                lang,
                "special point: whichever pair of legs crosses most squarely; here the first",
                "特殊点：取交角最好的一对；此处列出第一对",
            )
            .into(),
        );
    }
    for step in group.alternatives.first().into_iter().flatten() {
        out.extend(step_lines(w, on, step, equation));
    }
    out.extend(group.rates.iter().filter_map(|(body, rate)| rate_words(w, on, *body, *rate)));
    for step in &group.further {
        out.extend(step_lines(w, on, step, equation));
    }
    out.extend(group.between.iter().map(|b| between_words(w, on, b)));
    out
}

/// Returns the relation drawn between two images that no equation shows.
pub(super) fn between_words(w: &PlanWriter, on: DiagramKind, between: &Between) -> String {
    let (of, to) = between.ends();
    let (from, end) = (formula(&w.image(on, to)), formula(&w.image(on, of)));
    let symbols = |terms: &[Term]| {
        terms.iter().map(|t| formula(&w.symbol(on, t))).collect::<Vec<_>>().join(" + ")
    };
    match (between, w.lang) {
        (Between::Join(t), Lang::En) => format!("{}: join {from} and {end}", symbols(&[*t])),
        (Between::Join(t), Lang::Zh) => format!("{}：连接 {from}、{end}", symbols(&[*t])),
        (Between::Perpendicular { normal, tangential }, lang) => {
            let (parts, line) =
                ([*normal, *tangential].map(|t| symbols(&[t])), formula(&w.line(of, to)));
            match lang {
                Lang::En => format!(
                    "{}, {}: perpendicular from {end} on the parallel to {line} through {from}",
                    parts[0], parts[1]
                ),
                Lang::Zh => format!(
                    "{}、{}：自 {end} 向过 {from} 且平行于 {line} 的直线作垂线",
                    parts[0], parts[1]
                ),
            }
        }
        (Between::LayOff { known, rest }, Lang::En) => {
            let joined = if rest.is_empty() {
                String::new()
            } else {
                format!(", then join to {end}: {}", symbols(rest))
            };
            format!("lay off {} from {from}{joined}", symbols(known))
        }
        (Between::LayOff { known, rest }, Lang::Zh) => {
            let joined = if rest.is_empty() {
                String::new()
            } else {
                format!("，再连至 {end}：{}", symbols(rest))
            };
            format!("自 {from} 作 {}{joined}", symbols(known))
        }
    }
}

/// Returns the determination of an angular velocity or acceleration; `None` for a link that does
/// not rotate.
pub(super) fn rate_words(
    w: &PlanWriter,
    on: DiagramKind,
    body: TurningBody,
    rate: Rate,
) -> Option<String> {
    let symbol = formula(&w.turning(on, body));
    Some(match rate {
        Rate::Zero => return None,
        Rate::Given { .. } => {
            format!("{symbol}{}", tr(w.lang, ": given by the driver", "：由原动件给定"))
        }
        Rate::Same(l) => format!("{symbol} = {}", formula(&w.turning(on, TurningBody::Link(l)))),
        Rate::Measured { of, to } => {
            formula(&format!("{symbol} = {} / {}", w.measured(on, body, of, to), w.length(of, to)))
        }
    })
}

/// Returns the definition of a special point: by the legs of its triad, else by the intersecting
/// lines.
fn special_words(w: &PlanWriter, special: &Special, name: &str) -> String {
    match (special.legs, w.lang) {
        (Some((a, b)), Lang::En) => {
            format!("{name}: crossing of the constraint lines of legs {} and {}", a + 1, b + 1)
        }
        (Some((a, b)), Lang::Zh) => {
            format!("{name}：第 {} 与第 {} 条支链约束线的交点", a + 1, b + 1)
        }
        (None, lang) => {
            let [a, b] = special.lines.each_ref().map(|line| line_words(w, line));
            let (link, with) =
                (w.scene.link_name(special.link), special.with.map(|l| w.scene.link_name(l)));
            match (lang, with) {
                (Lang::En, None) => format!("{name}: point of link {link} where {a} and {b} meet"),
                (Lang::Zh, None) => format!("{name}：构件 {link} 上 {a} 与 {b} 的交点"),
                (Lang::En, Some(with)) => format!(
                    "{name}: common point of links {link} and {with}, where {a} and {b} meet"
                ),
                (Lang::Zh, Some(with)) => {
                    format!("{name}：构件 {link} 与 {with} 的公共点，即 {a} 与 {b} 的交点")
                }
            }
        }
    }
}

/// Returns a line along which a link is constrained.
fn line_words(w: &PlanWriter, line: &SpecialLine) -> String {
    let name = |p: PointId| w.scene.point_name(p);
    match *line {
        SpecialLine::Leg(ConstraintLine::Along { near, far }) => {
            format!("{}{}", name(far), name(near))
        }
        SpecialLine::Leg(ConstraintLine::Normal { pin, .. }) => match w.lang {
            Lang::En => format!("the normal to the guide at {}", name(pin)),
            Lang::Zh => format!("过 {} 的导路垂线", name(pin)),
        },
        SpecialLine::Leg(ConstraintLine::Tangent { at, .. }) => match w.lang {
            Lang::En => format!("the tangent at {}", name(at)),
            Lang::Zh => format!("过 {} 的公切线", name(at)),
        },
        SpecialLine::Through { pin, special } => {
            format!("{}{}", formula(&w.spot(special)), name(pin))
        }
    }
}

fn step_lines(
    w: &PlanWriter,
    on: DiagramKind,
    step: &PlanStep,
    equation: &mut usize,
) -> Vec<String> {
    let lang = w.lang;
    match step {
        PlanStep::Equation { target, chains, method } => {
            *equation += 1;
            let why = method_words(*method, lang);
            let chosen = w.choice(on, *target).map_or_else(String::new, |rate| match lang {
                Lang::En => format!(", {} chosen", formula(&rate)),
                Lang::Zh => format!("，取 {}", formula(&rate)),
            });
            let vector = formula(&w.vector(on, *target));
            let mut out = vec![format!("({equation}) {vector} — {why}{chosen}")];
            if let Some(special) = w.plan.introduced(step) {
                out.push(format!("    {}", special_words(w, special, &formula(&w.spot(*target)))));
            }
            out.extend(mate(w, step).map(|told| format!("    {}", Phrase::new(&told).plain())));
            let columns = w.columns(on, *target, chains);
            match columns[..] {
                [] => out.push(format!("    {} = 0", formula(&w.summand(on, *target)))),
                _ => out.extend(table(lang, &columns).into_iter().map(|l| format!("    {l}"))),
            }
            out
        }
        PlanStep::Image { link, target, from } => {
            let images =
                format!("{}{}{}", w.image(on, from.0), w.image(on, from.1), w.image(on, *target));
            let points = format!("{}{}", w.line(from.0, from.1), w.spot(*target));
            vec![format!(
                "{} — {} {}{}△{} {} △{}",
                formula(&w.vector(on, *target)),
                tr(lang, "image, link", "影像法，构件"),
                w.scene.link_name(*link),
                tr(lang, ": ", "："),
                formula(&images),
                formula(&w.notation.similar),
                formula(&points)
            )]
        }
        PlanStep::Trials { target, images, mates } => {
            let [a, b] =
                [images, mates].map(|pair| formula(&pair.map(|v| w.image(on, v)).concat()));
            let (vector, image) = (formula(&w.vector(on, *target)), formula(&w.image(on, *target)));
            vec![match lang {
                Lang::En => format!("{vector} — two trials: {image} where {a} and {b} cross"),
                Lang::Zh => format!("{vector} — 两次试作：{a} 与 {b} 交于 {image}"),
            }]
        }
        PlanStep::Same { link, target, from } => vec![format!(
            "{} = {} — {}",
            formula(&w.vector(on, *target)),
            formula(&w.vector(on, *from)),
            match lang {
                Lang::En => format!("link {} does not turn", w.scene.link_name(*link)),
                Lang::Zh => format!("构件 {} 作平动", w.scene.link_name(*link)),
            }
        )],
    }
}

pub(super) fn method_words(method: Method, lang: Lang) -> &'static str {
    match method {
        Method::Driven => tr(lang, "known", "已知"),
        Method::SameLink => tr(lang, "points of one link", "基点法"),
        Method::Cylinder => {
            tr(lang, "ends of a cylinder, on barrel and rod", "液压缸两端（缸筒与活塞杆上的点）")
        }
        Method::Coincident => tr(lang, "coincident points", "重合点法"),
        Method::Strand => tr(lang, "ends of a strand, without slip", "带（链）段两端的点，不打滑"),
        Method::Special => tr(lang, "special point method", "特殊点法"),
        Method::Trial => tr(lang, "trial polygon", "试作多边形"),
    }
}

/// Returns an equation table in aligned characters: symbols, magnitudes, directions.
pub(super) fn table(lang: Lang, columns: &[EquationColumn]) -> Vec<String> {
    let heads = ["", tr(lang, "magnitude", "大小"), tr(lang, "direction", "方向")];
    let head = heads.iter().map(|h| h.width()).max().unwrap_or(0);
    let mut lines: Vec<String> = heads.iter().map(|h| pad(h, head)).collect();
    for c in columns {
        let cells = [formula(&c.symbol), formula(&c.magnitude), formula(&c.direction)];
        let wide = cells.iter().map(|x| x.width()).max().unwrap_or(0);
        for (i, (line, cell)) in lines.iter_mut().zip(&cells).enumerate() {
            line.push_str(&format!(
                " {} {}",
                if i == 0 { pad(c.joint, 1) } else { " ".into() },
                pad(cell, wide)
            ));
        }
    }
    lines
}

fn pad(s: &str, to: usize) -> String {
    format!("{s}{}", " ".repeat(to.saturating_sub(s.width())))
}
