//! `s_3`, `psi_3`, `h_3`, `Psi_3`, `Phi_3`, `pressure_3`, `rho_2/3`, `rho_min_2`: of a disc cam and its follower.
//!
//! They follow from the geometry of the cam alone ([`crate::cam`]), in double precision: no more digits than those are vouched for. Where no one link
//! carries cam and follower, the pressure angle and the radius of curvature are those of the pose: of a round end's way against the normal at the contact,
//! and of the arc that is touched.

use super::along::along;
use super::{Entry, Form, Known, Level, Meaning, Need, Of, Over, Quantity, Value};
use crate::cam::Follower;
use crate::diag::{Both, Diagnostic, both};
use crate::geom::Vec2;
use crate::number::Real;
use crate::scene::book::Kind;
use crate::scene::cams::{Cam, Turning};
use crate::scene::model::{Find, GuideId, GuidePath, LinkId, PointId, Scene};
use crate::scene::resolve::Question;

/// Of a cam and its follower.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CamQuantity {
    what: What,
    /// The follower; of ρ the cam.
    link: LinkId,
    /// The follower of ρ.
    follower: Option<LinkId>,
    /// The point of a round end.
    end: Option<PointId>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum What {
    Lift,
    Swing,
    Stroke,
    Angle,
    Rise,
    Pressure,
    Rho,
    RhoMin,
}

/// Rows of the table.
const ROWS: [What; 7] = [What::Lift, What::Swing, What::Stroke, What::Angle, What::Rise, What::Pressure, What::Rho];

/// What double precision keeps of a value that is computed from given lengths, relative to it.
const LOST: f64 = 1e-11;

impl Quantity for CamQuantity {
    const WRITTEN: &'static [Entry] = &[
        Entry::new("s", "s_3", Kind::Length, Form::Scalar, ["lift of the follower", "从动件位移"]),
        Entry::new("psi", "psi_3", Kind::Angle, Form::Scalar, ["lift of the swinging follower", "摆动从动件角位移"])
            .printed("\\psi", Over::Nothing),
        Entry::new("h", "h_3", Kind::Length, Form::Scalar, ["stroke of the follower", "行程"]),
        Entry::new("Psi", "Psi_3", Kind::Angle, Form::Scalar, ["swing of the follower", "最大摆角"]).printed("\\Psi", Over::Nothing),
        Entry::new("Phi", "Phi_3", Kind::Angle, Form::Scalar, ["angle of the rise", "推程运动角"]).printed("\\Phi", Over::Nothing),
        Entry::new("pressure", "pressure_3", Kind::Angle, Form::Scalar, ["pressure angle", "压力角"]).printed("\\alpha", Over::Sign("p")),
        Entry::new("rho", "rho_2/3", Kind::Length, Form::Scalar, ["radius of curvature of the profile", "廓线曲率半径"])
            .printed("\\rho", Over::Nothing),
    ];

    fn read(question: &Question<'_>) -> Result<Option<CamQuantity>, Diagnostic> {
        let what = ROWS[question.row(Self::WRITTEN)];
        let names = question.names();
        if what == What::Rho {
            if let Some(cam) = names.strip_prefix("min_") {
                return Ok(Some(CamQuantity { what: What::RhoMin, link: question.link(cam.trim())?, follower: None, end: None }));
            }
            let Some((cam, follower)) = names.split_once('/') else {
                let d = question.fault(both!(
                    "`{}` does not say of which cam and follower",
                    "`{}` 没有说明是哪个凸轮和从动件",
                    question.text()
                ));
                return Err(d.help(both!(
                    "write rho_2/3: of cam 2 at follower 3; or rho_min_2",
                    "请写 rho_2/3（凸轮 2 与从动件 3 接触处），或 rho_min_2"
                )));
            };
            let (link, follower) = (question.link(cam.trim())?, question.link(follower.trim())?);
            return Ok(Some(CamQuantity { what, link, follower: Some(follower), end: None }));
        }
        // What slides and is no follower has a coordinate along its guide.
        if what == What::Lift && !question.is_follower(names) {
            return Ok(None);
        }
        let link = question.link(names)?;
        let end = (what == What::Pressure).then(|| question.end_of(link)).flatten();
        Ok(Some(CamQuantity { what, link, follower: None, end }))
    }

    fn entry(&self) -> &'static Entry {
        let what = if self.what == What::RhoMin { What::Rho } else { self.what };
        &Self::WRITTEN[ROWS.iter().position(|w| *w == what).unwrap_or(0)]
    }

    fn of(&self) -> Of {
        self.follower.map_or(Of::Link(self.link), |f| Of::Links(self.link, f))
    }

    fn meaning(&self, _scene: &Scene) -> Option<Meaning> {
        None
    }

    fn no_value(&self, scene: &Scene) -> Both {
        let link = scene.link_name(self.link);
        match self.what {
            What::RhoMin => both!("the profile of cam {link} is nowhere convex", "凸轮 {link} 的廓线没有外凸部分"),
            What::Rho => {
                both!("the profile of cam {link} is straight there, or touches nothing", "凸轮 {link} 的廓线在该处为直线，或没有接触")
            }
            What::Lift | What::Swing | What::Stroke | What::Angle | What::Rise | What::Pressure => {
                both!("the follower {link} touches nothing in this pose", "从动件 {link} 在该位置没有接触")
            }
        }
    }

    fn needs(&self) -> Vec<(Need, Level)> {
        // Where the geometry of the cam does not tell it, the places of what touches do.
        self.end.map(|p| (Need::Point(p, None), Level::Position)).into_iter().collect()
    }

    fn fault(&self, scene: &Scene, find: &Find) -> Option<Diagnostic> {
        let Some((cam, t)) = self.cam(scene) else {
            if self.pair(scene).is_some_and(|c| self.of_the_pose(scene, c)) {
                return None;
            }
            let d = Diagnostic::error(
                "no-cam",
                both!(
                    "`{}` needs a cam that turns about a pin of the link in which its follower slides or turns",
                    "`{}` 需要绕从动件导路（或转轴）所在构件上一点转动的凸轮",
                    find.text
                ),
            );
            let d = d.at(find.span);
            return Some(match self.pair(scene) {
                None => d,
                Some(pair) => {
                    let [cam, follower] = [pair.cam, pair.follower].map(|l| scene.link_name(l));
                    d.help(both!(
                        "no link carries both the pivot of cam `{cam}` and the guide or pivot of `{follower}`: list the pivot in \"links\" among the points of the ground, or of the link that carries the follower",
                        "没有构件同时支承凸轮 `{cam}` 的轴心和 `{follower}` 的导路或转轴：请在 \"links\" 中把轴心写入机架（或支承从动件的构件）的点"
                    ))
                }
            });
        };
        let swings = matches!(t.disc.follower, Follower::Oscillating { .. });
        let wrong = match self.what {
            What::Lift | What::Stroke => swings,
            What::Swing | What::Angle => !swings,
            What::Rise | What::Pressure | What::Rho | What::RhoMin => false,
        };
        wrong.then(|| {
            let name = scene.link_name(cam.follower);
            let (kind, help) = if swings {
                (both!("swings", "摆动"), both!("ask for psi_{name} and Psi_{name}", "请求 psi_{name} 和 Psi_{name}"))
            } else {
                (both!("slides", "移动"), both!("ask for s_{name} and h_{name}", "请求 s_{name} 和 h_{name}"))
            };
            Diagnostic::error("cam-follower", both!("follower `{name}` {}", "从动件 `{name}` 作{}", kind)).at(find.span).help(help)
        })
    }

    fn value<N: Real, K: Known<N>>(&self, known: &K) -> Option<Value<N>> {
        let Some((_, t)) = self.cam(known.scene()) else { return self.posed(known) };
        let value = match self.what {
            What::Lift | What::Swing => t.disc.coordinate(t.phi, t.side)?.value() - t.survey.of(&t.disc).rest,
            What::Stroke | What::Angle => t.survey.of(&t.disc).stroke,
            What::Rise => t.survey.of(&t.disc).angle(1, false),
            What::Pressure => t.disc.station(t.phi, t.side)?.pressure,
            What::Rho => t.disc.station(t.phi, t.side)?.rho,
            What::RhoMin => least_radius(t)?,
        };
        let radius = LOST * value.abs().max(LOST);
        N::from_bounded(value, radius).filter(|_| value.is_finite()).map(Value::Scalar)
    }
}

/// The least convex radius of the profile.
fn least_radius(t: &Turning) -> Option<f64> {
    let (_, rho) = t.survey.of(&t.disc).least_rho?;
    let end = match t.disc.touch {
        crate::cam::Touch::Point { radius } => radius,
        crate::cam::Touch::Flat { .. } => 0.0,
    };
    Some(rho - end)
}

impl CamQuantity {
    /// The cam that is meant.
    fn cam<'s>(&self, scene: &'s Scene) -> Option<(&'s Cam, &'s Turning)> {
        let cam = self.pair(scene)?;
        Some((cam, cam.disc.as_ref()?))
    }

    /// Whether it is of the pose, whatever carries the cam.
    fn of_the_pose(&self, scene: &Scene, cam: &Cam) -> bool {
        match self.what {
            What::Rho => cam.touched_radius().is_some(),
            What::Pressure => {
                cam.follows.radius().is_some() && (cam.contact.is_some() || cam.is_on_course()) && way_of(scene, cam).is_some()
            }
            What::Lift | What::Swing | What::Stroke | What::Angle | What::Rise | What::RhoMin => false,
        }
    }

    /// Its value in the pose.
    fn posed<N: Real, K: Known<N>>(&self, known: &K) -> Option<Value<N>> {
        let scene = known.scene();
        let cam = self.pair(scene)?;
        let number = |x: f64| N::from_bounded(x, x.abs() * LOST);
        if self.what == What::Rho {
            return number(cam.touched_radius()?.abs()).map(Value::Scalar);
        }
        let end = known.point(cam.follows.point())?;
        let normal = match cam.contact.map(|g| &scene.guides[g.0]) {
            Some(guide) => match guide.path {
                GuidePath::Arc { centre, .. } => end - known.point(centre)?,
                GuidePath::Line { .. } => along(known, guide)?.perp(),
            },
            None => cam.touched_on_course(&|p| known.point(p))?.1,
        };
        let way = match way_of(scene, cam)? {
            Way::Guide(g) => along(known, &scene.guides[g.0])?,
            Way::Pivot(p) => (end - known.point(p)?).perp(),
        };
        let magnitude = |x: N| if x.approx() < 0.0 { -x } else { x };
        let (n, w) = (normal.unit()?, way.unit()?);
        Some(Value::Scalar(Vec2 { x: magnitude(n.dot(w)), y: magnitude(n.cross(w)) }.angle()))
    }

    /// The pair that is meant, wherever its cam turns.
    fn pair<'s>(&self, scene: &'s Scene) -> Option<&'s Cam> {
        let meant = |c: &&Cam| match (self.what, self.follower) {
            (What::Rho, follower) => c.cam == self.link && follower == Some(c.follower),
            (What::RhoMin, _) => c.cam == self.link,
            (What::Lift | What::Swing | What::Stroke | What::Angle | What::Rise | What::Pressure, _) => c.follower == self.link,
        };
        scene.cams.iter().find(meant)
    }
}

/// On what a follower moves.
enum Way {
    Guide(GuideId),
    Pivot(PointId),
}

/// The guide in which a follower slides, or the pivot about which it turns.
fn way_of(scene: &Scene, cam: &Cam) -> Option<Way> {
    let slides = scene.guides.iter().position(|g| g.slider == Some(cam.follower)).map(|g| Way::Guide(GuideId(g)));
    let joint = |p: &PointId| *p != cam.follows.point() && scene.carriers(*p).any(|l| l != cam.follower);
    slides.or_else(|| scene.links[cam.follower.0].points.iter().copied().find(joint).map(Way::Pivot))
}
