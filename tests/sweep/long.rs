//! Long sweeps in pieces give the rows of an undivided sweep.

use super::*;
use hodograph::sweep::long::LongSweep;
use hodograph::sweep::pieces::SweepPieces;

/// The numbers of a sweep in pieces, and its notes.
pub fn pieces(sweep: &mut dyn SweepPieces, cut: usize) -> (Vec<Vec<f64>>, Vec<Diagnostic>) {
    let (count, mut columns) = (sweep.count(), vec![Vec::new(); sweep.columns().len()]);
    let mut piece = Vec::new();
    for from in (0..count).step_by(cut) {
        piece = sweep.piece(from..count.min(from + cut), piece, &|| false).unwrap();
        columns.iter_mut().zip(&piece).for_each(|(c, p)| c.extend_from_slice(p));
    }
    (columns, sweep.notes())
}

pub fn same_bits(name: &str, columns: &[Vec<f64>], whole: &Table) {
    for (a, b) in columns.iter().zip(&whole.columns) {
        assert!(
            a.len() == b.values.len()
                && a.iter().zip(&b.values).all(|(x, y)| x.to_bits() == y.to_bits()),
            "{name} {}",
            b.name
        );
    }
}

/// A sweep in pieces has the rows and the notes of the undivided one, to the bit: where rows are
/// missing across the ends of pieces, past change points, where the driver slides, and where each
/// position is reached from the one before it, or after it, or round the other way.
#[test]
fn a_long_sweep_is_its_pieces() {
    let mut scenes: Vec<(&str, Scene, [usize; 2])> = Vec::new();
    for (n, t) in templates::list().iter().enumerate() {
        // Only these two have both a row at every limit and more rows than are between two stored
        // states.
        let always = ["crank-rocker", "class-iii-six-bar"].contains(&t.name);
        if n % every(8) != 0 && !always {
            continue;
        }
        let set: &[(&str, &str)] = if t.name == "crank-rocker" { &[("l_AB", "240")] } else { &[] };
        let scene = read(templates::instantiate(t.name, set).unwrap()).unwrap().value;
        let whole = Mechanism::new(&scene)
            .unwrap()
            .value
            .groups
            .iter()
            .any(|g| g.class() == Some("IV or higher"));
        let size = match t.name {
            // More positions than are between two stored states.
            "class-iii-six-bar" => [10_000, 4096],
            // Each position needs the general solver, or its scene is read for it.
            _ if whole || scene.has_momentary_cams() => [200 / every(8), 77],
            _ => [2000 / every(8), 77],
        };
        scenes.push((t.name, scene, size));
    }
    scenes.push(("class IV", class_iv(r#""v_D", "omega_5""#, ["", ""]), [400 / every(8), 77]));
    let (mut missing, mut followed_missing) = (0, 0);
    for (name, scene, [steps, cut]) in &scenes {
        let m = Mechanism::new(scene).unwrap().value;
        let placed = PlacedScene::new(scene, &m).unwrap();
        let per_value = station::angle_per_value(scene, &placed.at, 0);
        let now = station::position_now(scene, &placed.at, 0);
        let (turn, slide) =
            (|a, b| station::DriverSpan::Turn(Angle::Deg(a), Angle::Deg(b)), placed.at.extent());
        let ways = match scene.drivers[0].kind {
            DriverKind::Turn { .. } => [turn(-30.0, 450.0), turn(400.0, -30.0)],
            _ => [[-slide, slide], [slide, -slide]].map(|[a, b]| station::DriverSpan::Slide {
                from: now + a,
                to: now + b,
                per_value,
            }),
        };
        for way in ways {
            let steps = sweep::StationSteps { way, steps: *steps };
            let whole = sweep::run(&placed, 0, &steps.all(), Width::Widest).unwrap();
            let mut long = LongSweep::new(&placed, 0, steps).unwrap();
            let (columns, notes) = pieces(&mut long, *cut);
            assert!(
                long.columns()
                    .into_iter()
                    .eq(whole.columns.iter().map(|c| (c.name.clone(), c.unit))),
                "{name}"
            );
            same_bits(name, &columns, &whole);
            assert_eq!(notes, whole.notes, "{name}");
            missing += steps.steps + 1 - whole.rows();
            followed_missing +=
                if followed(scene, &m) { steps.steps + 1 - whole.rows() } else { 0 };
        }
    }
    assert!(
        missing > 500 / every(8) && followed_missing > 500 / every(8),
        "{missing} rows are missing, {followed_missing} of followed mechanisms"
    );
}

/// A sweep that is asked to stop reports this instead of giving rows that it does not have.
#[test]
fn a_sweep_in_pieces_stops_when_asked() {
    for scene in [scene("class-iii-six-bar", &[]), class_iv(r#""v_D""#, ["", ""])] {
        let m = Mechanism::new(&scene).unwrap().value;
        let placed = PlacedScene::new(&scene, &m).unwrap();
        let way = station::DriverSpan::Turn(Angle::Deg(0.0), Angle::Deg(360.0));
        let mut long =
            LongSweep::new(&placed, 0, sweep::StationSteps { way, steps: 1000 }).unwrap();
        assert!(long.piece(0..10, Vec::new(), &|| true).is_none());
    }
}
