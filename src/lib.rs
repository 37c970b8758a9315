//! hodograph solves planar mechanisms the way they are solved at the drawing board.
//!
//! From one scene file it plans the relative-motion vector equations, draws the velocity and acceleration polygons step by
//! step to the scales μ_l, μ_v, μ_a, reads the answers off the paper, and proves them against the loop equations.
//!
//! One call takes a file of any kind, a scene, a design task or motions of points, to its answers and to all that is written of them; a scene can be
//! built without a file too:
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
//! # The way through
//! ```text
//! scene.json ─▶ Scene ─▶ Mechanism ─┬─▶ Plan ──────────┬─▶ Drawing ──────┬─▶ Figure ─▶ SVG ─▶ PNG
//!   raw text    valid,   links,     │  which equations, │  paper mm,      │  lines, arrows,
//!               SI       pairs,     │  no numbers       │  ruler steps    │  labels in mm
//!                        groups     └─▶ Configuration ──┤                 └─▶ Answers ──┐
//!                                       positions       └─▶ Solution (loop equations) ──┴─▶ Agreement
//! ```
//! Every arrow is one public function from one finished value to the next; nothing flows back. [`worked::work`] walks them
//! all; [`problem::solve()`] does it for every kind of file.
//!
//! # Rooms
//! - [`scene`]: the file a person writes. JSON with places → raw mirror → valid [`scene::Scene`]; scenes without JSON ([`scene::build`]); units, expressions,
//!   templates, schema; what can be asked, a file for each family of quantities ([`scene::quantity`]); in which unit a number is printed
//!   ([`scene::book`]).
//! - [`cam`]: disc cams as plain geometry: motion laws, profiles of arcs and lines, the profile by inversion, pressure angle, curvature.
//! - [`mechanism`]: links, pairs, drivers as a graph, each pair a value that demands a form; mobility, and what only repeats other
//!   pairs; Assur groups in solving order with their legs; the demand of the questions.
//! - [`position`]: where everything is: a kernel for each dyad, triads, Newton's method for the rest;
//!   whether what repeats other pairs holds by itself ([`position::redundant`]).
//! - [`stated`]: proof of a configuration against what the scene states: lengths, sides, guides, drivers, contacts without penetration. It shares nothing with
//!   the position solver.
//! - [`motion`]: velocities and accelerations group by group, in any number; [`number`]: the numbers.
//! - [`plan`]: the vector equations: legs to loci, images, notation profiles, words and symbols. Holds no numbers.
//! - [`construction`]: what is done with ruler and set squares, as plain data without coordinates, and its evaluation for given places, scales and a
//!   pencil.
//! - [`construct`]: the drawing board: a plan written as acts and drawn; the one door between SI and millimetres ([`construct::scale`]), polygons, readings.
//! - [`force`]: loads of an instant: given forces, weights, springs, inertia.
//! - [`equilibrium`]: forces on the drawing board: moments and force polygons, group after group.
//! - [`analytic`]: constraint rows, Jacobian, conditioning; singular poses by the next orders. Knows neither plan nor paper.
//! - [`paper`]: what figures are made of: typed items in mm, labels, words of both languages, fonts, placement of labels, styles;
//!   [`render`]: ink: numbers, SVG and PDF (the doors between y up and y down), PNG; GIF and SVG that move; two figures
//!   compared ([`render::diff`]).
//! - [`answer`]: what a question means, for both ways alike; [`accuracy`]: how far the two are apart, and what a pencil makes of the
//!   drawing.
//! - [`worked`]: the whole way as one call, each stage's result kept.
//! - [`certified`]: how many digits are true ([`certified::ladder`], for the steps of the drawing [`certified::steps()`]);
//!   [`effort`]: what was done, and what accuracy costs ([`effort::ways`]).
//! - [`centres`]: instantaneous centres of velocity: the order of finding from topology alone, two lines drawn for each, rates and
//!   speeds by centres beside those of drawing and analysis.
//! - [`curvature`]: how paths bend: pole, inflection circle, centres of curvature with the ruler and from accelerations; centrodes.
//! - [`inversions`]: each link of a chain as ground in turn, every one a scene.
//! - [`gears`]: a pair of spur gears with involute flanks: circles, profile shifts, contact ratio.
//! - [`trains`]: gear trains by Willis' method, from numbers of teeth alone, beside what drawing and analysis say.
//! - [`attempts`]: wrong solutions: where a known mistake can be made, and what its equations, drawn on the same board, give.
//! - [`composite`]: composite motion of a point: which moving points and frames serve and why not, the parts of the motion, projections.
//! - [`particle`]: motions without a mechanism: pursuit, integrated with a bound of its error; a plate that turns in space, in two views.
//! - [`sweep`]: all positions of a driver: the scene compiled to operations over chunks of positions; limits and extremes of the
//!   motion; batches of mechanisms.
//! - [`search`]: crank-rockers whose coupler point passes nearest to given places, by differential evolution and Gauss–Newton.
//! - [`synthesis`]: from what a linkage is to do to scenes that do it: closed formulas, the construction with ruler and paper, judging by sweeping.
//! - [`figure`]: diagram, polygons, tables, sheet as items on paper; of a motion line diagrams, paths with hodographs, the sheet of many
//!   poses, the motion frame by frame.
//! - [`lesson`]: one HTML page with the construction step by step and a driver to drag, and fragments for slides.
//! - [`report`]: plan, construction, answers, diagnostics as text (in either language) and JSON.
//! - [`worksheet`]: problem and solution as a document, and its writers: HTML with MathML, Markdown, Typst, pages for PDF.
//! - [`webfont`]: the letters that every page brings with it.
//! - [`problem`]: every kind of file through one call: read, solve, and what is written of the answers.
//! - [`cli`]: the only room that prints, reads arguments or touches files.
//! - [`templates`](problem::templates): the texts of the files under `templates/`, known by their names.
//! - Small shared ones: [`geom`], [`trig`], [`digits`], [`diag`], [`budget`], [`json`](hodograph_base::json), [`kind`], [`diagram`], [`lang`], [`notation`].
//!
//! # Crates
//! The rooms are crates under `crates/`, so that Cargo refuses what the table below forbids, above all that drawing and analysis know one
//! another, and builds each at the level of optimisation that it needs. The root package hands on all that a user needs; in it stand the rooms that
//! write documents, and the program. A package includes files of its own alone: the folder `templates/` is a crate, the fonts are in `crates/paper`.
//! ```text
//! templates  templates
//! base       diag budget json digits trig number geom cam kind diagram lang notation
//! scene      scene
//! mechanism  mechanism position stated answer force motion
//! board      plan construction construct equilibrium
//! analytic   analytic
//! sweep      sweep
//! paper      paper render
//! worked     accuracy worked certified effort
//! methods    gears trains centres composite attempts curvature inversions particle
//! search     search
//! synthesis  synthesis
//! report     report
//! figure     figure
//! ```
//!
//! # Who may import whom
//! Rooms from the bottom up, each with the rooms that it imports. `tests/tidy.rs` compares the table with the imports of all files.
//! ```text
//! templates  -
//! diag       -
//! budget     diag
//! json       diag
//! lang       diag
//! kind       -
//! diagram    diag lang kind
//! notation   lang
//! digits     -
//! trig       -
//! number     budget trig
//! geom       number
//! cam        number geom
//! scene      templates diag json diagram kind lang digits trig number geom cam
//! mechanism  diag scene
//! position   diag budget digits trig number geom cam scene mechanism
//! stated     diag digits trig geom cam scene mechanism position
//! answer     number geom scene mechanism position
//! force      diag trig number geom scene mechanism position answer
//! motion     number geom scene mechanism position answer force
//! plan       diag notation scene mechanism
//! construction budget diagram digits kind number geom
//! construct  diag budget number geom scene mechanism position answer plan construction
//! equilibrium diag diagram geom kind scene mechanism position answer force construct construction
//! analytic   diag budget geom cam scene mechanism position answer force
//! sweep      diag budget digits trig number geom cam scene mechanism position stated answer force motion analytic
//! paper      diag budget json notation diagram lang geom
//! render     diag geom paper
//! accuracy   diag budget digits number geom scene mechanism position answer motion plan construct analytic
//! worked     diag digits geom scene mechanism position stated answer force motion plan construct equilibrium analytic sweep accuracy
//! certified  diag digits number geom scene mechanism position answer motion plan construct accuracy worked
//! effort     diag number geom scene mechanism position answer motion plan construct analytic sweep accuracy worked certified
//! gears      geom
//! trains     scene
//! centres    diag geom scene mechanism position answer worked certified
//! composite  diag geom scene mechanism position answer worked
//! attempts   diag digits geom scene mechanism position answer plan construct worked
//! curvature  diag geom scene mechanism position answer analytic sweep worked centres
//! inversions diag scene mechanism position sweep worked curvature
//! search     diag budget geom position
//! synthesis  templates diag json digits number geom scene mechanism position construct sweep search
//! particle   templates diag json digits number geom scene construct
//! report     diag notation digits number geom cam scene mechanism position answer force motion plan construct construction equilibrium analytic sweep paper render accuracy worked certified effort trains centres composite attempts curvature inversions synthesis particle
//! figure     diag budget notation digits geom cam scene mechanism position answer force plan construct construction equilibrium analytic sweep paper accuracy worked certified effort gears trains centres composite attempts curvature inversions synthesis particle report
//! webfont    paper
//! worksheet  diag notation digits geom scene mechanism answer plan construct paper render worked certified centres attempts synthesis particle report figure webfont
//! lesson     diag budget notation digits geom scene mechanism position plan construct construction equilibrium sweep paper render worked certified centres synthesis particle report figure webfont
//! problem    diag json notation geom scene answer plan sweep paper worked certified attempts synthesis particle report figure worksheet lesson
//! cli        diag json notation digits geom cam scene mechanism position plan sweep paper render worked certified effort centres composite attempts curvature inversions report figure worksheet lesson problem
//! ```
//!
//! # What grows
//! A pair or driver is one file in [`mechanism`]'s folder `pair`: of which items of the scene it is, which *form* it demands
//! ([`mechanism::Form`]), how it is named. Forms are the few statements in link frames that all pairs come down to: two points meet, the
//! angles of two links differ by what is given, a point lies on the path of a guide, its way along it is given, a distance is given,
//! turnings of two links and that of a line of centres, or a way along a guide, are linearly related. How two links touch is asked apart from
//! that ([`scene::Touch`]). Newton's method and the proofs ([`position`]), motion, loop equations and sweep match the forms, each differentiates
//! them by itself; nodes, numbers of equations and legs follow from them. The table says where a new one is written.
//! ```text
//! a new pair of these forms   its file in mechanism/pair and its line in the list there; the scene's reading and writing of it; its symbol
//! a new kind of driver        the same, and its answers in scene/driver.rs; its statement, its JSON, its symbol in the lesson
//! a new rolling pair          its kind, and its contour if that is new, in scene/rolling.rs; its file in mechanism/pair; its section (scene/decode),
//!                             its sentence (report/given), its writing (inversions), its symbol (figure/mechanism)
//! a new way to touch          besides: the points where it does (position/rolling.rs, belt.rs), motion/conditions.rs, plan/contact.rs and locus.rs,
//!                             construct/special.rs and measure.rs, sweep/compile/rolling.rs
//! a new form                  besides: its equation (position/equations.rs), coefficients (position/coupled.rs), motion
//!                             (motion/conditions.rs), rows (analytic/rows.rs), legs (mechanism/groups.rs, plan/reduce.rs), sweep/train.rs
//! ```
//! Kinds of pair are private to their folder, so that no other file can match them; `tests/tidy.rs` keeps the lists of files that match
//! forms, kinds of driver and kinds of leg, which only shrink.
//!
//! Kinds that grow and that no other crate of the workspace takes apart are `#[non_exhaustive]`. Those that are taken apart elsewhere (forms, kinds of
//! driver, quantities, steps of a plan) are not: the compiler then tells every place where a new one is to be treated, which `_ =>` would hide.
//!
//! # What must not be
//! [`construct`] and [`analytic`] do not know one another: their agreement is evidence only because of this. They share the
//! mechanism and its positions, nothing else. No hash-map order reaches an output. No absolute tolerance decides anything.

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// clippy.toml lists the functions of f64 whose last bit the platform decides; tests may use them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The map names private rooms too; `cargo doc --document-private-items` follows those links.
#![allow(rustdoc::private_intra_doc_links)]

pub use hodograph_analytic as analytic;
pub use hodograph_base::{budget, cam, diag, diagram, digits, geom, kind, lang, notation, number, trig};
pub use hodograph_board::{construct, construction, equilibrium, plan};
pub use hodograph_figure as figure;
pub use hodograph_mechanism::{answer, force, mechanism, motion, position, stated};
pub use hodograph_methods::{attempts, centres, composite, curvature, gears, inversions, particle, trains};
pub use hodograph_paper::{paper, render};
pub use hodograph_report as report;
pub use hodograph_scene as scene;
pub use hodograph_search as search;
pub use hodograph_sweep as sweep;
pub use hodograph_synthesis as synthesis;
pub use hodograph_worked::{accuracy, certified, effort, worked};

#[cfg(feature = "cli")]
mod cli;
pub mod lesson;
pub mod problem;
mod webfont;
pub mod worksheet;

/// Runs the command-line program on the arguments of the process; the binary calls it, and nothing else does.
#[cfg(feature = "cli")]
#[doc(hidden)]
pub use cli::main as program;
