//! Kutzbach's plan and Willis' table step by step: the rays in the order in which they are found,
//! the angular velocities, the rows of the table.

use hodograph_base::diag::Both;
use hodograph_base::lang::{say, tr};
use hodograph_board::plan::names::point_label;
use hodograph_methods::trains::{given, trains};
use hodograph_paper::paper::style::Style;
use hodograph_report::trains::{omega, sentences, turns};
use hodograph_scene::{Lang, LinkId};

use super::{CAPTION, KutzbachDrawing, KutzbachPlan, KutzbachPoint, TABLE};
use crate::list::FigureInput;
use crate::particle::ParticleView;
use crate::sheet::{SheetDrafter, SheetOptions};
use crate::stepped::SteppedMethod;

/// The plan and the table of the first train step by step; `None` without a train whose angular
/// velocities are known.
pub fn stepped(w: &FigureInput) -> Option<SteppedMethod> {
    let all = trains(w.scene);
    let train = all.first()?;
    let turns = turns(w.scene, w.worked, train)?;
    let maker = SheetDrafter {
        scene: w.scene,
        worked: w.worked,
        options: w.options,
        certified: Vec::new(),
    };
    let mut plan = KutzbachPlan { maker: &maker, train, turns, order: Vec::new() };
    let mut out = SteppedMethod::default();
    let both = |en: String, zh: String| Both { en, zh };
    if let Some(stations) = plan.stations() {
        plan.order = plan.solved(&stations);
        if let Some(KutzbachDrawing { part, scales, .. }) = plan.drawing() {
            let told = |lang| plan.sentences(&stations, lang);
            let sentences = told(Lang::En).into_iter().zip(told(Lang::Zh));
            out.steps.extend(sentences.map(|(en, zh)| both(en, zh)));
            let caption = both(CAPTION[0].to_owned(), CAPTION[1].to_owned());
            out.views.push(ParticleView { part, caption, scales: scales.to_vec() });
        }
    }
    let first = out.steps.len();
    // One size for all: the page shows the table as wide as it can.
    let style = &w.options.style;
    let style = Style { label_mm: style.caption_mm, ..style.clone() };
    let options = SheetOptions { style, ..w.options.clone() };
    let of_table =
        SheetDrafter { scene: w.scene, worked: w.worked, options: &options, certified: Vec::new() };
    let mut table = KutzbachPlan { maker: &of_table, train, turns, order: Vec::new() }.table();
    // The caption says the same.
    table.items.retain(|item| item.id != "willis-heading");
    let tables =
        [Lang::En, Lang::Zh].map(|lang| sentences(w.scene, train, turns, lang, w.options.digits));
    let last = tables[0].len().saturating_sub(1);
    for item in &mut table.items {
        let result = item.id.starts_with("willis-result").then_some(last);
        if let Some(step) = row_of(&item.id).or(result) {
            item.class = format!("{} step-{}", item.class, first + step);
        }
    }
    let [en, zh] = tables;
    out.steps.extend(en.into_iter().zip(zh).map(|(en, zh)| both(en, zh)));
    let caption = both(TABLE[0].to_owned(), TABLE[1].to_owned());
    out.views.push(ParticleView { part: table, caption, scales: Vec::new() });
    Some(out)
}

/// The row of Willis' table to which an item belongs, from its id.
fn row_of(id: &str) -> Option<usize> {
    id.strip_prefix("willis-")?.split('-').next()?.parse().ok()
}

impl KutzbachPlan<'_> {
    /// The step that draws the ray of a link; `None` in a drawing without steps. The first step
    /// shows the line of centres.
    pub(super) fn step_of(&self, link: LinkId) -> Option<usize> {
        self.order.iter().position(|l| *l == link).map(|k| k + 1)
    }

    /// The step that draws the angular velocity of a link: those follow the rays and their pole.
    pub(super) fn rate_step(&self, link: LinkId) -> Option<usize> {
        Some(self.step_of(link)? + self.order.len() + 1)
    }

    /// The links in the order in which their rays are found: those with given angular velocities,
    /// then each that shares two points with links already drawn.
    fn solved(&self, stations: &[KutzbachPoint]) -> Vec<LinkId> {
        let scene = self.maker.scene;
        let moving = || self.links().into_iter().filter(|l| *l != scene.ground);
        let mut order: Vec<LinkId> = moving().filter(|l| given(scene, *l).is_some()).collect();
        if order.is_empty() {
            order.extend(moving().take(1));
        }
        loop {
            let left: Vec<LinkId> = moving().filter(|l| !order.contains(l)).collect();
            let found = left.iter().find(|l| self.shared(stations, &order, **l).len() > 1);
            match found.or(left.first()) {
                Some(next) => order.push(*next),
                None => return order,
            }
        }
    }

    /// The points of a link that it shares with the ground or with links already drawn, each with
    /// that link.
    fn shared<'s>(
        &self,
        stations: &'s [KutzbachPoint],
        order: &[LinkId],
        link: LinkId,
    ) -> Vec<(&'s str, LinkId)> {
        let ground = self.maker.scene.ground;
        let known = |l: &&LinkId| **l != link && (**l == ground || order.contains(l));
        let own = stations.iter().filter(|s| s.links.contains(&link));
        let fixed = |s: &KutzbachPoint| {
            self.maker.scene.links[ground.0]
                .points
                .iter()
                .any(|p| self.maker.scene.point_name(*p) == s.name)
        };
        own.filter_map(|s| {
            let other = s.links.iter().find(known).copied();
            Some((s.name.as_str(), other.or_else(|| fixed(s).then_some(ground))?))
        })
        .collect()
    }

    /// The sentence of each step.
    fn sentences(&self, stations: &[KutzbachPoint], lang: Lang) -> Vec<String> {
        let scene = self.maker.scene;
        let name = |l: LinkId| scene.link_name(l);
        let point = |p: &str| format!("${}$", point_label(p));
        let names: Vec<String> = stations.iter().map(|s| point(&s.name)).collect();
        let mut out = vec![say!(
            lang,
            "The line of centres is drawn upright, with the pitch circles and the points {}. Velocities are perpendicular to it; they begin on the vertical zero line.",
            names.join(lang.comma())
        )];
        for (k, link) in self.order.iter().enumerate() {
            let shared = self.shared(stations, &self.order[..k], *link);
            let rate = self.rate_text(self.rate(*link));
            let symbol = omega(scene, *link);
            let known = given(scene, *link).is_some() || shared.len() < 2;
            let name_of = name(*link);
            out.push(match known {
                true => say!(
                    lang,
                    "Link {name_of} is known: ${symbol} = {rate}$. Its velocities grow in proportion to the distance from its axis; their ends lie on a straight line, the ray {name_of}."
                ),
                false => {
                    let ends: Vec<String> = shared
                        .iter()
                        .take(2)
                        .map(|(p, l)| match *l == scene.ground {
                            true => say!(
                                lang,
                                "{} has no velocity, as it is a point of the fixed link too",
                                point(p)
                            ),
                            false => say!(lang, "{} has the velocity of link {}", point(p), name(*l)),
                        })
                        .collect();
                    say!(
                        lang,
                        "Link {name_of}: {}. The line through both ends is its ray.",
                        ends.join(lang.semicolon())
                    )
                }
            });
        }
        out.push(
            tr!(
                lang,
                "Angular velocities are laid off on a horizontal line; the pole $P$ is above its zero point."
            )
            .to_owned(),
        );
        out.extend(self.order.iter().map(|link| {
            let (symbol, rate) = (omega(scene, *link), self.rate_text(self.rate(*link)));
            say!(
                lang,
                "The parallel to the ray {} through $P$ cuts off ${symbol} = {rate}$.",
                name(*link)
            )
        }));
        out
    }
}
