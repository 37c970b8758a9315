//! Vector equations on their own as text and JSON: the table of magnitudes and directions, the
//! unknowns with certain digits beside the values measured on paper, the steps.

use crate::amount::scale_formula;
use crate::answers::diagnostic;
use crate::particle::{enclosed, number};
use crate::plan::table;
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::digits::minus;
use hodograph_base::lang::tr;
use hodograph_base::notation::Notation;
use hodograph_base::number::decimal::Enclosure;
use hodograph_board::plan::text::EquationColumn;
use hodograph_methods::equation::board::EquationDrawing;
use hodograph_methods::equation::{
    EquationCase, EquationSolution, RootVector, VectorEquation, VectorTerm, unknowns,
};
use hodograph_paper::paper::phrase::Phrase;
use hodograph_scene::Lang;
use serde_json::{Value as Json, json};

/// Largest relative difference between drawing and analysis, times the sine of the crossing, that
/// counts as agreement.
pub const AGREES: f64 = 1e-9;

/// Returns the columns of the table of an equation: what is known and what is not.
pub fn columns(terms: &[VectorTerm], notation: &Notation) -> Vec<EquationColumn> {
    let column = |k: usize, t: &VectorTerm| {
        let joint = match k.checked_sub(1).map(|before| terms[before].left == t.left) {
            None if t.left => "",
            None => "=",
            Some(true) => "+",
            Some(false) => "=",
        };
        let direction = match &t.direction {
            None => notation.unknown.clone(),
            Some(d) => match (&d.line, d.across) {
                (None, _) => notation.known.clone(),
                (Some(line), true) => format!("\\perp \\text{{{line}}}"),
                (Some(line), false) => format!("\\parallel \\text{{{line}}}"),
            },
        };
        let magnitude =
            if t.magnitude.is_some() { notation.known.clone() } else { notation.unknown.clone() };
        let symbol = notation.vectors.write(t.symbol(0));
        EquationColumn { joint, symbol, direction, magnitude, term: None }
    };
    let zero = |joint: &'static str, left: bool| {
        let none = String::new;
        let column = EquationColumn {
            joint,
            symbol: "0".to_owned(),
            direction: none(),
            magnitude: none(),
            term: None,
        };
        terms.iter().all(|t| t.left != left).then_some(column)
    };
    let told = terms.iter().enumerate().map(|(k, t)| column(k, t));
    zero("", true).into_iter().chain(told).chain(zero("=", false)).collect()
}

/// Returns the number of primes after the symbols of a solution: none if it is the only one.
pub fn primes(solved: &EquationSolution, root: usize) -> usize {
    if solved.roots.len() > 1 { root + 1 } else { 0 }
}

/// Returns the name of a vector of a solution in the way of `find`: `v_C`, or `v_C'` and `v_C''`.
pub fn find(
    problem: &VectorEquation,
    solved: &EquationSolution,
    root: usize,
    term: usize,
) -> String {
    format!("{}{}", problem.terms[term].name, "'".repeat(primes(solved, root)))
}

/// The largest magnitude of a solution (SI); smaller ones are compared with a thousandth of it.
fn largest(solved: &EquationSolution) -> f64 {
    let all = solved.roots.iter().flat_map(|r| &r.vectors);
    all.map(|v| v.magnitude.approx).fold(0.0, f64::max)
}

/// Returns the relative difference between drawing and closed form; `None` if it is not drawn.
pub fn apart(
    solved: &EquationSolution,
    drawn: &EquationDrawing,
    root: usize,
    v: &RootVector,
) -> Option<f64> {
    let off = (drawn.read(v.term, root)? - v.value).norm();
    let size = v.magnitude.approx.max(1e-3 * largest(solved));
    Some(if size > 0.0 { off / size } else { off })
}

/// Returns the value of a vector: magnitude and direction.
pub fn value(
    problem: &VectorEquation,
    solved: &EquationSolution,
    v: &RootVector,
    digits: usize,
) -> String {
    let (book, kind) = (&problem.book, problem.on.kind());
    let size = book.value(kind, largest(solved));
    let told = minus(&number(&enclosed(book, Some(kind), &v.magnitude), size, digits));
    let told = book.text(kind, &told);
    match &v.angle {
        Some(angle) => format!("{told} ∠ {}°", minus(&number(angle, 180.0, digits.max(5) - 1))),
        None => told,
    }
}

/// Returns the answers, one line each, in the label language.
pub fn lines(problem: &VectorEquation, solved: &EquationSolution, digits: usize) -> Vec<Phrase> {
    let line = |(root, v): (usize, &RootVector)| {
        let symbol = problem.terms[v.term].symbol(primes(solved, root));
        Phrase::new(&format!("${symbol}$ = {}", value(problem, solved, v, digits)))
    };
    solved
        .roots
        .iter()
        .enumerate()
        .flat_map(|(k, r)| r.vectors.iter().map(move |v| (k, v)))
        .map(line)
        .collect()
}

/// Returns the count of unknowns in words: `2 unknowns: solvable`.
pub fn count(terms: &[VectorTerm]) -> Both {
    let all: usize = unknowns(terms).iter().map(Vec::len).sum();
    let verdict = match EquationCase::of(terms) {
        Ok(case) => both!("solvable: {}", case.words()),
        Err(_) => both!("not solvable"),
    };
    both!("{all} unknowns; {}", verdict)
}

/// Returns the table of an equation with the count of its unknowns, as `plan` prints it.
pub fn plan(problem: &VectorEquation, notation: &Notation, lang: Lang) -> String {
    let mut out = format!("{}\n", lang.of(&problem.title));
    for line in table(lang, &columns(&problem.terms, notation)) {
        out += &format!("  {}\n", line.trim_end());
    }
    out + &format!("{}\n", lang.of(&count(&problem.terms).sentence()))
}

/// Returns the report as text.
pub fn text(
    problem: &VectorEquation,
    solved: &EquationSolution,
    drawn: &EquationDrawing,
    (digits, steps): (usize, bool),
    notation: &Notation,
    lang: Lang,
) -> String {
    let mut out = plan(problem, notation, lang);
    out.push('\n');
    let all: Vec<(usize, &RootVector)> = solved
        .roots
        .iter()
        .enumerate()
        .flat_map(|(k, r)| r.vectors.iter().map(move |v| (k, v)))
        .collect();
    let name = |root: usize, term: usize| find(problem, solved, root, term);
    let wide = all.iter().map(|(k, v)| name(*k, v.term).len()).max().unwrap_or(0);
    for (k, v) in &all {
        let beside = apart(solved, drawn, *k, v).map_or_else(String::new, |off| {
            let off = if off < 1e-14 { "0".to_owned() } else { format!("{off:.0e}") };
            format!("   {} {off}", tr!(lang, "drawing differs by"))
        });
        let told = value(problem, solved, v, digits);
        out += &format!("{:wide$} = {told}{beside}\n", name(*k, v.term));
    }
    if steps {
        let scale = Phrase::new(&format!("${}$", scale_formula(&problem.book, drawn.on, drawn.mu)));
        out += &format!("\n{}{}\n", tr!(lang, "Drawing: "), scale.plain());
        for (k, step) in drawn.steps.iter().enumerate() {
            out += &format!("{}. {}\n", k + 1, Phrase::new(lang.of(step)).plain());
        }
    }
    out
}

/// Returns the report as JSON, in SI.
pub fn json(
    problem: &VectorEquation,
    solved: &EquationSolution,
    drawn: &EquationDrawing,
    digits: usize,
    notes: &[Diagnostic],
) -> Json {
    let told = |e: &Enclosure, size: f64, digits: usize| json!({"value": e.approx, "radius": e.radius, "text": number(e, size, digits)});
    let answer = |(root, v): (usize, &RootVector)| {
        let read = drawn.read(v.term, root);
        json!({
            "find": find(problem, solved, root, v.term),
            "vector": problem.terms[v.term].name,
            "solution": root + 1,
            "unit": problem.on.kind().si(),
            "value": [v.value.x, v.value.y],
            "magnitude": told(&v.magnitude, largest(solved), digits),
            "angle_deg": v.angle.as_ref().map(|e| told(e, 180.0, digits)),
            "drawn": read.map(|r| [r.x, r.y]),
            "difference": apart(solved, drawn, root, v),
        })
    };
    let answers: Vec<Json> = solved
        .roots
        .iter()
        .enumerate()
        .flat_map(|(k, r)| r.vectors.iter().map(move |v| (k, v)))
        .map(answer)
        .collect();
    json!({
        "title": problem.title.json(),
        "case": case_word(solved.case),
        "unknowns": plan_json(problem)["unknowns"],
        "answers": answers,
        "scale": drawn.mu,
        "steps": drawn.steps.iter().map(Both::json).collect::<Vec<_>>(),
        "notes": notes.iter().map(diagnostic).collect::<Vec<_>>(),
    })
}

/// Returns the table and the count of unknowns for programs; works for equations that cannot be
/// solved.
pub fn plan_json(problem: &VectorEquation) -> Json {
    let [sizes, directions] = unknowns(&problem.terms);
    let named = |what: &str, all: &[usize]| -> Vec<Json> {
        let one = |k: &usize| json!({"vector": problem.terms[*k].name, "unknown": what});
        all.iter().map(one).collect()
    };
    let case = EquationCase::of(&problem.terms);
    let all = [named("magnitude", &sizes), named("direction", &directions)].concat();
    json!({
        "title": problem.title.json(),
        "unknowns": all,
        "solvable": case.is_ok(),
        "case": case.ok().map(case_word),
    })
}

fn case_word(case: EquationCase) -> &'static str {
    match case {
        EquationCase::Vector(_) => "vector",
        EquationCase::Magnitudes(_) => "two magnitudes",
        EquationCase::Directions(_) => "two directions",
        EquationCase::Mixed { .. } => "magnitude and direction",
    }
}
