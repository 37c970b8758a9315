//! Disc cams over a whole turn, with the least base circle for an allowed pressure angle, and their
//! profiles as files.

use super::range::WrongValue;
use crate::cam::{AllowedPressure, CamMotion, ProfileSegment};
use crate::diag::{Diagnostic, Faults, both};
use crate::figure::cam::{inversion, least, motion};
use crate::geom::Vec2;
use crate::paper::item::Figure;
use crate::paper::style::Style;
use crate::render::dxf::{Entity, dxf};
use crate::report::cam::{LeastCams, Report};
#[cfg(feature = "csv")]
use crate::report::table::{Csv, RowFormat as _, TableHead, TablePiece};
use crate::scene::{Cam, Lang, Scene, edit};
use serde_json::Value as Json;
use std::f64::consts::FRAC_PI_2;

/// Usual number of steps of a profile.
pub const STEPS: u32 = 720;

/// Usual allowed pressure angle of the return of a follower that a spring holds.
const BACK: &str = "75deg";

/// A cam over a whole turn.
pub struct SurveyedCam<'a> {
    /// Displacement, shocks, pressure angle and curvature.
    pub report: Report<'a>,
    /// The least base circle and radius, if they are asked for.
    pub least: Option<LeastCams>,
}

/// Returns the cams of a scene, or the one with a number from 1, with the least ones for allowed
/// pressure angles.
///
/// # Errors
/// `no-cam`; `cam-pose` for cams whose pivot or follower moves; those of [`Report::least`].
pub fn survey(
    scene: &Scene,
    which: Option<usize>,
    allowed: Option<AllowedPressure>,
) -> Result<Vec<SurveyedCam<'_>>, Faults> {
    let mut all = Vec::new();
    for report in chosen(scene, which)?.into_iter().filter_map(|cam| Report::of(scene, cam)) {
        let least = allowed.map(|allowed| report.least(allowed)).transpose()?;
        all.push(SurveyedCam { report, least });
    }
    Ok(all)
}

/// Reads the allowed pressure angles of the rise and of the return, which is 75° without one.
///
/// # Errors
/// `cam-alpha` for an angle that is not between 0° and 90°; texts that are no angles.
pub fn allowed(rise: &str, back: Option<&str>) -> Result<AllowedPressure, WrongValue> {
    let read = |of, text: &str| {
        let angle = edit::angle(text).map_err(|f| WrongValue::new(of, text, f))?.radians();
        if angle > 0.0 && angle < FRAC_PI_2 {
            return Ok(angle);
        }
        let d = Diagnostic::error(
            "cam-alpha",
            both!("an allowed pressure angle is between 0° and 90°, not {text}"),
        );
        Err(WrongValue::new(of, text, d.help(both!("usual is 30deg"))))
    };
    Ok(AllowedPressure {
        rise: read("alpha", rise)?,
        back: read("alpha-back", back.unwrap_or(BACK))?,
    })
}

impl SurveyedCam<'_> {
    /// Returns the report as text.
    pub fn text(&self, lang: Lang) -> String {
        let more = self.least.as_ref().map(|l| self.report.least_text(l, lang));
        self.report.text(lang) + &more.unwrap_or_default()
    }

    /// Returns the report as JSON, in SI.
    pub fn json(&self) -> Json {
        let mut json = self.report.json();
        if let Some(least) = &self.least {
            json["least"] = self.report.least_json(least);
        }
        json
    }

    /// Draws the motion diagrams, the profile by inversion and, with the least cams, the diagram in
    /// which they are found; each with the word for its file.
    pub fn figures(&self, style: &Style, lang: Lang) -> Vec<(&'static str, Figure)> {
        let r = &self.report;
        let mut all = vec![
            ("cam-motion", motion::figure(r, style, lang)),
            ("cam-profile", inversion::figure(r, style, lang)),
        ];
        all.extend(self.least_figure(style, lang).map(|figure| ("cam-alpha", figure)));
        all
    }

    /// Draws the diagram in which the least cams are found, if they are asked for.
    pub fn least_figure(&self, style: &Style, lang: Lang) -> Option<Figure> {
        self.least.as_ref().map(|l| least::figure(&self.report, l, style, lang))
    }

    /// Returns the profile as a table in a number of steps of a turn, in SI.
    #[cfg(feature = "csv")]
    pub fn profile_csv(&self, steps: usize) -> Vec<u8> {
        let (names, columns) = self.report.table(steps);
        let csv = Csv::new(TableHead::new("", names));
        let views: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
        let rows = columns.first().map_or(0, Vec::len);
        let mut out = csv.begin(rows as u64, &[]);
        // Writing to memory does not fail.
        if let Ok(piece) = csv.piece_in(&views, TablePiece::default()) {
            out.extend(piece.parts.concat());
        }
        out
    }

    /// Returns the profile as a drawing (mm).
    pub fn profile_dxf(&self, steps: usize) -> String {
        dxf(&entities(&self.report, steps))
    }
}

/// Returns the cams that can be surveyed, or the one at a place in the list.
fn chosen(scene: &Scene, which: Option<usize>) -> Result<Vec<&Cam>, Faults> {
    let cams = &scene.cams;
    if cams.is_empty() {
        let d = Diagnostic::error("no-cam", both!("the scene has no cam"));
        return Err(d
            .help(both!("add \"cams\"; `hodograph new cam-offset-roller` writes an example"))
            .into());
    }
    if let Some(k) = which.filter(|k| *k == 0 || *k > cams.len()) {
        let d =
            Diagnostic::error("no-cam", both!("there is no cam {k}: the scene has {}", cams.len()));
        return Err(d.into());
    }
    let named = cams.iter().enumerate().filter(|(i, _)| which.is_none_or(|k| k == i + 1));
    let all: Vec<&Cam> =
        named.clone().map(|(_, cam)| cam).filter(|cam| cam.disc.is_some()).collect();
    if !all.is_empty() {
        return Ok(all);
    }
    let faults = named.map(|(_, c)| {
        let message = both!(
            "cam `{}` or its follower is carried by a moving link: its motion over a turn is that of the whole mechanism",
            scene.link_name(c.cam)
        );
        Diagnostic::error("cam-pose", message).at(c.span).help(both!("use `curves` or `sweep`"))
    });
    Err(Faults { list: faults.collect() })
}

/// The profile in millimetres: arcs and lines unchanged, a motion law as a closed chain of lines;
/// base circle and bore are not included.
fn entities(report: &Report, steps: usize) -> Vec<(&'static str, Entity)> {
    let disc = &report.turning.disc;
    let mm = |v: Vec2| v * 1e3;
    let mut out: Vec<(&'static str, Entity)> = Vec::new();
    match &disc.motion {
        CamMotion::Law { .. } => {
            out.push(("PROFILE", Entity::Closed(disc.outline(steps).into_iter().map(mm).collect())))
        }
        CamMotion::Profile(segments) => out.extend(segments.iter().filter_map(|s| {
            let entity = match *s {
                ProfileSegment::Line { .. } => {
                    let ends = s.points(1.0);
                    Entity::Line([mm(ends[0]), mm(*ends.last()?)])
                }
                ProfileSegment::Arc { radius: 0.0, .. } => return None,
                ProfileSegment::Arc { centre, radius, normals: [from, to] }
                    if to - from >= std::f64::consts::TAU =>
                {
                    Entity::Circle { centre: mm(centre), radius: radius * 1e3 }
                }
                ProfileSegment::Arc { centre, radius, normals: [from, to] } => {
                    // The centre of a concave arc is on the other side, and the arc runs in the
                    // other direction.
                    let half = if radius < 0.0 { std::f64::consts::PI } else { 0.0 };
                    let (low, high) = (from.min(to) + half, from.max(to) + half);
                    let degrees = [low, high].map(|a| crate::cam::in_turn(a).to_degrees());
                    Entity::Arc { centre: mm(centre), radius: radius.abs() * 1e3, degrees }
                }
            };
            Some(("PROFILE", entity))
        })),
    }
    out.push(("CENTRE", Entity::Line([Vec2::new(-2.0, 0.0), Vec2::new(2.0, 0.0)])));
    out.push(("CENTRE", Entity::Line([Vec2::new(0.0, -2.0), Vec2::new(0.0, 2.0)])));
    out
}
