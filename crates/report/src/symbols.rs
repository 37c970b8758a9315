//! Names of points and angles in plain sentences as formulas: `AC1` as a line from A to C with its
//! index, `ψ12` as an angle.
//!
//! The sentences of a construction are also printed in terminals, without formulas; documents and
//! pictures typeset the same sentences with the names found here.

/// Returns a sentence with its names between dollar signs.
///
/// A name consists of capital letters, each optionally followed by digits and primes, or of one
/// small Greek letter with digits, and is not adjacent to another letter.
pub fn symbols(sentence: &str) -> String {
    let all: Vec<char> = sentence.chars().collect();
    let mut out = String::with_capacity(sentence.len());
    let mut k = 0;
    while k < all.len() {
        let apart = k == 0 || !all[k - 1].is_ascii_alphanumeric();
        match name(&all[k..]).filter(|_| apart) {
            Some((length, formula))
                if !all.get(k + length).is_some_and(char::is_ascii_alphanumeric)
                    && !article(&all[k..k + length], &all[k + length..]) =>
            {
                out += &format!("${formula}$");
                k += length;
            }
            _ => {
                out.push(all[k]);
                k += 1;
            }
        }
    }
    out
}

/// Returns true for the article at the start of a sentence: a word follows it.
fn article(name: &[char], after: &[char]) -> bool {
    name == ['A']
        && matches!(after, [' ', c, d, ..] if c.is_ascii_lowercase() && d.is_ascii_lowercase())
        && {
            let word: String = after[1..].iter().take_while(|c| c.is_ascii_alphabetic()).collect();
            // A point is followed by a verb or a conjunction, an article by one of these nouns of
            // constructions.
            ["line", "circle", "parallel", "perpendicular", "ray", "point"].contains(&word.as_str())
        }
}

/// Returns the name at the start of a text: its length and its formula.
fn name(text: &[char]) -> Option<(usize, String)> {
    let mut k = 0;
    let mut formula = String::new();
    let greek = |c: char| ('α'..='ω').contains(&c);
    let first = *text.first()?;
    if !(first.is_ascii_uppercase() || greek(first)) {
        return None;
    }
    while let Some(c) =
        text.get(k).copied().filter(|c| c.is_ascii_uppercase() || k == 0 && greek(*c))
    {
        formula.push(c);
        k += 1;
        let digits: String = text[k..].iter().take_while(|c| c.is_ascii_digit()).collect();
        k += digits.len();
        if !digits.is_empty() {
            formula += &format!("_{{{digits}}}");
        }
        // An apostrophe before a letter is a possessive: D's arc.
        while text.get(k) == Some(&'\'') && !text.get(k + 1).is_some_and(char::is_ascii_lowercase) {
            formula.push('\'');
            k += 1;
        }
    }
    Some((k, formula))
}

#[cfg(test)]
mod tests {
    use super::symbols;

    #[test]
    fn names_are_formulas_and_words_stay_words() {
        assert_eq!(
            symbols("With AC1 as opening about A cut AC2 at F"),
            "With $AC_{1}$ as opening about $A$ cut $AC_{2}$ at $F$"
        );
        assert_eq!(symbols("ψ12 = 41.771°: B2'"), "$ψ_{12}$ = 41.771°: $B_{2}'$");
        assert_eq!(symbols("Burmester's points, P12P23"), "Burmester's points, $P_{12}P_{23}$");
        assert_eq!(symbols("以 A 为圆心、AC1 为半径"), "以 $A$ 为圆心、$AC_{1}$ 为半径");
        assert_eq!(symbols("A line through A"), "A line through $A$");
        assert_eq!(symbols("D's arc about C"), "$D$'s arc about $C$");
    }
}
