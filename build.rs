//! Compiles again when the text of a form comes or goes: the macro that embeds a folder is not told.

fn main() {
    println!("cargo::rerun-if-changed=src/effects");
}
