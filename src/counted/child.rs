//! The process that counts, and its parent.
//!
//! The parent writes one [`Request`] as JSON; the child answers line by line, as it gets on, so that a
//! crash costs the kernel at which it happens and no other.

use std::io::{self, BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde::{Deserialize, Serialize};

use super::foreign::vulkan;
use super::kernel::KernelCode;
use super::statistics::Statistics;
use super::target::{Compiler, GpuTarget};
use crate::numeric::measured::Measured;

/// The hidden verb of the command line that runs [`count_kernels`].
pub const COUNT_VERB: &str = "count-kernels";

#[derive(Serialize, Deserialize)]
struct Request {
    target: GpuTarget,
    kernels: Vec<KernelCode>,
}

/// A line of the child's answer: the driver first, then one per kernel in the order asked.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Answer {
    Driver(String),
    /// Nothing can be counted, and why.
    Unavailable(String),
    Kernel(Measured<Statistics>),
}

/// What a batch of kernels came to.
pub(super) struct Counted {
    pub(super) driver: Measured<String>,
    pub(super) kernels: Vec<Measured<Statistics>>,
}

impl Counted {
    /// That none of `kernels` was counted.
    pub(super) fn nothing(reason: &str, kernels: usize) -> Self {
        let kernels = (0..kernels).map(|_| Measured::NotMeasured(reason.to_owned())).collect();
        Self { driver: Measured::NotMeasured(reason.to_owned()), kernels }
    }
}

/// Counts `kernels` on `target` by the program of striae.
pub(super) fn counted(program: &Path, target: GpuTarget, kernels: &[&KernelCode]) -> Counted {
    let all = kernels.len();
    let driver_files = match target.compiler() {
        Compiler::Radv(_) => match radv() {
            Some(path) => path,
            None => return Counted::nothing(NO_RADV, all),
        },
    };
    let mut counted = Counted { driver: Measured::NotMeasured(String::new()), kernels: Vec::new() };
    while counted.kernels.len() < all {
        let left = kernels[counted.kernels.len()..].iter().map(|code| (*code).clone()).collect();
        let request = Request { target, kernels: left };
        let before = counted.kernels.len();
        match answers(program, &driver_files, &request) {
            Err(reason) => return Counted::nothing(&reason, all),
            Ok((answers, ending)) => {
                for answer in answers {
                    match answer {
                        Answer::Driver(driver) => counted.driver = Measured::Value(driver),
                        Answer::Unavailable(reason) => return Counted::nothing(&reason, all),
                        Answer::Kernel(kernel) => counted.kernels.push(kernel),
                    }
                }
                if counted.driver.value().is_none() {
                    let reason = format!("{} counted nothing: {ending}", program.display());
                    return Counted::nothing(&reason, all);
                }
                counted.kernels.truncate(all);
                // The kernel at which the compiler ended the process costs itself alone.
                if counted.kernels.len() < all {
                    let reason = format!("the compiler failed on it: {ending}");
                    counted.kernels.push(Measured::NotMeasured(reason));
                }
                debug_assert!(counted.kernels.len() > before);
            }
        }
    }
    counted
}

/// What the child answered before it ended, and how it ended.
fn answers(
    program: &Path,
    driver_files: &Path,
    request: &Request,
) -> Result<(Vec<Answer>, String), String> {
    let failed = |error: io::Error| format!("{}: {error}", program.display());
    let json = serde_json::to_vec(request).map_err(|error| error.to_string())?;
    let mut command = Command::new(program);
    command.arg(COUNT_VERB).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
    // No layer and no cache: the same compiler on every machine and every run.
    command.env("NODEVICE_SELECT", "1").env("MESA_SHADER_CACHE_DISABLE", "true");
    command.env("VK_DRIVER_FILES", driver_files).env("VK_ICD_FILENAMES", driver_files);
    match request.target.compiler() {
        Compiler::Radv(family) => command.env("RADV_FORCE_FAMILY", family),
    };
    let mut child = command.spawn().map_err(failed)?;
    let mut stdin = child.stdin.take();
    let stdout = child.stdout.take();
    let answers = std::thread::scope(|scope| {
        // A child that ends early does not read to the end: that is seen in its answers.
        scope.spawn(move || stdin.take().map(|mut stdin| stdin.write_all(&json)));
        let lines = stdout.into_iter().flat_map(|stdout| BufReader::new(stdout).lines());
        let read = |line: io::Result<String>| serde_json::from_str::<Answer>(&line.ok()?).ok();
        lines.map_while(read).collect()
    });
    // What is not an answer is not read on: the child must not wait for that.
    let ending = child.wait().map_err(failed)?;
    Ok((answers, ending.to_string()))
}

/// Why there is no compiler of AMD's.
const NO_RADV: &str =
    "no Vulkan driver `radeon_icd*.json` is installed: mesa-vulkan-drivers has it";

/// The manifest of RADV, in the folders where the loader looks for drivers.
fn radv() -> Option<PathBuf> {
    let mut folders: Vec<PathBuf> = vec!["/etc/vulkan/icd.d".into()];
    let shared = std::env::var_os("XDG_DATA_DIRS").unwrap_or_else(|| SHARED.into());
    folders.extend(std::env::split_paths(&shared).map(|folder| folder.join("vulkan/icd.d")));
    let manifests = folders.iter().filter_map(|folder| std::fs::read_dir(folder).ok()).flatten();
    let mut found: Vec<PathBuf> = manifests
        .filter_map(|entry| Some(entry.ok()?.path()))
        .filter(|path| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            name.starts_with("radeon_icd") && name.ends_with(".json") && !name.contains("i686")
        })
        .collect();
    found.sort();
    found.into_iter().next()
}

/// Folders of shared data where the environment names none.
const SHARED: &str = "/usr/local/share:/usr/share";

/// The child: reads a request, answers on `out`.
///
/// # Errors
/// If the request is none, or an answer cannot be written; what cannot be counted is an answer.
pub fn count_kernels(mut request: impl Read, mut out: impl Write) -> io::Result<()> {
    let mut json = Vec::new();
    request.read_to_end(&mut json)?;
    let request: Request = serde_json::from_slice(&json)?;
    let mut answer = |answer: &Answer| -> io::Result<()> {
        writeln!(out, "{}", serde_json::to_string(answer)?)?;
        out.flush()
    };
    match request.target.compiler() {
        Compiler::Radv(_) => {
            let compiler = match vulkan::Compiler::open() {
                Ok(compiler) => compiler,
                Err(reason) => return answer(&Answer::Unavailable(reason)),
            };
            answer(&Answer::Driver(compiler.driver().to_owned()))?;
            for kernel in &request.kernels {
                let compiled = compiler.compile(&kernel.words, kernel.tables);
                answer(&Answer::Kernel(match compiled.and_then(|compiled| compiled.of_radv()) {
                    Ok(statistics) => Measured::Value(statistics),
                    Err(reason) => Measured::NotMeasured(reason),
                }))?;
            }
        }
    }
    Ok(())
}
