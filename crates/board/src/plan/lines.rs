//! Names of the lines along which guides run: BC, x, t–t, t₃.

use std::f64::consts::PI;

use super::names::{name_label, point_label};
use super::text::PlanWriter;
use hodograph_scene::{Angle, Guide, GuideDirection, GuideId, GuidePath, PointId, Through};

/// Directions that differ by less than this coincide.
const PARALLEL_RAD: f64 = 1e-9;

impl PlanWriter<'_> {
    /// Returns the name of a guide's direction if it runs along no line of two points and no axis:
    /// t–t, or t₃ for a guide of link 3.
    pub fn tangent(&self, g: GuideId) -> Option<String> {
        use GuideDirection::{Along, Instant, Own, Slid};
        let guide = &self.scene.guides[g.0];
        let GuidePath::Line { through, direction, offset } = &guide.path else { return None };
        match direction {
            Along(_, _, None) => None,
            Own if offset.is_none() && matches!(through, Through::Point(_)) => None,
            Instant(_) if guide.on == self.scene.ground => {
                self.axis(g).is_none().then(|| self.oblique(g))
            }
            Instant(_) if self.axis(g).is_some() => None,
            Along(..) | Own | Instant(_) | Slid(_) => Some(self.carried(g)),
        }
    }

    /// Returns the name of a guide of link 3: t₃; if the link has other guides in other directions,
    /// with the name of the runner.
    fn carried(&self, g: GuideId) -> String {
        let guide = &self.scene.guides[g.0];
        let link = name_label(self.scene.link_name(guide.on));
        let crosses =
            |o: &Guide| o.on == guide.on && o.rolling.is_none() && !self.parallel(guide, o);
        let runner = guide
            .pin
            .filter(|_| self.scene.guides.iter().any(crosses))
            .map(|p| point_label(self.scene.point_name(p)));
        format!("t_{{{link}{}}}", runner.unwrap_or_default())
    }

    /// True if the scene defines two guides of one link as parallel; arcs have no direction.
    fn parallel(&self, a: &Guide, b: &Guide) -> bool {
        let (GuidePath::Line { direction: a, .. }, GuidePath::Line { direction: b, .. }) =
            (&a.path, &b.path)
        else {
            return true;
        };
        // The reference of each angle, and the angle.
        let said = |d: &GuideDirection| match d {
            GuideDirection::Instant(angle) => (0, None, angle.value.radians()),
            GuideDirection::Along(p, q, angle) => {
                (1, Some((*p, *q)), angle.as_ref().map_or(0.0, |a| a.value.radians()))
            }
            GuideDirection::Own => (2, None, 0.0),
            GuideDirection::Slid(angle) => (3, None, angle.value.radians()),
        };
        let ((a, of_a, x), (b, of_b, y)) = (said(a), said(b));
        let apart = (x - y).rem_euclid(PI);
        (a, of_a) == (b, of_b) && apart.min(PI - apart) < PARALLEL_RAD
    }

    /// Returns the name of an oblique guide of the ground: t–t; if there are several, each with the
    /// name of its runner.
    fn oblique(&self, g: GuideId) -> String {
        let of_ground = |k: &usize| {
            let guide = &self.scene.guides[*k];
            let straight = matches!(
                &guide.path,
                GuidePath::Line { direction: GuideDirection::Instant(_), .. }
            );
            straight
                && guide.on == self.scene.ground
                && guide.rolling.is_none()
                && self.axis(GuideId(*k)).is_none()
        };
        if (0..self.scene.guides.len()).filter(of_ground).count() < 2 {
            return "t\\text{–}t".into();
        }
        let guide = &self.scene.guides[g.0];
        let runner = guide
            .pin
            .map(|p| point_label(self.scene.point_name(p)))
            .or_else(|| Some(name_label(self.scene.link_name(guide.slider?))));
        format!("t_{{{}}}", runner.unwrap_or_default())
    }

    /// Returns the axis along which a fixed guide runs.
    fn axis(&self, g: GuideId) -> Option<&'static str> {
        let guide = &self.scene.guides[g.0];
        match &guide.path {
            GuidePath::Line { direction: GuideDirection::Instant(angle), .. }
                if self.plan.still[guide.on.0] =>
            {
                match angle.value {
                    Angle::Deg(d) if d.rem_euclid(180.0) == 0.0 => Some("x"),
                    Angle::Deg(d) if d.rem_euclid(180.0) == 90.0 => Some("y"),
                    Angle::Deg(_) | Angle::Rad(_) => None,
                }
            }
            GuidePath::Line { .. } | GuidePath::Arc { .. } => None,
        }
    }

    /// Returns the name of a guide's direction: the line of two points that it runs along, an axis,
    /// otherwise t.
    pub fn guide_line(&self, g: GuideId) -> String {
        if let Some(own) = self.axis(g).map(str::to_owned).or_else(|| self.tangent(g)) {
            return own;
        }
        let guide = &self.scene.guides[g.0];
        let p = |q: PointId| point_label(self.scene.point_name(q));
        let from = |start: PointId| format!("{}{}", p(start), guide.pin.map(p).unwrap_or_default());
        match &guide.path {
            GuidePath::Line { direction: GuideDirection::Along(a, b, _), .. } => {
                format!("{}{}", p(*a), p(*b))
            }
            GuidePath::Line { through: Through::Point(a), .. } => from(*a),
            // A guide without two points has its name from above.
            GuidePath::Line { .. } => String::new(),
            GuidePath::Arc { centre, .. } => from(*centre),
        }
    }
}
