//! The program `hodograph` as a part of a benchmark's executable, so that no second program is
//! linked.

use std::process::{Command, ExitCode};

/// Set in the environment of an executable that is to be the program.
const AS_PROGRAM: &str = "HODOGRAPH_BENCH_AS_PROGRAM";

/// Returns a command that runs the program.
pub fn hodograph() -> Command {
    let mut command = Command::new(std::env::current_exe().unwrap());
    command.env(AS_PROGRAM, "1");
    command
}

/// Runs the program if this executable is called as such, else the benchmark.
pub fn or(benchmark: impl FnOnce()) -> ExitCode {
    if std::env::var_os(AS_PROGRAM).is_some() {
        return hodograph::program();
    }
    benchmark();
    ExitCode::SUCCESS
}
