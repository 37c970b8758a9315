//! The table of a gear pair: the sizes of each gear, and the sizes of the pair.

use hodograph_base::digits::{inked, significant};
use hodograph_base::geom::Point;
use hodograph_base::lang::tr;
use hodograph_methods::gears::{Gear, Mate, standard};
use hodograph_paper::paper::drawing::DrawingPart;
use hodograph_paper::paper::grid::{self, Cell, Row};
use hodograph_paper::paper::item::{Anchor, Colour, FigureItem, Shape};
use hodograph_paper::paper::label::Label;
use hodograph_report::teeth::drive;
use hodograph_scene::Kind;
use std::f64::consts::PI;

use super::DrawnGears;

/// Gap between columns, and distance between the baselines of rows.
const GAP_MM: f64 = 5.0;
const ROW_MM: f64 = 7.0;

impl DrawnGears<'_> {
    /// A length in the table: in the unit of the answers, or else in mm.
    fn length(&self, m: f64) -> String {
        let (book, digits) = (&self.maker.scene.book, self.maker.options.digits + 1);
        match book.chosen(Kind::Length) {
            Some(_) => {
                book.label(Kind::Length, &inked(&significant(book.value(Kind::Length, m), digits)))
            }
            None => format!("{} mm", inked(&significant(m * 1e3, digits))),
        }
    }

    pub(super) fn table(&self) -> DrawingPart {
        let (maker, pair, lang) = (self.maker, &self.pair, self.maker.options.lang);
        let (style, digits) = (&maker.options.style, maker.options.digits);
        let number = |x: f64| inked(&significant(if x.abs() < 1e-12 { 0.0 } else { x }, digits));
        let text = |s: &str, id: String| {
            Some(Cell {
                label: Label::text(s).in_fonts(&style.fonts),
                size_mm: style.caption_mm,
                anchor: Anchor::Start,
                class: "gears table".into(),
                id,
            })
        };
        let math = |s: &str, id: String| {
            Some(Cell {
                label: Label::math(s).in_fonts(&style.fonts),
                size_mm: style.caption_mm,
                anchor: Anchor::Start,
                class: "gears table".into(),
                id,
            })
        };
        // A rack has no sizes of a gear.
        let rounds = if pair.mate == Mate::Rack { 1 } else { 2 };
        let of =
            |f: &dyn Fn(&Gear) -> String| pair.gears.iter().take(rounds).map(f).collect::<Vec<_>>();
        // A ring is not cut by a rack.
        let least = |g: &Gear| {
            let ring = pair.mate == Mate::Ring && *g == pair.gears[1];
            if ring { "\\text{–}".to_owned() } else { number(g.least_shift(&pair.basic)) }
        };
        let basic = &pair.basic;
        let pitch = PI * basic.module;
        // The spaces of a ring are the teeth of a gear of its size.
        let thickness = |g: &Gear| {
            let wide = 0.5 * pitch + 2.0 * g.shift * basic.module * libm::tan(basic.alpha);
            let ring = pair.mate == Mate::Ring && *g == pair.gears[1];
            if ring { pitch - wide } else { wide }
        };
        let each = [
            (tr!(lang, "teeth"), "z", of(&|g| g.teeth.to_string())),
            (tr!(lang, "profile shift"), "x", of(&|g| number(g.shift))),
            (tr!(lang, "least shift without undercut"), "x_{min}", of(&least)),
            (tr!(lang, "reference radius"), "r", of(&|g| self.length(g.reference))),
            (tr!(lang, "base radius"), "r_b", of(&|g| self.length(g.base))),
            (tr!(lang, "operating pitch radius"), "r'", of(&|g| self.length(g.pitch))),
            (tr!(lang, "tip radius"), "r_a", of(&|g| self.length(g.tip))),
            (tr!(lang, "root radius"), "r_f", of(&|g| self.length(g.root))),
            (tr!(lang, "tooth thickness"), "s", of(&|g| self.length(thickness(g)))),
            (tr!(lang, "width of space"), "e", of(&|g| self.length(pitch - thickness(g)))),
            (tr!(lang, "depth of tooth"), "h", of(&|g| self.length((g.tip - g.root).abs()))),
        ];
        let degrees = |a: f64| format!("{}°", number(a.to_degrees()));
        let [b2, b1] = pair.contact();
        let mut common = vec![
            (tr!(lang, "module"), "m", self.length(basic.module)),
            (tr!(lang, "pitch"), "p", self.length(pitch)),
            (tr!(lang, "pressure angle"), "\\alpha", degrees(basic.alpha)),
            (tr!(lang, "operating pressure angle"), "\\alpha'", degrees(pair.operating)),
        ];
        let centres = || {
            [
                (
                    tr!(lang, "standard centre distance"),
                    "a",
                    self.length(standard(basic, pair.mate, pair.gears.map(|g| g.teeth))),
                ),
                (tr!(lang, "operating centre distance"), "a'", self.length(pair.distance)),
            ]
        };
        let shift = || number(pair.mate.shift(pair.gears.map(|g| g.shift)));
        match pair.mate {
            Mate::Gear => {
                common.extend(centres());
                common.push((tr!(lang, "sum of profile shifts"), "x_{\\Sigma}", shift()));
            }
            Mate::Ring => {
                common.extend(centres());
                common.push((tr!(lang, "difference of profile shifts"), "x_{}-x_{}", shift()));
            }
            Mate::Rack => {
                let [tip, root] = pair.rack();
                common.extend([
                    (tr!(lang, "pitch line to the gear's axis"), "r'", self.length(pair.distance)),
                    (tr!(lang, "pitch line to the tip line"), "h_a", self.length(tip)),
                    (tr!(lang, "pitch line to the root line"), "h_f", self.length(root)),
                ]);
            }
        }
        if pair.mate != Mate::Rack {
            let shifts = pair.gears.map(|g| g.shift);
            let kind = drive(pair.mate.shift(shifts), shifts != [0.0; 2], lang);
            common.push((tr!(lang, "kind of drive"), "", format!("\\text{{{kind}}}")));
        }
        common.extend([
            (tr!(lang, "length of contact"), "B_{}B_{}", self.length(b1 - b2)),
            (tr!(lang, "base pitch"), "p_b", self.length(pair.base_pitch())),
            (tr!(lang, "contact ratio"), "\\varepsilon", number(pair.contact_ratio())),
        ]);
        let mut head = vec![tr!(lang, "gear").to_owned(), String::new(), self.name(0).to_owned()];
        if rounds == 2 {
            head.push(self.name(1).to_owned());
        }
        let cells = head
            .iter()
            .enumerate()
            .map(|(k, h)| if h.is_empty() { None } else { text(h, format!("gears-head-{k}")) })
            .collect();
        let mut rows = vec![Row { cells, height_mm: ROW_MM }];
        for (r, (words, letter, values)) in each.iter().enumerate() {
            let mut cells = vec![
                text(words, format!("gears-word-{r}")),
                math(letter, format!("gears-symbol-{r}")),
            ];
            cells.extend(
                values.iter().enumerate().map(|(k, v)| math(v, format!("gears-value-{r}-{k}"))),
            );
            rows.push(Row { cells, height_mm: ROW_MM });
        }
        for (r, (words, letter, value)) in common.iter().enumerate() {
            let letter = letter
                .replace("B_{}B_{}", &format!("{}{}", self.symbol("B", 1), self.symbol("B", 0)))
                .replace(
                    "x_{}-x_{}",
                    &format!("{} - {}", self.symbol("x", 1), self.symbol("x", 0)),
                );
            let mut row = Row {
                cells: vec![
                    text(words, format!("gears-pair-{r}")),
                    math(&letter, format!("gears-pair-symbol-{r}")),
                    math(value, format!("gears-pair-value-{r}")),
                ],
                height_mm: ROW_MM,
            };
            // A gap separates the sizes of the pair from those of each gear.
            row.height_mm += if r == 0 { ROW_MM / 2.0 } else { 0.0 };
            rows.push(row);
        }
        let mut items: Vec<FigureItem> = grid::set(&rows, GAP_MM);
        let heading = Shape::Label {
            at: Point::new(0.0, 2.0),
            label: Label::text(tr!(lang, "Gear pair")).in_fonts(&style.fonts),
            size_mm: style.caption_mm,
            anchor: Anchor::Start,
            colour: Colour::BLACK,
        };
        items.push(FigureItem::new("gears heading", heading).with_id("gears-heading"));
        DrawingPart::of(items)
    }
}
