//! Solves planar mechanisms as on the drawing board.
//!
//! From one scene file, hodograph plans the relative-motion vector equations, draws the velocity
//! and acceleration polygons step by step to the scales μ_l, μ_v, μ_a, reads the answers off the
//! paper, and proves them against the loop equations.
//!
//! A file of any kind (a scene, a design task, motions of points) is solved by one call; the
//! answers are then written in all forms. A scene can also be built without a file:
//! ```
//! use hodograph::{problem::{Look, Options, Pictures, Problem, read, solve, templates}, render::svg, scene::build::*};
//!
//! let problem = read(templates::text("shaper", &[("l_O1A", "120 mm")])?)?.value;
//! let solved = solve(&problem, &Options::with_figures())?;
//! println!("{}", solved.text(&Look::default(), false));
//! let markup = svg::write(&solved.figures(&Pictures::default(), &Look::default())?.value[0].1)?.value;
//! assert!(markup.starts_with("<svg"));
//!
//! let scene = Builder::new()
//!     .link("1", ["A", "B"]).link("2", ["B", "C"]).link("3", ["C", "D"]).link("4", ["A", "D"]).ground("4")
//!     .length("AB", mm(100.0)).length("BC", mm(250.0)).length("CD", mm(200.0)).length("AD", mm(300.0))
//!     .driver(Driver::turning("1").angle(deg(60.0)).omega(rad_per_s(10.0)))
//!     .find(["v_C", "a_C"]).build()?.value;
//! let answers = solve(&Problem::of_scene(scene).value, &Options::default())?.answers(&Look::default());
//! assert_eq!(answers.len(), 2);
//! # Ok::<(), hodograph::diag::Faults>(())
//! ```
//!
//! # From scene to sheet
//! ```text
//! scene.json ─▶ Scene ─▶ Mechanism ─┬─▶ Plan ──────────┬─▶ Drawing ──────┬─▶ Figure ─▶ SVG ─▶ PNG
//!   raw text    valid,   links,     │  which equations, │  paper mm,      │  lines, arrows,
//!               SI       pairs,     │  no numbers       │  ruler steps    │  labels in mm
//!                        groups     └─▶ Configuration ──┤                 └─▶ Answers ──┐
//!                                       positions       └─▶ Solution (loop equations) ──┴─▶ Agreement
//! ```
//! Every arrow is one public function from one finished value to the next; no stage uses the result
//! of a later one. [`worked::work`] calls them all; [`problem::solve()`] does it for every kind of
//! file.
//!
//! # Modules
//! The modules of all crates:
//! - [`scene`]: the scene file. JSON with places → raw mirror → valid [`scene::Scene`]; scenes
//!   without JSON ([`scene::build`]); units, expressions, templates, schema; the questions, one
//!   file for each family of quantities ([`scene::quantity`]); the unit in which a number is
//!   printed ([`scene::book`]).
//! - [`cam`]: disc cams as plain geometry: motion laws, profiles of arcs and lines, the profile
//!   by inversion, pressure angle, curvature.
//! - [`mechanism`]: links, pairs, drivers as a graph, each pair a value that demands a form;
//!   mobility, and redundant pairs; Assur groups in the order of solution with their legs; the
//!   demand of the questions.
//! - [`position`]: positions of all points and links: a kernel for each dyad, triads, Newton's
//!   method for the rest; the check that redundant pairs hold ([`position::redundant`]).
//! - [`stated`]: proof of a configuration against the data of the scene: lengths, sides, guides,
//!   drivers, contacts without penetration. It shares nothing with the position solver.
//! - [`motion`]: velocities and accelerations group by group, for any kind of number; [`number`]:
//!   the kinds of number.
//! - [`plan`]: the vector equations: legs to loci, images, notation profiles, words and symbols.
//!   It holds no numbers.
//! - [`construction`]: the acts with ruler and set squares, as plain data without coordinates,
//!   and their evaluation for given places, scales and pencil.
//! - [`construct`]: the drawing board: a plan written as acts and drawn; the only conversion
//!   between SI and millimetres ([`construct::scale`]), polygons, readings.
//! - [`force`]: loads of an instant: given forces, weights, springs, inertia.
//! - [`equilibrium`]: forces on the drawing board: moments and force polygons, group after group.
//! - [`analytic`]: constraint rows, Jacobian, conditioning; singular poses by the next orders. It
//!   uses neither plan nor paper.
//! - [`paper`]: the parts of figures: typed items in mm, labels, words of both languages, fonts,
//!   placement of labels, styles; [`render`]: the writers: numbers, SVG and PDF (the only places
//!   that convert between y up and y down), PNG; animated GIF and SVG; the comparison of two
//!   figures ([`render::diff`]).
//! - [`answer`]: the meaning of a question, for both methods; [`accuracy`]: the difference
//!   between them, and the effect of a pencil's error on the drawing.
//! - [`worked`]: the whole solution as one call, with the result of each stage.
//! - [`certified`]: the number of true digits ([`certified::ladder`], for the steps of the
//!   drawing [`certified::steps()`]); [`effort`]: the work done, and the cost of accuracy
//!   ([`effort::ways`]).
//! - [`centres`]: instantaneous centres of velocity: the order of finding from topology alone,
//!   two lines drawn for each, angular velocities and speeds by centres beside those of drawing and
//!   analysis.
//! - [`curvature`]: the curvature of paths: pole, inflection circle, centres of curvature with
//!   the ruler and from accelerations; centrodes.
//! - [`inversions`]: each link of a chain as ground in turn, each as a scene.
//! - [`gears`]: a pair of spur gears with involute flanks: circles, profile shifts, contact
//!   ratio.
//! - [`trains`]: gear trains by Willis' method, from numbers of teeth alone, beside the results
//!   of drawing and analysis.
//! - [`attempts`]: wrong solutions: the places where a known mistake is possible, and the result
//!   of its equations, drawn on the same board.
//! - [`composite`]: composite motion of a point: suitable moving points and frames with reasons,
//!   the parts of the motion, projections.
//! - [`loops`]: the analytic method written out: vector loops, their real and imaginary parts, the
//!   unknowns of each group as formulas that carry their values.
//! - [`equation`]: vector equations on their own: the four cases with two unknowns, in closed form
//!   and drawn.
//! - [`particle`]: motions without a mechanism: pursuit, integrated with an error bound; a plate
//!   that turns in space, in two views.
//! - [`sweep`]: all positions of a driver: the scene compiled to operations over chunks of
//!   positions; limits and extremes of the motion; batches of mechanisms.
//! - [`search`]: crank-rockers with a coupler point that passes nearest to given places, by
//!   differential evolution and Gauss–Newton.
//! - [`synthesis`]: scenes for a prescribed task of a linkage: closed formulas, the construction
//!   with ruler and paper, judgement by sweeping.
//! - [`figure`]: diagram, polygons, tables, sheet as items on paper; for a motion line diagrams,
//!   paths with hodographs, the sheet of many poses, the motion frame by frame.
//! - [`lesson`]: one HTML page with the construction step by step and a driver to drag, and
//!   fragments for slides.
//! - [`report`]: plan, construction, answers, diagnostics as text (in either language) and JSON.
//! - [`worksheet`]: problem and solution as a document, and its writers: HTML with MathML,
//!   Markdown, Typst, pages for PDF.
//! - [`webfont`]: the embedded fonts of every page.
//! - [`homework`]: variants of a problem for a class, their keys, marks, and questions for learning
//!   platforms.
//! - [`exchange`]: files of other programs: DXF, GeoGebra, slides, mdBook, and linkages of pylinkage and PMKS in
//!   both directions; [`zip`]: archives.
//! - [`problem`]: every kind of file through one call: read, solve, and write the answers; a figure
//!   that is drawn again while drivers are dragged ([`problem::Live`]).
//! - [`cli`]: the only module that prints, reads arguments or touches files; [`parts`] of it, a
//!   batch in a folder, is public for bindings.
//! - [`templates`](problem::templates): the texts of the files under `templates/`, by their
//!   names.
//! - Small shared ones: [`geom`], [`linear`], [`trig`], [`digits`], [`diag`], [`budget`],
//!   [`json`](hodograph_base::json), [`kind`], [`diagram`], [`lang`] with
//!   [`translate`](hodograph_base::lang), [`notation`].
//!
//! # Crates
//! The modules are grouped into crates under `crates/`. Cargo therefore refuses imports that the
//! table below forbids, above all between drawing and analysis, and builds each crate at its own
//! level of optimisation. The root package re-exports everything that a user needs; it holds the
//! modules that write documents, and the program. A package includes only files of its own: the
//! folder `templates/` is a crate, and the fonts are in `crates/paper`.
//! ```text
//! templates  templates
//! translate  translate
//! base       diag budget json digits trig number geom linear cam kind diagram lang notation
//! scene      scene
//! mechanism  mechanism position stated answer force motion
//! board      plan construction construct equilibrium
//! analytic   analytic
//! sweep      sweep
//! paper      paper render
//! worked     accuracy worked certified effort
//! methods    gears trains centres composite attempts curvature inversions loops particle equation
//! search     search
//! synthesis  synthesis
//! report     report
//! figure     figure
//! ```
//!
//! # Who may import whom
//! The modules from the bottom up, each with the modules that it imports. `tests/tidy.rs` compares
//! the table with the imports of all files.
//! ```text
//! templates  -
//! translate  -
//! diag       -
//! budget     diag
//! json       diag
//! lang       diag translate
//! kind       -
//! diagram    diag lang kind
//! notation   lang
//! digits     -
//! trig       -
//! number     budget trig
//! geom       number
//! linear     -
//! cam        number geom lang
//! scene      templates diag json diagram kind lang digits trig number geom cam
//! mechanism  diag scene
//! position   diag lang budget digits trig number geom linear cam scene mechanism
//! stated     diag digits trig geom cam scene mechanism position
//! answer     number geom scene mechanism position
//! force      diag trig number geom scene mechanism position answer
//! motion     number geom scene mechanism position answer force
//! plan       diag notation scene mechanism
//! construction budget diagram digits kind number geom
//! construct  diag lang budget number geom scene mechanism position answer plan construction
//! equilibrium diag number diagram geom kind scene mechanism position answer force construct construction
//! analytic   diag budget geom linear cam scene mechanism position answer force
//! sweep      diag budget digits trig number geom cam scene mechanism position stated answer force motion analytic
//! paper      diag budget json notation diagram lang geom
//! render     diag geom paper
//! accuracy   diag lang budget digits number geom scene mechanism position answer motion plan construct analytic equilibrium
//! worked     diag digits geom scene mechanism position stated answer force motion plan construct equilibrium analytic sweep accuracy
//! certified  diag lang digits number geom scene mechanism position answer motion plan construct accuracy worked
//! effort     diag number geom scene mechanism position answer motion plan construct analytic sweep accuracy worked certified
//! gears      diag geom scene answer worked
//! trains     scene
//! centres    diag geom scene mechanism position answer worked certified construct
//! composite  diag geom scene mechanism position answer construct sweep worked
//! attempts   diag digits geom scene mechanism position answer plan construct worked
//! curvature  diag geom scene mechanism position answer analytic sweep worked centres construct
//! inversions diag geom scene mechanism position sweep worked curvature
//! loops      diag digits kind geom linear scene mechanism position plan worked
//! search     diag budget geom position
//! synthesis  templates diag lang json digits number geom scene mechanism position construct sweep search
//! particle   templates diag json digits number geom scene construct
//! equation   templates diag lang json digits number geom scene position construct
//! report     diag lang notation digits number geom cam scene mechanism position answer force motion plan construct construction equilibrium analytic sweep paper render accuracy worked certified effort gears trains centres composite attempts curvature inversions loops synthesis particle equation
//! figure     diag lang budget notation digits geom cam scene mechanism position answer force plan construct construction equilibrium analytic sweep paper accuracy worked certified effort gears trains centres composite attempts curvature inversions loops synthesis particle equation report
//! webfont    paper
//! worksheet  diag lang notation digits geom scene mechanism answer plan construct paper render worked certified centres composite attempts loops synthesis particle equation report figure webfont
//! lesson     diag lang budget notation digits geom scene mechanism position plan construct construction equilibrium sweep paper render worked certified centres synthesis particle report figure webfont
//! problem    diag lang json kind notation digits geom cam scene mechanism position answer plan construct sweep paper render worked certified gears attempts synthesis particle equation report figure worksheet lesson
//! zip        -
//! homework   diag digits scene answer sweep paper render worked attempts report figure worksheet problem zip
//! exchange   diag notation geom scene position paper render worked figure problem zip
//! cli        diag lang json notation digits scene mechanism plan sweep paper render worked certified effort centres composite attempts curvature inversions loops report figure worksheet lesson problem homework exchange zip
//! ```
//!
//! # Extension
//! A pair or driver is one file in [`mechanism`]'s folder `pair`. It states the items of the scene
//! that the pair comes from, the *form* that it demands ([`mechanism::PairForm`]), and its name.
//! Forms are the few statements in link frames to which all pairs are reduced:
//! - two points meet;
//! - the angles of two links differ by a given amount;
//! - a point lies on the path of a guide;
//! - its travel along the path is given;
//! - a distance is given;
//! - the rotations of two links and that of a line of centres, or a travel along a guide, are
//!   linearly related.
//!
//! The kind of contact between two links is separate ([`scene::Touch`]). Newton's method and the
//! proofs ([`position`]), motion, loop equations and sweep match the forms, and each differentiates
//! them by itself; nodes, numbers of equations and legs follow from them. The table lists the files
//! for each addition.
//! ```text
//! a new pair of these forms   its file in mechanism/pair and its line in the list there; its reading
//!                             and writing in the scene; its symbol
//! a new kind of driver        as a new pair, and its answers in scene/driver.rs; its statement, its
//!                             JSON, its symbol in the lesson
//! a new rolling pair          its kind, and its contour if that is new, in scene/rolling.rs; its file
//!                             in mechanism/pair; its section (scene/decode), its sentence
//!                             (report/given), its writing (inversions), its symbol (figure/mechanism)
//! a new kind of contact       also: its points (position/rolling.rs, belt.rs), motion/conditions.rs,
//!                             plan/contact.rs and locus.rs, construct/special.rs,
//!                             construction/measure.rs, sweep/compile/rolling.rs
//! a new form                  also: its equation (position/equations.rs), coefficients
//!                             (position/coupled.rs), motion (motion/conditions.rs), rows
//!                             (analytic/rows.rs), legs (mechanism/groups.rs, plan/reduce.rs),
//!                             sweep/train.rs
//! ```
//! Kinds of pair are private to their folder, so that no other file can match them. `tests/tidy.rs`
//! keeps the lists of files that match forms, kinds of driver and kinds of leg; these lists only
//! shrink.
//!
//! Enums that grow and that no other crate of the workspace matches are `#[non_exhaustive]`. Enums
//! that other crates match (forms, kinds of driver, quantities, steps of a plan) are not: the
//! compiler then reports every place that must handle a new variant, which `_ =>` would hide.
//!
//! # Invariants
//! [`construct`] and [`analytic`] are independent: only for this reason is their agreement
//! evidence. They share the mechanism and its positions, nothing else. No order of a hash map
//! reaches an output. No decision depends on an absolute tolerance.

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// clippy.toml lists the functions of f64 with a last bit that depends on the platform; tests may
// use them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The list names private modules too; `cargo doc --document-private-items` follows those links.
#![allow(rustdoc::private_intra_doc_links)]

pub use hodograph_analytic as analytic;
pub use hodograph_base::{
    budget, cam, diag, diagram, digits, geom, kind, lang, linear, notation, number, trig,
};
pub use hodograph_board::{construct, construction, equilibrium, plan};
pub use hodograph_figure as figure;
pub use hodograph_mechanism::{answer, force, mechanism, motion, position, stated};
pub use hodograph_methods::{
    attempts, centres, composite, curvature, equation, gears, inversions, loops, particle, trains,
};
pub use hodograph_paper::{paper, render};
pub use hodograph_report as report;
pub use hodograph_scene as scene;
pub use hodograph_search as search;
pub use hodograph_sweep as sweep;
pub use hodograph_synthesis as synthesis;
pub use hodograph_worked::{accuracy, certified, effort, worked};

#[cfg(feature = "cli")]
mod cli;
#[cfg(feature = "exchange")]
pub mod exchange;
#[cfg(feature = "cli")]
pub mod homework;
pub mod lesson;
pub mod problem;
mod webfont;
pub mod worksheet;
#[cfg(feature = "exchange")]
mod zip;

// Compiled again when its Chinese texts change.
const _: &str = include_str!("../po/zh.po");

/// Runs the command-line program on the arguments of the process; only the binary calls it.
#[cfg(feature = "cli")]
#[doc(hidden)]
pub use cli::main as program;
#[cfg(feature = "cli")]
pub use cli::parts;
