//! The sections `belts` and `chains`: each entry becomes one rolling pair for every two neighbours
//! that it runs round.

use super::super::keys;
use super::super::raw::*;
use super::super::rolling::RollingKind;
use super::rolling::{quantities, side};
use super::{flag, items, quantity, words};
use hodograph_base::diag::{Both, Diagnostic, Faults, both};
use hodograph_base::json::Word;
use hodograph_base::json::fields::Fields;

/// The words in which `belts` and `chains` differ; both sections are read in one way.
struct Section {
    kind: RollingKind,
    keys: &'static [&'static str],
    what: Both,
    /// The key of the wheels that it runs round.
    wheels: &'static str,
    /// The key of the wheels' sizes, with an example of two of them.
    sizes: (&'static str, &'static str),
}

pub(super) fn belts(f: &Fields, raw: &mut RawScene, faults: &mut Faults) {
    let sections = [
        Section {
            kind: RollingKind::Belt,
            keys: keys::BELT,
            what: both!("a belt"),
            wheels: "pulleys",
            sizes: ("radii", "[\"50 mm\", \"120 mm\"]"),
        },
        Section {
            kind: RollingKind::Chain,
            keys: keys::CHAIN,
            what: both!("a chain"),
            wheels: "sprockets",
            sizes: ("teeth", "[19, 38]"),
        },
    ];
    let mut count = 0;
    for (key, section) in ["belts", "chains"].into_iter().zip(sections) {
        for node in items(f.get(key), &format!("\"{key}\""), faults) {
            if let Some(f) = Fields::open(node, &section.what, section.keys, faults) {
                raw.rolling.extend(strands(&f, &section, count, faults).unwrap_or_default());
            }
            count += 1;
        }
    }
}

fn strands(
    f: &Fields,
    section: &Section,
    belt: usize,
    faults: &mut Faults,
) -> Option<Vec<RawRolling>> {
    let before = faults.list.len();
    let (wheels, (sizes, example)) = (section.wheels, section.sizes);
    let list = |key: &str, example: &str, faults: &mut Faults| {
        f.need(key, example, faults)
            .map(|n| words(Some(n), &format!("\"{key}\""), faults))
            .unwrap_or_default()
    };
    let (links, centres) =
        (list(wheels, "[\"2\", \"3\"]", faults), list("centres", "[\"A\", \"B\"]", faults));
    let values =
        f.need(sizes, example, faults).map(|n| quantities(n, sizes, faults)).unwrap_or_default();
    let need_pitch = |faults: &mut Faults| {
        f.need("pitch", "\"12.7 mm\"", faults).and_then(|n| quantity(n, "\"pitch\"", faults))
    };
    let pitch = section.kind.is_toothed().then(|| need_pitch(faults)).flatten();
    let reversed =
        f.get("reversed").map(|n| words(Some(n), "\"reversed\"", faults)).unwrap_or_default();
    let crossed = f.get("crossed").and_then(|n| flag(n, "crossed", faults)) == Some(true);
    let at = f.get("at").map(|n| words(Some(n), "\"at\"", faults));
    let phase = f.get("phase").and_then(|n| quantity(n, "\"phase\"", faults));
    if faults.list.len() > before {
        return None;
    }
    let n = links.len();
    if n < 2 || centres.len() != n || values.len() != n {
        let message = both!(
            "{} runs round two or more wheels, each with its centre and size: there are {n} of \"{wheels}\", {} of \"centres\", {} of \"{sizes}\"",
            section.what,
            centres.len(),
            values.len()
        );
        let help = both!("write as many of each, in the order in which it runs round them");
        faults.push(Diagnostic::error("wrong-count", message).at(f.span()).help(help));
        return None;
    }
    for word in reversed.iter().filter(|w| links.iter().all(|l| l.text != w.text)) {
        let names: Vec<&str> = links.iter().map(|l| l.text.as_str()).collect();
        let message = both!("`{}` is not among \"{wheels}\"", word.text);
        let help = both!("they are {}", Both::names(&names));
        faults.push(Diagnostic::error("unknown-link", message).at(word.span).help(help));
    }
    if crossed && (n != 2 || !reversed.is_empty()) {
        let message = both!("\"crossed\" is said of two pulleys without \"reversed\"");
        let help = both!("name the pulleys that turn the other way in \"reversed\"");
        faults.push(Diagnostic::error("belt", message).at(f.span()).help(help));
    }
    if section.kind == RollingKind::Chain && n == 2 && !reversed.is_empty() {
        let message = both!("a chain round two sprockets does not cross itself");
        let help = both!("leave \"reversed\" away");
        faults.push(Diagnostic::error("belt", message).at(reversed[0].span).help(help));
    }
    if let Some(at) = at.as_ref().filter(|at| at.len() != 2 * (n - 1)) {
        let message = both!("\"at\" names {} points, not {}", at.len(), 2 * (n - 1));
        let help = both!(
            "name both ends of the strand between each wheel and the next: \"at\": [\"M\", \"N\"]"
        );
        faults.push(
            Diagnostic::error("wrong-count", message)
                .at(at.first().map_or(f.span(), |w| w.span))
                .help(help),
        );
    }
    if let Some(q) = phase.as_ref().filter(|_| n != 2) {
        let message = both!("\"phase\" is said of two wheels, here are {n}");
        let help = both!("give coordinates of a second point of each wheel in \"points\"");
        faults.push(Diagnostic::error("phase", message).at(q.span).help(help));
    }
    if faults.list.len() > before {
        return None;
    }
    let back = |l: &Word| reversed.iter().any(|r| r.text == l.text);
    let strand = |i: usize| {
        let (a, b) = (i, i + 1);
        let ends = at.as_ref().map(|at| [&at[2 * i], &at[2 * i + 1]].map(Word::clone));
        let [begin, end] = ends.map_or([None, None], |ends| ends.map(Some));
        RawRolling {
            sides: [a, b].map(|k| side(&links[k], Some(&centres[k]), false)),
            sizes: match &pitch {
                Some(pitch) => {
                    RawSizes::Teeth(vec![values[a].clone(), values[b].clone()], Some(pitch.clone()))
                }
                None => RawSizes::Radii(vec![values[a].clone(), values[b].clone()]),
            },
            kind: section.kind,
            strand: Some(RawStrand {
                belt,
                crossed: crossed || back(&links[a]) != back(&links[b]),
                right: back(&links[a]),
                end,
            }),
            line: None,
            through: None,
            angle: None,
            at: begin,
            phase: phase.clone(),
            flanks: RawFlanks::default(),
            span: f.span(),
        }
    };
    Some((0..n - 1).map(strand).collect())
}
