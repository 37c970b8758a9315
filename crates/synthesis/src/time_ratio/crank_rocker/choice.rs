//! The choice of A on the circle with the inscribed angle θ by a line, and the nearest feasible
//! task where there is no crank-rocker.

use super::super::bar::GivenBar;
use super::family::Family;
use super::{CrankRocker, Limits, RockerGivens};
use crate::board::cross_circles;
use crate::fourbar::cross_circle;
use crate::nearest::{number, told};
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::digits::significant;
use hodograph_base::geom::{Point, Vec2};
use std::f64::consts::PI;

impl CrankRocker {
    /// The linkages with A at the intersection of a line and the circle over C₁C₂ with the
    /// inscribed angle θ; D is the origin, the swing is symmetrical about the upward axis.
    pub(super) fn by_line(&self, swing: f64, [through, end]: [Point; 2]) -> Vec<Limits> {
        let c = self.swung(swing);
        let along = end - through;
        let Some(along) = along.unit() else { return Vec::new() };
        let (theta, chord) = (self.ratio.theta, c[0].distance(c[1]));
        let middle = self.rocker * libm::cos(swing / 2.0);
        let mut places: Vec<(Point, bool)> = Vec::new();
        if theta == 0.0 {
            // The circle becomes the line of the chord.
            if along.y.abs() > 1e-9 {
                places.push((through + along * ((middle - through.y) / along.y), true));
            }
        } else {
            let (radius, rise) =
                (chord / (2.0 * libm::sin(theta)), chord / (2.0 * libm::tan(theta)));
            for above in [true, false] {
                let centre = Point::new(0.0, middle + if above { rise } else { -rise });
                let crossings = cross_circle(through, along, centre, radius)
                    .into_iter()
                    .flatten()
                    .map(|at| through + along * at);
                // The arc on the far side of the chord has the angle 180° − θ.
                places.extend(
                    crossings
                        .filter(|a| if above { a.y > middle } else { a.y < middle })
                        .map(|a| (a, above)),
                );
            }
        }
        // On the axis of symmetry AC₁ = AC₂: the crank has zero length.
        places.retain(|(a, _)| (a.distance(c[0]) - a.distance(c[1])).abs() > 1e-6 * self.rocker);
        let named = |(k, (a, above)): (usize, &(Point, bool))| {
            let which = match above {
                true => both!("crossing {} of the line, beyond C1C2", k + 1),
                false => both!("crossing {} of the line, on the side of D", k + 1),
            };
            self.laid(which, *a, c)
        };
        places.iter().enumerate().map(named).collect()
    }

    /// The linkages with A where AC₁ and AC₂ are sum and difference of the two bars.
    pub(super) fn by_bar(&self, swing: f64, bar: GivenBar) -> Vec<Limits> {
        let c = self.swung(swing);
        let Some([crank, coupler]) = bar.both(c[0].distance(c[1]), libm::cos(self.ratio.theta))
        else {
            return Vec::new();
        };
        let Some(both_sides) = cross_circles(c[0], coupler + crank, c[1], coupler - crank) else {
            return Vec::new();
        };
        let middle = self.rocker * libm::cos(swing / 2.0);
        let named = |a: Point| {
            let which = if a.y > middle {
                both!("A on the arc beyond C1C2")
            } else {
                both!("A on the arc on the side of D")
            };
            self.laid(which, a, c)
        };
        both_sides.into_iter().map(named).collect()
    }

    /// All linkages of a task, crank-rockers or not.
    pub(super) fn all(&self) -> Vec<Limits> {
        match self.way {
            RockerGivens::Limit { frame, angle } => self.by_limit(frame, angle),
            RockerGivens::Swing { swing, frame } => self.by_frame(swing, frame),
            RockerGivens::Bar { swing, bar } => self.by_bar(swing, bar),
            RockerGivens::Line { swing, line } => self.by_line(swing, line),
            RockerGivens::Best { .. } | RockerGivens::Gamma { .. } => Vec::new(),
        }
    }

    /// The linkages of the family with the wanted least transmission angle.
    pub(super) fn at_gamma(&self, swing: f64, gamma: f64) -> Result<Vec<Limits>, Faults> {
        let family = Family::of(self.ratio.theta, swing);
        let found =
            if self.ratio.theta > 0.0 { family.at(libm::cos(gamma), 1440) } else { Vec::new() };
        if found.is_empty() {
            let (k, psi, wanted) = (self.ratio.k, swing.to_degrees(), gamma.to_degrees());
            let [k, psi, wanted] = [k, psi, wanted].map(|v| significant(v, 4));
            let message = both!(
                "no crank-rocker of K = {k} and a swing of {psi}° has the least transmission angle {wanted}°"
            );
            let help = match family.scanned(1440).filter(|_| self.ratio.theta > 0.0) {
                Some((cosine, ..)) => both!(
                    "the greatest is {}°; \"best\": \"transmission\" takes it",
                    significant(libm::acos(cosine).to_degrees(), 4)
                ),
                None => both!("take a smaller swing or K"),
            };
            return Err(Diagnostic::error("no-real-solution", message).help(help).into());
        }
        let told = |(beta, toward_d): (f64, bool)| {
            let which = match toward_d {
                true => both!("A on the side of D, β = {}°", significant(beta.to_degrees(), 4)),
                false => both!("A beyond C1C2, β = {}°", significant(beta.to_degrees(), 4)),
            };
            self.laid(which, family.place(beta, toward_d, self.rocker), self.swung(swing))
        };
        // A beyond the axis of symmetry is the mirror image of an A on this side.
        let mut all: Vec<Limits> = Vec::new();
        for l in found.into_iter().map(told) {
            let reach = |l: &Limits| {
                let far = l.c.map(|c| c.to_vec2().norm());
                [far[0].min(far[1]), far[0].max(far[1]), l.d.x]
            };
            let same =
                |m: &Limits| reach(m).iter().zip(reach(&l)).all(|(p, q)| (p - q).abs() <= 1e-9 * q);
            if !all.iter().any(same) {
                all.push(l);
            }
        }
        Ok(all)
    }

    /// True if a linkage by its limits is a crank-rocker with both limits in one assembly.
    pub(super) fn turns(&self, l: &Limits) -> bool {
        let far = l.c.map(|c| c.to_vec2().norm());
        let (ab, bc) = ((far[0] - far[1]).abs() / 2.0, (far[0] + far[1]) / 2.0);
        let (cd, ad) = (self.rocker, l.d.x);
        let longest = bc.max(cd).max(ad);
        let shortest = ab > 1e-6 * longest && ab < bc.min(cd).min(ad);
        let grashof = 2.0 * (ab + longest) - (ab + bc + cd + ad);
        // K = 1 is the centric linkage with a² + d² = b² + c². It is no change point in Grashof's
        // sense.
        shortest && grashof < 0.0 && l.c[0].y * l.c[1].y > 0.0
    }

    fn works(&self, way: RockerGivens, k: f64) -> bool {
        let ratio = super::StrokeRatio { k, theta: PI * (k - 1.0) / (k + 1.0), turned: false };
        let other = CrankRocker { ratio, rocker: self.rocker, size: self.size, way };
        k >= 1.0 && other.all().iter().any(|l| other.turns(l))
    }

    /// The nearest feasible task: another frame, another line, or another K.
    fn nearest(&self) -> Both {
        let own = self.ratio.k;
        let (way, other) = match self.way {
            RockerGivens::Limit { frame, angle } => {
                let works = |mm: f64| {
                    mm > 0.0 && self.works(RockerGivens::Limit { frame: mm * 1e-3, angle }, own)
                };
                (
                    RockerGivens::Limit { frame, angle },
                    number(frame * 1e3, frame * 1e3, works).map(frame_told),
                )
            }
            RockerGivens::Swing { swing, frame } => {
                let works = |mm: f64| {
                    mm > 0.0 && self.works(RockerGivens::Swing { swing, frame: mm * 1e-3 }, own)
                };
                // The range that works may be narrower than the steps: the best of all linkages is
                // in it.
                let best = || self.best(swing, &mut Vec::new()).ok()?.first().map(|l| l.d.x * 1e3);
                (
                    RockerGivens::Swing { swing, frame },
                    number(frame * 1e3, frame * 1e3, works).or_else(best).map(frame_told),
                )
            }
            RockerGivens::Bar { swing, bar } => {
                let works = |mm: f64| {
                    mm > 0.0 && self.works(RockerGivens::Bar { swing, bar: bar.with(mm) }, own)
                };
                let said = |mm: f64| both!("with \"{}\": \"{} mm\"", bar.key(), told(mm));
                (
                    RockerGivens::Bar { swing, bar },
                    number(bar.length() * 1e3, bar.length() * 1e3, works).map(said),
                )
            }
            RockerGivens::Line { swing, line } => {
                let place = |[x, y]: [f64; 2]| Point::new(x * 1e-3, y * 1e-3);
                let through = [line[0].x * 1e3, line[0].y * 1e3];
                let shifted = |axis: usize, v: f64| {
                    let mut at = through;
                    at[axis] = v;
                    at
                };
                let moved = |axis: usize| {
                    let works = |v: f64| {
                        let from = place(shifted(axis, v));
                        self.works(
                            RockerGivens::Line { swing, line: [from, from + (line[1] - line[0])] },
                            own,
                        )
                    };
                    number(through[axis], self.rocker * 1e3, works)
                        .map(|v| ((v - through[axis]).abs(), shifted(axis, v)))
                };
                let best = [0, 1].into_iter().filter_map(moved).min_by(|a, b| a.0.total_cmp(&b.0));
                let said = |(_, [x, y]): (f64, [f64; 2])| {
                    both!("with \"through\": [\"{} mm\", \"{} mm\"]", told(x), told(y))
                };
                (RockerGivens::Line { swing, line }, best.map(said))
            }
            RockerGivens::Best { .. } | RockerGivens::Gamma { .. } => return Both::default(),
        };
        let k = number(own, own, |k| self.works(way.clone(), k))
            .map(|k| both!("with \"K\": {}", told(k)));
        match (other, k) {
            (Some(one), Some(two)) => both!("there is one {}; or, all else as given, {}", one, two),
            (Some(one), None) | (None, Some(one)) => both!("there is one {}", one),
            (None, None) => both!(
                "leave \"frame\", \"limit\" and \"line\" out and give \"swing\" alone: the linkage with the best transmission angle is taken"
            ),
        }
    }

    /// The error for a task without any linkage, with its reason.
    pub(super) fn none(&self) -> Faults {
        let theta = significant(self.ratio.theta.to_degrees(), 4);
        let message = match self.way {
            RockerGivens::Limit { .. } => both!(
                "the rays turned by θ = {theta}° miss the circle of the rocker: there is no second limit position"
            ),
            RockerGivens::Swing { frame, .. } => both!(
                "the circle with the inscribed angle θ = {theta}° has no point at {} from D",
                hodograph_base::digits::metres(frame)
            ),
            RockerGivens::Bar { bar: GivenBar::Crank(crank), .. } => both!(
                "no coupler closes both limit positions with a crank of {} under θ = {theta}°",
                hodograph_base::digits::metres(crank)
            ),
            RockerGivens::Bar { bar: GivenBar::Coupler(coupler), .. } => both!(
                "no crank closes both limit positions with a coupler of {} under θ = {theta}°",
                hodograph_base::digits::metres(coupler)
            ),
            RockerGivens::Line { .. } => both!(
                "the line does not cross the circle with the inscribed angle θ = {theta}° where A has a crank"
            ),
            RockerGivens::Best { .. } | RockerGivens::Gamma { .. } => Both::default(),
        };
        Diagnostic::error("no-real-solution", message).help(self.nearest()).into()
    }

    /// The warning for linkages none of which is a crank-rocker that joins both limits.
    pub(super) fn no_crank_rocker(&self) -> Diagnostic {
        let message =
            both!("no crank turns through what comes out, or its limits lie on two assemblies");
        Diagnostic::warning("not-a-crank", message).help(self.nearest())
    }
}

fn frame_told(mm: f64) -> Both {
    both!("with \"frame\": \"{} mm\"", told(mm))
}

/// Reads a place and a direction as two places of a line.
pub(super) fn line(form: &crate::form::TaskForm) -> Option<[Point; 2]> {
    let inner = form.inner("line", &["through", "angle"])?;
    inner.need("through", "[\"0 mm\", \"0 mm\"]")?;
    let through = inner.point("through");
    let angle = if inner.has("angle") { inner.angle("angle") } else { Some(0.0) };
    let (through, angle) = (through?, angle?);
    Some([through, through + Vec2::from_angle(angle)])
}
