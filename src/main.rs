//! The `hodograph` program; see [`hodograph::cli`].

fn main() -> std::process::ExitCode {
    hodograph::cli::main()
}
