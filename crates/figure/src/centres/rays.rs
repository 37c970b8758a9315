//! Selects the lines that find centres on paper, each once, and computes their lengths.
//!
//! A line extends from the first to the last centre on the paper. Towards a centre off the paper it
//! continues to the edge, with an arrow.

use hodograph_base::geom::{Point, Vec2};
use hodograph_mechanism::position::Path;
use hodograph_methods::centres::{Centre, CentreLocus, CentrePlace, Centres, Origin};
use hodograph_scene::GuideId;

use hodograph_paper::paper::extent::Rect;

/// Lines closer than this over the whole paper are drawn once.
const SAME_MM: f64 = 0.2;
/// Extension of a line beyond its last centre, so that it visibly passes through it.
const BEYOND_MM: f64 = 4.0;

/// A centre on paper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CentreSpot {
    /// On the paper (mm).
    On(Point),
    /// In the plane, but off the paper (mm).
    Off(Point),
    /// At infinity, in this direction and in the opposite one.
    Infinite(Vec2),
}

/// The centres that a drawing finds, by their indices in the list; all of them if there is only one
/// drawing.
#[derive(Clone, Debug, Default)]
pub struct CentrePlate {
    /// The centres with their lines drawn, in the order of finding; `None` for all.
    pub found: Option<Vec<usize>>,
}

impl CentrePlate {
    /// True if the lines of a centre are drawn.
    pub fn finds(&self, k: usize) -> bool {
        self.found.as_ref().is_none_or(|all| all.contains(&k))
    }

    /// True if a centre is shown: the plate finds it, or a line of a centre that the plate finds
    /// passes through it.
    pub fn shows(&self, found: &Centres, k: usize) -> bool {
        let Some(all) = &self.found else { return true };
        let own = found.list[k].step.pair;
        let serves = |f: &usize| match found.list[*f].origin {
            Some(Origin::Crossing(lines)) => {
                let pair = found.list[*f].step.pair;
                let through = |line: &CentreLocus| match line {
                    CentreLocus::Through(link) => {
                        [pair.i, pair.j].iter().any(|l| found.closure.pair(*l, *link) == own)
                    }
                    CentreLocus::Normal(_) | CentreLocus::Infinity => false,
                };
                lines.iter().any(through)
            }
            Some(Origin::Pair | Origin::Velocities) | None => false,
        };
        all.contains(&k) || all.iter().any(serves)
    }
}

/// A line on paper.
#[derive(Clone, Debug)]
pub struct CentreRay {
    /// One end (mm).
    pub from: Point,
    /// The other end (mm).
    pub to: Point,
    /// True if the line is a normal, not a line through two centres.
    pub normal: bool,
    /// The centre (index) that the line is first drawn for.
    pub by: usize,
    /// The ends with an arrow.
    pub arrows: Vec<RayArrow>,
}

/// The end of a line towards a centre off the paper.
#[derive(Clone, Copy, Debug)]
pub struct RayArrow {
    /// The tip (mm).
    pub tip: Point,
    /// The last centre before the tip, or the start of the line (mm).
    pub last: Point,
    /// The centre off the paper (index).
    pub to: usize,
    /// The centre (index) on this line that the distance is measured from.
    pub from: Option<usize>,
}

/// The paper with the centres.
pub struct CentrePaper<'a> {
    /// The centres.
    pub found: &'a Centres,
    /// Maps the plane (m) to paper (mm).
    pub to_paper: &'a dyn Fn(Point) -> Point,
    /// The part of the paper that is used.
    pub window: Rect,
}

impl CentrePaper<'_> {
    /// Position of a centre on paper; `None` if it has no place.
    pub fn spot(&self, c: &Centre) -> Option<CentreSpot> {
        Some(match c.place? {
            CentrePlace::At(p) => {
                let at = (self.to_paper)(p);
                if holds(self.window, at) { CentreSpot::On(at) } else { CentreSpot::Off(at) }
            }
            CentrePlace::Infinity(u) => CentreSpot::Infinite(u),
        })
    }

    /// All lines that find the centres of a plate, with the centres on them.
    pub fn rays(&self, plate: &CentrePlate) -> Vec<CentreRay> {
        let mut lines: Vec<DrawnRay> = Vec::new();
        for (k, c) in self.found.list.iter().enumerate().filter(|(k, _)| plate.finds(*k)) {
            let Some(Origin::Crossing(pair)) = c.origin else { continue };
            for line in pair {
                let Some(drawn) = self.drawn(k, c, line) else { continue };
                match lines.iter_mut().find(|l| l.is(&drawn, self.window)) {
                    Some(same) => same.members.extend(drawn.members),
                    None => lines.push(drawn),
                }
            }
        }
        lines.iter().filter_map(|l| self.ray(l)).collect()
    }

    /// A line of a centre, with the centres on it.
    fn drawn(&self, k: usize, c: &Centre, line: CentreLocus) -> Option<DrawnRay> {
        let pair = c.step.pair;
        let index = |a, b| {
            self.found.list.iter().position(|o| o.step.pair == self.found.closure.pair(a, b))
        };
        match line {
            CentreLocus::Through(link) => {
                let members = vec![index(pair.i, link)?, index(link, pair.j)?, k];
                let finite = |k: &usize| match self.spot(&self.found.list[*k]) {
                    Some(CentreSpot::On(p) | CentreSpot::Off(p)) => Some(p),
                    Some(CentreSpot::Infinite(_)) | None => None,
                };
                // The two known centres define the direction.
                let [a, b] = [members[0], members[1]];
                let direction = match (finite(&a), finite(&b)) {
                    (Some(p), Some(q)) => q - p,
                    _ => [a, b].iter().find_map(|k| match self.spot(&self.found.list[*k]) {
                        Some(CentreSpot::Infinite(u)) => Some(u),
                        _ => None,
                    })?,
                };
                let nearest = [a, b].iter().filter_map(finite).min_by(|p, q| {
                    let middle = self.window.centre();
                    p.distance(middle).total_cmp(&q.distance(middle))
                })?;
                Some(DrawnRay {
                    through: nearest,
                    along: direction.unit()?,
                    members,
                    normal: false,
                    by: k,
                })
            }
            CentreLocus::Normal(g) => {
                let [pin, along] = self.normal(g)?;
                Some(DrawnRay {
                    through: pin.to_point(),
                    along,
                    members: vec![k],
                    normal: true,
                    by: k,
                })
            }
            CentreLocus::Infinity => None,
        }
    }

    /// The foot of a slot's normal (as a vector from the origin) and the normal's direction.
    fn normal(&self, g: GuideId) -> Option<[Vec2; 2]> {
        let at = &self.found.worked.configuration;
        let pin = at.points[self.found.scene.guides[g.0].pin?.0]?;
        let along = match at.guides[g.0]? {
            Path::Line { direction, .. } => direction.perp(),
            Path::Arc { centre, .. } => (centre - pin).unit()?,
        };
        Some([(self.to_paper)(pin).to_vec2(), along])
    }

    /// The visible part of a line, with its arrows.
    fn ray(&self, line: &DrawnRay) -> Option<CentreRay> {
        let [low, high] = clipped(self.window, line.through, line.along)?;
        let position = |p: Point| (p - line.through).dot(line.along);
        let (mut first, mut last) =
            if line.normal { (0.0, 0.0) } else { (f64::INFINITY, f64::NEG_INFINITY) };
        let mut ends: [Option<usize>; 2] = [None, None];
        let mut infinite = None;
        for k in &line.members {
            match self.spot(&self.found.list[*k])? {
                CentreSpot::On(p) => {
                    (first, last) = (first.min(position(p)), last.max(position(p)))
                }
                CentreSpot::Off(p) => ends[usize::from(position(p) > 0.0)] = Some(*k),
                CentreSpot::Infinite(_) => infinite = Some(*k),
            }
        }
        if first > last {
            (first, last) = (low, high);
        }
        // A centre at infinity is towards either end: take the one with more space.
        if let (Some(k), [None, None]) = (infinite, ends) {
            ends[usize::from(high - last > first - low)] = Some(k);
        }
        let (from, to) = (
            if ends[0].is_some() { low } else { (first - BEYOND_MM).max(low) },
            if ends[1].is_some() { high } else { (last + BEYOND_MM).min(high) },
        );
        let at = |t: f64| line.through + line.along * t;
        let measured = line
            .members
            .iter()
            .copied()
            .filter(|k| matches!(self.spot(&self.found.list[*k]), Some(CentreSpot::On(_))))
            .min();
        let arrow = |(k, tip, last): (Option<usize>, f64, f64)| {
            Some(RayArrow { tip: at(tip), last: at(last), to: k?, from: measured })
        };
        // A line without a centre on the paper runs from edge to edge.
        let (before, behind) =
            if measured.is_some() || line.normal { (first, last) } else { (to, from) };
        let arrows = [(ends[0], from, before), (ends[1], to, behind)]
            .into_iter()
            .filter_map(arrow)
            .collect();
        (to > from).then(|| CentreRay {
            from: at(from),
            to: at(to),
            normal: line.normal,
            by: line.by,
            arrows,
        })
    }
}

/// An infinite line.
struct DrawnRay {
    through: Point,
    along: Vec2,
    /// The centres on the line, as indices.
    members: Vec<usize>,
    normal: bool,
    /// The centre (index) that the line is first drawn for.
    by: usize,
}

impl DrawnRay {
    /// True if both lines coincide on the paper.
    fn is(&self, other: &DrawnRay, window: Rect) -> bool {
        let Some([low, high]) = clipped(window, other.through, other.along) else { return false };
        [low, high].iter().all(|t| {
            self.along.cross(other.through + other.along * *t - self.through).abs() < SAME_MM
        })
    }
}

/// True if the paper holds a point.
pub fn holds(window: Rect, p: Point) -> bool {
    (window.min.x..=window.max.x).contains(&p.x) && (window.min.y..=window.max.y).contains(&p.y)
}

/// The part of a line on the paper (Liang-Barsky), as positions along it from `through`; `None` if
/// the line misses the paper.
pub fn clipped(window: Rect, through: Point, along: Vec2) -> Option<[f64; 2]> {
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    for (at, step, min, max) in [
        (through.x, along.x, window.min.x, window.max.x),
        (through.y, along.y, window.min.y, window.max.y),
    ] {
        if step == 0.0 {
            if !(min..=max).contains(&at) {
                return None;
            }
            continue;
        }
        let (a, b) = ((min - at) / step, (max - at) / step);
        low = low.max(a.min(b));
        high = high.min(a.max(b));
    }
    (low < high && low.is_finite() && high.is_finite()).then_some([low, high])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_cut_at_the_edge_of_the_paper() {
        let window = Rect::new(Point::new(0.0, 0.0), Point::new(10.0, 5.0));
        assert_eq!(clipped(window, Point::new(2.0, 1.0), Vec2::new(1.0, 0.0)), Some([-2.0, 8.0]));
        assert_eq!(clipped(window, Point::new(2.0, 9.0), Vec2::new(1.0, 0.0)), None);
        assert_eq!(clipped(window, Point::new(-1.0, -1.0), Vec2::new(1.0, 1.0)), Some([1.0, 6.0]));
        assert_eq!(clipped(window, Point::new(-9.0, 4.0), Vec2::new(1.0, 1.0)), None);
    }
}
