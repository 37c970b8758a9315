//! Offset slider-crank with a time ratio.
//!
//! With the stroke H, the offset e and the crank angle θ between the limits: b² − a² = He/sin θ
//! (twice the area of A C₁ C₂ is He and AC₁·AC₂ sin θ) and a² + b² = H²/2 + He cot θ (law of
//! cosines). Instead of e the crank or the rod may be given: 2a² = H²/2 − He tan(θ/2), 2b² = H²/2 +
//! He cot(θ/2). Without a quick return e = 0 and a = H/2.

mod explained;

use super::StrokeRatio;
use super::bar::GivenBar;
use crate::board::{PaperLine, SynthesisBoard, Weight};
use crate::candidate::{Demand, DesignNumber, Draft, WantedPosition, deg, mm};
use crate::form::TaskForm;
use crate::fourbar::{Heading, headed, omega};
use crate::{Proof, Statement, TaskResult, Wish};
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::digits::{metres, significant};
use hodograph_base::geom::Point;
use serde_json::{Value as Json, json};

#[derive(Clone, Debug)]
struct SliderCrank {
    ratio: StrokeRatio,
    stroke: f64,
    third: ThirdGiven,
}

/// The given in addition to K and the stroke.
#[derive(Clone, Copy, Debug)]
enum ThirdGiven {
    Offset(f64),
    Crank(f64),
    Rod(f64),
    /// None: the offset that minimises the greatest pressure angle.
    Best,
}

pub(super) fn read(form: &TaskForm) -> Option<Box<dyn Wish>> {
    let ratio = StrokeRatio::read(form);
    let stroke = form.need_size("stroke", "\"50 mm\"");
    let given: Vec<&str> = ["offset", "crank", "rod"].into_iter().filter(|k| form.has(k)).collect();
    let third = match given.as_slice() {
        ["offset"] => form.length("offset").map(ThirdGiven::Offset),
        ["crank"] => form.size("crank").map(ThirdGiven::Crank),
        ["rod"] => form.size("rod").map(ThirdGiven::Rod),
        [] if form.has("best") => form.choice("best", &["transmission"]).map(|_| ThirdGiven::Best),
        [_, second, ..] => {
            let message = both!(
                "`{}` are given, one of which follows from the others, K and the stroke",
                given.join("`, `")
            );
            let help = both!("keep one of them");
            form.fault(Diagnostic::error("given-twice", message).at(form.span(second)).help(help));
            None
        }
        _ => {
            let message = both!("one of `offset`, `crank`, `rod` is given beside K and the stroke");
            form.fault(Diagnostic::error("missing-key", message).at(form.span("stroke")).help(both!(
                "add \"offset\": \"20 mm\", or \"best\": \"transmission\" for the least pressure angle"
            )));
            None
        }
    };
    Some(Box::new(SliderCrank { ratio: ratio?, stroke: stroke?, third: third? }))
}

/// The offset with the least greatest pressure angle, sin α = (a + e)/b, for a stroke h and t =
/// tan(θ/2): scanned, then the zero of its slope bisected.
fn best_offset(h: f64, t: f64) -> f64 {
    const STEPS: usize = 400;
    let most = h / (2.0 * t);
    let lengths = |e: f64| {
        [(h * (h / 4.0 - e * t / 2.0)).max(0.0).sqrt(), (h * (h / 4.0 + e / (2.0 * t))).sqrt()]
    };
    let sine = |e: f64| {
        let [a, b] = lengths(e);
        (a + e) / b
    };
    // An expression with the sign of the slope: a' = −ht/4a, b' = h/4tb.
    let slope = |e: f64| {
        let [a, b] = lengths(e);
        (1.0 - h * t / (4.0 * a)) * b - (a + e) * h / (4.0 * t * b)
    };
    let place = |k: usize| most * k as f64 / STEPS as f64;
    let least = (1..STEPS).min_by(|p, q| sine(place(*p)).total_cmp(&sine(place(*q)))).unwrap_or(1);
    let (mut low, mut high) = (place(least - 1), place(least + 1));
    for _ in 0..80 {
        let middle = (low + high) / 2.0;
        if slope(middle) < 0.0 { low = middle } else { high = middle }
    }
    (low + high) / 2.0
}

impl Wish for SliderCrank {
    fn title(&self) -> Both {
        both!("Slider-crank with time ratio {}", significant(self.ratio.k, 4))
    }

    fn solve(&self, heading: &Heading) -> Result<TaskResult, Faults> {
        let [a, b, e] = self.lengths()?;
        Ok(TaskResult {
            drafts: vec![self.draft([a, b, e], heading)],
            notes: self.ratio.notes(),
            ..TaskResult::default()
        })
    }

    fn construct(&self, draft: &Draft, board: &mut SynthesisBoard) -> Option<()> {
        let offset = draft.numbers.iter().find(|n| n.name == "e")?.value;
        let way = |k: usize| move |board: &mut SynthesisBoard| self.drawn(board, offset, k);
        board.meant(draft, &[&way(0), &way(1)])
    }

    fn statement(&self) -> Statement {
        self.stated()
    }

    fn proof(&self, draft: &Draft) -> Vec<Proof> {
        self.proved(draft)
    }
}

impl SliderCrank {
    /// Draws C₁C₂ as the stroke, and A on the circle over it with the inscribed angle θ, at the
    /// offset.
    fn drawn(&self, board: &mut SynthesisBoard, offset: f64, k: usize) -> Option<()> {
        if self.ratio.theta == 0.0 {
            return None;
        }
        let (c2, c1) = (Point::ORIGIN, Point::new(board.mm(self.stroke), 0.0));
        board.step(both!("Lay off the stroke C1C2 on the guide"));
        board.line(c2, c1, Weight::Given).mark("C_1", c1).mark("C_2", c2);
        let theta = significant(self.ratio.theta.to_degrees(), 4);
        board.step(both!(
            "Over C1C2 draw the circle with the inscribed angle θ = {theta}°: 90° − θ from the chord at both ends gives its centre"
        ));
        let (centre, radius) = board.inscribed(c2, c1, self.ratio.theta, false)?;
        board.mark("O", centre);
        let bar = match self.third {
            ThirdGiven::Crank(l) => Some(GivenBar::Crank(l)),
            ThirdGiven::Rod(l) => Some(GivenBar::Coupler(l)),
            ThirdGiven::Offset(_) | ThirdGiven::Best => None,
        };
        let a = match bar {
            Some(bar) => {
                let a =
                    bar.place(board, [c1, c2], (self.ratio.theta, true), (centre, radius), k)?;
                let foot = Point::new(a.x, 0.0);
                board.line(a, foot, Weight::Thin).mark("A", a).read("e", a, foot);
                a
            }
            None => {
                let level = PaperLine::ray(Point::new(0.0, -board.mm(offset)), 0.0);
                let a = board.cut(&level, centre, radius)?[k];
                board.step(both!(
                    "The parallel to the guide at the offset {} meets the circle at A",
                    metres(offset)
                ));
                board
                    .line(level.place(a.x.min(0.0)), level.place(a.x.max(0.0)), Weight::Thin)
                    .mark("A", a);
                a
            }
        };
        board.line(a, c1, Weight::Thin).line(a, c2, Weight::Thin);
        board.halve(a, [c1, c2])
    }

    /// The lengths of crank and rod, and the offset (m).
    fn lengths(&self) -> Result<[f64; 3], Faults> {
        let (h, theta) = (self.stroke, self.ratio.theta);
        if theta == 0.0 {
            return self.centric();
        }
        let t = libm::tan(theta / 2.0);
        let e = match self.third {
            ThirdGiven::Offset(e) => e,
            ThirdGiven::Crank(a) => (h * h / 2.0 - 2.0 * a * a) / (h * t),
            ThirdGiven::Rod(b) => (2.0 * b * b - h * h / 2.0) * t / h,
            ThirdGiven::Best => best_offset(h, t),
        };
        let most = h / (2.0 * t);
        let off = e.abs();
        let a2 = h * (h / 4.0 - off * t / 2.0);
        if e == 0.0
            || a2 <= 0.0
            || matches!(self.third, ThirdGiven::Crank(_) | ThirdGiven::Rod(_)) && e < 0.0
        {
            let message = match self.third {
                ThirdGiven::Offset(_) if e == 0.0 => {
                    both!("without an offset the slider has no quick return: K would be 1")
                }
                ThirdGiven::Offset(_) => {
                    both!(
                        "with the offset {} the square of the crank comes out negative",
                        metres(off)
                    )
                }
                ThirdGiven::Crank(_) | ThirdGiven::Rod(_) | ThirdGiven::Best => {
                    both!("no offset gives this length: its value would be {}", metres(e))
                }
            };
            let (key, range) = match self.third {
                ThirdGiven::Offset(_) | ThirdGiven::Best => ("offset", [0.0, most]),
                ThirdGiven::Crank(_) => ("crank", [0.0, h / 2.0]),
                ThirdGiven::Rod(_) => ("rod", [h / 2.0, h / (2.0 * libm::sin(theta / 2.0))]),
            };
            let help = both!(
                "for this stroke and K `{key}` lies between {} and {}, neither included",
                metres(range[0]),
                metres(range[1])
            );
            return Err(Diagnostic::error("no-real-solution", message).help(help).into());
        }
        let b2 = h * (h / 4.0 + off / (2.0 * t));
        Ok([a2.sqrt(), b2.sqrt(), e])
    }

    fn centric(&self) -> Result<[f64; 3], Faults> {
        match self.third {
            ThirdGiven::Rod(b) if b > self.stroke / 2.0 => Ok([self.stroke / 2.0, b, 0.0]),
            ThirdGiven::Offset(_)
            | ThirdGiven::Crank(_)
            | ThirdGiven::Rod(_)
            | ThirdGiven::Best => {
                let message = both!(
                    "with K = 1 the slider-crank is centric: the crank is half the stroke, the rod is free"
                );
                let help = both!("give \"rod\", longer than {}", metres(self.stroke / 2.0));
                Err(Diagnostic::error("free-choice", message).help(help).into())
            }
        }
    }

    fn draft(&self, [a, b, e]: [f64; 3], heading: &Heading) -> Draft {
        // The slider's limits: crank and rod stretched, then folded.
        let at = |reach: f64| Point::new(((reach - e.abs()) * (reach + e.abs())).sqrt(), e);
        let wanted = [(b + a, 1.0), (b - a, -1.0)].map(|(reach, sense)| {
            let c = at(reach);
            let crank = c.to_vec2() * (sense / reach);
            WantedPosition {
                driver: crank.angle(),
                places: vec![("B".into(), (crank * a).to_point()), ("C".into(), c)],
            }
        });
        let (off, swing) = (e.abs(), ((a + e.abs()) / b).min(1.0));
        let numbers = vec![
            DesignNumber::length("AB", both!("crank"), a),
            DesignNumber::length("BC", both!("rod"), b),
            DesignNumber::length("e", both!("offset"), off),
            DesignNumber::length("H", both!("stroke"), self.stroke),
            DesignNumber::angle(
                "theta",
                both!("crank angle between the limit positions"),
                self.ratio.theta,
            ),
            DesignNumber::angle(
                "alpha_max",
                both!("greatest pressure angle, the crank square to the guide"),
                libm::asin(swing),
            ),
            DesignNumber::ratio("K", both!("time ratio"), self.ratio.k),
        ];
        let demands =
            vec![Demand::FullTurn, Demand::TimeRatio(self.ratio.k), Demand::Stroke(self.stroke)];
        let slow = super::slow_stroke(wanted[0].driver, wanted[1].driver, heading.omega);
        let driver = wanted[0].driver;
        Draft {
            demands,
            remarks: vec![slow],
            ..Draft::new(
                both!("the only solution"),
                scene([a, b, e], driver, at(b + a), heading),
                numbers,
                wanted.into(),
            )
        }
    }
}

fn scene([a, b, e]: [f64; 3], crank: f64, c: Point, heading: &Heading) -> Json {
    let mut scene = headed(heading);
    scene.insert("links".into(), json!({"1": ["A", "B"], "2": ["B", "C"], "4": ["A"]}));
    scene.insert("ground".into(), json!("4"));
    scene.insert("points".into(), json!({"A": [0, 0]}));
    scene.insert("lengths".into(), json!({"AB": mm(a), "BC": mm(b)}));
    scene.insert("guides".into(), json!([{"pin": "C", "slider": "3", "on": "4", "through": "A", "angle": "0 deg", "offset": mm(e)}]));
    scene.insert(
        "driver".into(),
        json!({"link": "1", "angle": deg(crank), "omega": omega(heading.omega)}),
    );
    scene.insert("sketch".into(), sketch(&[("C", c)]));
    scene.insert("find".into(), json!(["v_C", "a_C", "omega_2"]));
    Json::Object(scene)
}

/// Approximate places that determine the assembly, in units of the scene's first length (mm).
pub(crate) fn sketch(points: &[(&str, Point)]) -> Json {
    let all = points.iter().map(|(name, p)| ((*name).to_owned(), json!([mm(p.x), mm(p.y)])));
    Json::Object(all.collect())
}
