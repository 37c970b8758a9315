//! Labels of figures: a short formula or a sentence in the label language, parsed into rows of
//! atoms.
//!
//! ```text
//! v_{B3B2}^r   a^n_{CB}   \omega_1^2 l_{AB}   b'_2   \mu_l = 0.002 m/mm   \perp AB   B \to A
//! \text{max}   \bm{v}_B   \circled{3}   \checkmark   \surd   \sin\varphi   \,   \quad   B\_1
//! ```
//! Names of a scene's points and links come in as labels in which their marks are already escaped.
//!
//! Letters of quantities and points are italic; digits, operators, words and units are upright. A
//! unit is the text after a number **and a space** (`2 m/s` is two metres per second, `2l` twice a
//! length). Spaces have no other meaning in a formula, except beside Chinese. Sizes, fonts and
//! positions are decided elsewhere.

use hodograph_base::diag::Diagnostic;

use super::font::{Slant, has_song, own::Fonts};
use super::text::Typeset;
use std::cell::RefCell;
use std::collections::HashMap;
use std::sync::{Arc, OnceLock};

mod parse;

pub use parse::greek;

/// A text on a figure. Clones share the text and its typeset form.
#[derive(Clone, Debug)]
pub struct Label(Arc<LabelContent>);

#[derive(Clone, Debug)]
struct LabelContent {
    source: String,
    row: Vec<LabelNode>,
    faults: Vec<Diagnostic>,
    fonts: Fonts,
    /// The typeset label, kept after the first request.
    kept: OnceLock<Arc<Typeset>>,
}

impl PartialEq for Label {
    fn eq(&self, other: &Label) -> bool {
        let (one, two) = (&*self.0, &*other.0);
        Arc::ptr_eq(&self.0, &other.0)
            || one.source == two.source
                && one.row == two.row
                && one.faults == two.faults
                && one.fonts == two.fonts
    }
}

/// A label as data: its text and its row, in the bundled fonts.
#[cfg(feature = "wire")]
impl serde::Serialize for Label {
    fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        (&self.0.source, &self.0.row).serialize(to)
    }
}

#[cfg(feature = "wire")]
impl<'de> serde::Deserialize<'de> for Label {
    fn deserialize<D: serde::Deserializer<'de>>(from: D) -> Result<Label, D::Error> {
        let (source, row) = serde::Deserialize::deserialize(from)?;
        Ok(Label::of(source, row, Vec::new()))
    }
}

/// Largest number of labels that a thread keeps, and the longest of them (bytes): those of a few
/// sheets. The bounds keep memory constant in a batch of thousands of sheets.
const MOST_LABELS: usize = 2048;
const LONGEST_LABEL: usize = 200;

/// The labels of formulas that a thread has made.
#[derive(Default)]
struct Formulas {
    labels: HashMap<String, Label>,
    /// True if they were typeset with the Chinese font.
    with_song: bool,
}

thread_local! {
    static FORMULAS: RefCell<Formulas> = RefCell::default();
}

/// The effect of an atom on the space around it, as in TeX.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "wire", derive(serde::Serialize, serde::Deserialize))]
pub enum Role {
    /// A letter, a digit, a word.
    Ordinary,
    /// `+ − ×` between two operands.
    Binary,
    /// `= → ≈ <`.
    Relation,
    /// `, ;`.
    Punctuation,
    /// A function's name: a thin space before its argument.
    Function,
}

/// One atom with its scripts.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "wire", derive(serde::Serialize, serde::Deserialize))]
pub struct LabelNode {
    /// The characters.
    pub text: String,
    /// Type style of the characters.
    pub slant: Slant,
    /// Effect on the space around them.
    pub role: Role,
    /// Extra space after the atom, in em.
    pub space_em: f64,
    /// Number of primes.
    pub primes: usize,
    /// The subscript's row; empty if there is none.
    pub sub: Vec<LabelNode>,
    /// The superscript's row; empty if there is none.
    pub sup: Vec<LabelNode>,
}

impl LabelNode {
    fn new(text: impl Into<String>, slant: Slant, role: Role) -> LabelNode {
        LabelNode {
            text: text.into(),
            slant,
            role,
            space_em: 0.0,
            primes: 0,
            sub: Vec::new(),
            sup: Vec::new(),
        }
    }

    fn space(em: f64) -> LabelNode {
        LabelNode { space_em: em, ..LabelNode::new("", Slant::Upright, Role::Ordinary) }
    }
}

impl Label {
    /// Parses a formula. Never fails: unreadable input is kept unchanged and reported by
    /// [`Label::faults`].
    pub fn math(source: impl Into<String>) -> Label {
        let source = source.into();
        if source.len() > LONGEST_LABEL {
            return Label::parsed(source);
        }
        FORMULAS.with_borrow_mut(|formulas| {
            let with_song = has_song();
            if formulas.with_song != with_song || formulas.labels.len() >= MOST_LABELS {
                *formulas = Formulas { with_song, ..Formulas::default() };
            }
            if let Some(known) = formulas.labels.get(&source) {
                return known.clone();
            }
            let label = Label::parsed(source.clone());
            formulas.labels.insert(source, label.clone());
            label
        })
    }

    fn parsed(source: String) -> Label {
        let (row, faults) = parse::formula(&source);
        Label::of(source, row, faults)
    }

    fn of(source: String, row: Vec<LabelNode>, faults: Vec<Diagnostic>) -> Label {
        let (fonts, kept) = (Fonts::default(), OnceLock::new());
        Label(Arc::new(LabelContent { source, row, faults, fonts, kept }))
    }

    /// Returns a label of a sentence: every character upright and unchanged.
    pub fn text(source: impl Into<String>) -> Label {
        let source = source.into();
        let row = vec![LabelNode::new(source.as_str(), Slant::Upright, Role::Ordinary)];
        Label::of(source, row, Vec::new())
    }

    /// Returns the label typeset in the author's fonts; the figure passes the fonts of its style.
    pub fn in_fonts(mut self, fonts: &Fonts) -> Label {
        if self.0.fonts != *fonts {
            let content = self.content();
            content.fonts = fonts.clone();
        }
        self
    }

    /// Returns this label followed by another, such as a caption's words followed by a formula.
    pub fn then(mut self, other: Label) -> Label {
        let content = self.content();
        content.source.push_str(&other.0.source);
        content.row.extend(other.0.row.iter().cloned());
        content.faults.extend(other.0.faults.iter().cloned());
        self
    }

    /// The content to be changed, not yet typeset.
    fn content(&mut self) -> &mut LabelContent {
        let content = Arc::make_mut(&mut self.0);
        content.kept = OnceLock::new();
        content
    }

    /// The cell in which [`super::text::set`] keeps its result.
    pub(super) fn kept(&self) -> &OnceLock<Arc<Typeset>> {
        &self.0.kept
    }

    /// The author's fonts for this label.
    pub fn fonts(&self) -> &Fonts {
        &self.0.fonts
    }

    /// Source text of the label.
    pub fn source(&self) -> &str {
        &self.0.source
    }

    /// The row of atoms.
    pub fn row(&self) -> &[LabelNode] {
        &self.0.row
    }

    /// Faults of the source (`label-syntax`).
    pub fn faults(&self) -> &[Diagnostic] {
        &self.0.faults
    }

    /// Returns the label in one line of plain characters, for screen readers and text reports:
    /// `ω_1^2 l_AB`, `3 m/s²`.
    pub fn plain(&self) -> String {
        let mut out = String::new();
        plain_row(self.row(), &mut out);
        out
    }
}

fn plain_row(row: &[LabelNode], out: &mut String) {
    for node in row {
        let spaced = matches!(node.role, Role::Relation | Role::Binary);
        if spaced {
            out.push(' ');
        }
        out.push_str(&node.text);
        out.extend(std::iter::repeat_n('′', node.primes));
        for (mark, script) in [('_', &node.sub), ('^', &node.sup)] {
            if script.is_empty() {
                continue;
            }
            let mut told = String::new();
            plain_row(script, &mut told);
            match (mark, node.slant, told.trim()) {
                // Powers of units are written as in running text.
                ('^', Slant::Upright, "2") => out.push('²'),
                ('^', Slant::Upright, "3") => out.push('³'),
                (_, _, parts) if parts.contains(' ') => {
                    out.push(mark);
                    out.push_str(&format!("({parts})"));
                }
                _ => {
                    out.push(mark);
                    out.push_str(&told);
                }
            }
        }
        if spaced || node.space_em > 0.0 {
            out.push(' ');
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shape(source: &str) -> String {
        fn row(nodes: &[LabelNode]) -> String {
            nodes
                .iter()
                .map(|n| {
                    let mark = match n.slant {
                        Slant::Italic => 'i',
                        Slant::Bold => 'b',
                        Slant::Upright => 'u',
                        Slant::Symbol => 's',
                    };
                    let mut s = format!("{mark}:{}{}", n.text, "'".repeat(n.primes));
                    if !n.sub.is_empty() {
                        s += &format!("_({})", row(&n.sub));
                    }
                    if !n.sup.is_empty() {
                        s += &format!("^({})", row(&n.sup));
                    }
                    s
                })
                .collect::<Vec<_>>()
                .join(" ")
        }
        let label = Label::math(source);
        assert_eq!(label.faults(), [], "{source}");
        row(label.row())
    }

    #[test]
    fn quantities_points_and_numbers() {
        assert_eq!(shape("v_{B3B2}^r"), "i:v_(i:B u:3 i:B u:2)^(i:r)");
        assert_eq!(shape("a^n_{CB}"), "i:a_(i:CB)^(i:n)");
        assert_eq!(shape(r"\bm{a}^n_{CB}"), "b:a_(i:CB)^(i:n)");
        assert_eq!(shape(r"\omega_1^2 l_{AB}"), "i:ω_(u:1)^(u:2) i:l_(i:AB)");
        assert_eq!(shape("b'_2"), "i:b'_(u:2)");
        assert_eq!(shape("b_2'"), "i:b'_(u:2)");
        assert_eq!(shape("n''"), "i:n''");
        assert_eq!(shape(r"2\omega_3 v_{B3B2}"), "u:2 i:ω_(u:3) i:v_(i:B u:3 i:B u:2)");
        assert_eq!(shape(r"B \to A"), "i:B s:→ i:A");
        assert_eq!(shape(r"\perp AB"), "s:⊥ i:AB");
        assert_eq!(shape("?"), "u:?");
    }

    #[test]
    fn units_follow_a_number_and_a_space() {
        assert_eq!(shape(r"\mu_l = 0.002 m/mm"), "i:μ_(i:l) s:= u:0.002 u: u:m/mm");
        assert_eq!(
            shape(r"\mu_v = 0.01 (m/s)/mm"),
            "i:μ_(i:l) s:= u:0.01 u: u:(m/s)/mm".replace("(i:l)", "(i:v)")
        );
        assert_eq!(shape("a = 12 m/s^2, b"), "i:a s:= u:12 u: u:m/s^(u:2) u:, i:b");
        assert_eq!(shape(r"2.7 \times 10^{10} m/s^2"), "u:2.7 s:× u:10^(u:10) u: u:m/s^(u:2)");
        assert_eq!(shape("2l"), "u:2 i:l");
        assert_eq!(shape("2 + l"), "u:2 s:+ i:l");
    }

    #[test]
    fn words_chinese_and_circles() {
        assert_eq!(shape(r"v_{\text{max}}"), "i:v_(u:max)");
        assert_eq!(shape("大小 v_B"), "u:大小 u: i:v_(i:B)");
        assert_eq!(shape(r"\circled{3}"), "s:③");
        assert_eq!(shape(r"\checkmark"), "s:✓");
        assert_eq!(shape(r"\surd"), "s:√");
    }

    #[test]
    fn faults_are_said_and_the_rest_stays() {
        for (source, word) in [
            (r"\fooo_1", "fooo"),
            ("v_{B", "}"),
            ("v_", "_"),
            ("v_1_2", "_"),
            ("}", "}"),
            (r"\circled{99}", "99"),
        ] {
            let label = Label::math(source);
            assert_eq!(label.faults().len(), 1, "{source}: {:?}", label.faults());
            assert_eq!(label.faults()[0].code, "label-syntax");
            assert!(label.faults()[0].message.en.contains(word), "{source}: {}", label.faults()[0]);
        }
    }

    #[test]
    fn plain_line() {
        assert_eq!(Label::math(r"\omega_1^2 l_{AB}").plain(), "ω_1^2l_AB");
        assert_eq!(Label::math("3 m/s^2").plain(), "3 m/s²");
        assert_eq!(Label::math(r"a^{e\,t}_{C}").plain(), "a_C^(e t)");
        assert_eq!(Label::math(r"\mu_l = 0.002 m/mm").plain(), "μ_l = 0.002 m/mm");
        assert_eq!(Label::math(r"\angle -90.00").plain(), "∠−90.00");
        assert_eq!(Label::text("Velocity polygon").plain(), "Velocity polygon");
        assert_eq!(Label::text("Ⅱ级杆组").plain(), "Ⅱ级杆组");
        assert_eq!(
            Label::text("Link 2, ").then(Label::math(r"\omega_2 = 3 rad/s")).plain(),
            "Link 2, ω_2 = 3 rad/s"
        );
    }
}
