//! The architecture as a test: modules use what stands above them in `src/lib.rs` and nothing
//! below; every effect is registered, documented, gated and reported; the documents name only
//! files that exist.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn rust_files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a source folder") {
        let path = entry.expect("a folder entry").path();
        if path.is_dir() {
            rust_files(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// Modules in the order of `src/lib.rs`.
fn modules() -> Vec<String> {
    read(&root().join("src/lib.rs"))
        .lines()
        .filter_map(|line| line.strip_prefix("pub mod ")?.strip_suffix(';').map(str::to_owned))
        .collect()
}

/// Top-level modules named after `crate::` in a text, comments left out.
fn used_modules(text: &str) -> BTreeSet<String> {
    let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
    let mut used = BTreeSet::new();
    for line in code {
        for rest in line.split("crate::").skip(1) {
            let name: String =
                rest.chars().take_while(|c| c.is_ascii_alphanumeric() || *c == '_').collect();
            if let Some(group) = rest.strip_prefix('{') {
                let group = group.split('}').next().unwrap_or_default();
                used.extend(group.split(',').filter_map(|part| {
                    part.trim()
                        .split("::")
                        .next()
                        .filter(|word| !word.is_empty())
                        .map(str::to_owned)
                }));
            }
            used.insert(name);
        }
    }
    used
}

#[test]
fn modules_use_only_what_stands_above_them() {
    let modules = modules();
    assert!(modules.len() >= 10, "the module list of src/lib.rs was not found");
    let mut faults = Vec::new();
    for (rank, module) in modules.iter().enumerate() {
        let mut files = Vec::new();
        let folder = root().join("src").join(module);
        match folder.is_dir() {
            true => rust_files(&folder, &mut files),
            false => files.push(folder.with_extension("rs")),
        }
        for file in files {
            let used = used_modules(&read(&file));
            for below in &modules[rank + 1..] {
                if used.contains(below) {
                    faults
                        .push(format!("{} uses `{below}`, which stands below it", file.display()));
                }
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn the_check_sees_a_use_of_a_lower_module() {
    let used =
        used_modules("use crate::fit::outcome;\nuse crate::{gpu::Device, table};\n// crate::cli\n");
    assert!(used.contains("fit") && used.contains("gpu") && used.contains("table"));
    assert!(!used.contains("cli"));
}

/// Files by the type that a `pub` line of theirs defines; what is `pub` can be reached, since
/// `unreachable_pub` warns of what cannot.
fn public_types(files: &[PathBuf]) -> BTreeMap<String, Vec<PathBuf>> {
    let mut types: BTreeMap<String, Vec<PathBuf>> = BTreeMap::new();
    for file in files {
        for line in read(file).lines() {
            let mut words = line.trim_start().split(|c: char| !c.is_alphanumeric() && c != '_');
            let (Some("pub"), Some("struct" | "enum" | "trait" | "type"), Some(name)) =
                (words.next(), words.next(), words.next())
            else {
                continue;
            };
            types.entry(name.to_owned()).or_default().push(file.clone());
        }
    }
    types
}

#[test]
fn a_public_type_name_means_one_thing() {
    let mut files = Vec::new();
    rust_files(&root().join("src"), &mut files);
    let types = public_types(&files);
    assert!(types.len() >= 200, "the public types were not found: {types:?}");
    let twice: BTreeMap<_, _> = types.iter().filter(|(_, files)| files.len() > 1).collect();
    assert!(twice.is_empty(), "public types that share a name: {twice:#?}");
}

#[test]
fn every_effect_folder_is_registered_gated_and_reported() {
    let registered: BTreeSet<&str> =
        striae::registry::Registry::builtin().effects().iter().map(|effect| effect.name).collect();
    let gates = read(&root().join("fits/gates.toml"));
    let accuracy = read(&root().join("reports/accuracy.tsv"));
    for entry in fs::read_dir(root().join("src/effects")).expect("effects") {
        let path = entry.expect("a folder entry").path();
        if !path.is_dir() {
            continue;
        }
        let name = path.file_name().and_then(|name| name.to_str()).expect("UTF-8 name").to_owned();
        assert!(registered.contains(name.as_str()), "effect `{name}` is not in the registry");
        assert!(gates.contains(&format!("\"{name}/")), "effect `{name}` has no gate");
        let line = format!("\n{name}/");
        assert!(accuracy.contains(&line), "effect `{name}` is not in reports/accuracy.tsv");
    }
}

#[test]
fn every_registered_item_is_described() {
    for effect in striae::registry::Registry::builtin().effects() {
        assert!(!effect.references.is_empty(), "{} has no reference", effect.name);
        for reference in effect.references {
            for text in [reference.description, reference.accuracy, reference.source] {
                assert!(!text.is_empty(), "{} is not described", reference.name);
            }
        }
        for form in striae::registry::Registry::builtin().forms_of(effect) {
            assert!(form.name.starts_with(&format!("{}/", effect.name)), "{}", form.name);
            assert!(!form.description.is_empty() && !form.citation.is_empty(), "{}", form.name);
            assert!(form.reference.is_some(), "{} approximates nothing", form.name);
            for source in &form.constants_of {
                let known = striae::registry::Registry::builtin().form(source).is_some()
                    || root().join(format!("fits/{source}.json")).is_file();
                assert!(known, "{} takes constants from `{source}`, which is not there", form.name);
            }
            assert!(
                root().join(&form.path).is_file(),
                "{} names no file: {}",
                form.name,
                form.path
            );
        }
    }
}

#[test]
fn documents_name_only_files_that_exist() {
    for document in ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md", "data/tutorial/README.md"] {
        let path = root().join(document);
        let text = read(&path);
        let folder = path.parent().expect("a document lies in a folder");
        for quoted in text.split('`').skip(1).step_by(2) {
            let looks_like_path = (quoted.starts_with("src/")
                || quoted.starts_with("tests/")
                || quoted.starts_with("fits/")
                || quoted.starts_with("data/"))
                && !quoted.contains(['<', '*', ' ', '{', '…']);
            if looks_like_path {
                assert!(
                    root().join(quoted).exists(),
                    "{document} names `{quoted}`, which does not exist"
                );
            }
        }
        for target in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            if !target.starts_with("http") && !target.starts_with('#') {
                let file = target.split('#').next().unwrap_or(target);
                assert!(
                    folder.join(file).exists(),
                    "{document} links to `{target}`, which does not exist"
                );
            }
        }
    }
}
