//! Gear trains in words: Willis' table, the ratio as a formula, and its agreement with drawing and
//! analysis.

use hodograph_base::digits::{inked, significant};
use hodograph_base::lang::{each, say, tr};
use hodograph_board::plan::TurningBody;
use hodograph_board::plan::names::name_label;
use hodograph_mechanism::answer::MotionSource;
use hodograph_mechanism::mechanism::Level;
use hodograph_methods::trains::{GearTrain, TrainSpeeds, given, trains};
use hodograph_paper::paper::phrase::{Phrase, capital, formula};
use hodograph_scene::{DiagramKind, Kind, Lang, LinkId, Scene};
use hodograph_worked::worked::Worked;
use unicode_width::UnicodeWidthStr;

/// Significant digits of rates and ratios.
const DIGITS: usize = 6;

/// A table of labels: a row for each motion, first its words, then the arm and all gears.
pub struct TrainTable {
    /// Symbols of the angular velocities above the columns.
    pub head: Vec<String>,
    /// Rows of words (not in the label language) and cells (in it).
    pub rows: Vec<(String, Vec<String>)>,
    /// Results of the table as formulas.
    pub results: Vec<String>,
}

/// Returns the rotations of a train: from the given data of the scene, else from the analysis.
pub fn turns(scene: &Scene, worked: &Worked, train: &GearTrain) -> Option<TrainSpeeds> {
    let solved = |l: LinkId| worked.solution.turning(Level::Velocity, l);
    train.turns(|l| given(scene, l)).or_else(|| train.turns(solved))
}

/// Returns the symbol of an angular velocity: `\omega_{3}`.
pub fn omega(scene: &Scene, link: LinkId) -> String {
    format!("\\omega_{{{}}}", name_label(scene.link_name(link)))
}

/// Returns an angular velocity with the unit of the answers, in the label language.
pub fn amount(scene: &Scene, rate: f64, digits: usize) -> String {
    scene.book.label(Kind::Omega, &number(scene.book.value(Kind::Omega, rate), digits))
}

/// Returns a number in the label language; the rounding remainder of a difference is zero.
pub fn number(x: f64, digits: usize) -> String {
    inked(&significant(x, digits))
}

/// Returns Willis' table of a train: arm fixed and the first gear rotated by one, the same by x,
/// all rotated by y, and the sum.
pub fn table(
    scene: &Scene,
    train: &GearTrain,
    t: TrainSpeeds,
    lang: Lang,
    digits: usize,
) -> TrainTable {
    let (arm, first) = (scene.link_name(train.arm), scene.link_name(train.gears[0].link));
    let rates: Vec<f64> = (0..train.gears.len()).map(|g| train.rate(g, t)).collect();
    let largest = rates.iter().fold(t.arm.abs().max(t.first.abs()), |m, r| m.max(r.abs()));
    // A rate within rounding of zero is zero.
    let shown = |w: f64| {
        number(
            scene.book.value(Kind::Omega, if w.abs() < 1e-12 * largest { 0.0 } else { w }),
            digits,
        )
    };
    let head = std::iter::once(train.arm)
        .chain(train.gears.iter().map(|g| g.link))
        .map(|l| omega(scene, l))
        .collect();
    let row = |of_arm: String, of_gear: &dyn Fn(usize) -> String| -> Vec<String> {
        std::iter::once(of_arm).chain((0..train.gears.len()).map(of_gear)).collect()
    };
    let ratio = |g: usize| train.gears[g].ratio.clone();
    let mut rows = vec![(
        say!(lang, "{arm} held, {first} turns once"),
        row("0".into(), &|g| ratio(g).formula()),
    )];
    if train.gears.iter().any(|g| g.ratio.formula().contains('/')) {
        rows.push((String::new(), row("0".into(), &|g| number(ratio(g).value, digits))));
    }
    rows.push((
        tr!(lang, "the same times $x$").into(),
        row("0".into(), &|g| shown(ratio(g).value * t.first)),
    ));
    let unit = scene.book.name(Kind::Omega);
    let with_unit = |words: &str| format!("{words} / ({unit})");
    if train.arm == scene.ground {
        // With axes fixed to the ground nothing is added.
        if let Some((words, _)) = rows.last_mut() {
            *words = with_unit(words);
        }
        return TrainTable { head, rows, results: results(scene, train, t, digits) };
    }
    rows.push((
        tr!(lang, "all turn by $y$ with the arm").into(),
        row(shown(t.arm), &|_| shown(t.arm)),
    ));
    rows.push((with_unit(tr!(lang, "sum")), row(shown(t.arm), &|g| shown(rates[g]))));
    TrainTable { head, rows, results: results(scene, train, t, digits) }
}

/// Returns a sentence for each row of Willis' table, and one with its results.
pub fn sentences(
    scene: &Scene,
    train: &GearTrain,
    t: TrainSpeeds,
    lang: Lang,
    digits: usize,
) -> Vec<String> {
    let table = table(scene, train, t, lang, digits);
    let mut rows: Vec<String> = Vec::new();
    let (colon, comma, stop) = (tr!(lang, ": "), tr!(lang, "clause" => ", "), tr!(lang, "."));
    let last = table.rows.len().saturating_sub(1);
    for (k, (words, cells)) in table.rows.iter().enumerate() {
        let cells = table.head.iter().zip(cells).map(|(w, c)| format!("${w}$: ${c}$"));
        let cells = cells.collect::<Vec<_>>().join(comma);
        let words = match words.as_str() {
            "" => tr!(lang, "The ratios as numbers"),
            words => words,
        };
        // The results follow from the last row.
        let results: String = if k == last {
            let each = table.results.iter().map(|r| format!("${r}$"));
            let each = each.collect::<Vec<_>>().join(comma);
            format!("{}{each}{stop}", tr!(lang, " Therefore "))
        } else {
            String::new()
        };
        rows.push(format!("{}{colon}{cells}{stop}{results}", capital(words)));
    }
    rows
}

/// Returns Willis' equation between the first gear and the last about its axis, and the ratio that
/// it gives if one member is fixed.
fn results(scene: &Scene, train: &GearTrain, t: TrainSpeeds, digits: usize) -> Vec<String> {
    let w = |l: LinkId| omega(scene, l);
    let (arm, first) = (train.arm, &train.gears[0]);
    let fixed = arm == scene.ground;
    let seen = |l: LinkId| if fixed { w(l) } else { format!("({} − {})", w(l), w(arm)) };
    let others = || train.gears.iter().skip(1);
    let Some(last) = others().rev().find(|g| g.centre == train.axis).or_else(|| others().last())
    else {
        return Vec::new();
    };
    let mut out = vec![format!(
        "{}/{} = {} = {}",
        seen(last.link),
        seen(first.link),
        last.ratio.formula(),
        number(last.ratio.value, digits)
    )];
    let held = train.gears.iter().find(|g| g.link == scene.ground && g.link != first.link);
    if let (Some(held), true) = (held, t.arm != 0.0) {
        // 0 = y + e x: ω₁/ω_h = 1 + x/y = 1 − 1/e.
        let back = held.ratio.inverse();
        let sign = if back.value < 0.0 { '+' } else { '−' };
        out.push(format!(
            "{}/{} = 1 {sign} {} = {}",
            w(first.link),
            w(arm),
            back.magnitude(),
            number(1.0 - back.value, digits)
        ));
    }
    out
}

/// Returns Willis' equation of each train and the resulting ratio, for programs.
pub fn formulas(scene: &Scene, worked: &Worked) -> Vec<String> {
    let of =
        |train: &GearTrain| turns(scene, worked, train).map(|t| results(scene, train, t, DIGITS));
    trains(scene).iter().filter_map(of).flatten().map(|r| formula(&r)).collect()
}

/// Returns the section of the report on trains; empty for a scene without a train with known rates.
pub fn text(scene: &Scene, worked: &Worked, lang: Lang) -> String {
    let mut out = String::new();
    for train in trains(scene) {
        let Some(t) = turns(scene, worked, &train) else { continue };
        out.push_str(&of_train(scene, worked, &train, t, lang));
    }
    out
}

fn of_train(
    scene: &Scene,
    worked: &Worked,
    train: &GearTrain,
    t: TrainSpeeds,
    lang: Lang,
) -> String {
    let arm = scene.link_name(train.arm);
    let strands = train.meshes.iter().all(|m| scene.rolling[m.0].contact().is_none());
    let drive = lang.pick(match strands {
        true => each!("belt or chain drive"),
        false => ["gear train", ""],
    });
    let mut lines = vec![match train.arm == scene.ground {
        true => say!(lang, "{drive} with fixed axes, by Willis' table:"),
        false => say!(lang, "{drive} with arm {arm}, by Willis' table:"),
    }];
    let table = table(scene, train, t, lang, DIGITS);
    let cells = |words: &str, cells: &[String]| {
        std::iter::once(Phrase::new(words).plain())
            .chain(cells.iter().map(|c| formula(c)))
            .collect()
    };
    let mut rows: Vec<Vec<String>> = vec![cells("", &table.head)];
    rows.extend(table.rows.iter().map(|(words, row)| cells(words, row)));
    let width = |k: usize| rows.iter().map(|r| r[k].width()).max().unwrap_or(0);
    for row in &rows {
        let pad = |(k, c): (usize, &String)| {
            let air = " ".repeat(width(k) - c.width());
            if k == 0 { format!("{c}{air}") } else { format!("{air}{c}") }
        };
        lines.push(format!("  {}", row.iter().enumerate().map(pad).collect::<Vec<_>>().join("  ")));
    }
    lines.extend(table.results.iter().map(|r| format!("  {}", formula(r))));
    if let Some([drawn, solved]) = apart(worked, train, t) {
        lines.push(format!(
            "  {}",
            match drawn == "0" && solved == "0" {
                true => tr!(lang, "polygon and analysis give the same angular velocities").to_owned(),
                false => say!(
                    lang,
                    "greatest relative difference of the angular velocities: {drawn} in the polygon, {solved} in the analysis"
                ),
            }
        ));
    }
    lines.iter().map(|l| format!("{}\n", l.trim_end())).collect()
}

/// Returns the largest differences between the rates of drawing and analysis and those of the
/// table, relative to the largest rate; `None` if no rate is drawn.
fn apart(worked: &Worked, train: &GearTrain, t: TrainSpeeds) -> Option<[String; 2]> {
    let members: Vec<(LinkId, f64)> = std::iter::once((train.arm, t.arm))
        .chain(train.gears.iter().enumerate().map(|(k, g)| (g.link, train.rate(k, t))))
        .collect();
    let largest = members.iter().map(|m| m.1.abs()).fold(0.0, f64::max);
    let worst = |of: &dyn Fn(LinkId) -> Option<f64>| {
        members.iter().filter_map(|(l, w)| Some((of(*l)? - w).abs())).reduce(f64::max)
    };
    let drawn = worst(&|l| worked.construction.rate(DiagramKind::Velocity, TurningBody::Link(l)))?;
    let solved = worst(&|l| worked.solution.turning(Level::Velocity, l))?;
    (largest > 0.0).then(|| [drawn, solved].map(|d| significant(d / largest, 1)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use hodograph_scene::read;
    use hodograph_worked::worked::{Scope, work};

    const PLANETARY: &str = r#"{"units": {"length": "mm", "angle": "deg"}, "answers": {"omega": "rpm"}, "ground": "1",
        "links": {"1": ["O"], "2": ["O", "Q"], "3": ["Q"], "4": ["O"]}, "points": {"O": [0, 0], "Q": [36, 48]},
        "gears": [{"links": ["4", "3"], "centres": ["O", "Q"], "teeth": [20, 30]},
                  {"links": ["3", "1"], "centres": ["Q", "O"], "teeth": [30, 80], "ring": "1"}],
        "driver": {"link": "4", "omega": "-100 rpm"}, "find": ["omega_2", "omega_3"]}"#;

    #[test]
    fn the_section_shows_table_ratio_and_agreement_in_both_languages() {
        let scene = read(PLANETARY).unwrap().value;
        let worked = work(&scene, Scope::Questions).unwrap().value;
        let en = text(&scene, &worked, Lang::En);
        for part in [
            "arm 2",
            "−z_4/z_3",
            "ω_4/ω_2 = 1 + z_1/z_4 = 5.00000",
            "−20.0000",
            "33.3333",
            "polygon",
        ] {
            assert!(en.contains(part), "{part} is not in\n{en}");
        }
        let zh = text(&scene, &worked, Lang::Zh);
        assert!(zh.contains("系杆 2") && zh.contains("ω_4/ω_2 = 1 + z_1/z_4 = 5.00000"), "{zh}");
    }

    #[test]
    fn a_scene_without_gears_has_no_section() {
        let scene = read(hodograph_scene::templates::get("crank-rocker").unwrap()).unwrap().value;
        let worked = work(&scene, Scope::Questions).unwrap().value;
        assert_eq!(text(&scene, &worked, Lang::En), "");
    }
}
