//! The parser of the label language: characters to rows of atoms.

use crate::paper::font::Slant;
use hodograph_base::diag::{Both, Diagnostic, both};

use super::{LabelNode, Role};

/// A thin space, TeX's `\,`: 3/18 em.
const THIN_EM: f64 = 0.167;
/// Returns true if a number can end with the node: upright, without scripts, or a power of ten.
fn ends_a_number(n: &LabelNode) -> bool {
    n.slant == Slant::Upright && n.sub.is_empty() && (n.sup.is_empty() || n.text == "10")
}

/// An interword space of Times: 1/4 em. It separates a number from its unit, and letters from
/// Chinese.
const WORD_EM: f64 = 0.25;

/// Parses a formula; unreadable characters are reported and kept upright.
pub fn formula(source: &str) -> (Vec<LabelNode>, Vec<Diagnostic>) {
    let mut p = Parser { source, chars: source.chars().collect(), at: 0, faults: Vec::new() };
    let row = p.row(false);
    (row, p.faults)
}

struct Parser<'a> {
    source: &'a str,
    chars: Vec<char>,
    at: usize,
    faults: Vec<Diagnostic>,
}

impl Parser<'_> {
    fn peek(&self) -> Option<char> {
        self.chars.get(self.at).copied()
    }

    fn fault(&mut self, what: Both) {
        let help = both!("see the label language: v_{{B3B2}}^r, \\omega_1, b'_2, \\text{{words}}");
        self.faults.push(
            Diagnostic::error("label-syntax", both!("label `{}`: {}", self.source, what))
                .help(help),
        );
    }

    fn take_while(&mut self, keep: impl Fn(char) -> bool) -> String {
        let start = self.at;
        while self.peek().is_some_and(&keep) {
            self.at += 1;
        }
        self.chars[start..self.at].iter().collect()
    }

    /// Parses a row up to the end of the input, or up to the closing brace.
    fn row(&mut self, braced: bool) -> Vec<LabelNode> {
        let mut row: Vec<LabelNode> = Vec::new();
        while let Some(c) = self.peek() {
            match c {
                '}' if braced => {
                    self.at += 1;
                    return row;
                }
                '}' => {
                    self.at += 1;
                    self.fault(both!("a }} that closes nothing"));
                }
                '{' => {
                    self.at += 1;
                    let inner = self.row(true);
                    row.extend(inner);
                }
                '_' | '^' => self.script(c, &mut row),
                '\'' | '′' => {
                    let n = self.take_while(|c| c == '\'' || c == '′').chars().count();
                    self.host(&mut row, "′").primes += n;
                }
                c if c.is_whitespace() => self.space(&mut row),
                '\\' => self.command(&mut row),
                c if c.is_ascii_digit() => {
                    // A dot belongs to the number if a digit follows it.
                    let mut text = self.take_while(|c| c.is_ascii_digit());
                    while self.peek() == Some('.')
                        && self.chars.get(self.at + 1).is_some_and(char::is_ascii_digit)
                    {
                        self.at += 1;
                        text.push('.');
                        text += &self.take_while(|c| c.is_ascii_digit());
                    }
                    row.push(LabelNode::new(text, Slant::Upright, Role::Ordinary));
                }
                c if is_quantity_letter(c) => {
                    let text = self.take_while(is_quantity_letter);
                    row.push(LabelNode::new(text, Slant::Italic, Role::Ordinary));
                }
                c if is_cjk(c) => {
                    let text = self.take_while(is_cjk);
                    row.push(LabelNode::new(text, Slant::Upright, Role::Ordinary));
                }
                c => {
                    self.at += 1;
                    row.push(symbol(c, &row));
                }
            }
        }
        if braced {
            self.fault(both!("a {{ without its }}"));
        }
        row
    }

    /// Returns the atom of a script or prime: the last letter of a run of letters, or a new empty
    /// atom.
    fn host<'r>(&mut self, row: &'r mut Vec<LabelNode>, mark: &str) -> &'r mut LabelNode {
        match row.last_mut() {
            None => {
                self.fault(both!("{mark} stands on nothing"));
                row.push(LabelNode::new("", Slant::Upright, Role::Ordinary));
            }
            // A script belongs to one letter: in `AB_1` to B.
            Some(last)
                if last.slant == Slant::Italic
                    && last.sub.is_empty()
                    && last.sup.is_empty()
                    && last.primes == 0 =>
            {
                if let Some((i, c)) = last.text.char_indices().next_back().filter(|&(i, _)| i > 0) {
                    last.text.truncate(i);
                    row.push(LabelNode::new(c, Slant::Italic, Role::Ordinary));
                }
            }
            Some(_) => {}
        }
        row.last_mut().expect("an atom was there or has just been pushed")
    }

    fn script(&mut self, mark: char, row: &mut Vec<LabelNode>) {
        self.at += 1;
        while self.peek().is_some_and(char::is_whitespace) {
            self.at += 1;
        }
        let mut inner = match self.peek() {
            Some('{') => {
                self.at += 1;
                self.row(true)
            }
            Some('\\') => {
                let mut one = Vec::new();
                self.command(&mut one);
                one
            }
            Some(c) if !matches!(c, '_' | '^' | '}') => {
                self.at += 1;
                let slant = if is_quantity_letter(c) { Slant::Italic } else { Slant::Upright };
                let c = if c == '-' { '−' } else { c };
                vec![LabelNode::new(c, slant, Role::Ordinary)]
            }
            _ => {
                self.fault(both!("{mark} without a script"));
                return;
            }
        };
        // Signs in a script have no space around them, as in TeX's script style.
        for n in &mut inner {
            n.role = Role::Ordinary;
        }
        let host = self.host(row, &mark.to_string());
        let slot = if mark == '_' { &mut host.sub } else { &mut host.sup };
        if slot.is_empty() {
            *slot = inner;
        } else {
            self.fault(both!("two {mark} on one letter"));
        }
    }

    /// Reads a space. It is significant beside Chinese, and after a number followed by letters,
    /// which are then its unit.
    fn space(&mut self, row: &mut Vec<LabelNode>) {
        self.take_while(char::is_whitespace);
        let Some(last) = row.last().and_then(|n| n.text.chars().last()) else { return };
        let Some(next) = self.peek() else { return };
        if is_cjk(last) || is_cjk(next) {
            row.push(LabelNode::space(WORD_EM));
        } else if row.last().is_some_and(ends_a_number) && last.is_ascii_digit() {
            let micro = self.chars[self.at..].starts_with(&['\\', 'm', 'u', ' ']);
            if next.is_ascii_alphabetic() || matches!(next, '(' | '°' | 'µ' | 'μ' | '%') || micro
            {
                row.push(LabelNode::space(WORD_EM));
                self.unit(row);
            }
        }
    }

    fn unit(&mut self, row: &mut Vec<LabelNode>) {
        let is_unit = |c: char| {
            c.is_ascii_alphanumeric()
                || matches!(c, '/' | '(' | ')' | '·' | '⋅' | '°' | 'µ' | 'μ' | '%' | '²' | '³')
        };
        loop {
            let text = self.take_while(is_unit);
            if !text.is_empty() {
                row.push(LabelNode::new(text, Slant::Upright, Role::Ordinary));
            }
            match self.peek() {
                Some('^') => self.script('^', row),
                _ => return,
            }
        }
    }

    fn command(&mut self, row: &mut Vec<LabelNode>) {
        self.at += 1;
        let name = self.take_while(|c| c.is_ascii_alphabetic());
        if name.is_empty() {
            match self.peek() {
                Some(',') => row.push(LabelNode::space(THIN_EM)),
                Some(' ') => row.push(LabelNode::space(WORD_EM)),
                Some(c @ ('{' | '}' | '_' | '^' | '\\' | '\'' | '%' | '#' | '&')) => {
                    row.push(LabelNode::new(c, Slant::Upright, Role::Ordinary))
                }
                _ => {
                    self.fault(both!("a \\ with no command after it"));
                    return;
                }
            }
            self.at += 1;
            return;
        }
        match name.as_str() {
            "text" => {
                let words = self.argument();
                row.push(LabelNode::new(words, Slant::Upright, Role::Ordinary));
            }
            "circled" => {
                let n = self.argument();
                match n.parse::<u32>() {
                    Ok(k @ 1..=20) => {
                        let c = char::from_u32(0x2460 + k - 1).expect("① to ⑳ are characters");
                        row.push(LabelNode::new(c, Slant::Symbol, Role::Ordinary));
                    }
                    _ => self.fault(both!("\\circled takes a number from 1 to 20, not `{n}`")),
                }
            }
            "bm" => {
                let letters = self.argument();
                if letters.chars().all(|c| c.is_ascii_alphabetic()) {
                    row.push(LabelNode::new(letters, Slant::Bold, Role::Ordinary));
                } else {
                    self.fault(both!("\\bm takes letters, not `{letters}`"));
                }
            }
            "quad" => row.push(LabelNode::space(1.0)),
            "sin" | "cos" | "tan" | "arctan" | "arcsin" | "arccos" => {
                row.push(LabelNode::new(name, Slant::Upright, Role::Function))
            }
            _ => match named(&name) {
                Some((c, CharKind::Letter)) => {
                    row.push(LabelNode::new(c, Slant::Italic, Role::Ordinary))
                }
                Some((c, CharKind::Capital)) => {
                    row.push(LabelNode::new(c, Slant::Upright, Role::Ordinary))
                }
                Some((c, CharKind::Sign)) => row.push(symbol(c, row)),
                None => {
                    self.fault(both!("unknown command \\{name}"));
                    row.push(LabelNode::new(name, Slant::Upright, Role::Ordinary));
                }
            },
        }
    }

    /// Returns the characters between the braces after a command, unchanged.
    fn argument(&mut self) -> String {
        if self.peek() != Some('{') {
            self.fault(both!("a command that needs {{…}}"));
            return String::new();
        }
        self.at += 1;
        let text = self.take_while(|c| c != '}');
        if self.peek().is_none() {
            self.fault(both!("a {{ without its }}"));
        }
        self.at += 1;
        text
    }
}

fn is_quantity_letter(c: char) -> bool {
    c.is_ascii_alphabetic() || ('α'..='ω').contains(&c) || matches!(c, 'ϑ' | 'ϕ' | 'ϖ' | 'ϱ' | 'ϵ')
}

fn is_cjk(c: char) -> bool {
    matches!(c, '\u{3000}'..='\u{303F}' | '\u{3400}'..='\u{9FFF}' | '\u{F900}'..='\u{FAFF}' | '\u{FF00}'..='\u{FFEF}')
}

/// Returns a sign as an atom; an operator with no operand before it is the sign of a number and
/// gets no space.
fn symbol(c: char, before: &[LabelNode]) -> LabelNode {
    let opens = |n: &LabelNode| {
        matches!(n.role, Role::Binary | Role::Relation | Role::Punctuation)
            || n.text.ends_with(['(', '∠'])
    };
    let starts = before.last().is_none_or(opens);
    match c {
        '+' | '-' | '−' | '±' if starts => {
            LabelNode::new(if c == '-' { '−' } else { c }, Slant::Symbol, Role::Ordinary)
        }
        '-' => LabelNode::new('−', Slant::Symbol, Role::Binary),
        '+' | '−' | '±' | '×' | '÷' | '·' | '⋅' => {
            LabelNode::new(c, Slant::Symbol, Role::Binary)
        }
        '=' | '<' | '>' | '≈' | '≠' | '≤' | '≥' | '→' | '←' | '↔' | '∝' | '≡' => {
            LabelNode::new(c, Slant::Symbol, Role::Relation)
        }
        ',' | ';' => LabelNode::new(c, Slant::Upright, Role::Punctuation),
        '✓' | '✔' => LabelNode::new('✓', Slant::Symbol, Role::Ordinary),
        '⟂' => LabelNode::new('⊥', Slant::Symbol, Role::Ordinary),
        '⊥' | '∥' | '∠' | '√' | '∞' | '∼' | '∽' => {
            LabelNode::new(c, Slant::Symbol, Role::Ordinary)
        }
        '①'..='⑳' => LabelNode::new(c, Slant::Symbol, Role::Ordinary),
        _ => LabelNode::new(c, Slant::Upright, Role::Ordinary),
    }
}

enum CharKind {
    Letter,
    Capital,
    Sign,
}

/// Returns the Greek letter of a name: `omega`, `Phi`.
pub fn greek(name: &str) -> Option<char> {
    named(name).filter(|(_, kind)| !matches!(kind, CharKind::Sign)).map(|(letter, _)| letter)
}

fn named(name: &str) -> Option<(char, CharKind)> {
    let letter = match name {
        "alpha" => 'α',
        "beta" => 'β',
        "gamma" => 'γ',
        "delta" => 'δ',
        "epsilon" | "varepsilon" => 'ε',
        "zeta" => 'ζ',
        "eta" => 'η',
        "theta" => 'θ',
        "iota" => 'ι',
        "kappa" => 'κ',
        "lambda" => 'λ',
        "mu" => 'μ',
        "nu" => 'ν',
        "xi" => 'ξ',
        "pi" => 'π',
        "rho" => 'ρ',
        "sigma" => 'σ',
        "tau" => 'τ',
        "upsilon" => 'υ',
        "phi" | "varphi" => 'φ',
        "chi" => 'χ',
        "psi" => 'ψ',
        "omega" => 'ω',
        _ => '\0',
    };
    if letter != '\0' {
        return Some((letter, CharKind::Letter));
    }
    let capital = match name {
        "Gamma" => 'Γ',
        "Delta" => 'Δ',
        "Theta" => 'Θ',
        "Lambda" => 'Λ',
        "Pi" => 'Π',
        "Sigma" => 'Σ',
        "Phi" => 'Φ',
        "Psi" => 'Ψ',
        "Omega" => 'Ω',
        _ => '\0',
    };
    if capital != '\0' {
        return Some((capital, CharKind::Capital));
    }
    let sign = match name {
        "to" | "rightarrow" => '→',
        "leftarrow" => '←',
        "perp" => '⊥',
        "parallel" => '∥',
        "angle" => '∠',
        "cdot" => '·',
        "times" => '×',
        "pm" => '±',
        "approx" => '≈',
        "neq" => '≠',
        "leq" => '≤',
        "geq" => '≥',
        "sim" => '∼',
        "infty" => '∞',
        "degree" => '°',
        "checkmark" => '✓',
        "surd" => '√',
        _ => return None,
    };
    Some((sign, CharKind::Sign))
}
