//! Each cam over its turn: the motion of its follower, and its profile by inversion.

use crate::cam::{instant, inversion, motion};
use hodograph_base::diag::{Faults, Warned};
use hodograph_base::lang::each;
use hodograph_report::cam::Report;

use super::{FigureEntry, FigureInput, Pages};

/// Diagrams of the follower, and the profile by inversion 反转法.
pub const ENTRY: FigureEntry = FigureEntry {
    name: "cam",
    about: each!("Cams: motion of the follower over a turn, and the profile by inversion"),
    draw,
};

/// Each cam at the instant, with α, s, h and the angles of rise, dwells and return.
pub const INSTANT: FigureEntry = FigureEntry {
    name: "cam-instant",
    about: each!("Cams at the instant: pressure angle, s, h, base circle, pitch curve"),
    draw: draw_instant,
};

fn draw_instant(w: &FigureInput) -> Result<Warned<Pages>, Faults> {
    let reports = w.scene.cams.iter().filter_map(|cam| Report::of(w.scene, cam));
    let (style, lang) = (&w.options.style, w.options.lang);
    let figures: Vec<_> = reports.filter_map(|r| instant::figure(&r, style, lang)).collect();
    let one = figures.len() == 1;
    let named = |(k, figure)| {
        let number = if one { String::new() } else { format!("-{}", k + 1) };
        (format!("{}{number}", INSTANT.name), figure)
    };
    Ok(Warned { value: figures.into_iter().enumerate().map(named).collect(), notes: Vec::new() })
}

fn draw(w: &FigureInput) -> Result<Warned<Pages>, Faults> {
    let reports: Vec<Report> =
        w.scene.cams.iter().filter_map(|cam| Report::of(w.scene, cam)).collect();
    let (style, lang) = (&w.options.style, w.options.lang);
    let mut pages = Pages::new();
    for (k, report) in reports.iter().enumerate() {
        let number = if reports.len() > 1 { format!("-{}", k + 1) } else { String::new() };
        pages.push((format!("cam-motion{number}"), motion::figure(report, style, lang)));
        pages.push((format!("cam-profile{number}"), inversion::figure(report, style, lang)));
    }
    Ok(Warned { value: pages, notes: Vec::new() })
}
