//! A gear pair as books draw it: involute flanks around the pitch point, all circles, the line of action with N and B, the points in
//! contact; beside it a table of its sizes.
//!
//! The line of centres stands upright, the driver below and turning clockwise, two flanks touching in the pitch point. Large gears are
//! drawn around the pitch point alone. [`crate::gears`] has the geometry; decided here: what a scene means by it, and the drawing.

mod table;

use crate::construct::scale::choose_in;
use crate::diag::{Diagnostic, Faults, Warned, both};
use crate::digits::significant;
use crate::gears::{Basic, Gear, Pair, distance_of, operating, sum_of_shifts};
use crate::geom::{Point, Vec2};
use crate::plan::names::{name_label, point_label};
use crate::scene::{Contours, DriverKind, Flanks, Kind, LinkId, Rolling, Scene};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

use super::drawing::{Drawing, Part};
use super::item::{Dash, Figure, Shape, Stroke};
use super::label::Label;
use super::list::Pages;
use super::sheet::{Maker, scale};
use super::symbols as sym;

/// Room for the pair: a page with its table beside it, as large as a sheet.
const ROOM_MM: [f64; 2] = [240.0, 240.0];
/// Centres farther apart than so many modules are not on the drawing: a tooth would be lower than its letters.
const WHOLE_MODULES: f64 = 45.0;
/// Of such a pair, what lies within so many modules of the pitch point is drawn.
const NEAR_MODULES: f64 = 8.0;
/// So many teeth are drawn to both sides of the pitch point: more than are ever in contact.
const TEETH: i32 = 3;
/// The line of action is drawn so far, in parts of half the height of the drawing.
const FAR: f64 = 1.4;
/// Points of a flank: chords of a tooth as high as a hand are off by less than a line's width.
const FLANK_POINTS: usize = 16;
/// Two lengths this much apart (relative) are two lengths in a file.
const SAME: f64 = 1e-4;
/// Between the drawing and the table.
const TABLE_MM: f64 = 14.0;

/// One page for each pair of external gears with numbers of teeth.
///
/// # Errors
/// `gear-shift` where both profile shifts are given and the centres are not as far apart as they make them; `gear-teeth` where no teeth
/// can be made with what is given.
pub(super) fn pairs(maker: &Maker) -> Result<Warned<Pages>, Faults> {
    let scene = maker.scene;
    let external = |r: &&Rolling| matches!(r.contours, Contours::Circles { hollow: None, .. });
    let all: Vec<(&Rolling, &Flanks)> = scene.rolling.iter().filter(external).filter_map(|r| Some((r, r.flanks.as_ref()?))).collect();
    let one = all.len() == 1;
    let (mut pages, mut notes, mut faults) = (Pages::new(), Vec::new(), Faults::default());
    for (rolling, flanks) in &all {
        match meant(maker, rolling, flanks) {
            Ok(pair) => {
                notes.extend(remarks(scene, rolling, &pair));
                let name = if one { String::new() } else { format!("-{}", scene.point_name(rolling.at)) };
                pages.push((format!("gears{name}"), Drawn { maker, rolling, pair }.figure()));
            }
            Err(fault) => faults.push(fault),
        }
    }
    if faults.has_errors() { Err(faults) } else { Ok(Warned { value: pages, notes }) }
}

/// The order in which a pair is drawn: the gear that a driver turns first.
fn order(scene: &Scene, rolling: &Rolling) -> [usize; 2] {
    let driven = |l: LinkId| scene.drivers.iter().any(|d| matches!(d.kind, DriverKind::Turn { link, .. } if link == l));
    if driven(rolling.links[1]) && !driven(rolling.links[0]) { [1, 0] } else { [0, 1] }
}

/// The pair that a scene means at the distance of its centres (m), the driver first.
fn meant(maker: &Maker, rolling: &Rolling, flanks: &Flanks) -> Result<Pair, Diagnostic> {
    let scene = maker.scene;
    let fault = |code, message| Diagnostic::error(code, message).at(rolling.span);
    let impossible = || {
        fault("gear-teeth", both!("no involute teeth can be made with these sizes", "按所给参数无法形成渐开线轮齿"))
            .help(both!("check module, teeth, shift and the distance of the centres", "请检查模数、齿数、变位系数和中心距"))
    };
    let place = |i: usize| rolling.centres()[i].and_then(|p| maker.worked.configuration.points[p.0]);
    let (Some(p), Some(q)) = (place(0), place(1)) else { return Err(impossible()) };
    let distance = p.distance(q);
    let [i, j] = order(scene, rolling);
    let teeth = [flanks.teeth[i], flanks.teeth[j]];
    let unit = |module| Basic { module, alpha: flanks.pressure_angle, addendum: flanks.addendum, clearance: flanks.clearance };
    let given = flanks.shifts.iter().sum::<f64>();
    let (module, shifts) = match (flanks.module, &flanks.shifts[..]) {
        // Teeth alone: the module that the distance asks for.
        (None, shifts) => {
            let at_one = distance_of(&unit(1.0), teeth, given).ok_or_else(impossible)?;
            (distance / at_one, [shifts.first().copied().unwrap_or(0.0), shifts.get(1).copied().unwrap_or(0.0)])
        }
        (Some(module), &[first]) => {
            let sum = sum_of_shifts(&unit(module), teeth, operating(&unit(module), teeth, distance).ok_or_else(impossible)?);
            (module, [first, sum - first])
        }
        (Some(module), shifts) => {
            let wanted = distance_of(&unit(module), teeth, given).ok_or_else(impossible)?;
            if (wanted - distance).abs() > SAME * distance {
                let (wanted, distance) = (scene.length_words(wanted), scene.length_words(distance));
                return Err(fault(
                    "gear-shift",
                    both!(
                        "the profile shifts make the centres {wanted} apart without backlash, but they are {distance} apart",
                        "按变位系数无侧隙中心距为 {wanted}，而实际中心距为 {distance}"
                    ),
                )
                .help(both!(
                    "give one shift, \"shift\": [x1]: the other follows from the distance",
                    "只给一个变位系数 \"shift\": [x1]，另一个由中心距确定"
                )));
            }
            (module, [shifts.first().copied().unwrap_or(0.0), shifts.get(1).copied().unwrap_or(0.0)])
        }
    };
    Pair::new(unit(module), teeth, [shifts[i], shifts[j]], distance).ok_or_else(impossible)
}

/// What a maker of the gears should know.
fn remarks(scene: &Scene, rolling: &Rolling, pair: &Pair) -> Vec<Diagnostic> {
    let at = scene.point_name(rolling.at);
    let note = |code, message| Diagnostic::warning(code, message).at(rolling.span);
    let mut out = Vec::new();
    if pair.interferes() {
        let message = both!(
            "at `{at}` a tip reaches beyond the line of action's end N: the flanks interfere",
            "`{at}` 处齿顶超过啮合极限点 N，将发生干涉"
        );
        out.push(note("gear-interference", message).help(both!("give the smaller gear a larger shift", "请加大小齿轮的变位系数")));
    }
    if pair.gears.iter().any(|g| g.pointed(&pair.basic)) {
        out.push(note("gear-pointed", both!("at `{at}` a tooth is pointed before its tip circle", "`{at}` 处轮齿在齿顶圆内已变尖")));
    }
    if pair.contact_ratio() < 1.0 {
        let ratio = significant(pair.contact_ratio(), 3);
        out.push(note(
            "contact-ratio",
            both!(
                "the contact ratio at `{at}` is {ratio}: below 1 the gears lose contact",
                "`{at}` 处重合度为 {ratio}，小于 1，传动不连续"
            ),
        ));
    }
    out
}

/// A pair to be drawn.
struct Drawn<'a> {
    maker: &'a Maker<'a>,
    rolling: &'a Rolling,
    pair: Pair,
}

impl Drawn<'_> {
    fn figure(&self) -> Figure {
        let mut part = self.drawing();
        let mut table = self.table();
        table.stand_at(Point::new(part.bounds.max.x + TABLE_MM, part.bounds.max.y));
        part.items.extend(table.items);
        self.maker.alone(Part::of(part.items))
    }

    /// The name of a gear's link, of the driver for 0.
    fn name(&self, i: usize) -> &str {
        self.maker.scene.link_name(self.rolling.links[order(self.maker.scene, self.rolling)[i]])
    }

    /// A symbol with a gear's link as its index.
    fn symbol(&self, letter: &str, i: usize) -> String {
        format!("{letter}_{{{}}}", name_label(self.name(i)))
    }

    fn drawing(&self) -> Part {
        let (maker, pair) = (self.maker, &self.pair);
        let style = &maker.options.style;
        let m = pair.basic.module;
        let whole = pair.distance <= WHOLE_MODULES * m;
        let height = if whole { pair.distance + 4.0 * m } else { 2.0 * NEAR_MODULES * m };
        let half_width = |g: &Gear| g.tip * libm::sin((TAU * (f64::from(TEETH) + 0.5) / f64::from(g.teeth)).min(FRAC_PI_2));
        let width = 2.0 * pair.gears.iter().map(half_width).fold(0.0, f64::max);
        let mu = choose_in(maker.scene.book.size(Kind::Length), [width, height], ROOM_MM);
        let k = 1.0 / mu;
        let mut d = Drawing::new("gears", style.clone());
        let centres = [Point::new(0.0, -pair.gears[0].pitch * k), Point::new(0.0, pair.gears[1].pitch * k)];
        // The pitch point seen from the driver's centre lies above, from the other's below.
        let toward = [FRAC_PI_2, -FRAC_PI_2];
        let thin = style.thin;
        let reach = height / 2.0 * k;
        let ends = if whole { centres } else { [Point::new(0.0, -reach), Point::new(0.0, reach)] };
        d.shape("centres", "line", Shape::Line { from: ends[0], to: ends[1], stroke: thin.dashed(Dash::DashDot) });
        for (i, g) in pair.gears.iter().enumerate() {
            self.circles(&mut d, (i, centres[i], toward[i]), reach, k);
            let pitch_angle = TAU / f64::from(g.teeth);
            let first = toward[i] + g.half_tooth(&pair.basic, g.pitch);
            let most = TEETH.min((g.teeth as i32 - 1) / 2);
            let points = (-most..=most)
                .flat_map(|n| g.tooth(&pair.basic, first + pitch_angle * f64::from(n), FLANK_POINTS))
                .map(|p| centres[i] + p.to_vec2() * k)
                .collect();
            d.of_link(Some(self.rolling.links[order(maker.scene, self.rolling)[i]].0));
            let stroke = Some(style.outline);
            d.shape(&format!("teeth-{}", self.name(i)), "teeth", Shape::Polyline { points, closed: false, stroke, fill: None });
            d.of_link(None);
            if whole {
                let centre = self.rolling.centres()[order(maker.scene, self.rolling)[i]].map_or("O", |p| maker.scene.point_name(p));
                d.draw(&format!("centre-{centre}"), "point", sym::dot(style, centres[i]));
                d.label_at(centre, "point", &point_label(centre), centres[i], style.dot_radius_mm, Some(Vec2::new(1.0, 0.0)));
            }
        }
        self.action(&mut d, reach, k);
        let mu_words =
            format!("\\mu_l = {} {}", scale(maker.scene.book.value(Kind::Length, mu)), maker.scene.book.scale_label(Kind::Length));
        let words = match maker.options.lang {
            crate::scene::Lang::En => format!("Gears {} and {}; {} drives, clockwise", self.name(0), self.name(1), self.name(0)),
            crate::scene::Lang::Zh => format!("齿轮 {} 与 {}（{} 主动，顺时针）", self.name(0), self.name(1), self.name(0)),
        };
        maker.titled(d.finish(), Label::text(words), &mu_words, "gears")
    }

    /// The circles of a gear as arcs about the line of centres, each named at its end.
    fn circles(&self, d: &mut Drawing, (i, centre, toward): (usize, Point, f64), reach: f64, k: f64) {
        let style = &self.maker.options.style;
        let g = &self.pair.gears[i];
        // As far as there are teeth, one of which stands aside, and past N where it is on the drawing.
        let tangent = self.pair.tangents()[i].abs() * k <= FAR * reach;
        let past = if tangent { self.pair.operating + 0.12 } else { 0.0 };
        let half = (TAU * (f64::from(TEETH) + 0.9) / f64::from(g.teeth)).max(past).min(PI);
        // Names on both sides in turn, so that neighbours do not meet.
        let rings: [(&str, f64, Stroke, f64); 4] = [
            ("r_{f", g.root, style.thin, 1.0),
            ("r_{b", g.base, style.thin.dashed(Dash::Dashed), -1.0),
            ("r'_{", g.pitch, style.thin.dashed(Dash::DashDot), 1.0),
            ("r_{a", g.tip, style.thin, -1.0),
        ];
        for (letter, radius, stroke, side) in rings {
            let (from_rad, to_rad) = (toward - half, toward + half);
            let text = format!("{letter}{}}}", name_label(self.name(i)));
            let owner =
                d.shape(&format!("circle-{text}"), "circle", Shape::Arc { centre, radius_mm: radius * k, from_rad, to_rad, stroke });
            let along = Vec2::from_angle(toward + side * half);
            let end = centre + along * (radius * k);
            let out = if side > 0.0 { Vec2::from_angle(toward + FRAC_PI_2) } else { Vec2::from_angle(toward - FRAC_PI_2) };
            let request = super::place::LabelRequest::at_point(Label::math(text.clone()), style.small_mm, end, 0.3);
            d.label(&text, "circle", request.owned(owner).towards(out));
        }
    }

    /// The line of action with its points, and the contacts on it; within `reach` of the pitch point.
    fn action(&self, d: &mut Drawing, reach: f64, k: f64) {
        let (pair, style) = (&self.pair, &self.maker.options.style);
        // The driver turns clockwise and pushes to the right, and up.
        let along = Vec2::from_angle(pair.operating);
        let at = |t: f64| (along * (t * k)).to_point();
        let [n1, n2] = pair.tangents();
        let [b2, b1] = pair.contact();
        let cut = |t: f64| t.clamp(-FAR * reach / k, FAR * reach / k);
        d.shape("action", "line", Shape::Line { from: at(cut(n1 * 1.12)), to: at(cut(n2 * 1.12)), stroke: style.thin });
        let active = Shape::Line { from: at(b2), to: at(b1), stroke: style.outline };
        d.shape("action-active", "line", active);
        let side = along.perp();
        let named = [(n1, "N", 0, -1.0), (n2, "N", 1, 1.0), (b2, "B", 1, 1.0), (b1, "B", 0, -1.0)];
        for (t, letter, i, up) in named {
            if cut(t) == t {
                let name = self.symbol(letter, i);
                d.draw(&format!("{letter}-{}", self.name(i)), "point", sym::dot(style, at(t)));
                d.label_at(&name, "point", &name, at(t), style.dot_radius_mm, Some(side * up));
            }
        }
        // Contacts: one base pitch apart, of which one is the pitch point now.
        let p_b = pair.base_pitch();
        for n in -3..=3 {
            let t = f64::from(n) * p_b;
            if t >= b2 && t <= b1 {
                let circle = Shape::Circle { centre: at(t), radius_mm: 1.2, stroke: Some(style.outline), fill: None };
                d.shape("contact", "contact", circle);
            }
        }
        let name = self.maker.scene.point_name(self.rolling.at).to_owned();
        d.label_at(&name, "point", &point_label(&name), Point::ORIGIN, 1.6, Some(Vec2::new(-1.0, 0.6)));
        // The operating pressure angle, between the common tangent and the line of action.
        let radius = (0.75 * reach).min(26.0);
        d.shape(
            "tangent",
            "line",
            Shape::Line { from: Point::new(-radius * 1.3, 0.0), to: Point::new(radius * 1.3, 0.0), stroke: style.thin },
        );
        let owner = d.draw("angle", "angle", sym::angle(style, Point::ORIGIN, radius, 0.0, pair.operating));
        let angle = super::place::LabelRequest::along_arc(
            Label::math("\\alpha'"),
            style.label_mm,
            Point::ORIGIN,
            radius,
            [0.0, pair.operating],
            style.thin.width_mm,
        );
        d.label("alpha", "angle", angle.owned(owner));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accuracy::certify;
    use crate::figure::item::Item;
    use crate::figure::sheet::Options;
    use crate::scene::{Lang, read};
    use crate::worked::{Scope, work};

    fn text(gear: &str, distance: f64) -> String {
        format!(
            r#"{{"units": {{"length": "mm", "angle": "deg"}}, "links": {{"1": ["A", "D"], "2": ["A"], "3": ["D"]}}, "ground": "1",
                "points": {{"A": [0, 0], "D": [{distance}, 0]}}, "driver": {{"link": "2", "omega": "10 rad/s"}},
                "gears": [{{"links": ["2", "3"], "centres": ["A", "D"], "at": "K", {gear}}}], "find": ["omega_3"]}}"#
        )
    }

    fn drawn(gear: &str, distance: f64, lang: Lang) -> Result<Warned<Pages>, Faults> {
        let scene = read(text(gear, distance)).unwrap().value;
        let worked = work(&scene, Scope::Questions).unwrap().value;
        let options = Options::of_language(lang);
        pairs(&Maker { scene: &scene, worked: &worked, options: &options, certified: certify(&scene, &worked, 4) })
    }

    #[test]
    fn the_exercise_of_the_lecture_notes_is_in_the_table() {
        for lang in [Lang::En, Lang::Zh] {
            let pages = drawn(r#""teeth": [15, 32], "module": "2 mm", "shift": [0.6]"#, 50.0, lang).unwrap();
            let [(name, figure)] = &pages.value[..] else { panic!("{} pages", pages.value.len()) };
            assert_eq!(name, "gears");
            let labels: Vec<&str> = figure
                .items
                .iter()
                .filter_map(|i| if let Shape::Label { label, .. } = &i.shape { Some(label.source()) } else { None })
                .collect();
            for wanted in ["27.96°", "1.801", "1.201", "47.000 mm", "50.000 mm", "N_{2}", "B_{3}"] {
                assert!(labels.contains(&wanted), "{wanted} is not among {labels:?}");
            }
            assert!(figure.items.iter().all(Item::is_finite));
        }
    }

    #[test]
    fn teeth_alone_make_the_module() {
        let pages = drawn(r#""teeth": [20, 40]"#, 90.0, Lang::En).unwrap();
        assert!(pages.value[0].1.items.iter().any(|i| matches!(&i.shape, Shape::Label { label, .. } if label.source() == "3.0000 mm")));
    }

    #[test]
    fn what_does_not_fit_is_told() {
        let faults = drawn(r#""teeth": [15, 32], "module": "2 mm", "shift": [0.5, 0.5]"#, 50.0, Lang::En).unwrap_err();
        assert_eq!(faults.list[0].code, "gear-shift");
        let notes = drawn(r#""teeth": [8, 40], "module": "2 mm", "shift": [0, 0]"#, 48.0, Lang::En).unwrap().notes;
        assert!(notes.iter().any(|n| n.code == "gear-interference"), "{notes:?}");
        for (gear, code) in [
            (r#""radii": [20, 40], "shift": [0.5]"#, "gear-flanks"),
            (r#""teeth": [20, 40], "pressure_angle": "80 deg""#, "gear-flanks"),
            (r#""teeth": [20, 40], "shift": ["2 mm"]"#, "gear-flanks"),
            (r#""teeth": [20, 40], "addendum": 0"#, "gear-flanks"),
            (r#""teeth": [20, 40], "shift": [0, 0, 0]"#, "gear-flanks"),
        ] {
            let faults = read(text(gear, 60.0)).unwrap_err();
            assert!(faults.list.iter().any(|d| d.code == code), "{gear}: {:?}", faults.list);
        }
    }
}
