//! The order of finding: rounds of the Aronhold-Kennedy theorem over all pairs of links. No number takes part.
//!
//! For a missing P_ij each third link k whose P_ik and P_kj are there gives a line; a bare pin in a slot gives its normal, and links that
//! never turn against one another give the line at infinity. Two lines that are not one for topological reasons find the centre. A round
//! uses what earlier rounds found. Where a round finds nothing, one centre is taken from velocities, and the rounds go on.

use hodograph_scene::{GuideId, LinkId, PointId, Scene};

use super::primary::{Given, Primary, given};

/// Two different links, in the order in which their numbers are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Pair {
    /// The first.
    pub i: LinkId,
    /// The second.
    pub j: LinkId,
}

impl Pair {
    /// Both names, with a comma between those that could be read otherwise: `24`, `2,10`.
    pub fn indices(&self, scene: &Scene) -> String {
        let (a, b) = (scene.link_name(self.i), scene.link_name(self.j));
        let comma = if scene.links.iter().all(|l| l.name.chars().count() == 1) { "" } else { "," };
        format!("{a}{comma}{b}")
    }

    /// The name of their centre in plain text: `P24`.
    pub fn name(&self, scene: &Scene) -> String {
        format!("P{}", self.indices(scene))
    }

    /// Whether one of them is this link.
    pub fn has(&self, l: LinkId) -> bool {
        self.i == l || self.j == l
    }

    /// The other of the two.
    pub fn other(&self, l: LinkId) -> LinkId {
        if self.i == l { self.j } else { self.i }
    }
}

/// A line on which a centre P_ij lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Line {
    /// P_ik P_kj, through this link k.
    Through(LinkId),
    /// The normal of a slot at its bare pin.
    Normal(GuideId),
    /// The line at infinity, as neither turns against the other.
    Infinity,
}

/// How a centre is found.
#[derive(Clone, Debug, PartialEq)]
pub enum How {
    /// By its pair.
    Primary(Primary),
    /// Where two of these lines cross.
    Lines(Vec<Line>),
    /// From velocities, as the theorem stalls.
    Velocities,
}

/// The finding of one centre.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Whose centre.
    pub pair: Pair,
    /// The round: 0 for primary centres.
    pub round: usize,
    /// How.
    pub how: How,
    /// Whether it is at infinity in every pose.
    pub infinite: bool,
    /// Whether it holds only for the given rates of several drivers.
    pub given_drivers: bool,
}

/// The order of finding of a mechanism.
#[derive(Clone, Debug, PartialEq)]
pub struct Closure {
    /// All links in the order of their numbers.
    pub links: Vec<LinkId>,
    /// All centres, in the order of finding.
    pub steps: Vec<Step>,
    /// How many of them are primary.
    pub primary: usize,
    /// How many the theorem finds alone, the primary ones included.
    pub by_theorem: usize,
    /// Degrees of freedom.
    pub freedoms: usize,
}

impl Closure {
    /// The pair of two different links.
    pub fn pair(&self, a: LinkId, b: LinkId) -> Pair {
        let rank = |l: LinkId| self.links.iter().position(|k| *k == l);
        if rank(a) <= rank(b) { Pair { i: a, j: b } } else { Pair { i: b, j: a } }
    }

    /// Whether the theorem stalls on a mechanism of one freedom.
    pub fn stalled(&self) -> bool {
        self.freedoms == 1 && self.by_theorem < self.steps.len()
    }
}

/// The order of finding; `freedoms` is the number of drivers.
pub(super) fn closure(scene: &Scene, freedoms: usize) -> Closure {
    let given = given(scene);
    let links = scene.links_in_order();
    let n = scene.links.len();
    let mut open = Open { given: &given, links: &links, known: vec![None; n * n], n };
    let mut steps = Vec::new();
    let pairs: Vec<Pair> = links.iter().enumerate().flat_map(|(k, i)| links[k + 1..].iter().map(|j| Pair { i: *i, j: *j })).collect();
    for pair in &pairs {
        let there = given.primary.iter().find(|(a, b, _)| pair.has(*a) && pair.has(*b));
        if let Some((_, _, primary)) = there {
            steps.push(open.step(*pair, 0, How::Primary(*primary), false));
        }
    }
    steps.iter().for_each(|s: &Step| open.take(s));
    let primary = steps.len();
    let mut by_theorem = None;
    for round in 1.. {
        let found: Vec<Step> = pairs
            .iter()
            .filter(|pair| open.of(pair.i, pair.j).is_none())
            .filter_map(|pair| Some(open.step(*pair, round, How::Lines(open.lines(*pair)?), by_theorem.is_some() && freedoms > 1)))
            .collect();
        let found = if found.is_empty() {
            by_theorem.get_or_insert(steps.len());
            // The first absolute one, else the first: any one will do.
            let missing = || pairs.iter().filter(|pair| open.of(pair.i, pair.j).is_none());
            let Some(pair) = missing().find(|pair| pair.has(scene.ground)).or_else(|| missing().next()) else { break };
            vec![open.step(*pair, round, How::Velocities, freedoms > 1)]
        } else {
            found
        };
        found.iter().for_each(|s| open.take(s));
        steps.extend(found);
    }
    Closure { by_theorem: by_theorem.unwrap_or(steps.len()), links, steps, primary, freedoms }
}

/// A centre that is there, as far as topology tells it from others.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Known {
    /// At a joint.
    Joint(PointId),
    /// At infinity.
    Infinite,
    /// Anywhere.
    Somewhere,
}

/// The closure in the making.
struct Open<'a> {
    given: &'a Given,
    links: &'a [LinkId],
    known: Vec<Option<Known>>,
    n: usize,
}

impl Open<'_> {
    fn of(&self, a: LinkId, b: LinkId) -> Option<Known> {
        self.known[a.0 * self.n + b.0]
    }

    fn step(&self, pair: Pair, round: usize, how: How, given_drivers: bool) -> Step {
        Step { pair, round, how, infinite: self.given.translate(pair.i, pair.j), given_drivers }
    }

    fn take(&mut self, step: &Step) {
        let Pair { i, j } = step.pair;
        let known = match step.how {
            How::Primary(Primary::Pin(p)) => Known::Joint(p),
            _ if step.infinite => Known::Infinite,
            How::Primary(_) | How::Lines(_) | How::Velocities => Known::Somewhere,
        };
        self.known[i.0 * self.n + j.0] = Some(known);
        self.known[j.0 * self.n + i.0] = Some(known);
    }

    /// All lines on which a missing centre lies; `None` where they are fewer than two.
    fn lines(&self, pair: Pair) -> Option<Vec<Line>> {
        let Pair { i, j } = pair;
        let mut lines = Vec::new();
        // Lines that are one for topological reasons count once: through a joint that both have, or both at infinity.
        let mut through: Vec<[Known; 2]> = Vec::new();
        let mut different = 0;
        if self.given.translate(i, j) {
            lines.push(Line::Infinity);
            different += 1;
        }
        let mut pins = Vec::new();
        for normal in self.given.normals.iter().filter(|n| pair.has(n.pin_of) && pair.has(n.slot_of)) {
            lines.push(Line::Normal(normal.guide));
            pins.push(Known::Joint(normal.pin));
            different += 1;
        }
        for k in self.links.iter().copied().filter(|k| !pair.has(*k)) {
            let (Some(a), Some(b)) = (self.of(i, k), self.of(k, j)) else { continue };
            if a == Known::Infinite && b == Known::Infinite {
                // Then i and j do not turn against one another either: that line is there.
                continue;
            }
            let joint = |x: Known, y: Known| matches!(x, Known::Joint(_)) && x == y;
            if joint(a, b) {
                continue;
            }
            lines.push(Line::Through(k));
            // Through the pin of a slot there is one line, the normal, whichever of the links on the pin is taken.
            let normal = pins.iter().any(|pin| joint(a, *pin) || joint(b, *pin));
            if !normal && !through.iter().any(|[c, d]| joint(a, *c) || joint(b, *d)) {
                different += 1;
            }
            through.push([a, b]);
        }
        (different >= 2).then_some(lines)
    }
}
