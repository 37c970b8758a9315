//! Equations of motion: the coordinates of points that drivers move directly, from the ground and in
//! the axes of a moving frame, with their derivatives by time.
//!
//! A point is reached from the base by a chain of links that drivers turn and guides along which
//! drivers move it: x = Σ l cos φ, y = Σ l sin φ. In a frame with the origin O′ and the angle φ its
//! coordinates x′, y′ follow from x = x_O′ + x′ cos φ − y′ sin φ, y = y_O′ + x′ sin φ + y′ cos φ; a
//! point that drivers move along the frame has them directly. The derivatives are those of the
//! formulas.

use super::Equation;
use super::formula::{Formula, UnaryFunction};
use super::vectors::{AngleDifference, LoopVariable, SlideCarrier, VectorAngle, rounded, wrapped};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::kind::Kind;
use hodograph_board::plan::names::name_label;
use hodograph_mechanism::position::{Configuration, Path};
use hodograph_scene::quantity::{Frame, PointMotion};
use hodograph_scene::{Asked, CompositePoint, GuideId, GuidePath, LinkId, PointId, Scene, Through};
use std::f64::consts::TAU;

/// Equations of both coordinates and of their first and second derivatives.
pub type CoordinateEquations = [[Equation; 2]; 3];

/// The equations of motion of a point.
#[derive(Clone, Debug, PartialEq)]
pub struct PointEquations {
    /// The point.
    pub of: PointId,
    /// Its coordinates from the ground.
    pub absolute: Option<CoordinateEquations>,
    /// Its coordinates in frames.
    pub frames: Vec<FrameEquations>,
}

/// The equations of motion of a point in a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameEquations {
    /// The frame.
    pub frame: Frame,
    /// The point of the frame at its origin.
    pub origin: PointId,
    /// The coordinates from the ground by those in the frame; `None` if drivers do not move both
    /// the point and the frame directly.
    pub from_relative: Option<[Equation; 2]>,
    /// The coordinates in the frame.
    pub relative: CoordinateEquations,
    /// The relative velocity and the relative acceleration.
    pub sizes: [Equation; 2],
}

/// The equations of motion of a scene, with the variables in them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MotionEquations {
    /// The variables that drivers move.
    pub variables: Vec<LoopVariable>,
    /// The points.
    pub points: Vec<PointEquations>,
}

/// The largest difference of a formula from the pose, relative to the size of the mechanism.
const SOUND: f64 = 1e-9;

/// Returns the equations of motion of the moving points that a scene names, and without them of the
/// points with wanted motions; points that drivers do not move directly are left out.
pub fn motion_equations(scene: &Scene, at: &Configuration) -> MotionEquations {
    let mut wanted: Vec<(PointId, Vec<Frame>)> = Vec::new();
    let mut want = |p: PointId, frame: Option<Frame>| {
        let k = wanted.iter().position(|(q, _)| *q == p).unwrap_or_else(|| {
            wanted.push((p, Vec::new()));
            wanted.len() - 1
        });
        if let Some(f) = frame.filter(|f| !wanted[k].1.contains(f)) {
            wanted[k].1.push(f);
        }
    };
    for c in &scene.composite {
        if let CompositePoint::Point(of) = c.of {
            want(of.point, Some(c.frame));
        }
    }
    if scene.composite.is_empty() {
        for f in &scene.find {
            match f.what {
                Asked::PointMotion(PointMotion { of, .. }) if of.link.is_none() => {
                    want(of.point, None);
                }
                Asked::Composite(c) => want(c.of.point, Some(c.frame)),
                Asked::PointMotion(_)
                | Asked::Relative(_)
                | Asked::Sliding(_)
                | Asked::Turning(_)
                | Asked::Place(_)
                | Asked::Curvature(_)
                | Asked::CamQuantity(_)
                | Asked::FromCentre(_)
                | Asked::InstantCentre(_)
                | Asked::Ratio(_)
                | Asked::RollerSpin(_)
                | Asked::Transmission(_)
                | Asked::Force(_)
                | Asked::Combined(_) => {}
            }
        }
    }
    let mut all = MotionEquations::default();
    for (of, frames) in wanted {
        let own = |variables: &[LoopVariable]| {
            let mut maker = ChainMaker::new(scene, at, scene.ground, variables);
            let place = maker.place(of).filter(|f| maker.is_sound(f, of))?;
            Some((place, maker.variables))
        };
        let absolute = own(&all.variables);
        if let Some((_, variables)) = &absolute {
            all.variables.clone_from(variables);
        }
        let place = absolute.map(|(place, _)| place);
        let frames: Vec<FrameEquations> = frames
            .into_iter()
            .filter_map(|f| all.in_frame(scene, at, of, place.as_ref(), f))
            .collect();
        if place.is_none() && frames.is_empty() {
            continue;
        }
        let name = name_label(scene.point_name(of));
        let symbols = [
            [format!("x_{{{name}}}"), format!("y_{{{name}}}")],
            [format!("v_{{{name}x}}"), format!("v_{{{name}y}}")],
            [format!("a_{{{name}x}}"), format!("a_{{{name}y}}")],
        ];
        let absolute = place.map(|place| derived(place, &symbols, &all.variables));
        all.points.push(PointEquations { of, absolute, frames });
    }
    all
}

impl MotionEquations {
    /// Returns the coordinates of a point in a frame.
    fn in_frame(
        &mut self,
        scene: &Scene,
        at: &Configuration,
        of: PointId,
        place: Option<&[Formula; 2]>,
        frame: Frame,
    ) -> Option<FrameEquations> {
        let mut ground = ChainMaker::new(scene, at, scene.ground, &self.variables);
        let (origin, angle) = match frame {
            Frame::Link(l) => (*scene.links[l.0].points.first()?, ground.frame_angle(l)),
            Frame::Point(p) => (p.point, Some(VectorAngle { variable: None, plus: 0.0 })),
        };
        let corner = ground.place(origin).filter(|f| ground.is_sound(f, origin));
        let by_chain = match frame {
            Frame::Link(l) => {
                let mut own = ChainMaker::new(scene, at, l, &ground.variables);
                own.place(of).filter(|f| own.is_sound(f, of)).map(|f| (f, own.variables))
            }
            Frame::Point(_) => None,
        };
        let both = place.zip(corner).zip(angle);
        let turned = both.clone().map(|((place, corner), angle)| {
            let away: Vec<Formula> = place
                .iter()
                .zip(corner)
                .map(|(p, o)| Formula::sum([(false, p.clone()), (true, o)]))
                .collect();
            let [c, s] = AngleDifference::new(&ground.variables, &angle, None).cos_sin();
            let (x, y) = (away[0].clone(), away[1].clone());
            [
                Formula::collected([
                    (false, Formula::ordered([x.clone(), c.clone()])),
                    (false, Formula::ordered([y.clone(), s.clone()])),
                ]),
                Formula::collected([
                    (true, Formula::ordered([x, s])),
                    (false, Formula::ordered([y, c])),
                ]),
            ]
        });
        let relative = match by_chain {
            Some((relative, variables)) => {
                ground.variables = variables;
                relative
            }
            None => turned?,
        };
        self.variables = ground.variables;
        let symbols = [["x'", "y'"], ["v_{rx'}", "v_{ry'}"], ["a_{rx'}", "a_{ry'}"]];
        let symbols = symbols.map(|row| row.map(str::to_owned));
        let [own, centre_name] = [of, origin].map(|p| name_label(scene.point_name(p)));
        let relative = derived(relative, &symbols, &self.variables);
        let from_relative = both.map(|((place, corner), angle)| {
            let [c, s] = AngleDifference::new(&self.variables, &angle, None).cos_sin();
            let [x, y] = [0, 1].map(|k| relative[0][k].left.clone());
            let o = ["x", "y"].iter().zip(&corner).map(|(letter, f)| match f {
                zero @ Formula::Number(_, 0.0) => zero.clone(),
                f => Formula::symbol(format!("{letter}_{{{centre_name}}}"), f.value()),
            });
            let o: Vec<Formula> = o.collect();
            let left = |letter: &str, f: &Formula| {
                Formula::symbol(format!("{letter}_{{{own}}}"), f.value())
            };
            let turned = [
                [(false, [x.clone(), c.clone()]), (true, [y.clone(), s.clone()])],
                [(false, [x, s]), (false, [y, c])],
            ];
            let mut rows = turned.into_iter().zip(o).map(|(terms, o)| {
                let terms = terms.map(|(minus, f)| (minus, Formula::product(f)));
                Formula::sum(std::iter::once((false, o)).chain(terms))
            });
            let mut row = || rows.next().unwrap_or_else(|| Formula::whole(0));
            [("x", 0), ("y", 1)]
                .map(|(letter, k)| Equation::new(left(letter, &place[k]), row(), Kind::Length))
        });
        let sizes = [(1, "v_{r}", Kind::Velocity), (2, "a_{r}", Kind::Acceleration)].map(
            |(order, symbol, kind)| {
                let squares = [0, 1].map(|k| (false, relative[order][k].left.clone().squared()));
                let size = Formula::sum(squares).root();
                Equation::new(Formula::symbol(symbol, size.value()), size, kind)
            },
        );
        Some(FrameEquations { frame, origin, from_relative, relative, sizes })
    }
}

/// Returns coordinates as equations with their first and second derivatives.
fn derived(
    place: [Formula; 2],
    symbols: &[[String; 2]; 3],
    variables: &[LoopVariable],
) -> CoordinateEquations {
    let rates = |text: &str| {
        let of = |order: usize| {
            variables.iter().find(|v| v.symbol(order).text() == text).map(|v| {
                let next = v.symbol(order + 1);
                let still = v.second == 0.0 && (order == 1 || v.rate == 0.0);
                if still { Formula::whole(0) } else { next }
            })
        };
        of(0).or_else(|| of(1))
    };
    let velocity = place.each_ref().map(|f| f.derivative(&rates));
    let acceleration = velocity.each_ref().map(|f| f.derivative(&rates));
    let equations = |[x, y]: [Formula; 2], [of_x, of_y]: &[String; 2], kind: Kind| {
        [(of_x, x), (of_y, y)]
            .map(|(name, f)| Equation::new(Formula::symbol(name.clone(), f.value()), f, kind))
    };
    let [of_place, of_velocity, of_acceleration] = symbols;
    [
        equations(place, of_place, Kind::Length),
        equations(velocity, of_velocity, Kind::Velocity),
        equations(acceleration, of_acceleration, Kind::Acceleration),
    ]
}

/// Makes coordinates relative to a base link, from its first point along its direction; relative to
/// ground in the axes of the scene.
struct ChainMaker<'a> {
    scene: &'a Scene,
    at: &'a Configuration,
    base: LinkId,
    variables: Vec<LoopVariable>,
    /// Origin and direction of the axes in the pose.
    origin: Point,
    axis: Vec2,
    /// The points on the way.
    open: Vec<PointId>,
}

impl<'a> ChainMaker<'a> {
    fn new(
        scene: &'a Scene,
        at: &'a Configuration,
        base: LinkId,
        variables: &[LoopVariable],
    ) -> ChainMaker<'a> {
        let of_link = |l: LinkId| {
            let origin = at.points[scene.links[l.0].points.first()?.0]?;
            Some((origin, at.direction(scene, l)?.unit()?))
        };
        let plain = (Point::ORIGIN, Vec2::new(1.0, 0.0));
        let (origin, axis) =
            if base == scene.ground { plain } else { of_link(base).unwrap_or(plain) };
        let variables = variables.to_vec();
        ChainMaker { scene, at, base, variables, origin, axis, open: Vec::new() }
    }

    /// Returns a place of the pose in the axes of the base.
    fn local(&self, p: Point) -> Vec2 {
        self.turned(p - self.origin)
    }

    fn turned(&self, v: Vec2) -> Vec2 {
        Vec2::new(self.axis.dot(v), self.axis.cross(v))
    }

    fn is_sound(&self, formula: &[Formula; 2], of: PointId) -> bool {
        let Some(at) = self.at.points[of.0].map(|p| self.local(p)) else { return false };
        let [x, y] = formula.each_ref().map(Formula::value);
        (Vec2::new(x, y) - at).norm() <= SOUND * self.at.extent().max(at.norm())
    }

    /// Returns the angle of a link's direction.
    fn frame_angle(&mut self, l: LinkId) -> Option<VectorAngle> {
        let (variable, reference) = self.angle(l)?;
        let here = self.turned(self.at.direction(self.scene, l)?).angle();
        Some(self.counted(variable, reference, here))
    }

    /// Returns the variable of a link's angle and the direction for which it is counted; `None` if
    /// no drivers give it. A link that does not turn has no variable.
    fn angle(&mut self, l: LinkId) -> Option<(Option<usize>, f64)> {
        if l == self.base {
            return Some((None, 0.0));
        }
        let slides = self
            .scene
            .guides
            .iter()
            .find(|g| g.slider == Some(l) && matches!(g.path, GuidePath::Line { .. }));
        let driver = self
            .scene
            .drivers
            .iter()
            .position(|d| d.kind.turned().is_some_and(|(link, _)| link == l));
        let Some(d) = driver else { return self.angle(slides?.on) };
        let driver = &self.scene.drivers[d];
        let (_, against) = driver.kind.turned()?;
        let (carrier, _) = self.angle(against)?;
        let mut index = name_label(self.scene.link_name(l));
        if self.base != self.scene.ground {
            index = format!("{index}/{}", name_label(self.scene.link_name(self.base)));
        }
        // A given angle is that of the driver's own line.
        let told = driver.kind.position().map(hodograph_scene::Position::value);
        let own = self.base == self.scene.ground && against == self.base;
        let value = match told.filter(|_| own) {
            Some(told) => rounded(wrapped(told.rem_euclid(TAU))),
            None => rounded(self.turned(self.at.direction(self.scene, l)?).angle()),
        };
        if let Some(k) = self.variables.iter().position(|v| v.angular && v.index == index) {
            return Some((Some(k), value));
        }
        let own = |k: Option<usize>| {
            k.map_or([0.0; 2], |k| [self.variables[k].rate, self.variables[k].second])
        };
        let [rate, second] = own(carrier);
        self.variables.push(LoopVariable {
            index,
            link: Some(l),
            angular: true,
            driver: Some(d),
            value,
            rate: rate + driver.rate.value,
            second: second + driver.acceleration.as_ref().map_or(0.0, |a| a.value),
            along: SlideCarrier::Ground,
        });
        Some((Some(self.variables.len() - 1), value))
    }

    /// Returns the coordinates of a point; `None` if drivers do not move it directly.
    fn place(&mut self, p: PointId) -> Option<[Formula; 2]> {
        let scene = self.scene;
        if scene.links[self.base.0].points.contains(&p) {
            let at = self.local(self.at.points[p.0]?);
            return Some(self.constant(p, at));
        }
        if self.open.contains(&p) {
            return None;
        }
        self.open.push(p);
        let place = self.driven(p).or_else(|| self.carried(p));
        self.open.pop();
        place
    }

    /// Returns the coordinates of a fixed point of the base.
    fn constant(&self, p: PointId, at: Vec2) -> [Formula; 2] {
        let name = name_label(self.scene.point_name(p));
        let small = SOUND * SOUND * self.at.extent();
        [("x", at.x), ("y", at.y)].map(|(letter, v)| match v.abs() <= small {
            true => Formula::whole(0),
            false => Formula::symbol(format!("{letter}_{{{name}}}"), v),
        })
    }

    /// Returns the coordinates of a point that a driver moves along a guide.
    fn driven(&mut self, p: PointId) -> Option<[Formula; 2]> {
        let scene = self.scene;
        let driven = |(d, driver): (usize, &hodograph_scene::Driver)| {
            let g = driver.kind.guide().filter(|g| scene.guides[g.0].pin == Some(p))?;
            Some((d, g))
        };
        let (d, g) = scene.drivers.iter().enumerate().find_map(driven)?;
        let guide = &scene.guides[g.0];
        let (turning, reference) = self.angle(guide.on)?;
        let (at, driver) = (self.at.points[p.0]?, &scene.drivers[d]);
        let told = driver.kind.position().map(hodograph_scene::Position::value);
        let name = name_label(scene.point_name(p));
        match self.at.guides[g.0]? {
            Path::Line { direction, .. } => {
                let from = match guide.path {
                    GuidePath::Line { through: Through::Point(q), .. } => Some(q),
                    GuidePath::Line { through: Through::Pin | Through::At(_), .. }
                    | GuidePath::Arc { .. } => scene.links[guide.on.0].points.first().copied(),
                };
                let from = from?;
                let (place, corner) = (self.at.points[from.0]?, self.place(from)?);
                let (s, off) = (direction.dot(at - place), direction.cross(at - place));
                let here = self.turned(direction).angle();
                let angle = self.counted(turning, reference, here);
                let k = self.slide(d, g, name.clone(), s);
                let mut parts = vec![(self.variables[k].symbol(0), angle.clone())];
                if off.abs() > SOUND * self.at.extent() {
                    let square = VectorAngle {
                        plus: rounded(wrapped(angle.plus + std::f64::consts::FRAC_PI_2)),
                        ..angle
                    };
                    parts.push((Formula::symbol(format!("e_{{{name}}}"), off), square));
                }
                Some(self.sum(corner, &parts))
            }
            Path::Arc { centre, radius } => {
                let of_guide = match guide.path {
                    GuidePath::Arc { centre, .. } => centre,
                    GuidePath::Line { .. } => return None,
                };
                let corner = self.place(of_guide)?;
                let here = self.turned(at - centre).angle();
                let s = told.unwrap_or(radius * here);
                let k = self.slide(d, g, name.clone(), s);
                let symbol = Formula::symbol(format!("\\rho_{{{name}}}"), radius);
                let turn = self.variables[k].symbol(0).over(symbol.clone());
                let base = self.counted(turning, reference, here - s / radius);
                let fixed = AngleDifference::new(&self.variables, &base, None).formula();
                let angle = match fixed {
                    Formula::Number(_, 0.0) => turn,
                    fixed => Formula::sum([(false, turn), (false, fixed)]),
                };
                let [c, s] =
                    [UnaryFunction::Cos, UnaryFunction::Sin].map(|f| angle.clone().call(f));
                let [x, y] = corner;
                Some([(x, c), (y, s)].map(|(from, part)| {
                    Formula::sum([(false, from), (false, Formula::product([symbol.clone(), part]))])
                }))
            }
        }
    }

    /// Returns the coordinates of a point on a link with a known angle and another known point.
    fn carried(&mut self, p: PointId) -> Option<[Formula; 2]> {
        let scene = self.scene;
        let links: Vec<LinkId> = scene.carriers(p).collect();
        for l in links {
            let Some((turning, reference)) = self.angle(l) else { continue };
            for q in scene.links[l.0].points.iter().copied().filter(|q| *q != p) {
                let Some(corner) = self.place(q) else { continue };
                let arm = self.at.points[p.0]? - self.at.points[q.0]?;
                let angle = self.counted(turning, reference, self.turned(arm).angle());
                let ends = [q, p].map(|p| scene.point_name(p)).concat();
                let length = Formula::symbol(format!("l_{{{}}}", name_label(&ends)), arm.norm());
                return Some(self.sum(corner, &[(length, angle)]));
            }
        }
        None
    }

    /// Returns a direction of the pose as an angle of a variable.
    fn counted(&self, variable: Option<usize>, reference: f64, here: f64) -> VectorAngle {
        let plus = if variable.is_some() { here - reference } else { here };
        VectorAngle { variable, plus: rounded(wrapped(plus)) }
    }

    /// Returns the variable of a driver along a guide.
    fn slide(&mut self, d: usize, g: GuideId, index: String, value: f64) -> usize {
        let driver = &self.scene.drivers[d];
        let known = |v: &LoopVariable| !v.angular && v.driver == Some(d);
        if let Some(k) = self.variables.iter().position(known) {
            return k;
        }
        let along = match self.scene.guides[g.0].on == self.scene.ground {
            true => SlideCarrier::Ground,
            false => SlideCarrier::Link,
        };
        self.variables.push(LoopVariable {
            index,
            link: None,
            angular: false,
            driver: Some(d),
            value,
            rate: driver.rate.value,
            second: driver.acceleration.as_ref().map_or(0.0, |a| a.value),
            along,
        });
        self.variables.len() - 1
    }

    /// Returns a place and vectors, added.
    fn sum(&self, corner: [Formula; 2], parts: &[(Formula, VectorAngle)]) -> [Formula; 2] {
        let [mut x, mut y] = corner.map(|f| vec![(false, f)]);
        for (length, angle) in parts {
            let [c, s] = AngleDifference::new(&self.variables, angle, None).cos_sin();
            x.push((false, Formula::product([length.clone(), c])));
            y.push((false, Formula::product([length.clone(), s])));
        }
        [Formula::sum(x), Formula::sum(y)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hodograph_scene::{Swept, read, templates};
    use hodograph_sweep::follow::PoseFollower;
    use hodograph_sweep::points::seen_from;
    use hodograph_worked::worked::{Scope, work};

    /// The step of the differences (s).
    const H: f64 = 1e-3;

    /// First and second differences of places through time agree with the printed derivatives.
    fn differentiated(name: &str, equations: &CoordinateEquations, place: impl Fn(f64) -> Vec2) {
        let [before, now, after] = [-H, 0.0, H].map(place);
        let of = |order: usize| {
            let [x, y] = equations[order].each_ref().map(|e| e.right.value());
            Vec2::new(x, y)
        };
        for e in equations.iter().flatten() {
            let (left, right) = (e.left.value(), e.right.value());
            assert!((left - right).abs() <= 1e-12 * right.abs().max(1e-3), "{name}");
        }
        let size = now.norm().max(of(1).norm()).max(of(2).norm());
        let first = (after - before) * (0.5 / H);
        let second = (after - now * 2.0 + before) * (1.0 / (H * H));
        assert!((now - of(0)).norm() < 1e-9 * size, "{name}: {now:?} {:?}", of(0));
        assert!((first - of(1)).norm() < 1e-4 * size, "{name}: {first:?} {:?}", of(1));
        assert!((second - of(2)).norm() < 1e-3 * size, "{name}: {second:?} {:?}", of(2));
    }

    #[test]
    fn derivatives_are_those_of_the_places_through_time() {
        let mut frames = 0;
        for name in [
            "lathe",
            "ships",
            "turning-plate",
            "plate-by-law",
            "cart-by-law",
            "disc-on-rod",
            "robot-arm",
        ] {
            let scene = read(templates::get(name).unwrap()).unwrap().value;
            let worked = work(&scene, Scope::Figure).unwrap().value;
            let at = &worked.configuration;
            let all = motion_equations(&scene, at);
            assert!(!all.points.is_empty(), "{name}");
            let follower =
                PoseFollower::new(&scene, &worked.mechanism, &worked.demand, at, Swept::Time);
            let pose = |t: f64| if t == 0.0 { at.clone() } else { follower.at(at, t).unwrap() };
            for p in &all.points {
                let absolute = |t: f64| pose(t).points[p.of.0].unwrap().to_vec2();
                differentiated(name, p.absolute.as_ref().unwrap(), absolute);
                for f in &p.frames {
                    for e in f.from_relative.iter().flatten().chain(&f.sizes) {
                        assert!((e.left.value() - e.right.value()).abs() < 1e-12, "{name}");
                    }
                    let relative = |t: f64| {
                        let there = pose(t);
                        let origin = at.points[f.origin.0].unwrap();
                        match f.frame {
                            Frame::Link(l) => {
                                let axis = at.direction(&scene, l).unwrap().unit().unwrap();
                                let seen = seen_from(&there, at, p.of, l).unwrap() - origin;
                                Vec2::new(axis.dot(seen), axis.cross(seen))
                            }
                            Frame::Point(_) => {
                                there.points[p.of.0].unwrap() - there.points[f.origin.0].unwrap()
                            }
                        }
                    };
                    differentiated(name, &f.relative, relative);
                    frames += 1;
                }
            }
        }
        assert!(frames >= 7, "{frames}");
    }
}
