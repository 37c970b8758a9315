//! Places and lines in projective coordinates, and the choice of the two lines drawn for a centre.
//!
//! A place is (x, y, 1), a direction (x, y, 0), a line (a, b, c) with ax + by + cw = 0. Join and
//! crossing are cross products. Coordinates are measured from the middle of the mechanism in units
//! of its size, so that a unit vector distinguishes near from far.

use hodograph_base::geom::{Point, Vec2};

/// The position of a centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CentrePlace {
    /// In the plane (m).
    At(Point),
    /// At infinity in this direction (a unit vector), and in the opposite one.
    Infinity(Vec2),
}

impl CentrePlace {
    /// Returns the point, unless it is at infinity.
    pub fn point(&self) -> Option<Point> {
        match self {
            CentrePlace::At(p) => Some(*p),
            CentrePlace::Infinity(_) => None,
        }
    }

    /// Returns the place at infinity in a direction, with the sense that lies in (−90°, 90°].
    pub fn infinity(direction: Vec2) -> Option<CentrePlace> {
        let u = direction.unit()?;
        let right = u.x > 0.0 || u.x == 0.0 && u.y > 0.0;
        Some(CentrePlace::Infinity(if right { u } else { -u }))
    }
}

/// Projective coordinates of a place or a line, normalized to a unit vector.
pub(super) type ProjectiveUnit = [f64; 3];

/// Two places, or two lines, coincide if the sine between their unit vectors is at most this: a
/// million roundings.
pub(super) const SAME: f64 = 1e-9;

fn cross(a: ProjectiveUnit, b: ProjectiveUnit) -> ProjectiveUnit {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn norm(a: ProjectiveUnit) -> f64 {
    (a[0] * a[0] + a[1] * a[1] + a[2] * a[2]).sqrt()
}

pub(super) fn unit(a: ProjectiveUnit) -> Option<ProjectiveUnit> {
    let n = norm(a);
    (n > 0.0 && n.is_finite()).then(|| a.map(|x| x / n))
}

/// Returns the line through two places, or the crossing of two lines; `None` if they coincide.
pub(super) fn meet(a: ProjectiveUnit, b: ProjectiveUnit) -> Option<ProjectiveUnit> {
    let m = cross(a, b);
    unit(m).filter(|_| norm(m) > SAME)
}

/// Returns the volume that three unit vectors span: 0 if three places are collinear.
pub(super) fn volume(a: ProjectiveUnit, b: ProjectiveUnit, c: ProjectiveUnit) -> f64 {
    let m = cross(a, b);
    (m[0] * c[0] + m[1] * c[1] + m[2] * c[2]).abs()
}

/// The frame of the projective coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct ProjectiveFrame {
    pub middle: Point,
    /// The size of the mechanism (m).
    pub size: f64,
}

impl ProjectiveFrame {
    pub fn of(&self, place: CentrePlace) -> ProjectiveUnit {
        let [x, y, w] = match place {
            CentrePlace::At(p) => {
                let v = (p - self.middle) * (1.0 / self.size);
                [v.x, v.y, 1.0]
            }
            CentrePlace::Infinity(u) => [u.x, u.y, 0.0],
        };
        unit([x, y, w]).unwrap_or([0.0, 0.0, 1.0])
    }

    /// Returns the place of projective coordinates: at infinity if `infinite` is set or the last
    /// coordinate is zero.
    pub fn place(&self, at: ProjectiveUnit, infinite: bool) -> Option<CentrePlace> {
        if infinite || at[2] == 0.0 {
            return CentrePlace::infinity(Vec2::new(at[0], at[1]));
        }
        let p = self.middle + Vec2::new(at[0] / at[2], at[1] / at[2]) * self.size;
        p.is_finite().then_some(CentrePlace::At(p))
    }
}

/// A line that can be drawn for a centre, with the two places (finite or at infinity) that define
/// it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ruled {
    pub line: ProjectiveUnit,
    pub through: [ProjectiveUnit; 2],
}

impl Ruled {
    pub fn through(a: ProjectiveUnit, b: ProjectiveUnit) -> Option<Ruled> {
        Some(Ruled { line: meet(a, b)?, through: [a, b] })
    }

    /// Returns a measure of the distance of the crossing from the places that define the line, and
    /// of these places from the middle: 1 near, 0 far.
    fn nearness(&self, at: ProjectiveUnit) -> f64 {
        let finite =
            |p: &ProjectiveUnit| (p[2] != 0.0).then(|| Vec2::new(p[0] / p[2], p[1] / p[2]));
        let places: Vec<Vec2> = self.through.iter().filter_map(finite).collect();
        let reach: f64 = places.iter().map(|p| 1.0 / (1.0 + p.norm())).product();
        let Some(at) = finite(&at) else { return reach };
        // The uncertainty of a line grows with the ratio of the length beyond its two places to the
        // length between them. A line drawn by its direction has the mechanism's size as its
        // length.
        let base = if let [a, b] = places[..] { (b - a).norm() } else { 1.0 };
        let beyond = places.iter().map(|p| (at - *p).norm()).fold(f64::INFINITY, f64::min);
        if beyond.is_finite() { reach * base / (base + beyond) } else { reach }
    }
}

/// Chooses the two lines that are drawn: the pair with the largest sine × nearness of their
/// crossing, the first such pair on a tie. Returns their indices and the crossing; `None` if all
/// lines coincide.
pub(super) fn choose(lines: &[Ruled]) -> Option<([usize; 2], ProjectiveUnit)> {
    let mut best: Option<(f64, [usize; 2], ProjectiveUnit)> = None;
    for (k, a) in lines.iter().enumerate() {
        for (l, b) in lines.iter().enumerate().skip(k + 1) {
            let Some(at) = meet(a.line, b.line) else { continue };
            let worth = sine(a.line, b.line) * a.nearness(at) * b.nearness(at);
            if best.is_none_or(|(most, ..)| worth > most * (1.0 + SAME)) {
                best = Some((worth, [k, l], at));
            }
        }
    }
    best.map(|(_, which, at)| (which, at))
}

/// Returns the sine of the angle between two lines; the line at infinity counts as square to every
/// other line.
fn sine(a: ProjectiveUnit, b: ProjectiveUnit) -> f64 {
    let (u, v) = (Vec2::new(a[0], a[1]), Vec2::new(b[0], b[1]));
    match (u.unit(), v.unit()) {
        (Some(u), Some(v)) if u.is_finite() && v.is_finite() => u.cross(v).abs(),
        _ => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: ProjectiveFrame = ProjectiveFrame { middle: Point::new(100.0, 0.0), size: 2.0 };

    fn at(x: f64, y: f64) -> ProjectiveUnit {
        FRAME.of(CentrePlace::At(Point::new(x, y)))
    }

    #[test]
    fn crossings_near_far_and_at_infinity() {
        let line = |a, b| Ruled::through(a, b).unwrap();
        let low = line(at(100.0, 0.0), at(101.0, 0.0));
        let up = line(at(103.0, 1.0), FRAME.of(CentrePlace::Infinity(Vec2::new(0.0, 1.0))));
        let (_, x) = choose(&[low, up]).unwrap();
        let Some(CentrePlace::At(p)) = FRAME.place(x, false) else { panic!("{x:?}") };
        assert!(p.distance(Point::new(103.0, 0.0)) < 1e-12);
        let parallel = line(at(100.0, 1.0), at(101.0, 1.0));
        let (_, x) = choose(&[low, parallel]).unwrap();
        assert_eq!(FRAME.place(x, true), Some(CentrePlace::Infinity(Vec2::new(1.0, 0.0))));
        assert!(choose(&[low, line(at(102.0, 0.0), at(103.0, 0.0))]).is_none(), "one line twice");
        assert!(Ruled::through(at(100.0, 1.0), at(100.0, 1.0)).is_none());
    }

    #[test]
    fn the_squarest_and_nearest_are_drawn() {
        let line = |a, b| Ruled::through(a, b).unwrap();
        let flat = line(at(99.0, -0.1), at(100.0, 0.0));
        let low = line(at(100.0, 0.0), at(101.0, 0.0));
        let up = line(at(100.0, 0.0), at(100.0, 1.0));
        assert_eq!(choose(&[flat, low, up]).unwrap().0, [1, 2]);
        assert_eq!(choose(&[low, up, up]).unwrap().0, [0, 1], "ties go to the first");
    }
}
