//! Texts and symbols of a plan, in the label language: `v_{CB}`, `a^n_{B3}`, `\perp BC`, `2\omega_3
//! v_{B3B2}`.
//!
//! A vector that starts at a fixed point is written as an absolute one (v_C, not v_CD), as in every
//! textbook.

pub use super::names::point_label;
use super::names::{
    image_label, image_of, is_image, mate_letter, name_label, numbered, of_trial, pole_letter,
    special_name,
};
use super::{
    Plan, PlanStep, Term, TermChain, TermConnection, TermKind, TurningBody, VertexId, VertexPlace,
    VertexTrial,
};
use hodograph_base::diag::{Both, both};
use hodograph_base::notation::Notation;
use hodograph_scene::{DiagramKind, GuideId, GuidePath, Lang, PointId, Scene};

/// The context of the texts.
#[derive(Clone, Copy, Debug)]
pub struct PlanWriter<'a> {
    /// The scene, for names.
    pub scene: &'a Scene,
    /// The plan.
    pub plan: &'a Plan,
    /// The notation of the marks.
    pub notation: &'a Notation,
    /// The language of the words.
    pub lang: Lang,
}

/// One column of an equation table.
#[derive(Clone, Debug, PartialEq)]
pub struct EquationColumn {
    /// The sign before the column: nothing, `=` or `+`.
    pub joint: &'static str,
    /// The vector's symbol.
    pub symbol: String,
    /// The direction.
    pub direction: String,
    /// The magnitude.
    pub magnitude: String,
    /// The term, if the column is one (not for a whole known vector).
    pub term: Option<Term>,
}

/// Returns the name of a vertex in capitals, as in diagnostics: `C`, `B3`, `S`.
pub fn vertex_name(scene: &Scene, plan: &Plan, v: VertexId) -> String {
    let vertex = plan.vertex(v);
    let name = match (vertex.spot, vertex.trial) {
        (_, Some(VertexTrial { run, mate: true })) => {
            return format!("{}({run})", mate_letter(scene));
        }
        (VertexPlace::Point(p), _) => scene.point_name(p).to_owned(),
        (VertexPlace::Special(k), _) => special_name(scene, plan, k),
    };
    let name = numbered(scene, name, vertex.number.map(|n| scene.link_name(n)));
    vertex.trial.map_or(name.clone(), |t| format!("{name}({})", t.run))
}

/// Returns the name of a line in plain letters, with its ends in the order of the scene: `AB`.
pub fn line_name(scene: &Scene, plan: &Plan, a: VertexId, b: VertexId) -> String {
    let (a, b) = ordered(plan, a, b);
    let plain = |v: VertexId| match plan.vertex(v).spot {
        VertexPlace::Point(p) => scene.point_name(p).to_string(),
        VertexPlace::Special(k) => special_name(scene, plan, k),
    };
    format!("{}{}", plain(a), plain(b))
}

/// Returns the link, cylinder, guide or contact that gives a term its direction, in words of
/// diagnostics: `link 3 (CD)`, `the guide on link 4`.
pub fn held_by(scene: &Scene, plan: &Plan, t: &Term) -> Both {
    let line = || line_name(scene, plan, t.to, t.of);
    match t.by {
        TermConnection::Turning(TurningBody::Link(l)) => {
            both!("link {} ({})", scene.link_name(l), line())
        }
        TermConnection::Turning(TurningBody::Cylinder(_)) | TermConnection::Cylinder(_) => {
            both!("cylinder {}", line())
        }
        TermConnection::Guide { guide, .. } => {
            both!("the guide on link {}", scene.link_name(scene.guides[guide.0].on))
        }
        TermConnection::Contact(pair) => {
            let [a, b] = scene.rolling[pair.0].links.map(|l| scene.link_name(l));
            both!("the contact of links {a} and {b}")
        }
        TermConnection::Frame { .. } | TermConnection::Apart => Both::same(line()),
    }
}

/// Returns the ends of a line in the order of the scene, so that a line has only one name: AB,
/// never BA.
fn ordered(plan: &Plan, a: VertexId, b: VertexId) -> (VertexId, VertexId) {
    let rank = |v: VertexId| match plan.vertex(v).spot {
        VertexPlace::Point(p) => p.0,
        VertexPlace::Special(_) => usize::MAX,
    };
    if rank(a) <= rank(b) { (a, b) } else { (b, a) }
}

impl PlanWriter<'_> {
    /// Returns the name of a vertex in capitals, in the label language.
    pub fn name(&self, v: VertexId) -> String {
        name_label(&vertex_name(self.scene, self.plan, v))
    }

    /// Returns the place of a vertex, `B`, `O_2`, without the number that distinguishes coincident
    /// points.
    pub fn spot(&self, v: VertexId) -> String {
        match self.plan.vertex(v).spot {
            VertexPlace::Point(p) => point_label(self.scene.point_name(p)),
            VertexPlace::Special(k) => point_label(&special_name(self.scene, self.plan, k)),
        }
    }

    /// Returns the name of a line through two vertices, `AB`, without the numbers of coincident
    /// points, because a line is a place.
    pub fn line(&self, a: VertexId, b: VertexId) -> String {
        let (a, b) = ordered(self.plan, a, b);
        format!("{}{}", self.spot(a), self.spot(b))
    }

    /// Returns the length of a line: `l_{AB}`.
    pub fn length(&self, a: VertexId, b: VertexId) -> String {
        format!("l_{{{}}}", name_label(&line_name(self.scene, self.plan, a, b)))
    }

    /// Returns the symbol of a whole vector of a vertex: `v_{B3}`.
    pub fn vector(&self, on: DiagramKind, v: VertexId) -> String {
        format!("{}_{{{}}}", on.letter(), self.name(v))
    }

    /// True if a term is written as an absolute vector, from a fixed point. The parts of a cylinder
    /// are always relative, because the other chain of their equation may start at a fixed point as
    /// well.
    pub(super) fn is_absolute(&self, on: DiagramKind, t: &Term) -> bool {
        let whole = |t: &Term| match t.by {
            TermConnection::Cylinder(_) | TermConnection::Turning(TurningBody::Cylinder(_)) => {
                false
            }
            // Over a fixed point of a turning guide, sliding is the whole velocity, but with the
            // Coriolis term only a part of the acceleration.
            TermConnection::Guide { guide, .. } => {
                on == DiagramKind::Velocity || self.plan.still[self.scene.guides[guide.0].on.0]
            }
            TermConnection::Turning(TurningBody::Link(_))
            | TermConnection::Contact(_)
            | TermConnection::Apart => true,
            TermConnection::Frame { .. } => false,
        };
        let absolute = |t: &Term| self.plan.vertex(t.to).fixed && whole(t);
        // A point held from two fixed ones (a part of the mechanism that cannot move) has two names
        // for the same vector.
        absolute(t) && !self.plan.terms(on).any(|u| u.of == t.of && u.to != t.to && absolute(&u))
    }

    fn subscript(&self, on: DiagramKind, t: &Term) -> String {
        if self.is_absolute(on, t) {
            self.name(t.of)
        } else {
            format!("{}{}", self.name(t.of), self.name(t.to))
        }
    }

    /// Returns the sliding velocity in a Coriolis or normal part of sliding.
    fn sliding(&self, t: &Term) -> String {
        let [of, to] = [t.of, t.to].map(|v| self.plan.untried(v));
        if let TermConnection::Frame { .. } = t.by {
            return self.symbol(
                DiagramKind::Velocity,
                &Term { kind: TermKind::Relative, by: TermConnection::Apart, of, to, ..*t },
            );
        }
        self.symbol(DiagramKind::Velocity, &Term { kind: TermKind::Slide, of, to, ..*t })
    }

    /// Returns the vector from which the angular quantity of a body is measured: `v_{CB}`,
    /// `a^t_{CB}`.
    pub fn measured(
        &self,
        on: DiagramKind,
        body: TurningBody,
        of: VertexId,
        to: VertexId,
    ) -> String {
        let kind =
            if on == DiagramKind::Acceleration { TermKind::Tangential } else { TermKind::Relative };
        self.symbol(on, &Term { kind, of, to, by: TermConnection::Turning(body), known: false })
    }

    /// Returns the name of a vertex in the letters of images, in the label language.
    fn small(&self, v: VertexId) -> String {
        let vertex = self.plan.vertex(v);
        let name = match (vertex.spot, vertex.trial) {
            (_, Some(VertexTrial { mate: true, .. })) => mate_letter(self.scene).to_lowercase(),
            (VertexPlace::Point(p), _) => self.plan.letters[p.0].clone(),
            (VertexPlace::Special(k), _) => special_name(self.scene, self.plan, k).to_lowercase(),
        };
        let name =
            name_label(&numbered(self.scene, name, vertex.number.map(|n| self.scene.link_name(n))));
        vertex.trial.map_or(name.clone(), |t| format!("{name}({})", t.run))
    }

    fn superscript(&self, on: DiagramKind, t: &Term) -> String {
        let fixed_guide = self.is_absolute(on, t);
        match (t.kind, t.by) {
            // The part square to the line; the whole vector also has the part along it.
            (TermKind::Relative, TermConnection::Turning(TurningBody::Cylinder(_))) => {
                self.notation.tangential.clone()
            }
            (TermKind::Relative, _) => String::new(),
            (TermKind::Normal, _) => "n".into(),
            (TermKind::Tangential, _) => self.notation.tangential.clone(),
            (TermKind::Coriolis, _) => self.notation.coriolis.clone(),
            (TermKind::Extension, _) => self.notation.sliding.clone(),
            // On a fixed straight guide, sliding is the whole motion of the point.
            (TermKind::Slide, TermConnection::Guide { guide, .. }) if fixed_guide => {
                if on == DiagramKind::Acceleration && self.is_arc(guide) {
                    self.notation.tangential.clone()
                } else {
                    String::new()
                }
            }
            (TermKind::SlideNormal, _) if fixed_guide => "n".into(),
            (TermKind::Slide, TermConnection::Guide { guide, .. })
                if on == DiagramKind::Acceleration && self.is_arc(guide) =>
            {
                format!("{}\\,{}", self.notation.sliding, self.notation.tangential)
            }
            (TermKind::Slide, TermConnection::Frame { about: Some(_), .. })
                if on == DiagramKind::Acceleration =>
            {
                format!("{}\\,{}", self.notation.sliding, self.notation.tangential)
            }
            (TermKind::Slide, _) => self.notation.sliding.clone(),
            (TermKind::SlideNormal, _) => format!("{}\\,n", self.notation.sliding),
            (TermKind::Roll, _) if on == DiagramKind::Acceleration && !fixed_guide => "ro".into(),
            (TermKind::Roll | TermKind::Gap, _) => String::new(),
        }
    }

    pub(super) fn is_arc(&self, g: GuideId) -> bool {
        matches!(self.scene.guides[g.0].path, GuidePath::Arc { .. })
    }

    /// Returns the symbol of a term: `v_{CB}`, `a^t_{CB}`, `a^k_{B3B2}`.
    pub fn symbol(&self, on: DiagramKind, t: &Term) -> String {
        if let (TermKind::Gap, Some(trial)) = (t.kind, self.plan.vertex(t.of).trial) {
            return format!("\\delta_{{({})}}", trial.run);
        }
        let (q, sub, sup) = (on.letter(), self.subscript(on, t), self.superscript(on, t));
        if sup.is_empty() { format!("{q}_{{{sub}}}") } else { format!("{q}^{{{sup}}}_{{{sub}}}") }
    }

    /// Returns the pole of a polygon: `p`, `p'`, or another letter if a moving point has that one.
    pub fn pole(&self, on: DiagramKind) -> String {
        let letter = pole_letter(self.scene, self.plan, &self.notation.pole);
        format!("{letter}{}", on.prime())
    }

    /// Returns the image of a vertex: `b`, `b_3`, `b'_3`; fixed points have their image at the
    /// pole.
    pub fn image(&self, on: DiagramKind, v: VertexId) -> String {
        let vertex = self.plan.vertex(v);
        if vertex.fixed {
            return self.pole(on);
        }
        let link = vertex.number.map(|l| self.scene.link_name(l));
        let label = match (vertex.spot, vertex.trial) {
            (_, Some(VertexTrial { mate: true, .. })) => {
                image_of(&mate_letter(self.scene).to_lowercase(), None, on.prime())
            }
            (VertexPlace::Point(p), _) => image_label(&self.plan.letters, p, link, on.prime()),
            (VertexPlace::Special(k), _) => {
                image_of(&special_name(self.scene, self.plan, k).to_lowercase(), link, on.prime())
            }
        };
        vertex.trial.map_or(label.clone(), |t| of_trial(&label, t.run))
    }

    /// Returns the letter of a pin's image on the velocity polygon: `b`, `s_2`.
    pub fn letter(&self, p: PointId) -> String {
        image_label(&self.plan.letters, p, None, "")
    }

    /// Returns the end of a part of a point's acceleration, `n'_B`, `k'`, with the image letter of
    /// the point in the subscript, as n_b′. If the image of a point already has the letter n or k,
    /// a letter of the notation profile (η, κ) replaces it.
    pub fn part(&self, on: DiagramKind, t: &Term) -> String {
        let (letter, other) = self.part_letters(t.kind);
        // Two parts of one point, such as aⁿ_C and aⁿ_CB, are distinguished by the reference point
        // of the second.
        let shared = self
            .plan
            .terms(on)
            .any(|u| self.part_letters(u.kind).0 == letter && u.of == t.of && u.to != t.to);
        let to = if shared && !self.is_absolute(on, t) { self.small(t.to) } else { String::new() };
        // Two slots of a link over one pin give two parts of the same name; the second has an
        // additional prime.
        let twin = |u: &Term| self.part_letters(u.kind).0 == letter && (u.of, u.to) == (t.of, t.to);
        let before =
            self.plan.terms(on).filter(twin).take_while(|u| u.is_same(t).is_none()).count();
        let letter = if is_image(self.scene, self.plan, letter) { other } else { letter };
        format!("{letter}{}{}_{{{}{to}}}", on.prime(), "'".repeat(before), self.small(t.of))
    }

    fn part_letters(&self, kind: TermKind) -> (&'static str, &str) {
        let n = self.notation;
        match kind {
            TermKind::Normal | TermKind::SlideNormal => ("n", &n.normal_end),
            TermKind::Coriolis => ("k", &n.coriolis_end),
            TermKind::Tangential => ("t", &n.tangential_end),
            TermKind::Relative
            | TermKind::Slide
            | TermKind::Extension
            | TermKind::Roll
            | TermKind::Gap => ("r", &n.sliding_end),
        }
    }

    /// Returns the symbol of a body's angular quantity: `\omega_3`, `\alpha_3`; for an unnumbered
    /// cylinder `\omega_{FG}`.
    pub fn turning(&self, on: DiagramKind, body: TurningBody) -> String {
        let letter = on.turning_letter();
        match body {
            TurningBody::Link(l) => format!("{letter}_{{{}}}", name_label(self.scene.link_name(l))),
            TurningBody::Cylinder(d) => {
                let kind = &self.scene.drivers[d].kind;
                match (kind.parts(), kind.ends()) {
                    ([part, ..], _) => {
                        format!("{letter}_{{{}}}", name_label(self.scene.link_name(*part)))
                    }
                    ([], Some(ends)) => format!(
                        "{letter}_{{{}}}",
                        ends.map(|p| name_label(self.scene.point_name(p))).concat()
                    ),
                    ([], None) => letter.into(),
                }
            }
        }
    }

    /// Returns the direction of a term: `\perp BC`, `\parallel BC`, `C \to D`.
    pub fn direction(&self, t: &Term) -> String {
        match (t.kind, t.by) {
            (TermKind::Relative | TermKind::Tangential, _) => {
                format!("\\perp {}", self.line(t.of, t.to))
            }
            (TermKind::Normal, _) => format!("{} \\to {}", self.spot(t.of), self.spot(t.to)),
            (TermKind::Extension | TermKind::Gap, _) => {
                format!("\\parallel {}", self.line(t.to, t.of))
            }
            (TermKind::Coriolis, TermConnection::Guide { guide, .. }) if !self.is_arc(guide) => {
                format!("\\perp {}", self.guide_line(guide))
            }
            (TermKind::Coriolis, TermConnection::Guide { guide, .. }) => {
                format!("\\parallel {}", self.guide_line(guide))
            }
            (TermKind::Coriolis, TermConnection::Frame { .. }) => {
                format!(
                    "\\perp {}",
                    self.symbol(
                        DiagramKind::Velocity,
                        &Term { kind: TermKind::Relative, by: TermConnection::Apart, ..*t }
                    )
                )
            }
            (TermKind::Coriolis, _) => format!("\\perp {}", self.line(t.to, t.of)),
            (TermKind::Slide, TermConnection::Guide { guide, .. }) if self.is_arc(guide) => {
                format!("\\perp {}", self.guide_line(guide))
            }
            (TermKind::Slide, TermConnection::Guide { guide, .. }) => {
                format!("\\parallel {}", self.guide_line(guide))
            }
            (TermKind::SlideNormal, TermConnection::Guide { guide, .. }) => {
                let (GuidePath::Arc { centre, .. }, Some(pin)) =
                    (&self.scene.guides[guide.0].path, self.scene.guides[guide.0].pin)
                else {
                    return String::new();
                };
                let (k, p) = (
                    point_label(self.scene.point_name(*centre)),
                    point_label(self.scene.point_name(pin)),
                );
                let carried = self.plan.vertex(t.of).on == Some(self.scene.guides[guide.0].on);
                if carried { format!("{k} \\to {p}") } else { format!("{p} \\to {k}") }
            }
            (TermKind::Roll, TermConnection::Contact(pair)) if t.known => {
                self.toward_centre(pair, t)
            }
            (TermKind::Roll, TermConnection::Contact(pair)) => self.normal_line(pair),
            (TermKind::SlideNormal, TermConnection::Frame { about: Some(k), .. }) => {
                format!("{} \\to {}", self.spot(t.of), point_label(self.scene.point_name(k)))
            }
            (TermKind::Slide, TermConnection::Frame { about: Some(k), .. }) => {
                format!("\\perp {}{}", self.spot(t.of), point_label(self.scene.point_name(k)))
            }
            (TermKind::Slide, TermConnection::Frame { about: None, .. }) => {
                self.notation.unknown.clone()
            }
            (TermKind::Slide | TermKind::SlideNormal | TermKind::Roll, _) => String::new(),
        }
    }

    /// Returns the magnitude of a term: `\omega_1 l_{AB}`, `\omega_3^2 l_{BC}`, `0` if a driver at
    /// rest makes it vanish, or the sign for unknown.
    pub fn magnitude(&self, on: DiagramKind, t: &Term) -> String {
        if self.plan.vanishes(self.scene, on, t) {
            return "0".into();
        }
        if !t.known {
            return self.notation.unknown.clone();
        }
        let length = || self.length(t.of, t.to);
        if let Some(rate) = self.chosen_rate(on, t) {
            return format!("{rate} {}", length());
        }
        let squared = |s: String| s.replacen('_', "^2_", 1);
        match (t.kind, t.by) {
            (TermKind::Relative, TermConnection::Turning(b)) => {
                format!("{} {}", self.turning(DiagramKind::Velocity, b), length())
            }
            (TermKind::Normal, TermConnection::Turning(b)) => {
                format!("{} {}", squared(self.turning(DiagramKind::Velocity, b)), length())
            }
            (TermKind::Tangential, TermConnection::Turning(b)) => {
                format!("{} {}", self.turning(DiagramKind::Acceleration, b), length())
            }
            (TermKind::Coriolis, TermConnection::Guide { guide, .. }) => {
                let omega = self.turning(
                    DiagramKind::Velocity,
                    TurningBody::Link(self.plan.coriolis_link(self.scene, guide)),
                );
                format!("2{omega} {}", self.sliding(t))
            }
            (TermKind::Coriolis, TermConnection::Frame { body: Some(body), .. }) => {
                format!("2{} {}", self.turning(DiagramKind::Velocity, body), self.sliding(t))
            }
            (TermKind::Coriolis, TermConnection::Cylinder(d)) => {
                let v =
                    self.symbol(DiagramKind::Velocity, &Term { kind: TermKind::Extension, ..*t });
                format!("2{} {v}", self.turning(DiagramKind::Velocity, TurningBody::Cylinder(d)))
            }
            (TermKind::SlideNormal, _) => {
                let v = self.sliding(t);
                let squared =
                    if v.contains('^') { format!("({v})^2") } else { v.replacen('_', "^2_", 1) };
                format!("{squared}/\\rho")
            }
            (TermKind::Roll, TermConnection::Contact(pair)) => self.of_contact(pair),
            _ => self.notation.known.clone(),
        }
    }

    /// Returns the assumed rate of a trial polygon, `ω_{2(2)}`, if a known term depends on it.
    fn chosen_rate(&self, on: DiagramKind, t: &Term) -> Option<String> {
        match (t.kind, t.by, self.plan.vertex(t.of).trial) {
            (
                TermKind::Relative | TermKind::Tangential,
                TermConnection::Turning(body),
                Some(trial),
            ) if t.known => Some(of_trial(&self.turning(on, body), trial.run)),
            _ => None,
        }
    }

    /// Returns the assumption with which a trial begins, if it finds the vertex: `ω_{2(1)} = 0`,
    /// `ω_{2(2)}`.
    pub fn choice(&self, on: DiagramKind, v: VertexId) -> Option<String> {
        let (own, run) = (self.plan.vertex(v), self.plan.vertex(v).trial?.run);
        let steps = || self.plan.steps(on).iter().flat_map(|g| g.steps(0));
        let begins = |step: &PlanStep| match step {
            PlanStep::Equation { target, chains, .. }
                if chains.len() == 1 && self.plan.vertex(*target).trial.is_some() =>
            {
                Some((*target, chains[0].known.clone()))
            }
            PlanStep::Equation { .. }
            | PlanStep::Image { .. }
            | PlanStep::Trials { .. }
            | PlanStep::Same { .. } => None,
        };
        steps().filter_map(begins).find(|(target, _)| *target == v)?;
        let here = |(target, known): (VertexId, Vec<Term>)| {
            if self.plan.vertex(target).is_at(own) { known.last().copied() } else { None }
        };
        let body = steps().filter_map(begins).filter_map(here).find_map(|t| {
            if let TermConnection::Turning(body) = t.by { Some(body) } else { None }
        })?;
        let rate = of_trial(&self.turning(on, body), run);
        Some(if run == 1 { format!("{rate} = 0") } else { rate })
    }

    /// Returns the point and the bar of a mate that a step introduces in the first trial.
    pub fn mate(&self, step: &PlanStep) -> Option<[String; 2]> {
        let target = step.target();
        self.plan.vertex(target).trial.filter(|trial| trial.mate && trial.run == 1)?;
        let gap =
            step.chains().iter().flat_map(|c| &c.unknown).find(|t| t.kind == TermKind::Gap)?;
        Some([self.spot(target), self.line(gap.to, gap.of)])
    }

    /// Returns the columns of an equation with its loci: the chain that starts at a fixed point (or
    /// the point itself) on the left, then the other chains, each after an equals sign.
    pub fn columns(
        &self,
        on: DiagramKind,
        target: VertexId,
        chains: &[TermChain],
    ) -> Vec<EquationColumn> {
        let mut out: Vec<EquationColumn> = Vec::new();
        // A single chain has no unknowns.
        let absolute_left = !self.plan.vertex(chains[0].start).fixed
            || chains.len() == 1 && chains[0].known.len() > 1;
        if absolute_left {
            out.push(EquationColumn {
                joint: "",
                symbol: self.summand(on, target),
                direction: self.notation.unknown.clone(),
                magnitude: self.notation.unknown.clone(),
                term: None,
            });
        }
        for (i, chain) in chains.iter().enumerate() {
            // The first chain is left of the equals sign, unless the point itself is.
            let leads = i == 0 && !absolute_left;
            let mut first = true;
            let mut joint = || {
                let j = match (first, leads) {
                    (true, true) => "",
                    (true, false) => "=",
                    (false, _) => "+",
                };
                first = false;
                j
            };
            if !self.plan.vertex(chain.start).fixed {
                let (direction, magnitude) = self.known_vector(on, chain.start);
                out.push(EquationColumn {
                    joint: joint(),
                    symbol: self.summand(on, chain.start),
                    direction,
                    magnitude,
                    term: None,
                });
            }
            for t in chain.known.iter().chain(&chain.unknown) {
                out.push(EquationColumn {
                    joint: joint(),
                    symbol: self.notation.vectors.write(self.symbol(on, t)),
                    direction: self.direction(t),
                    magnitude: self.magnitude(on, t),
                    term: Some(*t),
                });
            }
        }
        out
    }

    /// Returns a point's vector as a summand of a vector equation.
    pub fn summand(&self, on: DiagramKind, v: VertexId) -> String {
        self.notation.vectors.write(self.vector(on, v))
    }

    /// Returns direction and magnitude of a known vertex: those of its own single term, otherwise
    /// "known".
    fn known_vector(&self, on: DiagramKind, v: VertexId) -> (String, String) {
        let defining = self.plan.steps(on).iter().flat_map(|g| g.steps(0)).find_map(|s| match s {
            PlanStep::Equation { target, chains, .. } if *target == v && chains.len() == 1 => {
                Some(&chains[0])
            }
            PlanStep::Equation { .. }
            | PlanStep::Image { .. }
            | PlanStep::Trials { .. }
            | PlanStep::Same { .. } => None,
        });
        if let Some(c) = defining
            && self.plan.vertex(c.start).fixed
            && let [t] = c.known[..]
        {
            return (self.direction(&t), self.magnitude(on, &t));
        }
        (self.notation.known.clone(), self.notation.known.clone())
    }
}
