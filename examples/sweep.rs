//! A whole turn of the driver: columns of numbers, for the program's own use and as a CSV file.
//!
//! `cargo run --example sweep` writes `turn.csv` to the current folder.

use hodograph::problem::{read, templates};
use hodograph::report::table::{Csv, PiecePlace, RowFormat, TableHead, TablePiece};
use hodograph::scene::Angle;
use hodograph::sweep::{self, PlacedScene, Stations, Width};
use std::error::Error;
use std::fs::File;
use std::io::Write;

pub fn main() -> Result<(), Box<dyn Error>> {
    let scene = read(templates::text("crank-rocker", &[])?)?.value.into_scene()?;
    let mechanism = sweep::mechanism(&scene)?;
    let placed = PlacedScene::new(&scene, &mechanism)?;

    // The first driver in steps of one degree. A row for each position that the driver reaches; the
    // notes name the others.
    let stations = Stations::turned(Angle::Deg(0.0), Angle::Deg(360.0), 360);
    let table = sweep::run(&placed, 0, &stations, Width::default())?;
    for note in &table.notes {
        eprintln!("{note}");
    }

    // Numbers are in SI units; a vector has the columns `.x`, `.y` and one for its magnitude.
    for column in &table.columns {
        println!("{} [{}]", column.name, column.unit);
    }
    let (angle, rate) =
        (&table.columns[0], table.column("omega_3").ok_or("omega_3 is not asked for")?);
    let fastest = (0..table.rows())
        .max_by(|&i, &j| rate.values[i].abs().total_cmp(&rate.values[j].abs()))
        .ok_or("no position is reached")?;
    println!(
        "the rocker turns fastest at {:.0} deg: {:.4} {}",
        angle.values[fastest].to_degrees(),
        rate.values[fastest],
        rate.unit
    );

    // The same table as `hodograph sweep` writes it: a beginning, pieces of whole rows, an end.
    // `Npy` and `Parquet` are used alike.
    let csv = Csv::new(TableHead::of("Crank-rocker", &table));
    let columns: Vec<&[f64]> = table.columns.iter().map(|c| c.values.as_slice()).collect();
    let begin = csv.begin(table.rows() as u64, &table.notes);
    let piece = csv.piece_in(&columns, TablePiece::default())?;
    let standing =
        PiecePlace { offset: begin.len() as u64, rows: piece.rows, index: piece.index.clone() };
    let mut file = File::create("turn.csv")?;
    file.write_all(&begin)?;
    piece.write(&mut file)?;
    file.write_all(&csv.end(&[standing], &table.notes)?)?;
    Ok(())
}
