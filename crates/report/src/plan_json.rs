//! The plan as JSON: groups, effects and equations, with counters of the work done.
//!
//! The format is described by `docs/plan.schema.json`. Vertices, groups, guides and drivers are
//! identified by their index in the lists of the document; points and links by their names in the
//! scene. Every formula is given twice: in plain characters (`text`) and in the label language, a
//! subset of TeX (`tex`).

use super::answers::diagnostic;
use super::forces::ForceWriter;
use super::plan::{
    between_words, effect_words, group_words, method_words, rate_words, reason_words,
};
use hodograph_base::diag::Diagnostic;
use hodograph_board::plan::text::{EquationColumn, PlanWriter, vertex_name};
use hodograph_board::plan::{
    Between, Effect, GroupSteps, Method, PlanStep, Rate, Reason, Term, TermChain, TermConnection,
    TermKind, TurningBody, VertexId, VertexPlace,
};
use hodograph_mechanism::mechanism::{Assur, Demand, Level, Mechanism};
use hodograph_paper::paper::phrase::formula;
use hodograph_scene::{DiagramKind, DriverKind, GuidePath, LinkId, PointId, Scene};
use hodograph_worked::effort::{MotionWork, Work};
use hodograph_worked::worked::Worked;
use serde_json::{Value as Json, json};

/// Returns the plan that `w` writes, and the work done for it; without `done` (a pose that cannot
/// be solved) the plan alone.
pub fn json(
    m: &Mechanism,
    demand: &Demand,
    w: &PlanWriter,
    done: Option<(&Worked, Work)>,
    notes: &[Diagnostic],
) -> Json {
    let r = Reporter { w, scene: w.scene, m, demand, worked: done.map(|d| d.0) };
    let f = &m.mobility;
    let mut out = json!({
        "title": {"en": w.scene.title.en, "zh": w.scene.title.zh},
        "language": w.lang.name(),
        "notation": w.notation.name,
        "mobility": {"moving": f.moving, "lower": f.lower, "higher": f.higher, "freedom": f.freedom},
        "level": level_name(demand.level),
        "drivers": w.scene.drivers.iter().map(|d| r.driver(&d.kind)).collect::<Vec<_>>(),
        "guides": r.guides(),
        "groups": r.groups(),
        "effects": w.plan.effects.iter().map(|(e, included, why)| r.effect(*e, *included, *why)).collect::<Vec<_>>(),
        "vertices": (0..w.plan.vertices.len()).map(|v| r.vertex(VertexId(v))).collect::<Vec<_>>(),
    });
    let mut before = 0;
    for on in DiagramKind::POLYGONS {
        out[on.word()] = json!(r.stage(on, before));
        before += r.equations(on);
    }
    let drawn = done.and_then(|(worked, _)| worked.equilibrium.as_ref());
    out["forces"] = json!(drawn.map(|of| {
        ForceWriter { scene: w.scene, notation: w.notation, lang: w.lang, of }.plan_json()
    }));
    out["work"] = json!(done.map(|d| work(&d.1)));
    out["notes"] = json!(notes.iter().map(diagnostic).collect::<Vec<_>>());
    out
}

fn work(work: &Work) -> Json {
    let motion = |m: &MotionWork| {
        json!({
            "groups": m.groups,
            "equations_planned": m.equations_planned,
            "equations_closed": m.equations_closed,
            "images": m.images,
            "vectors": m.vectors,
            "rates": m.rates,
            "unknowns": m.unknowns,
        })
    };
    json!({
        "levels": work.levels(),
        "groups_placed": work.groups_placed,
        "velocity": motion(&work.velocity),
        "acceleration": motion(&work.acceleration),
        "drawings": work.drawings,
        "answers": work.answers,
        "certified_values": work.certified_values,
        "labels_placed": work.labels_placed,
    })
}

struct Reporter<'a> {
    w: &'a PlanWriter<'a>,
    scene: &'a Scene,
    m: &'a Mechanism,
    demand: &'a Demand,
    worked: Option<&'a Worked>,
}

impl Reporter<'_> {
    fn links(&self, links: &[LinkId]) -> Vec<&str> {
        links.iter().map(|l| self.scene.link_name(*l)).collect()
    }

    fn points(&self, points: &[PointId]) -> Vec<&str> {
        points.iter().map(|p| self.scene.point_name(*p)).collect()
    }

    fn driver(&self, kind: &DriverKind) -> Json {
        match kind {
            DriverKind::Turn { link, against, .. } => {
                json!({"kind": "turn", "link": self.scene.link_name(*link), "against": self.scene.link_name(*against)})
            }
            DriverKind::Slide { guide, .. } => json!({"kind": "slide", "guide": guide.0}),
            DriverKind::Cylinder { a, b, links, .. } => {
                json!({"kind": "cylinder", "points": self.points(&[*a, *b]), "links": self.links(links)})
            }
        }
    }

    fn guides(&self) -> Vec<Json> {
        let guide = |g: &hodograph_scene::Guide| {
            json!({
                "pin": g.pin.map(|p| self.scene.point_name(p)),
                "slider": g.slider.map(|s| self.scene.link_name(s)),
                "on": self.scene.link_name(g.on),
                "path": match g.path { GuidePath::Line { .. } => "line", GuidePath::Arc { .. } => "arc" },
            })
        };
        self.scene.guides.iter().map(guide).collect()
    }

    fn groups(&self) -> Vec<Json> {
        let books = self.m.assur(self.scene);
        let numbered: Vec<&Assur> = books.iter().filter(|a| !a.is_carried()).collect();
        let group = |(i, g): (usize, &hodograph_mechanism::mechanism::Group)| {
            let book = numbered
                .iter()
                .enumerate()
                .find(|(_, a)| a.steps.iter().any(|s| std::ptr::eq(*s, g)));
            let driver = |c: &usize| self.m.constraints[*c].form().driver();
            json!({
                "number": book.map(|(n, _)| n + 1),
                "kind": book.map_or_else(|| g.kind(), |(_, a)| a.kind().to_owned()),
                "class": book.and_then(|(_, a)| a.class()),
                "links": self.links(&g.links),
                "pins": self.points(&g.pins),
                "drivers": g.constraints.iter().filter_map(driver).collect::<Vec<_>>(),
                "upstream": g.upstream,
                "level": self.demand.groups[i].map(level_name),
                "drawable": !self.w.plan.undrawable.contains(&i),
                "text": book.map(|(_, a)| group_words(self.scene, self.m, a, self.w.lang)),
            })
        };
        self.m.groups.iter().enumerate().map(group).collect()
    }

    fn effect(&self, effect: Effect, included: bool, why: Reason) -> Json {
        let (kind, of) = match effect {
            Effect::Velocities => ("velocities", None),
            Effect::Accelerations => ("accelerations", None),
            Effect::DriverRate(d) => ("driver-rate", Some(("driver", d))),
            Effect::DriverAcceleration(d) => ("driver-acceleration", Some(("driver", d))),
            Effect::Coriolis(g) => ("coriolis", Some(("guide", g.0))),
            Effect::Group(g) => ("group", Some(("group", g))),
        };
        let mut out = json!({"effect": kind});
        if let Some((key, index)) = of {
            out[key] = json!(index);
        }
        out["text"] = json!(effect_words(self.scene, self.m, effect, self.w.lang));
        self.with_reason(out, included, why)
    }

    fn with_reason(&self, mut out: Json, included: bool, why: Reason) -> Json {
        out["in"] = json!(included);
        out["reason"] = json!(reason_name(why));
        out["reason_text"] = json!(reason_words(why, self.w.lang));
        out
    }

    fn vertex(&self, v: VertexId) -> Json {
        let vertex = self.w.plan.vertex(v);
        let (point, special) = match vertex.spot {
            VertexPlace::Point(p) => (Some(self.scene.point_name(p)), None),
            VertexPlace::Special(k) => {
                let special = &self.w.plan.specials[k];
                let legs = special.legs.map(|(a, b)| [a, b]);
                (None, Some(json!({"group": special.group, "legs": legs})))
            }
        };
        json!({
            "name": vertex_name(self.scene, self.w.plan, v),
            "point": point,
            "special": special,
            "on": vertex.on.map(|l| self.scene.link_name(l)),
            "fixed": vertex.fixed,
            "trial": vertex.trial.map(|t| t.run),
        })
    }

    /// Returns the number of equations of a polygon in the first alternatives, which the text of
    /// the plan numbers.
    fn equations(&self, on: DiagramKind) -> usize {
        self.w.plan.steps(on).iter().map(|g| count(g.steps(0))).sum()
    }

    /// Returns the groups of a polygon; their equations are numbered from `first` + 1.
    fn stage(&self, on: DiagramKind, first: usize) -> Vec<Json> {
        let mut number = first;
        let mut out = Vec::new();
        for g in self.w.plan.steps(on) {
            let before = number;
            // An alternative replaces the first solution and uses its numbering.
            let alternatives: Vec<Vec<Json>> =
                g.alternatives.iter().map(|steps| self.steps(on, steps, before)).collect();
            number += g.alternatives.first().map_or(0, count);
            let further = self.steps(on, &g.further, number);
            number += count(&g.further);
            out.push(json!({
                "group": g.group,
                "alternatives": alternatives,
                "drawn": self.worked.map(|d| g.drawn(d.construction.acts.chosen[g.group])),
                "between": g.between.iter().map(|b| self.between(on, b)).collect::<Vec<_>>(),
                "rates": self.rates(on, g),
                "further": further,
            }));
        }
        out
    }

    fn between(&self, on: DiagramKind, between: &Between) -> Json {
        let (of, to) = between.ends();
        let kind = match between {
            Between::Join(_) => "join",
            Between::Perpendicular { .. } => "perpendicular",
            Between::LayOff { .. } => "lay-off",
        };
        let symbols: Vec<Json> =
            between.terms().iter().map(|t| both(&self.w.symbol(on, t))).collect();
        json!({"kind": kind, "of": of.0, "to": to.0, "symbols": symbols, "text": between_words(self.w, on, between)})
    }

    fn rates(&self, on: DiagramKind, g: &GroupSteps) -> Vec<Json> {
        let rate = |(body, rate): &(TurningBody, Rate)| {
            let mut out =
                json!({"symbol": both(&self.w.turning(on, *body)), "by": self.body(*body)});
            out["kind"] = json!(match rate {
                Rate::Measured { .. } => "measured",
                Rate::Given { .. } => "given",
                Rate::Same(_) => "same",
                Rate::Zero => "zero",
            });
            match rate {
                Rate::Measured { of, to } => (out["of"], out["to"]) = (json!(of.0), json!(to.0)),
                Rate::Given { driver, against } => {
                    (out["driver"], out["against"]) =
                        (json!(driver), json!(self.scene.link_name(*against)));
                }
                Rate::Same(l) => out["as"] = json!(self.scene.link_name(*l)),
                Rate::Zero => {}
            }
            out["text"] = json!(rate_words(self.w, on, *body, *rate));
            out
        };
        g.rates.iter().map(rate).collect()
    }

    fn body(&self, body: TurningBody) -> Json {
        match body {
            TurningBody::Link(l) => json!({"link": self.scene.link_name(l)}),
            TurningBody::Cylinder(d) => json!({"cylinder": d}),
        }
    }

    fn steps(&self, on: DiagramKind, steps: &[PlanStep], mut number: usize) -> Vec<Json> {
        let w = self.w;
        let step = |s: &PlanStep| match s {
            PlanStep::Equation { target, chains, method } => {
                number += 1;
                self.equation(on, *target, chains, *method, number)
            }
            PlanStep::Image { link, target, from } => json!({
                "kind": "image",
                "target": target.0,
                "symbol": both(&w.vector(on, *target)),
                "link": self.scene.link_name(*link),
                "from": [from.0.0, from.1.0],
            }),
            PlanStep::Trials { target, images, mates } => json!({
                "kind": "trials",
                "target": target.0,
                "symbol": both(&w.vector(on, *target)),
                "images": images.map(|v| v.0),
                "mates": mates.map(|v| v.0),
            }),
            PlanStep::Same { link, target, from } => json!({
                "kind": "same",
                "target": target.0,
                "symbol": both(&w.vector(on, *target)),
                "link": self.scene.link_name(*link),
                "from": [from.0],
            }),
        };
        steps.iter().map(step).collect()
    }

    fn equation(
        &self,
        on: DiagramKind,
        target: VertexId,
        chains: &[TermChain],
        method: Method,
        number: usize,
    ) -> Json {
        let w = self.w;
        let columns = w.columns(on, target, chains);
        let text: Vec<String> = columns
            .iter()
            .map(|c| format!("{} {}", c.joint, formula(&c.symbol)).trim().to_string())
            .collect();
        json!({
            "kind": "equation",
            "number": number,
            "target": target.0,
            "symbol": both(&w.vector(on, target)),
            "method": match method {
                Method::Driven => "driven",
                Method::SameLink => "same-link",
                Method::Cylinder => "cylinder",
                Method::Coincident => "coincident",
                Method::Strand => "strand",
                Method::Special => "special",
                Method::Trial => "trial",
            },
            "method_text": method_words(method, w.lang),
            "text": text.join(" "),
            "terms": columns.iter().map(|c| self.column(on, c)).collect::<Vec<_>>(),
            "omitted": self.omitted(on, target, chains),
        })
    }

    fn column(&self, on: DiagramKind, c: &EquationColumn) -> Json {
        let part = |tex: &str| json!({"known": tex != self.w.notation.unknown, "text": formula(tex), "tex": tex});
        let mut out = json!({
            "joint": c.joint,
            "symbol": both(&c.symbol),
            "magnitude": part(&c.magnitude),
            "direction": part(&c.direction),
        });
        let Some(t) = c.term else {
            out["kind"] = json!("whole");
            return out;
        };
        out["kind"] = json!(term_name(t.kind));
        (out["of"], out["to"], out["by"]) = (json!(t.of.0), json!(t.to.0), self.by(t.by));
        let (included, why) = match t.kind {
            _ if self.w.plan.vanishes(self.scene, on, &t) => (false, Reason::AtRest),
            TermKind::Coriolis => (true, Reason::GuideTurns),
            TermKind::Tangential | TermKind::Slide | TermKind::Extension
                if t.known && on == DiagramKind::Acceleration =>
            {
                (true, Reason::Accelerated)
            }
            TermKind::Relative
            | TermKind::Normal
            | TermKind::Tangential
            | TermKind::Slide
            | TermKind::SlideNormal
            | TermKind::Extension
            | TermKind::Gap
            | TermKind::Roll => (true, Reason::Asked),
        };
        self.with_reason(out, included, why)
    }

    fn by(&self, by: TermConnection) -> Json {
        match by {
            TermConnection::Turning(body) => self.body(body),
            TermConnection::Guide { guide, driver } => json!({"guide": guide.0, "driver": driver}),
            TermConnection::Cylinder(d) => json!({"cylinder": d}),
            TermConnection::Contact(pair) => json!({"rolling": pair.0}),
            TermConnection::Frame { body, about } => {
                json!({"frame": body.map(|b| self.body(b)), "about": about.map(|p| p.0)})
            }
            TermConnection::Apart => Json::Null,
        }
    }

    /// Returns the terms that an acceleration equation could have but lacks, with the reason, which
    /// follows from the equation's own terms and from those of the velocity equation for the same
    /// point.
    fn omitted(&self, on: DiagramKind, target: VertexId, chains: &[TermChain]) -> Vec<Json> {
        if on != DiagramKind::Acceleration {
            return Vec::new();
        }
        let own: Vec<Term> = terms(chains).copied().collect();
        let before = self
            .w
            .plan
            .steps(DiagramKind::Velocity)
            .iter()
            .flat_map(|g| g.alternatives.iter().flatten().chain(&g.further));
        let of_velocity = before.filter_map(|s| match s {
            PlanStep::Equation { target: t, chains, .. } if *t == target => Some(terms(chains)),
            PlanStep::Equation { .. }
            | PlanStep::Image { .. }
            | PlanStep::Trials { .. }
            | PlanStep::Same { .. } => None,
        });
        let mut connections: Vec<(VertexId, VertexId, TermConnection)> = Vec::new();
        for t in own.iter().chain(of_velocity.flatten()) {
            if !connections.contains(&(t.of, t.to, t.by)) {
                connections.push((t.of, t.to, t.by));
            }
        }
        let mut out = Vec::new();
        for (of, to, by) in connections {
            let expected: &[(TermKind, Reason)] = match by {
                TermConnection::Turning(_) => &[(TermKind::Tangential, Reason::ConstantRate)],
                TermConnection::Guide { .. } => &[
                    (TermKind::Coriolis, Reason::GuideDoesNotTurn),
                    (TermKind::Slide, Reason::ConstantRate),
                ],
                TermConnection::Cylinder(_) => &[(TermKind::Extension, Reason::ConstantRate)],
                TermConnection::Contact(_)
                | TermConnection::Frame { .. }
                | TermConnection::Apart => &[],
            };
            for &(kind, why) in expected {
                if !own.iter().any(|t| (t.kind, t.of, t.to) == (kind, of, to)) {
                    let term =
                        json!({"kind": term_name(kind), "of": of.0, "to": to.0, "by": self.by(by)});
                    out.push(self.with_reason(term, false, why));
                }
            }
        }
        out
    }
}

fn terms(chains: &[TermChain]) -> impl Iterator<Item = &Term> {
    chains.iter().flat_map(|c| c.known.iter().chain(&c.unknown))
}

fn count<'a>(steps: impl IntoIterator<Item = &'a PlanStep>) -> usize {
    steps.into_iter().filter(|s| matches!(s, PlanStep::Equation { .. })).count()
}

/// Returns a formula in plain characters and in the label language.
fn both(tex: &str) -> Json {
    json!({"text": formula(tex), "tex": tex})
}

fn level_name(level: Level) -> &'static str {
    match level {
        Level::Position => "position",
        Level::Velocity => "velocity",
        Level::Acceleration => "acceleration",
    }
}

fn term_name(kind: TermKind) -> &'static str {
    match kind {
        TermKind::Relative => "relative",
        TermKind::Normal => "normal",
        TermKind::Tangential => "tangential",
        TermKind::Slide => "sliding",
        TermKind::SlideNormal => "sliding-normal",
        TermKind::Coriolis => "coriolis",
        TermKind::Extension => "extension",
        TermKind::Roll => "rolling",
        TermKind::Gap => "gap",
    }
}

fn reason_name(why: Reason) -> &'static str {
    match why {
        Reason::Asked => "asked",
        Reason::NotAsked => "not-asked",
        Reason::AtRest => "at-rest",
        Reason::Accelerated => "accelerated",
        Reason::ConstantRate => "constant-rate",
        Reason::GuideTurns => "guide-turns",
        Reason::GuideDoesNotTurn => "guide-does-not-turn",
        Reason::GuideNotReached => "guide-not-reached",
    }
}
