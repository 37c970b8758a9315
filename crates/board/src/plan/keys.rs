//! Names of vectors for programs: keys that form ids (`normal-C-B`), and quantities in the notation
//! of `find` (`an_CB`).
//!
//! Both are made from terms and vertices alone, so that they are the same in every language and
//! notation. [`PlanWriter::symbol`] gives two vectors the same symbol exactly if they have the same
//! key.

use super::text::{PlanWriter, vertex_name};
use super::{Term, TermConnection, TermKind, TurningBody, VertexId, VertexPlace};
use hodograph_scene::{DiagramKind, Scene};

/// The part of a relative motion that a vector represents.
#[derive(Clone, Copy, PartialEq, Eq)]
enum TermPart {
    Whole,
    Normal,
    Tangential,
    Coriolis,
    Sliding,
    SlidingNormal,
    SlidingTangential,
    Rolling,
}

impl TermPart {
    /// Returns the word of a key; the word of a whole vector depends on its ends.
    fn word(self) -> &'static str {
        match self {
            TermPart::Whole => "rel",
            TermPart::Normal => "normal",
            TermPart::Tangential => "tangential",
            TermPart::Coriolis => "coriolis",
            TermPart::Sliding => "sliding",
            TermPart::SlidingNormal => "sliding-normal",
            TermPart::SlidingTangential => "sliding-tangential",
            TermPart::Rolling => "rolling",
        }
    }

    /// Returns the letters that `find` writes after `v` or `a`; `find` does not have the last part,
    /// which gets letters of its own.
    fn letters(self) -> &'static str {
        match self {
            TermPart::Whole => "",
            TermPart::Normal => "n",
            TermPart::Tangential => "t",
            TermPart::Coriolis => "k",
            TermPart::Sliding => "r",
            TermPart::SlidingNormal => "rn",
            TermPart::SlidingTangential => "rt",
            TermPart::Rolling => "ro",
        }
    }
}

impl PlanWriter<'_> {
    /// Returns the key of the whole vector of a vertex: `abs-B`, `abs-B3`.
    pub fn vector_key(&self, v: VertexId) -> String {
        format!("abs-{}", self.vertex(v))
    }

    /// Returns the whole vector of a vertex in the notation of `find`: `v_B`, `a_B3`.
    pub fn vector_quantity(&self, on: DiagramKind, v: VertexId) -> String {
        format!("{}_{}", on.letter(), self.vertex(v))
    }

    /// Returns the key of a term: `abs-C`, `rel-C-B`, `normal-C-B`, `coriolis-A3-A2`.
    pub fn key(&self, on: DiagramKind, t: &Term) -> String {
        let part = self.part_of(on, t);
        match (part, self.is_absolute(on, t)) {
            (TermPart::Whole, true) => self.vector_key(t.of),
            (_, true) => format!("{}-{}", part.word(), self.vertex(t.of)),
            (_, false) => format!("{}-{}-{}", part.word(), self.vertex(t.of), self.vertex(t.to)),
        }
    }

    /// Returns a term in the notation of `find`: `v_CB`, `an_CB`, `ak_A3A2`, `arn_A/2`.
    pub fn quantity(&self, on: DiagramKind, t: &Term) -> String {
        let part = self.part_of(on, t);
        let head = format!("{}{}_{}", on.letter(), part.letters(), self.vertex(t.of));
        if self.is_absolute(on, t) {
            return head;
        }
        let of_guide = matches!(part, TermPart::SlidingNormal | TermPart::SlidingTangential);
        match t.by {
            TermConnection::Frame { body: Some(TurningBody::Link(l)), .. }
                if part != TermPart::Whole =>
            {
                format!("{head}/{}", self.scene.link_name(l))
            }
            TermConnection::Frame { .. } if part != TermPart::Whole => {
                format!("{head}/{}", self.vertex(t.to))
            }
            TermConnection::Guide { .. } if of_guide => {
                match self.plan.vertex(t.to).link(self.scene) {
                    Some(l) => format!("{head}/{}", self.scene.link_name(l)),
                    None => format!("{head}/{}", self.vertex(t.to)),
                }
            }
            TermConnection::Turning(_)
            | TermConnection::Guide { .. }
            | TermConnection::Cylinder(_)
            | TermConnection::Contact(_)
            | TermConnection::Frame { .. }
            | TermConnection::Apart => {
                let [of, to] = [t.of, t.to].map(|v| self.vertex(v));
                let between = if self.runs_on(&of, &to, t) { "" } else { "," };
                format!("{head}{between}{to}")
            }
        }
    }

    fn vertex(&self, v: VertexId) -> String {
        vertex_name(self.scene, self.plan, v)
    }

    /// Returns the part of a relative motion that a term represents: the cases of its superscript.
    fn part_of(&self, on: DiagramKind, t: &Term) -> TermPart {
        let acceleration = on == DiagramKind::Acceleration;
        let along_arc = match t.by {
            TermConnection::Guide { guide, .. } => self.is_arc(guide),
            TermConnection::Frame { about, .. } => about.is_some(),
            TermConnection::Turning(_)
            | TermConnection::Cylinder(_)
            | TermConnection::Contact(_)
            | TermConnection::Apart => false,
        };
        let fixed_guide = self.is_absolute(on, t) && matches!(t.by, TermConnection::Guide { .. });
        match t.kind {
            TermKind::Relative
                if matches!(t.by, TermConnection::Turning(TurningBody::Cylinder(_))) =>
            {
                TermPart::Tangential
            }
            TermKind::Relative | TermKind::Gap => TermPart::Whole,
            TermKind::Normal => TermPart::Normal,
            TermKind::Tangential => TermPart::Tangential,
            TermKind::Coriolis => TermPart::Coriolis,
            TermKind::Extension => TermPart::Sliding,
            TermKind::Slide if fixed_guide && acceleration && along_arc => TermPart::Tangential,
            TermKind::Slide if fixed_guide => TermPart::Whole,
            TermKind::SlideNormal if self.is_absolute(on, t) => TermPart::Normal,
            TermKind::Slide if acceleration && along_arc => TermPart::SlidingTangential,
            TermKind::Slide => TermPart::Sliding,
            TermKind::SlideNormal => TermPart::SlidingNormal,
            TermKind::Roll if acceleration && !self.is_absolute(on, t) => TermPart::Rolling,
            TermKind::Roll => TermPart::Whole,
        }
    }

    /// Returns true if two names written one after the other can be read in only one way.
    fn runs_on(&self, of: &str, to: &str, t: &Term) -> bool {
        let numbered = |v: VertexId| self.plan.vertex(v).number.is_some();
        if [of, to].iter().any(|n| n.contains(','))
            || [t.of, t.to]
                .iter()
                .any(|v| matches!(self.plan.vertex(*v).spot, VertexPlace::Special(_)))
        {
            return false;
        }
        let run = format!("{of}{to}");
        let weight = usize::from(numbered(t.of)) + usize::from(numbered(t.to));
        let pair = |at: usize| {
            Some(is_vertex(self.scene, &run[..at])? + is_vertex(self.scene, &run[at..])?)
        };
        let others = run.char_indices().map(|(at, _)| at).filter(|at| *at != 0 && *at != of.len());
        is_vertex(self.scene, &run).is_none() && !others.filter_map(pair).any(|w| w <= weight)
    }
}

/// Returns 0 for the name of a point, 1 for the name of a point with a link.
fn is_vertex(scene: &Scene, text: &str) -> Option<usize> {
    let link = |name: &str| scene.links.iter().any(|l| l.name == name);
    if scene.points.iter().any(|p| p.name == text) {
        return Some(0);
    }
    scene.points.iter().any(|p| text.strip_prefix(p.name.as_str()).is_some_and(link)).then_some(1)
}
