//! The reasons why an opened pair holds by itself, in words, and the messages about pairs that do
//! not.

use super::redundant::{Checked, RedundancyVerdict};
use super::{Configuration, Path};
use crate::mechanism::{Mechanism, Opened, PairItem, words_of};
use hodograph_base::diag::{Both, Diagnostic, Span, both};
use hodograph_base::digits::significant;
use hodograph_scene::{Cam, GuideDirection, GuideId, GuidePath, LinkId, PointId, RollingId, Scene};

/// The reason why a pair repeats others.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum RepeatReason {
    /// Cranks of the same length and direction join the same two bodies: two pins of each crank.
    ParallelCranks(Vec<(PointId, PointId)>),
    /// Another guide with the same direction joins the same two links.
    ParallelGuides(GuideId),
    /// Two pins that join the same two links coincide.
    CoaxialPins(PointId, PointId),
    /// The middle of a bar whose ends move along two lines through the crank's centre, with equal
    /// distances: the ends, the middle, the centre.
    SameCircle([PointId; 2], PointId, PointId),
    /// [`RepeatReason::SameCircle`] for the guide of one of the ends.
    SameLine([PointId; 2], PointId, PointId),
    /// Another link meshes with the same links from the same carrier: the name of that link.
    RepeatedPlanets(String),
    /// The link closes a rigid triangle with these two links, and repeats nothing.
    Triangle([LinkId; 2]),
    /// Another contact of the same cam and follower: both have one normal.
    OneNormal,
    /// None of these: the check finds that it holds in several positions.
    Found,
}

/// Returns the bodies at a pin of a link, without that link.
fn bodies(scene: &Scene, m: &Mechanism, p: PointId, without: LinkId) -> Vec<LinkId> {
    scene.carriers(p).filter(|l| *l != without && !m.is_passive(*l)).collect()
}

/// Returns the reason why a pair holds by itself: lengths that agree within the part `near` are
/// equal.
pub(super) fn reason(
    scene: &Scene,
    m: &Mechanism,
    opened: &Opened,
    at: &Configuration,
    near: f64,
) -> RepeatReason {
    let found = match opened {
        Opened::Link(l) => {
            let circle = || {
                same_circle(scene, *l, at, near)
                    .map(|(ends, b, d)| RepeatReason::SameCircle(ends, b, d))
            };
            parallel_cranks(scene, m, *l, at, near).or_else(circle)
        }
        Opened::Guide(g) => {
            let pin = scene.guides[g.0].pin;
            let cranks = (0..scene.links.len()).map(LinkId).filter(|l| *l != scene.ground);
            let mut circles = cranks
                .filter_map(|l| same_circle(scene, l, at, near))
                .filter(|(ends, _, _)| ends.iter().any(|p| Some(*p) == pin));
            let line = || circles.next().map(|(ends, b, d)| RepeatReason::SameLine(ends, b, d));
            let normal = || {
                contact_of(scene, *g).filter(|(_, all)| *all > 1).map(|_| RepeatReason::OneNormal)
            };
            normal()
                .or_else(|| parallel_guides(scene, *g, at, near).map(RepeatReason::ParallelGuides))
                .or_else(line)
        }
        Opened::Rolling(r) => repeated_planets(scene, *r, |_| true),
        Opened::Pin(p, l) => {
            let other = |q: &&PointId| {
                **q != *p
                    && at.points[q.0]
                        .zip(at.points[p.0])
                        .is_some_and(|(a, b)| a.distance(b) <= near * at.extent())
            };
            scene.links[l.0].points.iter().find(other).map(|q| RepeatReason::CoaxialPins(*p, *q))
        }
    };
    found.unwrap_or(RepeatReason::Found)
}

/// Returns the reason if it needs no lengths.
pub(super) fn by_topology(scene: &Scene, m: &Mechanism, opened: &Opened) -> Option<RepeatReason> {
    match opened {
        Opened::Rolling(r) => {
            // One of them stays closed, and is repeated.
            let opened = |l: LinkId| {
                m.redundant.iter().any(|o| matches!(o.opened, Opened::Rolling(p) if scene.rolling[p.0].links.contains(&l)))
            };
            repeated_planets(scene, *r, |l| !opened(l))
        }
        Opened::Link(l) => {
            let (a, b) = m.held(*l)?;
            let shares = |p: LinkId, q: LinkId| {
                scene.links[p.0].points.iter().any(|x| scene.links[q.0].points.contains(x))
            };
            let at_b = bodies(scene, m, b, *l);
            bodies(scene, m, a, *l).into_iter().find_map(|p| {
                at_b.iter()
                    .find(|q| **q != p && shares(p, **q))
                    .map(|q| RepeatReason::Triangle([p, *q]))
            })
        }
        Opened::Guide(g) => second_guide(scene, *g).map(RepeatReason::ParallelGuides),
        Opened::Pin(..) => None,
    }
}

/// Returns another guide of the same slider on the same link, in the same direction.
fn second_guide(scene: &Scene, g: GuideId) -> Option<GuideId> {
    let guide = &scene.guides[g.0];
    let told = |path: &GuidePath| match path {
        GuidePath::Line { direction: GuideDirection::Instant(angle), .. } => {
            Some(angle.value.radians())
        }
        GuidePath::Line {
            direction: GuideDirection::Along(..) | GuideDirection::Own | GuideDirection::Slid(_),
            ..
        }
        | GuidePath::Arc { .. } => None,
    };
    let own = told(&guide.path).filter(|_| guide.slider.is_some())?;
    let same = |other: &GuideId| {
        let o = &scene.guides[other.0];
        *other != g
            && o.slider == guide.slider
            && o.on == guide.on
            && told(&o.path).is_some_and(|a| libm::sin(a - own).abs() < 1e-9)
    };
    (0..scene.guides.len()).map(GuideId).find(same)
}

/// Returns the number of the contact of cam and follower that a guide represents, from 1, and the
/// number of contacts.
fn contact_of(scene: &Scene, g: GuideId) -> Option<(usize, usize)> {
    let own = scene.cams.iter().position(|c| c.contact == Some(g))?;
    let pair = |c: &Cam| (c.cam, c.follower);
    let mut same =
        (0..scene.cams.len()).filter(|k| pair(&scene.cams[*k]) == pair(&scene.cams[own]));
    Some((same.clone().position(|k| k == own)? + 1, same.by_ref().count()))
}

fn parallel_cranks(
    scene: &Scene,
    m: &Mechanism,
    l: LinkId,
    at: &Configuration,
    near: f64,
) -> Option<RepeatReason> {
    let (a, b) = m.held(l)?;
    let between = |p: PointId, q: PointId| Some(at.points[q.0]? - at.points[p.0]?);
    let own = between(a, b)?;
    let (at_a, at_b) = (bodies(scene, m, a, l), bodies(scene, m, b, l));
    let mut cranks = vec![(a, b)];
    for k in (0..scene.links.len()).map(LinkId).filter(|k| *k != l && *k != scene.ground) {
        let points = &scene.links[k.0].points;
        let joins =
            |p: PointId, to: &[LinkId]| bodies(scene, m, p, k).iter().any(|x| to.contains(x));
        let equal = |p: PointId, q: PointId| {
            p != q
                && joins(p, &at_a)
                && joins(q, &at_b)
                && between(p, q).is_some_and(|d| (d - own).norm() <= near * own.norm())
        };
        // Named in the order of its link.
        let pairs =
            points.iter().enumerate().flat_map(|(i, q)| points[..i].iter().map(move |p| (*p, *q)));
        cranks.extend(pairs.into_iter().find(|(p, q)| equal(*p, *q) || equal(*q, *p)));
    }
    (cranks.len() > 1).then_some(RepeatReason::ParallelCranks(cranks))
}

fn parallel_guides(scene: &Scene, g: GuideId, at: &Configuration, near: f64) -> Option<GuideId> {
    let guide = &scene.guides[g.0];
    // The link that runs in the guide: the slider, or a link that carries the pin.
    let runs = |i: GuideId| -> Vec<LinkId> {
        let guide = &scene.guides[i.0];
        guide
            .slider
            .into_iter()
            .chain(guide.pin.into_iter().flat_map(|p| scene.carriers(p)))
            .collect()
    };
    let direction = |i: GuideId| match at.guides[i.0]? {
        Path::Line { direction, .. } => Some(direction),
        Path::Arc { .. } => None,
    };
    let own = direction(g)?;
    let same = |i: &GuideId| {
        *i != g
            && scene.guides[i.0].on == guide.on
            && runs(*i).iter().any(|l| runs(g).contains(l))
            && direction(*i).is_some_and(|d| own.cross(d).abs() <= near)
    };
    (0..scene.guides.len()).map(GuideId).find(same)
}

/// AB = BC = BD: the crank D–B, a bar with B and two points that move along lines through D.
fn same_circle(
    scene: &Scene,
    l: LinkId,
    at: &Configuration,
    near: f64,
) -> Option<([PointId; 2], PointId, PointId)> {
    let [a, b] = scene.links[l.0].points[..] else { return None };
    [(a, b), (b, a)].into_iter().find_map(|(d, b)| {
        let (centre, middle) = (at.points[d.0]?, at.points[b.0]?);
        let radius = centre.distance(middle);
        let passes = |g: &GuideId| match at.guides[g.0] {
            Some(Path::Line { through, direction }) => {
                direction.cross(centre - through).abs() <= near * radius
            }
            Some(Path::Arc { .. }) | None => false,
        };
        let guides = (0..scene.guides.len()).map(GuideId).filter(passes);
        let ends: Vec<PointId> = guides
            .filter_map(|g| scene.guides[g.0].pin)
            .filter(|p| {
                at.points[p.0].is_some_and(|p| (p.distance(middle) - radius).abs() <= near * radius)
            })
            .filter(|p| scene.carriers(*p).any(|k| k != l && scene.links[k.0].points.contains(&b)))
            .collect();
        let [p, q] = ends[..] else { return None };
        Some(([p, q], b, d))
    })
}

/// Returns the planet that a rolling pair repeats: on the same carrier, rolling on the same links.
fn repeated_planets(
    scene: &Scene,
    r: RollingId,
    whole: impl Fn(LinkId) -> bool,
) -> Option<RepeatReason> {
    let partners = |l: LinkId| {
        let mut all: Vec<LinkId> = scene.rolling.iter().filter_map(|p| p.other(l)).collect();
        all.sort_unstable();
        all
    };
    let carriers = |l: LinkId| {
        let on = |p: &PointId| scene.carriers(*p).filter(|k| *k != l).collect::<Vec<_>>();
        let mut all: Vec<LinkId> = scene.links[l.0].points.iter().flat_map(on).collect();
        all.sort_unstable();
        all
    };
    let like = |l: LinkId| {
        let same = |k: &LinkId| {
            *k != l
                && partners(*k) == partners(l)
                && carriers(*k) == carriers(l)
                && partners(l).len() > 1
                && whole(*k)
        };
        (0..scene.links.len()).map(LinkId).find(same)
    };
    let planet =
        scene.rolling[r.0].links.into_iter().filter(|l| *l != scene.ground).find_map(like)?;
    Some(RepeatReason::RepeatedPlanets(scene.link_name(planet).to_owned()))
}

/// Returns the name of a line, as in the figures.
fn line(scene: &Scene, (a, b): (PointId, PointId)) -> String {
    format!("{}{}", scene.point_name(a), scene.point_name(b))
}

impl RepeatReason {
    /// Returns the reason in words.
    pub fn words(&self, scene: &Scene, positions: usize) -> Both {
        let name = |p: &PointId| scene.point_name(*p);
        match self {
            RepeatReason::ParallelCranks(cranks) => {
                // The pair's own crank is first in the list, and is named last.
                let others = cranks.iter().skip(1).chain(cranks.first());
                let names: Vec<Both> = others.map(|c| Both::same(line(scene, *c))).collect();
                both!("equal parallel cranks {}", Both::listed(&names))
            }
            RepeatReason::ParallelGuides(g) => {
                let on = scene.link_name(scene.guides[g.0].on);
                both!("parallel guides on link {on}")
            }
            RepeatReason::CoaxialPins(p, q) => {
                both!("coaxial pins {} and {}", name(p), name(q))
            }
            RepeatReason::SameCircle([p, q], b, d) | RepeatReason::SameLine([p, q], b, d) => {
                let of = |p: &PointId| line(scene, (*p, *b));
                let (first, second, radius) = (of(p), of(q), line(scene, (*b, *d)));
                match self {
                    RepeatReason::SameLine(..) => {
                        both!("its pin runs on that line anyway ({first} = {second} = {radius})")
                    }
                    RepeatReason::ParallelCranks(_)
                    | RepeatReason::ParallelGuides(_)
                    | RepeatReason::CoaxialPins(..)
                    | RepeatReason::SameCircle(..)
                    | RepeatReason::RepeatedPlanets(_)
                    | RepeatReason::Triangle(_)
                    | RepeatReason::OneNormal
                    | RepeatReason::Found => both!(
                        "{} runs on that circle anyway ({first} = {second} = {radius})",
                        name(b)
                    ),
                }
            }
            RepeatReason::RepeatedPlanets(like) => {
                both!("it repeats planet {like}")
            }
            RepeatReason::Triangle([a, b]) => {
                let [a, b] = [a, b].map(|l| scene.link_name(*l));
                both!("it makes a rigid triangle with links {a} and {b}")
            }
            RepeatReason::OneNormal => both!("two contacts on one normal"),
            RepeatReason::Found => {
                both!("it holds at {positions} positions")
            }
        }
    }
}

/// Returns the name of the opened item, and its span in the file.
pub fn opened_words(scene: &Scene, opened: &Opened) -> (Both, Span) {
    match opened {
        Opened::Link(l) => (both!("link {}", scene.link_name(*l)), scene.links[l.0].span),
        Opened::Guide(GuideId(g)) if scene.guides[*g].rolling.is_some() => {
            let guide = &scene.guides[*g];
            let (on, axle) =
                (scene.link_name(guide.on), guide.pin.map_or("", |p| scene.point_name(p)));
            let words = both!("the touching of the wheel about {axle} and link {on}");
            (words, guide.span)
        }
        Opened::Guide(g) if contact_of(scene, *g).is_some() => contact_words(scene, *g),
        Opened::Guide(g) => {
            let guide = &scene.guides[g.0];
            let (on, runner) = (
                scene.link_name(guide.on),
                guide.pin.map(|p| scene.point_name(p)).or(guide.slider.map(|s| scene.link_name(s))),
            );
            let runner = runner.unwrap_or_default();
            (both!("the guide of {runner} on link {on}"), guide.span)
        }
        Opened::Rolling(r) => (words_of(scene, PairItem::Rolling(*r)), scene.rolling[r.0].span),
        Opened::Pin(p, l) => (words_of(scene, PairItem::Pin(*p, *l)), scene.links[l.0].span),
    }
}

/// Returns the name of the cam contact that a guide represents, with its span.
fn contact_words(scene: &Scene, g: GuideId) -> (Both, Span) {
    let Some(cam) = scene.cams.iter().find(|c| c.contact == Some(g)) else {
        return (scene.guide_words(g), scene.guides[g.0].span);
    };
    let [own, follower] = [cam.cam, cam.follower].map(|l| scene.link_name(l));
    let words = match contact_of(scene, g) {
        Some((2, _)) => both!("the second contact of cam {own} and follower {follower}"),
        Some((1, 2..)) => both!("the first contact of cam {own} and follower {follower}"),
        Some(_) | None => scene.guide_words(g),
    };
    (words, cam.span)
}

/// Returns the amount by which the driver is moved, in words.
fn way_words(scene: &Scene, checked: &Checked) -> Option<Both> {
    let (driver, moved) = (checked.driver.filter(|_| checked.moved != 0.0)?, checked.moved);
    let turns = scene.drivers[driver].kind.turns();
    let (name, _) = scene.driver_name(driver);
    let by = if turns {
        format!("{}°", significant(moved.to_degrees(), 3))
    } else {
        scene.length_words(moved)
    };
    Some(both!("when the driver {name} changes by {by}"))
}

/// Returns given lengths that are nearly equal to that of an opened link.
fn suspects(scene: &Scene, m: &Mechanism, checked: &Checked) -> Vec<String> {
    let RepeatReason::ParallelCranks(cranks) = &checked.reason else {
        return match &checked.reason {
            RepeatReason::SameCircle([p, q], b, d) | RepeatReason::SameLine([p, q], b, d) => {
                [(*p, *b), (*q, *b), (*b, *d)].iter().map(|l| line(scene, *l)).collect()
            }
            RepeatReason::ParallelCranks(_)
            | RepeatReason::ParallelGuides(_)
            | RepeatReason::CoaxialPins(..)
            | RepeatReason::RepeatedPlanets(_)
            | RepeatReason::Triangle(_)
            | RepeatReason::OneNormal
            | RepeatReason::Found => match checked.opened {
                Opened::Link(l) => m.held(l).map(|pins| line(scene, pins)).into_iter().collect(),
                Opened::Guide(_) | Opened::Pin(..) | Opened::Rolling(_) => Vec::new(),
            },
        };
    };
    cranks.iter().map(|c| line(scene, *c)).collect()
}

/// Smallest error bound (m) that is reported: a bound from underflow alone has no meaning.
const SHOWN: f64 = 1e-30;

/// Returns the diagnostic about an opened pair.
pub(super) fn diagnostic(scene: &Scene, m: &Mechanism, checked: &Checked) -> Diagnostic {
    let opened = &checked.opened;
    let (what, span) = opened_words(scene, opened);
    let why = checked.reason.words(scene, checked.positions);
    let off = scene.length_words(checked.off_m);
    let when = way_words(scene, checked).unwrap_or_else(|| both!("in the pose itself"));
    let (positions, freedom) = (checked.positions, m.mobility.freedom);
    match checked.verdict {
        RedundancyVerdict::Virtual => {
            let bound = match checked.bound_m {
                _ if positions == 1 => {
                    both!("the driver could not be moved, so that only the pose shows it")
                }
                Some(bound) => both!(
                    "left open, it holds at {positions} positions to within {} m",
                    significant(bound.max(SHOWN), 1)
                ),
                None => both!(
                    "left open, it holds at {positions} positions as far as double precision can tell"
                ),
            };
            Diagnostic::note("virtual", both!("{} only repeats what the others fix: {}; {}", what, why, bound))
                .at(span)
        }
        RedundancyVerdict::Almost => Diagnostic::warning(
            "almost-virtual",
            both!(
                "{} nearly repeats what the others fix: left open, it is off by {off} {}; it is taken for a virtual constraint",
                what,
                when
            ),
        )
        .at(span)
        .help(match &suspects(scene, m, checked)[..] {
            [] => both!("give the numbers to more digits"),
            list => {
                let names: Vec<Both> = list.iter().map(Both::same).collect();
                both!(
                    "look at {}: as they are given the mechanism moves only by its play",
                    Both::listed(&names)
                )
            }
        }),
        RedundancyVerdict::Shaky => Diagnostic::error(
            "shaky",
            both!(
                "{} makes the mechanism shaky, mobility F = {freedom}: mobile to first order in this pose, it locks at a finite turn, off by {off} {}",
                what,
                when
            ),
        )
        .at(span)
        .help(help(scene, opened)),
        RedundancyVerdict::Locked => Diagnostic::error(
            "locked",
            both!(
                "{} locks the mechanism, mobility F = {freedom}: {} would have to give {off} {}",
                what,
                joint(scene, m, opened),
                when
            ),
        )
        .at(span)
        .help(help(scene, opened)),
    }
}

/// Returns the joint at which an opened pair gives way.
fn joint(scene: &Scene, m: &Mechanism, opened: &Opened) -> Both {
    let pin = |p: PointId| both!("joint {}", scene.point_name(p));
    match opened {
        Opened::Link(l) => m.held(*l).map_or_else(Both::default, |(a, b)| {
            // The pivot on ground does not move.
            pin(if scene.links[scene.ground.0].points.contains(&a) { b } else { a })
        }),
        Opened::Guide(g) => {
            scene.guides[g.0].pin.map_or_else(|| opened_words(scene, opened).0, pin)
        }
        Opened::Pin(p, _) => pin(*p),
        Opened::Rolling(r) => {
            scene.rolling[r.0].contact().map_or_else(|| opened_words(scene, opened).0, pin)
        }
    }
}

fn help(scene: &Scene, opened: &Opened) -> Both {
    match opened {
        Opened::Link(l) => both!(
            "leave link {0} out, let one end of it run in a slot, or make it equal and parallel to another link between the same two",
            scene.link_name(*l)
        ),
        Opened::Guide(g) if scene.guides[g.0].rolling.is_some() => both!(
            "let the axle of the wheel keep its distance from the track: correct a radius, the axle's place or the angle of the track, or free the axle"
        ),
        Opened::Guide(g) if contact_of(scene, *g).is_some() => {
            both!("make the two faces as far apart as the cam is broad, or leave one contact out")
        }
        Opened::Guide(_) => both!(
            "leave the guide out; of two guides of one slider the second is parallel to the first"
        ),
        Opened::Rolling(_) => {
            both!("leave the pair out, or give it the ratio that the others ask for")
        }
        Opened::Pin(p, _) => {
            both!("put {0} where the other pin is, or leave it out", scene.point_name(*p))
        }
    }
}
