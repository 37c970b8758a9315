//! Legibility of every sheet in any pose: all templates at 24 positions of their driver, in both
//! languages and both notation profiles.
//!
//! `HODOGRAPH_WIDE=1` examines all positions, otherwise a part of them is examined. The table:
//! `HODOGRAPH_WIDE=1 cargo test --test sheet every_pose -- --nocapture`

use crate::wide::every;
use hodograph::figure::list::{self, Extras, FigureInput};
use hodograph::figure::sheet::{SheetOptions, sheet};
use hodograph::geom::{Point, Vec2};
use hodograph::notation::Notation;
use hodograph::paper::extent::Rect;
use hodograph::paper::item::{Figure, FigureItem, Shape};
use hodograph::paper::place::Obstacles;
use hodograph::scene::{self, DriverKind, Lang, Scene, driver_position, templates, with_driver_at};
use hodograph::sweep::extreme::ends;
use hodograph::worked::{Scope, work};

/// Positions of the driver.
const POSES: usize = 24;
/// The smallest type, printed on A4 (a larger sheet is reduced to it); on A3 with more links than
/// `A4_LINKS`, or with force polygons.
pub const SMALLEST_MM: f64 = 2.2;
const A4_LINKS: usize = 7;
/// A label that a line only grazes is still legible.
const GRAZE_MM: f64 = 0.3;

/// Findings on sheets.
#[derive(Clone, Copy, Default)]
pub struct Found {
    sheets: usize,
    labels: usize,
    pub overlaps: usize,
    pub outside: usize,
    on_thick_lines: usize,
    on_heads: usize,
    on_joints: usize,
    leaders: usize,
    pub smallest_mm: f64,
}

impl Found {
    fn add(&mut self, o: Found) {
        let first = self.sheets == 0;
        self.sheets += o.sheets;
        self.labels += o.labels;
        self.overlaps += o.overlaps;
        self.outside += o.outside;
        self.on_thick_lines += o.on_thick_lines;
        self.on_heads += o.on_heads;
        self.on_joints += o.on_joints;
        self.leaders += o.leaders;
        self.smallest_mm = if first { o.smallest_mm } else { self.smallest_mm.min(o.smallest_mm) };
    }

    fn line(&self, name: &str) -> String {
        format!(
            "{name:<22} {:>6} {:>7} {:>8} {:>7} {:>8} {:>8} {:>8} {:>8} {:>8.2}",
            self.sheets,
            self.labels,
            self.overlaps,
            self.outside,
            self.on_thick_lines,
            self.on_heads,
            self.on_joints,
            self.leaders,
            self.smallest_mm
        )
    }
}

/// The factor by which a sheet is reduced to the paper, upright or across; at most 1.
fn printed(figure: &Figure, links: usize) -> f64 {
    let [long, short] = if links > A4_LINKS { [420.0, 297.0] } else { [297.0, 210.0] };
    let fits = |w: f64, h: f64| (w / figure.width_mm).min(h / figure.height_mm);
    fits(long, short).max(fits(short, long)).min(1.0)
}

pub fn look(figure: &Figure, links: usize) -> Found {
    let labels: Vec<(&FigureItem, Rect)> = figure
        .items
        .iter()
        .filter(|i| matches!(i.shape, Shape::Label { .. }))
        .filter_map(|i| Some((i, i.bounds()?)))
        .collect();
    let mut found =
        Found { sheets: 1, labels: labels.len(), smallest_mm: f64::INFINITY, ..Found::default() };
    let paper = Rect::new(Point::ORIGIN, Point::new(figure.width_mm, figure.height_mm));
    // The ring around an inset is a line, not a joint.
    let is_ink = |i: &&FigureItem| {
        !matches!(i.shape, Shape::Label { .. } | Shape::Circle { fill: None, .. })
    };
    let lines: Vec<FigureItem> = figure.items.iter().filter(is_ink).cloned().collect();
    let ink = Obstacles::of(&lines);
    let meets = |r: Rect, a: Point, b: Point, half: f64| clipped(a, b, r.grown(half)) > GRAZE_MM;
    for (k, (item, r)) in labels.iter().enumerate() {
        let Shape::Label { size_mm, .. } = &item.shape else { continue };
        found.smallest_mm = found.smallest_mm.min(size_mm * printed(figure, links));
        found.outside += usize::from(paper.union(*r) != paper);
        found.overlaps += labels[..k].iter().filter(|(_, o)| r.overlap_mm2(*o) > 0.0).count();
        let thick = ink.bars.iter().filter(|b| b.half_width_mm > 0.15);
        found.on_thick_lines +=
            usize::from(thick.clone().any(|b| meets(*r, b.from, b.to, b.half_width_mm)));
        found.on_heads += usize::from(ink.heads.iter().any(|h| meets(*r, h.from, h.to, 0.0)));
        let near = |d: &hodograph::paper::place::InkDisc| {
            let p =
                Point::new(d.centre.x.clamp(r.min.x, r.max.x), d.centre.y.clamp(r.min.y, r.max.y));
            p.distance(d.centre) < d.radius_mm - GRAZE_MM
        };
        found.on_joints += usize::from(ink.discs.iter().any(near));
    }
    found.leaders = figure.items.iter().filter(|i| i.id.ends_with("-leader")).count();
    found
}

/// Length of a segment inside a box, by halving: independent of the placement of labels.
fn clipped(a: Point, b: Point, r: Rect) -> f64 {
    const PIECES: usize = 200;
    let inside = |p: Point| r.min.x <= p.x && p.x <= r.max.x && r.min.y <= p.y && p.y <= r.max.y;
    let apart = a.x.max(b.x) < r.min.x
        || a.x.min(b.x) > r.max.x
        || a.y.max(b.y) < r.min.y
        || a.y.min(b.y) > r.max.y;
    if apart {
        return 0.0;
    }
    let d: Vec2 = b - a;
    let hits = (0..PIECES).filter(|k| inside(a + d * ((*k as f64 + 0.5) / PIECES as f64))).count();
    hits as f64 / PIECES as f64 * d.norm()
}

/// The scene at positions of its first driver all around or between its limits, or a part of these
/// positions.
pub fn poses(scene: &Scene) -> Vec<Scene> {
    let Some(start) = driver_position(scene, 0) else { return vec![scene.clone()] };
    let turns = matches!(scene.drivers[0].kind, DriverKind::Turn { .. });
    let [low, high] = match ends(scene, 0).unwrap_or_default() {
        [Some(low), Some(high)] => [low, high],
        _ if turns => [start, start + std::f64::consts::TAU],
        _ => [start * 0.8, start * 1.2],
    };
    (0..POSES)
        .step_by(every(8))
        .map(|k| with_driver_at(scene, 0, low + (high - low) * (k as f64 + 0.25) / POSES as f64))
        .collect()
}

#[test]
fn every_pose_can_be_read() {
    let only = std::env::var("HODOGRAPH_ONLY").unwrap_or_default();
    let mut table = vec![format!(
        "{:<22} {:>6} {:>7} {:>8} {:>7} {:>8} {:>8} {:>8} {:>8} {:>8}",
        "",
        "sheets",
        "labels",
        "overlaps",
        "outside",
        "on lines",
        "on heads",
        "on pins",
        "leaders",
        "least mm"
    )];
    let mut all = Found::default();
    let mut faults = Vec::new();
    for t in templates::list() {
        if !only.is_empty() && !only.split(',').any(|o| o == t.name) {
            continue;
        }
        let scene = scene::read(templates::get(t.name).unwrap()).unwrap().value;
        let mut here = Found::default();
        for (k, pose) in poses(&scene).iter().enumerate() {
            let Ok(worked) = work(pose, Scope::Figure) else { continue };
            for lang in [Lang::En, Lang::Zh] {
                for notation in ["en", "cn"] {
                    let notation = Notation::named(notation).unwrap();
                    let name = format!("{} pose {k} {lang:?} {}", t.name, notation.name);
                    let figure = sheet(
                        pose,
                        &worked.value,
                        &SheetOptions { notation, ..SheetOptions::of_language(lang) },
                    )
                    .unwrap();
                    let forces = worked.value.equilibrium.is_some();
                    let found = look(&figure, if forces { usize::MAX } else { pose.links.len() });
                    if found.overlaps + found.outside > 0 || found.smallest_mm < SMALLEST_MM {
                        faults.push(format!(
                            "{name}: {} overlaps, {} outside, smallest type {:.2} mm",
                            found.overlaps, found.outside, found.smallest_mm
                        ));
                    }
                    here.add(found);
                }
            }
        }
        table.push(here.line(t.name));
        all.add(here);
    }
    table.push(all.line("all"));
    println!("{}", table.join("\n"));
    assert!(faults.is_empty(), "{} sheets:\n{}", faults.len(), faults.join("\n"));
}

/// Checks the centres of every template at all positions: no label overlaps another, none is off
/// the paper.
#[test]
fn every_centre_can_be_read() {
    let only = std::env::var("HODOGRAPH_ONLY").unwrap_or_default();
    let (mut all, mut faults, mut table) = (Found::default(), Vec::new(), Vec::new());
    let entry = list::named("centres").unwrap();
    for t in templates::list() {
        if !only.is_empty() && !only.split(',').any(|o| o == t.name) {
            continue;
        }
        let scene = scene::read(templates::get(t.name).unwrap()).unwrap().value;
        // The sixty-six centres of twelve links are too many to examine; the eighteen that an
        // eight-bar finds are on pages of five.
        if scene.links.len() > A4_LINKS && t.name != "double-butterfly" {
            continue;
        }
        let mut here = Found::default();
        for (k, pose) in poses(&scene).iter().enumerate() {
            let Ok(worked) = work(pose, Scope::Figure) else { continue };
            for lang in [Lang::En, Lang::Zh] {
                let options = SheetOptions::of_language(lang);
                let wanted = FigureInput {
                    scene: pose,
                    worked: &worked.value,
                    options: &options,
                    extras: &Extras::default(),
                };
                let pages = (entry.draw)(&wanted)
                    .unwrap_or_else(|f| panic!("{} pose {k}: {f}", t.name))
                    .value;
                for (page, figure) in &pages {
                    let found = look(figure, pose.links.len());
                    if found.overlaps + found.outside > 0 || found.smallest_mm < SMALLEST_MM {
                        let (overlaps, outside, least) =
                            (found.overlaps, found.outside, found.smallest_mm);
                        faults.push(format!(
                            "{} pose {k} {lang:?} {page}: {overlaps} overlaps, {outside} outside, smallest type {least:.2} mm",
                            t.name
                        ));
                    }
                    here.add(found);
                }
            }
        }
        table.push(here.line(t.name));
        all.add(here);
    }
    table.push(all.line("all"));
    println!("{}", table.join("\n"));
    assert!(faults.is_empty(), "{} figures:\n{}", faults.len(), faults.join("\n"));
}
