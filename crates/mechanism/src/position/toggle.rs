//! The cause of a limit of the motion, in words: the legs of a group that hold one another at its
//! limit.
//!
//! At the limit of a dyad the two loci of its pin touch: the lines square to them, along which the
//! legs hold the pin, coincide. At that of a link on three legs the lines along which they hold it
//! meet in one point, or are parallel. This module contains the descriptions for all users of
//! limits (sweeps, lessons); the callers find the limit itself.
//!
//! `analytic` describes singular poses of any block by the joints that the loop equations load; the
//! two modules are independent.

use super::Configuration;
use crate::mechanism::{ConstraintLine, Core, Group, Hold, Leg, Mechanism, Strut};
use hodograph_base::geom::{Point, Vec2, cross_lines};
use hodograph_base::lang::say;
use hodograph_scene::{Lang, LinkId, PointId, Scene};

/// Sine below which two lines coincide. At a limit found to the last digit of the driver the sine
/// is the square root of the rounding (1e-8 for links of similar length), elsewhere it is not
/// small.
const IN_LINE: f64 = 1e-5;

/// Three lines that intersect at less than this (sine) count as parallel: their intersection is a
/// thousand times as far away as their distance, off any paper.
pub const PARALLEL: f64 = 1e-3;

/// The cause of a limit.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Toggle {
    /// Two legs that hold a pin along one line.
    Line {
        /// The pin.
        pin: PointId,
        /// The legs.
        legs: [Leg; 2],
    },
    /// Three legs of a link.
    Legs {
        /// The link.
        link: LinkId,
        /// Its legs.
        legs: Vec<Leg>,
        /// True if the lines along which they hold it are parallel; otherwise they meet in one
        /// point.
        parallel: bool,
    },
    /// The links of any other group together.
    Open(Vec<LinkId>),
}

impl Toggle {
    /// Returns the cause of a group's limit; `parallel` is called for a link on three legs only.
    pub fn of(group: &Group, parallel: impl FnOnce() -> bool) -> Option<Toggle> {
        match &group.core {
            Core::Pin { pin, legs } => match &legs[..] {
                [a, b] if [a, b].iter().all(|l| is_named(l)) => {
                    Some(Toggle::Line { pin: *pin, legs: [*a, *b] })
                }
                _ => None,
            },
            Core::Link { link, legs } if group.class() == Some("III") => {
                Some(Toggle::Legs { link: *link, legs: legs.clone(), parallel: parallel() })
            }
            Core::Link { .. } => None,
            Core::Higher => Some(Toggle::Open(group.links.clone())),
        }
    }

    /// Returns the cause for the group that is at its limit in a pose, if there is one.
    pub fn at(m: &Mechanism, at: &Configuration) -> Option<Toggle> {
        m.groups.iter().find_map(|group| match &group.core {
            Core::Pin { legs, .. } => {
                let [(p, u), (_, v)] =
                    legs.iter().map(|l| line(at, l)).collect::<Option<Vec<_>>>()?[..]
                else {
                    return None;
                };
                (u.cross(v).abs() < IN_LINE && p.is_finite())
                    .then(|| Toggle::of(group, || false))?
            }
            Core::Link { legs, .. } if group.class() == Some("III") => {
                let lines: Vec<(Point, Vec2)> =
                    legs.iter().map(|l| line(at, l)).collect::<Option<_>>()?;
                let parallel = meeting(&lines, at.extent())?;
                Toggle::of(group, || parallel)
            }
            Core::Link { .. } | Core::Higher => None,
        })
    }

    /// Returns the cause as a clause: `link 2 (BC) and link 3 (CD) lie in line`.
    pub fn words(&self, scene: &Scene, lang: Lang) -> String {
        match self {
            Toggle::Line { pin, legs } => match legs.each_ref().map(|l| bar(scene, l, lang)) {
                [Some(a), Some(b)] => say!(lang, "{a} and {b} lie in line"),
                [Some(bar), None] | [None, Some(bar)] => {
                    say!(lang, "{bar} stands square to the guide of {}", scene.point_name(*pin))
                }
                [None, None] => {
                    say!(lang, "the two guides of {} run parallel", scene.point_name(*pin))
                }
            },
            Toggle::Legs { link, legs, parallel } => {
                let legs: Vec<String> = legs
                    .iter()
                    .map(|l| bar(scene, l, lang).unwrap_or_else(|| normal(scene, l, lang)))
                    .collect();
                let link = scene.link_name(*link);
                let legs = listed(&legs, lang);
                match parallel {
                    true => say!(lang, "{legs}, the legs of link {link}, run parallel"),
                    false => {
                        say!(
                            lang,
                            "{legs}, the legs of link {link}, lie on lines through one point"
                        )
                    }
                }
            }
            Toggle::Open(links) => {
                let names: Vec<String> =
                    links.iter().map(|l| scene.link_name(*l).to_owned()).collect();
                let names = listed(&names, lang);
                match links.len() {
                    1 => say!(lang, "link {names} leaves one freedom open"),
                    _ => say!(lang, "links {names} leave one freedom open"),
                }
            }
        }
    }

    /// Returns the links that it names.
    pub fn links(&self) -> Vec<LinkId> {
        let of =
            |legs: &[Leg]| legs.iter().filter_map(|l| Some(l.hold()?.bar()?.0)).collect::<Vec<_>>();
        match self {
            Toggle::Line { legs, .. } => of(legs),
            Toggle::Legs { link, legs, .. } => std::iter::once(*link).chain(of(legs)).collect(),
            Toggle::Open(links) => links.clone(),
        }
    }
}

/// Returns true if a clause names a leg that holds a pin. A leg with a ram is not named: the clause
/// names the links of the group instead.
fn is_named(leg: &Leg) -> bool {
    matches!(leg.line(), Some(ConstraintLine::Along { .. } | ConstraintLine::Normal { .. }))
        && !matches!(leg.hold(), Some(Hold::Distance { strut: Strut::Ram { .. }, .. }))
}

/// Returns the line along which a leg holds the pin, or the link: a point of it and its direction
/// (a unit vector).
fn line(at: &Configuration, leg: &Leg) -> Option<(Point, Vec2)> {
    let line = leg.line()?;
    let p = at.points[line.pin().0]?;
    let along = match line {
        ConstraintLine::Along { far, .. } => p - at.points[far.0]?,
        ConstraintLine::Normal { guide, .. } => at.guides[guide.0]?.tangent_at(p).perp(),
        // For a group that rolls the clause names its links, not its lines.
        ConstraintLine::Tangent { .. } => return None,
    };
    Some((p, along.unit()?))
}

/// Returns true if three lines are parallel, false if they meet in one point; `None` otherwise.
fn meeting(lines: &[(Point, Vec2)], size: f64) -> Option<bool> {
    let [(p, u), (q, v), (r, w)] = lines[..] else { return None };
    let sine = |a: Vec2, b: Vec2| a.cross(b).abs();
    let pairs = [((p, u), (q, v), (r, w)), ((p, u), (r, w), (q, v)), ((q, v), (r, w), (p, u))];
    let widest =
        pairs.into_iter().max_by(|a, b| sine(a.0.1, a.1.1).total_cmp(&sine(b.0.1, b.1.1)))?;
    let ((p, u), (q, v), (r, w)) = widest;
    if sine(u, v) < PARALLEL {
        return Some(true);
    }
    let crossing = cross_lines(p, u, q, v).at;
    // Distance of the third line from the intersection, relative to the distance of the
    // intersection or to the mechanism's size.
    let miss = w.cross(crossing - r).abs();
    (miss < IN_LINE * size.max((crossing - r).norm())).then_some(false)
}

/// Returns the name of a leg that is a line itself: `link 2 (BC)`, `cylinder BC`.
fn bar(scene: &Scene, leg: &Leg, lang: Lang) -> Option<String> {
    // In the order of the scene, so that one line has one name: AB, never BA.
    let Some(Hold::Distance { near, far, strut }) = leg.hold() else { return None };
    let letters = format!("{}{}", scene.point_name(near.min(far)), scene.point_name(near.max(far)));
    match strut {
        Strut::Bar(link) => Some(say!(lang, "link {} ({letters})", scene.link_name(link))),
        Strut::Cylinder(_) => Some(say!(lang, "cylinder {letters}")),
        Strut::Ram { .. } => None,
    }
}

/// Returns the name of the line along which a guide holds: `the normal to the guide at C`.
fn normal(scene: &Scene, leg: &Leg, lang: Lang) -> String {
    let pin = leg.line().map_or("", |line| scene.point_name(line.pin()));
    say!(lang, "the normal to the guide at {pin}")
}

fn listed(all: &[String], lang: Lang) -> String {
    match (all, lang) {
        ([head @ .., last], Lang::En) if !head.is_empty() => {
            format!("{} and {last}", head.join(", "))
        }
        (all, _) => all.join("、"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_lines_meet_run_parallel_or_do_neither() {
        let line = |x: f64, y: f64, degrees: f64| {
            (Point::new(x, y), Vec2::from_angle(degrees.to_radians()))
        };
        // Through (1, 2): along x, along y, along x = y − 1.
        assert_eq!(
            meeting(&[line(0.0, 2.0, 0.0), line(1.0, 0.0, 90.0), line(0.0, 1.0, 45.0)], 1.0),
            Some(false)
        );
        assert_eq!(
            meeting(&[line(0.0, 2.0, 30.0), line(1.0, 0.0, 210.0), line(4.0, 1.0, 30.0)], 1.0),
            Some(true)
        );
        assert_eq!(
            meeting(&[line(0.0, 2.0, 0.0), line(1.0, 0.0, 90.0), line(0.0, 1.1, 45.0)], 1.0),
            None
        );
    }
    #[test]
    fn names_are_listed_as_each_language_lists_them() {
        let names = ["a", "b", "c"].map(str::to_owned);
        assert_eq!(
            [1, 2, 3].map(|n| listed(&names[..n], Lang::En)),
            ["a", "a and b", "a, b and c"]
        );
        assert_eq!([1, 2, 3].map(|n| listed(&names[..n], Lang::Zh)), ["a", "a、b", "a、b、c"]);
    }
}
