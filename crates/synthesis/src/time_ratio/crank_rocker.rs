//! Crank-rocker with a time ratio.
//!
//! In its limit positions crank and coupler are collinear: AC₁ = BC + AB or BC − AB, AC₂ the other,
//! and ∠C₁AC₂ = θ. So AB is half the difference of AC₁ and AC₂, and BC half the sum.
//!
//! Either one limit is given (rocker, frame, the rocker's angle with the frame): C₂ is the
//! intersection of the ray AC₁, turned by ±θ, with the rocker's circle. Or the swing ψ is given: A
//! is on the circle through C₁, C₂ with the inscribed angle θ, and one parameter along it is free.
//! It is determined by the frame's length, the crank's or the coupler's, or the least transmission
//! angle is maximised (*Source*: VDI 2130, Alt's problem; the optimum by golden-section search in
//! double-double numbers).

mod choice;
mod drawing;
mod explained;
mod family;

use super::StrokeRatio;
use super::bar::GivenBar;
use crate::board::SynthesisBoard;
use crate::candidate::{Demand, DesignNumber, Draft, WantedPosition};
use crate::form::TaskForm;
use crate::fourbar::{FourBar, Heading, cross_circle, named_lengths};
use crate::judge::USUAL_GAMMA;
use crate::nearest::told;
use crate::{Proof, Statement, TaskResult, Wish};
use family::{Family, most_k};
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::digits::{metres, significant};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::number::Real;
use std::f64::consts::{FRAC_PI_2, PI};

#[derive(Clone, Debug)]
struct CrankRocker {
    ratio: StrokeRatio,
    /// The rocker (m); one metre if another length determines the size.
    rocker: f64,
    size: SizeBasis,
    way: RockerGivens,
}

/// The givens that determine the linkage in addition to K and the rocker.
#[derive(Clone, Debug)]
enum RockerGivens {
    /// The frame and the angle ∠ADC₁ in one limit.
    Limit { frame: f64, angle: f64 },
    /// The rocker's swing and the frame.
    Swing { swing: f64, frame: f64 },
    /// The rocker's swing, and the crank or the coupler.
    Bar { swing: f64, bar: GivenBar },
    /// The rocker's swing, and two points of a line through A; D is the origin, the swing is
    /// symmetrical about the upward axis.
    Line { swing: f64, line: [Point; 2] },
    /// The rocker's swing; the least transmission angle is maximised.
    Best { swing: f64, chosen: bool },
    /// The rocker's swing and the least transmission angle (rad).
    Gamma { swing: f64, gamma: f64 },
}

/// The length that determines the size of the linkage.
#[derive(Clone, Copy, Debug, PartialEq)]
enum SizeBasis {
    /// The rocker.
    Rocker,
    /// The frame (m), where the place of A does not follow from it.
    Frame(f64),
    /// The crank (m).
    Crank(f64),
}

pub(super) fn read(form: &TaskForm) -> Option<Box<dyn Wish>> {
    let ratio = StrokeRatio::read(form);
    // A shape chosen by its transmission angle can be scaled to any of its lengths.
    let by_shape = form.has("swing") && (form.has("gamma") || form.has("best"));
    let (rocker, size) = match (form.has("rocker"), by_shape) {
        (false, true) if form.has("frame") => (Some(1.0), form.size("frame").map(SizeBasis::Frame)),
        (false, true) if form.has("crank") => (Some(1.0), form.size("crank").map(SizeBasis::Crank)),
        _ => (form.need_size("rocker", "\"75 mm\""), Some(SizeBasis::Rocker)),
    };
    let best = form.has("best").then(|| form.choice("best", &["transmission"]));
    let way = match (form.has("limit"), form.has("swing")) {
        (true, false) => {
            let frame = form.need_size("frame", "\"100 mm\"");
            within(form, "limit")
                .zip(frame)
                .map(|(angle, frame)| RockerGivens::Limit { frame, angle })
        }
        (false, true) if form.has("gamma") => {
            let gamma = form.angle("gamma").filter(|g| {
                let inside = *g > 0.0 && *g < FRAC_PI_2;
                if !inside {
                    let d =
                        Diagnostic::error("out-of-range", both!("`gamma` lies between 0° and 90°"));
                    form.fault(d.at(form.span("gamma")).help(both!("write \"gamma\": \"40 deg\"")));
                }
                inside
            });
            within(form, "swing")
                .zip(gamma)
                .map(|(swing, gamma)| RockerGivens::Gamma { swing, gamma })
        }
        (false, true) if form.has("line") && (form.has("frame") || best.is_some()) => {
            let message = both!("\"line\", \"frame\" and \"best\" are three ways to place A");
            form.fault(
                Diagnostic::error("wrong-given", message)
                    .at(form.span("line"))
                    .help(both!("keep one of them")),
            );
            None
        }
        (false, true) if form.has("line") => within(form, "swing")
            .zip(choice::line(form))
            .map(|(swing, line)| RockerGivens::Line { swing, line }),
        (false, true) if form.has("frame") && best.is_none() => within(form, "swing")
            .zip(form.size("frame"))
            .map(|(swing, frame)| RockerGivens::Swing { swing, frame }),
        (false, true) if form.has("crank") && best.is_none() => within(form, "swing")
            .zip(form.size("crank"))
            .map(|(swing, crank)| RockerGivens::Bar { swing, bar: GivenBar::Crank(crank) }),
        (false, true) if form.has("coupler") && best.is_none() => within(form, "swing")
            .zip(form.size("coupler"))
            .map(|(swing, coupler)| RockerGivens::Bar { swing, bar: GivenBar::Coupler(coupler) }),
        (false, true) => {
            within(form, "swing").map(|swing| RockerGivens::Best { swing, chosen: best.is_none() })
        }
        (both_given, _) => {
            let message = match both_given {
                true => both!("`limit` and `swing` are two ways to fix the linkage"),
                false => {
                    both!("neither `limit` nor `swing` is given")
                }
            };
            let help = both!(
                "give \"limit\": \"45 deg\" (the rocker's angle with the frame in one limit position, with \"frame\"), or \"swing\": \"40 deg\""
            );
            form.fault(Diagnostic::error("missing-key", message).at(form.span("limit")).help(help));
            None
        }
    };
    Some(Box::new(CrankRocker { ratio: ratio?, rocker: rocker?, size: size?, way: way? }))
}

/// Reads an angle between 0 and 180°, both excluded (rad).
fn within(form: &TaskForm, key: &str) -> Option<f64> {
    let angle = form.need_angle(key, "\"40 deg\"")?;
    if angle > 0.0 && angle < PI {
        return Some(angle);
    }
    let d = Diagnostic::error("out-of-range", both!("`{key}` lies between 0° and 180°"));
    form.fault(d.at(form.span(key)));
    None
}

/// A linkage by its limit positions, the frame along x.
struct Limits {
    which: Both,
    d: Point,
    c: [Point; 2],
}

impl Wish for CrankRocker {
    fn title(&self) -> Both {
        both!("Crank-rocker with time ratio {}", significant(self.ratio.k, 4))
    }

    fn solve(&self, heading: &Heading) -> Result<TaskResult, Faults> {
        let mut notes = self.ratio.notes();
        let found = match self.way {
            RockerGivens::Limit { .. }
            | RockerGivens::Swing { .. }
            | RockerGivens::Bar { .. }
            | RockerGivens::Line { .. } => {
                let all = self.all();
                if all.is_empty() {
                    return Err(self.none());
                }
                if !all.iter().any(|l| self.turns(l)) {
                    notes.push(self.no_crank_rocker());
                }
                notes.extend(self.whole_arc());
                all
            }
            RockerGivens::Best { swing, chosen } => {
                if chosen {
                    let message = both!(
                        "A is free on the circle through C1 and C2: taken where the least transmission angle is greatest"
                    );
                    let help = both!("fix it by \"frame\", or write \"best\": \"transmission\"");
                    notes.push(Diagnostic::note("free-choice", message).help(help));
                }
                self.best(swing, &mut notes)?
            }
            RockerGivens::Gamma { swing, gamma } => self.at_gamma(swing, gamma)?,
        };
        let drafts =
            found.iter().map(|l| self.sized(l)).map(|(own, l)| own.draft(&l, heading)).collect();
        Ok(TaskResult { drafts, notes, ..TaskResult::default() })
    }

    fn construct(&self, draft: &Draft, board: &mut SynthesisBoard) -> Option<()> {
        self.drawn(draft, board)
    }

    fn statement(&self) -> Statement {
        self.stated()
    }

    fn proof(&self, draft: &Draft) -> Vec<Proof> {
        self.proved(draft)
    }
}

impl CrankRocker {
    /// A at the origin, D on the x axis, C₁ above it; C₂ on the ray AC₁ turned by ±θ.
    fn by_limit(&self, frame: f64, angle: f64) -> Vec<Limits> {
        let d = Point::new(frame, 0.0);
        let c1 = d + Vec2::from_angle(PI - angle) * self.rocker;
        let mut found = Vec::new();
        // With K = 1 the two rays coincide.
        let senses: &[f64] = if self.ratio.theta == 0.0 { &[1.0] } else { &[1.0, -1.0] };
        for &sense in senses {
            let ray = Vec2::from_angle(c1.to_vec2().angle() + sense * self.ratio.theta);
            for (k, at) in
                cross_circle(Point::ORIGIN, ray, d, self.rocker).into_iter().flatten().enumerate()
            {
                let c2 = Point::ORIGIN + ray * at;
                // The ray starts at A; with K = 1 it meets the circle in C₁ again.
                if at > 0.0 && c2.distance(c1) > 1e-9 * self.rocker {
                    let side =
                        if sense > 0.0 { both!("counter-clockwise") } else { both!("clockwise") };
                    let place = if k == 0 { both!("the nearer") } else { both!("the farther") };
                    let which = both!("C2 on the ray AC1 turned {} by θ, {} crossing", side, place);
                    found.push(Limits { which, d, c: [c1, c2] });
                }
            }
        }
        found
    }

    /// C₁ and C₂ for a swing, with D at the origin and symmetrical about the upward axis.
    fn swung(&self, swing: f64) -> [Point; 2] {
        [1.0, -1.0]
            .map(|s| Point::ORIGIN + Vec2::from_angle(FRAC_PI_2 + s * swing / 2.0) * self.rocker)
    }

    /// The linkages with A on the circle over C₁C₂ with the inscribed angle θ, at the distance of
    /// the frame from D.
    fn by_frame(&self, swing: f64, frame: f64) -> Vec<Limits> {
        let c = self.swung(swing);
        let chord = c[0].distance(c[1]);
        let theta = self.ratio.theta;
        let mut found = Vec::new();
        // The centre is on the axis of symmetry; for θ = 0 the circle becomes a line, that of the
        // chord.
        for above in [true, false] {
            let middle = self.rocker * libm::cos(swing / 2.0);
            let roots = if theta == 0.0 {
                let half2 = (frame - middle) * (frame + middle);
                (above && half2 > 0.0).then(|| Point::new(half2.sqrt(), middle))
            } else {
                let radius = chord / (2.0 * libm::sin(theta));
                let rise = chord / (2.0 * libm::tan(theta));
                let centre = middle + if above { rise } else { -rise };
                // On both circles: x² + y² = frame², x² + (y − centre)² = radius².
                let y = (frame * frame - radius * radius + centre * centre) / (2.0 * centre);
                let x2 = (frame - y) * (frame + y);
                // The arc on the far side of the chord from its centre has the angle 180° − θ.
                let inscribed = if above { y > middle } else { y < middle };
                (x2 > 0.0 && inscribed).then(|| Point::new(x2.sqrt(), y))
            };
            if let Some(a) = roots {
                let which = match above {
                    true => both!("A on the arc beyond C1C2"),
                    false => both!("A on the arc on the side of D"),
                };
                found.push(self.laid(which, a, c));
            }
        }
        found
    }

    /// Notes that for ψ = 2θ the circle with the inscribed angle θ has its centre in D: a frame as
    /// long as the rocker leaves A free on it.
    fn whole_arc(&self) -> Option<Diagnostic> {
        let RockerGivens::Swing { swing, frame } = self.way else { return None };
        let same = |p: f64, q: f64| (p - q).abs() <= 1e-9 * q;
        if !(same(swing, 2.0 * self.ratio.theta) && same(frame, self.rocker)) {
            return None;
        }
        let message = both!(
            "with ψ = 2θ and a frame as long as the rocker A lies anywhere on the circle through C1 and C2: one of its places is taken"
        );
        let help = both!(
            "fix it by \"crank\", or write \"best\": \"transmission\" in the place of \"frame\""
        );
        Some(Diagnostic::note("free-choice", message).help(help))
    }

    /// The linkage rotated and moved so that A is the origin, D on the x axis, the rocker above.
    fn laid(&self, which: Both, a: Point, c: [Point; 2]) -> Limits {
        let frame = Point::ORIGIN - a;
        let axis = frame * (1.0 / frame.norm());
        let turned = |p: Point| Point::new(axis.dot(p - a), axis.cross(p - a));
        let mut c = c.map(turned);
        if c[0].y + c[1].y < 0.0 {
            c = c.map(|p| Point::new(p.x, -p.y));
        }
        Limits { which, d: Point::new(frame.norm(), 0.0), c }
    }

    /// The linkage with the greatest least transmission angle; adds a note on the K that a better
    /// one needs.
    fn best(&self, swing: f64, notes: &mut Vec<Diagnostic>) -> Result<Vec<Limits>, Faults> {
        let theta = self.ratio.theta;
        if theta == 0.0 {
            let message = both!("with K = 1 A lies anywhere on the line C1C2: the frame is free");
            let d = Diagnostic::error("free-choice", message)
                .help(both!("give \"frame\", longer than {}", metres(self.rocker)));
            return Err(d.into());
        }
        let family = Family::of(theta, swing);
        let Some((worst, beta, toward_d)) = family.scanned(1440) else {
            let message = both!(
                "no crank-rocker has K = {} and a swing of {}°",
                significant(self.ratio.k, 4),
                significant(swing.to_degrees(), 4)
            );
            let help = match most_k(swing, 1.0) {
                k if k > 1.0 => {
                    both!("K is below {} for this swing", told(k))
                }
                _ => both!("take a smaller swing"),
            };
            return Err(Diagnostic::error("no-real-solution", message).help(help).into());
        };
        let usual = libm::cos(USUAL_GAMMA);
        if worst > usual {
            let message =
                both!("no linkage of this K and swing has a transmission angle of 40° throughout");
            let help = match most_k(swing, usual) {
                k if k > 1.0 => both!("K = {} and less has one", told(k)),
                _ => both!("take a smaller swing"),
            };
            notes.push(Diagnostic::warning("poor-transmission", message).help(help));
        }
        let step = (PI - theta) / 1440.0;
        let beta = family.golden(beta - step, beta + step, toward_d).approx();
        let a = family.place(beta, toward_d, self.rocker);
        let which = match toward_d {
            true => both!("greatest least transmission angle, A on the side of D"),
            false => both!("greatest least transmission angle, A beyond C1C2"),
        };
        Ok(vec![self.laid(which, a, self.swung(swing))])
    }

    /// The linkage scaled to the given length.
    fn sized(&self, l: &Limits) -> (CrankRocker, Limits) {
        let far = l.c.map(|c| c.to_vec2().norm());
        let by = match self.size {
            SizeBasis::Rocker => 1.0,
            SizeBasis::Frame(frame) => frame / l.d.x,
            SizeBasis::Crank(crank) => crank / ((far[0] - far[1]).abs() / 2.0),
        };
        let grown = |p: Point| (p.to_vec2() * by).to_point();
        let own = CrankRocker { rocker: self.rocker * by, ..self.clone() };
        (own, Limits { which: l.which.clone(), d: grown(l.d), c: l.c.map(grown) })
    }

    fn draft(&self, l: &Limits, heading: &Heading) -> Draft {
        let far = l.c.map(|c| c.to_vec2().norm());
        let (ab, bc) = ((far[0] - far[1]).abs() / 2.0, (far[0] + far[1]) / 2.0);
        // In the farther limit crank and coupler are stretched, in the nearer one they are folded.
        let stretched = usize::from(far[1] > far[0]);
        let sense = |i: usize| if i == stretched { 1.0 } else { -1.0 };
        let limit = |i: usize| {
            let direction = l.c[i].to_vec2() * (sense(i) / far[i]);
            (direction.angle(), Point::ORIGIN + direction * ab)
        };
        let wanted = [0, 1].map(|i| {
            let (driver, b) = limit(i);
            WantedPosition { driver, places: vec![("B".into(), b), ("C".into(), l.c[i])] }
        });
        let four = FourBar { a: Point::ORIGIN, b: limit(0).1, c: l.c[0], d: l.d, e: None };
        let swing = (l.c[0] - l.d).cross(l.c[1] - l.d).abs();
        let swing = libm::atan2(swing, (l.c[0] - l.d).dot(l.c[1] - l.d));
        let mut numbers = named_lengths([ab, bc, self.rocker, l.d.x]);
        numbers.push(DesignNumber::angle(
            "theta",
            both!("crank angle between the limit positions"),
            self.ratio.theta,
        ));
        numbers.push(DesignNumber::angle("psi", both!("swing of the rocker"), swing));
        let beta = |from: Vec2, to: Vec2| libm::atan2(from.cross(to).abs(), from.dot(to));
        numbers.push(DesignNumber::angle(
            "beta",
            both!("angle C1C2A"),
            beta(l.c[0] - l.c[1], Point::ORIGIN - l.c[1]),
        ));
        numbers.push(DesignNumber::ratio("K", both!("time ratio"), self.ratio.k));
        let demands = vec![Demand::FullTurn, Demand::TimeRatio(self.ratio.k), Demand::Swing(swing)];
        let remarks = vec![super::slow_stroke(limit(0).0, limit(1).0, heading.omega)];
        Draft {
            demands,
            remarks,
            ..Draft::new(l.which.clone(), four.scene(heading), numbers, wanted.into())
        }
    }
}
