//! Applied forces and couples, and the part of the motion over which they act.

use super::guides::Numbered;
use super::loads::{loaded, on_link, positive};
use super::*;

/// Guides and drivers of the scene.
pub(super) type GuidesAndDrivers<'a> = (&'a [Numbered], &'a [Driver]);

/// The size of a load in the form of the file.
enum LoadAmount {
    Couple(GivenQuantity),
    Components([GivenQuantity; 2]),
    Magnitude(GivenQuantity),
}

fn fault(message: Both, help: Both, span: Span, faults: &mut Faults) {
    faults.push(Diagnostic::error("force", message).at(span).help(help));
}

pub(super) fn applied(
    c: &Context,
    moving: GuidesAndDrivers,
    raw: &RawApplied,
    faults: &mut Faults,
) -> Option<Applied> {
    let link = loaded(c, &raw.on, faults)?;
    let against = match &raw.against {
        None => false,
        Some(word) if word.text == "motion" => true,
        Some(word) => {
            let message = both!("`{}` is nothing that a force acts against", word.text);
            fault(message, both!("write \"motion\""), word.span, faults);
            return None;
        }
    };
    let course =
        transpose(raw.course.as_ref().map(|course| self::course(c, moving, raw, course, faults)))?;
    let size = match (load_amount(c, raw, course.as_ref(), faults)?, against) {
        (LoadAmount::Couple(given), _) => couple(raw, given, against, faults)?,
        (LoadAmount::Components(xy), _) => {
            if let Some(span) = raw.angle.as_ref().map(|q| q.span).or(raw
                .line
                .as_ref()
                .or(raw.against.as_ref())
                .map(|w| w.span))
            {
                let message = both!("components of a force already tell its direction");
                fault(
                    message,
                    both!("give its magnitude as \"F\", or leave this out"),
                    span,
                    faults,
                );
                return None;
            }
            LoadSize::Components(xy)
        }
        (LoadAmount::Magnitude(given), _) => directed(c, raw, given, against, faults)?,
    };
    let at = match (&size, &raw.at, &c.names.links[link.0].points[..]) {
        (LoadSize::Couple(_) | LoadSize::AgainstTurning(_), ..) => None,
        (_, Some(word), _) => Some(on_link(c, word, link, faults)?),
        (_, None, [one]) => Some(*one),
        (_, None, _) => {
            let message = both!("the force on link `{}` has no point of application", raw.on.text);
            fault(message, both!("give \"at\": {}", c.points_of(link)), raw.span, faults);
            return None;
        }
    };
    Some(Applied { link, at, size, course: course.map(|(course, _)| course), span: raw.span })
}

/// Returns the size of a load: `F`, `M`, or the largest amount of its diagram.
fn load_amount(
    c: &Context,
    raw: &RawApplied,
    course: Option<&(LoadCourse, bool)>,
    faults: &mut Faults,
) -> Option<LoadAmount> {
    let amounts =
        course.map(|(course, _)| course.stations.iter().filter_map(|s| s.amount.as_ref()));
    let largest =
        amounts.and_then(|all| all.max_by(|a, b| a.value.abs().total_cmp(&b.value.abs())));
    match (&raw.force, &raw.moment, largest) {
        (None, None, Some(largest)) => Some(match course {
            Some((_, true)) => LoadAmount::Couple(largest.clone()),
            Some((_, false)) | None => LoadAmount::Magnitude(largest.clone()),
        }),
        (_, _, Some(_)) => {
            let message = both!("the amounts of a load stand in its diagram");
            fault(message, both!("leave \"F\" or \"M\" out"), raw.span, faults);
            None
        }
        (None, None, None) | (Some(_), Some(_), None) => {
            let message = both!("a load is either a force \"F\" or a couple \"M\"");
            fault(message, both!("give one of them"), raw.span, faults);
            None
        }
        (None, Some(moment), None) => {
            Some(LoadAmount::Couple(c.values.si(moment, RequiredQuantity::Moment, faults)?))
        }
        (Some(RawSizeOfForce::Components([x, y])), None, None) => {
            let (x, y) = (
                c.values.si(x, RequiredQuantity::Force, faults),
                c.values.si(y, RequiredQuantity::Force, faults),
            );
            Some(LoadAmount::Components([x?, y?]))
        }
        (Some(RawSizeOfForce::Magnitude(force)), None, None) => {
            Some(LoadAmount::Magnitude(c.values.si(force, RequiredQuantity::Force, faults)?))
        }
    }
}

fn couple(
    raw: &RawApplied,
    given: GivenQuantity,
    against: bool,
    faults: &mut Faults,
) -> Option<LoadSize> {
    for (key, span) in [
        ("at", raw.at.as_ref().map(|w| w.span)),
        ("line", raw.line.as_ref().map(|w| w.span)),
        ("angle", raw.angle.as_ref().map(|q| q.span)),
    ] {
        if let Some(span) = span {
            let message = both!("a couple has no \"{key}\": it acts alike everywhere on its link");
            fault(message, both!("leave it out"), span, faults);
            return None;
        }
    }
    Some(if against {
        LoadSize::AgainstTurning(positive(given, both!("a resisting couple"), faults)?)
    } else {
        LoadSize::Couple(given)
    })
}

/// Resolves a force given by its magnitude: at an angle or against the motion.
fn directed(
    c: &Context,
    raw: &RawApplied,
    given: GivenQuantity,
    against: bool,
    faults: &mut Faults,
) -> Option<LoadSize> {
    let line = transpose(raw.line.as_ref().map(|word| line_of(c, word, faults)))?;
    let angle = transpose(raw.angle.as_ref().map(|q| c.values.angle(q, faults)))?;
    match (against, line.is_some() || angle.is_some()) {
        (true, false) => {
            Some(LoadSize::AgainstMotion(positive(given, both!("a resistance"), faults)?))
        }
        (false, true) => Some(LoadSize::Directed { force: given, line, angle }),
        (true, true) => {
            let message = both!("a force against the motion has no direction of its own");
            fault(message, both!("leave \"angle\" and \"line\" out"), raw.span, faults);
            None
        }
        (false, false) => {
            let message = both!("the force on link `{}` has no direction", raw.on.text);
            let help = both!(
                "give \"angle\": \"270 deg\", \"line\": \"BC\" (from B toward C), or \"against\": \"motion\""
            );
            fault(message, help, raw.span, faults);
            None
        }
    }
}

/// Returns two points of one link.
fn line_of(c: &Context, word: &Word, faults: &mut Faults) -> Option<(PointId, PointId)> {
    let (a, b) = note(c.names.pair(word), faults)?;
    if c.common(a, b).is_some() {
        return Some((a, b));
    }
    let message = both!("`{}` is not a line of one link", word.text);
    faults.push(
        Diagnostic::error("not-on-link", message)
            .at(word.span)
            .help(both!("name two points of a link")),
    );
    None
}

/// Returns the part of the motion, with true if its diagram is one of couples.
fn course(
    c: &Context,
    moving: GuidesAndDrivers,
    load: &RawApplied,
    raw: &RawCourse,
    faults: &mut Faults,
) -> Option<(LoadCourse, bool)> {
    let along = along(c, moving, raw, faults)?;
    let amounts: Vec<&RawQuantity> =
        raw.stations.iter().filter_map(|(_, amount)| amount.as_ref()).collect();
    // A load with a direction is a force.
    let is_couple = !amounts.is_empty()
        && load.at.is_none()
        && load.angle.is_none()
        && load.line.is_none()
        && {
            let mut tried = Faults::default();
            amounts.iter().for_each(|q| drop(c.values.si(q, RequiredQuantity::Moment, &mut tried)));
            !tried.has_errors()
        };
    let wanted = if is_couple { RequiredQuantity::Moment } else { RequiredQuantity::Force };
    let station = |(at, amount): &(RawQuantity, Option<RawQuantity>), faults: &mut Faults| {
        let at = match &along {
            LoadTravel::Turn { .. } => Abscissa::Angle(c.values.angle(at, faults)?),
            LoadTravel::Stroke { .. } => {
                let mut tried = Faults::default();
                match c.values.pure_number(at, &mut tried) {
                    Some(value) => {
                        let radius = f64::EPSILON * value.abs();
                        Abscissa::Part(GivenQuantity {
                            value,
                            radius,
                            text: at.text.clone(),
                            span: at.span,
                        })
                    }
                    None => Abscissa::Way(c.values.si(at, RequiredQuantity::Length, faults)?),
                }
            }
        };
        Some(LoadStation {
            at,
            amount: transpose(amount.as_ref().map(|q| c.values.si(q, wanted, faults)))?,
        })
    };
    let stations: Vec<LoadStation> =
        raw.stations.iter().map(|s| station(s, faults)).collect::<Option<_>>()?;
    let places: Vec<f64> = stations.iter().map(|s| s.at.value()).collect();
    let kinds = stations
        .windows(2)
        .all(|w| matches!(w[0].at, Abscissa::Part(_)) == matches!(w[1].at, Abscissa::Part(_)));
    let rising = places.windows(2).all(|w| w[0] <= w[1]) && places.first() < places.last();
    let inside = |s: &LoadStation| {
        !matches!(&s.at, Abscissa::Part(x) if !(0.0..=1.0).contains(&x.value))
            && s.at.value() >= f64::NEG_INFINITY
    };
    let turn = match &along {
        LoadTravel::Turn { period, .. } => {
            places.last().zip(places.first()).is_some_and(|(b, a)| b - a > period.value.degrees())
        }
        LoadTravel::Stroke { .. } => false,
    };
    let message = if stations.len() < 2 {
        both!("a diagram has two points at least")
    } else if !kinds {
        both!("parts of the stroke and lengths stand side by side")
    } else if !rising {
        both!("the places do not rise: {}", words(&places))
    } else if !stations.iter().all(inside) {
        both!("a part of the stroke lies between 0 and 1: {}", words(&places))
    } else if turn {
        both!("the angles go beyond one period")
    } else {
        return Some((LoadCourse { along, stations, span: raw.span }, is_couple));
    };
    let help = both!(
        "write places in the order of the working stroke, all as parts from 0 to 1 or all as lengths, or angles within one period"
    );
    fault(message, help, raw.span, faults);
    None
}

fn words(places: &[f64]) -> Both {
    let words: Vec<String> = places.iter().map(f64::to_string).collect();
    Both::names(&words.iter().map(String::as_str).collect::<Vec<_>>())
}

/// Returns the motion along which a load is given.
fn along(
    c: &Context,
    (guides, drivers): GuidesAndDrivers,
    raw: &RawCourse,
    faults: &mut Faults,
) -> Option<LoadTravel> {
    match (&raw.slide, &raw.turn) {
        (Some(word), None) => {
            let point = note(c.names.point(word), faults)?;
            let toward = transpose(raw.toward.as_ref().map(|q| c.values.angle(q, faults)))?;
            let straight = |g: &Guide| {
                g.pin == Some(point) && g.on == c.ground && matches!(g.path, GuidePath::Line { .. })
            };
            let Some(guide) = guides.iter().position(|(g, _)| straight(g)) else {
                let message = both!(
                    "`{}` has no stroke: it is no pin in a straight guide on ground",
                    word.text
                );
                fault(
                    message,
                    both!(
                        "name the pin of a slider, or tell the load by an angle: \"turn\": \"1\""
                    ),
                    word.span,
                    faults,
                );
                return None;
            };
            Some(LoadTravel::Stroke {
                point,
                guide: GuideId(guide),
                toward,
                ends: StrokeEnds::default(),
            })
        }
        (None, Some(word)) => {
            let link = note(c.names.link(word), faults)?;
            let Some(driver) =
                drivers.iter().position(|d| d.kind.turned() == Some((link, c.ground)))
            else {
                let message = both!("link `{}` is no driver that turns on ground", word.text);
                fault(message, both!("name a driven link"), word.span, faults);
                return None;
            };
            let period = match &raw.period {
                Some(q) => c.values.angle(q, faults)?,
                None => GivenQuantity {
                    value: Angle::Deg(360.0),
                    radius: 0.0,
                    text: "360 deg".to_owned(),
                    span: raw.span,
                },
            };
            if period.value.degrees() <= 0.0 {
                let message = both!("the period is {}; it must be positive", period.text);
                faults.push(Diagnostic::error("not-positive", message).at(period.span));
                return None;
            }
            Some(LoadTravel::Turn { driver, period })
        }
        (None, None) | (Some(_), Some(_)) => {
            let message = both!("what the load depends on is either a stroke or an angle");
            let help = both!(
                "give \"slide\": \"C\" (the pin of a slider) or \"turn\": \"1\" (a driven link)"
            );
            fault(message, help, raw.span, faults);
            None
        }
    }
}
