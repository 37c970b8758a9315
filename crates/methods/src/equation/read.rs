//! Reads the file: its keys, and their consistency.

use super::{TermDirection, VectorEquation, VectorTerm};
use hodograph_base::diag::{Both, Diagnostic, Faults, Span, Warned, both};
use hodograph_base::json::fields::{Fields, object, suggest, word};
use hodograph_base::json::{self, Node, NodeKind, Word};
use hodograph_scene::DiagramKind;
use hodograph_scene::front::{self, Front, Law, RawFront};
use hodograph_scene::units::RequiredQuantity;

/// The keys in addition to those of the front.
pub(super) const KEYS: [&str; 5] = ["statement", "equation", "quantity", "lines", "vectors"];
/// The keys of a vector.
pub(super) const VECTOR: [&str; 2] = ["magnitude", "direction"];
/// The largest permitted number of vectors.
const MOST: usize = 20;
/// The longest permitted name of a vector.
const LONGEST: usize = 20;
/// The sign of an unknown.
const UNKNOWN: &str = "?";
/// Beginnings of a direction that refers to a line; true for the perpendicular.
const RELATIONS: [(&str, bool); 4] =
    [("parallel to ", false), ("∥", false), ("perpendicular to ", true), ("⊥", true)];

/// Keys that only scenes have.
const OF_SCENES: [&str; 3] = ["links", "ground", "driver"];

/// True if a file is a vector equation: it has `equation`, and no key of a linkage.
pub fn is_problem(source: &[u8]) -> bool {
    json::parse(source, &mut Faults::default()).is_ok_and(|(_, root)| match &root.kind {
        NodeKind::Object(members) => {
            let has = |key: &str| members.iter().any(|(k, _)| k.text == key);
            has("equation") && !OF_SCENES.iter().any(|key| has(key))
        }
        NodeKind::Text(_)
        | NodeKind::Number(_)
        | NodeKind::Bool(_)
        | NodeKind::Null
        | NodeKind::Array(_) => false,
    })
}

/// Reads a file: JSON in UTF-8.
///
/// # Errors
/// All faults of the file in one list, each with its place as byte offsets into `source`.
pub fn read(source: impl AsRef<[u8]>) -> Result<Warned<VectorEquation>, Faults> {
    let mut faults = Faults::default();
    let (text, root) = json::parse(source.as_ref(), &mut faults)?;
    let found = problem(&root, text, &mut faults);
    match found {
        Some(value) if !faults.has_errors() => Ok(Warned { value, notes: faults.list }),
        _ => {
            faults.list.retain(|d| d.code != "unused-parameter");
            faults.list.sort_by_key(|d| d.span.map_or(0, |s| s.start));
            Err(faults)
        }
    }
}

fn problem(root: &Node, text: &str, faults: &mut Faults) -> Option<VectorEquation> {
    let keys: Vec<&str> = front::KEYS.iter().chain(&KEYS).copied().collect();
    let f = Fields::open(root, both!("a vector equation"), &keys, faults)?;
    let raw = RawFront::decode(root, faults);
    let front = Front::new(&raw, text, faults);
    let statement = f.get("statement").and_then(|n| front.statement(n, faults));
    let named = f
        .need("equation", "\"v_C = v_B + v_CB\"", faults)
        .and_then(|n| Some((n.span, word(n, "\"equation\"", faults)?)))
        .and_then(|(span, written)| sides(&written.text).map_err(|d| faults.push(d.at(span))).ok());
    let mut r = VectorReader { front: &front, faults, lines: Vec::new() };
    r.lines(f.get("lines"));
    let given = r.vectors(f.get("vectors"), named.as_deref());
    let on = r.diagram(f.get("quantity"), &given)?;
    let term = |(left, name): &(bool, String)| {
        let fields = given.iter().find(|(n, _)| n.text == *name).map(|(_, f)| f);
        let magnitude = fields.and_then(|f| f.get("magnitude"));
        let magnitude = magnitude.and_then(|n| r.magnitude(n, on, fields));
        let direction = fields.and_then(|f| f.get("direction")).and_then(|n| r.direction(n));
        VectorTerm { name: name.clone(), left: *left, magnitude, direction }
    };
    let terms: Vec<VectorTerm> = named?.iter().map(term).collect();
    faults.list.extend(front.unused());
    let title = front
        .title
        .as_ref()
        .map_or_else(|| both!("Vector equation"), |t| Both { en: t.en.clone(), zh: t.zh.clone() });
    Some(VectorEquation {
        title,
        statement,
        language: front.language,
        notation: front.notation(),
        paper: front.paper.clone(),
        book: front.book.clone(),
        on,
        terms,
    })
}

/// Takes an equation apart: the name of each vector, and true if it is on the left side.
fn sides(text: &str) -> Result<Vec<(bool, String)>, Diagnostic> {
    let fault = |message: Both| {
        Diagnostic::error("equation", message).help(both!(
            "write sums of vectors, or 0, on both sides of one sign of equality: \"v_C = v_B + v_CB\"; a difference is moved to the other side"
        ))
    };
    let sides: Vec<&str> = text.split('=').collect();
    let [left, right] = sides[..] else {
        let count = sides.len() - 1;
        return Err(fault(both!("the equation has {count} signs of equality")));
    };
    let mut all: Vec<(bool, String)> = Vec::new();
    for (is_left, side) in [(true, left), (false, right)] {
        // A side may be empty: forces in equilibrium sum to 0.
        for name in side.split('+').map(str::trim).filter(|_| side.trim() != "0") {
            if !is_name(name) {
                return Err(fault(both!(
                    "`{name}` is not the name of a vector: a letter, then letters, `^` with a superscript, `_` with an index"
                )));
            }
            if all.iter().any(|(_, n)| n == name) {
                return Err(fault(both!("the vector `{name}` is in the equation twice")));
            }
            all.push((is_left, name.to_owned()));
        }
    }
    if all.is_empty() {
        return Err(fault(both!("the equation has no vectors")));
    }
    if all.len() > MOST {
        return Err(fault(both!("the equation has {} vectors; {MOST} is the most", all.len())));
    }
    Ok(all)
}

/// True for a name such as `D`, `v_CB`, `a^n_B`.
fn is_name(name: &str) -> bool {
    let (stem, below) = name.split_once('_').map_or((name, None), |(s, b)| (s, Some(b)));
    let (stem, above) = stem.split_once('^').map_or((stem, None), |(s, a)| (s, Some(a)));
    let plain = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_alphanumeric());
    name.len() <= LONGEST
        && stem.starts_with(|c: char| c.is_ascii_alphabetic())
        && plain(stem)
        && above.is_none_or(plain)
        && below.is_none_or(plain)
}

/// The file, with a list of its faults.
struct VectorReader<'a> {
    front: &'a Front<'a>,
    faults: &'a mut Faults,
    /// The lines: name and angle; `None` for an angle that could not be read.
    lines: Vec<(Word, Option<Law>)>,
}

impl VectorReader<'_> {
    fn fault(&mut self, code: &'static str, at: Span, message: Both, help: Both) {
        self.faults.push(Diagnostic::error(code, message).at(at).help(help));
    }

    /// Reads a quantity that may use parameters, and not the time.
    fn constant(&mut self, node: &Node, wanted: RequiredQuantity, key: &str) -> Option<Law> {
        let law = self.front.law(node, wanted, 0.0, &format!("\"{key}\""), self.faults)?;
        if law.depends_on_time() {
            let message = both!("`{}` depends on the time `t`", law.text);
            self.fault("equation", node.span, message, both!("an equation holds at one instant"));
            return None;
        }
        Some(law)
    }

    fn lines(&mut self, node: Option<&Node>) {
        let Some(members) = node.and_then(|n| object(n, "\"lines\"", self.faults)) else { return };
        for (name, angle) in members.iter().take(MOST) {
            let angle = self.constant(angle, RequiredQuantity::Angle, &name.text);
            self.lines.push((name.clone(), angle));
        }
    }

    /// Opens the vectors; a name that the equation does not have is a fault.
    fn vectors<'n>(
        &mut self,
        node: Option<&'n Node>,
        named: Option<&[(bool, String)]>,
    ) -> Vec<(Word, Fields<'n>)> {
        let members = node.and_then(|n| object(n, "\"vectors\"", self.faults)).unwrap_or_default();
        let mut out = Vec::new();
        for (name, node) in members {
            if let Some(all) = named
                && !all.iter().any(|(_, n)| *n == name.text)
            {
                let message = both!("the equation has no vector `{}`", name.text);
                let known = all.iter().map(|(_, n)| n.as_str());
                let help = suggest(&name.text, known, both!("its vectors are"));
                self.fault("unknown-key", name.span, message, help);
                continue;
            }
            let fields = Fields::open(node, both!("a vector"), &VECTOR, self.faults);
            out.extend(fields.map(|f| (name.clone(), f)));
        }
        out
    }

    /// Reads the kind of quantity; if it is not named, it is that of most magnitudes.
    fn diagram(&mut self, node: Option<&Node>, given: &[(Word, Fields)]) -> Option<DiagramKind> {
        let name = |on: DiagramKind| if on == DiagramKind::Plane { "length" } else { on.word() };
        if let Some(node) = node {
            let written = word(node, "\"quantity\"", self.faults)?;
            let found = DiagramKind::ALL.into_iter().find(|on| name(*on) == written.text);
            if found.is_none() {
                let message = both!("`{}` is no quantity of an equation", written.text);
                let help = suggest(
                    &written.text,
                    DiagramKind::ALL.into_iter().map(name),
                    both!("the quantities are"),
                );
                self.fault("unknown-word", written.span, message, help);
            }
            return found;
        }
        let magnitudes: Vec<&Node> = given
            .iter()
            .filter_map(|(_, f)| f.get("magnitude"))
            .filter(|n| !is_unknown(n))
            .take(MOST)
            .collect();
        let fitting = |on: &DiagramKind| {
            let wanted = RequiredQuantity::of(on.kind());
            let fits = |n: &&&Node| {
                self.front.law(n, wanted, 0.0, "\"magnitude\"", &mut Faults::default()).is_some()
            };
            magnitudes.iter().filter(fits).count()
        };
        // Among kinds that fit equally many, the last is taken: velocities are usual.
        let usual = [
            DiagramKind::Plane,
            DiagramKind::Force,
            DiagramKind::Acceleration,
            DiagramKind::Velocity,
        ];
        usual.into_iter().max_by_key(fitting)
    }

    fn magnitude(&mut self, node: &Node, on: DiagramKind, fields: Option<&Fields>) -> Option<Law> {
        if is_unknown(node) {
            return None;
        }
        let law = self.constant(node, RequiredQuantity::of(on.kind()), "magnitude")?;
        // A law without a value is reported when it is evaluated.
        let value = law.at(0.0).ok()?.si().0[0];
        let turnable = fields.and_then(|f| f.get("direction")).is_none_or(is_unknown);
        if value < 0.0 || turnable && value == 0.0 {
            let message = both!("the magnitude `{}` is {value} {}", law.text, on.kind().si());
            let help = if value < 0.0 {
                both!("turn the direction by 180° instead")
            } else {
                both!("a vector of length 0 has no direction")
            };
            self.fault("not-positive", node.span, message, help);
            return None;
        }
        Some(law)
    }

    fn direction(&mut self, node: &Node) -> Option<TermDirection> {
        if is_unknown(node) {
            return None;
        }
        if let NodeKind::Text(text) = &node.kind {
            for (beginning, across) in RELATIONS {
                if let Some(line) = text.trim().strip_prefix(beginning) {
                    return self.along(line.trim(), across, node.span);
                }
            }
        }
        let angle = self.constant(node, RequiredQuantity::Angle, "direction")?;
        Some(TermDirection { angle, line: None, across: false })
    }

    fn along(&mut self, line: &str, across: bool, at: Span) -> Option<TermDirection> {
        if let Some((name, angle)) = self.lines.iter().find(|(name, _)| name.text == line) {
            let (line, angle) = (Some(name.text.clone()), angle.clone()?);
            return Some(TermDirection { angle, line, across });
        }
        let message = both!("there is no line `{line}`");
        let names: Vec<&str> = self.lines.iter().map(|(name, _)| name.text.as_str()).collect();
        let help = if names.is_empty() {
            both!("give its angle: \"lines\": {{\"{line}\": \"30 deg\"}}")
        } else {
            suggest(line, names.into_iter(), both!("the lines are"))
        };
        self.fault("unknown-word", at, message, help);
        None
    }
}

/// True for the sign of an unknown.
fn is_unknown(node: &Node) -> bool {
    matches!(&node.kind, NodeKind::Text(text) if text.trim() == UNKNOWN)
}
