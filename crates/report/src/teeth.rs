//! Numbers of teeth for a ratio in words: pairs for a centre distance, and trains of stages.

use super::columns::columns;
use hodograph_base::digits::{legible, shortest};
use hodograph_base::lang::{say, tr};
use hodograph_methods::gears::unknown::{FoundGear, GearCandidate, WantedGear};
use hodograph_methods::gears::wanted::{
    FoundPair, PairFit, WantedPair, WantedTrain, ratio_of, shares,
};
use hodograph_paper::paper::label::Label;
use hodograph_scene::Lang;
use serde_json::{Value as Json, json};
use std::f64::consts::PI;

/// Significant digits of ratios, shifts and angles.
const DIGITS: usize = 5;
/// Sums of shifts below this are zero.
const ZERO: f64 = 1e-12;

/// Returns the kind of drive by the sum of profile shifts.
pub fn drive(sum: f64, equal_and_opposite: bool, lang: Lang) -> &'static str {
    match (sum, equal_and_opposite) {
        (s, _) if s > ZERO => tr!(lang, "positive drive"),
        (s, _) if s < -ZERO => tr!(lang, "negative drive"),
        (_, true) => tr!(lang, "equal and opposite shifts"),
        (_, false) => tr!(lang, "standard gears"),
    }
}

fn percent(part: f64) -> String {
    if part.abs() < 1e-12 { "0 %".to_owned() } else { format!("{} %", legible(part * 100.0, 3)) }
}

fn mm(m: f64) -> String {
    shortest(m * 1e3)
}

/// Returns the pairs as a table; lengths are in millimetres.
pub fn pairs_text(wish: &WantedPair, found: &[FoundPair], lang: Lang) -> String {
    let (ratio, distance) = (shortest(wish.ratio), mm(wish.distance));
    let mut out = say!(lang, "Pairs for i = {ratio} at a' = {distance} mm: {}\n", found.len());
    if found.is_empty() {
        return out;
    }
    let head = ["m/mm", "z1", "z2", "i", "Δi", "x1+x2", "α'", "β", "ε", "p/mm", "h/mm", ""];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    for p in found {
        let i = ratio_of(p.teeth);
        let degrees = |a: f64| format!("{}°", legible(a.to_degrees(), DIGITS));
        let dash = || "—".to_owned();
        let [sum, operating, helix, contact, kind] = match p.fit {
            PairFit::Spur { sum, operating, contact } => [
                if sum == 0.0 { "0".to_owned() } else { legible(sum, DIGITS) },
                degrees(operating),
                dash(),
                contact.map_or_else(dash, |c| legible(c, 4)),
                drive(sum, false, lang).to_owned(),
            ],
            PairFit::Helical(angle) => {
                ["0".to_owned(), dash(), degrees(angle), dash(), tr!(lang, "helical").to_owned()]
            }
        };
        let height = (2.0 * wish.basic.addendum + wish.basic.clearance) * p.module;
        rows.push(vec![
            mm(p.module),
            p.teeth[0].to_string(),
            p.teeth[1].to_string(),
            legible(i, DIGITS),
            percent(i / wish.ratio - 1.0),
            sum,
            operating,
            helix,
            contact,
            legible(PI * p.module * 1e3, DIGITS),
            legible(height * 1e3, DIGITS),
            kind,
        ]);
    }
    columns(&rows, 0).iter().for_each(|line| out += &format!("{}\n", line.trim_end()));
    out
}

/// Returns the pairs as JSON: lengths in m, angles in rad.
pub fn pairs_json(wish: &WantedPair, found: &[FoundPair]) -> Json {
    let pair = |p: &FoundPair| {
        let (sum, operating, helix, contact) = match p.fit {
            PairFit::Spur { sum, operating, contact } => (sum, Some(operating), None, contact),
            PairFit::Helical(angle) => (0.0, None, Some(angle), None),
        };
        json!({
            "module": p.module, "teeth": p.teeth, "ratio": ratio_of(p.teeth), "sum_of_shifts": sum,
            "operating_pressure_angle": operating, "helix_angle": helix, "contact_ratio": contact,
            "drive": if helix.is_some() { "helical" } else { drive(sum, false, Lang::En) },
        })
    };
    json!({
        "ratio": wish.ratio,
        "distance": wish.distance,
        "pairs": found.iter().map(pair).collect::<Vec<_>>(),
    })
}

/// Returns trains as a table, with the ratio of each stage.
pub fn stages_text(wish: &WantedTrain, found: &[Vec<[u32; 2]>], lang: Lang) -> String {
    let share: Vec<String> = shares(wish)
        .iter()
        .enumerate()
        .map(|(k, i)| format!("i{} = {}", k + 1, legible(*i, DIGITS)))
        .collect();
    let (ratio, share) = (shortest(wish.ratio), share.join(", "));
    let mut out = say!(lang, "Total ratio {ratio} in {} stages: {share}\n", wish.stages);
    let mut head: Vec<String> = (1..=wish.stages)
        .flat_map(|k| [format!("z{}/z{}", 2 * k, 2 * k - 1), format!("i{k}")])
        .collect();
    head.extend(["i", "Δi"].map(str::to_owned));
    let mut rows = vec![head];
    for train in found {
        let total: f64 = train.iter().map(|p| ratio_of(*p)).product();
        let mut row: Vec<String> = train
            .iter()
            .flat_map(|p| [format!("{}/{}", p[1], p[0]), legible(ratio_of(*p), DIGITS)])
            .collect();
        row.extend([legible(total, DIGITS + 1), percent(total / wish.ratio - 1.0)]);
        rows.push(row);
    }
    if found.is_empty() {
        out += tr!(lang, "no train within these limits\n");
        return out;
    }
    columns(&rows, 0).iter().for_each(|line| out += &format!("{}\n", line.trim_end()));
    out
}

/// Returns trains as JSON.
pub fn stages_json(wish: &WantedTrain, found: &[Vec<[u32; 2]>]) -> Json {
    let train = |t: &Vec<[u32; 2]>| {
        let ratios: Vec<f64> = t.iter().map(|p| ratio_of(*p)).collect();
        json!({"teeth": t, "ratios": ratios, "ratio": ratios.iter().product::<f64>()})
    };
    json!({
        "ratio": wish.ratio,
        "shares": shares(wish),
        "trains": found.iter().map(train).collect::<Vec<_>>(),
    })
}

/// Returns the numbers of teeth of a gear in a scene as a table.
pub fn gear_text(wish: &WantedGear, all: &FoundGear, lang: Lang) -> String {
    let (gear, name, book) = (wish.gear, wish.quantity, &all.scene.book);
    let value = |si: f64| {
        let number = legible(book.value(all.kind, si), DIGITS);
        Label::math(book.label(all.kind, &number)).plain()
    };
    let wanted = value(all.wanted);
    let mates: Vec<String> = all.mates.iter().map(|(link, z)| format!("z_{link} = {z}")).collect();
    let mates = mates.join(tr!(lang, "clause" => ", "));
    let count = all.found.len();
    let mut out = say!(lang, "Teeth of gear {gear} for {name} = {wanted} ({mates}): {count}\n");
    let head = [format!("z_{gear}"), name.to_owned(), tr!(lang, "deviation").to_owned()];
    let row =
        |c: &GearCandidate| vec![c.teeth.to_string(), value(c.value), percent(all.off(c.value))];
    let rows: Vec<Vec<String>> =
        std::iter::once(head.to_vec()).chain(all.found.iter().map(row)).collect();
    if all.found.is_empty() {
        if let Some(c) = &all.nearest {
            let [z, value, off] = [c.teeth.to_string(), value(c.value), percent(all.off(c.value))];
            out += &say!(lang, "nearest: z_{gear} = {z} gives {value}, deviation {off}\n");
        }
        return out;
    }
    out.extend(columns(&rows, 0).into_iter().map(|l| format!("  {}\n", l.trim_end())));
    out
}

/// Returns the numbers of teeth of a gear in a scene as JSON, in SI.
pub fn gear_json(wish: &WantedGear, all: &FoundGear) -> Json {
    let one = |c: &GearCandidate| json!({"teeth": c.teeth, "value": c.value, "deviation": all.off(c.value)});
    let mates = all.mates.iter().map(|(link, z)| json!({"link": link, "teeth": z}));
    json!({
        "gear": wish.gear,
        "quantity": wish.quantity,
        "wanted": all.wanted,
        "mates": mates.collect::<Vec<_>>(),
        "found": all.found.iter().map(one).collect::<Vec<_>>(),
        "nearest": all.nearest.as_ref().map(one),
    })
}
