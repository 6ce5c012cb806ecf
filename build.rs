//! Asks the linker to keep equal functions once, where it can: the command has a largest size.

fn main() {
    platewash_bundler::fold_equal_functions("bin");
}
