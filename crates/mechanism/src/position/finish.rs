//! Completion of a configuration from placed groups: adds passive links and points, and checks that
//! values given twice agree.

use super::assemble::Assembly;
use super::{Configuration, Path, Pose, RollingRecord, Shapes, rolling, touch};
use crate::mechanism::{Mechanism, Opened, Passive};
use hodograph_base::diag::{Both, Diagnostic, Faults, Span, Warned, both};
use hodograph_base::digits::significant;
use hodograph_base::geom::Point;
use hodograph_base::number::Real;
use hodograph_scene::{GuideDirection, GuideId, GuidePath, LinkId, PointId, PointPlace, Scene};

impl<N: Real> Assembly<'_, N> {
    /// Adds the passive points, and places the guides that depend on the pose in their links.
    pub(super) fn settled(mut self) -> Self {
        for l in (0..self.scene.links.len()).map(LinkId) {
            let Some(pose) = self.poses[l.0] else { continue };
            for (p, local) in &self.shapes[l.0].points {
                if self.points[p.0].is_none() {
                    self.points[p.0] = Some(pose.to_world(*local));
                }
            }
        }
        for g in (0..self.scene.guides.len()).map(GuideId) {
            if self.guides[g.0].is_some() {
                continue;
            }
            let on = self.scene.guides[g.0].on;
            if let (Some(path), Some(pose)) = (self.guide_in_plane(g), self.poses[on.0]) {
                self.guides[g.0] = Some(match path {
                    Path::Line { through, direction } => Path::Line {
                        through: pose.to_local(through),
                        direction: pose.turn_back(direction),
                    },
                    Path::Arc { centre, radius } => {
                        Path::Arc { centre: pose.to_local(centre), radius }
                    }
                });
            }
        }
        self.fit_arcs();
        self
    }

    /// Coordinates take precedence: the radius of an arc follows from the coordinates of its pin. A
    /// radius that is given in addition agrees within the rounding of typed numbers; used as well,
    /// it would contradict the coordinates in the tenth digit.
    fn fit_arcs(&mut self) {
        for (g, guide) in self.scene.guides.iter().enumerate() {
            let given =
                guide.pin.filter(|p| matches!(self.scene.points[p.0].place, PointPlace::At(_)));
            let (Some(at), Some(pose)) =
                (given.and_then(|p| self.points[p.0]), self.poses[guide.on.0])
            else {
                continue;
            };
            if let Some(Path::Arc { centre, radius }) = &mut self.guides[g] {
                *radius = at.distance(pose.to_world(*centre));
            }
        }
    }

    /// Returns the sizes of all rolling pairs.
    pub(super) fn sizes(&self) -> Vec<[N; 2]> {
        self.scene.rolling.iter().map(|r| r.sizes(&self.inputs)).collect()
    }

    pub(super) fn into_configuration(self) -> Configuration<N> {
        let rolling = self.sizes();
        let shapes = Shapes {
            points: self.shapes.into_iter().map(|s| s.points).collect(),
            guides: self.guides,
            rolling,
        };
        let before = self.meant.map_or(&[][..], |m| &m.rolled);
        complete(self.scene, self.m, shapes, (self.poses, self.points), self.closures, before)
    }
}

impl Assembly<'_, f64> {
    pub(super) fn finish(self) -> Result<Warned<Configuration>, Faults> {
        let mut a = self.settled();
        for g in (0..a.scene.guides.len()).map(GuideId) {
            a.check_placed(g);
        }
        if a.faults.has_errors() {
            return Err(a.faults);
        }
        let shapes = Shapes {
            points: a.shapes.iter().map(|s| s.points.clone()).collect(),
            guides: a.guides.clone(),
            rolling: a.sizes(),
        };
        let configuration = complete(
            a.scene,
            a.m,
            shapes,
            (a.poses.clone(), a.points.clone()),
            a.closures.clone(),
            &[],
        );
        a.check(&configuration);
        if a.faults.has_errors() {
            Err(a.faults)
        } else {
            Ok(Warned { value: configuration, notes: a.notes })
        }
    }

    /// Checks that the radii of two circles in contact match the distance of their centres.
    fn check_rolling(&mut self, c: &Configuration) {
        let mut found = Faults::default();
        for pair in &self.scene.rolling {
            found.list.extend(rolling::misfit(self.scene, pair, c));
        }
        self.faults.list.extend(found.list);
    }

    /// Checks that a guide is placed if its carrier and its runner are: coordinates may place both
    /// without the guide.
    pub(super) fn check_placed(&mut self, g: GuideId) {
        let guide = &self.scene.guides[g.0];
        let runner = match (guide.pin, guide.slider) {
            (Some(p), _) => self.points[p.0].is_some(),
            (None, s) => s.is_some_and(|s| self.poses[s.0].is_some()),
        };
        if self.guides[g.0].is_some() || self.poses[guide.on.0].is_none() || !runner {
            return;
        }
        let d = match &guide.path {
            GuidePath::Line { direction: GuideDirection::Along(a, b, _), .. } => {
                let (a, b) = (self.scene.point_name(*a), self.scene.point_name(*b));
                self.degenerate(g, both!("{a} and {b} coincide"))
            }
            GuidePath::Line { .. } | GuidePath::Arc { .. } => match self.need_guide(g) {
                Err(d) => d,
                Ok(_) => return,
            },
        };
        self.faults.push(d);
    }

    /// Checks that pins given by coordinates are on their guides and links, and that driver angles
    /// agree with the pose.
    pub(super) fn check(&mut self, c: &Configuration) {
        let extent = c.extent();
        for (g, guide) in self.scene.guides.iter().enumerate() {
            let (Some(p), Some(path)) = (guide.pin, c.guides[g]) else { continue };
            // Sizes of two rolling circles are checked as such; opened items are checked
            // separately.
            if guide.rolling.is_some() && matches!(path, Path::Arc { .. })
                || self.m.is_opened(&Opened::Guide(GuideId(g)))
            {
                continue;
            }
            let Some(at) = c.points[p.0] else { continue };
            let off = match path {
                Path::Line { through, direction } => direction.cross(at - through).abs(),
                Path::Arc { centre, radius } => {
                    let given = if let GuidePath::Arc { radius: Some(given), .. } = &guide.path {
                        given.value
                    } else {
                        radius
                    };
                    (at.distance(centre) - given).abs()
                }
            };
            let contact = self.scene.contact_words(GuideId(g));
            let beside = || {
                let (pin, off) = (self.scene.point_name(p), self.scene.length_words(off));
                match &contact {
                    Some(contact) => {
                        both!("{} is missed by {off} at {pin}", contact)
                    }
                    None => {
                        let on = self.scene.link_name(guide.on);
                        both!("pin {pin} lies {off} beside its guide on link {on}")
                    }
                }
            };
            if off > same_place(extent, at) {
                let d = match &contact {
                    Some(_) => Diagnostic::error("contact-missed", beside()).help(both!(
                        "correct the coordinates, the radius or where the face or track lies, or leave out what can be derived"
                    )),
                    None => Diagnostic::error("pin-off-guide", beside()).help(both!(
                        "correct its coordinates or the guide, or leave out what can be derived"
                    )),
                };
                self.faults.push(d.at(guide.span));
            } else if off > distinguishable_length(extent, at) {
                let what = match guide.path {
                    GuidePath::Arc { .. } => {
                        both!("the radius is what they make it")
                    }
                    GuidePath::Line { .. } => both!("the guide runs through them"),
                };
                self.notes.push(given_twice(beside(), what, guide.span));
            }
        }
        self.check_rolling(c);
        for (l, shape) in self.shapes.iter().enumerate() {
            let Some(pose) = c.poses[l] else { continue };
            let opened = |p: PointId| {
                self.m.is_opened(&Opened::Link(LinkId(l)))
                    || self.m.is_opened(&Opened::Pin(p, LinkId(l)))
            };
            for (p, local) in shape.points.iter().filter(|(p, _)| !opened(*p)) {
                let Some(at) = c.points[p.0] else { continue };
                let off = at.distance(pose.to_world(*local));
                let message = || {
                    both!(
                        "{} lies {} from where the data of link {} put it",
                        self.scene.point_name(*p),
                        self.scene.length_words(off),
                        self.scene.links[l].name
                    )
                };
                if off > same_place(extent, at) {
                    self.faults.push(Diagnostic::error("pin-off-link", message()).at(self.scene.points[p.0].span).help(both!(
                        "coordinates and lengths contradict each other: leave one out, or move rough coordinates to \"sketch\""
                    )));
                } else if off > distinguishable_length(extent, at) {
                    self.notes.push(given_twice(
                        message(),
                        both!("the lengths are what they make them"),
                        self.scene.points[p.0].span,
                    ));
                }
            }
        }
        for length in &self.scene.lengths {
            let given = |p: PointId| {
                if let PointPlace::At(_) = self.scene.points[p.0].place {
                    c.points[p.0]
                } else {
                    None
                }
            };
            let (Some(a), Some(b)) = (given(length.a), given(length.b)) else { continue };
            let off = (a.distance(b) - length.value.value).abs();
            if off > distinguishable_length(extent, a) {
                let (na, nb) = (self.scene.point_name(length.a), self.scene.point_name(length.b));
                self.notes.push(given_twice(
                    both!(
                        "{na}{nb} = {} is {} off what the coordinates make it",
                        length.value.text,
                        self.scene.length_words(off)
                    ),
                    both!("the length is what they make it"),
                    length.value.span,
                ));
            }
        }
        for (d, driver) in self.scene.drivers.iter().enumerate() {
            let (Some((link, against)), Some(angle)) = (driver.kind.turned(), driver.kind.angle())
            else {
                continue;
            };
            let (Some(pose), Ok(axis)) = (c.poses[link.0], self.axis_of(link, against, Some(d)))
            else {
                continue;
            };
            let off = pose.axis.cross(axis).abs() + (1.0 - pose.axis.dot(axis));
            if off > DISTINGUISHABLE && off <= SAME_PLACE {
                let link = self.scene.link_name(link);
                self.notes.push(given_twice(
                    both!(
                        "the driver's angle {} is {} rad off the coordinates of link {link}",
                        angle.text,
                        significant(off, 2)
                    ),
                    both!("the angle is what they make it"),
                    angle.span,
                ));
            }
            if off > SAME_PLACE {
                self.faults.push(
                    Diagnostic::error(
                        "contradictory-angle",
                        both!(
                            "the driver's angle {} contradicts the coordinates of link {}",
                            angle.text,
                            self.scene.link_name(link)
                        ),
                    )
                    .at(angle.span)
                    .help(both!("leave one of the two out")),
                );
            }
        }
    }
}

/// Relative difference of two descriptions of one position up to the rounding of typed numbers (ten
/// digits), relative to the size of the mechanism. Larger contradictions would appear as a
/// disagreement between drawing and analysis.
const SAME_PLACE: f64 = 1e-9;

/// Returns the permitted distance of two descriptions of the position `at`: see [`SAME_PLACE`], and
/// a few units in the last place of the coordinates themselves (a single point has no size, and a
/// point far from the origin has a coarse rounding).
pub(super) fn same_place(extent: f64, at: Point) -> f64 {
    SAME_PLACE * extent + 16.0 * f64::EPSILON * at.to_vec2().norm()
}

/// Difference of two descriptions (relative to the mechanism's size, in radians) above which twelve
/// digits of an answer show which of them is used.
const DISTINGUISHABLE: f64 = 1e-13;

/// Returns [`DISTINGUISHABLE`] as a length for the position `at`: see [`same_place`].
fn distinguishable_length(extent: f64, at: Point) -> f64 {
    DISTINGUISHABLE * extent + 16.0 * f64::EPSILON * at.to_vec2().norm()
}

/// Returns the note on two descriptions that agree within the rounding of typed numbers, but not to
/// the certified digits.
fn given_twice(how: Both, so: Both, span: Span) -> Diagnostic {
    Diagnostic::note(
        "given-twice",
        both!(
            "{}: the coordinates are taken, and {}; all digits are those of the coordinates",
            how,
            so
        ),
    )
    .at(span)
}

/// Poses of links and positions of points, as far as they are known.
type FinishedParts<N> = (Vec<Option<Pose<N>>>, Vec<Option<Point<N>>>);

/// Returns a configuration from poses and pins, close to one with the rolling records `before`:
/// adds tracer points, guides in the plane, and passive links.
pub(super) fn complete<N: Real>(
    scene: &Scene,
    m: &Mechanism,
    shapes: Shapes<N>,
    (mut poses, mut points): FinishedParts<N>,
    closures: Vec<usize>,
    before: &[Option<RollingRecord>],
) -> Configuration<N> {
    poses[scene.ground.0] = Some(Pose::ground());
    let mut pinned = vec![false; points.len()];
    m.pins.iter().for_each(|p| pinned[p.0] = true);
    for (pose, carried) in poses.iter().zip(&shapes.points) {
        let Some(pose) = pose else { continue };
        for (p, local) in carried {
            // Pins keep their positions; every other point follows its link.
            if !pinned[p.0] || points[p.0].is_none() {
                points[p.0] = Some(pose.to_world(*local));
            }
        }
    }
    let guides: Vec<Option<Path<N>>> = (0..scene.guides.len())
        .map(|g| Some(shapes.guides[g]?.to_world(&poses[scene.guides[g].on.0]?)))
        .collect();
    for (pair, sizes) in scene.rolling.iter().zip(&shapes.rolling) {
        let ends = rolling::contact(pair, *sizes, &points, &guides);
        for (k, at) in pair.at.into_iter().enumerate() {
            points[at.0] = ends.map(|ends| ends[k]);
        }
    }
    for (cam, at) in scene.cams.iter().filter_map(|c| Some((c, c.touch?))) {
        points[at.0] = touch::touch(scene, cam, &points, &guides).map(|t| t.at);
    }
    for (l, passive) in m.passive.iter().enumerate() {
        poses[l] = match *passive {
            Some(Passive::Block(g)) => scene.guides[g.0]
                .pin
                .and_then(|p| points[p.0])
                .zip(guides[g.0])
                .map(|(origin, path)| Pose { origin, axis: path.tangent_at(origin) }),
            Some(Passive::Cylinder(d)) => scene.drivers[d].kind.ends().and_then(|[a, b]| {
                let (from, to) = points[a.0].zip(points[b.0])?;
                let [own, _] = scene.drivers[d].kind.ends_of(LinkId(l))?;
                Some(Pose { origin: points[own.0]?, axis: (to - from).unit()? })
            }),
            Some(Passive::Held(a, b)) => {
                let shape = |p| shapes.local(LinkId(l), p);
                let lies =
                    |(((la, lb), wa), wb)| Pose::from_point_and_direction(la, lb - la, wa, wb - wa);
                shape(a).zip(shape(b)).zip(points[a.0]).zip(points[b.0]).and_then(lies)
            }
            None => poses[l],
        };
        if let (Some(Passive::Held(..)), Some(pose)) = (passive, poses[l]) {
            for (p, local) in &shapes.points[l] {
                points[p.0].get_or_insert(pose.to_world(*local));
            }
        }
    }
    let mut at = Configuration { points, poses, guides, shapes, closures, rolled: Vec::new() };
    at.rolled = rolling::counted(scene, &at, before);
    at
}
