//! Displaces overlapping bars of two links, each by the same amount, so that two lines are visible;
//! their ends stay under the circles of the joints.
//!
//! This module decides which bars overlap and how far each is displaced. Otherwise their positions
//! on the paper are true.

use hodograph_base::geom::{Point, Vec2};
use hodograph_scene::LinkId;

use super::MechanismDraft;

/// Clear space between two bars side by side: with less they merge in print.
const AIR_MM: f64 = 0.4;
/// Bars that share less than this length meet at a joint.
const OVER_MM: f64 = 4.0;
/// Maximum displacement of a bar, as a part of the radius of its joints' circles; beyond it the bar
/// would leave them.
const IN_JOINT: f64 = 0.78;

/// A straight line of a link on paper.
struct PartedBar {
    link: usize,
    /// The index among the link's bars, those along guides last; `None` for a line that is not
    /// displaced (the edge of a plate, a slot).
    index: Option<usize>,
    a: Point,
    b: Point,
}

impl PartedBar {
    /// The offset of the other bar to the left of this one, where the two are farthest apart;
    /// `None` if they do not overlap: their centre lines are `apart_mm` or more apart, or they
    /// share less than [`OVER_MM`].
    fn over(&self, other: &PartedBar, apart_mm: f64) -> Option<f64> {
        let u = (self.b - self.a).unit()?;
        let [mut p, mut q] = [other.a, other.b].map(|e| ((e - self.a).dot(u), u.cross(e - self.a)));
        if p.0 > q.0 {
            std::mem::swap(&mut p, &mut q);
        }
        let (from, to) = (p.0.max(0.0), q.0.min(self.a.distance(self.b)));
        if to - from < OVER_MM {
            return None;
        }
        let at = |t: f64| p.1 + (q.1 - p.1) * (t - p.0) / (q.0 - p.0);
        let [one, two] = [at(from), at(to)];
        let far = if two.abs() > one.abs() { two } else { one };
        (far.abs() < apart_mm).then_some(far)
    }
}

impl MechanismDraft<'_> {
    /// For each link, the displacement of each of its bars: plain ones first, then those along
    /// guides.
    pub(super) fn parted(&self) -> Vec<Vec<Vec2>> {
        let count =
            |l: usize| self.forms[l].as_ref().map_or(0, |f| f.bars.len() + f.guide_bars.len());
        let mut out: Vec<Vec<Vec2>> =
            (0..self.forms.len()).map(|l| vec![Vec2::ZERO; count(l)]).collect();
        let bars = self.all_bars();
        let apart_mm = self.style.link.width_mm + AIR_MM;
        let over = |i: usize, j: usize| {
            if bars[i].link == bars[j].link { None } else { bars[i].over(&bars[j], apart_mm) }
        };
        let mut done = vec![false; bars.len()];
        for first in 0..bars.len() {
            if done[first] {
                continue;
            }
            // All bars that overlap the first one, or one of those, and so on: they are nearly
            // parallel.
            let mut together = vec![first];
            let mut k = 0;
            while k < together.len() {
                let more = (first + 1..bars.len())
                    .filter(|j| !together.contains(j) && over(together[k], *j).is_some());
                together.extend(more.collect::<Vec<_>>());
                k += 1;
            }
            together.iter().for_each(|i| done[*i] = true);
            let Some(along) = (bars[first].b - bars[first].a).unit().filter(|_| together.len() > 1)
            else {
                continue;
            };
            // From right to left in their present order.
            let left_of = |i: usize, j: usize| {
                let sense = (bars[j].b - bars[j].a).dot(along).signum();
                over(j, i).map_or(0.0, |d| d * sense)
            };
            let side = |i: usize| {
                together.iter().filter(|j| **j != i).map(|j| left_of(i, *j)).sum::<f64>()
            };
            let mut ordered: Vec<(f64, usize)> = together.iter().map(|i| (side(*i), *i)).collect();
            ordered.sort_by(|(s, i), (t, j)| s.total_cmp(t).then(i.cmp(j)));
            let mut lanes: Vec<(usize, usize)> = Vec::new();
            for &(_, i) in &ordered {
                let taken = |lane: usize| {
                    lanes.iter().any(|(j, l)| {
                        *l == lane && (over(*j, i).is_some() || over(i, *j).is_some())
                    })
                };
                lanes.push((i, (0..together.len()).find(|l| !taken(*l)).unwrap_or(0)));
            }
            let last = lanes.iter().map(|l| l.1).max().unwrap_or(0) as f64;
            let fixed = lanes.iter().find(|(i, _)| bars[*i].index.is_none()).map(|l| l.1 as f64);
            let middle = fixed.unwrap_or(last / 2.0);
            let most =
                lanes.iter().map(|l| (l.1 as f64 - middle).abs()).fold(0.0, f64::max).max(0.5);
            let step = apart_mm.min(self.style.pin_radius_mm * IN_JOINT / most);
            for &(i, lane) in &lanes {
                let Some(index) = bars[i].index else { continue };
                // The displacement decreases with the distance already present: bars that swing
                // over each other separate and close smoothly.
                let nearest = together
                    .iter()
                    .filter_map(|j| if *j == i { None } else { over(*j, i) })
                    .map(f64::abs)
                    .fold(apart_mm, f64::min);
                out[bars[i].link][index] =
                    along.perp() * ((lane as f64 - middle) * step * (1.0 - nearest / apart_mm));
            }
        }
        out
    }

    fn all_bars(&self) -> Vec<PartedBar> {
        let mut bars = Vec::new();
        for (link, form) in self.forms.iter().enumerate() {
            let Some(form) = form else { continue };
            let straight = form.bars.iter().chain(&form.guide_bars).enumerate();
            bars.extend(straight.map(|(k, &(a, b))| {
                let slotted = k >= form.bars.len() && !form.slots.is_empty();
                PartedBar { link, index: (!slotted).then_some(k), a, b }
            }));
            let n = form.plate.len();
            bars.extend((0..n).map(|k| PartedBar {
                link,
                index: None,
                a: form.plate[k],
                b: form.plate[(k + 1) % n],
            }));
        }
        bars
    }

    /// The displacement of a bar; plain bars are counted first, then those along guides.
    pub(super) fn aside(&self, l: LinkId, index: usize) -> Vec2 {
        self.parted[l.0].get(index).copied().unwrap_or(Vec2::ZERO)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bar(a: [f64; 2], b: [f64; 2]) -> PartedBar {
        PartedBar { link: 0, index: Some(0), a: Point::new(a[0], a[1]), b: Point::new(b[0], b[1]) }
    }

    #[test]
    fn bars_over_one_another() {
        let level = bar([0.0, 0.0], [20.0, 0.0]);
        assert_eq!(level.over(&bar([15.0, 0.0], [30.0, 0.0]), 1.1), Some(0.0));
        assert_eq!(level.over(&bar([30.0, 0.0], [15.0, 0.0]), 1.1), Some(0.0));
        assert_eq!(level.over(&bar([0.0, 0.0], [20.0, 1.0]), 1.1), Some(1.0));
        assert_eq!(level.over(&bar([0.0, 0.0], [20.0, 3.0]), 1.1), None, "far enough apart");
        assert_eq!(level.over(&bar([20.0, 0.0], [40.0, 0.0]), 1.1), None, "one after the other");
    }
}
