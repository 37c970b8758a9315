//! Joined names, as in print: `AB`, `O2B`, `B3B2`, `omega_3/2`, separated with the names that the
//! scene declares.

use hodograph_base::lang::each;
use std::collections::HashMap;

use super::model::{Link, LinkId, NamedPoint, OnLink, PointId};
use super::quantity::Frame;
use hodograph_base::diag::{Both, Diagnostic, both};
use hodograph_base::json::Word;
use hodograph_base::json::fields::suggest;

/// Longest name of a point or link. Figures print the names, and longer ones do not fit beside a
/// joint.
const MAX_NAME: usize = 16;

/// Longest text of joined names: two points, each with a link, and a comma. The number of ways to
/// split a text grows with the square of its length.
const MAX_RUN: usize = 4 * MAX_NAME + 1;

/// The declared names.
pub(super) struct Names<'a> {
    pub points: &'a [NamedPoint],
    pub links: &'a [Link],
    by_point: HashMap<&'a str, PointId>,
    by_link: HashMap<&'a str, LinkId>,
}

/// The object of a name.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Named {
    Point,
    Link,
}

/// Returns the fault of a new name, if any. `what` is "point" or "link"; a point begins with a
/// letter.
pub(super) fn check(name: &Word, what: Named) -> Option<Diagnostic> {
    let text = &name.text;
    let good = text.chars().all(|c| c.is_alphanumeric() || c == '\'' || c == '_');
    let start = text.chars().next().is_some_and(|c| what == Named::Link || c.is_alphabetic());
    if good && start && text.chars().count() <= MAX_NAME {
        return None;
    }
    let (message, help) = match what {
        Named::Link => (
            both!("`{text}` cannot name a link"),
            both!("up to {MAX_NAME} letters, digits, ' or _"),
        ),
        Named::Point => (
            both!("`{text}` cannot name a point"),
            both!("a letter first, up to {MAX_NAME} letters, digits, ' or _"),
        ),
    };
    Some(Diagnostic::error("name", message).at(name.span).help(help))
}

/// Returns a list of readings for the author to choose from.
pub(super) fn written(readings: &[String]) -> Both {
    both!("write {}", Both::from(each!(" or ").map(|or| readings.join(or))))
}

fn within_run(text: &str, word: &Word) -> Result<(), Diagnostic> {
    if text.chars().count() <= MAX_RUN {
        return Ok(());
    }
    let message = both!(
        "a name of more than {MAX_RUN} letters cannot be made of the names of points and links"
    );
    Err(Diagnostic::error("name", message).at(word.span))
}

/// Returns the two halves of `O2,B` or `O2-B`; `None` for other texts.
fn halves(text: &str) -> Option<(&str, &str)> {
    text.split_once([',', '-']).map(|(a, b)| (a.trim(), b.trim()))
}

impl<'a> Names<'a> {
    /// Returns the names of these points and links.
    pub fn new(points: &'a [NamedPoint], links: &'a [Link]) -> Self {
        let by_point =
            points.iter().enumerate().map(|(i, p)| (p.name.as_str(), PointId(i))).collect();
        let by_link = links.iter().enumerate().map(|(i, l)| (l.name.as_str(), LinkId(i))).collect();
        Names { points, links, by_point, by_link }
    }

    fn find_point(&self, name: &str) -> Option<PointId> {
        self.by_point.get(name).copied()
    }

    fn find_link(&self, name: &str) -> Option<LinkId> {
        self.by_link.get(name).copied()
    }

    /// Returns the point with a name.
    pub fn point(&self, word: &Word) -> Result<PointId, Diagnostic> {
        self.find_point(&word.text).ok_or_else(|| self.no_point(&word.text, word))
    }

    /// Returns the link with a name.
    pub fn link(&self, word: &Word) -> Result<LinkId, Diagnostic> {
        self.link_in(&word.text, word)
    }

    /// Returns the link `text`, which is a part of `word`.
    pub fn link_in(&self, text: &str, word: &Word) -> Result<LinkId, Diagnostic> {
        self.find_link(text).ok_or_else(|| {
            let d =
                Diagnostic::error("unknown-link", both!("there is no link `{text}`")).at(word.span);
            let near = || {
                suggest(text, self.links.iter().map(|l| l.name.as_str()), both!("the links are"))
            };
            d.help(self.meant_link(text).unwrap_or_else(near))
        })
    }

    /// Returns help for the notations `BC` and `31` of books where a link is needed: the link that
    /// carries both points, a link relative to another.
    fn meant_link(&self, text: &str) -> Option<Both> {
        let halves = || text.char_indices().skip(1).map(|(i, _)| text.split_at(i));
        let carrier = |(a, b): (&str, &str)| {
            let (p, q) = (self.find_point(a)?, self.find_point(b)?);
            let mut on =
                self.links.iter().filter(|l| l.points.contains(&p) && l.points.contains(&q));
            let name = &on.next().filter(|_| on.next().is_none())?.name;
            Some(both!("{a} and {b} are on link `{name}`: write `{name}`"))
        };
        let relative = |(a, b): (&str, &str)| {
            (self.find_link(a)? != self.find_link(b)?)
                .then(|| both!("for link `{a}` relative to link `{b}` write `{a}/{b}`"))
        };
        halves().find_map(carrier).or_else(|| halves().find_map(relative))
    }

    fn no_point(&self, text: &str, word: &Word) -> Diagnostic {
        let d = Diagnostic::error("unknown-point", both!("there is no point `{text}` on any link"))
            .at(word.span);
        d.help(suggest(text, self.points.iter().map(|p| p.name.as_str()), both!("the points are")))
    }

    /// Returns two different points, as in `AB` or `O2,B`.
    pub fn pair(&self, word: &Word) -> Result<(PointId, PointId), Diagnostic> {
        self.pair_in(&word.text, word)
    }

    /// Returns two different points named by `text`, which is a part of `word`.
    pub fn pair_in(&self, text: &str, word: &Word) -> Result<(PointId, PointId), Diagnostic> {
        within_run(text, word)?;
        let (a, b) = if let Some((a, b)) = halves(text) {
            let find = |t: &str| self.find_point(t).ok_or_else(|| self.no_point(t, word));
            (find(a)?, find(b)?)
        } else {
            let both =
                |i: usize| Some((self.find_point(&text[..i])?, self.find_point(&text[i..])?));
            let found: Vec<_> = text.char_indices().skip(1).filter_map(|(i, _)| both(i)).collect();
            match found.as_slice() {
                [one] => *one,
                [] => return Err(self.no_pair(text, word)),
                many => {
                    let readings = many.iter().map(|(a, b)| {
                        format!("\"{},{}\"", self.points[a.0].name, self.points[b.0].name)
                    });
                    let d = Diagnostic::error(
                        "ambiguous",
                        both!("`{text}` can be read in {} ways", many.len()),
                    )
                    .at(word.span);
                    return Err(d.help(written(&readings.collect::<Vec<_>>())));
                }
            }
        };
        if a == b {
            let d = Diagnostic::error("same-point", both!("`{text}` names the same point twice"))
                .at(word.span);
            return Err(d.help(both!("two different points are wanted")));
        }
        Ok((a, b))
    }

    fn no_pair(&self, text: &str, word: &Word) -> Diagnostic {
        // The longest declared name at the beginning leaves the unknown part.
        let known =
            self.points.iter().filter(|p| text.starts_with(&p.name)).max_by_key(|p| p.name.len());
        match known {
            Some(p) if p.name.len() < text.len() => {
                let rest = &text[p.name.len()..];
                let d = Diagnostic::error(
                    "unknown-point",
                    both!("in `{text}` there is no point `{rest}`"),
                )
                .at(word.span);
                d.help(suggest(
                    rest,
                    self.points.iter().map(|p| p.name.as_str()),
                    both!("the points are"),
                ))
            }
            _ => {
                let d =
                    Diagnostic::error("unknown-point", both!("`{text}` does not name two points"))
                        .at(word.span);
                let names: Vec<_> = self.points.iter().map(|p| p.name.as_str()).collect();
                d.help(both!(
                    "write two of the points one after the other or with a comma; the points are {}",
                    Both::names(&names)
                ))
            }
        }
    }

    /// Returns one or two points, each with or without a link: `E`, `B3`, `CB`, `B3B2`, `B3,B2`,
    /// `O2,3`. `text` is a part of `word`.
    ///
    /// A name that is declared as a whole has priority: with a point `O2`, `O2` is that point and
    /// not the point of link 2 at O.
    pub fn on_links(
        &self,
        text: &str,
        word: &Word,
    ) -> Result<(OnLink, Option<OnLink>), Diagnostic> {
        within_run(text, word)?;
        let mut readings: Vec<(usize, (OnLink, Option<OnLink>))> = Vec::new();
        let weight = |p: &OnLink| usize::from(p.link.is_some());
        if let Some((a, b)) = halves(text) {
            for a in self.singles(a) {
                readings.extend(
                    self.singles(b)
                        .into_iter()
                        .map(|b| (2 + weight(&a) + weight(&b), (a, Some(b)))),
                );
            }
            // A comma also separates a point from its link, if the joined names would be another
            // name.
            if let (Some(point), Some(link)) = (self.find_point(a), self.find_link(b)) {
                readings.push((3, (OnLink { point, link: Some(link) }, None)));
            }
        } else {
            readings.extend(self.singles(text).into_iter().map(|a| (weight(&a), (a, None))));
            for (i, _) in text.char_indices().skip(1) {
                for a in self.singles(&text[..i]) {
                    readings.extend(
                        self.singles(&text[i..])
                            .into_iter()
                            .map(|b| (2 + weight(&a) + weight(&b), (a, Some(b)))),
                    );
                }
            }
        }
        let Some(least) = readings.iter().map(|r| r.0).min() else {
            return Err(self.no_on_link(text, word));
        };
        let best: Vec<_> = readings.iter().filter(|r| r.0 == least).map(|r| r.1).collect();
        match best.as_slice() {
            [one] => Ok(*one),
            many => {
                let d = Diagnostic::error(
                    "ambiguous",
                    both!("`{text}` can be read in {} ways", many.len()),
                )
                .at(word.span);
                Err(d.help(written(&many.iter().map(|r| self.print(r)).collect::<Vec<_>>())))
            }
        }
    }

    /// Returns a moving point, and the frame from which it is observed: a link, else a point. Both
    /// are parts of `word`.
    pub fn seen_from(
        &self,
        point: &str,
        frame: &str,
        word: &Word,
    ) -> Result<(OnLink, Frame), Diagnostic> {
        Ok((self.one_on_link(point, word)?, self.frame(frame, word)?))
    }

    /// Returns a frame: a link or a point.
    pub fn frame(&self, frame: &str, word: &Word) -> Result<Frame, Diagnostic> {
        Ok(match self.find_link(frame) {
            Some(link) => Frame::Link(link),
            None if self.singles(frame).is_empty() => {
                let message = both!("the frame `{frame}` is neither a link nor a point");
                let all = self
                    .links
                    .iter()
                    .map(|l| l.name.as_str())
                    .chain(self.points.iter().map(|p| p.name.as_str()));
                let d = Diagnostic::error("unknown-frame", message).at(word.span);
                return Err(d.help(suggest(frame, all, both!("there are"))));
            }
            None => Frame::Point(self.one_on_link(frame, word)?),
        })
    }

    /// Returns one point, with or without a link.
    fn one_on_link(&self, text: &str, word: &Word) -> Result<OnLink, Diagnostic> {
        match self.on_links(text, word)? {
            (one, None) => Ok(one),
            (_, Some(_)) => {
                let message = both!("`{text}` names two points; here is place for one");
                Err(Diagnostic::error("unknown-point", message).at(word.span))
            }
        }
    }

    /// Returns all readings of a text as one point, with or without a link; several if names
    /// overlap.
    fn singles(&self, text: &str) -> Vec<OnLink> {
        let mut out: Vec<_> =
            self.find_point(text).map(|point| OnLink { point, link: None }).into_iter().collect();
        for (i, _) in text.char_indices().skip(1) {
            if let (Some(point), Some(link)) =
                (self.find_point(&text[..i]), self.find_link(&text[i..]))
            {
                out.push(OnLink { point, link: Some(link) });
            }
        }
        out
    }

    /// Returns true if a text names a link and cannot be read as a point.
    pub fn is_link_only(&self, text: &str) -> bool {
        self.find_link(text).is_some()
            && self.find_point(text).is_none()
            && self.singles(text).is_empty()
    }

    /// Returns the notation for the point of a link in a question: `B3`, or `O2,3` if `O23` has
    /// another reading.
    pub fn run(&self, point: &str, link: &str) -> String {
        let run = format!("{point}{link}");
        let plain = matches!(self.singles(&run).as_slice(), [one] if one.link.is_some())
            && self.point_pairs(&run) == 0;
        if plain { run } else { format!("{point},{link}") }
    }

    fn point_pairs(&self, text: &str) -> usize {
        let pair = |i: usize| {
            self.find_point(&text[..i]).is_some() && self.find_point(&text[i..]).is_some()
        };
        text.char_indices().skip(1).filter(|(i, _)| pair(*i)).count()
    }

    fn print(&self, (a, b): &(OnLink, Option<OnLink>)) -> String {
        let one = |p: &OnLink| {
            format!(
                "{}{}",
                self.points[p.point.0].name,
                p.link.map_or("", |l| self.links[l.0].name.as_str())
            )
        };
        match b {
            Some(b) => format!("\"{},{}\"", one(a), one(b)),
            None => format!("\"{}\"", one(a)),
        }
    }

    fn no_on_link(&self, text: &str, word: &Word) -> Diagnostic {
        let known =
            self.points.iter().filter(|p| text.starts_with(&p.name)).max_by_key(|p| p.name.len());
        if let Some(p) = known
            && p.name.len() < text.len()
        {
            let rest = &text[p.name.len()..];
            let message = both!("in `{text}`, `{rest}` is neither a link nor a point");
            let all = self
                .links
                .iter()
                .map(|l| l.name.as_str())
                .chain(self.points.iter().map(|p| p.name.as_str()));
            return Diagnostic::error("unknown-point", message).at(word.span).help(suggest(
                rest,
                all,
                both!("there are"),
            ));
        }
        self.no_point(text, word)
    }
}
