//! Composite motion of a point as a table and as JSON: suitable and unsuitable moving points and
//! frames with the reasons, the components of the motion, and the projection that eliminates the
//! unwanted unknown. The terms are those of theoretical mechanics.

mod coriolis;
mod derivation;
mod equated;
mod motions;
mod steps;

pub use derivation::DerivationWords;
pub use steps::CompositeStep;

use super::answers::diagnostic;
use super::columns::columns;
use super::writing::PointForm;
use hodograph_base::diag::Diagnostic;
use hodograph_base::digits::{direction_degrees, inked, significant};
use hodograph_base::geom::Vec2;
use hodograph_base::lang::{say, tr};
use hodograph_base::notation::Notation;
use hodograph_board::plan::names::name_label;
use hodograph_methods::composite::contact::ContactSlip;
use hodograph_methods::composite::{
    AxisRotation, ChoicePlace, ChoiceSolution, ChoiceVerdict, ContactScene, FrameChoice,
    KnownMotion, On, Projection, ProjectionTerm, name_of, projections,
};
use hodograph_paper::paper::phrase::{Phrase, capital, sense};
use hodograph_scene::quantity::composite::CompositePart;
use hodograph_scene::quantity::{Frame, RelativePath};
use hodograph_scene::{DiagramKind, GuidePath, Kind, Lang, Scene};
use serde_json::{Value as Json, json};

/// Significant digits of the table; `solve` prints the certified ones.
const DIGITS: usize = 5;
/// Number of values per line.
pub const PER_LINE: usize = 3;

/// Returns the report as text.
pub fn text(
    scene: &Scene,
    all: &[FrameChoice],
    solved: &[ChoiceSolution],
    lang: Lang,
    notation: &Notation,
) -> String {
    let w = CompositeWords { scene, lang, notation };
    let mut lines = Vec::new();
    let title = lang.of(&scene.title);
    if !title.is_empty() {
        lines.push(title.to_owned());
    }
    if all.is_empty() {
        lines.push(
            tr!(lang, "no pair of moving bodies offers a moving point and a frame").to_owned(),
        );
    } else {
        lines.extend(columns(&w.table(all), usize::MAX));
    }
    for s in solved {
        lines.push(String::new());
        lines.extend(w.lines(s).iter().map(|p| p.plain()));
    }
    let both = w.equated(solved);
    if !both.is_empty() {
        lines.push(String::new());
        lines.extend(both.iter().map(|p| p.plain()));
    }
    lines.iter().map(|l| format!("{}\n", l.trim_end())).collect()
}

/// Returns moving point and frame of each choice that the scene names, each followed by its three
/// motions.
pub fn named(scene: &Scene, lang: Lang, notation: &Notation) -> Vec<Phrase> {
    let staged = ContactScene::new(scene);
    let w = CompositeWords { scene: &staged.scene, lang, notation };
    let choices = staged.shown(scene, 0);
    choices.iter().flat_map(|c| [w.heading(c), w.three_motions(c)]).collect()
}

/// Returns the word for a verdict in JSON.
pub fn code(verdict: ChoiceVerdict) -> &'static str {
    match verdict {
        ChoiceVerdict::Serves => "serves",
        ChoiceVerdict::PathUnknown => "path-unknown",
        ChoiceVerdict::PointChanges => "momentary-point",
        ChoiceVerdict::SameBody => "same-body",
        ChoiceVerdict::FrameFixed => "frame-unusable",
    }
}

/// A writer for one scene and language.
pub struct CompositeWords<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The language.
    pub lang: Lang,
    /// The marks of normal, tangential and Coriolis components, and the notation of vectors.
    pub notation: &'a Notation,
}

impl CompositeWords<'_> {
    fn table(&self, all: &[FrameChoice]) -> Vec<Vec<String>> {
        let lang = self.lang;
        let head = [
            tr!(lang, "moving point"),
            tr!(lang, "frame"),
            tr!(lang, "at"),
            tr!(lang, "verdict"),
            "",
        ];
        let row = |c: &FrameChoice| {
            let point = name_of(self.scene, &c.of);
            vec![
                point,
                self.frame(c.frame, PointForm::Plain),
                self.place(c),
                self.verdict(c.verdict).to_owned(),
                self.reason(c),
            ]
        };
        std::iter::once(head.map(str::to_owned).to_vec()).chain(all.iter().map(row)).collect()
    }

    /// Returns a frame: `link 2`, `translating with C`.
    fn frame(&self, frame: Frame, writing: PointForm) -> String {
        match frame {
            Frame::Link(l) => say!(self.lang, "link {}", self.scene.link_name(l)),
            Frame::Point(p) => {
                say!(self.lang, "translating with {}", writing.point(&name_of(self.scene, &p)))
            }
        }
    }

    fn place(&self, c: &FrameChoice) -> String {
        let lang = self.lang;
        match c.place {
            ChoicePlace::Named => tr!(lang, "as asked").to_owned(),
            ChoicePlace::Pin(p) => {
                format!("{} {}", tr!(lang, "pin"), self.scene.point_name(p))
            }
            ChoicePlace::Guide(g) => {
                let guide = &self.scene.guides[g.0];
                let name = guide.pin.map_or("", |p| self.scene.point_name(p));
                format!("{} {name}", tr!(lang, "guide at"))
            }
            ChoicePlace::Cam(_) => {
                format!("{} {}", tr!(lang, "contact"), self.scene.point_name(c.of.point))
            }
            ChoicePlace::Contact(r) => {
                format!(
                    "{} {}",
                    tr!(lang, "contact"),
                    self.scene.point_name(self.scene.rolling[r.0].at[0])
                )
            }
        }
    }

    /// Returns the verdict in a word or two.
    pub fn verdict(&self, verdict: ChoiceVerdict) -> &'static str {
        match verdict {
            ChoiceVerdict::Serves => tr!(self.lang, "serves"),
            ChoiceVerdict::PathUnknown => tr!(self.lang, "path not known"),
            ChoiceVerdict::PointChanges => tr!(self.lang, "point changes"),
            ChoiceVerdict::SameBody => tr!(self.lang, "same body"),
            ChoiceVerdict::FrameFixed => tr!(self.lang, "frame stands still"),
        }
    }

    /// Returns the reason for the verdict.
    fn reason(&self, c: &FrameChoice) -> String {
        let (scene, lang) = (self.scene, self.lang);
        match c.verdict {
            ChoiceVerdict::Serves if c.path == RelativePath::Unknown => tr!(
                lang,
                "momentary contact: v_r along the tangent, a_r^n known from the velocities"
            )
            .to_owned(),
            ChoiceVerdict::Serves => self.path(c, PointForm::Plain),
            ChoiceVerdict::PathUnknown => tr!(
                lang,
                "its path in the frame is not known: neither the direction of v_r nor a_r^n"
            )
            .to_owned(),
            ChoiceVerdict::PointChanges => tr!(
                lang,
                "another point of the body lies at the contact at every instant; its relative path is not the guide or profile"
            )
            .to_owned(),
            ChoiceVerdict::SameBody => {
                let point = scene.point_name(c.of.point);
                say!(lang, "{point} belongs to the frame: no relative motion")
            }
            ChoiceVerdict::FrameFixed => tr!(lang, "nothing is carried").to_owned(),
        }
    }

    /// Returns the path of the point in the frame.
    fn path(&self, c: &FrameChoice, writing: PointForm) -> String {
        let (scene, lang) = (self.scene, self.lang);
        match c.path {
            RelativePath::Guide(g) => match scene.guides[g.0].path {
                GuidePath::Line { .. } => {
                    tr!(lang, "relative path: a straight line, the guide").to_owned()
                }
                GuidePath::Arc { centre, .. } => {
                    self.circle(&writing.point(scene.point_name(centre)))
                }
            },
            RelativePath::Circle(k) => self.circle(&writing.point(scene.point_name(k))),
            RelativePath::Unknown => String::new(),
        }
    }

    fn circle(&self, centre: &str) -> String {
        say!(self.lang, "relative path: a circle about {centre}")
    }

    /// Returns the heading of a choice: `moving point A, frame fixed to link 2`.
    pub fn heading(&self, c: &FrameChoice) -> Phrase {
        let (point, frame) = (
            PointForm::Marked.point(&name_of(self.scene, &c.of)),
            self.frame(c.frame, PointForm::Marked),
        );
        Phrase::new(&match c.frame {
            Frame::Link(_) => say!(self.lang, "Moving point {point}, frame fixed to {frame}"),
            Frame::Point(_) => say!(self.lang, "Moving point {point}, frame {frame}"),
        })
    }

    /// Returns a projection in one line.
    fn projected(&self, words: &str, equation: &str) -> String {
        format!("{words}{}${equation}$", self.lang.pick([" ", ""]))
    }

    /// Returns all lines of a choice: heading, path, equations with values, projections.
    pub fn lines(&self, s: &ChoiceSolution) -> Vec<Phrase> {
        let mut out = vec![self.heading(&s.choice), self.three_motions(&s.choice)];
        out.extend(self.body(s, PER_LINE));
        out
    }

    /// Returns the lines below the heading of a choice, with `per_line` values per line; in narrow
    /// columns of fewer than three a projection takes two lines.
    pub fn body(&self, s: &ChoiceSolution, per_line: usize) -> Vec<Phrase> {
        let mut out = match s.slip {
            Some(slip) if !s.acceleration.is_empty() => self.contact(&slip, per_line),
            Some(_) | None => vec![self.first(s)],
        };
        let [whole, carried, relative] = ["v_{a}", "v_{e}", "v_{r}"]
            .map(|symbol| self.notation.vectors.write(symbol.to_owned()));
        out.push(Phrase::new(&format!("${whole} = {carried} + {relative}$")));
        let [a, e, r] = s.velocity;
        out.extend(self.values(
            &[("v_{a}".into(), a), ("v_{e}".into(), e), ("v_{r}".into(), r)],
            Kind::Velocity,
            per_line,
        ));
        let projections = projections(s);
        let projected = |of| -> Vec<Phrase> {
            let lines = projections.iter().filter(|p| p.of == of).flat_map(|p| {
                let (words, equation) = self.projection(p, s.known);
                if per_line < PER_LINE {
                    vec![words, format!("${equation}$")]
                } else {
                    vec![self.projected(&words, &equation)]
                }
            });
            lines.map(|l| Phrase::new(&l)).collect()
        };
        out.extend(projected(DiagramKind::Velocity));
        if !s.acceleration.is_empty() {
            let written = |p| {
                self.notation.vectors.write(symbol(p, DiagramKind::Acceleration, self.notation))
            };
            let symbols: Vec<String> =
                s.acceleration.iter().skip(1).map(|(p, _)| written(*p)).collect();
            out.push(Phrase::new(&format!(
                "${} = {}$",
                self.notation.vectors.write("a_{a}".to_owned()),
                symbols.join(" + ")
            )));
            let each: Vec<(String, Vec2)> = s
                .acceleration
                .iter()
                .map(|(p, v)| (symbol(*p, DiagramKind::Acceleration, self.notation), *v))
                .collect();
            out.extend(self.values(&each, Kind::Acceleration, per_line));
            out.extend(projected(DiagramKind::Acceleration));
        }
        out.extend(s.turning.as_ref().map(|t| self.turning(s, t)));
        out
    }

    /// Returns angular velocity and angular acceleration of the link that rotates about a fixed
    /// axis with the wanted motion: `ω_3 = v_e/l_{CB} = ...`.
    fn turning(&self, s: &ChoiceSolution, t: &AxisRotation) -> Phrase {
        let (scene, lang) = (self.scene, self.lang);
        let [axis, point] = [t.axis, s.choice.of.point].map(|p| name_label(scene.point_name(p)));
        let whose = if t.of_frame { "e" } else { "a" };
        let arm = format!("l_{{{axis}{point}}}");
        let link = name_label(scene.link_name(t.link));
        let value = |kind: Kind, si: f64| {
            let words = if si == 0.0 { "" } else { sense(lang, si) };
            format!("{}$ {words}", self.amount(kind, si.abs())).trim_end().to_owned()
        };
        let mut out =
            format!("$\\omega_{{{link}}} = v_{{{whose}}}/{arm} = {}", value(Kind::Omega, t.omega));
        if let Some(alpha) = t.alpha {
            let part = format!("a^{{{}}}_{{{whose}}}", self.notation.tangential);
            out += &format!(
                "{}$\\alpha_{{{link}}} = {part}/{arm} = {}",
                self.comma(),
                value(Kind::Alpha, alpha)
            );
        }
        Phrase::new(&out)
    }

    /// Returns the properties of the relative path that are known before the drawing.
    fn first(&self, s: &ChoiceSolution) -> Phrase {
        let lang = self.lang;
        Phrase::new(&match s.choice.verdict {
            ChoiceVerdict::Serves if s.slip.is_some() => {
                tr!(lang, "Momentary contact: $v_{r}$ along the common tangent").to_owned()
            }
            ChoiceVerdict::Serves => capital(&self.path(&s.choice, PointForm::Marked)),
            ChoiceVerdict::PathUnknown if !s.acceleration.is_empty() => {
                let words = tr!(lang, "Relative path not known: $a_{r}$ is the closing side");
                words.to_owned()
            }
            ChoiceVerdict::PathUnknown
            | ChoiceVerdict::PointChanges
            | ChoiceVerdict::SameBody
            | ChoiceVerdict::FrameFixed => self.verdict(s.choice.verdict).into(),
        })
    }

    /// Returns the normal part of a_r at a momentary contact: its formula and its numbers.
    fn contact(&self, slip: &ContactSlip, per_line: usize) -> Vec<Phrase> {
        let lang = self.lang;
        let told = |kind: Kind, value: f64| self.amount(kind, value);
        let formula = match slip.radii {
            [Some(_), None] => "\\Omega^2\\rho + 2\\Omega v_{s}",
            [None, Some(_)] => "\\Omega^2\\rho",
            [Some(_), Some(_)] | [None, None] => {
                "\\Omega^2\\rho_2 − (v_{s} − \\Omega\\rho_2)^2/(\\rho_1 + \\rho_2)"
            }
        };
        let first = tr!(lang, "Momentary contact: $v_{r}$ along the common tangent");
        let normal = tr!(lang, "along the outward normal of the frame's contour:");
        let equation = format!(
            "$a^{{n}}_{{r}} = {formula} = {}$",
            told(Kind::Acceleration, slip.acceleration())
        );
        let numbers = format!(
            "$\\Omega = {}${} $v_{{s}} = {}$",
            told(Kind::Omega, slip.omega),
            self.comma(),
            told(Kind::Velocity, slip.sliding)
        );
        let lines = if per_line < PER_LINE {
            vec![first.to_owned(), normal.to_owned(), equation, numbers]
        } else {
            vec![first.to_owned(), format!("{normal} {equation}{}{numbers}", self.comma())]
        };
        lines.iter().map(|l| Phrase::new(l)).collect()
    }

    fn values(&self, vectors: &[(String, Vec2)], kind: Kind, per_line: usize) -> Vec<Phrase> {
        let largest = vectors.iter().map(|v| v.1.norm()).fold(0.0, f64::max);
        let told = |(symbol, v): &(String, Vec2)| {
            // A remainder of rounding has no direction.
            if v.norm() <= 1e-12 * largest {
                return format!("${symbol} = 0$");
            }
            let degrees = inked(&significant(direction_degrees(v.angle()), DIGITS));
            format!("${symbol} = {}$ ∠ ${degrees}$°", self.amount(kind, v.norm()))
        };
        vectors
            .chunks(per_line.max(1))
            .map(|row| Phrase::new(&row.iter().map(told).collect::<Vec<_>>().join(self.comma())))
            .collect()
    }

    /// Returns an amount with its unit.
    fn amount(&self, kind: Kind, si: f64) -> String {
        let number = inked(&significant(self.scene.book.value(kind, si) + 0.0, DIGITS));
        self.scene.book.label(kind, &number)
    }

    fn comma(&self) -> &'static str {
        tr!(self.lang, "clause" => ", ")
    }

    /// Returns an equation in one line: `projected square to v_r (on 120°):` and
    /// `v_a cos 30° = v_e cos 60°`.
    fn projection(&self, p: &Projection, known: KnownMotion) -> (String, String) {
        let symbol_of = |term: ProjectionTerm| {
            let letter = p.of.letter();
            match term {
                ProjectionTerm::Absolute => symbol(None, p.of, self.notation),
                ProjectionTerm::AbsoluteNormal => format!("{letter}^{{n}}_{{a}}"),
                ProjectionTerm::AbsoluteTangential => {
                    format!("{letter}^{{{}}}_{{a}}", self.notation.tangential)
                }
                ProjectionTerm::Component => {
                    format!("{letter}_{{a{}}}", if p.on == On::Y { "y" } else { "x" })
                }
                ProjectionTerm::Part(part) => symbol(Some(part), p.of, self.notation),
            }
        };
        let (left, right): (Vec<_>, Vec<_>) =
            p.terms.iter().partition(|(term, _)| !matches!(term, ProjectionTerm::Part(_)));
        let side = |terms: &[&(ProjectionTerm, f64)]| {
            projected_sum(terms.iter().map(|(term, angle)| (symbol_of(*term), *angle)))
        };
        (self.on_line(p, known), format!("{} = {}", side(&left), side(&right)))
    }

    /// Returns the line of projection of an equation, and the unknown to be found.
    fn on_line(&self, p: &Projection, known: KnownMotion) -> String {
        let lang = self.lang;
        let degrees = inked(&significant(direction_degrees(p.line.angle()), 4));
        let relative = match p.of {
            DiagramKind::Acceleration => {
                symbol(Some(CompositePart::RelativeTangential), p.of, self.notation)
            }
            DiagramKind::Plane | DiagramKind::Velocity | DiagramKind::Force => {
                symbol(Some(CompositePart::RelativeVelocity), p.of, self.notation)
            }
        };
        let wanted = match (known, p.of) {
            (KnownMotion::Transport, DiagramKind::Acceleration) => {
                tr!(lang, " for $a_{a}$")
            }
            (KnownMotion::Transport, _) => tr!(lang, " for $v_{a}$"),
            (KnownMotion::Absolute, DiagramKind::Acceleration) => {
                tr!(lang, " for the transport part")
            }
            (KnownMotion::Absolute, _) => tr!(lang, " for $v_{e}$"),
            (KnownMotion::Both, _) => "",
        };
        // A point at rest in its frame has no v_r to be perpendicular to.
        let rests = p.of == DiagramKind::Velocity && p.rests;
        match p.on {
            On::X => say!(lang, "Projected on the x axis{wanted}:"),
            On::Y => tr!(lang, "Projected on the y axis:").to_owned(),
            On::Along => {
                say!(lang, "Projected on the relative path (${degrees}$°) for ${relative}$:")
            }
            On::Across if rests => say!(
                lang,
                "Projected on the perpendicular to the relative path (${degrees}$°){wanted}:"
            ),
            On::Across => {
                say!(lang, "Projected on the perpendicular to ${relative}$ (${degrees}$°){wanted}:")
            }
        }
    }
}

/// Returns the sum of the components on a line of vectors with their angles from it.
fn projected_sum(terms: impl Iterator<Item = (String, f64)>) -> String {
    let term = |(symbol, angle): (String, f64)| {
        let degrees = significant(angle.to_degrees(), 4);
        match degrees.parse::<f64>() {
            Ok(d) if d.abs() < 0.01 => symbol,
            Ok(d) if (d - 180.0).abs() < 0.01 => format!("−{symbol}"),
            _ => format!("{symbol}\\,\\cos {}°", inked(&degrees)),
        }
    };
    let all: Vec<String> = terms.map(term).collect();
    if all.is_empty() { "0".to_owned() } else { all.join(" + ").replace("+ −", "− ") }
}

/// Returns the symbol of a component in the letters of theoretical mechanics with the marks of a
/// notation; `None`: the absolute quantity.
pub fn symbol(part: Option<CompositePart>, on: DiagramKind, notation: &Notation) -> String {
    let letter = on.letter();
    let (below, above) = match part {
        None => ("a", ""),
        Some(CompositePart::TransportVelocity | CompositePart::Transport) => ("e", ""),
        Some(CompositePart::TransportNormal) => ("e", "n"),
        Some(CompositePart::TransportTangential) => ("e", notation.tangential.as_str()),
        Some(CompositePart::RelativeVelocity | CompositePart::Relative | CompositePart::Path) => {
            ("r", "")
        }
        Some(CompositePart::RelativeNormal) => ("r", "n"),
        Some(CompositePart::RelativeTangential) => ("r", notation.tangential.as_str()),
        Some(CompositePart::Coriolis) => (notation.coriolis.as_str(), ""),
    };
    if above.is_empty() {
        format!("{letter}_{{{below}}}")
    } else {
        format!("{letter}^{{{above}}}_{{{below}}}")
    }
}

/// Returns the choices as JSON, in SI.
pub fn json(
    staged: &ContactScene,
    all: &[FrameChoice],
    solved: &[ChoiceSolution],
    notes: &[Diagnostic],
) -> Json {
    let scene = &staged.scene;
    let [english, keys] = [Lang::En, Lang::Zh].map(Notation::of_language);
    let w = CompositeWords { scene, lang: Lang::En, notation: &english };
    let frame = |f: Frame| match f {
        Frame::Link(l) => json!({"link": scene.link_name(l)}),
        Frame::Point(p) => json!({"point": name_of(scene, &p)}),
    };
    let path = |c: &FrameChoice| match c.path {
        RelativePath::Guide(g) => json!({"guide": g.0}),
        RelativePath::Circle(k) => json!({"circle_about": scene.point_name(k)}),
        RelativePath::Unknown if c.verdict == ChoiceVerdict::Serves => {
            json!({"contact_at": scene.point_name(c.of.point)})
        }
        RelativePath::Unknown => Json::Null,
    };
    let vector = |v: Vec2| json!([v.x, v.y]);
    let parts = |s: &ChoiceSolution| {
        let [a, e, r] = s.velocity;
        let mut out = json!({"v_a": vector(a), "v_e": vector(e), "v_r": vector(r)});
        for (part, v) in &s.acceleration {
            let key = symbol(*part, DiagramKind::Acceleration, &keys).replace(['{', '}'], "");
            let key = match key.split_once("^") {
                Some((letter, rest)) => rest
                    .split_once('_')
                    .map_or(key.clone(), |(above, below)| format!("{letter}_{below}{above}")),
                None => key,
            };
            out[key] = vector(*v);
        }
        if let Some(t) = &s.turning {
            out["turning"] =
                json!({"link": scene.link_name(t.link), "omega": t.omega, "alpha": t.alpha});
        }
        out["projections"] = projections(s)
            .iter()
            .map(|p| {
                let (words, equation) = w.projection(p, s.known);
                json!(Phrase::new(&w.projected(&words, &equation)).plain())
            })
            .collect();
        out
    };
    let motions = |c: &FrameChoice| {
        let motions::ThreeMotions { absolute, relative, transport, carried } =
            w.motions(c, PointForm::Plain);
        json!({
            "absolute": absolute,
            "relative": relative,
            "transport": transport,
            "transport_point": carried,
        })
    };
    let choices: Vec<Json> = all
        .iter()
        .map(|c| {
            let found = solved.iter().find(|s| s.choice.of == c.of && s.choice.frame == c.frame);
            json!({
                "point": name_of(scene, &c.of),
                "frame": frame(c.frame),
                "named": c.place == ChoicePlace::Named,
                "verdict": code(c.verdict),
                "reason": w.reason(c),
                "path": path(c),
                "motions": motions(c),
                "parts": found.map(parts),
            })
        })
        .collect();
    let equated: Vec<String> = w.equated(solved).iter().map(|p| p.plain()).collect();
    json!({"choices": choices, "equated": equated, "notes": notes.iter().map(diagnostic).collect::<Vec<_>>()})
}
