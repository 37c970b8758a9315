//! Straight lines, `"synthesis": "straight-line"`: linkages with a point E that moves on a nearly
//! or exactly straight line of the wanted length.
//!
//! Watt: two rods of 5 and a coupler of 2, E its midpoint. Chebyshev: frame 4, crossed rods 5,
//! coupler 2, E its midpoint, over the frame's length. Roberts: frame 2, coupler 1, rods and the
//! sides of the coupler's triangle 1.2, E its apex, from pivot to pivot. Hoeken: crank 1, frame 2,
//! coupler and rocker 2.5, BE twice BC, over half a turn of the crank; other `ratios` may be given.
//! Exact linkages are Scott-Russell's crank on the midpoint of a rod with a sliding end, and
//! Peaucellier's inversor, OC · OP = L² − s². Length and deviation are those of the finished scene,
//! swept, with the extremes located.

mod drawing;
mod explained;

use super::board::SynthesisBoard;
use super::candidate::{DesignNumber, Draft, WantedPosition, deg, mm, place, scene_text};
use super::form::TaskForm;
use super::fourbar::{FourBar, Heading, headed, meet, omega};
use super::{KindOfTask, Proof, Statement, TaskResult, Wish};
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::digits::{metres, significant};
use hodograph_base::geom::{Point, Vec2};
use hodograph_base::lang::each;
use hodograph_mechanism::mechanism::Mechanism;
use hodograph_scene as scene;
use hodograph_sweep::zoom::{self, SoughtExtreme, extreme_row};
use hodograph_sweep::{PlacedScene, Stations, Width, of_values, run};
use serde_json::{Value as Json, json};
use std::f64::consts::{FRAC_PI_2, PI};

/// Straight lines as a kind of task.
pub const KIND: KindOfTask = KindOfTask {
    name: "straight-line",
    what: each!(
        "straight-line linkages: Watt, Chebyshev, Roberts, Hoeken, Scott-Russell, Peaucellier"
    ),
    keys: &["linkage", "length", "swing", "ratios"],
    read,
};

/// The linkages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Linkage {
    Watt,
    Chebyshev,
    Roberts,
    Hoeken,
    ScottRussell,
    Peaucellier,
}

const NAMES: [(&str, Linkage); 6] = [
    ("watt", Linkage::Watt),
    ("chebyshev", Linkage::Chebyshev),
    ("roberts", Linkage::Roberts),
    ("hoeken", Linkage::Hoeken),
    ("scott-russell", Linkage::ScottRussell),
    ("peaucellier", Linkage::Peaucellier),
];

/// Half the driver's swing if the file gives none (rad): of Watt's linkage, whose deviation grows
/// with its fifth power, and of the others.
const WATT_SWING: f64 = 20.0 * PI / 180.0;
const SWING: f64 = 45.0 * PI / 180.0;
/// A swing read from degrees may exceed the printed greatest swing by this much (rad).
const ROUNDING: f64 = 1e-12;
/// Number of steps of a sweep between which extremes are located.
const STEPS: usize = 360;
/// The angle by which a located range falls short of a limit of the driver (rad).
const SHORT: f64 = 1e-13;

#[derive(Clone, Debug)]
struct StraightLineTask {
    linkage: Linkage,
    /// The wanted length (m).
    length: f64,
    /// Half the driver's swing, to either side of the middle (rad).
    swing: f64,
    /// Frame and rods over the crank, for Hoeken's linkage.
    ratios: [f64; 2],
}

fn read(form: &TaskForm) -> Option<Box<dyn Wish>> {
    form.need("linkage", "\"hoeken\"")?;
    let name = form.choice("linkage", &NAMES.map(|n| n.0));
    let length = form.need_size("length", "\"200 mm\"");
    let linkage = NAMES.iter().find(|n| Some(n.0) == name)?.1;
    let usual = if linkage == Linkage::Watt { WATT_SWING } else { SWING };
    let swings = matches!(linkage, Linkage::Watt | Linkage::ScottRussell | Linkage::Peaucellier);
    let swing = if form.has("swing") { form.angle("swing")? / 2.0 } else { usual };
    // Beyond 27.02° one of Watt's rods passes its dead centre; beyond 2 arccos(3.5/4) = 57.91° C is
    // too near for Peaucellier's arms.
    let most = match linkage {
        Linkage::Watt => 27.0_f64.to_radians(),
        Linkage::Peaucellier => 57.5_f64.to_radians(),
        Linkage::Chebyshev | Linkage::Roberts | Linkage::Hoeken | Linkage::ScottRussell => {
            89.0_f64.to_radians()
        }
    };
    let taken = swings && swing > 0.0 && swing <= most + ROUNDING;
    if form.has("swing") && !taken {
        let message = if swings {
            both!(
                "\"swing\" is to be more than 0 and at most {}°",
                significant(2.0 * most.to_degrees(), 3)
            )
        } else {
            both!("this linkage has its own range; it takes no \"swing\"")
        };
        form.fault(Diagnostic::error("out-of-range", message).at(form.span("swing")));
        return None;
    }
    let ratios = if form.has("ratios") { ratios(form, linkage)? } else { [2.0, 2.5] };
    Some(Box::new(StraightLineTask { linkage, length: length?, swing, ratios }))
}

/// Reads frame and rods of Hoeken's linkage over its crank.
fn ratios(form: &TaskForm, linkage: Linkage) -> Option<[f64; 2]> {
    let [p, q] = form.several::<2>(form.node("ratios")?, "ratios", "[2, 2.5]")?;
    let (frame, rod) = (form.number_of(p, "ratios")?, form.number_of(q, "ratios")?);
    // The crank is the shortest link and turns fully, and the dyad closes: s + l < p + q.
    let turns = frame > 1.0 && rod > 1.0 && 1.0 + frame < 2.0 * rod;
    if linkage == Linkage::Hoeken && turns {
        return Some([frame, rod]);
    }
    let message = if linkage == Linkage::Hoeken {
        both!(
            "frame {frame} and rods {rod} over a crank of 1 do not let it turn: both must be more than 1, and 1 + frame less than twice the rod"
        )
    } else {
        both!("\"ratios\" are of Hoeken's linkage alone")
    };
    let help = if linkage == Linkage::Hoeken {
        nearest_ratios([frame, rod])
    } else {
        both!("leave it out")
    };
    form.fault(Diagnostic::error("out-of-range", message).at(form.span("ratios")).help(help));
    None
}

/// The nearest feasible ratios, a hundredth inside the change point, to three decimals.
fn nearest_ratios([frame, rod]: [f64; 2]) -> Both {
    let up = |v: f64| (v * 1e3).ceil() / 1e3;
    let frame = up(frame.max(1.01));
    let rod = up(rod.max(0.505 * (1.0 + frame)));
    both!("write [{frame}, {rod}]")
}

/// A linkage at a scale: its scene, the driver's range, the axis of the line, and the places of E
/// at the ends and the middle.
struct ScaledLinkage {
    scene: Json,
    range: [f64; 2],
    /// The direction of the line, `x` or `y`.
    along: char,
    wanted: Vec<WantedPosition>,
    numbers: Vec<DesignNumber>,
}

impl StraightLineTask {
    /// The name of the linkage.
    fn name(&self) -> Both {
        match self.linkage {
            Linkage::Watt => both!("Watt"),
            Linkage::Chebyshev => both!("Chebyshev"),
            Linkage::Roberts => both!("Roberts"),
            Linkage::Hoeken => both!("Hoeken"),
            Linkage::ScottRussell => both!("Scott Russell"),
            Linkage::Peaucellier => both!("Peaucellier"),
        }
    }

    /// The length along the line at scale 1.
    fn unit_length(&self) -> f64 {
        let s = self.swing;
        match self.linkage {
            Linkage::Watt => {
                watt(1.0).e_at(s).zip(watt(1.0).e_at(-s)).map_or(f64::NAN, |(p, q)| p.y - q.y)
            }
            Linkage::Chebyshev => 4.0,
            Linkage::Roberts => 2.0,
            Linkage::Hoeken => {
                let l = hoeken(1.0, self.ratios);
                l.e_at(FRAC_PI_2)
                    .zip(l.e_at(3.0 * FRAC_PI_2))
                    .map_or(f64::NAN, |(p, q)| (p.x - q.x).abs())
            }
            Linkage::ScottRussell => 4.0 * libm::sin(s),
            Linkage::Peaucellier => 2.0 * inversor(1.0, s).map_or(f64::NAN, |p| p[3].y),
        }
    }

    fn made(&self, k: f64, heading: &Heading) -> Option<ScaledLinkage> {
        let s = self.swing;
        let four = |l: FourBar, range: [f64; 2], along: char, middle: f64| {
            let wanted = [middle, range[0], range[1]].map(|at| {
                Some(WantedPosition { driver: at, places: vec![("E".into(), l.e_at(at)?)] })
            });
            let mut numbers = super::fourbar::named_lengths(l.lengths());
            numbers.push(DesignNumber::length(
                "BE",
                both!("to the point that runs straight"),
                l.e.map_or(0.0, Vec2::norm),
            ));
            Some(ScaledLinkage {
                scene: l.scene(heading),
                range,
                along,
                wanted: wanted.into_iter().flatten().collect(),
                numbers,
            })
        };
        match self.linkage {
            Linkage::Watt => four(watt(k), [-s, s], 'y', 0.0),
            Linkage::Hoeken => four(hoeken(k, self.ratios), [FRAC_PI_2, 3.0 * FRAC_PI_2], 'x', PI),
            Linkage::Chebyshev => {
                let l = chebyshev(k);
                let low = libm::atan2(3.0, 4.0);
                four(l, [low + SHORT, FRAC_PI_2], 'x', libm::atan2(4.0, 3.0))
            }
            Linkage::Roberts => {
                // E in D: B is above the midpoint of AD. E in A: C is there; AB leads AC by half
                // the coupler's angle twice.
                let from = libm::acos(1.0 / ROBERTS);
                let to = from + 2.0 * libm::asin(0.5 / ROBERTS);
                four(roberts(k), [from, to], 'x', libm::acos(0.5 / ROBERTS))
            }
            Linkage::ScottRussell => {
                let place_of = |at: f64| Point::new(0.0, 2.0 * k * libm::sin(at));
                let wanted = [0.3 * s, -s, s].map(|at| WantedPosition {
                    driver: at,
                    places: vec![("E".into(), place_of(at))],
                });
                let numbers = vec![
                    DesignNumber::length("AB", both!("crank"), k),
                    DesignNumber::length("CE", both!("rod"), 2.0 * k),
                ];
                Some(ScaledLinkage {
                    scene: scott_russell(k, 0.3 * s, heading),
                    range: [-s, s],
                    along: 'y',
                    wanted: wanted.into(),
                    numbers,
                })
            }
            Linkage::Peaucellier => {
                let wanted = [0.5 * s, -s, s].map(|at| {
                    Some(WantedPosition {
                        driver: at,
                        places: vec![("E".into(), inversor(k, at)?[3])],
                    })
                });
                let numbers = vec![
                    DesignNumber::length("KC", both!("crank, and its distance from O"), 2.0 * k),
                    DesignNumber::length("OX", both!("long arms"), 6.0 * k),
                    DesignNumber::length("CX", both!("sides of the rhombus"), 2.5 * k),
                ];
                Some(ScaledLinkage {
                    scene: peaucellier(k, 0.5 * s, heading)?,
                    range: [-s, s],
                    along: 'y',
                    wanted: wanted.into_iter().flatten().collect(),
                    numbers,
                })
            }
        }
    }
}

/// Watt's linkage in its middle position: rods level, coupler upright.
fn watt(k: f64) -> FourBar {
    let at = |x: f64, y: f64| Point::new(k * x, k * y);
    FourBar {
        a: at(0.0, 0.0),
        b: at(5.0, 0.0),
        c: at(5.0, -2.0),
        d: at(10.0, -2.0),
        e: Some(Vec2::new(k, 0.0)),
    }
}

/// Chebyshev's linkage in its middle position: rods crossed, coupler level.
fn chebyshev(k: f64) -> FourBar {
    let at = |x: f64, y: f64| Point::new(k * x, k * y);
    FourBar {
        a: at(0.0, 0.0),
        b: at(3.0, 4.0),
        c: at(1.0, 4.0),
        d: at(4.0, 0.0),
        e: Some(Vec2::new(k, 0.0)),
    }
}

/// Rods, and the equal sides of the coupler's triangle, of Roberts' linkage over its coupler.
const ROBERTS: f64 = 1.2;

/// Roberts' linkage in its middle position: the coupler level, its apex below on the frame.
fn roberts(k: f64) -> FourBar {
    let at = |x: f64, y: f64| Point::new(k * x, k * y);
    let high = (ROBERTS * ROBERTS - 0.25).sqrt();
    FourBar {
        a: at(0.0, 0.0),
        b: at(0.5, high),
        c: at(1.5, high),
        d: at(2.0, 0.0),
        e: Some(Vec2::new(0.5 * k, -high * k)),
    }
}

/// Hoeken's linkage with its crank pointing away from the rocker's pivot: the middle of the
/// straight stretch.
fn hoeken(k: f64, [frame, rod]: [f64; 2]) -> FourBar {
    let (b, d) = (Point::new(-k, 0.0), Point::new(frame * k, 0.0));
    let half = (frame + 1.0) / 2.0 * k;
    let c = Point::new(-k + half, ((rod * k - half) * (rod * k + half)).max(0.0).sqrt());
    FourBar { a: Point::ORIGIN, b, c, d, e: Some(Vec2::new(2.0 * rod * k, 0.0)) }
}

impl FourBar {
    /// E for a crank angle.
    fn e_at(&self, crank: f64) -> Option<Point> {
        let (b, c) = self.at(crank)?;
        self.coupler_point(b, c)
    }
}

/// The points C, X, Y, E of Peaucellier's inversor with K to the right of O, for an angle of the
/// crank KC.
fn inversor(k: f64, crank: f64) -> Option<[Point; 4]> {
    let c = Point::new(2.0 * k, 0.0) + Vec2::from_angle(crank) * (2.0 * k);
    let x = meet(Point::ORIGIN, 6.0 * k, c, 2.5 * k, true)?;
    let y = meet(Point::ORIGIN, 6.0 * k, c, 2.5 * k, false)?;
    Some([c, x, y, c + (x - c) + (y - c)])
}

/// The scene with crank AB on the midpoint B of the rod CE, whose end C slides toward A.
fn scott_russell(k: f64, angle: f64, heading: &Heading) -> Json {
    let mut scene = headed(heading);
    scene.insert("links".into(), json!({"1": ["A", "B"], "2": ["C", "B", "E"], "4": ["A"]}));
    scene.insert("ground".into(), json!("4"));
    scene.insert(
        "points".into(),
        json!({"A": [0, 0], "E": {"base": "CB", "x": mm(2.0 * k), "y": 0}}),
    );
    scene.insert("lengths".into(), json!({"AB": mm(k), "BC": mm(k)}));
    scene.insert(
        "guides".into(),
        json!([{"pin": "C", "slider": "3", "on": "4", "through": "A", "angle": "0 deg"}]),
    );
    scene.insert(
        "driver".into(),
        json!({"link": "1", "angle": deg(angle), "omega": omega(heading.omega)}),
    );
    scene.insert("sketch".into(), json!({"C": place(Point::new(2.0 * k * libm::cos(angle), 0.0))}));
    scene.insert("find".into(), json!(["v_E", "a_E", "v_C"]));
    Json::Object(scene)
}

fn peaucellier(k: f64, angle: f64, heading: &Heading) -> Option<Json> {
    let [c, x, y, e] = inversor(k, angle)?;
    let mut scene = headed(heading);
    let links = json!({"1": ["K", "C"], "2": ["O", "X"], "3": ["O", "Y"], "4": ["C", "X"], "5": ["C", "Y"], "6": ["X", "E"], "7": ["Y", "E"], "8": ["O", "K"]});
    scene.insert("links".into(), links);
    scene.insert("ground".into(), json!("8"));
    scene.insert("points".into(), json!({"O": [0, 0], "K": [mm(2.0 * k), 0]}));
    let (long, short) = (mm(6.0 * k), mm(2.5 * k));
    scene.insert("lengths".into(), json!({"KC": mm(2.0 * k), "OX": long, "OY": long, "CX": short, "CY": short, "EX": short, "EY": short}));
    scene.insert(
        "driver".into(),
        json!({"link": "1", "angle": deg(angle), "omega": omega(heading.omega)}),
    );
    scene.insert(
        "sketch".into(),
        json!({"C": place(c), "X": place(x), "Y": place(y), "E": place(e)}),
    );
    scene.insert("find".into(), json!(["v_E", "a_E"]));
    Some(Json::Object(scene))
}

impl Wish for StraightLineTask {
    fn title(&self) -> Both {
        both!("{}'s straight-line linkage, {} long", self.name(), metres(self.length))
    }

    fn solve(&self, heading: &Heading) -> Result<TaskResult, Faults> {
        let scale = self.length / self.unit_length();
        let none = || {
            Diagnostic::error(
                "no-real-solution",
                both!("the linkage does not reach over this swing"),
            )
        };
        let Some(made) = self.made(scale, heading).filter(|_| scale.is_finite()) else {
            return Err(none().help(both!("take a smaller \"swing\"")).into());
        };
        let measured = measure(&made, self.length)?;
        let mut numbers = made.numbers;
        numbers.extend(measured.numbers());
        let which =
            if measured.deviation == 0.0 { both!("exact") } else { both!("nearly straight") };
        let draft = Draft {
            error: measured.deviation,
            ..Draft::new(which, made.scene, numbers, made.wanted)
        };
        Ok(TaskResult { drafts: vec![draft], numbers: Vec::new(), notes: Vec::new() })
    }

    fn construct(&self, draft: &Draft, board: &mut SynthesisBoard) -> Option<()> {
        self.drawn(draft, board)
    }

    fn statement(&self) -> Statement {
        self.stated()
    }

    fn proof(&self, draft: &Draft) -> Vec<Proof> {
        self.proved(draft)
    }
}

/// A deviation below this share of the length is rounding.
const EXACT: f64 = 1e-11;

/// The share of the length that corresponds to the last [`SHORT`] of the driver before a dead
/// centre: about its square root, with a margin.
const NEXT_TO_DEAD: f64 = 1e-6;

/// Measurements of the finished scene over its range.
struct MeasuredStretch {
    /// The difference of the greatest and the least coordinate along the line (m).
    length: f64,
    /// The difference of the greatest and the least coordinate across the line (m).
    deviation: f64,
    /// The least and the greatest coordinate across the line (m), each with the driver's position.
    extremes: [(f64, f64); 2],
    range: [f64; 2],
}

impl MeasuredStretch {
    fn numbers(&self) -> Vec<DesignNumber> {
        let [(low_at, low), (high_at, high)] = self.extremes;
        let mut out = vec![
            DesignNumber::length("length", both!("length along the line"), self.length),
            DesignNumber::length(
                "deviation",
                both!("from the least to the greatest deviation"),
                self.deviation,
            ),
            DesignNumber::ratio(
                "relative",
                both!("deviation over length"),
                self.deviation / self.length,
            ),
        ];
        // A straight line has no least and no greatest place.
        if self.deviation > 0.0 {
            out.extend([
                DesignNumber::length("least", both!("least coordinate across the line"), low),
                DesignNumber::angle("at_least", both!("the driver there"), low_at),
                DesignNumber::length(
                    "greatest",
                    both!("greatest coordinate across the line"),
                    high,
                ),
                DesignNumber::angle("at_greatest", both!("the driver there"), high_at),
            ]);
        }
        out.extend([
            DesignNumber::angle("from", both!("the driver where the line begins"), self.range[0]),
            DesignNumber::angle("to", both!("the driver where it ends"), self.range[1]),
        ]);
        out
    }
}

/// Sweeps the scene over the range and locates the extremes of E.
fn measure(made: &ScaledLinkage, wanted: f64) -> Result<MeasuredStretch, Faults> {
    let scene = scene::read_asking(scene_text(&made.scene), "x_E, y_E")?.value;
    let mechanism = Mechanism::new(&scene)?.value;
    let placed = PlacedScene::new(&scene, &mechanism)?;
    let [from, to] = made.range;
    let values: Vec<f64> =
        (0..=STEPS).map(|i| from + (to - from) * i as f64 / STEPS as f64).collect();
    let table = run(&placed, 0, &Stations::of_values(values.clone(), 1.0), Width::One)?;
    let at = &table.columns[0].values;
    let swept_at = |values| of_values(&placed, 0, values);
    let across = if made.along == 'x' { 'y' } else { 'x' };
    let names = [made.along, across].map(|axis| format!("{axis}_E"));
    let columns: Vec<&[f64]> =
        names.iter().filter_map(|n| Some(&table.column(n)?.values[..])).collect();
    let ends = names.iter().zip(&columns).flat_map(|(name, column)| {
        let row = |highest| extreme_row(column, highest).map(|row| (row, highest));
        let sought =
            move |(row, highest)| (SoughtExtreme { column: name, row, highest }, column[row]);
        [false, true].into_iter().filter_map(row).map(sought)
    });
    let (sought, at_rows): (Vec<SoughtExtreme>, Vec<f64>) = ends.unzip();
    let found = zoom::extremes(&table, &swept_at, &sought);
    let four: [Option<(f64, f64)>; 4] = std::array::from_fn(|k| {
        let (one, in_row) = (sought.get(k)?, at_rows[k]);
        let beats = |v: f64| if one.highest { v > in_row } else { v < in_row };
        found[k].filter(|(_, v)| beats(*v)).or(Some((at[one.row], in_row)))
    });
    let [Some(a), Some(b), Some(low), Some(high)] = four else {
        return Err(Diagnostic::error(
            "no-motion",
            both!("the linkage does not move through its range"),
        )
        .into());
    };
    let (length, deviation) = (b.1 - a.1, high.1 - low.1);
    let deviation = if deviation <= EXACT * length { 0.0 } else { deviation };
    // A range that begins in a dead centre is swept from next to it: the wanted length includes the
    // rest.
    let length = if (length - wanted).abs() <= NEXT_TO_DEAD * wanted { wanted } else { length };
    Ok(MeasuredStretch { length, deviation, extremes: [low, high], range: made.range })
}
