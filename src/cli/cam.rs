//! `hodograph cam`: a disc cam over a whole turn, as text and JSON, its figures, and its profile
//! for milling.

use super::draw::{FORMATS, style_of};
use super::places::in_stream;
use super::target::is_stream;
use super::together::Together;
use super::values::{FigureFormat, Profile, TextFormat};
use super::{CommandResult, Failure, SceneInput, args, choices, files, places};
use crate::cam::{AllowedPressure, CamMotion, ProfileSegment};
use crate::diag::{Diagnostic, Faults, Warned, both};
use crate::figure::cam::{inversion, least, motion};
use crate::geom::Vec2;
use crate::render::dxf::{Entity, dxf};
use crate::report::cam::{LeastCams, Report};
use crate::report::table::{Csv, RowFormat as _, TableHead, TablePiece};
use crate::scene::{Cam, edit};
use std::f64::consts::FRAC_PI_2;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Runs the command.
pub fn run(a: args::CamArgs) -> CommandResult {
    places::no_report_beside(a.profile.as_deref(), a.json)?;
    let formats = if a.format.is_empty() { FORMATS.to_vec() } else { places::once(&a.format) };
    let style = style_of(&a.look)?;
    let mut input = SceneInput::read(&a.common)?.drawn_in(&style);
    let (lang, _) = choices(&input.scene, &a.common);
    let chosen = chosen(&input, a.cam).map_err(|f| input.failed(f))?;
    let reports: Vec<Report> =
        chosen.iter().filter_map(|cam| Report::of(&input.scene, cam)).collect();
    let allowed = allowed(&a)?;
    let least: Vec<Option<LeastCams>> = reports
        .iter()
        .map(|r| allowed.map(|allowed| r.least(allowed)).transpose())
        .collect::<Result<_, _>>()
        .map_err(|d: Diagnostic| input.failed(d.into()))?;
    let mut all = Together::default();
    let mut written = String::new();
    let mut notes = Vec::new();
    let mut add = |path: PathBuf, bytes: &[u8], all: &mut Together| -> Result<(), Failure> {
        all.add(&path, bytes)?;
        written += &format!("{}\n", path.display());
        Ok(())
    };
    if let Some(folder) = &a.output {
        if places::of_name::<FigureFormat>(folder).is_some() || is_stream(folder) {
            let d = Diagnostic::error(
                "output",
                both!(
                    "{} would be a folder: a cam has two figures",
                    "{}应为文件夹：凸轮有两幅图",
                    places::shown(folder)
                ),
            );
            let d = d.help(both!(
                "write -o out/; the profile alone goes to one file or to standard output: --profile -",
                "请写 -o out/；仅廓线可写入一个文件或标准输出：--profile -"
            ));
            return Err(Failure::argument("-o", folder, d));
        }
        let stem = files::stem(&input.file.name, "scene");
        for (k, (r, least)) in reports.iter().zip(&least).enumerate() {
            let diagram = least.as_ref().map(|l| ("cam-alpha", least::figure(r, l, &style, lang)));
            let number = if reports.len() > 1 { format!("-{}", k + 1) } else { String::new() };
            for (word, figure) in [
                ("cam-motion", motion::figure(r, &style, lang)),
                ("cam-profile", inversion::figure(r, &style, lang)),
            ]
            .into_iter()
            .chain(diagram)
            {
                for format in &formats {
                    let Warned { value, notes: more } =
                        files::bytes(&figure, *format, TextFormat::Outlines, a.dpi)
                            .map_err(|f| input.failed(f))?;
                    notes.extend(
                        more.into_iter().filter(|n| !notes.contains(n)).collect::<Vec<_>>(),
                    );
                    add(
                        Path::new(folder)
                            .join(format!("{stem}-{word}{number}.{}", format.ending())),
                        &value,
                        &mut all,
                    )?;
                }
            }
        }
    }
    if let Some(path) = &a.profile {
        let [one] = reports.as_slice() else {
            let d = Diagnostic::error(
                "which-cam",
                both!("the scene has {} cams", "机构文件有 {} 个凸轮", reports.len()),
            );
            return Err(Failure::argument(
                "--profile",
                path,
                d.help(both!("say which: --cam 1", "请写明是哪一个：--cam 1")),
            ));
        };
        let format = if is_stream(path) {
            Some(in_stream(path, &[], Profile::Csv)?)
        } else {
            places::of_name(path)
        };
        let bytes = match format {
            Some(Profile::Csv) => csv(one, a.steps as usize)?,
            Some(Profile::Dxf) => dxf(&entities(one, a.steps as usize)).into_bytes(),
            None => {
                let d = Diagnostic::error(
                    "output",
                    both!(
                        "{path} is neither a .csv nor a .dxf file",
                        "{path} 不是 .csv 或 .dxf 文件"
                    ),
                );
                let d = d.help(both!(
                    "write --profile cam.csv or --profile cam.dxf",
                    "请写 --profile cam.csv 或 --profile cam.dxf"
                ));
                return Err(Failure::argument("--profile", path, d));
            }
        };
        add(PathBuf::from(path), &bytes, &mut all)?;
    }
    all.appear()?;
    if a.json {
        let one = |(r, least): (&Report, &Option<LeastCams>)| {
            let mut json = r.json();
            if let Some(least) = least {
                json["least"] = r.least_json(least);
            }
            json
        };
        let list: Vec<_> = reports.iter().zip(&least).map(one).collect();
        files::print(&format!("{:#}\n", serde_json::Value::from(list)))?;
    } else {
        let one = |(r, least): (&Report, &Option<LeastCams>)| {
            let more = least.as_ref().map(|l| r.least_text(l, lang)).unwrap_or_default();
            r.text(lang) + &more
        };
        let texts: Vec<String> = reports.iter().zip(&least).map(one).collect();
        files::print(&texts.join("\n"))?;
        files::print_names(&written)?;
    }
    let faults: Vec<Diagnostic> = reports.iter().flat_map(Report::faults).collect();
    input.file.notes.extend(faults);
    input.file.notes.extend(notes);
    input.file.say_notes();
    Ok(ExitCode::SUCCESS)
}

/// Returns the allowed pressure angles of the options.
fn allowed(a: &args::CamArgs) -> Result<Option<AllowedPressure>, Failure> {
    let read = |option: &str, text: &str| {
        let angle = edit::angle(text).map_err(|f| Failure::argument(option, text, f))?.radians();
        if angle > 0.0 && angle < FRAC_PI_2 {
            return Ok(angle);
        }
        let d = Diagnostic::error(
            "cam-alpha",
            both!(
                "an allowed pressure angle is between 0° and 90°, not {text}",
                "许用压力角应在 0° 与 90° 之间，不能是 {text}"
            ),
        );
        Err(Failure::argument(option, text, d.help(both!("usual is 30deg", "常用 30deg"))))
    };
    let Some(alpha) = &a.alpha else { return Ok(None) };
    let rise = read("--alpha", alpha)?;
    let back = read("--alpha-back", a.alpha_back.as_deref().unwrap_or("75deg"))?;
    Ok(Some(AllowedPressure { rise, back }))
}

/// Returns the cams that can be surveyed, or the one at a place in the list.
fn chosen(input: &SceneInput, which: Option<usize>) -> Result<Vec<&Cam>, Faults> {
    let cams = &input.scene.cams;
    if cams.is_empty() {
        let d = Diagnostic::error("no-cam", both!("the scene has no cam", "机构文件中没有凸轮"));
        return Err(d
            .help(both!(
                "add \"cams\"; `hodograph new cam-offset-roller` writes an example",
                "请加上 \"cams\"；`hodograph new cam-offset-roller` 给出一例"
            ))
            .into());
    }
    if let Some(k) = which.filter(|k| *k == 0 || *k > cams.len()) {
        let d = Diagnostic::error(
            "no-cam",
            both!(
                "there is no cam {k}: the scene has {}",
                "没有第 {k} 个凸轮：机构文件共有 {} 个",
                cams.len()
            ),
        );
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
            "凸轮 `{}` 或其从动件装在活动构件上：一周的运动取决于整个机构",
            input.scene.link_name(c.cam)
        );
        Diagnostic::error("cam-pose", message).at(c.span).help(both!("use `curves` or `sweep`", "请用 `curves` 或 `sweep`"))
    });
    Err(Faults { list: faults.collect() })
}

/// The profile as a table.
fn csv(report: &Report, steps: usize) -> Result<Vec<u8>, Failure> {
    let (names, columns) = report.table(steps);
    let csv = Csv::new(TableHead::new("", names));
    let views: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let mut out = csv.begin(columns[0].len() as u64, &[]);
    // Writing to memory does not fail.
    let piece = csv
        .piece_in(&views, TablePiece::default())
        .map_err(|e| Failure::Output(both!("{e}", "{e}")))?;
    out.extend(piece.parts.concat());
    Ok(out)
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
