//! Several designs side by side: the results of their whole motions in one table, as text, CSV and
//! JSON.

use super::columns::columns;
use hodograph_base::digits::{legible, shortest};
use hodograph_base::lang::{say, tr};
use hodograph_paper::paper::label::Label;
use hodograph_scene::Lang;
use serde_json::{Value as Json, json};

/// Significant digits in the table for reading, as many as the limits of a motion have.
const DIGITS: usize = 6;

/// A number that characterises a quantity over the whole motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MotionResult {
    /// The difference of the two extreme positions of an output.
    Stroke,
    /// The time ratio K of its two strokes.
    TimeRatio,
    /// The least transmission angle of all groups.
    Transmission,
    /// The highest value.
    Highest,
    /// The lowest value.
    Lowest,
    /// The greatest magnitude of a value that changes its sign.
    Greatest,
    /// The mean over the position of the driver.
    Mean,
}

impl MotionResult {
    /// Returns the name in files.
    pub fn key(self) -> &'static str {
        match self {
            MotionResult::Stroke => "stroke",
            MotionResult::TimeRatio => "time ratio",
            MotionResult::Transmission => "least transmission angle",
            MotionResult::Highest => "highest",
            MotionResult::Lowest => "lowest",
            MotionResult::Greatest => "greatest magnitude",
            MotionResult::Mean => "mean",
        }
    }

    /// Returns the words of the table.
    pub fn words(self, lang: Lang) -> &'static str {
        match self {
            MotionResult::Stroke => tr!(lang, "stroke"),
            MotionResult::TimeRatio => tr!(lang, "time ratio K"),
            MotionResult::Transmission => tr!(lang, "least transmission angle γ"),
            MotionResult::Highest => tr!(lang, "maximum" => "highest"),
            MotionResult::Lowest => tr!(lang, "minimum" => "lowest"),
            MotionResult::Greatest => tr!(lang, "greatest magnitude"),
            MotionResult::Mean => tr!(lang, "mean"),
        }
    }
}

/// The result of one design.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ComparedCell {
    /// The value (SI).
    pub value: f64,
    /// The position of the driver that has it (rad or m).
    pub at: Option<f64>,
}

/// One result of all designs.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparedRow {
    /// The name of the quantity, such as `v_C.x` or `phi_3`; empty for a result of the mechanism.
    pub quantity: String,
    /// The kind of result.
    pub result: MotionResult,
    /// The unit in the label language, and its number per SI unit.
    pub unit: (String, f64),
    /// The result of each design; `None` for a design without this quantity.
    pub cells: Vec<Option<ComparedCell>>,
}

/// A table of designs.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The file of each design.
    pub files: Vec<String>,
    /// The title of each design, which may be empty.
    pub titles: Vec<String>,
    /// The name of the driver, such as `phi_1`.
    pub driver: String,
    /// The unit of the driver in the label language, and its number per SI unit.
    pub driver_unit: (String, f64),
    /// The results.
    pub rows: Vec<ComparedRow>,
}

impl Comparison {
    /// Returns the name of each design: its number, title and file.
    pub fn names(&self, lang: Lang) -> Vec<String> {
        let name = |(k, (file, title)): (usize, (&String, &String))| match (title.as_str(), lang) {
            ("", _) => format!("{}  {file}", k + 1),
            (title, Lang::En) => format!("{}  {title} ({file})", k + 1),
            (title, Lang::Zh) => format!("{}  {title}（{file}）", k + 1),
        };
        self.files.iter().zip(&self.titles).enumerate().map(name).collect()
    }

    /// Returns the table as text: a line for each design, then a column for each; in brackets the
    /// position of the driver.
    pub fn text(&self, lang: Lang) -> String {
        let driver = match lang {
            Lang::En => self.driver.clone(),
            Lang::Zh => self.driver.replacen("phi", "φ", 1),
        };
        let mut out = say!(lang, "Comparison of designs over the whole motion of {driver}\n");
        self.names(lang).iter().for_each(|name| out += &format!("{name}\n"));
        let head = [String::new(), String::new()].into_iter();
        let mut rows = vec![head.chain((1..=self.files.len()).map(|k| k.to_string())).collect()];
        let mut before = "";
        for row in &self.rows {
            let shown = if row.quantity == before { "" } else { row.quantity.as_str() };
            before = &row.quantity;
            let cell = |cell: &Option<ComparedCell>| match cell {
                None => "—".to_owned(),
                Some(ComparedCell { value, at }) => {
                    let value = number(*value, &row.unit);
                    let place = at.map(|at| number(at, &self.driver_unit));
                    place.map_or(value.clone(), |place| format!("{value} ({place})"))
                }
            };
            let words = [shown.to_owned(), row.result.words(lang).to_owned()];
            rows.push(words.into_iter().chain(row.cells.iter().map(cell)).collect::<Vec<_>>());
        }
        columns(&rows, 2).iter().for_each(|line| out += &format!("{}\n", line.trim_end()));
        out
    }

    /// Returns the table as comma-separated values, in the units of the table for reading; each
    /// design has a column of values and one of positions of the driver.
    pub fn csv(&self) -> String {
        let field = |text: &str| match text.contains(['"', ',', '\n']) {
            true => format!("\"{}\"", text.replace('"', "\"\"")),
            false => text.to_owned(),
        };
        let unit = plain(&self.driver_unit.0);
        let heads = self.files.iter().enumerate().flat_map(|(k, file)| {
            let of = format!("{} {file}", k + 1);
            [of.clone(), format!("{of}: {} [{unit}]", self.driver)]
        });
        let head = ["quantity", "result", "unit"].map(str::to_owned).into_iter().chain(heads);
        let mut out = head.map(|h| field(&h)).collect::<Vec<_>>().join(",") + "\n";
        for row in &self.rows {
            let words = [row.quantity.as_str(), row.result.key(), &plain(&row.unit.0)]
                .map(str::to_owned)
                .into_iter();
            let cells = row.cells.iter().flat_map(|cell| {
                let value = cell.map(|c| shortest(c.value * row.unit.1));
                let at = cell.and_then(|c| c.at).map(|at| shortest(at * self.driver_unit.1));
                [value, at].map(Option::unwrap_or_default)
            });
            out += &(words.chain(cells).map(|f| field(&f)).collect::<Vec<_>>().join(",") + "\n");
        }
        out
    }

    /// Returns the table as JSON, in SI.
    pub fn json(&self) -> Json {
        let designs = self.files.iter().zip(&self.titles);
        let designs = designs.map(|(file, title)| json!({"file": file, "title": title}));
        let cell = |cell: &Option<ComparedCell>| {
            cell.map(|c| json!({"value": c.value, "driver": c.at})).unwrap_or_default()
        };
        let rows = self.rows.iter().map(|row| {
            json!({
                "quantity": row.quantity,
                "result": row.result.key(),
                "designs": row.cells.iter().map(cell).collect::<Vec<_>>(),
            })
        });
        json!({
            "driver": self.driver,
            "designs": designs.collect::<Vec<_>>(),
            "rows": rows.collect::<Vec<_>>(),
        })
    }
}

/// Returns a unit as plain text; a degree is `°`.
fn plain(unit: &str) -> String {
    if unit.contains("degree") { "°".to_owned() } else { Label::math(unit).plain() }
}

/// Returns an SI value in a unit with its name.
fn number(si: f64, (unit, per_si): &(String, f64)) -> String {
    let value = legible(si * per_si, DIGITS);
    match plain(unit).as_str() {
        "°" => format!("{value}°"),
        unit => format!("{value} {unit}").trim_end().to_owned(),
    }
}
