//! Typesetting of labels: from atoms to glyphs with positions, and the measures of the whole.
//!
//! Sizes and positions of scripts follow the MATH table of STIX Two Math (constants below, in em of
//! the label).

use std::collections::BTreeSet;
use std::sync::Arc;

use hodograph_base::diag::{Diagnostic, both, shortened};

use super::font::{Face, Glyph, Ink, Slant, own::Fonts};
use super::label::{Label, LabelNode, Role};

/// `ScriptPercentScaleDown` = 70.
const SCRIPT_SCALE: f64 = 0.70;
/// `SubscriptShiftDown` = 210.
const SUB_DOWN: f64 = 0.210;
/// `SuperscriptShiftUp` = 360.
const SUP_UP: f64 = 0.360;
/// `SubSuperscriptGapMin` = 150: with a smaller gap, `ω₃²` closes up in print.
const SCRIPT_GAP: f64 = 0.150;
/// `SuperscriptBottomMaxWithSubscript` = 380: the superscript rises no further to make the gap;
/// beyond that the subscript moves down.
const SUP_BOTTOM_MAX: f64 = 0.380;
/// `SpaceAfterScript` = 40.
const AFTER_SCRIPT: f64 = 0.040;
/// TeX's thick space, 5/18 em, on each side of a relation.
const RELATION_SPACE: f64 = 0.278;
/// TeX's medium space, 4/18 em, on each side of a binary operator.
const BINARY_SPACE: f64 = 0.222;
/// TeX's thin space, 3/18 em, after punctuation and function names.
const THIN_SPACE: f64 = 0.167;
/// Advance of a character that no font has, so that the gap stays visible beside the diagnostic.
const MISSING_ADVANCE: f64 = 0.5;

/// Largest number of missing characters reported per label: this many already show that the fonts
/// do not suit the text.
const MISSING_MAX: usize = 12;

/// A typeset label; all measures in em of the label's size.
#[derive(Clone, Debug, PartialEq)]
pub struct Typeset {
    /// The runs with their fonts and positions.
    pub runs: Vec<TextRun>,
    /// Advance width.
    pub width_em: f64,
    /// Start and end of the ink, from the start of the baseline: the advance ends beyond the ink,
    /// or within a slanted letter.
    pub ink_em: [f64; 2],
    /// Height of the ink above the baseline (0 for an empty label).
    pub ascent_em: f64,
    /// Depth of the ink below the baseline, positive downwards; negative if all ink is above it.
    pub descent_em: f64,
    /// True if the label has visible ink.
    pub inked: bool,
    /// Faults of the label: `label-syntax` and `missing-glyph`.
    pub faults: Vec<Diagnostic>,
}

/// Characters of one font, size and place in a row.
#[derive(Clone, Debug, PartialEq)]
pub struct TextRun {
    /// The font.
    pub face: Face,
    /// The text of the run.
    pub text: String,
    /// The glyphs of the run; measures in em of the run.
    pub glyphs: Vec<Glyph>,
    /// Origin of the first glyph from the start of the baseline, in em of the label.
    pub x_em: f64,
    /// Height of that origin above the baseline, in em of the label.
    pub y_em: f64,
    /// The run's em as a fraction of the label's: 1, or less in a script.
    pub size_em: f64,
}

/// Typesets a label.
///
/// A character that no font has leaves a gap of half an em and a `missing-glyph` warning; it is
/// never drawn as a box and never dropped silently.
///
/// ```
/// use hodograph_paper::paper::{label::Label, text};
/// // Digits of Times are half an em wide.
/// assert_eq!(text::set(&Label::math("3")).width_em, 0.5);
/// assert_eq!(text::set(&Label::text("\u{1F600}")).faults[0].code, "missing-glyph");
/// ```
///
/// The result is kept in the label and shared by its clones, because a label is measured many times
/// during placement.
pub fn set(label: &Label) -> Arc<Typeset> {
    Arc::clone(label.kept().get_or_init(|| Arc::new(set_anew(label))))
}

fn set_anew(label: &Label) -> Typeset {
    let mut setter = TextSetter { fonts: label.fonts(), missing: Vec::new() };
    let line = setter.row(label.row());
    let mut faults = label.faults().to_vec();
    let mut told = BTreeSet::new();
    for c in setter.missing.into_iter().filter(|c| told.insert(*c)).take(MISSING_MAX) {
        let label = shortened(label.source());
        let message = both!(
            "label `{label}`: no embedded font has the character {c} (U+{:04X})",
            u32::from(c)
        );
        faults.push(
            Diagnostic::warning("missing-glyph", message)
                .help(both!("write it with other characters")),
        );
    }
    let (bottom, top) = line.vertical_ink();
    let ink_em =
        if line.ink.any() { [line.ink.min[0], line.ink.max[0]] } else { [0.0, line.advance] };
    Typeset {
        runs: line.runs,
        width_em: line.advance,
        ink_em,
        ascent_em: top,
        descent_em: -bottom,
        inked: line.ink.any(),
        faults,
    }
}

/// A piece of typeset text relative to its own origin, in em.
#[derive(Clone)]
struct TypesetLine {
    ink: Ink,
    runs: Vec<TextRun>,
    advance: f64,
}

impl TypesetLine {
    fn empty() -> TypesetLine {
        TypesetLine { ink: Ink::NONE, runs: Vec::new(), advance: 0.0 }
    }

    fn append(&mut self, other: TypesetLine, scale: f64, dx: f64, dy: f64) {
        self.ink = self.ink.union(other.ink.placed(scale, dx, dy));
        let moved = |r: TextRun| TextRun {
            x_em: dx + r.x_em * scale,
            y_em: dy + r.y_em * scale,
            size_em: r.size_em * scale,
            ..r
        };
        self.runs.extend(other.runs.into_iter().map(moved));
    }

    /// Returns the lower and upper edge of the ink.
    fn vertical_ink(&self) -> (f64, f64) {
        if self.ink.any() { (self.ink.min[1], self.ink.max[1]) } else { (0.0, 0.0) }
    }

    /// Returns the distance by which the ink of a slanted letter extends beyond its advance.
    fn overhang(&self) -> f64 {
        (self.ink.max[0] - self.advance).max(0.0)
    }
}

struct TextSetter<'a> {
    fonts: &'a Fonts,
    missing: Vec<char>,
}

impl TextSetter<'_> {
    fn row(&mut self, row: &[LabelNode]) -> TypesetLine {
        let mut line = TypesetLine::empty();
        for (i, node) in row.iter().enumerate() {
            let side = match node.role {
                Role::Relation => RELATION_SPACE,
                Role::Binary => BINARY_SPACE,
                Role::Ordinary | Role::Punctuation | Role::Function => 0.0,
            };
            let after = match node.role {
                Role::Punctuation | Role::Function if i + 1 < row.len() => THIN_SPACE,
                Role::Ordinary
                | Role::Binary
                | Role::Relation
                | Role::Punctuation
                | Role::Function => side,
            };
            // A single sign, as between the columns of an equation's table, has no space around it.
            let (side, after) = if row.len() == 1 { (0.0, 0.0) } else { (side, after) };
            line.advance += side;
            let atom = self.atom(node);
            let (at, wide) = (line.advance, atom.advance);
            line.append(atom, 1.0, at, 0.0);
            line.advance += wide + after + node.space_em;
        }
        line
    }

    fn atom(&mut self, node: &LabelNode) -> TypesetLine {
        let mut line = self.characters(&node.text, node.slant);
        if node.primes == 0 && node.sub.is_empty() && node.sup.is_empty() {
            return line;
        }
        let base = line.advance;
        let lean = line.overhang();
        let mut upper = base + lean;
        if node.primes > 0 {
            // Full size, above the subscript: the glyph ′ of a text-size mathematical font is
            // already raised.
            let primes = self.characters(&"′".repeat(node.primes), Slant::Symbol);
            let wide = primes.advance;
            line.append(primes, 1.0, upper, 0.0);
            upper += wide;
        }
        let sub = self.row(&node.sub);
        let sup = self.row(&node.sup);
        let (mut down, mut up) = (SUB_DOWN, SUP_UP);
        if !node.sub.is_empty() && !node.sup.is_empty() {
            let sup_bottom = sup.vertical_ink().0 * SCRIPT_SCALE;
            let sub_top = sub.vertical_ink().1 * SCRIPT_SCALE;
            let lacking = SCRIPT_GAP - ((up + sup_bottom) - (sub_top - down));
            if lacking > 0.0 {
                let rise = lacking.min((SUP_BOTTOM_MAX - (up + sup_bottom)).max(0.0));
                up += rise;
                down += lacking - rise;
            }
        }
        let mut end = upper;
        if !node.sup.is_empty() {
            end = upper + sup.advance * SCRIPT_SCALE + AFTER_SCRIPT;
            line.append(sup, SCRIPT_SCALE, upper, up);
        }
        if !node.sub.is_empty() {
            end = end.max(base + sub.advance * SCRIPT_SCALE + AFTER_SCRIPT);
            line.append(sub, SCRIPT_SCALE, base, -down);
        }
        line.advance = end;
        line
    }

    /// Sets characters in a row, each in the first font that has it, shaped in runs of one font.
    fn characters(&mut self, text: &str, slant: Slant) -> TypesetLine {
        let mut line = TypesetLine::empty();
        let mut run = String::new();
        let mut face = None;
        for c in text.chars() {
            let next = Face::of(c, slant, self.fonts);
            if next != face {
                Self::flush(&mut line, &mut run, face);
                face = next;
            }
            if face.is_some() {
                run.push(c);
            } else {
                self.missing.push(c);
                line.advance += MISSING_ADVANCE;
            }
        }
        Self::flush(&mut line, &mut run, face);
        line
    }

    fn flush(line: &mut TypesetLine, run: &mut String, face: Option<Face>) {
        if let (Some(face), false) = (face, run.is_empty()) {
            let set = face.shaped(run);
            let at = line.advance;
            let run = TextRun {
                face,
                text: run.clone(),
                glyphs: set.glyphs.clone(),
                x_em: 0.0,
                y_em: 0.0,
                size_em: 1.0,
            };
            line.append(
                TypesetLine { ink: set.ink, runs: vec![run], advance: set.advance_em },
                1.0,
                at,
                0.0,
            );
            line.advance += set.advance_em;
        }
        run.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: f64, b: f64) -> bool {
        (a - b).abs() < 2e-3
    }

    #[test]
    fn measures_of_plain_letters() {
        // Tinos: the advance of 0 is 1024/2048, that of italic B 1251/2048.
        let zero = set(&Label::math("0"));
        assert!(
            close(zero.width_em, 0.5) && close(zero.ascent_em, 0.665) && zero.descent_em < 0.02,
            "{zero:?}"
        );
        let b = set(&Label::math("B"));
        assert!(
            close(b.width_em, 0.611) && (0.64..0.68).contains(&b.ascent_em),
            "{} {}",
            b.width_em,
            b.ascent_em
        );
        assert!(set(&Label::math("p")).descent_em > 0.19);
    }

    #[test]
    fn scripts_are_smaller_lower_and_apart() {
        let v = set(&Label::math("v"));
        let vb = set(&Label::math("v_B"));
        assert!(
            close(vb.width_em, v.width_em + 0.611 * SCRIPT_SCALE + AFTER_SCRIPT),
            "{}",
            vb.width_em
        );
        assert!((0.0..0.01).contains(&(vb.descent_em - SUB_DOWN)), "{}", vb.descent_em);
        // The scripts are one above the other, separated by the gap.
        let both = TextSetter { fonts: &Fonts::default(), missing: Vec::new() }
            .atom(&Label::math("a_3^2").row()[0].clone());
        let ink = |r: &TextRun| r.face.shaped(&r.text).ink.placed(r.size_em, r.x_em, r.y_em);
        let (sup, sub) = (ink(&both.runs[1]), ink(&both.runs[2]));
        let gap = sup.min[1] - sub.max[1];
        assert!(gap >= SCRIPT_GAP - 1e-9, "gap {gap}");
    }

    #[test]
    fn primes_stand_above_the_subscript() {
        let with = set(&Label::math("b'_2"));
        let without = set(&Label::math("b_2"));
        assert!(
            with.width_em < without.width_em + 0.1,
            "{} against {}",
            with.width_em,
            without.width_em
        );
        assert!(set(&Label::math("n''")).width_em > set(&Label::math("n'")).width_em + 0.1);
        assert!(close(set(&Label::math("b_2'")).width_em, with.width_em));
    }

    #[test]
    fn runs_are_the_label_in_characters() {
        let set = set(&Label::text("速 office ").then(Label::math(r"a^n_{CB} = 2\omega_3 v'_B")));
        let text: String = set.runs.iter().map(|r| r.text.as_str()).collect();
        // A superscript comes before its subscript, and primes before both.
        assert_eq!(text, "速 office anCB=2ω3v′B");
        // The glyphs fill the box that the label reports.
        let mut ink = Ink::NONE;
        for r in &set.runs {
            let mut pen = r.x_em;
            for g in &r.glyphs {
                ink = ink.union(r.face.outline(g.id).ink.placed(
                    r.size_em,
                    pen + g.offset_em[0] * r.size_em,
                    r.y_em,
                ));
                pen += g.advance_em * r.size_em;
            }
        }
        assert!(close(ink.max[1], set.ascent_em) && close(ink.min[1], -set.descent_em));
    }

    #[test]
    fn missing_glyph_is_said_and_nothing_is_drawn() {
        let label = set(&Label::text("a\u{1F600}b"));
        assert_eq!(label.faults.len(), 1);
        assert_eq!(label.faults[0].code, "missing-glyph");
        assert!(label.faults[0].message.en.contains("U+1F600"));
        assert!(close(
            label.width_em,
            set(&Label::text("a")).width_em + MISSING_ADVANCE + set(&Label::text("b")).width_em
        ));
        let gap = set(&Label::text("\u{1F600}"));
        assert!(!gap.inked && close(gap.width_em, MISSING_ADVANCE));
    }

    #[test]
    fn every_sign_of_the_language_has_a_glyph() {
        let all = r"\perp\parallel\to\checkmark\surd\circled{1}\circled{20}\angle\times\pm\approx\neq\leq\geq\infty\degree\cdot\alpha\beta\gamma
            \delta\epsilon\zeta\eta\theta\iota\kappa\lambda\mu\nu\xi\pi\rho\sigma\tau\upsilon\phi\chi\psi\omega\Gamma\Delta\Theta\Lambda\Pi
            \Sigma\Phi\Psi\Omega\sim\leftarrow ①⑳?+-=<>()[]/.,;:!|* 机构位置图速度加速度多边形方向大小比例尺";
        assert_eq!(set(&Label::math(all)).faults, []);
    }

    #[test]
    fn relations_are_spaced_unless_alone() {
        assert!(set(&Label::math("a=b")).width_em > set(&Label::math("ab")).width_em + 1.0);
        assert!(set(&Label::math("=")).width_em < 0.8);
        assert!(set(&Label::math("-2")).width_em < set(&Label::math("1-2")).width_em - 0.5 - 0.4);
    }
}
