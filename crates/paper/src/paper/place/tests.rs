use super::*;
use crate::paper::arrow::ArrowHead;
use crate::paper::item::FigureItem;

const PAPER: Rect = Rect { min: Point::ORIGIN, max: Point { x: 180.0, y: 120.0 } };

fn arrow(from: Point, to: Point) -> FigureItem {
    FigureItem::new(
        "vector",
        Shape::Arrow { from, to, stroke: LineStroke::new(0.4), head: ArrowHead::VECTOR },
    )
}

/// Counts pairs of labels that overlap, labels on a bar or disc, and labels off the paper.
fn clashes(placements: &[Placement], obstacles: &Obstacles) -> (usize, usize, usize) {
    let mut pairs = 0;
    for (i, a) in placements.iter().enumerate() {
        pairs += placements[..i].iter().filter(|b| a.bounds.overlap_mm2(b.bounds) > 0.0).count();
    }
    let on = |p: &&Placement| {
        obstacles.bars.iter().any(|b| cost::clipped_mm(b.from, b.to, p.bounds) > 0.0)
            || obstacles
                .discs
                .iter()
                .any(|d| candidate::nearest(p.bounds, d.centre).distance(d.centre) < d.radius_mm)
    };
    let covering = placements.iter().filter(on).count();
    let outside = placements.iter().filter(|p| p.bounds.grown(-1e-9).union(PAPER) != PAPER).count();
    (pairs, covering, outside)
}

/// A polygon with a labelled corner and edge at each step, the pole in the centre, and a ray to
/// every corner.
fn rose(
    centre: Point,
    n: usize,
    radius: f64,
    items: &mut Vec<FigureItem>,
    obstacles: &mut Obstacles,
    requests: &mut Vec<LabelRequest>,
) {
    let corner = |k: usize| {
        centre + Vec2::from_angle(0.3 + std::f64::consts::TAU * k as f64 / n as f64) * radius
    };
    for k in 0..n {
        for (from, to, name) in
            [(centre, corner(k), "v_{B3}"), (corner(k), corner(k + 1), "a_{CB}^t")]
        {
            let owner = items.len() as u32;
            items.push(arrow(from, to));
            obstacles.add(&items[items.len() - 1..], Some(owner));
            requests.push(LabelRequest::along(Label::math(name), 4.0, from, to, 0.2).owned(owner));
        }
        requests.push(
            LabelRequest::at_point(Label::math("b'_2"), 4.4, corner(k), 0.3)
                .towards(corner(k) - centre),
        );
    }
}

fn sheet() -> (Vec<LabelRequest>, Obstacles) {
    let (mut items, mut obstacles, mut requests) = (Vec::new(), Obstacles::default(), Vec::new());
    for (x, y, n, r) in [(35.0, 80.0, 4, 26.0), (95.0, 85.0, 5, 28.0), (150.0, 80.0, 3, 24.0)] {
        rose(Point::new(x, y), n, r, &mut items, &mut obstacles, &mut requests);
    }
    for k in 0..36 {
        let from = Point::new(10.0 + 4.5 * k as f64, 15.0);
        obstacles.bars.push(Bar {
            from,
            to: from + Vec2::new(-2.0, -2.0),
            half_width_mm: 0.1,
            owner: None,
            faint: false,
        });
    }
    (requests, obstacles)
}

#[test]
fn a_full_sheet_has_no_overlap() {
    let (requests, obstacles) = sheet();
    assert!(
        requests.len() >= 36 && obstacles.bars.len() >= 60,
        "{} {}",
        requests.len(),
        obstacles.bars.len()
    );
    let placements = place(&requests, &obstacles, PAPER);
    assert_eq!(clashes(&placements, &obstacles), (0, 0, 0));
    assert_eq!(place(&requests, &obstacles, PAPER), placements, "same requests, same places");
}

#[test]
fn a_lone_label_stands_where_it_is_asked_to() {
    let point = Point::new(50.0, 50.0);
    let at = |r: LabelRequest| place(&[r], &Obstacles::default(), PAPER)[0].bounds.centre() - point;
    let free = at(LabelRequest::at_point(Label::math("B"), 4.5, point, 1.0));
    assert!(free.x > 0.0 && free.y > 0.0, "{free:?}");
    let west =
        at(LabelRequest::at_point(Label::math("B"), 4.5, point, 1.0).towards(Vec2::new(-1.0, 0.0)));
    assert!(west.x < -2.0 && west.y.abs() < 0.5, "{west:?}");
}

#[test]
fn baseline_is_the_ink_box_moved_by_the_descent() {
    let request = LabelRequest::at_point(Label::math("p"), 5.0, Point::new(20.0, 20.0), 0.0);
    let p = place(std::slice::from_ref(&request), &Obstacles::default(), PAPER)[0];
    let drawn = p.items(&request, "point", LineStroke::new(0.2));
    assert_eq!(drawn.len(), 1);
    let ink = drawn[0].bounds().unwrap();
    assert!((ink.min.y - p.bounds.min.y).abs() < 1e-9 && (ink.max.x - p.bounds.max.x).abs() < 1e-9);
    assert!(p.at.y > p.bounds.min.y + 0.9);
}

#[test]
fn stands_nearer_to_its_own_line() {
    // Two parallel lines 5 mm apart: a label just fits between them, but outside it cannot be
    // mistaken.
    let lines = [
        (Point::new(20.0, 40.0), Point::new(80.0, 40.0)),
        (Point::new(20.0, 45.0), Point::new(80.0, 45.0)),
    ];
    let mut obstacles = Obstacles::default();
    for (k, &(from, to)) in lines.iter().enumerate() {
        obstacles.add(
            &[FigureItem::new("", Shape::Line { from, to, stroke: LineStroke::new(0.4) })],
            Some(k as u32),
        );
    }
    let request = |k: usize, side: f64| {
        LabelRequest::along(Label::math("v_B"), 4.5, lines[k].0, lines[k].1, 0.2)
            .owned(k as u32)
            .towards(Vec2::new(0.0, side))
    };
    let both = place(&[request(0, -1.0), request(1, 1.0)], &obstacles, PAPER);
    assert!(both[0].bounds.max.y < 40.0 && both[1].bounds.min.y > 45.0, "{both:?}");
    // Without a preferred side the upper one is the default; the label of the lower line still goes
    // below it.
    let free = LabelRequest { prefer: None, ..request(0, 1.0) };
    assert!(place(&[free], &obstacles, PAPER)[0].bounds.max.y < 40.0);
}

#[test]
fn names_beside_each_other_are_not_read_as_one() {
    // Two lines that cross at a small angle, and two that diverge slowly: the middles of each two
    // are so near that their names would look like a product.
    let flat = [
        (Point::new(20.0, 50.0), Point::new(85.0, 40.0)),
        (Point::new(75.0, 52.0), Point::new(20.0, 36.0)),
    ];
    let slow = [
        (Point::new(20.0, 20.0), Point::new(70.0, 75.0)),
        (Point::new(20.0, 18.0), Point::new(84.0, 70.0)),
    ];
    for (lines, names) in [(flat, ["v_A", "v_{PB}"]), (slow, ["1", "2"])] {
        let mut obstacles = Obstacles::default();
        for (k, &(from, to)) in lines.iter().enumerate() {
            obstacles.add(
                &[FigureItem::new("", Shape::Line { from, to, stroke: LineStroke::new(0.4) })],
                Some(k as u32),
            );
        }
        let request = |k: usize| {
            LabelRequest::along(Label::math(names[k]), 4.5, lines[k].0, lines[k].1, 0.2)
                .owned(k as u32)
        };
        let both = place(&[request(0), request(1)], &obstacles, PAPER);
        assert!(both.iter().all(|p| p.leader.is_none()), "{both:?}");
        assert!(!cost::is_beside(both[0].bounds, both[1].bounds), "{both:?}");
    }
}

#[test]
fn a_walled_in_point_gets_a_leader() {
    let at = Point::new(60.0, 60.0);
    let mut obstacles = Obstacles::default();
    for k in 0..24 {
        let u = Vec2::from_angle(k as f64 * std::f64::consts::TAU / 24.0);
        obstacles.bars.push(Bar {
            from: at + u * 1.0,
            to: at + u * 7.0,
            half_width_mm: 0.2,
            owner: None,
            faint: false,
        });
    }
    let p =
        place(&[LabelRequest::at_point(Label::math("B_2"), 4.5, at, 0.8)], &obstacles, PAPER)[0];
    let (from, to) = p.leader.expect("no room near the point");
    assert_eq!(clashes(&[p], &obstacles), (0, 0, 0));
    assert!(to.distance(at) < from.distance(at), "the leader ends at the point");
}

#[test]
fn beside_an_arc_means_off_the_arc() {
    let centre = Point::new(60.0, 60.0);
    for k in 0..12 {
        let from = k as f64 * 0.5;
        let angles = [from, from + 1.2];
        let mut obstacles = Obstacles::default();
        let [from_rad, to_rad] = angles;
        let arc =
            Shape::Arc { centre, radius_mm: 12.0, from_rad, to_rad, stroke: LineStroke::new(0.25) };
        obstacles.add(&[FigureItem::new("angle", arc)], Some(1));
        let request =
            LabelRequest::along_arc(Label::math(r"\varphi_1"), 4.5, centre, 12.0, angles, 0.125)
                .owned(1);
        let p = place(&[request], &obstacles, PAPER)[0];
        let gap = candidate::nearest(p.bounds, centre).distance(centre) - 12.0;
        assert!((0.5..2.0).contains(&gap), "{angles:?}: {gap} mm from the arc");
    }
}

#[test]
fn labels_stay_on_the_paper() {
    let corner =
        LabelRequest::at_point(Label::math("v_{B3B2}^r"), 4.5, Point::new(178.0, 118.0), 1.0);
    let p = place(&[corner], &Obstacles::default(), PAPER)[0];
    assert_eq!(clashes(&[p], &Obstacles::default()).2, 0);
}

/// A hundred random vectors on an A4 sheet, every other one labelled along itself, the rest at
/// their tails.
#[test]
fn scattered_vectors_have_no_overlap() {
    let mut seed = 12345_u64;
    let mut random = || {
        // Knuth's MMIX generator: the same sheet on every run.
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (seed >> 33) as f64 / (1_u64 << 31) as f64
    };
    let paper = Rect { min: Point::ORIGIN, max: Point::new(280.0, 190.0) };
    let (mut obstacles, mut requests) = (Obstacles::default(), Vec::new());
    for k in 0..100 {
        let from = Point::new(10.0 + 260.0 * random(), 10.0 + 170.0 * random());
        let to =
            from + Vec2::from_angle(std::f64::consts::TAU * random()) * (6.0 + 22.0 * random());
        obstacles.add(&[arrow(from, to)], Some(k));
        requests.push(match k % 2 {
            0 => LabelRequest::along(Label::math("v_{CB}"), 3.0, from, to, 0.2).owned(k),
            _ => LabelRequest::at_point(Label::math("b'_2"), 3.0, from, 0.3),
        });
    }
    let placements = place(&requests, &obstacles, paper);
    let (pairs, covering, _) = clashes(&placements, &obstacles);
    assert_eq!((pairs, covering), (0, 0));
    assert!(
        placements.iter().filter(|p| p.leader.is_some()).count() <= 3,
        "leader lines are the exception"
    );
}
