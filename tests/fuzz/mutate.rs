//! Mutations of texts: bytes, numbers, pieces of other texts, words with a meaning in some format.

/// Splitmix64 (Steele, Lea, Flood 2014).
pub struct Rng(u64);

impl Rng {
    pub fn new(seed: u64) -> Rng {
        Rng(seed)
    }

    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number less than `n`; 0 for `n = 0`.
    pub fn below(&mut self, n: usize) -> usize {
        (self.next() % n.max(1) as u64) as usize
    }
}

/// Words with a meaning in JSON, SVG, HTML, Markdown, Typst or a terminal, and numbers at the ends
/// of their ranges.
const HOSTILE: [&str; 40] = [
    "\\u001b[2J",
    "\\u0000",
    "\\ufffe",
    "\u{1b}",
    "\u{7f}",
    "\u{9b}",
    "\u{fffe}",
    "\u{202e}",
    "\\ud800",
    "\\n\\n",
    "\\",
    "\"",
    "{",
    "}",
    "[",
    "]",
    ",",
    ":",
    "]]>",
    "<!--",
    "</script>",
    "&copy;",
    "$",
    "~~~",
    "---",
    "#",
    "*/",
    "曲",
    "\u{fffc}",
    "\u{feff}",
    "1e308",
    "-1",
    "0",
    "1e-320",
    "1e999",
    "180",
    "360.0000000001",
    "nan",
    "null",
    "1/0",
];

/// Largest length of a name (bytes).
const LONGEST_NAME: usize = 8;

/// Makes inputs from a corpus.
pub struct Mutator<'a> {
    seeds: &'a [String],
}

impl<'a> Mutator<'a> {
    pub fn new(seeds: &'a [String]) -> Mutator<'a> {
        Mutator { seeds }
    }

    /// One of the texts after one to four mutations. Of five inputs, two are changed only in their
    /// numbers and one only in its names: these stay of their kind and get farther in the program.
    pub fn input(&self, rng: &mut Rng) -> Vec<u8> {
        let mut text = self.seeds[rng.below(self.seeds.len())].clone().into_bytes();
        let kind = rng.below(5);
        for _ in 0..1 + rng.below(4) {
            match kind {
                0 | 1 => Mutator::digit(&mut text, rng),
                2 => Mutator::name(&mut text, rng),
                _ => self.mutate(&mut text, rng),
            }
        }
        text
    }

    /// Replaces a digit by a digit.
    fn digit(text: &mut [u8], rng: &mut Rng) {
        let digits: Vec<usize> = (0..text.len()).filter(|i| text[*i].is_ascii_digit()).collect();
        if let Some(&at) = digits.get(rng.below(digits.len())) {
            text[at] = b'0' + rng.below(10) as u8;
        }
    }

    /// Replaces a word between quotation marks by another of the same text: a point, link or key
    /// that is in use.
    fn name(text: &mut Vec<u8>, rng: &mut Rng) {
        let marks: Vec<usize> = (0..text.len()).filter(|i| text[*i] == b'"').collect();
        let words: Vec<[usize; 2]> = marks
            .chunks_exact(2)
            .map(|m| [m[0] + 1, m[1]])
            .filter(|[a, b]| b - a <= LONGEST_NAME)
            .collect();
        let (one, other) = (words.get(rng.below(words.len())), words.get(rng.below(words.len())));
        if let (Some([a, b]), Some([c, d])) = (one, other) {
            let word = text[*c..*d].to_vec();
            text.splice(*a..*b, word);
        }
    }

    fn mutate(&self, text: &mut Vec<u8>, rng: &mut Rng) {
        let at = rng.below(text.len());
        match rng.below(8) {
            0 if at < text.len() => text[at] = rng.next() as u8,
            1 if at < text.len() => text[at] ^= 1 << rng.below(8),
            2 => {
                let end = text.len().min(at + 1 + rng.below(12));
                text.drain(at..end);
            }
            // A piece of another text, from one quotation mark to another.
            3 => {
                let other = &self.seeds[rng.below(self.seeds.len())];
                let marks: Vec<usize> = other.match_indices('"').map(|m| m.0).collect();
                let (a, b) = (rng.below(marks.len()), rng.below(marks.len()));
                if let (Some(a), Some(b)) = (marks.get(a.min(b)), marks.get(a.max(b))) {
                    let piece = &other.as_bytes()[*a..(*b).min(a + 200)];
                    text.splice(at..at, piece.iter().copied());
                }
            }
            4 => {
                let end = text.len().min(at + 1 + rng.below(30));
                let piece = text[at..end].to_vec();
                text.splice(at..at, piece);
            }
            // Replacing a number by a number keeps the kind of the text.
            5 | 6 => {
                let digits: Vec<usize> =
                    (0..text.len()).filter(|i| text[*i].is_ascii_digit()).collect();
                if let Some(&from) = digits.get(rng.below(digits.len())) {
                    let to = (from..text.len())
                        .find(|i| !text[*i].is_ascii_digit())
                        .unwrap_or(text.len());
                    let number = [30, 31, 32, 33, 34, 35, 36].map(|k| HOSTILE[k])[rng.below(7)];
                    let number = if rng.below(2) == 0 {
                        rng.below(400).to_string()
                    } else {
                        number.to_owned()
                    };
                    text.splice(from..to, number.bytes());
                }
            }
            _ => {
                let word = HOSTILE[rng.below(HOSTILE.len())];
                text.splice(at..at, word.bytes());
            }
        }
    }
}
