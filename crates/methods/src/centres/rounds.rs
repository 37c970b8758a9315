//! The order of finding: rounds of the Aronhold-Kennedy theorem over all pairs of links, without
//! numbers.
//!
//! For a missing P_ij, each third link k with known P_ik and P_kj gives a line. A bare pin in a
//! slot gives its normal, and links that never turn relative to one another give the line at
//! infinity. Two lines that do not coincide for topological reasons determine the centre. A round
//! uses the centres of earlier rounds. If a round finds nothing, one centre is taken from
//! velocities, and the rounds continue.

use hodograph_scene::{GuideId, LinkId, PointId, Scene};

use super::primary::{PairCentres, Primary, given};

/// Two different links, in the order in which their numbers are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct LinkPair {
    /// The first link.
    pub i: LinkId,
    /// The second link.
    pub j: LinkId,
}

impl LinkPair {
    /// Returns both names, with a comma between them if a link's name has more than one character:
    /// `24`, `2,10`.
    pub fn indices(&self, scene: &Scene) -> String {
        let (a, b) = (scene.link_name(self.i), scene.link_name(self.j));
        let comma = if scene.links.iter().all(|l| l.name.chars().count() == 1) { "" } else { "," };
        format!("{a}{comma}{b}")
    }

    /// Returns the name of the centre in plain text: `P24`.
    pub fn name(&self, scene: &Scene) -> String {
        format!("P{}", self.indices(scene))
    }

    /// True if one of the two is this link.
    pub fn has(&self, l: LinkId) -> bool {
        self.i == l || self.j == l
    }

    /// Returns the other link of the pair.
    pub fn other(&self, l: LinkId) -> LinkId {
        if self.i == l { self.j } else { self.i }
    }
}

/// A line on which a centre P_ij lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CentreLocus {
    /// The line P_ik P_kj through this link k.
    Through(LinkId),
    /// The normal of a slot at its bare pin.
    Normal(GuideId),
    /// The line at infinity, because neither link turns relative to the other.
    Infinity,
}

/// The way in which a centre is found.
#[derive(Clone, Debug, PartialEq)]
pub enum CentreMethod {
    /// By its pair.
    Primary(Primary),
    /// By crossing two of these lines.
    Lines(Vec<CentreLocus>),
    /// From velocities, because the theorem stalls.
    Velocities,
}

/// The step that finds one centre.
#[derive(Clone, Debug, PartialEq)]
pub struct CentreStep {
    /// The two links of the centre.
    pub pair: LinkPair,
    /// The round: 0 for primary centres.
    pub round: usize,
    /// The way in which the centre is found.
    pub how: CentreMethod,
    /// True if the centre is at infinity in every pose.
    pub infinite: bool,
    /// True if the centre holds only for the given rates of several drivers.
    pub given_drivers: bool,
}

/// The order of finding of a mechanism.
#[derive(Clone, Debug, PartialEq)]
pub struct CentreClosure {
    /// All links in the order of their numbers.
    pub links: Vec<LinkId>,
    /// All centres, in the order of finding.
    pub steps: Vec<CentreStep>,
    /// The number of primary centres.
    pub primary: usize,
    /// The number of centres that are known before one is taken from velocities: the primary ones
    /// and those that the theorem finds alone.
    pub alone: usize,
    /// Degrees of freedom.
    pub freedoms: usize,
}

impl CentreClosure {
    /// Returns the pair of two different links.
    pub fn pair(&self, a: LinkId, b: LinkId) -> LinkPair {
        let rank = |l: LinkId| self.links.iter().position(|k| *k == l);
        if rank(a) <= rank(b) { LinkPair { i: a, j: b } } else { LinkPair { i: b, j: a } }
    }

    /// Returns the number of centres that the theorem finds and of those from velocities; with the
    /// primary ones they are all.
    pub fn found_by(&self) -> [usize; 2] {
        let taken = self.steps.iter().filter(|s| s.how == CentreMethod::Velocities).count();
        [self.steps.len() - self.primary - taken, taken]
    }

    /// True if the theorem stalls on a mechanism of one degree of freedom.
    pub fn stalled(&self) -> bool {
        self.freedoms == 1 && self.alone < self.steps.len()
    }
}

/// Returns the order of finding; `freedoms` is the number of drivers.
pub(super) fn closure(scene: &Scene, freedoms: usize) -> CentreClosure {
    let given = given(scene);
    let links = scene.links_in_order();
    let n = scene.links.len();
    let mut open = OpenClosure { given: &given, links: &links, known: vec![None; n * n], n };
    let mut steps = Vec::new();
    let pairs: Vec<LinkPair> = links
        .iter()
        .enumerate()
        .flat_map(|(k, i)| links[k + 1..].iter().map(|j| LinkPair { i: *i, j: *j }))
        .collect();
    for pair in &pairs {
        let there = given.primary.iter().find(|(a, b, _)| pair.has(*a) && pair.has(*b));
        if let Some((_, _, primary)) = there {
            steps.push(open.step(*pair, 0, CentreMethod::Primary(*primary), false));
        }
    }
    steps.iter().for_each(|s: &CentreStep| open.take(s));
    let primary = steps.len();
    let mut alone = None;
    for round in 1.. {
        let found: Vec<CentreStep> = pairs
            .iter()
            .filter(|pair| open.of(pair.i, pair.j).is_none())
            .filter_map(|pair| {
                Some(open.step(
                    *pair,
                    round,
                    CentreMethod::Lines(open.lines(*pair)?),
                    alone.is_some() && freedoms > 1,
                ))
            })
            .collect();
        let found = if found.is_empty() {
            alone.get_or_insert(steps.len());
            // Any missing centre serves: the first absolute one, otherwise the first.
            let missing = || pairs.iter().filter(|pair| open.of(pair.i, pair.j).is_none());
            let Some(pair) =
                missing().find(|pair| pair.has(scene.ground)).or_else(|| missing().next())
            else {
                break;
            };
            vec![open.step(*pair, round, CentreMethod::Velocities, freedoms > 1)]
        } else {
            found
        };
        found.iter().for_each(|s| open.take(s));
        steps.extend(found);
    }
    CentreClosure { alone: alone.unwrap_or(steps.len()), links, steps, primary, freedoms }
}

/// A known centre, as far as topology distinguishes it from others.
#[derive(Clone, Copy, PartialEq, Eq)]
enum KnownCentre {
    /// At a joint.
    Joint(PointId),
    /// At infinity.
    Infinite,
    /// At an unspecified place.
    Somewhere,
}

/// The closure under construction.
struct OpenClosure<'a> {
    given: &'a PairCentres,
    links: &'a [LinkId],
    known: Vec<Option<KnownCentre>>,
    n: usize,
}

impl OpenClosure<'_> {
    fn of(&self, a: LinkId, b: LinkId) -> Option<KnownCentre> {
        self.known[a.0 * self.n + b.0]
    }

    fn step(
        &self,
        pair: LinkPair,
        round: usize,
        how: CentreMethod,
        given_drivers: bool,
    ) -> CentreStep {
        CentreStep {
            pair,
            round,
            how,
            infinite: self.given.translate(pair.i, pair.j),
            given_drivers,
        }
    }

    fn take(&mut self, step: &CentreStep) {
        let LinkPair { i, j } = step.pair;
        let known = match step.how {
            CentreMethod::Primary(Primary::Pin(p)) => KnownCentre::Joint(p),
            _ if step.infinite => KnownCentre::Infinite,
            CentreMethod::Primary(_) | CentreMethod::Lines(_) | CentreMethod::Velocities => {
                KnownCentre::Somewhere
            }
        };
        self.known[i.0 * self.n + j.0] = Some(known);
        self.known[j.0 * self.n + i.0] = Some(known);
    }

    /// Returns all lines on which a missing centre lies; `None` if fewer than two are different.
    fn lines(&self, pair: LinkPair) -> Option<Vec<CentreLocus>> {
        let LinkPair { i, j } = pair;
        let mut lines = Vec::new();
        // Lines that coincide for topological reasons count once: lines through a common joint.
        let mut through: Vec<[KnownCentre; 2]> = Vec::new();
        let mut different = 0;
        if self.given.translate(i, j) {
            lines.push(CentreLocus::Infinity);
            different += 1;
        }
        let mut pins = Vec::new();
        for normal in
            self.given.normals.iter().filter(|n| pair.has(n.pin_of) && pair.has(n.slot_of))
        {
            lines.push(CentreLocus::Normal(normal.guide));
            pins.push(KnownCentre::Joint(normal.pin));
            different += 1;
        }
        for k in self.links.iter().copied().filter(|k| !pair.has(*k)) {
            let (Some(a), Some(b)) = (self.of(i, k), self.of(k, j)) else { continue };
            if a == KnownCentre::Infinite && b == KnownCentre::Infinite {
                // In this case i and j do not turn relative to one another either: the line at
                // infinity is already in the list.
                continue;
            }
            let joint =
                |x: KnownCentre, y: KnownCentre| matches!(x, KnownCentre::Joint(_)) && x == y;
            if joint(a, b) {
                continue;
            }
            lines.push(CentreLocus::Through(k));
            // Only one line, the normal, goes through the pin of a slot, independent of the link on
            // the pin.
            let normal = pins.iter().any(|pin| joint(a, *pin) || joint(b, *pin));
            if !normal && !through.iter().any(|[c, d]| joint(a, *c) || joint(b, *d)) {
                different += 1;
            }
            through.push([a, b]);
        }
        (different >= 2).then_some(lines)
    }
}
