//! Draws the arrows of the drivers' given rates. A velocity and an acceleration are two arrows,
//! each in its own sense, which are opposite for a driver that slows down; a zero rate has no arrow
//! and no name.

use std::f64::consts::TAU;

use hodograph_base::geom::{Point, Vec2};
use hodograph_board::plan::names::name_label;
use hodograph_paper::paper::extent::on_circle;
use hodograph_paper::paper::item::{FigureItem, Shape};
use hodograph_paper::paper::place::{Obstacles, free_places, roomiest};
use hodograph_paper::paper::symbols as sym;
use hodograph_scene::Driver;

use super::MechanismDraft;
use super::marks::{Called, NEXT_MM};

/// Places for the arrow of a rotation: number of turned positions about its centre, number of
/// radii, and their step.
const TURNS: i32 = 24;
const OUTS: usize = 6;
const OUT_MM: f64 = 1.6;
/// Clear space around an arrow: a line beside it would be read as part of it.
const ARC_AIR_MM: f64 = 0.8;
/// Costs of a place: a crossed line outweighs any displacement; one step outward costs as much as a
/// turn of 75°, and a turn of twice that four times as much, because the eye looks for the arrow at
/// the link.
const CROSSED_COST: f64 = 60.0;
const OUT_COST: f64 = 1.5;
const TURN_COST: f64 = 0.06;
/// Distance of the second arrow from the first one: its label fits between.
const APART_MM: f64 = NEXT_MM;
/// The second arrow also prefers a place with clear space for its label and for nearby names, such
/// as the ground's number under a support: a distance below this from anything costs as much as
/// four steps outward.
const FREE_MM: f64 = 3.0;
const FREE_COST: f64 = 6.0;
/// Additional cost accepted for a place with space for the name.
const ROOM_COST: f64 = 12.0;
/// The owner of an arrow that is not drawn yet.
const OWN: u32 = u32::MAX;
/// Length of a straight arrow, and its gap to the driver's other arrow in the same line.
pub(super) const ARROW_MM: f64 = 12.0;
const IN_LINE_MM: f64 = 3.0;

/// The candidate places for the arrows of a link that turns.
pub(super) struct TurnArrows {
    pub centre: Point,
    pub radius: f64,
    /// Start and end angle of the first arrow (rad), in either sense.
    pub angles: [f64; 2],
    /// The direction about which the place of the second arrow is mirrored (rad).
    pub mirror: f64,
}

/// The places of the arrows of a part that slides.
pub(super) struct Slides {
    /// The tail of the first arrow.
    pub from: Point,
    /// The positive sense.
    pub along: Vec2,
    /// The direction away from the part.
    pub outward: Vec2,
    /// The moving link or point, in ids.
    pub who: String,
}

/// The rate given in the file; 0 if the file leaves it free.
fn given_rate(driver: &Driver) -> f64 {
    if driver.rate_told { driver.rate.value } else { 0.0 }
}

impl MechanismDraft<'_> {
    /// Draws the arrows of ω and α.
    pub(super) fn rotations(&mut self, driver: &Driver, index: &str, t: TurnArrows) {
        let name = name_label(index);
        let given = [
            ("rotation", "omega", given_rate(driver)),
            ("angular-acceleration", "alpha", acceleration(driver)),
        ];
        let mut first: Option<Vec<FigureItem>> = None;
        for (thing, letter, value) in given.into_iter().filter(|g| g.2 != 0.0) {
            let [low, high] = sorted(t.angles);
            let (low, high) = if first.is_some() {
                (2.0 * t.mirror - high, 2.0 * t.mirror - low)
            } else {
                (low, high)
            };
            // The head is at the end towards which the link turns or accelerates.
            let ends = if value > 0.0 { [low, high] } else { [high, low] };
            let symbol = format!("\\{letter}_{{{name}}}");
            let (radius, [from, to]) =
                self.clear_arc(&symbol, t.centre, (t.radius, ends), first.as_deref());
            let arrow = sym::rotation(self.style, t.centre, radius, from, to);
            let id = format!("{thing}-{}", index.replace('/', "-"));
            let owner = self.d.draw(&id, "driver", arrow.clone());
            self.turned_at.push((t.centre, on_circle(t.centre, radius, (from + to) / 2.0)));
            self.arc_label(
                Called { id: &id, symbol: &symbol, class: "rotation" },
                t.centre,
                radius,
                [from, to],
                owner,
            );
            first.get_or_insert(arrow);
        }
    }

    /// The place of a rotation's arrow with the fewest crossings and space for its name: as
    /// requested, or else turned about its centre or farther out by as little as possible. In a
    /// series the space for the name is ignored, because the arrow would jump from one figure to
    /// the next.
    fn clear_arc(
        &self,
        symbol: &str,
        centre: Point,
        (radius, [from, to]): (f64, [f64; 2]),
        beside: Option<&[FigureItem]>,
    ) -> (f64, [f64; 2]) {
        let beside = beside.map(Obstacles::of);
        let place = |out: usize, turn: i32| {
            let by = f64::from(turn) * TAU / f64::from(TURNS);
            (radius + out as f64 * OUT_MM, [from + by, to + by])
        };
        let cost = |out: usize, turn: i32| {
            let (radius, [from, to]) = place(out, turn);
            let arrow = sym::rotation(self.style, centre, radius, from, to);
            let near = beside.as_ref().map_or(0, |b| b.met_by(&Obstacles::of(&arrow), APART_MM));
            let crossed = self.d.met_by(&arrow, ARC_AIR_MM) + near;
            let crowded = if beside.is_some() && self.d.met_by(&arrow, FREE_MM) > 0 {
                FREE_COST
            } else {
                0.0
            };
            CROSSED_COST * crossed as f64
                + crowded
                + OUT_COST * out as f64
                + TURN_COST * f64::from(turn * turn)
        };
        let all = (0..OUTS).flat_map(|out| {
            (0..TURNS).map(move |k| (out, if k % 2 == 0 { k / 2 } else { -(k + 1) / 2 }))
        });
        let mut priced: Vec<(f64, (f64, [f64; 2]))> =
            all.map(|(out, turn)| (cost(out, turn), place(out, turn))).collect();
        priced.sort_by(|a, b| a.0.total_cmp(&b.0));
        let cheapest = priced[0];
        let in_series = !self.course.supports.is_empty() || self.style.memory.is_some();
        let room = |(radius, [from, to]): (f64, [f64; 2])| {
            let mut drawn = self.d.obstacles().clone();
            drawn.add(&sym::rotation(self.style, centre, radius, from, to), Some(OWN));
            free_places(&self.arc_request(symbol, centre, radius, [from, to]).owned(OWN), &drawn)
        };
        let affordable = priced.into_iter().take_while(|p| p.0 < cheapest.0 + ROOM_COST);
        if in_series {
            cheapest.1
        } else {
            roomiest(affordable.map(|p| p.1), room).unwrap_or(cheapest.1)
        }
    }

    /// Draws the arrows of a velocity and an acceleration along a line, with their symbols.
    pub(super) fn translations(&mut self, driver: &Driver, symbols: &[String; 2], s: Slides) {
        let (rate, acceleration) = (given_rate(driver), acceleration(driver));
        if rate != 0.0 {
            self.straight_arrow(
                s.from,
                s.along * rate.signum(),
                &format!("driver-vel-{}", s.who),
                &symbols[0],
            );
        }
        if acceleration == 0.0 {
            return;
        }
        let towards = s.along * acceleration.signum();
        let beside = |k: f64| s.from + s.outward * (k * APART_MM);
        let places = if rate == 0.0 {
            vec![s.from]
        } else if (rate > 0.0) == (acceleration > 0.0) {
            vec![
                s.from + towards * (ARROW_MM + IN_LINE_MM),
                beside(1.0),
                s.from - towards * (ARROW_MM + IN_LINE_MM),
                beside(2.0),
            ]
        } else {
            // Tail to tail: the two arrows point away from each other.
            vec![
                s.from + towards * IN_LINE_MM,
                beside(1.0) - towards * ARROW_MM,
                beside(2.0) - towards * ARROW_MM,
            ]
        };
        let crossed = |from: &Point| self.d.met_by(&[self.arrow(*from, towards)], ARC_AIR_MM);
        let Some(from) = places.iter().min_by_key(|p| crossed(p)).copied() else { return };
        self.straight_arrow(from, towards, &format!("driver-acc-{}", s.who), &symbols[1]);
    }

    fn arrow(&self, from: Point, along: Vec2) -> FigureItem {
        FigureItem::new(
            "",
            Shape::Arrow {
                from,
                to: from + along * ARROW_MM,
                stroke: self.style.vector,
                head: self.style.head,
            },
        )
    }

    fn straight_arrow(&mut self, from: Point, along: Vec2, id: &str, symbol: &str) {
        let owner = self.d.draw(id, "driver", vec![self.arrow(from, along)]);
        self.d.label_along(
            id,
            "driver",
            symbol,
            (from, from + along * ARROW_MM),
            self.style.vector.width_mm / 2.0,
            owner,
        );
    }
}

fn acceleration(driver: &Driver) -> f64 {
    driver.acceleration.as_ref().map_or(0.0, |a| a.value)
}

fn sorted([a, b]: [f64; 2]) -> [f64; 2] {
    [a.min(b), a.max(b)]
}
