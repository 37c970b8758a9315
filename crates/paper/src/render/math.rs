//! Formulas of the label language as MathML, TeX and Typst.
//!
//! One traversal of a parsed [`Label`] serves all languages; each defines its form of letters,
//! numbers, signs and scripts. The appearance is the same as on figures: letters of quantities
//! italic, units and words upright.

use super::escaped;
use crate::paper::font::Slant;
use crate::paper::label::{Label, LabelNode, Role};

/// A part of a displayed formula.
#[derive(Clone, Debug, PartialEq)]
pub enum Math {
    /// A row of signs.
    Row(Label),
    /// One row over another.
    Fraction(Label, Label),
    /// The square root of a row.
    Root(Label),
}

impl Math {
    /// Returns the part in one line of characters: `(a)/(b)`, `√(a)`.
    pub fn plain(&self) -> String {
        match self {
            Math::Row(row) => row.plain(),
            Math::Fraction(over, under) => format!("({})/({})", over.plain(), under.plain()),
            Math::Root(row) => format!("√({})", row.plain()),
        }
    }
}

/// Smallest width of a space between words, in em.
const WORD_EM: f64 = 0.2;

/// An output language for formulas.
trait Tongue {
    /// Writes letters of quantities: `AB`, `ω`.
    fn letters(&self, text: &str) -> String;
    /// Writes letters of vectors, bold.
    fn bold(&self, text: &str) -> String;
    /// Writes a number.
    fn number(&self, text: &str) -> String;
    /// Writes upright words and units.
    fn words(&self, text: &str) -> String;
    /// Writes a sign, such as `=`, `⊥`, `(`.
    fn sign(&self, c: char, role: Role) -> String;
    /// Writes a function's name.
    fn function(&self, name: &str) -> String;
    /// Writes a space, in em.
    fn space(&self, em: f64) -> String;
    /// Writes a base with its primes, subscript and superscript (each may be empty).
    fn scripts(&self, base: String, primes: usize, sub: String, sup: String) -> String;
    /// Writes a fraction.
    fn fraction(&self, over: String, under: String) -> String;
    /// Writes a square root.
    fn root(&self, row: String) -> String;
    /// Joins adjacent pieces.
    fn join(&self, pieces: Vec<String>) -> String;

    fn row(&self, row: &[LabelNode]) -> String {
        self.join(row.iter().flat_map(|n| self.node(n)).collect())
    }

    fn node(&self, n: &LabelNode) -> Vec<String> {
        let mut out = Vec::new();
        if !n.text.is_empty() || n.primes > 0 || !n.sub.is_empty() || !n.sup.is_empty() {
            let base = self.base(n);
            let (sub, sup) = (self.row(&n.sub), self.row(&n.sup));
            out.push(if n.primes == 0 && sub.is_empty() && sup.is_empty() {
                base
            } else {
                self.scripts(base, n.primes, sub, sup)
            });
        }
        if n.space_em > 0.0 {
            out.push(self.space(n.space_em));
        }
        out
    }

    fn base(&self, n: &LabelNode) -> String {
        let mut chars = n.text.chars();
        match (n.slant, chars.next(), chars.next()) {
            (_, None, _) => String::new(),
            // A space between words that are set one by one.
            (_, Some(' '), None) => self.space(WORD_EM),
            _ if n.role == Role::Function => self.function(&n.text),
            (Slant::Italic, ..) => self.letters(&n.text),
            (Slant::Bold, ..) => self.bold(&n.text),
            _ if n.text.chars().all(|c| c.is_ascii_digit() || c == '.') => self.number(&n.text),
            (_, Some(c), None) if !c.is_alphanumeric() || n.slant == Slant::Symbol => {
                self.sign(c, n.role)
            }
            _ => self.words(&n.text),
        }
    }

    fn formula(&self, parts: &[Math]) -> String {
        let part = |m: &Math| match m {
            Math::Row(l) => self.row(l.row()),
            Math::Fraction(over, under) => {
                self.fraction(self.row(over.row()), self.row(under.row()))
            }
            Math::Root(l) => self.root(self.row(l.row())),
        };
        self.join(parts.iter().map(part).collect())
    }
}

/// Returns an inline formula as MathML.
pub fn mathml(label: &Label) -> String {
    format!("<math><mrow>{}</mrow></math>", Mathml.row(label.row()))
}

/// Returns a displayed formula as MathML.
pub fn mathml_display(parts: &[Math]) -> String {
    format!("<math display=\"block\"><mrow>{}</mrow></math>", Mathml.formula(parts))
}

/// Returns a formula in TeX, without dollar signs.
pub fn tex(label: &Label) -> String {
    Tex.row(label.row())
}

/// Returns a formula of several parts in TeX.
pub fn tex_display(parts: &[Math]) -> String {
    Tex.formula(parts)
}

/// Returns a formula in Typst, without dollar signs.
pub fn typst(label: &Label) -> String {
    Typst.row(label.row())
}

/// Returns a formula of several parts in Typst.
pub fn typst_display(parts: &[Math]) -> String {
    Typst.formula(parts)
}

struct Mathml;

impl Tongue for Mathml {
    fn letters(&self, text: &str) -> String {
        let each: String = text.chars().map(|c| format!("<mi>{c}</mi>")).collect();
        if text.chars().count() > 1 { format!("<mrow>{each}</mrow>") } else { each }
    }
    fn bold(&self, text: &str) -> String {
        // Of the letter variants, browsers support only the upright one.
        self.letters(text).replace("<mi>", "<mi style=\"font-weight:bold\">")
    }
    fn number(&self, text: &str) -> String {
        format!("<mn>{text}</mn>")
    }
    fn words(&self, text: &str) -> String {
        format!("<mtext>{}</mtext>", escaped(text))
    }
    fn sign(&self, c: char, role: Role) -> String {
        let c = escaped(&c.to_string());
        match role {
            Role::Ordinary if matches!(c.as_str(), "(" | ")" | "[" | "]" | "|") => {
                format!("<mo stretchy=\"false\">{c}</mo>")
            }
            // A sign used as a symbol, as `?` or `⊥` before a line, has no space around it.
            Role::Ordinary => format!("<mo lspace=\"0\" rspace=\"0\">{c}</mo>"),
            Role::Binary | Role::Relation | Role::Punctuation | Role::Function => {
                format!("<mo>{c}</mo>")
            }
        }
    }
    fn function(&self, name: &str) -> String {
        format!("<mi mathvariant=\"normal\">{name}</mi><mo>&#x2061;</mo>")
    }
    fn space(&self, em: f64) -> String {
        format!("<mspace width=\"{em}em\"/>")
    }
    fn scripts(&self, base: String, primes: usize, sub: String, sup: String) -> String {
        let (above, below) = (format!("<mrow>{sup}</mrow>"), format!("<mrow>{sub}</mrow>"));
        // The prime is already a raised sign: as a superscript Chromium would raise it again. The
        // subscript is below it.
        // Two separate primes would be drawn over one another.
        let marks = if primes == 2 { "″".to_owned() } else { "′".repeat(primes) };
        let marks = format!("<mi mathvariant=\"normal\">{marks}</mi>");
        let base = match (primes, sub.is_empty()) {
            (0, _) => base,
            (_, true) => format!("<mrow>{base}{marks}</mrow>"),
            (_, false) => format!("<mrow>{base}<mpadded width=\"0\">{marks}</mpadded></mrow>"),
        };
        // Below the descender of φ or μ a subscript would be lower than below ω: the base is
        // declared to have no depth.
        let base = match (base.is_empty(), sub.is_empty()) {
            (true, _) => "<mrow></mrow>".to_owned(),
            (false, true) => base,
            (false, false) => format!("<mpadded depth=\"0\">{base}</mpadded>"),
        };
        match (sub.is_empty(), sup.is_empty()) {
            (true, true) => base,
            (true, false) => format!("<msup>{base}{above}</msup>"),
            (false, true) => format!("<msub>{base}{below}</msub>"),
            (false, false) => format!("<msubsup>{base}{below}{above}</msubsup>"),
        }
    }
    fn fraction(&self, over: String, under: String) -> String {
        format!("<mfrac><mrow>{over}</mrow><mrow>{under}</mrow></mfrac>")
    }
    fn root(&self, row: String) -> String {
        format!("<msqrt>{row}</msqrt>")
    }
    fn join(&self, pieces: Vec<String>) -> String {
        pieces.concat()
    }
}

struct Tex;

/// Signs with a command that are also in the text fonts of LaTeX.
const TEXT_SIGNS: [char; 5] = ['°', '·', '×', '±', 'µ'];

/// Returns the command of a sign or a Greek letter in TeX, and its name in Typst.
fn named(c: char) -> Option<(&'static str, &'static str)> {
    Some(match c {
        'α' => ("\\alpha", "alpha"),
        'β' => ("\\beta", "beta"),
        'γ' => ("\\gamma", "gamma"),
        'δ' => ("\\delta", "delta"),
        'ε' => ("\\varepsilon", "epsilon"),
        'ζ' => ("\\zeta", "zeta"),
        'η' => ("\\eta", "eta"),
        'θ' => ("\\theta", "theta"),
        'ι' => ("\\iota", "iota"),
        'κ' => ("\\kappa", "kappa"),
        'λ' => ("\\lambda", "lambda"),
        'μ' | 'µ' => ("\\mu", "mu"),
        'ν' => ("\\nu", "nu"),
        'ξ' => ("\\xi", "xi"),
        'π' => ("\\pi", "pi"),
        'ρ' => ("\\rho", "rho"),
        'σ' => ("\\sigma", "sigma"),
        'τ' => ("\\tau", "tau"),
        'υ' => ("\\upsilon", "upsilon"),
        'φ' => ("\\varphi", "phi"),
        'χ' => ("\\chi", "chi"),
        'ψ' => ("\\psi", "psi"),
        'ω' => ("\\omega", "omega"),
        'Γ' => ("\\Gamma", "Gamma"),
        'Δ' => ("\\Delta", "Delta"),
        'Θ' => ("\\Theta", "Theta"),
        'Λ' => ("\\Lambda", "Lambda"),
        'Π' => ("\\Pi", "Pi"),
        'Σ' => ("\\Sigma", "Sigma"),
        'Φ' => ("\\Phi", "Phi"),
        'Ψ' => ("\\Psi", "Psi"),
        'Ω' => ("\\Omega", "Omega"),
        '−' => ("-", "-"),
        '×' => ("\\times", "times"),
        '·' | '⋅' => ("\\cdot", "dot.op"),
        '±' => ("\\pm", "plus.minus"),
        '→' => ("\\to", "arrow.r"),
        '←' => ("\\leftarrow", "arrow.l"),
        '≈' => ("\\approx", "approx"),
        '≠' => ("\\neq", "eq.not"),
        '≤' => ("\\leq", "lt.eq"),
        '≥' => ("\\geq", "gt.eq"),
        '⊥' => ("\\perp", "perp"),
        '∥' => ("\\parallel", "parallel"),
        '∠' => ("\\angle", "angle"),
        '√' => ("\\surd", "\"√\""),
        '✓' => ("\\checkmark", "\"✓\""),
        '∞' => ("\\infty", "infinity"),
        '∼' => ("\\sim", "tilde.op"),
        '∽' => ("\\backsim", "tilde.rev"),
        '°' => ("{}^\\circ", "degree"),
        _ => return None,
    })
}

impl Tongue for Tex {
    fn letters(&self, text: &str) -> String {
        let each: Vec<String> = text
            .chars()
            .map(|c| named(c).map_or_else(|| c.to_string(), |(tex, _)| tex.to_owned()))
            .collect();
        self.join(each)
    }
    fn bold(&self, text: &str) -> String {
        format!("\\boldsymbol{{{}}}", self.letters(text))
    }
    fn number(&self, text: &str) -> String {
        text.to_owned()
    }
    fn words(&self, text: &str) -> String {
        // A closing bracket around the words is not part of them.
        let (inner, close) = match text.strip_suffix(')').filter(|inner| !inner.contains('(')) {
            Some(inner) => (inner, ")"),
            None => (text, ""),
        };
        // Signs that the text fonts of LaTeX lack are signs of the formula.
        let mut pieces = vec![String::new()];
        for c in inner.chars() {
            match named(c).filter(|_| !TEXT_SIGNS.contains(&c)) {
                Some((command, _)) => pieces.extend([command.to_owned(), String::new()]),
                None => pieces.last_mut().expect("there is a piece").push(c),
            }
        }
        let words = |(k, piece): (usize, String)| match k % 2 {
            0 if piece.is_empty() && k > 0 => String::new(),
            0 => format!("\\text{{{}}}", tex_escaped(&piece)),
            _ => piece,
        };
        self.join(pieces.into_iter().enumerate().map(words).collect()) + close
    }
    fn sign(&self, c: char, _: Role) -> String {
        named(c).map_or_else(|| tex_escaped(&c.to_string()), |(tex, _)| tex.to_owned())
    }
    fn function(&self, name: &str) -> String {
        format!("\\{name}")
    }
    fn space(&self, em: f64) -> String {
        let command = match em {
            1.0.. => r"\quad",
            WORD_EM.. => r"\ ",
            _ => r"\,",
        };
        command.to_owned()
    }
    fn scripts(&self, base: String, primes: usize, sub: String, sup: String) -> String {
        let mut out = if base.is_empty() { "{}".to_owned() } else { base };
        out += &"'".repeat(primes);
        for (mark, script) in [('_', sub), ('^', sup)] {
            if !script.is_empty() {
                out += &format!("{mark}{{{script}}}");
            }
        }
        out
    }
    fn fraction(&self, over: String, under: String) -> String {
        format!("\\frac{{{over}}}{{{under}}}")
    }
    fn root(&self, row: String) -> String {
        format!("\\sqrt{{{row}}}")
    }
    fn join(&self, pieces: Vec<String>) -> String {
        let mut out = String::new();
        for p in pieces {
            // A command ends at the first character that is not a letter.
            let open = out.rfind('\\').is_some_and(|i| {
                out.len() > i + 1 && out[i + 1..].chars().all(|c| c.is_ascii_alphabetic())
            });
            if open && p.starts_with(|c: char| c.is_ascii_alphabetic()) {
                out.push(' ');
            }
            out += &p;
        }
        out
    }
}

fn tex_escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '\\' => out += "\\backslash ",
            '{' | '}' | '_' | '$' | '%' | '#' | '&' => {
                out.push('\\');
                out.push(c);
            }
            c => out.push(c),
        }
    }
    out
}

struct Typst;

impl Tongue for Typst {
    fn letters(&self, text: &str) -> String {
        let each: Vec<String> = text
            .chars()
            .map(|c| named(c).map_or_else(|| c.to_string(), |(_, typst)| typst.to_owned()))
            .collect();
        each.join(" ")
    }
    fn bold(&self, text: &str) -> String {
        format!("bold({})", self.letters(text))
    }
    fn number(&self, text: &str) -> String {
        text.to_owned()
    }
    fn words(&self, text: &str) -> String {
        quoted(text)
    }
    fn sign(&self, c: char, _: Role) -> String {
        match (named(c), c) {
            (Some((_, typst)), _) => typst.to_owned(),
            // Characters with a meaning in Typst's formulas are written as text.
            (None, '+' | '=' | '<' | '>' | '?' | '!' | ':' | '|') => c.to_string(),
            (None, _) => quoted(&c.to_string()),
        }
    }
    fn function(&self, name: &str) -> String {
        name.to_owned()
    }
    fn space(&self, em: f64) -> String {
        let name = match em {
            1.0.. => "quad",
            WORD_EM.. => "\" \"",
            _ => "thin",
        };
        name.to_owned()
    }
    fn scripts(&self, base: String, primes: usize, sub: String, sup: String) -> String {
        // Scripts need a base.
        let mut out = if base.is_empty() { "\"\"".to_owned() } else { base };
        out += &"'".repeat(primes);
        for (mark, script) in [('_', sub), ('^', sup)] {
            if !script.is_empty() {
                out += &format!("{mark}({script})");
            }
        }
        out
    }
    fn fraction(&self, over: String, under: String) -> String {
        format!("frac({over}, {under})")
    }
    fn root(&self, row: String) -> String {
        format!("sqrt({row})")
    }
    fn join(&self, pieces: Vec<String>) -> String {
        let mut out = String::new();
        for p in pieces {
            // A space beside quoted text is printed; elsewhere it only separates names.
            if !out.is_empty() && !out.ends_with('"') && !p.starts_with('"') {
                out.push(' ');
            }
            out += &p;
        }
        out
    }
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_formula_in_three_languages() {
        let l = Label::math(r"a^n_{CB} = \omega_2^2 l_{BC}");
        assert_eq!(tex(&l), r"a_{CB}^{n}=\omega_{2}^{2}l_{BC}");
        assert_eq!(typst(&l), "a_(C B)^(n) = omega_(2)^(2) l_(B C)");
        assert_eq!(
            mathml(&l),
            "<math><mrow><msubsup><mpadded depth=\"0\"><mi>a</mi></mpadded><mrow><mrow><mi>C</mi><mi>B</mi></mrow></mrow><mrow><mi>n</mi></mrow></msubsup><mo>=</mo>\
             <msubsup><mpadded depth=\"0\"><mi>ω</mi></mpadded><mrow><mn>2</mn></mrow><mrow><mn>2</mn></mrow></msubsup>\
             <msub><mpadded depth=\"0\"><mi>l</mi></mpadded><mrow><mrow><mi>B</mi><mi>C</mi></mrow></mrow></msub></mrow></math>"
        );
    }

    #[test]
    fn units_primes_signs_and_words() {
        let l = Label::math(r"\mu_v = 0.01 (m/s)/mm");
        assert_eq!(tex(&l), r"\mu_{v}=0.01\ \text{(m/s)/mm}");
        assert_eq!(typst(&l), r#"mu_(v) = 0.01" ""(m/s)/mm""#);
        assert_eq!(tex(&Label::math(r"b'_2")), "b'_{2}");
        let bold = Label::math(r"\bm{v}_{B}");
        assert_eq!(
            (tex(&bold).as_str(), typst(&bold).as_str()),
            (r"\boldsymbol{v}_{B}", "bold(v)_(B)")
        );
        assert!(mathml(&bold).contains("<mi style=\"font-weight:bold\">v</mi>"));
        assert_eq!(typst(&Label::math(r"\perp AB")), "perp A B");
        assert_eq!(tex(&Label::math(r"\perp AB")), r"\perp AB");
        assert_eq!(typst(&Label::math("B \\to A")), "B arrow.r A");
        assert_eq!(tex(&Label::math("大小 v")), r"\text{大小}\ v");
        assert_eq!(typst(&Label::math("(v_B)^2/\\rho")), r#""("v_(B)")"^(2)"/"rho"#);
    }

    #[test]
    fn fractions_and_roots() {
        let f = [
            Math::Row(Label::math("\\omega_3 =")),
            Math::Fraction(Label::math("v_C"), Label::math("l_{CD}")),
        ];
        assert_eq!(tex_display(&f), r"\omega_{3}=\frac{v_{C}}{l_{CD}}");
        assert_eq!(typst_display(&f), "omega_(3) = frac(v_(C), l_(C D))");
        assert!(mathml_display(&f).contains("<mfrac><mrow><msub><mpadded depth=\"0\"><mi>v</mi>"));
        assert_eq!(tex_display(&[Math::Root(Label::math("3^2 + 4^2"))]), r"\sqrt{3^{2}+4^{2}}");
    }
}
