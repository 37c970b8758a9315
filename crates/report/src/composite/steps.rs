//! The composite motion of a point as steps: the known vectors are laid off, the others close the
//! figure.

use super::{CompositeWords, symbol};
use hodograph_base::geom::Vec2;
use hodograph_base::lang::{say, tr};
use hodograph_methods::composite::{ChoiceSolution, KnownMotion, projections};
use hodograph_paper::paper::phrase::Phrase;
use hodograph_scene::quantity::composite::CompositePart;
use hodograph_scene::{DiagramKind, Kind};

/// A step of the construction.
pub struct CompositeStep {
    /// The polygon; [`DiagramKind::Plane`] for a step that draws no vector.
    pub on: DiagramKind,
    /// The vectors that the step draws; `None` is the absolute one.
    pub draws: Vec<Option<CompositePart>>,
    /// The sentence.
    pub text: Phrase,
}

impl CompositeWords<'_> {
    /// Returns the steps of a choice. They are the same in both languages.
    pub fn steps(&self, s: &ChoiceSolution) -> Vec<CompositeStep> {
        let lang = self.lang;
        let step = |on, draws: &[Option<CompositePart>], text: &str| CompositeStep {
            on,
            draws: draws.to_vec(),
            text: Phrase::new(text),
        };
        let stop = tr!(lang, ". ");
        let line = |p: &Phrase| format!("{}{}", p.source(), stop.trim_end());
        let heading =
            [self.heading(&s.choice), self.three_motions(&s.choice)].map(|p| p.source()).join(stop);
        let mut out = vec![step(DiagramKind::Plane, &[], &format!("{heading}{}", stop.trim_end()))];
        let path = match s.slip {
            Some(slip) if !s.acceleration.is_empty() => self.contact(&slip, 1),
            Some(_) | None => vec![self.first(s)],
        };
        let path: Vec<String> = path.iter().map(Phrase::source).collect();
        out.push(step(
            DiagramKind::Plane,
            &[],
            &format!("{}{}", path.join(lang.pick([" ", ""])), stop.trim_end()),
        ));
        let velocities: Vec<(Option<CompositePart>, Vec2)> =
            [None, Some(CompositePart::TransportVelocity), Some(CompositePart::RelativeVelocity)]
                .into_iter()
                .zip(s.velocity)
                .collect();
        for (on, vectors) in
            [(DiagramKind::Velocity, &velocities), (DiagramKind::Acceleration, &s.acceleration)]
        {
            if vectors.is_empty() {
                continue;
            }
            self.vectors(s, on, vectors, &mut out);
            for p in projections(s).iter().filter(|p| p.of == on) {
                let (words, equation) = self.projection(p, s.known);
                let text = self.projected(&words, &equation);
                out.push(step(on, &[], &format!("{text}{}", stop.trim_end())));
            }
        }
        if let Some(turning) = &s.turning {
            out.push(step(DiagramKind::Plane, &[], &line(&self.turning(s, turning))));
        }
        out
    }

    /// Adds the steps of a polygon: its equation, each known vector, and the others together.
    fn vectors(
        &self,
        s: &ChoiceSolution,
        on: DiagramKind,
        vectors: &[(Option<CompositePart>, Vec2)],
        out: &mut Vec<CompositeStep>,
    ) {
        let lang = self.lang;
        let symbol_of = |p: Option<CompositePart>| symbol(p, on, self.notation);
        let written = |p| self.notation.vectors.write(symbol_of(p));
        let parts: Vec<String> = vectors.iter().skip(1).map(|v| written(v.0)).collect();
        let equation = format!("${} = {}$", written(None), parts.join(" + "));
        let kind = if on == DiagramKind::Velocity { Kind::Velocity } else { Kind::Acceleration };
        let each: Vec<(String, Vec2)> = vectors.iter().map(|v| (symbol_of(v.0), v.1)).collect();
        let told = self.values(&each, kind, 1);
        let told: Vec<(Option<CompositePart>, String)> =
            vectors.iter().zip(&told).map(|(v, text)| (v.0, text.source())).collect();
        let (known, rest): (Vec<_>, Vec<_>) =
            told.into_iter().partition(|(part, _)| is_known(s.known, *part));
        let step = |draws: Vec<Option<CompositePart>>, text: String| CompositeStep {
            on,
            draws,
            text: Phrase::new(&text),
        };
        out.push(step(
            Vec::new(),
            match on {
                DiagramKind::Velocity => say!(lang, "The velocities: {equation}."),
                DiagramKind::Acceleration | DiagramKind::Plane | DiagramKind::Force => {
                    say!(lang, "The accelerations: {equation}.")
                }
            },
        ));
        for (part, value) in known {
            let reason = self.reason_of(part);
            out.push(step(vec![part], say!(lang, "Lay off {reason}: {value}.")));
        }
        let draws = rest.iter().map(|(part, _)| *part).collect();
        let values = rest.into_iter().map(|(_, text)| text).collect::<Vec<_>>().join(self.comma());
        out.push(step(
            draws,
            match on {
                DiagramKind::Velocity => {
                    say!(lang, "The parallelogram with the diagonal $v_{{a}}$ gives {values}.")
                }
                DiagramKind::Acceleration | DiagramKind::Plane | DiagramKind::Force => {
                    say!(lang, "The lines of the unknown vectors close the polygon: {values}.")
                }
            },
        ));
    }

    /// Returns how a known vector is known.
    fn reason_of(&self, part: Option<CompositePart>) -> &'static str {
        let lang = self.lang;
        match part {
            None => tr!(lang, "the absolute motion, which is known"),
            Some(CompositePart::TransportVelocity | CompositePart::Transport) => {
                tr!(lang, "the transport motion: that of the frame's point at the moving point")
            }
            Some(CompositePart::TransportNormal) => {
                tr!(lang, "the normal transport part $\\omega^2 r$, toward the axis of the frame")
            }
            Some(CompositePart::TransportTangential) => {
                tr!(lang, "the tangential transport part $\\alpha r$, square to the radius")
            }
            Some(CompositePart::RelativeNormal) => tr!(
                lang,
                "the normal relative part $v_{r}^2/\\rho$, toward the centre of the relative path"
            ),
            Some(CompositePart::Coriolis) => tr!(
                lang,
                "the Coriolis part $2\\omega v_{r}$: $v_{r}$ turned by 90° in the sense of $\\omega$"
            ),
            Some(
                CompositePart::RelativeVelocity
                | CompositePart::Relative
                | CompositePart::Path
                | CompositePart::RelativeTangential,
            ) => tr!(lang, "the relative motion"),
        }
    }
}

/// Returns true if a vector follows from what is known before the polygon is drawn.
fn is_known(known: KnownMotion, part: Option<CompositePart>) -> bool {
    let of_point = known != KnownMotion::Transport;
    let of_frame = known != KnownMotion::Absolute;
    match part {
        None => of_point,
        Some(
            CompositePart::TransportVelocity
            | CompositePart::Transport
            | CompositePart::TransportTangential,
        ) => of_frame,
        Some(
            CompositePart::TransportNormal
            | CompositePart::RelativeNormal
            | CompositePart::Coriolis,
        ) => true,
        Some(
            CompositePart::RelativeVelocity
            | CompositePart::Relative
            | CompositePart::Path
            | CompositePart::RelativeTangential,
        ) => false,
    }
}
