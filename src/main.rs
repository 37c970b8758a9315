//! The `hodograph` program.

fn main() -> std::process::ExitCode {
    hodograph::program()
}
