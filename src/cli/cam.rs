//! `hodograph cam`: a disc cam over a whole turn, as text and JSON, its figures, and its profile
//! for milling.

use super::draw::{FORMATS, style_of};
use super::places::in_stream;
use super::target::is_stream;
use super::together::Together;
use super::values::{FigureFormat, Profile, TextFormat};
use super::{CommandResult, Failure, SceneInput, args, choices, files, places};
use crate::diag::{Diagnostic, Warned, both};
use crate::problem::cams::{self, SurveyedCam};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Runs the command.
pub fn run(a: args::CamArgs) -> CommandResult {
    places::no_report_beside(a.profile.as_deref(), a.json)?;
    let formats = if a.format.is_empty() { FORMATS.to_vec() } else { places::once(&a.format) };
    let style = style_of(&a.look)?;
    let mut input = SceneInput::read(&a.common)?.drawn_in(&style);
    let (lang, _) = choices(&input.scene, &a.common);
    let alpha = a.alpha.as_deref();
    let allowed = alpha.map(|rise| cams::allowed(rise, a.alpha_back.as_deref())).transpose()?;
    let cams = cams::survey(&input.scene, a.cam, allowed).map_err(|f| input.failed(f))?;
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
                both!("{} would be a folder: a cam has two figures", places::shown(folder)),
            );
            let d = d.help(both!(
                "write -o out/; the profile alone goes to one file or to standard output: --profile -"
            ));
            return Err(Failure::argument("-o", folder, d));
        }
        let stem = files::stem(&input.file.name, "scene");
        for (k, cam) in cams.iter().enumerate() {
            let number = if cams.len() > 1 { format!("-{}", k + 1) } else { String::new() };
            for (word, figure) in cam.figures(&style, lang) {
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
        let [one] = cams.as_slice() else {
            let d = Diagnostic::error("which-cam", both!("the scene has {} cams", cams.len()));
            return Err(Failure::argument("--profile", path, d.help(both!("say which: --cam 1"))));
        };
        let format = if is_stream(path) {
            Some(in_stream(path, &[], Profile::Csv)?)
        } else {
            places::of_name(path)
        };
        let bytes = match format {
            Some(Profile::Csv) => one.profile_csv(a.steps as usize),
            Some(Profile::Dxf) => one.profile_dxf(a.steps as usize).into_bytes(),
            None => {
                let d =
                    Diagnostic::error("output", both!("{path} is neither a .csv nor a .dxf file"));
                let d = d.help(both!("write --profile cam.csv or --profile cam.dxf"));
                return Err(Failure::argument("--profile", path, d));
            }
        };
        add(PathBuf::from(path), &bytes, &mut all)?;
    }
    all.appear()?;
    if a.json {
        let list: Vec<_> = cams.iter().map(SurveyedCam::json).collect();
        files::print(&format!("{:#}\n", serde_json::Value::from(list)))?;
    } else {
        let texts: Vec<String> = cams.iter().map(|cam| cam.text(lang)).collect();
        files::print(&texts.join("\n"))?;
        files::print_names(&written)?;
    }
    let faults: Vec<Diagnostic> = cams.iter().flat_map(|cam| cam.report.faults()).collect();
    input.file.notes.extend(faults);
    input.file.notes.extend(notes);
    input.file.say_notes();
    Ok(ExitCode::SUCCESS)
}
