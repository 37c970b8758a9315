//! Drags the crank of a template through a quarter of a turn, and prints the time and the changes
//! of each picture: `cargo run --release --example live -- shaper`.

use hodograph::problem::{Live, Look, Options, PageDelta, Pictures, read, templates};
use std::time::Instant;

fn main() -> Result<(), hodograph::diag::Faults> {
    let name = std::env::args().nth(1).unwrap_or_else(|| "shaper".to_owned());
    let problem = read(templates::text(&name, &[])?)?.value;
    let mut live =
        Live::new(&problem, &Options::default(), &Pictures::default(), &Look::default())?;
    let start = live.values().to_vec();
    for k in 1..=90 {
        let mut values = start.clone();
        if let Some(first) = values.first_mut() {
            *first += f64::from(k) * 0.01745;
        }
        let before = Instant::now();
        let pages = live.redraw(&values)?;
        let count = |of: fn(&PageDelta) -> usize| pages.iter().map(of).sum::<usize>();
        let [changed, moved] = [count(|p| p.delta.changed.len()), count(|p| p.delta.moved.len())];
        println!("{k}: {:?}, {changed} elements redrawn, {moved} moved", before.elapsed());
    }
    Ok(())
}
