//! Friction in pins and guides.

use super::guides::Numbered;
use super::loads::{computed, positive};
use super::*;

/// Resolves the pairs of an entry: a pin, or the guides of a slider.
pub(super) fn friction(
    c: &Context,
    guides: &[Numbered],
    raw: &RawFriction,
    faults: &mut Faults,
) -> Vec<Friction> {
    let pairs = match (&raw.pin, &raw.slider) {
        (Some(pin), None) => at_pin(c, pin, raw, faults).map(|pair| vec![pair]),
        (None, Some(slider)) => in_guides(c, guides, slider, raw, faults),
        (None, None) | (Some(_), Some(_)) => {
            let message = both!("friction is in a pin or at a slider");
            let help = both!(
                "write {{\"pin\": \"B\", \"circle\": \"4 mm\"}} or {{\"slider\": \"3\", \"f\": 0.1}}"
            );
            fault(message, help, raw.span, faults)
        }
    };
    pairs.unwrap_or_default().into_iter().map(|at| Friction { at, span: raw.span }).collect()
}

fn fault<T>(message: Both, help: Both, span: Span, faults: &mut Faults) -> Option<T> {
    faults.push(Diagnostic::error("friction", message).at(span).help(help));
    None
}

/// Returns the coefficient of friction.
fn coefficient(c: &Context, raw: &RawQuantity, faults: &mut Faults) -> Option<GivenQuantity> {
    let value = c.values.pure_number(raw, faults)?;
    let given = GivenQuantity {
        value,
        radius: 2.0 * f64::EPSILON * value.abs(),
        text: raw.text.clone(),
        span: raw.span,
    };
    positive(given, both!("a coefficient of friction"), faults)
}

fn at_pin(c: &Context, pin: &Word, raw: &RawFriction, faults: &mut Faults) -> Option<Rub> {
    let point = note(c.names.point(pin), faults)?;
    let links: Vec<LinkId> =
        (0..c.names.links.len()).map(LinkId).filter(|l| c.carries(*l, point)).collect();
    if links.len() < 2 {
        let message = both!("`{}` is no pin that joins two links", pin.text);
        return fault(message, both!("name a joint, or the slider of a guide"), pin.span, faults);
    }
    let on =
        transpose(raw.on.as_ref().map(|word| note(c.names.link(word), faults).map(|l| (l, word))))?;
    let fast = match (on, &links[..]) {
        (Some((link, _)), _) if links.contains(&link) => link,
        (None, [first, _]) => *first,
        (on, _) => {
            let names: Vec<&str> = links.iter().map(|l| c.names.links[l.0].name.as_str()).collect();
            let message = match on {
                Some((_, word)) => {
                    both!("link `{}` does not carry the pin `{}`", word.text, pin.text)
                }
                None => both!(
                    "`{}` joins {} links: in which of them is the pin fast?",
                    pin.text,
                    links.len()
                ),
            };
            let help = both!("write \"on\", one of {}", Both::names(&names));
            return fault(message, help, on.map_or(pin.span, |(_, word)| word.span), faults);
        }
    };
    let circle = match (&raw.circle, &raw.radius, &raw.f) {
        (Some(circle), None, None) => c.values.si(circle, RequiredQuantity::Length, faults)?,
        (None, Some(radius), Some(f)) => {
            let (r, f) =
                (c.values.si(radius, RequiredQuantity::Length, faults), coefficient(c, f, faults));
            computed(
                c,
                format!("({})*({})", r?.text, f?.text),
                radius.span,
                RequiredQuantity::Length,
                faults,
            )?
        }
        _ => {
            let message = both!("the friction circle of `{}` is not told", pin.text);
            let help = both!("give its radius \"circle\", or \"radius\" of the pin and \"f\"");
            return fault(message, help, raw.span, faults);
        }
    };
    Some(Rub::Pin {
        point,
        fast,
        circle: positive(circle, both!("the radius of a friction circle"), faults)?,
    })
}

fn in_guides(
    c: &Context,
    guides: &[Numbered],
    slider: &Word,
    raw: &RawFriction,
    faults: &mut Faults,
) -> Option<Vec<Rub>> {
    let link = note(c.names.link(slider), faults)?;
    let on = transpose(raw.on.as_ref().map(|word| note(c.names.link(word), faults)))?;
    let Some(f) = &raw.f else {
        let message = both!("the friction of slider `{}` is not told", slider.text);
        return fault(message, both!("give \"f\""), raw.span, faults);
    };
    let f = coefficient(c, f, faults)?;
    let runs = |g: &Guide| {
        g.slider == Some(link)
            || g.slider.is_none()
                && g.pin.is_some_and(|p| c.names.links[link.0].points.contains(&p))
    };
    let own = |g: &Guide| {
        runs(g) && on.is_none_or(|on| g.on == on) && matches!(g.path, GuidePath::Line { .. })
    };
    let found: Vec<Rub> = guides
        .iter()
        .enumerate()
        .filter(|(_, (g, _))| own(g))
        .map(|(k, _)| Rub::Guide { guide: GuideId(k), f: f.clone() })
        .collect();
    if found.is_empty() {
        let message = both!("link `{}` slides in no straight guide", slider.text);
        return fault(message, both!("name a slider, or a pin"), slider.span, faults);
    }
    Some(found)
}
