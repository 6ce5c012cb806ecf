//! The `platewash` command.

fn main() -> std::process::ExitCode {
    platewash::cli::program(std::env::args_os()).into()
}
