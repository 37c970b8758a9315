//! The section `find`: the questions.

use super::*;
use crate::cams::raw::RawFollows;
use crate::quantity::combined::halves;
use crate::quantity::{self, Asked, Combined, Entry, Frame, Level, Of, PointMotion, Rate, Turning};
use hodograph_base::lang::each;
use std::borrow::Cow;

pub(super) fn find(c: &Context, faults: &mut Faults) -> Vec<Find> {
    let mut out: Vec<Find> = Vec::new();
    let Some(words) = &c.raw.find else { return everything(c) };
    for word in words {
        let Some(what) = note(asked(c, word).and_then(|what| of_links(c, word, what)), faults)
        else {
            continue;
        };
        if out.iter().any(|f| f.text == word.text) {
            let d = Diagnostic::warning("given-twice", both!("`{}` is asked twice", word.text))
                .at(word.span);
            faults.push(d.help(both!("ask once")));
            continue;
        }
        out.push(Find { what, text: word.text.clone(), span: word.span });
    }
    out
}

/// Refuses motions of a point of contact, which is on no link: the question must name a point of
/// one of the links.
fn of_links(c: &Context, word: &Word, what: Asked) -> Result<Asked, Diagnostic> {
    let moving = match what.of() {
        // The position of a contact is defined.
        _ if what.entry().level == Level::Position => Vec::new(),
        Of::Point(p) => vec![p],
        Of::Points(p, q) => vec![p, q],
        Of::Seen(p, Frame::Point(q)) => vec![p, q],
        Of::Seen(p, Frame::Link(_)) => vec![p],
        Of::Line(..) | Of::Link(_) | Of::Links(..) | Of::Mechanism => Vec::new(),
    };
    let Some(contact) = moving.into_iter().find(|p| p.link.is_none() && c.is_contact(p.point))
    else {
        return Ok(what);
    };
    let name = c.point_name(contact.point);
    let message = both!("`{}`: {name} is a point of contact, not a point of a link", word.text);
    let there = |(pair, at): (&'_ RawRolling, &[PointId; 2])| {
        [0, 1].map(|k| Some(pair.sides[k].clone()).filter(|_| at[k] == contact.point))
    };
    let sides = c.raw.rolling.iter().zip(c.contacts).flat_map(there).flatten();
    let of = |side: RawRollingSide| {
        c.names.run(name, side.link.as_ref().map_or(c.link_name(c.ground), |w| &w.text))
    };
    let cams =
        c.touches.iter().filter(|(at, _)| *at == contact.point).map(|(_, k)| &c.raw.cams[*k]);
    let of_cams =
        cams.flat_map(|cam| [&cam.cam, &cam.follower]).map(|w| c.names.run(name, &w.text));
    let names: Vec<Both> = sides.map(of).chain(of_cams).map(Both::same).collect();
    Err(Diagnostic::error("find", message)
        .at(word.span)
        .help(both!("name the link whose point is meant: {}", Both::join(&names, each!(" or ")))))
}

/// Returns the questions of a scene without `find`: v and a of every moving point, ω and α of every
/// moving link.
fn everything(c: &Context) -> Vec<Find> {
    let (points, links) = (c.names.points, c.names.links);
    let mut out = Vec::new();
    let mut ask = |name: &str, span, what: Asked| {
        out.push(Find { what, text: format!("{}_{name}", what.entry().symbol), span })
    };
    for (i, p) in points.iter().enumerate() {
        let id = PointId(i);
        if !c.carries(c.ground, id) && !c.is_contact(id) {
            let on = OnLink { point: id, link: None };
            Rate::ALL
                .into_iter()
                .for_each(|rate| ask(&p.name, p.span, PointMotion { rate, of: on }.into()));
        }
    }
    for (i, l) in links.iter().enumerate() {
        let id = LinkId(i);
        let carries_guide =
            c.raw.guides.iter().any(|g| g.on.as_ref().is_some_and(|w| w.text == l.name));
        let in_cylinder = c
            .raw
            .drivers
            .iter()
            .any(|d| matches!(&d.kind, RawDriverKind::Cylinder { links, .. } if links.iter().any(|w| w.text == l.name)));
        if id != c.ground && (l.points.len() >= 2 || carries_guide || in_cylinder || c.rolls(id)) {
            Rate::ALL.into_iter().for_each(|rate| {
                ask(&l.name, l.span, Turning { rate, of: id, against: None }.into())
            });
        }
    }
    out
}

/// Returns a symbol in Latin letters, for the Greek ones in figures.
fn spelt(symbol: &str) -> &str {
    match symbol {
        "ω" => "omega",
        "α" => "alpha",
        // The letter in Norton and in Uicker.
        "φ" | "theta" | "θ" => "phi",
        "γ" => "gamma",
        "η" => "eta",
        other => other,
    }
}

/// Returns true if a text begins as a question does: with the symbol of a quantity and `_`.
pub(crate) fn begins_a_question(text: &str) -> bool {
    is_alone(spelt(text.trim()))
        || with_underscore(text.trim_start()).split_once('_').is_some_and(|(symbol, _)| {
            quantity::symbols().iter().any(|e| e.symbol == spelt(symbol))
        })
}

/// True for a symbol that is a question without names: the power `P`.
fn is_alone(symbol: &str) -> bool {
    quantity::lines().any(|e| e.example == symbol && e.symbol == symbol)
}

/// Reads a question, or two of them combined.
pub(super) fn asked(c: &Context, word: &Word) -> Result<Asked, Diagnostic> {
    one(c, word).or_else(|d| combined(c, word).unwrap_or(Err(d)))
}

/// Reads the sum, the difference or the ratio of two quantities; `None` for other texts.
fn combined(c: &Context, word: &Word) -> Option<Result<Asked, Diagnostic>> {
    let part = |text: &str| one(c, &Word { text: text.to_owned(), span: word.span }).ok();
    let (operation, operands) = halves(&word.text)
        .find_map(|(operation, [a, b])| Some((operation, [part(a)?, part(b)?])))?;
    Some(Combined::new(operation, operands).map(Asked::from).ok_or_else(|| {
        let [a, b] = operands.map(|q| q.kind().si());
        let d = Diagnostic::error("find", both!("`{}` combines {a} with {b}", word.text)).at(word.span);
        d.help(both!(
            "a sum is of two quantities of one kind, and a ratio has a unit of length, velocity, acceleration or turning, or none"
        ))
    }))
}

/// Returns a text with the underscore that the name of a centre may omit: `P13D`.
fn with_underscore(text: &str) -> Cow<'_, str> {
    match text.strip_prefix('P') {
        Some(rest) if rest.starts_with(|c: char| c.is_ascii_digit()) => {
            Cow::Owned(format!("P_{rest}"))
        }
        Some(_) | None => Cow::Borrowed(text),
    }
}

fn one(c: &Context, word: &Word) -> Result<Asked, Diagnostic> {
    let text = with_underscore(&word.text);
    let fault = |message: Both| Diagnostic::error("find", message).at(word.span);
    let alone = is_alone(spelt(&text)).then_some((&*text, ""));
    let Some((symbol, rest)) = text.split_once('_').or(alone) else {
        let d = fault(both!("`{}` is not a quantity that can be asked", word.text));
        if matches!(word.text.as_str(), "F" | "class") {
            return Err(d.help(both!(
                "`hodograph mobility` counts the freedoms of the scene and tells the class of its groups"
            )));
        }
        return Err(d.help(both!(
            "write the symbol, _ and the points or links, such as v_E, a_CB, omega_3, ak_B3B2"
        )));
    };
    let symbol = spelt(symbol);
    let symbols = quantity::symbols();
    let Some(entry) = symbols.iter().find(|e| e.symbol == symbol) else {
        let d = fault(both!("`{symbol}` in `{}` is not a quantity that can be asked", word.text));
        return Err(d.help(suggest(
            symbol,
            symbols.iter().map(|e| e.symbol),
            both!("the quantities are"),
        )));
    };
    let question = Question { c, word, symbol: entry.symbol, names: rest };
    match Asked::read(&question)? {
        Some(asked) => Ok(asked),
        // Every family with this symbol needs two points.
        None => Err(question.names_one_point()),
    }
}

/// A question with a known symbol, as a family of quantities reads it: methods to resolve its
/// names.
pub(crate) struct Question<'a> {
    c: &'a Context<'a>,
    word: &'a Word,
    symbol: &'static str,
    names: &'a str,
}

impl Question<'_> {
    /// Returns the question as written.
    pub fn text(&self) -> &str {
        &self.word.text
    }

    /// Returns the part before the `_`, in Latin letters.
    pub fn symbol(&self) -> &'static str {
        self.symbol
    }

    /// Returns the part after the `_`.
    pub fn names(&self) -> &str {
        self.names
    }

    /// Returns a driver's index, counted from 0, if the scene has this driver.
    ///
    /// # Errors
    /// A scene with fewer drivers.
    pub fn driver(&self, driver: usize) -> Result<usize, Diagnostic> {
        let drivers = self.c.raw.drivers.len();
        if driver < drivers.max(1) {
            return Ok(driver);
        }
        let message = both!("`{}`: the scene has no driver of this number", self.text());
        Err(self.fault(message).help(both!("count them in the order of the file, from 1 on")))
    }

    /// Returns true if a table has its symbol.
    pub fn is_among(&self, table: &[Entry]) -> bool {
        table.iter().any(|e| e.symbol == self.symbol)
    }

    /// Returns the row of a table that has its symbol, or the first row.
    pub fn row(&self, table: &[Entry]) -> usize {
        table.iter().position(|e| e.symbol == self.symbol).unwrap_or(0)
    }

    /// Returns a fault of the question.
    pub fn fault(&self, message: Both) -> Diagnostic {
        Diagnostic::error("find", message).at(self.word.span)
    }

    /// Returns the link with this name.
    ///
    /// # Errors
    /// A name that belongs to no link.
    pub fn link(&self, name: &str) -> Result<LinkId, Diagnostic> {
        self.c.names.link_in(name, self.word)
    }

    /// Returns the point with this name, if any.
    pub fn point(&self, name: &str) -> Option<PointId> {
        self.c.names.point(&Word { text: name.to_owned(), span: self.word.span }).ok()
    }

    /// Returns two different links from their joined names: `24`, `2,10`, `2/4`.
    ///
    /// # Errors
    /// Names of other than two links, ambiguous names, or the same link twice.
    pub fn two_links(&self) -> Result<[LinkId; 2], Diagnostic> {
        self.two_links_of(self.names)
    }

    /// Returns two different links from a part of the names.
    ///
    /// # Errors
    /// As [`Question::two_links`].
    pub fn two_links_of(&self, names: &str) -> Result<[LinkId; 2], Diagnostic> {
        if let Some((a, b)) = names.split_once([',', '/']) {
            return self.different([self.link(a.trim())?, self.link(b.trim())?]);
        }
        let cuts = names.char_indices().skip(1).map(|(k, _)| names.split_at(k));
        let found: Vec<[LinkId; 2]> =
            cuts.filter_map(|(a, b)| Some([self.link(a).ok()?, self.link(b).ok()?])).collect();
        match found[..] {
            [links] => self.different(links),
            _ => {
                let d = self.fault(both!("`{}` does not name two links", self.text()));
                Err(d.help(both!("write the two names with a comma, such as {}_1,3", self.symbol)))
            }
        }
    }

    fn different(&self, links: [LinkId; 2]) -> Result<[LinkId; 2], Diagnostic> {
        if links[0] == links[1] {
            return Err(self.fault(both!("`{}` names one link twice", self.text())));
        }
        Ok(links)
    }

    /// Returns the roller of a follower: its centre, the cam on which it rolls, and a point of the
    /// cam.
    pub fn roller(&self, follower: LinkId) -> Option<(PointId, LinkId, PointId)> {
        let name = self.c.link_name(follower);
        self.c.raw.cams.iter().filter(|cam| cam.follower.text == name).find_map(|cam| {
            let pin = cam.follows.roller()?;
            let cam = self.c.names.link(&cam.cam).ok()?;
            Some((self.c.names.point(pin).ok()?, cam, self.first_point(cam)?))
        })
    }

    /// Returns the guides of the file in which a pin or a slider with this name runs, each with the
    /// pin.
    pub fn guides_of(&self, name: &str) -> Vec<(GuideId, Option<PointId>)> {
        let is = |word: &Option<Word>| word.as_ref().is_some_and(|w| w.text == name.trim());
        let mine = |(_, g): &(usize, &RawGuide)| !g.contact && (is(&g.pin) || is(&g.slider));
        let pin = |g: &RawGuide| g.pin.as_ref().and_then(|p| self.c.names.point(p).ok());
        self.c
            .raw
            .guides
            .iter()
            .enumerate()
            .filter(mine)
            .map(|(k, g)| (GuideId(k), pin(g)))
            .collect()
    }

    /// Returns true if a link is the follower of a cam.
    pub fn is_follower(&self, name: &str) -> bool {
        self.c.raw.cams.iter().any(|cam| cam.follower.text == name.trim())
    }

    /// Returns the point of a follower's round end that touches a cam.
    pub fn end_of(&self, follower: LinkId) -> Option<PointId> {
        let name = self.c.link_name(follower);
        let cam =
            self.c.raw.cams.iter().find(|cam| {
                cam.follower.text == name && !matches!(cam.follows, RawFollows::Face(_))
            })?;
        self.c.names.point(cam.follows.pin()?).ok()
    }

    /// Returns the first point of a link.
    pub fn first_point(&self, link: LinkId) -> Option<PointId> {
        self.c.names.links[link.0].points.first().copied()
    }

    /// Returns a point of the scene, on any link.
    pub fn any_point(&self) -> Option<PointId> {
        (!self.c.names.points.is_empty()).then_some(PointId(0))
    }

    /// Returns two different points.
    ///
    /// # Errors
    /// Names of other than two points.
    pub fn pair(&self) -> Result<(PointId, PointId), Diagnostic> {
        self.c.names.pair_in(self.names, self.word)
    }

    /// Returns one or two points, each with its link if the name includes one.
    ///
    /// # Errors
    /// Names that are not points.
    pub fn points(&self) -> Result<(OnLink, Option<OnLink>), Diagnostic> {
        if self.c.names.is_link_only(self.names) {
            return Err(self.of_a_link());
        }
        self.c.names.on_links(self.names, self.word)
    }

    /// Returns two points; the first is observed from the second.
    ///
    /// # Errors
    /// Names of other than two points, or the same point twice.
    pub fn two_points(&self) -> Result<(OnLink, OnLink), Diagnostic> {
        let (of, to) = self.points()?;
        let to = to.ok_or_else(|| self.names_one_point())?;
        if of == to {
            return Err(
                self.fault(both!("`{}` is of a point relative to itself: zero", self.text()))
            );
        }
        Ok((of, to))
    }

    /// Returns a point and, after a slash, the frame from which it is observed, a link or a point;
    /// `None` without a slash.
    ///
    /// # Errors
    /// Names that are not a point and a link or point.
    pub fn point_and_frame(&self) -> Result<Option<(OnLink, Frame)>, Diagnostic> {
        let Some((point, frame)) = self.names.split_once('/') else {
            // A symbol all of whose quantities have a frame.
            let (symbol, first) =
                (self.symbol, quantity::symbols().into_iter().find(|e| e.symbol == self.symbol));
            let d = self.fault(both!("`{}` names no frame", self.text()));
            let example = first.map_or("", |e| e.example);
            return Err(d.help(both!(
                "write the moving point, a stroke, and the link or point from which it is seen: {symbol}_A/2, such as {example}"
            )));
        };
        self.c.names.seen_from(point.trim(), frame.trim(), self.word).map(Some)
    }

    /// Returns the name of a point.
    pub fn point_name(&self, p: PointId) -> &str {
        self.c.point_name(p)
    }

    /// Returns the ground.
    pub fn ground(&self) -> LinkId {
        self.c.ground
    }

    /// Returns true if the link is the ground.
    pub fn is_ground(&self, link: LinkId) -> bool {
        link == self.c.ground
    }

    /// Returns true if a link has an angle: by two points, or by a guide.
    pub fn has_angle(&self, link: LinkId) -> bool {
        let name = self.c.link_name(link);
        let guided = self
            .c
            .raw
            .guides
            .iter()
            .any(|g| [&g.on, &g.slider].into_iter().flatten().any(|w| w.text == name));
        guided || self.c.names.links[link.0].points.len() >= 2
    }

    /// Returns true if the two points are the ends of a cylinder.
    pub fn are_ends_of_a_cylinder(&self, a: PointId, b: PointId) -> bool {
        self.c.raw.drivers.iter().any(|d| match &d.kind {
            RawDriverKind::Cylinder { ends, .. } => self
                .c
                .names
                .pair_in(&ends.text, ends)
                .is_ok_and(|(p, q)| (p, q) == (a, b) || (q, p) == (a, b)),
            RawDriverKind::Turn { .. } | RawDriverKind::Slide { .. } => false,
        })
    }

    fn names_one_point(&self) -> Diagnostic {
        let symbol = self.symbol;
        let example =
            quantity::symbols().iter().find(|e| e.symbol == symbol).map_or("", |e| e.example);
        let d = self.fault(both!(
            "`{}` names one point; `{symbol}` is of one point relative to another",
            self.text()
        ));
        d.help(both!("write for example {example}"))
    }

    /// Returns the fault of a quantity of a point that names a link, with the points of the link as
    /// help.
    fn of_a_link(&self) -> Diagnostic {
        let (c, symbol, link) = (self.c, self.symbol, self.names);
        let d =
            self.fault(both!("`{link}` in `{}` is a link; `{symbol}` is of a point", self.text()));
        let own = c.names.links.iter().find(|l| l.name == link).map_or(&[][..], |l| &l.points);
        let own = own.iter().map(|p| format!("{symbol}_{}", c.point_name(*p)));
        // Where a pin runs in the link's guide, the link has a coincident point with its own
        // motion.
        let pins = c
            .raw
            .guides
            .iter()
            .filter(|g| g.on.as_ref().is_some_and(|on| on.text == link))
            .filter_map(|g| g.pin.as_ref());
        let pins = pins.map(|pin| format!("{symbol}_{}", c.names.run(&pin.text, link)));
        let all: Vec<String> =
            if PointMotion::takes(self) { own.chain(pins).collect() } else { own.collect() };
        d.help(if all.is_empty() {
            both!("name a point")
        } else {
            super::super::names::written(&all)
        })
    }
}
