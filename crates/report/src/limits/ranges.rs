//! The ranges of a four-bar linkage's lengths for each of Grashof's types, as text and JSON.

use super::grashof_words;
use hodograph_base::diag::{Diagnostic, both};
use hodograph_base::lang::{say, tr};
use hodograph_scene::{Lang, Scene};
use hodograph_sweep::extreme::MotionLimits;
use hodograph_synthesis::grashof::{FourBarLength, Range, ranges};
use serde_json::{Value as Json, json};

/// A length, its value (m), and its ranges.
pub type OfLength = (FourBarLength, f64, Vec<Range>);

/// Returns the ranges of all four lengths.
///
/// # Errors
/// The mechanism is not a four-bar linkage with four pins and a driving crank.
pub fn of(limits: &MotionLimits) -> Result<Vec<OfLength>, Diagnostic> {
    let Some((_, lengths)) = limits.grashof else {
        let d = Diagnostic::error(
            "not-a-four-bar",
            both!("Grashof's types are of a four-bar of four pins with a crank as driver"),
        );
        return Err(d.help(both!("leave --ranges out")));
    };
    FourBarLength::ALL
        .into_iter()
        .map(|which| Ok((which, lengths[which as usize], ranges(lengths, which)?)))
        .collect()
}

fn named(which: FourBarLength, lang: Lang) -> &'static str {
    match which {
        FourBarLength::Driver => tr!(lang, "driver"),
        FourBarLength::Coupler => tr!(lang, "coupler"),
        FourBarLength::Output => tr!(lang, "output"),
        FourBarLength::Frame => tr!(lang, "fixed link" => "frame"),
    }
}

/// Returns a table for each length.
pub fn text(scene: &Scene, all: &[OfLength], lang: Lang) -> String {
    let mut out = String::new();
    let words = |m: f64| scene.length_words(m);
    for (which, now, ranges) in all {
        out += &say!(lang, "{} (now {}), the others held:\n", named(*which, lang), words(*now));
        for r in ranges {
            let end = if r.change_point { tr!(lang, "; change point at the end") } else { "" };
            out += &format!(
                "  {} .. {}  {}{end}\n",
                words(r.from),
                words(r.to),
                grashof_words(r.kind, lang)
            );
        }
    }
    out
}

/// Returns the ranges as JSON, in SI.
pub fn json(all: &[OfLength]) -> Json {
    let range = |r: &Range| json!({"type": grashof_words(r.kind, Lang::En), "from": r.from, "to": r.to, "change_point_at_the_end": r.change_point});
    let one = |(which, now, ranges): &OfLength| json!({"length": named(*which, Lang::En), "now": now, "ranges": ranges.iter().map(range).collect::<Vec<_>>()});
    Json::Array(all.iter().map(one).collect())
}
