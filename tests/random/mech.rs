//! Random mechanisms, grown group by group.
//!
//! The pose comes first: every point gets a random place, and lengths, guides and driver values are
//! read off it. Separate random streams decide topology and places, so that one topology can have
//! many geometries. Groups with poor intersections of unknown directions get other places.

use crate::rng::Rng;
use hodograph::geom::{Point, Vec2};

/// Below this sine (dyad's intersection; triad's normalised determinant) a group is redrawn.
const GOOD_ANGLE: f64 = 0.25;
const SHORTEST: f64 = 0.2;

#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A straight guide, with its direction in the plane.
    Line(Vec2),
    /// From the pivot `0` toward the pin: the link is known by pivot and slot only.
    Own(usize),
    /// About a point of the carrier.
    Arc(usize),
}

#[derive(Clone, Debug, PartialEq)]
pub struct Guide {
    pub pin: Option<usize>,
    pub slider: Option<usize>,
    pub on: usize,
    pub shape: Shape,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Drive {
    Turn { link: usize, against: usize },
    Slide { guide: usize },
    Cylinder { a: usize, b: usize, links: Vec<usize> },
}

#[derive(Clone, Debug, PartialEq)]
pub struct Driver {
    pub kind: Drive,
    pub rate: f64,
    pub acceleration: Option<f64>,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Link {
    pub points: Vec<usize>,
    /// True if it takes no further points: a block, a lever with pivot and slot, a cylinder part.
    pub closed: bool,
    /// True if it is named in `links` (a block with one pin need not be).
    pub listed: bool,
    /// True if only coordinates place it: it translates and has more than one point.
    pub by_coordinates: bool,
    /// True for cylinder parts, which have no place of their own to carry anything.
    pub follower: bool,
}

/// A mechanism in its pose. Link 0 is ground.
#[derive(Clone, Debug)]
pub struct Mech {
    pub points: Vec<Point>,
    pub links: Vec<Link>,
    pub guides: Vec<Guide>,
    pub drivers: Vec<Driver>,
    /// True if lengths and driver values cannot give its pose: coordinates are needed.
    pub coordinates_only: bool,
    /// Groups grown, by name.
    pub groups: Vec<&'static str>,
}

/// The way in which a leg holds its group, for the quality of the pose.
#[derive(Clone, Copy)]
enum Force {
    /// Along the line of two points.
    Bar(usize, usize),
    /// Perpendicular to a guide, at its pin.
    Normal(usize),
}

enum Check {
    None,
    /// Two forces on a pin, or on a link that keeps its direction.
    Two(Force, Force),
    /// A force on a link about a pivot.
    About(usize, Force),
    Three([Force; 3]),
}

pub struct Grower {
    pub m: Mech,
    topology: Rng,
    geometry: Rng,
    /// Range of links that are known and can carry more.
    fresh: (usize, usize),
}

/// The kinds of group that may be grown, each with its share.
pub const KINDS: &[(&str, f64)] = &[
    ("crank", 0.4),
    ("rrr", 2.0),
    ("rrp", 2.0),
    ("rpr", 2.0),
    ("prp", 1.0),
    ("rpp", 1.5),
    ("triad", 2.0),
    ("slide", 0.4),
    ("cylinder", 0.5),
    ("ram", 0.5),
    ("glide", 0.4),
];

/// A mechanism of `groups` groups; `None` where no good geometry was found.
pub fn grow(topology: u64, geometry: u64, groups: usize) -> Option<Mech> {
    for attempt in 0..20 {
        let m = Mech {
            points: vec![],
            links: vec![Link { listed: true, ..Link::default() }],
            guides: vec![],
            drivers: vec![],
            coordinates_only: false,
            groups: vec![],
        };
        let mut g = Grower {
            m,
            topology: Rng::new(topology),
            geometry: Rng::new(geometry ^ (attempt << 48) ^ 0xabcdef),
            fresh: (0, 0),
        };
        if g.all(groups) {
            return Some(g.m);
        }
    }
    None
}

impl Grower {
    fn all(&mut self, groups: usize) -> bool {
        let first =
            self.topology.pick(&["crank", "crank", "crank", "slide", "cylinder", "ram", "glide"]);
        if !self.group(first) {
            return false;
        }
        for _ in 1..groups {
            let total: f64 = KINDS.iter().map(|k| k.1).sum();
            let mut at = self.topology.between(0.0, total);
            let kind = KINDS.iter().find(|k| {
                at -= k.1;
                at < 0.0
            });
            if !self.group(kind.unwrap_or(&KINDS[1]).0) {
                return false;
            }
        }
        // A driver names its pin; if that runs in several guides, a block identifies one.
        for d in self.m.drivers.clone() {
            let Drive::Slide { guide } = d.kind else { continue };
            if let (Some(pin), None) = (self.m.guides[guide].pin, self.m.guides[guide].slider)
                && self.m.guides.iter().filter(|g| g.pin == Some(pin)).count() > 1
            {
                self.m.guides[guide].slider = Some(self.block(pin));
            }
        }
        true
    }

    /// Grows the topology of a group, then draws its places until they are good.
    fn group(&mut self, kind: &'static str) -> bool {
        self.fresh = (self.m.points.len(), self.m.guides.len());
        let drivers = self.m.drivers.len();
        let check = match kind {
            "crank" => self.crank(),
            "rrr" => self.rrr(),
            "rrp" => self.rrp(),
            "rpr" => self.rpr(),
            "prp" => self.prp(),
            "rpp" => self.rpp(),
            "triad" => self.triad(),
            "slide" => self.slide(),
            "cylinder" => self.cylinder(),
            "ram" => self.ram(),
            _ => self.glide(),
        };
        self.m.groups.push(kind);
        // Topology decides which drivers are accelerated, not by how much.
        for d in &mut self.m.drivers[drivers..] {
            d.rate = self.geometry.between(0.5, 2.0) * self.geometry.pick(&[-1.0, 1.0]);
            d.acceleration = d.acceleration.map(|_| self.geometry.between(-2.0, 2.0));
        }
        (0..400).any(|_| {
            self.place();
            self.good(&check)
        })
    }

    fn place(&mut self) {
        let (points, guides) = self.fresh;
        let spread = 1.0 + 0.15 * self.m.groups.len() as f64;
        for p in points..self.m.points.len() {
            self.m.points[p] = Point::new(
                self.geometry.between(-spread, spread),
                self.geometry.between(-spread, spread),
            );
        }
        for g in guides..self.m.guides.len() {
            if let Shape::Line(d) = &mut self.m.guides[g].shape {
                *d = Vec2::from_angle(self.geometry.between(-3.1, 3.1));
            }
        }
    }

    fn normal(&self, g: usize) -> Vec2 {
        let pin = |g: &Guide| self.m.points[g.pin.unwrap_or(0)];
        let guide = &self.m.guides[g];
        match guide.shape {
            Shape::Line(d) => d.perp(),
            Shape::Own(p) => (pin(guide) - self.m.points[p]).perp(),
            Shape::Arc(c) => pin(guide) - self.m.points[c],
        }
    }

    fn force(&self, f: Force) -> (Point, Vec2) {
        let (p, d) = match f {
            Force::Bar(a, b) => (self.m.points[a], self.m.points[a] - self.m.points[b]),
            Force::Normal(g) => {
                (self.m.guides[g].pin.map_or(Point::ORIGIN, |p| self.m.points[p]), self.normal(g))
            }
        };
        (p, d.unit().unwrap_or(Vec2::ZERO))
    }

    fn good(&self, check: &Check) -> bool {
        let far = |a: usize, b: usize| self.m.points[a].distance(self.m.points[b]) > SHORTEST;
        for link in &self.m.links {
            for (i, &a) in link.points.iter().enumerate() {
                if link.points[i + 1..].iter().any(|&b| b >= self.fresh.0 && !far(a, b)) {
                    return false;
                }
            }
            // Further points are placed by lengths from the first two: not in line with them.
            if let [a, b, rest @ ..] = &link.points[..]
                && rest.iter().any(|&c| {
                    c >= self.fresh.0 && {
                        let (a, b, c) = (self.m.points[*a], self.m.points[*b], self.m.points[c]);
                        ((b - a).cross(c - a) / ((b - a).norm() * (c - a).norm())).abs() < 0.1
                    }
                })
            {
                return false;
            }
        }
        for g in &self.m.guides[self.fresh.1..] {
            if let (Shape::Arc(c) | Shape::Own(c), Some(p)) = (&g.shape, g.pin)
                && !far(*c, p)
            {
                return false;
            }
        }
        for d in &self.m.drivers {
            if let Drive::Cylinder { a, b, .. } = d.kind
                && !far(a, b)
            {
                return false;
            }
        }
        match *check {
            Check::None => true,
            Check::Two(a, b) => self.force(a).1.cross(self.force(b).1).abs() > GOOD_ANGLE,
            Check::About(pivot, f) => {
                let (at, d) = self.force(f);
                let arm = at - self.m.points[pivot];
                arm.norm() > SHORTEST && (arm * (1.0 / arm.norm())).cross(d).abs() > GOOD_ANGLE
            }
            Check::Three(fs) => {
                let all = fs.map(|f| self.force(f));
                let c = all.iter().fold(Vec2::ZERO, |s, f| s + f.0.to_vec2() * (1.0 / 3.0));
                let size = all.iter().map(|f| (f.0.to_vec2() - c).norm()).fold(0.0, f64::max);
                let row = all.map(|(p, d)| (d.x, d.y, (p.to_vec2() - c).cross(d) / size));
                let det = row[0].0 * (row[1].1 * row[2].2 - row[1].2 * row[2].1)
                    - row[0].1 * (row[1].0 * row[2].2 - row[1].2 * row[2].0)
                    + row[0].2 * (row[1].0 * row[2].1 - row[1].1 * row[2].0);
                size > SHORTEST && det.abs() > GOOD_ANGLE
            }
        }
    }

    // Parts of the topology.

    fn new_point(&mut self, on: &[usize]) -> usize {
        self.m.points.push(Point::ORIGIN);
        let p = self.m.points.len() - 1;
        for l in on {
            self.m.links[*l].points.push(p);
        }
        p
    }

    fn new_link(&mut self, points: &[usize]) -> usize {
        self.m.links.push(Link { points: points.to_vec(), listed: true, ..Link::default() });
        self.m.links.len() - 1
    }

    /// A known link that may carry points or guides.
    fn known_link(&mut self, not: &[usize]) -> usize {
        if self.topology.chance(0.35) && !not.contains(&0) {
            return 0;
        }
        let open: Vec<usize> =
            (0..self.known()).filter(|l| !self.m.links[*l].closed && !not.contains(l)).collect();
        if open.is_empty() { 0 } else { self.topology.pick(&open) }
    }

    fn known(&self) -> usize {
        // Links of the current group are not known; the caller excludes them through `not`.
        self.m.links.len()
    }

    /// A known point: an existing one, or a new one on a known link.
    fn site(&mut self, not: &[usize]) -> usize {
        let old = self.fresh.0;
        let on_no = |m: &Mech, p: usize| not.iter().all(|l| !m.links[*l].points.contains(&p));
        if old > 0 && self.topology.chance(0.55) {
            let p = self.topology.below(old);
            if on_no(&self.m, p) {
                return p;
            }
        }
        let l = self.known_link(not);
        self.new_point(&[l])
    }

    fn add_guide(
        &mut self,
        pin: Option<usize>,
        slider: Option<usize>,
        on: usize,
        shape: Shape,
    ) -> usize {
        self.m.guides.push(Guide { pin, slider, on, shape });
        self.m.guides.len() - 1
    }

    /// A guide for `pin` on a known link, straight or curved, perhaps with a numbered block.
    fn guide_for(&mut self, pin: usize, not: &[usize]) -> usize {
        let mut not = not.to_vec();
        not.extend((0..self.m.links.len()).filter(|l| self.m.links[*l].points.contains(&pin)));
        let on = self.known_link(&not);
        self.guide_on(pin, on)
    }

    fn guide_on(&mut self, pin: usize, on: usize) -> usize {
        let shape = if self.topology.chance(0.3) {
            Shape::Arc(self.new_point(&[on]))
        } else {
            Shape::Line(Vec2::ZERO)
        };
        self.guide_shaped(pin, on, shape)
    }

    fn guide_shaped(&mut self, pin: usize, on: usize, shape: Shape) -> usize {
        let slider = self.topology.chance(0.5).then(|| self.block(pin));
        self.add_guide(Some(pin), slider, on, shape)
    }

    fn block(&mut self, pin: usize) -> usize {
        let l = self.new_link(&[pin]);
        self.m.links[l].closed = true;
        self.m.links[l].listed = self.topology.chance(0.5);
        l
    }

    fn drive(&mut self, kind: Drive) {
        let acceleration = self.topology.chance(0.5).then_some(1.0);
        self.m.drivers.push(Driver { kind, rate: 1.0, acceleration });
    }

    fn tracers(&mut self, link: usize) {
        for _ in 0..self.topology.below(3) {
            self.new_point(&[link]);
        }
    }

    // The groups.

    fn crank(&mut self) -> Check {
        let p = self.site(&[]);
        let against = if self.topology.chance(0.5) { 0 } else { self.known_link(&[]) };
        let against = if self.m.links[against].points.len() < 2 { 0 } else { against };
        let q = self.new_point(&[]);
        let link = self.new_link(&[p, q]);
        self.tracers(link);
        self.drive(Drive::Turn { link, against });
        Check::None
    }

    fn bar(&mut self, near: usize, far: usize) -> usize {
        let points = if self.topology.chance(0.5) { [near, far] } else { [far, near] };
        let l = self.new_link(&points);
        self.tracers(l);
        l
    }

    /// Two different known points.
    fn sites(&mut self) -> (usize, usize) {
        let a = self.site(&[]);
        loop {
            let b = self.site(&[]);
            if a != b {
                return (a, b);
            }
        }
    }

    fn rrr(&mut self) -> Check {
        let (a, b) = self.sites();
        let c = self.new_point(&[]);
        self.bar(c, a);
        self.bar(c, b);
        Check::Two(Force::Bar(c, a), Force::Bar(c, b))
    }

    fn rrp(&mut self) -> Check {
        let a = self.site(&[]);
        let c = self.new_point(&[]);
        let fat = self.topology.chance(0.25);
        let g = if fat {
            // The slider has further points: a link that keeps its direction.
            let on = self.known_link(&[]);
            let x = self.new_link(&[c]);
            self.new_point(&[x]);
            self.tracers(x);
            self.m.links[x].by_coordinates = true;
            self.add_guide(Some(c), Some(x), on, Shape::Line(Vec2::ZERO))
        } else {
            self.guide_for(c, &[])
        };
        self.bar(c, a);
        Check::Two(Force::Bar(c, a), Force::Normal(g))
    }

    fn rpr(&mut self) -> Check {
        let (a, b) = self.sites();
        let x = self.new_link(&[a]);
        let shape = match self.topology.below(3) {
            0 => {
                self.m.links[x].closed = true;
                Shape::Own(a)
            }
            1 => Shape::Arc(self.new_point(&[x])),
            _ => {
                self.new_point(&[x]);
                self.tracers(x);
                Shape::Line(Vec2::ZERO)
            }
        };
        let g = self.guide_shaped(b, x, shape);
        Check::About(a, Force::Normal(g))
    }

    fn prp(&mut self) -> Check {
        let c = self.new_point(&[]);
        let g = self.guide_for(c, &[]);
        let h = self.guide_for(c, &[self.m.guides[g].on]);
        if self.m.guides[h].on == self.m.guides[g].on && self.m.guides[h].on != 0 {
            self.m.coordinates_only = true;
        }
        Check::Two(Force::Normal(g), Force::Normal(h))
    }

    /// A link that slides without turning on a known one, with one more constraint.
    fn rpp(&mut self) -> Check {
        let x = self.new_link(&[]);
        let on = self.known_link(&[x]);
        let pinned = self.topology.chance(0.4);
        let yoke = !pinned && self.topology.chance(0.3);
        let first = if pinned {
            let c = self.new_point(&[x]);
            self.add_guide(Some(c), Some(x), on, Shape::Line(Vec2::ZERO))
        } else if self.topology.chance(0.25)
            && on != 0
            && !self.m.guides.iter().any(|g| g.slider == Some(on))
        {
            // The reverse: the known link slides in a guide of the unknown one.
            self.m.coordinates_only = true;
            self.add_guide(None, Some(on), x, Shape::Line(Vec2::ZERO))
        } else {
            self.add_guide(None, Some(x), on, Shape::Line(Vec2::ZERO))
        };
        if yoke {
            self.m.links[x].closed = true;
            let b = self.site(&[x]);
            let second = self.guide_shaped(b, x, Shape::Line(Vec2::ZERO));
            return Check::Two(Force::Normal(first), Force::Normal(second));
        }
        self.m.links[x].by_coordinates = true;
        let second = match self.topology.below(3) {
            0 => {
                let n = self.new_point(&[x]);
                let a = self.site(&[x]);
                self.bar(n, a);
                Force::Bar(n, a)
            }
            1 => {
                let n = self.new_point(&[x]);
                Force::Normal(self.guide_for(n, &[x]))
            }
            _ => {
                let b = self.site(&[x]);
                Force::Normal(self.guide_on(b, x))
            }
        };
        while self.m.links[x].points.len() < 2 {
            self.new_point(&[x]);
        }
        Check::Two(Force::Normal(first), second)
    }

    fn triad(&mut self) -> Check {
        let x = self.new_link(&[]);
        let mut made = vec![x];
        let legs = [0; 3].map(|_| {
            let kind = self.topology.pick(&[0, 0, 0, 1, 1, 2, 2, 3]);
            match kind {
                0 | 3 => {
                    let n = self.new_point(&[x]);
                    let a = self.site(&made);
                    if kind == 0 {
                        made.push(self.bar(n, a));
                    } else {
                        let links = self.parts(n, a);
                        made.extend(&links);
                        self.drive(Drive::Cylinder { a, b: n, links });
                    }
                    Force::Bar(n, a)
                }
                1 => {
                    let n = self.new_point(&[x]);
                    let g = self.guide_for(n, &made);
                    made.extend(self.m.guides[g].slider);
                    Force::Normal(g)
                }
                _ => {
                    let b = self.site(&made);
                    let g = self.guide_on(b, x);
                    made.extend(self.m.guides[g].slider);
                    Force::Normal(g)
                }
            }
        });
        while self.m.links[x].points.len() < 2 {
            self.new_point(&[x]);
        }
        self.tracers(x);
        Check::Three(legs)
    }

    /// Numbers for barrel and rod, sometimes.
    fn parts(&mut self, near: usize, far: usize) -> Vec<usize> {
        if self.topology.chance(0.5) {
            return vec![];
        }
        let listed = self.topology.chance(0.5);
        let (a, b) = if listed { (vec![far], vec![near]) } else { (vec![], vec![]) };
        let pair = vec![self.new_link(&a), self.new_link(&b)];
        for l in &pair {
            self.m.links[*l] =
                Link { closed: true, follower: true, listed, ..self.m.links[*l].clone() };
        }
        pair
    }

    fn slide(&mut self) -> Check {
        let c = self.new_point(&[]);
        let on = self.known_link(&[]);
        let fat = self.topology.chance(0.4);
        let arc = !fat && self.topology.chance(0.3);
        let x = if fat {
            let x = self.new_link(&[c]);
            self.new_point(&[x]);
            self.m.links[x].by_coordinates = true;
            x
        } else {
            self.block(c)
        };
        let shape = if arc {
            // Arc length counts in the carrier's frame, which only coordinates give.
            self.m.coordinates_only |= on != 0;
            Shape::Arc(self.new_point(&[on]))
        } else {
            Shape::Line(Vec2::ZERO)
        };
        let guide = self.add_guide(Some(c), Some(x), on, shape);
        self.drive(Drive::Slide { guide });
        Check::None
    }

    fn cylinder(&mut self) -> Check {
        let (a, b) = self.sites();
        let c = self.new_point(&[]);
        let links = self.parts(c, a);
        let other = if self.topology.chance(0.6)
            || !self.m.links.iter().skip(1).any(|l| l.points.contains(&c))
        {
            self.bar(c, b);
            Force::Bar(c, b)
        } else {
            Force::Normal(self.guide_for(c, &links))
        };
        let (p, q, links) = if self.topology.chance(0.5) {
            (a, c, links)
        } else {
            (c, a, links.into_iter().rev().collect())
        };
        self.drive(Drive::Cylinder { a: p, b: q, links });
        Check::Two(Force::Bar(c, a), other)
    }

    /// A pin driven along a slot of a link that is itself unknown.
    fn ram(&mut self) -> Check {
        let (a, b) = self.sites();
        let x = self.new_link(&[a]);
        let c = self.new_point(&[]);
        let shape = if self.topology.chance(0.4) {
            self.m.links[x].closed = true;
            Shape::Own(a)
        } else {
            self.new_point(&[x]);
            Shape::Line(Vec2::ZERO)
        };
        self.bar(c, b);
        let guide = self.guide_shaped(c, x, shape);
        self.drive(Drive::Slide { guide });
        Check::Two(Force::Bar(c, a), Force::Bar(c, b))
    }

    fn glide(&mut self) -> Check {
        let on = self.known_link(&[]);
        let x = self.new_link(&[]);
        self.new_point(&[x]);
        self.new_point(&[x]);
        self.m.links[x].by_coordinates = true;
        let guide = self.add_guide(None, Some(x), on, Shape::Line(Vec2::ZERO));
        self.drive(Drive::Slide { guide });
        Check::None
    }
}

impl Mech {
    /// Maps every place and direction: `turn` (a unit vector), then stretched, then shifted.
    pub fn mapped(&self, turn: Vec2, stretch: f64, shift: Vec2) -> Mech {
        let mut m = self.clone();
        for p in &mut m.points {
            let v = p.to_vec2();
            let v = if turn == Vec2::new(1.0, 0.0) { v } else { v.rotate_by(turn) };
            *p = (v * stretch + shift).to_point();
        }
        for g in &mut m.guides {
            if let Shape::Line(d) = &mut g.shape
                && turn != Vec2::new(1.0, 0.0)
            {
                *d = d.rotate_by(turn);
            }
        }
        for d in &mut m.drivers {
            if !matches!(d.kind, Drive::Turn { .. }) {
                d.rate *= stretch;
                d.acceleration = d.acceleration.map(|a| a * stretch);
            }
        }
        m
    }
}
