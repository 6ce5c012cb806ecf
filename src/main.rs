//! The `platewash` command.

fn main() -> std::process::ExitCode {
    platewash::cli::main(std::env::args_os()).into()
}
