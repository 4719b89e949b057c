//! A small project in a temporary folder, and the binary run in it.

use std::path::{Path, PathBuf};

use assert_cmd::Command;

/// eq. 29 of velinov2018 with its printed constants, over [−10, 10].
pub(crate) const PUBLISHED: &str = r#"# as printed
form = "sine_integral/published"
target = "sine_integral"
[domain]
x = { from = -10, to = 10, count = 401 }
[parameters]
tail = { fixed = 0.66142739 }
offset = { fixed = 0.38272292 }
"#;

/// The same, fitted.
pub(crate) const REFIT: &str = r#"description = "eq. 29 refitted"
form = "sine_integral/published"
target = "sine_integral"
[domain]
x = { from = -10, to = 10, count = 401 }
[parameters]
tail = { start = 0.7, lower = 0, upper = 2 }
offset = { start = 0.4 }
"#;

/// A form without constants.
pub(crate) const LOOKUP: &str = r#"form = "sine_integral/lookup_64"
target = "sine_integral"
[domain]
x = { from = -10, to = 10, count = 401 }
"#;

/// Measured at x = 3.56: 0.05098 for the printed constants, 0.05098 for the fitted ones.
pub(crate) const GATES: &str = r#"[[gate]]
subject = "sine_integral/published"
metric = "max_abs"
domain = "x = -10:10"
limit = 0.05105
why = "velinov2018 eq. 29 and fig. 7; measured 0.05098 at x = 3.56"

[[gate]]
subject = "sine_integral/refit"
metric = "rms"
limit = 0.0296
why = "the optimum of two constants; measured 0.0295"
"#;

/// A line through noisy points, as a WGSL form and a table of it.
pub(crate) const LINE_WGSL: &str = "override a: f32;\noverride b: f32 = 0.5;\n\
    fn line(x: f32) -> f32 { return a * x + b; }\n";
/// y = 2 x + 1 with a little noise.
pub(crate) const LINE_CSV: &str = "x [1],y [1]\n0,1.1\n1,2.9\n2,5.05\n3,6.95\n4,9.02\n";

/// A project in a temporary folder, removed with the value.
pub(crate) struct Project {
    folder: tempfile::TempDir,
}

impl Project {
    /// A project with three specs, two gates, and no results.
    pub(crate) fn new() -> Self {
        let project = Self { folder: tempfile::tempdir().expect("a temporary folder") };
        project.write("fits/gates.toml", GATES);
        project.write("fits/sine_integral/published.toml", PUBLISHED);
        project.write("fits/sine_integral/refit.toml", REFIT);
        project.write("fits/sine_integral/lookup.toml", LOOKUP);
        project
    }

    /// The same after `fit --all`.
    pub(crate) fn fitted() -> Self {
        let project = Self::new();
        project.striae().args(["fit", "--all"]).assert().success();
        project
    }

    /// A path in the project.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Writes a file, and its folder.
    pub(crate) fn write(&self, name: &str, text: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path(name);
        let folder = path.parent().expect("a file lies in a folder");
        std::fs::create_dir_all(folder).expect("a writable temporary folder");
        std::fs::write(&path, text).expect("a writable temporary folder");
        path
    }

    /// The content of a file.
    pub(crate) fn read(&self, name: &str) -> String {
        let path = self.path(name);
        std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
    }

    /// The binary, in the project's folder.
    pub(crate) fn striae(&self) -> Command {
        striae(self.folder.path())
    }
}

/// The binary, in `folder`, with no setting of the surroundings that would change what it does.
pub(crate) fn striae(folder: &Path) -> Command {
    let mut command = Command::cargo_bin("striae").expect("the binary of this package");
    command.current_dir(folder).env_remove("STRIAE_PROJECT").env_remove("STRIAE_REQUIRE_GPU");
    command
}
