//! Description in words of the links that hold each other in a singular block: those that the left
//! null vector loads.
//!
//! If the velocities of a block do not follow from its joints, the joints can carry forces without
//! an external load: along links in line, or from a bar into a guide that it meets at a right
//! angle. The description names the links and joints that these forces load.

use super::relation::{EquationPair, EquationRow};
use super::rows::UnknownLayout;
use super::singular::{FactoredBlock, Refusal, RefusalReason};
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::geom::Vec2;
use hodograph_mechanism::mechanism::mover_words;
use hodograph_mechanism::position::Configuration;
use hodograph_scene::{GuideId, LinkId, PointId, Scene};

/// The loaded part of a singular block.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct LoadedPart {
    /// The loaded links, including those that lead into the block if all are in one line.
    pub links: Vec<LinkId>,
    /// A joint between two of the links.
    pub joint: Option<PointId>,
    /// `link 1 (AB) and link 2 (BC) lie in line at B`.
    pub text: Both,
}

/// Loads smaller than this part of the largest are rounding (they are accurate to the square root
/// of the rounding of the lengths).
const LOADED: f64 = 1e-6;

/// Returns the links and joints that a block's left null vector loads.
pub(super) fn held(
    scene: &Scene,
    at: &Configuration,
    layout: &UnknownLayout,
    rows: &[EquationRow],
    part: &FactoredBlock,
) -> LoadedPart {
    let loads = part.factor.left();
    let loaded = |i: usize| loads[i].abs() > LOADED * loads.amax();
    let (mut pins, mut guides, mut drivers): (Vec<PointId>, Vec<GuideId>, Vec<usize>) =
        Default::default();
    for of in
        part.block.rows.iter().enumerate().filter(|(i, _)| loaded(*i)).map(|(_, r)| rows[*r].of)
    {
        match of {
            EquationPair::Pin(p) if !pins.contains(&p) => pins.push(p),
            EquationPair::Guide(g) if !guides.contains(&g) => guides.push(g),
            EquationPair::Driver(d) if !drivers.contains(&d) => drivers.push(d),
            EquationPair::Pin(_)
            | EquationPair::Guide(_)
            | EquationPair::Driver(_)
            | EquationPair::Rolling(_) => {}
        }
    }
    // A runner that is driven along its guide is held like a pin; any other runner is held square
    // to the guide.
    for d in &drivers {
        let kind = &scene.drivers[*d].kind;
        if let Some(guide) = kind.guide() {
            guides.retain(|g| *g != guide);
            pins.extend(scene.guides[guide.0].pin);
        }
        pins.extend(kind.ends().into_iter().flatten());
    }
    drivers.retain(|d| {
        scene.drivers[*d].kind.guide().is_none_or(|guide| scene.guides[guide.0].pin.is_none())
    });
    pins.extend(guides.iter().filter_map(|g| scene.guides[g.0].pin));
    pins.sort_unstable();
    pins.dedup();
    let block = links_of(layout, part);
    let on = |l: LinkId| -> Vec<PointId> {
        scene.links[l.0].points.iter().copied().filter(|p| pins.contains(p)).collect()
    };
    let mut links: Vec<LinkId> = block
        .iter()
        .copied()
        .filter(|l| {
            on(*l).len() > 1
                || guides
                    .iter()
                    .any(|g| scene.guides[g.0].on == *l || scene.guides[g.0].slider == Some(*l))
        })
        .collect();
    if links.is_empty() {
        links.clone_from(&block);
    }
    let joint = pins
        .iter()
        .copied()
        .find(|p| links.iter().filter(|l| scene.links[l.0].points.contains(p)).count() > 1)
        .or(pins.first().copied())
        .or(guides.iter().find_map(|g| scene.guides[g.0].pin));

    let places: Vec<_> = pins.iter().filter_map(|p| at.points[p.0]).collect();
    let turned = drivers.iter().any(|d| scene.drivers[*d].kind.turns());
    let in_line = guides.is_empty() && !turned && collinear(&places, at.extent());
    if in_line {
        // A link that leads into the block along the same line is included: the crank of a
        // parallelogram.
        let reaches = |l: LinkId| {
            let mine: Vec<_> =
                scene.links[l.0].points.iter().filter(|p| pins.contains(p)).collect();
            let all: Vec<_> = scene.links[l.0]
                .points
                .iter()
                .filter_map(|p| at.points[p.0])
                .chain(places.iter().copied())
                .collect();
            !mine.is_empty() && scene.links[l.0].points.len() == 2 && collinear(&all, at.extent())
        };
        links = (0..scene.links.len())
            .map(LinkId)
            .filter(|l| *l != scene.ground && (links.contains(l) || reaches(*l)))
            .collect();
    }
    // A bar is lettered by the joints at which it is loaded.
    let letters = |l: LinkId| {
        let of = if block.contains(&l) { on(l) } else { scene.links[l.0].points.clone() };
        match of[..] {
            [a, b] => both!(" ({}{})", scene.point_name(a), scene.point_name(b)),
            // A closing bracket ends the letters; a name alone is followed by a space.
            _ => Both { en: String::new(), zh: " ".to_owned() },
        }
    };
    let bars: Vec<Both> =
        links.iter().map(|l| both!("link {}{}", scene.link_name(*l), letters(*l))).collect();
    let guide = |g: &GuideId| match (scene.guides[g.0].pin, scene.guides[g.0].slider) {
        _ if scene.contact_words(*g).is_some() => {
            both!("the line of {}", scene.guide_words(*g))
        }
        (Some(p), _) => both!("the guide of {}", scene.point_name(p)),
        (None, Some(s)) => both!("the guide of link {}", scene.link_name(s)),
        (None, None) => both!("the guide"),
    };
    let at_joint = joint.map_or_else(Both::default, |p| both!(" at {}", scene.point_name(p)));
    let carries_guide = |l: LinkId| {
        guides.iter().any(|g| scene.guides[g.0].on == l || scene.guides[g.0].slider == Some(l))
    };
    let text = match (&guides[..], in_line) {
        (_, true) => {
            let cylinders = drivers.iter().map(|d| mover_words(scene, *d));
            let all: Vec<Both> = bars.into_iter().chain(cylinders).collect();
            match joint {
                Some(_) => both!(
                    "{} lie in line{}{}",
                    Both::listed(&all),
                    at_joint,
                    coincident(scene, at, &pins)
                ),
                None => both!("{} lie in line{}", Both::listed(&all), coincident(scene, at, &pins)),
            }
        }
        ([g], _) if bars.len() == 1 && on(links[0]).len() == 2 && !carries_guide(links[0]) => {
            both!("{} lies square to {}", bars[0], guide(g))
        }
        _ => {
            let cylinders = drivers.iter().map(|d| mover_words(scene, *d));
            let all: Vec<Both> =
                bars.into_iter().chain(guides.iter().map(guide)).chain(cylinders).collect();
            let verb = if all.len() == 1 { "leaves" } else { "leave" };
            let at_joint = joint.map_or_else(
                Both::default,
                |p| both!("at the joint" => " at {}", scene.point_name(p)),
            );
            both!(
                "{} {} one freedom open{}{}",
                Both::listed(&all),
                verb,
                at_joint,
                coincident(scene, at, &pins)
            )
        }
    };
    LoadedPart { links, joint, text }
}

fn collinear(places: &[hodograph_base::geom::Point], extent: f64) -> bool {
    let Some(first) = places.first() else { return false };
    let far = places
        .iter()
        .map(|p| *p - *first)
        .fold(Vec2::ZERO, |a, b| if b.norm2() > a.norm2() { b } else { a });
    far.norm() > 0.0
        && places.iter().all(|p| far.cross(*p - *first).abs() <= LOADED * far.norm() * extent)
}

fn coincident(scene: &Scene, at: &Configuration, pins: &[PointId]) -> Both {
    let close = |a: &PointId, b: &PointId| {
        at.points[a.0]
            .zip(at.points[b.0])
            .is_some_and(|(a, b)| a.distance(b) <= LOADED * at.extent())
    };
    for (i, a) in pins.iter().enumerate() {
        if let Some(b) = pins[i + 1..].iter().find(|b| close(a, b)) {
            return both!(" ({} and {} coincide)", scene.point_name(*a), scene.point_name(*b));
        }
    }
    Both::default()
}

/// Returns the links with unknowns in a block, in the order of the scene.
pub(super) fn links_of(layout: &UnknownLayout, part: &FactoredBlock) -> Vec<LinkId> {
    let mut links: Vec<LinkId> =
        part.block.unknowns.iter().filter_map(|u| layout.link_of(*u)).collect();
    links.sort_unstable();
    links.dedup();
    links
}

/// Returns the drivers that move, or are intended to move.
fn moving_drivers(scene: &Scene) -> Both {
    let moves = |d: &hodograph_scene::Driver| {
        d.rate.value != 0.0 || d.acceleration.as_ref().is_some_and(|a| a.value != 0.0)
    };
    let all: Vec<Both> = (0..scene.drivers.len())
        .filter(|d| moves(&scene.drivers[*d]))
        .map(|d| mover_words(scene, d))
        .collect();
    if all.is_empty() { both!("the driver") } else { Both::listed(&all) }
}

/// Returns the diagnostic about a part without a motion.
pub(super) fn refusal(
    scene: &Scene,
    layout: &UnknownLayout,
    part: &FactoredBlock,
    refused: &Refusal,
    held: &LoadedPart,
) -> Diagnostic {
    let drivers = moving_drivers(scene);
    let free = free_links(scene, layout, part);
    let text = &held.text;
    let d = match refused.why {
        RefusalReason::DeadPoint => Diagnostic::warning(
            "dead-centre",
            both!(
                "dead centre: {}, and {} cannot move them through this pose: the velocities of {} are unbounded",
                text,
                drivers,
                free
            ),
        )
        .help(both!(
            "drive another link, or choose a pose nearby; a machine is carried through by its flywheel"
        )),
        RefusalReason::Locked => Diagnostic::warning(
            "locked",
            both!(
                "{}: the links can be assembled in this pose, but {} cannot move on from it as asked",
                text,
                drivers
            ),
        )
        .help(both!(
            "choose another pose or other lengths; at the limit of its range a driver can only turn back"
        )),
        RefusalReason::Loose => Diagnostic::warning(
            "undetermined",
            both!(
                "{}: {} can move while the drivers stand, and nothing determines that motion",
                text,
                free
            ),
        )
        .help(both!(
            "choose another pose or other lengths: coincident joints leave a link free to turn"
        )),
        RefusalReason::Several => Diagnostic::warning(
            "singular",
            both!(
                "{}: more than one freedom is open in this pose, and which motion follows is not decided",
                text
            ),
        )
        .help(both!("choose another pose, or drive another link")),
        RefusalReason::NoAcceleration => Diagnostic::warning(
            "acceleration-undetermined",
            both!(
                "{}: the velocities are finite in this pose, but no finite accelerations of {} follow from them",
                text,
                free
            ),
        )
        .help(both!("ask for velocities only, or choose another pose")),
    };
    match held.joint {
        Some(p) => d.at(scene.points[p.0].span),
        None => d,
    }
}

/// Returns the links that the open freedom moves: `link 1 and link 2`.
fn free_links(scene: &Scene, layout: &UnknownLayout, part: &FactoredBlock) -> Both {
    let z = part.factor.right();
    let moved = |u: usize| z.as_ref().is_none_or(|z| z[u].abs() > LOADED * z.amax());
    let mut links: Vec<LinkId> = part
        .block
        .unknowns
        .iter()
        .enumerate()
        .filter(|(i, _)| moved(*i))
        .filter_map(|(_, u)| layout.link_of(*u))
        .collect();
    links.sort_unstable();
    links.dedup();
    let names: Vec<Both> = links.iter().map(|l| both!("link {}", scene.link_name(*l))).collect();
    if names.is_empty() { both!("the joints there") } else { Both::listed(&names) }
}

#[cfg(test)]
mod tests {
    use super::collinear;
    use hodograph_base::geom::Point;

    #[test]
    fn places_in_line_are_two_at_least() {
        let at = |all: &[(f64, f64)]| -> Vec<Point> {
            all.iter().map(|(x, y)| Point::new(*x, *y)).collect()
        };
        for (places, in_line) in [
            (vec![], false),
            (at(&[(1.0, 2.0)]), false),
            (at(&[(1.0, 2.0), (1.0, 2.0), (1.0, 2.0)]), false),
            (at(&[(1.0, 2.0), (4.0, 6.0)]), true),
            (at(&[(1.0, 2.0), (1.0, 2.0), (4.0, 6.0), (-2.0, -2.0)]), true),
            (at(&[(1.0, 2.0), (4.0, 6.0), (2.0, 2.0)]), false),
        ] {
            assert_eq!(collinear(&places, 5.0), in_line, "{places:?}");
        }
    }
}
