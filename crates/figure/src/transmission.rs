//! The transmission angle γ of each dyad at the pose and where it is least, as arcs on the
//! mechanism; for a four-bar in both positions in which the crank is in line with the frame, with
//! the formula.
//!
//! γ is the acute angle between the lines along which the two legs of a dyad hold its pin: two bars,
//! or a bar and the normal of a guide.

use hodograph_base::diag::{Diagnostic, Faults, Warned, both};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::{each, tr};
use hodograph_mechanism::mechanism::{ConstraintLine, Core};
use hodograph_mechanism::position::Configuration;
use hodograph_paper::paper::item::Figure;
use hodograph_paper::paper::label::Label;
use hodograph_scene::{DiagramKind, Kind, PointId, Scene};
use hodograph_sweep::extreme::{self, Grashof, GroupTransmission, MotionLimits};
use hodograph_worked::worked::{Worked, work_motion};
use std::f64::consts::{PI, TAU};

use super::extremes::{amount, with_rows};
use super::list::{FigureEntry, FigureInput, Pages};
use super::mechanism::{MarkedAngle, PositionMarks, positions};
use super::placed::{PlacedMechanism, at_travels, placed};
use super::sheet::{SheetDrafter, swept_symbol};

/// The transmission angles.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "transmission",
    about: each!("Transmission angles: at the pose, and where they are least"),
    draw,
};

/// Radius of the first arc, distance to the next, and length of a side beyond its arc.
const RADIUS_MM: f64 = 10.0;
const APART_MM: f64 = 4.0;
const BEYOND_MM: f64 = 4.0;
/// Positions of the driver within this angle or length (rad or m) are one position.
const SAME: f64 = 1e-6;

/// A dyad with a pin whose legs hold it along two lines.
struct PinnedDyad<'a> {
    pin: PointId,
    lines: [ConstraintLine; 2],
    least: &'a GroupTransmission,
}

fn draw(w: &FigureInput) -> Result<Warned<Pages>, Faults> {
    let of_motion = work_motion(w.scene)?;
    let (scene, worked) =
        of_motion.as_ref().map_or((w.scene, w.worked), |(scene, worked)| (scene, worked));
    let limits = extreme::limits(scene, &worked.mechanism, 0)?;
    let dyads: Vec<PinnedDyad> =
        limits.transmission.iter().filter_map(|least| PinnedDyad::of(worked, least)).collect();
    if dyads.is_empty() {
        return Err(none(worked).into());
    }
    let mut pages = Pages::new();
    for (k, dyad) in dyads.iter().enumerate() {
        let number = if dyads.len() > 1 { format!("-{}", k + 1) } else { String::new() };
        let figure = page(w, (scene, worked), &limits, dyad)?;
        pages.push((format!("{}{number}", ENTRY.name), figure));
    }
    Ok(Warned { value: pages, notes: Vec::new() })
}

fn none(worked: &Worked) -> Diagnostic {
    let higher = worked.mechanism.groups.iter().any(|g| g.class().is_some_and(|c| c != "II"));
    let message = if higher {
        both!(
            "the mechanism has a group above class II, for which no transmission angle is defined"
        )
    } else {
        both!("no dyad transmits by a bar: on a lever with a slide γ is 90° in every position")
    };
    Diagnostic::error("no-transmission", message).help(both!(
        "transmission angles are drawn for dyads with a pin between two bars, or between a bar and a slider"
    ))
}

impl<'a> PinnedDyad<'a> {
    fn of(worked: &Worked, least: &'a GroupTransmission) -> Option<PinnedDyad<'a>> {
        let of_group = |core: &Core| match core {
            Core::Pin { pin, legs } if Some(*pin) == least.pin => {
                let [a, b] = &legs[..] else { return None };
                Some(PinnedDyad { pin: *pin, lines: [a.line()?, b.line()?], least })
            }
            Core::Pin { .. } | Core::Link { .. } | Core::Higher => None,
        };
        worked.mechanism.groups.iter().find_map(|g| of_group(&g.core))
    }

    /// Returns the vertex (m), the directions of both sides, and whether each is drawn already as a
    /// bar; the angle between them is acute.
    fn sides(&self, at: &Configuration) -> Option<(Point, [Vec2; 2], [bool; 2])> {
        let centre = at.points[self.pin.0]?;
        let of = |line: ConstraintLine| {
            Some(match line {
                ConstraintLine::Along { far, .. } => ((at.points[far.0]? - centre).unit()?, true),
                ConstraintLine::Normal { guide, .. } => {
                    (at.guides[guide.0]?.tangent_at(centre).perp(), false)
                }
                ConstraintLine::Tangent { .. } => return None,
            })
        };
        let [(one, mut first), (two, second)] = [of(self.lines[0])?, of(self.lines[1])?];
        // The angle of an obtuse triangle is measured from the extension of one bar.
        if one.dot(two) >= 0.0 {
            return Some((centre, [one, two], [first, second]));
        }
        if !second {
            return Some((centre, [one, -two], [first, second]));
        }
        first = false;
        Some((centre, [-one, two], [first, second]))
    }

    /// Returns the angle (rad).
    fn angle(&self, at: &Configuration) -> Option<f64> {
        let (_, [one, two], _) = self.sides(at)?;
        Some(libm::atan2(one.cross(two).abs(), one.dot(two)))
    }

    /// Returns the mark of the angle; `k` numbers the marks of a drawing.
    fn mark(
        &self,
        scene: &Scene,
        at: &Configuration,
        symbol: &str,
        k: usize,
    ) -> Option<MarkedAngle> {
        let (centre, [one, two], drawn) = self.sides(at)?;
        let turn = libm::atan2(one.cross(two), one.dot(two));
        let value = amount(&scene.book, Kind::Angle, turn.abs());
        // Arcs about pins that are close together are apart.
        let radius_mm = RADIUS_MM + APART_MM * k as f64;
        Some(MarkedAngle {
            key: format!("gamma-{k}"),
            label: format!("{symbol} = {value}"),
            centre,
            sides: [one.angle(), one.angle() + turn],
            radius_mm,
            lines_mm: drawn.map(|drawn| if drawn { 0.0 } else { radius_mm + BEYOND_MM }),
        })
    }

    /// Returns the travels of the crank to the two positions in which it is in line with the frame,
    /// the folded one first; `None` if the dyad is no four-bar's, or its crank does not turn fully.
    fn in_line(&self, scene: &Scene, worked: &Worked, limits: &MotionLimits) -> Option<[f64; 2]> {
        let (Grashof::CrankRocker | Grashof::DoubleCrank, _) = limits.grashof? else { return None };
        let ground = &scene.links[scene.ground.0].points;
        let (crank, _) = scene.drivers[0].kind.turned()?;
        let at = |p: PointId| worked.configuration.points[p.0];
        let far = self.lines.map(|line| match line {
            ConstraintLine::Along { far, .. } => Some(far),
            ConstraintLine::Normal { .. } | ConstraintLine::Tangent { .. } => None,
        });
        let [a, b] = [far[0]?, far[1]?];
        let (tip, fixed) = if ground.contains(&a) { (b, a) } else { (a, b) };
        let pivot = *scene.links[crank.0].points.iter().find(|p| ground.contains(p))?;
        let (arm, frame) = (at(tip)? - at(pivot)?, at(fixed)? - at(pivot)?);
        let turn = libm::atan2(arm.cross(frame), arm.dot(frame)).rem_euclid(TAU);
        Some([turn, (turn + PI).rem_euclid(TAU)])
    }
}

fn page(
    w: &FigureInput,
    of: (&Scene, &Worked),
    limits: &MotionLimits,
    dyad: &PinnedDyad,
) -> Result<Figure, Faults> {
    let now = limits.range.now;
    let in_line = dyad.in_line(of.0, of.1, limits);
    let travels = match in_line {
        Some(both) => both.to_vec(),
        None => vec![dyad.least.driver - now],
    };
    let apart = |t: &f64| t.abs() > SAME && (TAU - t).abs() > SAME;
    let at = at_travels(of.0, of.1, &travels);
    let mut all: Vec<(Configuration, f64)> = at.into_iter().zip(travels).collect();
    let angles: Vec<f64> = all.iter().filter_map(|(at, _)| dyad.angle(at)).collect();
    let least = angles.iter().copied().fold(f64::INFINITY, f64::min);
    let symbols: Vec<&str> = match &angles[..] {
        [_, _] => vec!["\\gamma'", "\\gamma''"],
        _ => vec!["\\gamma_\\text{min}"],
    };
    // The pose of the scene may be one of them.
    let own = all.iter().position(|(_, t)| !apart(t));
    let mut marked: Vec<(Configuration, String)> = all
        .drain(..)
        .zip(&symbols)
        .filter(|((_, t), _)| apart(t))
        .map(|((at, _), symbol)| (at, (*symbol).to_owned()))
        .collect();
    let names: Vec<String> = marked.iter().map(|(_, symbol)| symbol.clone()).collect();
    for (k, (_, mark)) in marked.iter_mut().enumerate() {
        *mark = (k + 1).to_string();
    }
    let PlacedMechanism { scene, worked, course, others } = placed(w, of, marked)?;
    let (scene, worked) = (&scene, &worked);
    let mut marks = PositionMarks::default();
    let symbol = own.and_then(|k| symbols.get(k)).copied().unwrap_or("\\gamma");
    marks.angles.extend(dyad.mark(scene, &worked.configuration, symbol, 0));
    for (k, (pose, symbol)) in others.iter().zip(&names).enumerate() {
        marks.angles.extend(dyad.mark(scene, &pose.worked.configuration, symbol, k + 1));
    }
    marks.poses = others;
    let options = w.options;
    let maker = SheetDrafter { scene, worked, options, certified: Vec::new() };
    let part = positions(&options.style, (scene, worked), &options.notation, &course, &marks);
    let words = tr!(options.lang, "Transmission angle");
    let mu = maker.caption(DiagramKind::Plane).1;
    let titled = maker.titled(part, Label::text(words), &mu, ENTRY.name);
    let mut rows = Vec::new();
    if let (Some(_), [folded, extended], Some((_, lengths))) =
        (in_line, &angles[..], limits.grashof)
    {
        rows.extend(formula(w, scene, lengths, [*folded, *extended]));
    }
    let (driver, kind) = swept_symbol(scene, 0);
    let place = if kind == Kind::Angle && limits.range.full() {
        dyad.least.driver.rem_euclid(TAU * limits.seen as f64)
    } else {
        dyad.least.driver
    };
    let least = if least.is_finite() { least.min(dyad.least.angle) } else { dyad.least.angle };
    rows.push(Label::math(format!(
        "\\gamma_\\text{{min}} = {}\\quad ({driver} = {})",
        amount(&scene.book, Kind::Angle, least),
        amount(&scene.book, kind, place)
    )));
    Ok(maker.alone(with_rows(options, titled, rows)))
}

/// Returns the law of cosines in both positions of a four-bar with its numbers, and the letters:
/// a crank, b coupler, c output, d frame.
fn formula(w: &FigureInput, scene: &Scene, [a, b, c, d]: [f64; 4], angles: [f64; 2]) -> Vec<Label> {
    let book = &scene.book;
    let length = |x: f64| amount(book, Kind::Length, x);
    let angle = |x: f64| amount(book, Kind::Angle, x);
    let words = tr!(w.options.lang, "crank, coupler, output, frame: ");
    let mut rows = vec![Label::math(format!(
        "\\text{{{words}}}a = {},\\ b = {},\\ c = {},\\ d = {}",
        length(a),
        length(b),
        length(c),
        length(d)
    ))];
    for (sign, prime, (far, gamma)) in
        [("−", "'", (d - a, angles[0])), ("+", "''", (d + a, angles[1]))]
    {
        let cosine = (b * b + c * c - far * far) / (2.0 * b * c);
        let delta = libm::acos(cosine.clamp(-1.0, 1.0));
        let supplement = if delta > PI / 2.0 {
            format!("{} − {} = ", angle(PI), angle(delta))
        } else {
            String::new()
        };
        rows.push(Label::math(format!(
            "\\cos\\delta{prime} = [b^2 + c^2 − (d {sign} a)^2]/(2bc) = {},\\quad \\delta{prime} = {},\\quad \\gamma{prime} = {supplement}{}",
            hodograph_report::amount::number(cosine, super::extremes::DIGITS),
            angle(delta),
            angle(gamma)
        )));
    }
    rows
}
