//! What moves: links, pairs and groups of a scene, where they are, how fast they move.
//!
//! Rooms: [`mechanism`] (links, pairs and drivers as a graph, each pair a value that demands a form; Assur groups in solving order),
//! [`position`] (where everything is; what a form measures is written once, in any number), [`stated`] (proof of positions against the scene),
//! [`answer`] (what a question means), [`motion`] (velocities and accelerations group by group, in any number).

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// A kind that is added shows the compiler every match that it concerns.
#![warn(clippy::wildcard_enum_match_arm)]
// clippy.toml lists the functions of f64 whose last bit the platform decides; tests may use them.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]
// The maps name private rooms too; `cargo doc --document-private-items` follows those links.
#![allow(rustdoc::private_intra_doc_links)]

pub mod answer;
pub mod force;
pub mod mechanism;
pub mod motion;
pub mod position;
pub mod stated;
