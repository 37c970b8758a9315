//! The plan as text: groups, effects, equations in solving order.

use crate::equation::mate;
use crate::forces::ForceWriter;
use crate::replaced::replaced_words;
use hodograph_base::digits::minus;
use hodograph_base::lang::{say, tr, zh, zh_format};
use hodograph_board::plan::names::name_label;
use hodograph_board::plan::text::{EquationColumn, PlanWriter};
use hodograph_board::plan::{
    Between, Effect, GroupSteps, Method, PlanStep, Rate, Reason, Special, SpecialLine, Term,
    TurningBody,
};
use hodograph_mechanism::mechanism::{Assur, ConstraintLine, Mechanism, PairItem, moved_words};
use hodograph_paper::paper::phrase::{Phrase, formula};
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
    let title = lang.of(&scene.title);
    if !title.is_empty() {
        line(title.to_string());
    }
    let f = &m.mobility;
    line(format!(
        "{}F = 3·{} − 2·{} − {} = {}{}{}",
        tr!(lang, "mobility: "),
        f.moving,
        f.lower,
        f.higher,
        minus(&f.freedom.to_string()),
        lang.semicolon(),
        match scene.own_drivers() {
            1 => tr!(lang, "1 driver").to_owned(),
            n => say!(lang, "{n} drivers"),
        }
    ));
    line(String::new());
    line(tr!(lang, "groups in solving order").into());
    let mut number = 0;
    for g in m.assur(scene).iter().filter(|g| !g.is_carried()) {
        number += 1;
        line(format!("  {number}. {}", group_words(scene, m, g, lang)));
    }
    for words in replaced_words(scene) {
        line(format!("  {}", lang.of(&words)));
    }
    line(String::new());
    line(tr!(lang, "effects").into());
    for (effect, included, reason) in &w.plan.effects {
        line(format!(
            "  {} {}{}{}",
            if *included { tr!(lang, "in ") } else { tr!(lang, "out") },
            effect_words(scene, m, *effect, lang),
            tr!(lang, ": "),
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
            tr!(lang, "links"),
            names.join(lang.comma()),
            tr!(lang, ": "),
            tr!(
                lang,
                "in or behind a group higher than class III, not drawn; `solve` answers from the loop equations"
            )
        ));
    }
    out
}

/// Returns the class of a group or of a mechanism in Chinese notation.
pub fn grade(class: &str) -> &'static str {
    match class {
        "I" => zh!("grade" => "I"),
        "II" => zh!("grade" => "II"),
        "III" => zh!("grade" => "III"),
        _ => zh!("grade" => "IV"),
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
        (None, lang) if led => tr!(lang, "follower of the cam").into(),
        // The "driven link" of English books is the follower.
        (None, lang) => match g.kind() {
            "driven slider" => tr!(lang, "driving slider").into(),
            _ => tr!(lang, "driving link").into(),
        },
        (Some(class), Lang::En) => match g.kind() {
            "higher group" => format!("class {class}"),
            kind => format!("class {class}, {kind}"),
        },
        (Some(class), Lang::Zh) => {
            let kind = dyad(g).map_or(String::new(), |kind| format!(" {kind}"));
            zh_format!("group" => "class {}{kind}", grade(class))
        }
    };
    let comma = lang.comma();
    let links = match links.len() {
        0 => String::new(),
        // A dyad has two links: the other one replaces a contact, a belt or a rope.
        1 if g.class() == Some("II") && g.drivers(m).next().is_none() => {
            say!(lang, "link {} and an equivalent link: ", links[0])
        }
        1 => format!("{} {}{}", tr!(lang, "link"), links[0], tr!(lang, ": ")),
        _ => format!("{} {}{}", tr!(lang, "links"), links.join(comma), tr!(lang, ": ")),
    };
    let at = if at.is_empty() || g.class().is_none() {
        String::new()
    } else {
        format!("{} {}", tr!(lang, ", at"), at.join(comma))
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
        Effect::Velocities => tr!(lang, "velocities").into(),
        Effect::Accelerations => tr!(lang, "accelerations").into(),
        Effect::DriverRate(d) | Effect::DriverAcceleration(d) => {
            let name = moved_words(scene, d);
            match e {
                Effect::DriverRate(_) => say!(lang, "velocity of the driver ({})", name),
                _ => say!(lang, "acceleration of the driver ({})", name),
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
            say!(lang, "Coriolis acceleration at {at} in the guide on link {on}")
        }
        Effect::Group(g) => {
            let names: Vec<_> = m.groups[g].links.iter().map(|l| scene.link_name(*l)).collect();
            if names.is_empty() {
                let pins: Vec<_> = m.groups[g].pins.iter().map(|p| scene.point_name(*p)).collect();
                return format!("{} {}", tr!(lang, "joint"), pins.join(lang.comma()));
            }
            format!(
                "{} {}",
                match names.len() {
                    1 => tr!(lang, "link"),
                    _ => tr!(lang, "links"),
                },
                names.join(lang.comma())
            )
        }
    }
}

pub(super) fn reason_words(r: Reason, lang: Lang) -> &'static str {
    match r {
        Reason::Asked => tr!(lang, "asked for"),
        Reason::NotAsked => tr!(lang, "no question calls for it"),
        Reason::Accelerated => tr!(lang, "it is given"),
        Reason::AtRest => tr!(lang, "the driver is at rest at this instant"),
        Reason::ConstantRate => tr!(lang, "its rate is constant"),
        Reason::GuideTurns => tr!(lang, "the guide turns"),
        Reason::GuideDoesNotTurn => tr!(lang, "the guide does not turn"),
        Reason::GuideNotReached => tr!(lang, "no question calls for this guide"),
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
            tr!(
                lang,
                "special point: whichever pair of legs crosses most squarely; here the first"
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
    match between {
        Between::Join(t) => say!(w.lang, "{}: join {from} and {end}", symbols(&[*t])),
        Between::Perpendicular { normal, tangential } => {
            let (parts, line) =
                ([*normal, *tangential].map(|t| symbols(&[t])), formula(&w.line(of, to)));
            say!(
                w.lang,
                "{}, {}: perpendicular from {end} on the parallel to {line} through {from}",
                parts[0],
                parts[1]
            )
        }
        Between::LayOff { known, rest } if rest.is_empty() => {
            say!(w.lang, "lay off {} from {from}", symbols(known))
        }
        Between::LayOff { known, rest } => say!(
            w.lang,
            "lay off {} from {from}, then join to {end}: {}",
            symbols(known),
            symbols(rest)
        ),
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
            format!("{symbol}{}", tr!(w.lang, ": given by the driver"))
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
    let lang = w.lang;
    match special.legs {
        Some((a, b)) => {
            say!(lang, "{name}: crossing of the constraint lines of legs {} and {}", a + 1, b + 1)
        }
        None => {
            let [a, b] = special.lines.each_ref().map(|line| line_words(w, line));
            let (link, with) =
                (w.scene.link_name(special.link), special.with.map(|l| w.scene.link_name(l)));
            match with {
                None => say!(lang, "{name}: point of link {link} where {a} and {b} meet"),
                Some(with) => say!(
                    lang,
                    "{name}: common point of links {link} and {with}, where {a} and {b} meet"
                ),
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
        SpecialLine::Leg(ConstraintLine::Normal { pin, .. }) => {
            say!(w.lang, "the normal to the guide at {}", name(pin))
        }
        SpecialLine::Leg(ConstraintLine::Tangent { at, .. }) => {
            say!(w.lang, "the tangent at {}", name(at))
        }
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
            let chosen = w
                .choice(on, *target)
                .map_or_else(String::new, |rate| say!(lang, ", {} chosen", formula(&rate)));
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
                tr!(lang, "image, link"),
                w.scene.link_name(*link),
                tr!(lang, ": "),
                formula(&images),
                formula(&w.notation.similar),
                formula(&points)
            )]
        }
        PlanStep::Trials { target, images, mates } => {
            let [a, b] =
                [images, mates].map(|pair| formula(&pair.map(|v| w.image(on, v)).concat()));
            let (vector, image) = (formula(&w.vector(on, *target)), formula(&w.image(on, *target)));
            vec![say!(lang, "{vector} — two trials: {image} where {a} and {b} cross")]
        }
        PlanStep::Same { link, target, from } => vec![format!(
            "{} = {} — {}",
            formula(&w.vector(on, *target)),
            formula(&w.vector(on, *from)),
            say!(lang, "link {} does not turn", w.scene.link_name(*link))
        )],
    }
}

pub(super) fn method_words(method: Method, lang: Lang) -> &'static str {
    match method {
        Method::Driven => tr!(lang, "known"),
        Method::SameLink => tr!(lang, "points of one link"),
        Method::Cylinder => {
            tr!(lang, "ends of a cylinder, on barrel and rod")
        }
        Method::Coincident => tr!(lang, "coincident points"),
        Method::Strand => tr!(lang, "ends of a strand, without slip"),
        Method::Special => tr!(lang, "special point method"),
        Method::Trial => tr!(lang, "trial polygon"),
    }
}

/// Returns an equation table in aligned characters: symbols, magnitudes, directions.
pub(super) fn table(lang: Lang, columns: &[EquationColumn]) -> Vec<String> {
    let heads = ["", tr!(lang, "of a vector" => "magnitude"), tr!(lang, "direction")];
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
