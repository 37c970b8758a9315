//! A requested width is kept: every template, at widths from a narrow column to an A4 page, is
//! either drawn on a page of exactly this width, in legible type and with a note on omitted items,
//! or not drawn, with a message on the width needed.

use super::legible::SMALLEST_MM;
use hodograph::diag::Warned;
use hodograph::figure::fit::pages;
use hodograph::figure::list::{self, Extras, FigureInput};
use hodograph::figure::sheet::SheetOptions;
use hodograph::paper::extent::bounds;
use hodograph::paper::item::{Figure, Shape};
use hodograph::scene::{self, Lang, PageFormat, templates};
use hodograph::worked::{Scope, work};

const WIDTHS_MM: [f64; 4] = [60.0, 80.0, 118.0, 174.0];
const FIGURES: [&str; 6] =
    ["sheet", "mechanism", "velocity", "acceleration", "equations", "results"];

fn smallest_type(figure: &Figure) -> f64 {
    let size = |s: &Shape| if let Shape::Label { size_mm, .. } = s { Some(*size_mm) } else { None };
    figure.items.iter().filter_map(|i| size(&i.shape)).fold(f64::INFINITY, f64::min)
}

#[test]
fn a_width_is_kept_or_refused() {
    let (mut faults, mut drawn, mut refused) = (Vec::new(), 0, 0);
    for (t, template) in templates::list().iter().enumerate() {
        let scene = scene::read(templates::get(template.name).unwrap()).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        for k in 0..2 {
            // The sheet and one of the other figures, each at another width and in the other
            // language.
            let name = if k == 0 { FIGURES[0] } else { FIGURES[1 + t % (FIGURES.len() - 1)] };
            let width = WIDTHS_MM[(t + k) % WIDTHS_MM.len()];
            let options =
                SheetOptions::of_language(if (t + k) % 2 == 0 { Lang::En } else { Lang::Zh });
            let extras = Extras::default();
            let wanted =
                FigureInput { scene: &scene, worked: &worked, options: &options, extras: &extras };
            let what = format!("{} {name} at {width} mm", template.name);
            match pages(list::named(name).unwrap(), &wanted, &PageFormat::column(width)) {
                Ok(Warned { value, notes }) => {
                    for (_, figure) in &value {
                        drawn += 1;
                        let ink = bounds(&figure.items).unwrap();
                        if (figure.width_mm - width).abs() > 1e-9
                            || ink.min.x < 0.0
                            || ink.max.x > width
                        {
                            faults.push(format!(
                                "{what}: the page is {} mm, its ink goes from {} to {}",
                                figure.width_mm, ink.min.x, ink.max.x
                            ));
                        }
                        if smallest_type(figure) * 0.7 < SMALLEST_MM - 1e-9 {
                            faults.push(format!("{what}: type of {} mm", smallest_type(figure)));
                        }
                        // Items that the full sheet has and this one lacks are reported.
                        let named = |f: &Figure, word: &str| {
                            f.items.iter().any(|i| i.id.contains(word) || i.class.contains(word))
                        };
                        let told = notes.iter().any(|n| n.code == "left-out");
                        let usual = (list::named(name).unwrap().draw)(&wanted).unwrap().value;
                        for word in ["result", "velocity", "acceleration", "heading", "measured"] {
                            if named(&usual[0].1, word) && !named(figure, word) && !told {
                                faults.push(format!(
                                    "{what}: {word} is missing, and nothing is said"
                                ));
                            }
                        }
                    }
                }
                Err(e) => {
                    refused += 1;
                    if !e
                        .list
                        .iter()
                        .all(|d| d.code == "paper-too-small" && d.message.en.contains("needs"))
                    {
                        faults.push(format!("{what}: {e}"));
                    }
                }
            }
        }
    }
    println!("{drawn} pages, {refused} refused");
    assert!(drawn > 4 * refused, "{drawn} pages, {refused} refused");
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

/// Number of letters in the items of a class.
fn written(f: &Figure, class: &str) -> usize {
    let of_class = f.items.iter().filter(|i| i.class.split(' ').any(|c| c == class));
    of_class
        .map(|i| {
            if let Shape::Label { label, .. } = &i.shape {
                label.plain().trim().chars().count()
            } else {
                0
            }
        })
        .sum()
}

#[test]
fn a_narrow_column_leaves_no_words_out() {
    let mut faults = Vec::new();
    for (t, template) in templates::list().iter().enumerate() {
        let scene = scene::read(templates::get(template.name).unwrap()).unwrap().value;
        let worked = work(&scene, Scope::Figure).unwrap().value;
        let options = SheetOptions::of_language(if t % 2 == 0 { Lang::En } else { Lang::Zh });
        let extras = Extras::default();
        let wanted =
            FigureInput { scene: &scene, worked: &worked, options: &options, extras: &extras };
        let sheet = list::named("sheet").unwrap();
        let Ok(Warned { value, notes }) = pages(sheet, &wanted, &PageFormat::column(80.0)) else {
            continue;
        };
        let usual = (sheet.draw)(&wanted).unwrap().value;
        let (here, there) = (&value[0].1, &usual[0].1);
        for class in ["statement", "symbol", "magnitude", "direction", "joint"] {
            let (few, all) = (written(here, class), written(there, class));
            if few != all {
                faults.push(format!("{}: {few} of {all} letters of class {class}", template.name));
            }
        }
        for id in there
            .items
            .iter()
            .map(|i| &i.id)
            .filter(|id| id.ends_with("-measured") || id.ends_with("-value"))
        {
            if here.items.iter().all(|i| i.id != *id) {
                faults.push(format!("{}: {id} is missing", template.name));
            }
        }
        if notes.iter().any(|n| n.code == "left-out" && !n.message.en.contains("polygon")) {
            faults.push(format!(
                "{}: {}",
                template.name,
                notes.iter().map(|n| n.message.en.as_str()).collect::<String>()
            ));
        }
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}
